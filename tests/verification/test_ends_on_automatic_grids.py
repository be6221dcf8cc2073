"""Bodies that end, on automatic grids: ends at borders of cells, and what they resolve."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from returned import some
from viscontact.bodies.cell_borders import is_border

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

LENGTH, LINE = 4e-3, 10e3
CYLINDER = vc.Roller(10e-3, LENGTH / 2)
RUBBER = vc.Material(vc.Elastic.from_uniaxial(2e9 * 0.75, poisson_ratio=0.5), 0.5)


def _grid_of(ds: xr.Dataset) -> vc.Grid:
    steps = float(ds.x[1] - ds.x[0]), float(ds.y[1] - ds.y[0])
    shape = ds.sizes["x"], ds.sizes["y"]
    middle = float(ds.x.mean()), float(ds.y.mean())
    return vc.Grid(shape, (steps[0] * shape[0], steps[1] * shape[1]), centre=middle)


def _load_within(ds: xr.Dataset, distance: float) -> float:
    """Force on the part of the body up to a distance from its end at +x [N]."""
    step = float(ds.x[1] - ds.x[0])
    inside = np.abs(ds.x.values) < LENGTH / 2
    from_end = np.cumsum(ds.line_load[0].values[inside][::-1]) * step
    edges = step * np.arange(1, inside.sum() + 1)
    return float(np.interp(distance, edges, from_end))


@pytest.mark.parametrize("offset", [0.0, 0.3e-3])
def test_automatic_cells_resolve_the_pressure_near_a_free_end(offset: float) -> None:
    load = vc.step(LINE * LENGTH, eccentricity_x=offset)
    chosen = vc.simulate(CYLINDER, vc.Body(RUBBER, LENGTH), load, times=[0.0])
    grid = _grid_of(chosen)
    assert is_border(grid, -LENGTH / 2)
    assert is_border(grid, LENGTH / 2)
    fine = vc.simulate(
        CYLINDER,
        vc.Body(RUBBER, LENGTH),
        load,
        vc.Grid((204, 64), (LENGTH * 1.02, 0.8e-3)),
        [0.0],
        errors=False,
    )
    # At half a half width, and at one and two, from the end; the tolerance is 1 %.
    for distance in (0.13e-3, 0.25e-3, 0.5e-3):
        near, wanted = _load_within(chosen, distance), _load_within(fine, distance)
        assert near == close_to(wanted, rel=8e-3)
    for name in ("peak_pressure", "contact_area", "peak_line_load"):
        error = abs(float(chosen[name][0] - fine[name][0]))
        assert error < float(chosen[f"{name}_error"][0]) + 1e-3 * float(fine[name][0])
    assert float(chosen.peak_pressure_error[0] / chosen.peak_pressure[0]) < 0.01


@pytest.mark.parametrize(
    ("body", "planes"),
    [
        ({"length": 1.0, "centre": 0.5 - 0.2e-3, "ends": ("free", None)}, (-0.2e-3,)),
        ({"length": 1.0, "centre": 0.2e-3 - 0.5, "ends": (None, "free")}, (0.2e-3,)),
        ({"length": 1.1e-3, "centre": 0.1e-3, "ends": ("held", "free")}, (-0.45e-3, 0.65e-3)),
        ({"length": 20e-3}, (-10e-3, 10e-3)),
    ],
)
def test_automatic_grids_end_cells_where_bodies_end(
    body: dict[str, Any], planes: tuple[float, ...]
) -> None:
    load = vc.step(0.5)
    grid = vc.auto_grid(vc.Sphere(10e-3), vc.Body(RUBBER, **body), load)
    for plane in some(planes):
        assert is_border(grid, plane)
    assert grid.shape[0] * grid.shape[1] < 40_000
    finer = vc.Grid((2 * grid.shape[0], 2 * grid.shape[1]), grid.size, centre=grid.centre)
    one, other = (
        vc.simulate(vc.Sphere(10e-3), vc.Body(RUBBER, **body), load, each, [0.0], errors=False)
        for each in (grid, finer)
    )
    for name in ("peak_pressure", "contact_area"):
        assert float(one[name][0]) == close_to(float(other[name][0]), rel=0.01)


def test_two_bodies_that_end_at_different_places_have_cells_for_both() -> None:
    steel = vc.Body(vc.Material(vc.Elastic(2e9), 0.3), 6.26e-3)
    grid = vc.auto_grid(
        vc.Roller(10e-3, 3.13e-3),
        vc.Body(RUBBER, LENGTH),
        vc.step(LINE * LENGTH),
        indenter_material=steel,
    )
    for plane in some((-3.13e-3, -2e-3, 2e-3, 3.13e-3)):
        assert is_border(grid, plane)
    awkward = vc.Body(vc.Material(vc.Elastic(2e9), 0.3), 4e-3 * np.sqrt(2))
    with pytest.raises(ValueError, match="have borders at all ends"):
        vc.auto_grid(
            vc.Roller(10e-3, 2e-3 * np.sqrt(2)),
            vc.Body(RUBBER, LENGTH),
            vc.step(LINE * LENGTH),
            indenter_material=awkward,
        )


def test_an_endless_cylinder_on_a_body_of_finite_length_is_a_long_roller() -> None:
    load = vc.step(LINE * LENGTH)
    endless, roller = (
        vc.simulate(each, vc.Body(RUBBER, LENGTH), load, times=[0.0], errors=False)
        for each in (vc.Paraboloid(np.inf, 10e-3), vc.Roller(10e-3, 3e-3))
    )
    assert float(endless.peak_pressure[0]) == close_to(float(roller.peak_pressure[0]), rel=2e-3)


def test_automatic_grids_hold_a_body_that_rolls_along_its_ends() -> None:
    law = vc.Zener(700e6, 700e6, 7e9)
    body = vc.Body(vc.Material(law, 0.4), LENGTH)
    load = vc.step(LINE * LENGTH, tilt_y=0.0)
    steady = vc.steady(CYLINDER, body, load, [1e-5, 4e-5])
    travel = vc.Travel([0.0, 20.0], y=[0.0, 0.8e-3])
    travelled = vc.simulate(CYLINDER, body, load, motion=travel)
    for ds in (steady, travelled):
        grid = _grid_of(ds)
        assert is_border(grid, -LENGTH / 2)
        assert is_border(grid, LENGTH / 2)
        bars = ds.resistance_y_error.values[1:] / ds.resistance_y.values[1:]
        assert (bars < 0.05).all()
    assert float(travelled.resistance_y[-1]) == close_to(float(steady.resistance_y[1]), rel=0.1)


def test_a_program_finds_its_events_on_a_body_that_ends() -> None:
    body = vc.Body(RUBBER, 1.0, centre=0.5 - 0.2e-3, ends=("free", None))
    program = vc.LoadProgram(["move at 1 um/s until force reaches 0.5 N", "hold height for 1 s"])
    found = vc.simulate(vc.Sphere(10e-3), body, program, times=np.linspace(0.0, 100.0, 21))
    assert float(found.force.max()) == close_to(0.5, rel=1e-3)
    assert is_border(_grid_of(found), -0.2e-3)
