"""Friction over the steps of a run: symmetry, grids that grow, and what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.checks.friction import Grip
from viscontact.simulation.transient.march import March
from viscontact.simulation.transient.setup import prepare_run

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

RUBBER = vc.Material(vc.Zener(1e6, 5e5, 1e6), 0.5)
GRID = vc.Grid((32, 32), (4e-3, 4e-3))
BALL = vc.Sphere(0.01)
SHAKEN = {
    "x": vc.TangentialHistory([0.5, 1, 2], force_x=[0, 0.02, -0.02]),
    "y": vc.TangentialHistory([0.5, 1, 2], displacement_y=[0, 2e-5, -1e-5]),
    "torque": vc.TangentialHistory([0.5, 1, 2], rotation=[0, 2e-2, -1e-2]),
}


PATH = vc.Travel([0, 1], y=[0, 1e-3])
ROLLED = vc.Travel([0, 1], y=[0, 1e-3], rolling=True)
PRESSED = {"indenter": BALL, "material": RUBBER, "load": vc.step(0.1), "grid": GRID}
PRESSED["times"] = [0.0, 1.0]
DRIVEN = vc.Travel([0, 1], y=[0, 1e-3], creepage=0.003)


def march(load, tangential, times, material=RUBBER, grid=GRID, **given):
    return list(
        vc.march(BALL, material, load, grid, times, friction=0.3, tangential=tangential, **given)
    )


@pytest.mark.parametrize("name", SHAKEN)
def test_a_quarter_of_a_symmetric_contact_is_enough(name):
    """The same on cells of which one quarter is computed, and on a grid off the origin."""
    times = [0.5, 1.0, 1.5, 2.0]
    shifted = replace(GRID, centre=(GRID.cell_size[0], 0.0))
    quarter = march(vc.step(0.1), SHAKEN[name], times)[-1]
    whole = march(vc.step(0.1), SHAKEN[name], times, grid=shifted)[-1]
    assert quarter.slip_fraction == close_to(whole.slip_fraction, rel=1e-9)
    scale = quarter.peak_pressure
    for field in ("traction_x", "traction_y"):
        ours, theirs = getattr(quarter, field)[1:], getattr(whole, field)[:-1]
        np.testing.assert_allclose(ours, theirs, atol=1e-4 * scale)
    assert quarter.friction_heat == close_to(whole.friction_heat, rel=1e-4)


def test_a_grid_that_grows_keeps_tractions_and_memory():
    """An automatic grid, of one that holds the contact from the start."""
    problem = Problem(
        BALL,
        RUBBER,
        vc.ForceHistory([0, 0.1, 8], [0, 0.001, 0.3]),
        vc.Grid((16, 16), (0.8e-3, 0.8e-3)),
        vc.uniform_times(8.0, 16),
        friction=vc.Friction(0.3),
        tangential=vc.TangentialHistory([1, 2, 4, 8], force_x=[0, 0.004, 0.002, 0.02]),
    )
    small = prepare_run(problem)
    growing = [state for state in March(_growing(small)) if state is not None]
    wide = growing[-1].grid
    assert wide.shape[0] > 16
    fixed = march(problem.load, problem.tangential, problem.times, grid=wide)
    for name in ("tangential_displacement_x", "friction_heat", "slip_fraction"):
        assert getattr(growing[-1], name) == close_to(getattr(fixed[-1], name), rel=1e-4)


def _growing(run):
    """The run with a grid that is enlarged where the contact reaches its rim."""
    return replace(run, problem=replace(run.problem, grid=None))


def stiffness_along(tangential):
    """Tangential stiffness along x and y, where no symmetry of the grid keeps the ball in place."""
    times, shifted = [0.05, 0.5, 1.0, 2.0], replace(GRID, centre=GRID.cell_size)
    elastic = vc.Material(vc.Elastic(1e6), 0.5)
    states = march(vc.step(0.1), tangential, times, elastic, shifted)
    return (
        [state.tangential_stiffness_x for state in states],
        [state.tangential_stiffness_y for state in states],
    )


def test_a_body_that_only_turns_shows_no_stiffness_along_the_axes():
    assert np.isnan(stiffness_along(vc.TangentialHistory([0, 1], rotation=[0, 1e-2]))).all()


def test_stiffness_is_that_of_a_body_that_moves():
    """NaN across it and at rest; 8 a G / (2 - v), Mindlin (1949), J. Appl. Mech. 16, 259."""
    across, along = stiffness_along(vc.TangentialHistory([0, 1], displacement_y=[0, 2e-5]))
    assert np.isnan([*across, along[-1]]).all()
    # Before slip lowers it by more than 2 %; the radius is Hertz's.
    radius = (3 * 0.1 * 0.01 * (1 - 0.5) / (8 * 1e6)) ** (1 / 3)
    assert along[0] == close_to(8 * radius * 1e6 / 1.5, rel=0.02)
    assert along[:3] == sorted(along[:3], reverse=True)


def test_the_normal_contact_is_that_without_friction():
    with_friction = march(vc.step(0.1), SHAKEN["x"], [0.5, 1.0, 2.0])
    without = list(vc.march(BALL, RUBBER, vc.step(0.1), GRID, [0.5, 1.0, 2.0]))
    # The tangential load has kinks of its own, at which there are steps: the times are the same.
    np.testing.assert_allclose(with_friction[-1].pressure, without[-1].pressure, rtol=1e-4)
    assert without[-1].traction_x is None


def test_bodies_stick_without_traction_until_something_moves_them_along_each_other():
    """And after it: a force that has come and gone leaves tractions (Mindlin 1953)."""
    times = [0.5, 1.0, 1.5, 2.0, 2.5]
    pulled = vc.TangentialHistory([1, 1.5, 2], force_x=[0, 0.02, 0])
    still, also, *_, released, later = march(vc.step(0.1), pulled, times)
    for state in (still, also):
        assert not np.hypot(state.traction_x, state.traction_y).any()
        assert (state.slip_fraction, state.duality_gap) == (0.0, 0.0)
        cells = np.count_nonzero(state.pressure)
        assert state.stick_area == close_to(cells * GRID.cell_area, rel=1e-12)
    for state in (released, later):
        assert np.abs(state.traction_x).max() > 0.01 * state.peak_pressure
        assert state.tangential_force_x == close_to(0.0, abs=1e-9)


def test_coupling_is_chosen_by_itself_where_it_cancels():
    """Bodies of one material, or of c J alike, as of ν = 0.2 and 0.35 with these moduli."""
    given = {"times": [1.0], "tangential": SHAKEN["x"], "load": vc.step(0.1)}
    one = vc.Material(vc.Elastic(1e6), 0.2)
    others = one, vc.Material(vc.Elastic(1e6 * (1 - 2 * 0.35) / (1 - 2 * 0.2)), 0.35)
    for other in others:
        (state,) = march(**given, material=one, indenter_material=other)
        # Pressure as without friction, on a quarter of the cells.
        np.testing.assert_array_equal(state.pressure, state.pressure[::-1])
    (coupled,) = march(**given, material=one)
    assert np.abs(coupled.pressure - coupled.pressure[::-1]).max() > 1e-3 * coupled.peak_pressure


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"friction": 0.3}, "friction needs a tangential load"),
        ({"tangential": SHAKEN["x"]}, "a tangential load needs friction"),
        ({"friction": 0.3, "motion": PATH}, "under friction a body that moves needs a creepage"),
        ({"motion": DRIVEN}, "a creepage needs friction"),
        ({"friction": 0.3, "tangential": SHAKEN["x"], "motion": PATH}, "motion.rolling: a body"),
        (
            {"friction": 0.3, "tangential": SHAKEN["x"], "motion": DRIVEN},
            "the creepage of the motion prescribes the shift",
        ),
        (
            {"friction": 0.3, "tangential": SHAKEN["torque"], "motion": ROLLED},
            "torque and rotation of a body that moves",
        ),
        (
            {"friction": 0.3, "tangential": vc.tangential_ramp(force_x=0.06, duration=1.0)},
            "the body slides away at t = 500 ms: friction carries 30 mN",
        ),
    ],
)
def test_what_cannot_be_computed_is_refused_before_the_first_step(given, said):
    with pytest.raises(ValueError, match=said):
        vc.march(**{**PRESSED, **given})


def test_layers_that_slide_are_refused():
    body = vc.Layered([vc.Layer(1e-3, RUBBER)], "rigid", bonded=False)
    with pytest.raises(ValueError, match=r"material\.bonded: a layer that slides"):
        march(vc.step(0.1), SHAKEN["x"], [1.0], material=body)


def test_layers_that_are_coupled_are_refused_in_motion():
    body = vc.Layered([vc.Layer(1e-3, vc.Material(vc.Elastic(1e6), 0.3))], "rigid")
    with pytest.raises(ValueError, match="which is not supported in the motion over layers"):
        vc.march(**{**PRESSED, "friction": 0.3, "material": body, "motion": DRIVEN})


def test_layers_that_repeat_along_one_axis_only_are_refused():
    body = vc.Layered([vc.Layer(1e-3, RUBBER)], "rigid")
    grid = vc.Grid((8, 40), (1e-3, 6e-3), periodic=(True, False))
    with pytest.raises(ValueError, match=r"grid\.periodic: layers under friction that repeat"):
        vc.march(
            vc.Paraboloid(float("inf"), 0.01),
            body,
            vc.step(0.1),
            grid,
            [0.0, 1.0],
            friction=vc.Friction(0.3, coupling=False),
            tangential=vc.tangential_step(force_y=0.01),
        )


@pytest.mark.parametrize(
    ("tangential", "said"),
    [
        (vc.tangential_step(torque=1e-3), "a body without end does not turn"),
        (vc.tangential_step(displacement_y=1e-6), "has no point at rest"),
    ],
)
def test_a_line_contact_takes_forces_only(tangential, said):
    grid = vc.Grid((1, 40), (1e-3, 6e-3), periodic=(True, False))
    with pytest.raises(ValueError, match=said):
        vc.march(
            vc.Roller(0.01, 1.0),
            RUBBER,
            vc.step(0.1),
            grid,
            [1.0],
            friction=0.3,
            tangential=tangential,
        )


def test_a_body_that_slides_away_under_a_given_approach_ends_the_run():
    tangential = vc.tangential_ramp(force_x=1.0, duration=1.0)
    with pytest.raises(vc.ConvergenceError, match="the body slides away at t = "):
        march(vc.step(approach=1e-5), tangential, [0.0, 0.5, 1.0])


def test_a_force_without_contact_is_refused_with_its_time():
    load = vc.ApproachHistory([0, 1, 1], [1e-5, 1e-5, -1e-5])
    tangential = vc.tangential_step(force_x=1e-5)
    with pytest.raises(vc.ConvergenceError, match=r"the bodies are apart at t = 1 s"):
        march(load, tangential, [0.0, 1.0])


@pytest.mark.parametrize(
    ("tangential", "load", "said"),
    [
        (vc.TangentialHistory([0.5], force_x=0.0299), vc.step(0.1), "within 1 % of what friction"),
        (vc.TangentialHistory([0.5], force_x=4e-3), vc.step(0.1), "cells wide"),
        (
            vc.TangentialHistory([0, 0.4, 1], force_x=[0, 1e-3, 1e-3]),
            vc.ForceHistory([0, 0.4, 1, 1], [0.01, 0.01, 0.01, 0.1]),
            "the contact grows by",
        ),
    ],
)
@pytest.mark.filterwarnings("default::viscontact.AccuracyWarning")
def test_inaccurate_steps_warn_once(tangential, load, said):
    with pytest.warns(vc.AccuracyWarning) as caught:
        march(load, tangential, [0.2, 0.6, 0.8, 1.0])
    assert sum(said in str(each.message) for each in caught) == 1


def test_a_ring_that_is_narrow_only_while_the_force_is_small_is_not_warned_of():
    ramp = vc.TangentialHistory([0.0, 1.0], force_x=[0.0, 0.027])
    fine = vc.Grid((60, 60), GRID.size)
    states = march(vc.step(0.1), ramp, np.linspace(0.1, 1.0, 10), grid=fine)
    assert 0 < states[0].slip_fraction < 0.1
    assert states[-1].slip_fraction > 0.5
    assert not any("cells wide" in text for state in states for text in state.warnings)


def test_ring_of_a_round_contact_and_of_a_line_in_cells():
    assert Grip(0.0, 1.0, 2.0, 314, 314 - 201, 314).ring == close_to(2.0, rel=1e-2)
    assert Grip(0.0, 1.0, 2.0, 100, 40, 100, on_line=True).ring == 20


@pytest.mark.filterwarnings("default::viscontact.AccuracyWarning")
def test_neglected_coupling_warns():
    given = {"friction": vc.Friction(0.3, coupling=False), "tangential": SHAKEN["x"]}
    stiff = vc.Material(vc.Elastic(1e6), 0.3)
    with pytest.warns(vc.AccuracyWarning, match="this is neglected"):
        list(vc.march(BALL, stiff, vc.step(0.1), GRID, [1.0], **given))
