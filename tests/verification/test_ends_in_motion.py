"""Bodies that end, rolled over along y: line contacts, limits of speed, motion over time."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

LENGTH = 4e-3
LAW = vc.Zener(700e6, 700e6, 7e9)  # retardation time 10 s
CYLINDER = vc.Paraboloid(1e6, 10e-3)  # to a picometre over the length
LOAD = vc.step(40.0, tilt_y=0.0)


def _steady(body: Any, speed: float, shape: tuple[int, int] = (20, 128), **how: Any) -> xr.Dataset:
    grid = vc.Grid(shape, (LENGTH * shape[0] / (shape[0] - 4), 1.28e-3))
    return vc.steady(CYLINDER, body, LOAD, speed, grid=grid, **how)


@pytest.mark.parametrize("speed", [1e-5, 4e-5, 1e-3])
def test_without_poisson_effect_rolling_between_two_free_ends_is_a_line_contact(
    speed: float,
) -> None:
    # Nothing acts along x: each slice is in plane strain and in plane stress at once.
    rubber = vc.Material(LAW, 0.0)
    found = _steady(vc.Body(rubber, LENGTH), speed, errors=False)
    line = vc.steady(
        vc.Paraboloid(np.inf, 10e-3),
        rubber,
        LOAD,
        speed,
        grid=vc.Grid((1, 128), (LENGTH, 1.28e-3), periodic=(True, False)),
        errors=False,
    )
    assert found.line_load[0].values[2:-2] == close_to(np.full(16, 10e3), rel=2e-6)
    assert float(found.resistance_y[0]) == close_to(float(line.resistance_y[0]), rel=3e-6)
    peak = float(line.peak_pressure[0])
    whole = np.broadcast_to(line.pressure[0], (16, 128))
    assert found.pressure[0].values[2:-2] == close_to(whole, abs=1e-4 * peak)
    assert np.isnan(found.approach[0])
    assert found.attrs["ends_error"] < 1e-4


@pytest.mark.parametrize("speed", [1e-5, 3e-3, 0.3])
def test_a_roller_that_creeps_and_ends_is_without_poisson_effect_that_of_a_line_contact(
    speed: float,
) -> None:
    # Its material returns after 63 mm, before and after which it forgets the contact.
    rubber, steel = vc.Material(LAW, 0.0), vc.Material(vc.Elastic(1e15), 0.3)
    how: dict[str, Any] = {"rolling": True, "errors": False}
    found = _steady(steel, speed, indenter_material=vc.Body(rubber, LENGTH), **how)
    line = vc.steady(
        *(vc.Paraboloid(np.inf, 10e-3), steel, LOAD, speed),
        grid=vc.Grid((1, 128), (LENGTH, 1.28e-3), periodic=(True, False)),
        indenter_material=rubber,
        **how,
    )
    assert found.line_load[0].values[2:-2] == close_to(np.full(16, 10e3), rel=1e-5)
    assert float(found.resistance_y[0]) == close_to(float(line.resistance_y[0]), rel=1e-4)
    # What is left of earlier turns holds the fastest one: a track without memory of them resists.
    track = _steady(vc.Body(rubber, LENGTH), speed, errors=False)
    forgets = speed < 1e-4
    ratio = float(found.resistance_y[0] / track.resistance_y[0])
    assert ratio == close_to(1.0, rel=1e-6) if forgets else ratio < 0.95


def test_roller_and_track_that_end_exchange_their_parts_where_nothing_is_left_of_a_turn() -> None:
    creeping, steel = vc.Body(vc.Material(LAW, 0.4), LENGTH), vc.Material(vc.Elastic(1e15), 0.3)
    of_track = _steady(creeping, 1e-5, (28, 64), rolling=True, indenter_material=steel)
    of_roller = _steady(steel, 1e-5, (28, 64), rolling=True, indenter_material=creeping)
    for name in ("resistance_y", "peak_pressure", "contact_area", "peak_line_load"):
        assert float(of_roller[name][0]) == close_to(float(of_track[name][0]), rel=1e-6)
    assert of_roller.attrs["ends_error"] == of_track.attrs["ends_error"] > 0
    layers = vc.Layered([vc.Layer(1e-3, vc.Material(LAW, 0.4))], "rigid")
    covers = [
        _steady(*bodies, rolling=True, indenter_material=mate, errors=False)
        for bodies, mate in (
            ((vc.Body(layers, LENGTH), 1e-5, (28, 64)), steel),
            ((steel, 1e-5, (28, 64)), vc.Body(layers, LENGTH)),
        )
    ]
    one, other = (float(ds.resistance_y[0]) for ds in covers)
    assert one == close_to(other, rel=1e-6)


def test_slow_rolling_is_that_on_a_relaxed_body_and_fast_rolling_on_a_fresh_one() -> None:
    body = vc.Body(vc.Material(LAW, 0.4), LENGTH)
    rolled = vc.steady(
        CYLINDER,
        body,
        LOAD,
        [1e-9, 1e3],
        grid=vc.Grid((20, 64), (LENGTH * 1.25, 1.28e-3)),
        errors=False,
    )
    for index, modulus in ((0, 350e6), (1, 700e6)):
        elastic = vc.Body(vc.Material(vc.Elastic(modulus), 0.4), LENGTH)
        grid = vc.Grid((20, 64), (LENGTH * 1.25, 1.28e-3))
        rest = vc.simulate(CYLINDER, elastic, LOAD, grid, [0.0], errors=False)
        for name, rel in (("peak_pressure", 2e-5), ("contact_area", 1e-3)):
            assert float(rolled[name][index]) == close_to(float(rest[name][0]), rel=rel)
        line_loads = (ds.line_load.values[0 if ds is rest else index] for ds in (rolled, rest))
        assert next(line_loads) == close_to(next(line_loads), rel=2e-5)
        assert abs(float(rolled.friction_coefficient[index])) < 1e-6


def test_rolling_over_time_becomes_steady() -> None:
    # One end is free, the other far away; the way is long against the retardation length of 0.1 mm.
    body = vc.Body(vc.Material(LAW, 0.4), LENGTH, ends=("free", None))
    load, speed, way = vc.step(40.0, tilt_x=0.0, tilt_y=0.0), 1e-5, 1.2e-3
    roller = vc.Roller(10e-3, 2e-3)
    travelled = vc.simulate(
        roller,
        body,
        load,
        vc.Grid((22, 100), (LENGTH * 1.1, 2.5e-3)),
        np.linspace(0.0, way / speed, 97),
        motion=vc.Travel([0.0, way / speed], y=[-way / 2, way / 2]),
        errors=False,
    )
    grid = vc.Grid((22, 52), (LENGTH * 1.1, 1.3e-3))
    steady = vc.steady(roller, body, load, speed, grid=grid)
    for name, rel in (
        ("resistance_y", 2e-2),
        ("approach", 2e-3),
        ("eccentricity_x", 5e-3),
        ("contact_area", 2e-2),
    ):
        assert float(travelled[name][-1]) == close_to(float(steady[name][0]), rel=rel)
    line_loads = travelled.line_load[-1].values, steady.line_load[0].values
    assert line_loads[0] == close_to(line_loads[1], rel=5e-3, abs=1.0)
    # The end carries less than the middle, the other one more.
    assert line_loads[1][1] < 0.8 * line_loads[1][11] < line_loads[1][-2]


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"along": "x"}, "material.ends: the motion is along x"),
        ({"material": vc.Maxwell(700e6, 7e9), "grid": None}, "material: the material flows"),
        ({"material": vc.Maxwell(700e6, 7e9)}, "material: the material flows"),
        ({"tilt_x": 0.0, "eccentricity": 1e-4}, "load.tilt_x: .* bends as a plate"),
        (
            {"friction": vc.Friction(0.3, coupling=False), "creepage": 0.01, "rolling": True},
            "friction is not available",
        ),
    ],
)
def test_what_is_not_available_in_steady_motion_is_refused(
    changes: dict[str, Any], why: str
) -> None:
    body = vc.Body(vc.Material(changes.pop("material", LAW), 0.4), LENGTH)
    offset, tilt = changes.pop("eccentricity", 0.0), changes.pop("tilt_x", None)
    load = vc.step(40.0, tilt_x=tilt, tilt_y=0.0)
    indenter = CYLINDER if not offset else vc.Roller(10e-3, 2e-3, crown_radius=1.0)
    grid = vc.Grid((20, 64), (LENGTH * 1.25, 1.28e-3), centre=(LENGTH / 16 * (offset > 0), 0.0))
    with pytest.raises(ValueError, match=why):
        vc.steady(indenter, body, load, 1e-5, **{"grid": grid, **changes})


def test_the_error_bar_of_steady_rolling_covers_a_finer_grid() -> None:
    body = vc.Body(vc.Material(LAW, 0.4), LENGTH)
    coarse = _steady(body, 4e-5, (28, 64))
    fine = _steady(body, 4e-5, (52, 128), errors=False)
    for name in ("resistance_y", "peak_pressure", "contact_area", "peak_line_load"):
        assert abs(float(fine[name][0] - coarse[name][0])) < float(coarse[f"{name}_error"][0])
