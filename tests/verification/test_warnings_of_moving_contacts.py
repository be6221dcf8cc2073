"""Warnings about moving contacts, and what is refused of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.moving_bodies import BODY, J0, J1, LEVEL, TIME, ZENER, travelled
from viscontact.simulation.checks.motion import left_after

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"indenter_material": ZENER}, "rolling=True .* False"),
        ({"motion": vc.Travel([0, 1], y=[0, 9.0])}, "beyond the grid"),
        (
            {
                "indenter": vc.FlatPunch(0.5),
                "indenter_material": ZENER,
                "motion": vc.Travel([0, 1], y=[0, 0.4], rolling=True),
            },
            "no radius of curvature along the motion",
        ),
    ],
)
def test_what_is_not_available_is_refused_by_name(change: dict[str, Any], message: str) -> None:
    given = {"grid": vc.Grid((40, 40), (3.2, 3.2)), "motion": vc.Travel([0, 1], y=[0, 0.4])}
    given = {"indenter": BODY, "material": ZENER, "load": LEVEL} | given | change
    with pytest.raises(ValueError, match=message):
        next(vc.march(**given))


def test_a_jump_of_the_position_is_refused() -> None:
    with pytest.raises(ValueError, match="the position cannot jump"):
        vc.Travel([0.0, 1.0, 1.0], y=[0.0, 1.0, 2.0])


def test_long_steps_are_reported() -> None:
    with pytest.warns(vc.AccuracyWarning, match="move at most"):
        travelled(cells_a_step=5)
    with pytest.warns(vc.AccuracyWarning, match="retardation times that cause 100% of the loss"):
        travelled(speed=1e-3, way=0.4)


def messages(body: vc.Indenter, load: Any, grid: vc.Grid, motion: vc.Motion, **more: Any) -> str:
    """Warnings of the first state of a run."""
    return "; ".join(next(vc.march(body, ZENER, load, grid, motion=motion, **more)).warnings)


@pytest.mark.parametrize(("turns", "warned"), [(0.9, False), (1.1, True)])
def test_material_of_a_roller_that_returns_unrecovered_is_reported(
    turns: float, warned: bool
) -> None:
    radius = 1.0
    way = turns * 2 * np.pi * radius
    grid = vc.Grid((1, 80), (1.0, 10.0), periodic=(True, False), centre=(0.0, way / 2))
    path = vc.Travel([0.0, way / 0.5], y=[0.0, way], rolling=True)
    body, load = vc.Paraboloid(np.inf, radius), vc.step(10.0, tilt_y=0.0)
    found = messages(body, load, grid, path, indenter_material=ZENER)
    assert ("earlier turns are not included" in found) is warned


def test_deflection_left_after_a_turn_is_that_of_a_kelvin_body() -> None:
    """A Kelvin body that is unloaded recovers as the exponential of time over its retardation."""
    turn, load = 3.0, 0.3
    held = J1 * (1 - np.exp(-load / TIME))
    exact = held * np.exp(-turn / TIME) / (J0 + held)
    compliance = vc.Material(vc.CreepSeries(J0, [J1], [TIME]), 0.0).contact_compliance()
    assert left_after(compliance, turn) == close_to(exact, rel=1e-9)


def test_free_tilt_along_the_motion_is_reported_for_a_line_contact_as_well() -> None:
    body, free = vc.Paraboloid(np.inf, 10.0), vc.step(10.0)
    strip = vc.Grid((1, 60), (1.0, 4.0), periodic=(True, False))
    path = vc.Travel([0.0, 1.0], y=[0.0, 0.1])
    assert "tilt_y is free of moment" in messages(body, free, strip, path)
    assert "tilt_x" not in messages(body, free, strip, path)
    held = vc.step(10.0, tilt_y=0.0)
    assert "free of moment" not in messages(body, held, strip, path)


@pytest.mark.parametrize("periodic", [(False, True), (True, False), (False, False), (True, True)])
def test_bodies_that_follow_each_other_are_reported(periodic: tuple[bool, bool]) -> None:
    """The track of the body ahead lowers the friction of one that meets it."""
    grid = vc.Grid((24, 24), (3.2, 3.2), periodic=periodic)
    load = vc.step(10.0, tilt_x=0.0, tilt_y=0.0)
    found = messages(BODY, load, grid, vc.Travel([0.0, 1.0], y=[0.0, 0.1]))
    assert ("meets their tracks" in found) is (periodic == (False, True))


def test_heat_that_is_not_known_has_a_reason() -> None:
    power = vc.Material(vc.PowerLaw(1e-3, 0.3, 1.0, instant=J0), poisson_ratio=0.5)
    grid, path = vc.Grid((24, 24), (4.0, 4.0)), vc.Travel([0.0, 1.0], y=[0.0, 0.1])
    state = next(vc.march(BODY, power, LEVEL, grid, motion=path))
    assert np.isnan(state.heat)
    assert any("dissipation and heat are not known" in text for text in state.warnings)
    assert "heat are not known" not in messages(BODY, LEVEL, grid, path)
