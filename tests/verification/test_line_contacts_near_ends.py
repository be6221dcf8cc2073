"""Line contacts, and those that repeat along y, on bodies that end along x."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.backend.arrays import Floats
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.meshing.elastic_estimate import estimate_period
from viscontact.simulation.transient.setup import prepare_run

#: Length of a strip, and force on its period [m, N].
LENGTH, PERIOD, FORCE = 2e-3, 1e-3, 100.0
STEEL = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
BESIDE_END = ("free", None)

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum


def _wide_punch(cells: int, **load: float) -> tuple[Floats, Floats]:
    """Pressure over its mean under a rigid punch that is wider than a strip, and places [m]."""
    beyond = cells // 10
    grid = vc.Grid((cells + 2 * beyond, 1), (1.2 * LENGTH, PERIOD), periodic=(False, True))
    found = vc.simulate(
        vc.FlatPunch(half_length=LENGTH, half_width=1.0),
        vc.Body(STEEL, LENGTH),
        vc.step(FORCE, **load),
        grid,
        [0.0],
        tolerance=1e-7,
        errors=False,
    )
    inside = slice(beyond, -beyond)
    return found.pressure[0].values[inside, 0] * LENGTH * PERIOD / FORCE, grid.x[inside]


@pytest.mark.parametrize("cells", [20, 160])
def test_a_punch_as_wide_as_a_strip_compresses_it_as_a_column(cells: int) -> None:
    # Its end stays plane under a uniform pressure. On a half-space the pressure at the edges of the
    # punch has no limit.
    assert _wide_punch(cells)[0] == close_to(np.ones(cells), rel=1e-6)


def test_a_punch_that_is_pressed_beside_the_middle_bends_a_strip_as_a_beam() -> None:
    eccentricity, found = 0.1e-3, []
    for cells in (20, 40, 80, 160):
        pressure, x = _wide_punch(cells, eccentricity_x=eccentricity)
        navier = 1 + 12 * eccentricity * x / LENGTH**2
        found.append(float(np.abs(pressure - navier).mean()))
    # Samples of the linear pressure have the slope of its mean over cells.
    assert found[-1] < 1e-5
    orders = np.log2(np.divide(found[:-1], found[1:]))
    assert (orders > 1.8).all()


def _beside_end(
    cells: int, distance: float, ratio: float = 0.3, body: Any = None, **how: Any
) -> xr.Dataset:
    """Cylinder pressed at a distance from a free end, its contact about 67 µm wide."""
    grid = vc.Grid((cells, 1), (160e-6, PERIOD), periodic=(False, True)) if cells else None
    compliance = (1 - 0.3**2) / 2.6
    law = vc.Elastic(80e9 * (1 - ratio) / 2 / compliance)
    own = vc.Material(law, ratio) if body is None else body
    ended = vc.Body(own, 1.0, centre=0.5 - distance, ends=BESIDE_END)
    # An automatic grid has a period of a metre.
    load = vc.step(20e3 * (PERIOD if cells else 1.0), tilt_x=0.0)
    how.setdefault("times", [0.0])
    return vc.simulate(vc.Paraboloid(0.01, np.inf), ended, load, grid, **how)


def test_pressure_beside_the_end_of_a_quarter_plane_does_not_depend_on_poissons_ratio() -> None:
    # Michell's theorem: stress in a plane body under given loads does not, and the displacement of
    # its surface only by (1 - ν)/G.
    one, other = (_beside_end(64, 40e-6, ratio, errors=False) for ratio in (0.0, 0.45))
    assert one.pressure.values == close_to(other.pressure.values, rel=1e-5, abs=1e3)
    middle = (one.pressure[0, :, 0] * one.x).sum() / one.pressure.sum()
    assert middle > 10e-6  # the body is softer towards its end, and tilt is prevented


def test_far_from_its_end_a_body_is_pressed_as_a_half_space() -> None:
    line = vc.simulate(
        vc.Paraboloid(0.01, np.inf),
        STEEL,
        vc.step(20e3 * PERIOD, tilt_x=0.0),
        vc.Grid((64, 1), (160e-6, PERIOD), periodic=(False, True)),
        [0.0],
        errors=False,
    )
    peak = float(line.pressure.max())
    apart = []
    for distance in (1e-3, 4e-3, 16e-3):
        near = _beside_end(64, distance, errors=False)
        apart.append(float(np.abs(near.pressure.values - line.pressure.values).max() / peak))
    # The slope of what the end adds falls as the inverse distance, and prevents no contact.
    assert apart[0] > 3 * apart[1] > 9 * apart[2]
    assert apart[2] < 1e-2


def test_error_bars_beside_an_end_hold_on_finer_cells() -> None:
    coarse, fine = _beside_end(64, 40e-6), _beside_end(512, 40e-6, errors=False)
    for name in ("peak_pressure", "strip_width"):
        missed = abs(float(coarse[name][0]) - float(fine[name][0]))
        assert missed < float(coarse[f"{name}_error"][0]) < 0.1 * float(fine[name][0])
    assert 0 < coarse.attrs["ends_error"] < 1e-9
    assert np.isnan(coarse.approach[0])


@pytest.mark.parametrize("distance", [10e-6, 40e-6, 1e-3])
def test_automatic_grids_of_line_contacts_end_cells_at_the_end(distance: float) -> None:
    # Over the end, beside it and far from it: the contact is 67 µm wide.
    chosen = _beside_end(0, distance)
    border = (chosen.x.values[0] + distance) / np.diff(chosen.x.values[:2])[0] - 0.5
    assert border == close_to(round(border), abs=1e-5)
    cells = 1024 if distance < 1e-3 else 1000  # of which whole ones lie between contact and end
    fine = _beside_end(cells, distance, errors=False)
    for name in ("peak_pressure", "strip_width"):
        missed = abs(float(chosen[name][0]) - float(fine[name][0]))
        assert missed < float(chosen[f"{name}_error"][0]) < 0.02 * float(fine[name][0])


def test_an_automatic_grid_holds_a_contact_over_the_whole_of_a_strip() -> None:
    # A flat cylinder on a narrow strip is a punch that is wider than the strip: nearly a column.
    strip, load = vc.Body(STEEL, 20e-6), vc.step(20e3)
    found = vc.simulate(vc.Paraboloid(10.0, np.inf), strip, load, None, [0.0])
    assert float(found.strip_width[0]) == close_to(20e-6, rel=1e-9)
    inside = found.pressure.values[found.pressure.values > 0]
    assert inside == close_to(np.full(inside.shape, 1e9), rel=1e-3)


def test_a_line_contact_that_creeps_beside_an_end_begins_and_ends_as_elastic_ones() -> None:
    law = vc.Zener(80e9, 160e9, 160e9)
    times = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 20.0, 60.0]
    creeping = _beside_end(64, 40e-6, body=vc.Material(law, 0.3), times=times, errors=False)
    for index, modulus in ((0, 80e9), (-1, 0.5 / float(law(1e9)))):
        material = vc.Material(vc.Elastic(modulus), 0.3)
        elastic = _beside_end(64, 40e-6, body=material, errors=False)
        for name in ("peak_pressure", "strip_width"):
            assert float(creeping[name][index]) == close_to(float(elastic[name][0]), rel=2e-5)


def test_a_cylinder_along_a_strip_is_a_line_contact_without_poissons_effect() -> None:
    # Nothing acts along x: the waves along y of a body between its ends are those of a plane.
    rubber, cells = vc.Material(vc.Elastic(80e9), 0.0), 32
    cylinder, load = vc.Paraboloid(np.inf, 1.0), vc.step(20.0)
    ended = vc.simulate(
        cylinder,
        vc.Body(rubber, PERIOD),
        load,
        vc.Grid((cells + 4, cells), (PERIOD * (1 + 4 / cells), PERIOD), periodic=(False, True)),
        [0.0],
        tolerance=1e-7,
        errors=False,
    )
    grid = vc.Grid((1, cells), (PERIOD, PERIOD), periodic=(True, True))
    line = vc.simulate(cylinder, rubber, load, grid, [0.0], tolerance=1e-7, errors=False)
    pressure = ended.pressure[0].values[2:-2]
    expected = np.broadcast_to(line.pressure[0].values, pressure.shape)
    assert pressure == close_to(expected, rel=1e-5, abs=1e-5 * expected.max())
    assert 0 < ended.attrs["ends_error"] < 1e-4


def test_a_row_of_spheres_between_walls_is_a_grid_with_two_periods() -> None:
    rubber, load = vc.Material(vc.Elastic(1e6), poisson_ratio=0.4), vc.step(0.02, tilt_x=0.0)
    held = vc.simulate(
        vc.Sphere(0.01),
        vc.Body(rubber, 2e-3, ends="held"),
        load,
        vc.Grid((36, 32), (2.4e-3, 2e-3), periodic=(False, True)),
        [0.0],
        tolerance=1e-8,
        errors=False,
    )
    both = vc.Grid((30, 32), (2e-3, 2e-3), periodic=(True, True))
    rows = vc.simulate(
        vc.Sphere(0.01), rubber, vc.step(0.02), both, [0.0], tolerance=1e-8, errors=False
    )
    assert held.pressure[0].values[3:33] == close_to(rows.pressure[0].values, rel=1e-6, abs=1e-2)


def test_what_to_expect_is_estimated_with_the_ends() -> None:
    # On more cells than an estimate takes of a period, as the end must be a border of cells.
    grid = vc.Grid((330, 1), (2.2e-3, PERIOD), periodic=(False, True))
    own = Problem(
        vc.Paraboloid(0.01, np.inf),
        vc.Body(STEEL, LENGTH * 10, centre=LENGTH * 5 - 0.4e-3, ends=BESIDE_END),
        vc.step(2e6 * PERIOD),
        grid,
        times=np.array([0.0]),
    )
    run = prepare_run(own)
    compliance, point = own.compliance(0.0), own.load.at(0.0)
    response = own.surface.response_at(0.0)
    found = estimate_period(own.cut_indenter, compliance, point, run.grid, response=response)
    computed = vc.simulate(own.indenter, own.material, own.load, grid, [0.0], errors=False)
    assert found.peak_pressure == close_to(float(computed.peak_pressure[0]), rel=1e-3)


CYLINDER, LINE_GRID = vc.Paraboloid(0.01, np.inf), vc.Grid((72, 1), (2.4e-3, 1e-3), (False, True))


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"grid": vc.Grid((72, 8), (2.4e-3, 1e-3), (True, True))}, "grid.periodic: must be false"),
        ({"motion": vc.Travel([0.0, 1.0], y=[0.0, 1e-4])}, "repeats along y cannot move"),
        ({"load": vc.step(approach=1e-6)}, "has no datum"),
        ({"load": vc.step(1.0, tilt_x=1e-4)}, "load.tilt_x: .* bends as a plate"),
        (
            {"grid": vc.Grid((72, 4), (2.4e-3, 0.1), (False, True))},
            "grid.size: a period along y .* at most 78.5 mm long",
        ),
        (
            {"material": vc.Body(vc.Layered([vc.Layer(1e-3, STEEL)], "rigid"), LENGTH)},
            "layers that end are not available",
        ),
    ],
)
def test_what_line_contacts_near_ends_are_not_available_for_is_refused(
    changes: dict[str, Any], why: str
) -> None:
    given = {"material": vc.Body(STEEL, LENGTH), "load": vc.step(1.0), "grid": LINE_GRID}
    given |= {"times": [0.0, 1.0], **changes}
    with pytest.raises(ValueError, match=why):
        vc.simulate(CYLINDER, **given)


def test_stresses_below_line_contacts_near_ends_are_refused() -> None:
    found = vc.simulate(
        CYLINDER, vc.Body(STEEL, LENGTH), vc.step(1e3), LINE_GRID, [0.0], errors=False
    )
    with pytest.raises(ValueError, match="under a contact that repeats along y"):
        vc.section_stresses(found)
