"""Roughness of surfaces: closed forms of waves, Parseval's theorem, and SurfaceTopography."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipe

import viscontact as vc
from closeness import close_to
from viscontact.bodies.surfaces import power_spectrum
from viscontact.bodies.surfaces.plausibility import described
from viscontact.case import read_case
from viscontact.surfaces import Surface, indenter_of, surface_of, topography_of

AMPLITUDE, LENGTH = 2e-7, 1e-5


def waves(points: int, amplitude: float = AMPLITUDE, count: int = 3) -> Surface:
    """Ridges: a sine along x."""
    phase = 2 * np.pi * count * (np.arange(points) + 0.31) / points
    heights = amplitude * np.sin(phase)[:, np.newaxis] * np.ones(8)
    return Surface(heights, (LENGTH / points, 1e-6), periodic=True)


def rough(periodic: bool = True, shape: tuple[int, int] = (96, 64)) -> Surface:
    heights = 1e-8 * np.random.default_rng(3).standard_normal(shape).cumsum(axis=0)
    return Surface(heights - heights.mean(), (1e-7, 2e-7), periodic=periodic)


def test_mean_deviation_and_rms_height_of_a_sine_are_2a_over_pi_and_a_over_root_2() -> None:
    errors = []
    for points in (48, 96, 192):
        surface = waves(points)
        errors.append(abs(surface.mean_deviation / (2 * AMPLITUDE / math.pi) - 1))
        assert surface.rms_height == close_to(AMPLITUDE / math.sqrt(2), rel=1e-12)
    # The sum over the points of |sin| misses the integral by the square of the spacing.
    assert errors[-1] < 1e-3
    assert np.log2(errors[0] / errors[1]) == close_to(2, abs=0.1)
    assert np.log2(errors[1] / errors[2]) == close_to(2, abs=0.1)


def test_developed_area_is_the_mean_of_both_ways_to_split_a_cell_into_triangles() -> None:
    """ISO 25178-2 as measured: a corner lifted by the cell's edge, areas by cross products."""
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 1]])

    def area(*triangle: int) -> float:
        a, b, c = corners[list(triangle)]
        return float(np.linalg.norm(np.cross(b - a, c - a))) / 2

    either = [area(0, 1, 3) + area(0, 2, 3), area(0, 1, 2) + area(3, 1, 2)]
    surface = vc.Surface(corners[:, 2].reshape(2, 2), 1.0)
    assert surface.developed_ratio == close_to(sum(either) / 2 - 1, rel=1e-14)


@pytest.mark.parametrize("amplitude", [1e-8, 2e-7, 1e-6])
def test_developed_area_and_rms_slope_of_a_sine_converge_to_their_closed_forms(
    amplitude: float,
) -> None:
    # Arc length of s = A q: mean of sqrt(1 + s² cos²) = 2/pi sqrt(1 + s²) E(s²/(1 + s²)).
    s = amplitude * 2 * np.pi * 3 / LENGTH
    exact = 2 / np.pi * math.sqrt(1 + s**2) * ellipe(s**2 / (1 + s**2)) - 1
    errors, slopes = [], []
    for points in (48, 96, 192):
        surface = waves(points, amplitude)
        errors.append(abs(surface.developed_ratio / exact - 1))
        slopes.append(abs(surface.rms_slope / (s / math.sqrt(2)) - 1))
    for each in (errors, slopes):
        assert each[-1] < 1e-3
        assert np.log2(each[0] / each[2]) == close_to(4, abs=0.2)  # second order


def test_developed_area_of_a_plane_is_that_of_its_slopes() -> None:
    x, y = np.meshgrid(np.arange(7), np.arange(5), indexing="ij")
    plane = Surface(0.3 * x * 1e-6 - 0.4 * y * 2e-6, (1e-6, 2e-6))
    assert plane.developed_ratio == close_to(math.sqrt(1.25) - 1, rel=1e-12)
    holed = plane.heights.copy()
    holed[3, 2] = np.nan  # its four cells are left out
    assert plane.with_heights(holed).developed_ratio == close_to(math.sqrt(1.25) - 1)
    assert math.isnan(Surface(np.zeros((5, 1)), 1e-6).developed_ratio)


def test_spectrum_of_a_wave_is_at_its_wave_number_and_holds_its_mean_square() -> None:
    x = np.arange(128)
    heights = AMPLITUDE * np.cos(2 * np.pi * 8 * x / 128)[:, np.newaxis] * np.ones(128)
    spectrum = power_spectrum(Surface(heights, LENGTH / 128, periodic=True))
    assert spectrum.rms_height == close_to(AMPLITUDE / math.sqrt(2), rel=1e-12)
    peak = spectrum.wave_number[spectrum.density.argmax()]
    assert peak == close_to(2 * np.pi * 8 / LENGTH, rel=0.15)  # bins: factors of 1.26
    assert np.sort(spectrum.density)[-2] < 1e-20 * spectrum.density.max()


def test_spectrum_of_white_noise_is_flat_at_its_variance_per_cell() -> None:
    # C = Sq² dx dy for uncorrelated points; a bin of n waves scatters by 1/sqrt(n/2).
    heights = 1e-9 * np.random.default_rng(5).standard_normal((256, 256))
    for periodic in (True, False):
        spectrum = power_spectrum(Surface(heights, (1e-7, 1e-7), periodic=periodic))
        expected = 1e-18 * 1e-14
        # A tenth of a decade around q is a ring of 0.23 q, with a wave in each (2 pi / L)².
        waves = 2 * np.pi * 0.23 * (spectrum.wave_number * 256e-7 / (2 * np.pi)) ** 2
        assert np.all(np.abs(spectrum.density / expected - 1) < 5 / np.sqrt(waves / 2))
        assert spectrum.density[-5:] == close_to(expected, rel=0.06)


def test_roughness_and_spectrum_agree_with_surfacetopography() -> None:
    pytest.importorskip("SurfaceTopography")
    surface = rough()
    other = topography_of(surface)
    assert other.rms_height_from_area() == close_to(surface.rms_height, rel=1e-12)
    spectrum = power_spectrum(surface)
    # Bin edges in the middle between our bins would mix other waves; ours are given to it.
    steps = zip(surface.shape, surface.spacing, strict=True)
    q = np.hypot(*np.meshgrid(*(2 * np.pi * np.fft.fftfreq(n, d) for n, d in steps), indexing="ij"))
    low, high = q[q > 0].min(), np.pi / max(surface.spacing)
    count = round(10 * np.log10(high / low))
    edges = np.geomspace(low * (1 - 1e-9), high * (1 + 1e-9), count + 1)
    _, density = other.power_spectrum_from_area(collocation=edges, reliable=False)
    density = np.ma.compressed(density)
    np.testing.assert_allclose(spectrum.density, density[-spectrum.density.size :], rtol=1e-9)


def test_spectrum_refuses_missing_points_and_line_scans() -> None:
    heights = rough().heights.copy()
    heights[2, 3] = np.nan
    with pytest.raises(ValueError, match="has no height at 1 of"):
        power_spectrum(Surface(heights, 1e-7))
    with pytest.raises(ValueError, match="is a line scan"):
        power_spectrum(Surface(heights[:, :1], 1e-7))


def test_surface_becomes_a_topography_and_comes_back_unchanged() -> None:
    pytest.importorskip("SurfaceTopography")
    for periodic in (True, False):
        surface = rough(periodic, (12, 9))
        heights = surface.heights.copy()
        heights[1, 2] = np.nan
        back = surface_of(topography_of(surface.with_heights(heights)))
        np.testing.assert_array_equal(back.heights, heights)
        assert back.spacing == close_to(surface.spacing, rel=1e-15)
        assert back.periodic == periodic


# The map is coarse; all three ways must give the same result all the same.
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_topography_in_micrometres_is_pressed_as_the_map_it_is() -> None:
    topographies = pytest.importorskip("SurfaceTopography")
    x = np.linspace(-1, 1, 33)
    heights = -0.5 * np.add.outer(x**2, 2 * x**2)  # µm
    topography = topographies.Topography(heights, (66.0, 99.0), unit="um")
    surface = surface_of(topography)
    assert surface.spacing == close_to((2e-6, 3e-6))
    assert surface.height_range == close_to(1.5e-6)
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    arguments = (rubber, vc.step(1e-5), vc.Grid((24, 24), (40e-6, 60e-6)), [1.0])
    runs = [
        vc.simulate(body, *arguments, errors=False)
        for body in (topography, surface, indenter_of(topography))
    ]
    assert float(runs[0].approach[-1]) > 0
    for run in runs[1:]:
        np.testing.assert_array_equal(run.pressure, runs[0].pressure)


def test_topography_without_a_unit_or_size_is_refused() -> None:
    topographies = pytest.importorskip("SurfaceTopography")
    bare = topographies.Topography(np.eye(4), (4.0, 4.0))
    with pytest.raises(ValueError, match="has no unit; give unit="):
        surface_of(bare)
    assert surface_of(bare, unit="nm").spacing == (1e-9, 1e-9)
    with pytest.raises(ValueError, match="has the unit 'm' already"):
        surface_of(topographies.Topography(np.eye(4), (4.0, 4.0), unit="m"), unit="nm")
    with pytest.raises(ValueError, match="needs a map or an even line scan"):
        surface_of(np.eye(3))


@pytest.mark.slow
def test_check_states_the_roughness_of_the_surface_and_draws_its_spectrum(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from viscontact.cli import main

    case = tmp_path / "rough.yaml"
    assert main(["example", "rough-ball", "-o", str(case)]) == 0
    (surface,) = read_case(case).surfaces
    assert main(["check", str(case), "--plot"]) == 0
    said = capsys.readouterr().out
    words = f"Sa {1e9 * surface.mean_deviation:.3g} nm"
    assert words in described(surface)
    assert words in " ".join(said.split())
    assert (tmp_path / "rough-spectrum.png").stat().st_size > 5000
