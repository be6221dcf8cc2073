"""Stresses of results in bodies that end."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact import plot
from viscontact.results.peak_stress import peak_stress

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum

#: Half width, load per length and length of the contact of a cylinder with a radius of 10 mm.
HALF_WIDTH, LINE, LENGTH = 0.25231e-3, 10e3, 2e-3


def _cylinder(ratio: float, ends: str = "free", cells: int = 20, **given: Any) -> xr.Dataset:
    """Rigid cylinder on a body of its own length, with two rows beyond each end."""
    rubber = vc.Material(vc.Elastic.from_uniaxial(2e9 * (1 - ratio**2), poisson_ratio=ratio), ratio)
    grid = vc.Grid((cells + 4, 48), (LENGTH * (1 + 4 / cells), 3 * HALF_WIDTH))
    how = {"errors": False, **given}
    return vc.simulate(
        vc.Roller(0.01, LENGTH / 2),
        vc.Body(rubber, LENGTH, ends=ends),
        vc.step(LINE * LENGTH),
        grid,
        [0.0],
        **how,
    )


def _mcewen(peak: float, depth: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Stresses yy and zz below the middle of a line contact (Johnson 1985, eq. 4.46)."""
    over = np.hypot(1.0, depth / HALF_WIDTH)
    along = (1 + 2 * (depth / HALF_WIDTH) ** 2) / over - 2 * depth / HALF_WIDTH
    return -peak * along, -peak / over


@pytest.mark.parametrize("ratio", [0.0, 0.3])
def test_without_poisson_effect_each_slice_is_a_line_contact_up_to_the_end(ratio: float) -> None:
    # Between walls, too, in plane strain for any ratio.
    ds = _cylinder(ratio, "held" if ratio else "free")
    depths = HALF_WIDTH * np.array([0.2, 0.5, 1.0, 2.0])
    exact = vc.reference.hertz_line(LINE, 0.01, 2e9)
    yy, zz = _mcewen(exact.peak_pressure, depths)
    xx = ratio * (yy + zz)
    wanted = np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2)
    for x in (0.0, 0.95e-3, 1e-3):
        found = vc.section_stresses(ds, depths, x=x).isel(time=0).sel(y=0.0, method="nearest")
        assert found.stress_zz.values == close_to(zz, rel=6e-3)
        assert found.von_mises.values == close_to(wanted, rel=6e-3)


def test_von_mises_stress_rises_below_a_free_end_and_the_end_bears_nothing() -> None:
    ds = _cylinder(0.5)
    depths = HALF_WIDTH * np.array([0.1, 0.3, 0.7, 1.5])
    peak = float(ds.peak_pressure[0])
    at_end = vc.section_stresses(ds, depths, x=LENGTH / 2)
    for name in ("stress_xx", "stress_xy", "stress_xz"):
        assert np.abs(at_end[name]).max() < 1e-4 * peak
    along = vc.section_stresses(ds, depths, y=0.0)
    assert np.isnan(along.von_mises.values[..., [0, 1, -2, -1]]).all()
    inside = along.von_mises.values[0, :, 2:-2]
    assert np.isfinite(inside).all()
    assert inside == close_to(inside[:, ::-1], rel=1e-4)
    # The middle of a long incompressible contact has next to no von Mises stress at its surface;
    # the free end is in uniaxial compression there.
    assert inside[0, 0] > 1.3 * inside[0, 10]


def test_steady_motion_has_the_stresses_of_its_pressure() -> None:
    rubber = vc.Material(vc.Zener(1e6, 2e6, 2e6), 0.4)
    body, grid = vc.Body(rubber, 1.6e-3, ends=("free", "held")), vc.Grid((36, 32), (1.8e-3, 1.6e-3))
    load = vc.step(0.02, tilt_x=0.0, tilt_y=0.0)
    rolled = vc.steady(vc.Sphere(0.01), body, load, [1e-4], grid=grid, errors=False)
    found = vc.section_stresses(rolled, [0.1e-3], x=-0.8e-3)
    peak = float(rolled.peak_pressure[0])
    assert np.abs(found.stress_xx).max() < 1e-4 * peak
    wall = vc.section_stresses(rolled, [0.1e-3], x=0.8e-3)
    for name in ("stress_xy", "stress_xz"):  # no friction
        assert np.abs(wall[name]).max() < 1e-5 * peak


def test_a_roller_that_ends_has_stresses_of_its_own() -> None:
    soft, hard = (vc.Material(vc.Elastic(each), 0.3) for each in (1e9, 1e12))
    roller, load = vc.Roller(0.01, 1e-3), vc.step(20.0)
    grid = vc.Grid((24, 32), (2.4e-3, 0.8e-3))
    ds = vc.simulate(
        roller,
        hard,
        load,
        grid,
        [0.0],
        indenter_material=vc.Body(soft, 2e-3),
        errors=False,
    )
    own = vc.section_stresses(ds, [0.1e-3], y=0.0, body="indenter_material")
    assert np.isnan(own.von_mises.values[..., :2]).all()
    track = vc.section_stresses(ds, [0.1e-3], y=0.0)
    assert np.isfinite(track.von_mises.values).all()
    other = vc.section_stresses(ds, [0.1e-3], y=0.0, body="indenter_material", poisson_ratio=0.5)
    assert float(np.abs(other.von_mises - own.von_mises).max()) > 1e-3 * float(own.von_mises.max())


def test_layers_that_end_have_stresses_between_walls_and_are_refused_at_free_ends() -> None:
    rubber = vc.Material(vc.Elastic(1e6), 0.4)
    layers = vc.Layered([vc.Layer(0.5e-3, rubber)], "rigid")
    grid, load = vc.Grid((36, 32), (1.8e-3, 1.6e-3)), vc.step(0.02, tilt_x=0.0)

    def pressed(ends: str) -> xr.Dataset:
        body = vc.Body(layers, 1.6e-3, ends=ends)
        return vc.simulate(vc.Sphere(0.01), body, load, grid, [0.0], errors=False)

    held = pressed("held")
    at_base = vc.interface_stresses(held)
    assert np.isnan(at_base.interface_normal_stress.values[..., :2, :]).all()
    assert float(at_base.largest_interface_compression[0, 0]) > 0
    assert vc.section_stresses(held, y=0.0).von_mises.max() > 0
    with pytest.raises(ValueError, match="layers end at a face free of stress"):
        vc.section_stresses(pressed("free"))


@pytest.mark.parametrize("cells", [20, 21])
def test_the_largest_stress_of_a_body_that_ends_has_an_error(cells: int) -> None:
    ds = _cylinder(0.3, cells=cells, errors=True)
    found = peak_stress(ds, "von_mises")
    # In the middle it is 0.557 of the peak pressure, below the surface (plane strain); an end,
    # under less pressure, is not held along x.
    peak = float(ds.peak_pressure[0])
    assert 0.6 * peak < found.value < 0.9 * peak
    assert found.depth < 0.1 * HALF_WIDTH
    # An odd number of cells between two ends has no pairs.
    if cells % 2:
        assert np.isnan(found.error)
    else:
        assert 0 < found.error < 0.1 * found.value


def test_figures_show_the_stress_within_the_body() -> None:
    ds = _cylinder(0.3)
    assert plot.stress_section(ds).axes
    assert plot.von_mises_history(ds).axes
