"""Stresses below a pressure that repeats along one axis, against plane strain and direct sums.

Johnson: K. L. Johnson, Contact Mechanics, Cambridge (1985).
"""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.layered_stress import LayeredStress
from viscontact.mechanics.halfspace.periodic_stress import periodic_stress_coefficients
from viscontact.mechanics.halfspace.stress import Stress, stress_on_section
from viscontact.mechanics.halfspace.stress_response import HalfSpaceStress, StressResponse

COVER = ElasticStack((ElasticLayer(0.2, 1.0, 0.45),), ElasticBase(5.0, 0.3))
ALONG, POISSON = (True, False), 0.3
FloatArray = np.ndarray


def cylinder(y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Stresses yy, zz, yz under a line contact of half width and peak 1: Johnson, eqs. 4.49.

    McEwen 1949, Phil. Mag. 40, 454.
    """
    square = 1 - y**2 + z**2
    root = np.hypot(square, 2 * y * z)
    m, n = np.sqrt((root + square) / 2), np.sign(y) * np.sqrt((root - square) / 2)
    share = (z**2 + n**2) / (m**2 + n**2)
    yz = -n * (m**2 - z**2) / (m**2 + n**2)
    return -(m * (1 + share) - 2 * z), -m * (1 - share), yz


def below_cylinder(shape: tuple[int, int], depths: FloatArray, **where: float) -> Stress:
    grid = Grid(shape, (0.7, 2.2), periodic=ALONG)
    half = grid.cell_size[1] / 2
    ends = np.clip([grid.y - half, grid.y + half], -1, 1)
    integral = (ends * np.sqrt(1 - ends**2) + np.arcsin(ends)) / 2
    mean = np.diff(integral, axis=0)[0] / (2 * half)
    return stress_on_section(np.tile(mean, (shape[0], 1)), grid, depths, POISSON, **where)


@pytest.mark.parametrize("along", [1, 5])
def test_stresses_under_a_cylinder_are_mcewens_with_second_order(along: int) -> None:
    depths = np.array([0.5, 0.786, 1.5, 4.0])
    errors = []
    for cells in (21, 41, 81):
        stress = below_cylinder((along, cells), depths, x=0.1)
        y = Grid((4, cells), (1.0, 2.2)).y
        exact = cylinder(y[None, :], depths[:, None])
        errors.append(
            max(
                np.abs(stress[name] - each).max()
                for name, each in zip(("yy", "zz", "yz"), exact, strict=True)
            )
        )
        # Plane strain along the cylinder, nothing sheared along it, up to the error of the sum.
        assert stress["xx"] == close_to(POISSON * (stress["yy"] + stress["zz"]), abs=1e-5)
        assert np.abs(stress["xy"]).max() < 1e-6
        assert np.abs(stress["xz"]).max() < 1e-6
    assert errors[2] < 2e-4
    assert errors[0] / errors[2] > 4**1.8


def test_section_along_a_cylinder_is_uniform() -> None:
    depths = np.array([0.3, 1.0])
    stress = below_cylinder((6, 41), depths, y=0.5)
    exact = cylinder(np.array(0.5), depths)
    for name, each in zip(("yy", "zz", "yz"), exact, strict=True):
        assert stress[name] == close_to(np.tile(each[:, None], 6), abs=1e-3)
        assert np.ptp(stress[name], axis=1).max() < 1e-9


@pytest.mark.parametrize("where", [{"y": 0.1}, {"x": 0.21}, {"x": 0.21 + 3 * 1.5}])
@pytest.mark.parametrize(("cells", "width"), [((6, 8), 2.0), ((5, 8), 0.3)])
def test_row_is_the_sum_of_many_images(
    cells: tuple[int, int], width: float, where: dict[str, float]
) -> None:
    """The images left out of a row of 2 n + 1 leave an error of 1/n², or of 1/n from xx and yy."""
    grid, depths = Grid(cells, (1.5, width), periodic=ALONG), [0.0, 0.05, 0.4]
    pressure = np.random.default_rng(0).random(cells)
    found = stress_on_section(pressure, grid, depths, POISSON, **where).components

    def direct(images: int) -> FloatArray:
        row = 2 * images + 1
        finite = Grid((row * cells[0], cells[1]), (row * 1.5, width))
        at = {"x": 0.21} if "x" in where else where
        all_along = np.tile(pressure, (row, 1))
        components = stress_on_section(all_along, finite, depths, POISSON, **at).components
        middle = slice(images * cells[0], (images + 1) * cells[0])
        return components[:, :, middle] if "y" in where else components

    # Richardson: the remainder is a series in 1/(2 n + 1).
    one, two, four = direct(8), direct(25), direct(76)  # rows of 17, 51 and 153
    first, second = (3 * two - one) / 2, (3 * four - two) / 2
    limit = (9 * second - first) / 8
    assert np.abs(found - limit).max() < 1e-5


def test_period_along_y_is_a_period_along_x_turned() -> None:
    pressure, depths = np.random.default_rng(1).random((5, 7)), [0.1, 0.9]
    one = stress_on_section(pressure, Grid((5, 7), (1.0, 2.0), ALONG), depths, 0.2, y=0.05)
    turned = Grid((7, 5), (2.0, 1.0), periodic=(False, True))
    other = stress_on_section(pressure.T, turned, depths, 0.2, x=0.05)
    for name, swapped in (("xx", "yy"), ("yy", "xx"), ("zz", "zz"), ("xz", "yz"), ("xy", "xy")):
        assert one[name] == close_to(other[swapped], rel=1e-12, abs=1e-14)


def test_waves_along_a_wide_band_have_the_stresses_of_waves() -> None:
    """In the middle of a band of many wavelengths: Johnson, section 13.2, by both periods."""
    cells, depths = (12, 60), [0.2, 0.4]
    pressure = np.tile(np.cos(2 * np.pi * np.arange(12) / 12)[:, None], (1, 60))
    size = (1.0, 10.0)
    band = stress_on_section(pressure, Grid(cells, size, ALONG), depths, POISSON, y=0.0)
    whole = stress_on_section(pressure, Grid(cells, size, periodic=True), depths, POISSON, y=0.0)
    # A cell's mean of a wave is smaller by sinc(1/12), and its harmonics have decayed.
    mean = np.sinc(1 / 12)
    assert band["zz"] == close_to(mean * whole["zz"], abs=1e-5)
    assert band["xz"] == close_to(mean * whole["xz"], abs=1e-5)


@pytest.mark.parametrize(
    "depth",
    [1e-5, pytest.param(0.03, marks=pytest.mark.slow), pytest.param(2.0, marks=pytest.mark.slow)],
)
@pytest.mark.parametrize("body", [HalfSpaceStress(0.3), LayeredStress(COVER)])
def test_images_between_points_are_those_of_single_places(
    body: StressResponse, depth: float
) -> None:
    """All places are interpolated, single ones are not. Measured: 2e-16, on layers 2e-14."""
    cells, edge = 120, 0.01
    y_edges = (np.arange(90) - 0.3) * 0.006
    first = -cells // 2 * edge
    whole = periodic_stress_coefficients(first, cells, edge, y_edges, depth, body)
    for place in (0, 7, 60, 119):
        for line in (0, 3, 88):
            at = first + place * edge
            own = y_edges[line : line + 2]
            one = periodic_stress_coefficients(at, cells, edge, own, depth, body, places=1)
            assert whole[:, place, line] == close_to(one[:, 0, 0], abs=1e-13)
