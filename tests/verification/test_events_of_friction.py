"""Conditions of load programs on friction, against Cattaneo and Mindlin."""

import numpy as np
import pytest
from scipy.optimize import brentq

import viscontact as vc
from closeness import close_to

RADIUS, FORCE, COEFFICIENT = 0.01, 1.0, 0.3
BODY = vc.Material(vc.Elastic(1e6), poisson_ratio=0.0)
COMPLIANCE = 1 / 2e6  # (1 - ν)/(2 G)
#: Pulled from 1 s on, by half of what friction carries in a second.
PULL = vc.TangentialHistory([0, 1, 3], force_x=[0.0, 0.0, COEFFICIENT * FORCE])
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def run(sentences: str, *, cells: int = 26, errors: bool = False, **changed):
    edge = (0.75 * FORCE * RADIUS * COMPLIANCE) ** (1 / 3)
    given = {
        "friction": vc.Friction(COEFFICIENT, coupling=False),
        "tangential": PULL,
        "errors": errors,
        "fields": "none",
    }
    return vc.simulate(
        vc.Paraboloid(RADIUS, RADIUS),
        BODY,
        vc.LoadProgram(f"load at {FORCE} N/s for 1 s; {sentences}"),
        vc.Grid((cells, cells), (2.6 * edge, 2.6 * edge)),
        np.linspace(0, 3, 13),
        **(given | changed),
    )


def events_of(ds):
    return [float(each.split(" s: ")[0]) for each in ds.attrs["events"].split("; ")]


def shift(force: float) -> float:
    found = vc.reference.cattaneo_mindlin(FORCE, RADIUS, 1 / COMPLIANCE, force, COEFFICIENT)
    return float(found.displacement)


def test_a_shift_is_reached_when_cattaneo_and_mindlin_have_it():
    most = COEFFICIENT * FORCE
    wanted = shift(0.6 * most)
    exact = 1 + 2 * brentq(lambda part: shift(part * most) - wanted, 0.1, 0.9)
    program = f"hold force for 2 s; stop when tangential_displacement_x reaches {wanted} m"
    ds = run(program, cells=14, errors=True)
    assert ds.tangential_displacement_x[-1] == close_to(wanted, rel=1e-6)
    assert float(ds.time[-1]) == close_to(exact, rel=3e-3)
    (bar,) = np.atleast_1d(ds.attrs["event_time_errors"])
    assert abs(float(ds.time[-1]) - exact) < bar < 0.05
    assert float(ds.slip_fraction_error[-1]) < 0.2


def test_a_body_that_is_unloaded_slips_altogether_when_friction_carries_the_force_no_longer():
    held = vc.TangentialHistory([0, 1, 1.5], force_x=[0.0, 0.0, 0.15 * FORCE])
    ds = run(
        "hold force for 0.5 s; unload at 0.5 N/s until the whole contact slips", tangential=held
    )
    # Q = μ W at half of the force; the last cell slips before.
    assert float(ds.time[-1]) == close_to(2.5, rel=5e-3)
    assert float(ds.time[-1]) <= 2.5
    assert "the whole contact slips" in ds.attrs["events"]


@pytest.mark.slow
def test_coupled_bodies_slip_altogether_when_friction_carries_the_force_no_longer():
    """Of a rigid sphere on a body of ν = 0, whose pressure feels the tractions."""
    held = vc.TangentialHistory([0, 1, 1.5], force_x=[0.0, 0.0, 0.15 * FORCE])
    program = "hold force for 0.5 s; unload at 0.5 N/s until the whole contact slips"
    ds = run(program, cells=14, tangential=held, friction=COEFFICIENT)
    # Q = μ W at half of the force; the last cell slips before.
    assert float(ds.time[-1]) == close_to(2.5, rel=2e-2)
    assert float(ds.time[-1]) <= 2.5


def test_a_slip_fraction_is_reached_within_a_cell_of_the_ring():
    ds = run("hold force for 2 s; stop when slip_fraction reaches 0.5")
    # 1 - (c/a)² with c/a = (1 - Q/(μ W))^(1/3).
    assert float(ds.time[-1]) == close_to(1 + 2 * (1 - 0.5**1.5), abs=0.1)
    assert float(ds.slip_fraction[-1]) >= 0.5


def test_a_shifted_body_slips_altogether():
    moved = vc.TangentialHistory([0, 1, 3], displacement_x=[0.0, 0.0, 3 * shift(0.29)])
    ds = run("hold force until the whole contact slips", tangential=moved)
    assert float(ds.slip_fraction[-1]) == 1.0
    assert float(ds.tangential_force_x[-1]) == close_to(COEFFICIENT * FORCE, rel=5e-3)


@pytest.mark.parametrize(
    ("sentences", "changed", "why"),
    [
        (
            "hold force until slip_fraction reaches 0.5",
            {"friction": None, "tangential": None},
            "'slip_fraction reaches 0.5' needs friction",
        ),
        (
            "hold force until the whole contact slips",
            {"tangential": vc.tangential_ramp(force_x=0.1, duration=2.0)},
            "this does not happen .*, slip_fraction comes closest",
        ),
    ],
)
def test_conditions_that_are_not_met_are_refused(sentences, changed, why):
    with pytest.raises(ValueError, match=why):
        run(sentences, **changed)


def test_a_share_of_slip_is_a_number():
    with pytest.raises(ValueError, match="slip_fraction is a number from 0 to 1"):
        vc.LoadProgram("hold force until slip_fraction reaches 50 %")
