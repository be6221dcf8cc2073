"""A run that is stopped after any of its steps and gone on with ends in the same bits."""

from __future__ import annotations

import io
import math
from dataclasses import fields

import numpy as np
import pytest

import viscontact as vc
from returned import some
from viscontact.mechanics.problem.kept_fields import KeptFields
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import FIELD_NAMES, Outcome
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.runs.directory.npz_archive import read_plain, write_plain
from viscontact.simulation.transient.march import March
from viscontact.simulation.transient.setup import RunSetup, prepare_run

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

GRID = vc.Grid((36, 24), (3e-3, 2e-3))
SMALL = vc.Grid((16, 16), (2e-3, 2e-3))  # for runs of many steps
ZENER = vc.Material(vc.Zener(1e6, 5e5, 1e6), 0.5)
POWER = vc.Material(vc.PowerLaw(2e-7, 0.3, 1.0, instant=3e-7), 0.4)
UP_AND_DOWN = vc.ForceHistory([0, 1, 2, 2, 3, 4, 5], [0, 0.2, 0.2, 0.05, 0, 0, 0.1])


def rough() -> vc.Indenter:
    axis = np.linspace(-2e-3, 2e-3, 30)
    height = 2e-6 * np.random.default_rng(3).standard_normal((30, 30))
    return vc.HeightMap(axis, axis, height) + vc.Sphere(0.02)


def roller() -> vc.Roller:
    return vc.Roller(4e-3, 0.8e-3, 0.01)


WARMED = vc.Arrhenius(293.15, 80e3)

RUNS = {
    "series law, up, jump, away and back": lambda: prepare_run(
        Problem(vc.Sphere(0.01), ZENER, UP_AND_DOWN, GRID, vc.uniform_times(5.0, 9))
    ),
    "power law, eccentric roller": lambda: prepare_run(
        Problem(
            roller(), POWER, vc.ramp(0.1, 1.0, eccentricity_x=1e-4), GRID, vc.uniform_times(2.0, 20)
        )
    ),
    "rough, off both axes": lambda: prepare_run(
        Problem(
            rough(),
            ZENER,
            vc.step(0.02, eccentricity_x=5e-5, eccentricity_y=2e-5),
            GRID,
            vc.log_times(0.01, 3.0, 7),
        )
    ),
    "adaptive swing": lambda: prepare_run(
        Problem(
            vc.Sphere(0.01),
            ZENER,
            vc.harmonic(0.1, 0.06, 2.0, 1),
            SMALL,
            vc.adaptive_times(2.2, 0.1),
        )
    ),
    "adaptive power law in a soft start": lambda: prepare_run(
        Problem(
            vc.Sphere(0.01),
            POWER,
            vc.ramp(0.1, 1.0),
            GRID,
            vc.adaptive_times(3.0, 0.1),
            kept=KeptFields([2.0]),
        )
    ),
    "stage, contact lost": lambda: prepare_run(
        Problem(
            vc.Sphere(0.01),
            ZENER,
            vc.ApproachHistory([0, 1, 1.3, 3], [0, 2e-5, 0, 1.6e-5]),
            GRID,
            vc.uniform_times(3.0, 15),
        )
    ),
    "cycles of a triangle": lambda: prepare_run(
        Problem(
            vc.Sphere(0.01),
            ZENER,
            vc.ForceHistory(np.arange(7.0), [0, 0.1, 0, 0.1, 0, 0.1, 0]),
            GRID,
            vc.uniform_times(6.0, 18),
        )
    ),
    "warmed, with two clocks": lambda: prepare_run(
        Problem(
            vc.Sphere(0.01),
            vc.Material(ZENER.law, 0.5, shift=vc.WLF(293.15, 8.86, 101.6)),
            vc.ramp(0.02, 1.0),
            GRID,
            vc.uniform_times(5.0, 9),
            vc.Material(POWER.law, 0.4, ageing=vc.Ageing(2.0, 0.8), shift=WARMED),
            temperature=vc.TemperatureHistory([0.0, 3.0, 5.0], [293.15, 313.15, 303.15]),
        )
    ),
    "fretting with a load that varies": lambda: prepare_run(
        Problem(
            vc.Sphere(0.01),
            ZENER,
            UP_AND_DOWN,
            GRID,
            vc.uniform_times(5.0, 9),
            friction=vc.Friction(0.4),
            tangential=vc.TangentialHistory(
                [0, 0.8, 1.6, 2.4, 3, 4, 5],
                force_x=[0, 0.03, -0.03, 0, 0, 0, 0.02],
                rotation=[0, 1e-3, 0, 0, 0, 0, 1e-3],
            ),
        )
    ),
    "shifts under a power law": lambda: prepare_run(
        Problem(
            vc.Sphere(0.01),
            POWER,
            vc.ramp(0.1, 1.0),
            SMALL,
            vc.uniform_times(2.0, 10),
            friction=vc.Friction(0.3, coupling=False),
            tangential=vc.tangential_ramp(displacement_y=2e-5, duration=2.0),
        )
    ),
    "bodies that creep differently, coupled by friction": lambda: prepare_run(
        Problem(
            vc.Sphere(0.01),
            vc.Material(ZENER.law, bulk_modulus=3e6),
            vc.ForceHistory([0, 1, 2, 3], [0.1, 0.2, 0.0, 0.1]),
            vc.Grid((12, 12), (6e-3, 6e-3)),
            vc.uniform_times(3.0, 8),
            vc.Material(POWER.law, 0.2),
            friction=vc.Friction(0.4),
            tangential=vc.TangentialHistory([0, 1, 2, 3], force_x=[0, 0.03, 0, 0.02]),
        )
    ),
    "coupled body that rolls and creeps": lambda: prepare_run(
        Problem(
            vc.Paraboloid(0.01, 0.01),
            vc.Material(ZENER.law, 0.2),
            vc.step(0.05, tilt_x=0.0, tilt_y=0.0),
            vc.Grid((12, 20), (2.4e-3, 4e-3), centre=(0.0, 8e-4)),
            vc.uniform_times(4.0, 8),
            friction=vc.Friction(0.3),
            motion=vc.Travel([0, 4], y=[0.0, 1.6e-3], rolling=True, creepage=0.01),
        )
    ),
    "moving punch that is lifted": lambda: prepare_run(
        Problem(
            vc.FlatPunch(3e-4),
            ZENER,
            vc.ForceHistory([0, 2, 2.5, 4], [0.1, 0.1, 0, 0], tilt_x=0.0, tilt_y=0.0),
            SMALL,
            vc.uniform_times(4.0, 8),
            motion=vc.Travel([0, 1, 4], y=[0.0, 4e-4, 4.4e-4]),
        )
    ),
}


def same(one: object, other: object) -> bool:
    """Equal to the last bit, NaN included."""
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return one.dtype == other.dtype and one.tobytes() == other.tobytes()
    if isinstance(one, float) and isinstance(other, float) and math.isnan(one):
        return math.isnan(other)
    return one == other


def through_a_file(restart_data: RestartData) -> RestartData:
    file = io.BytesIO()
    write_plain(file, restart_data)
    return read_plain(file)


def leaves(value: object, where: str = "") -> dict[str, object]:
    """Plain data as a flat dict of numbers, texts and the bytes of arrays."""
    if isinstance(value, dict):
        inner = [leaves(each, f"{where}.{key}") for key, each in value.items()]
    elif isinstance(value, list):
        inner = [leaves(each, f"{where}[{number}]") for number, each in enumerate(value)]
    else:
        return {where: value.tobytes() if isinstance(value, np.ndarray) else repr(value)}
    return {place: leaf for each in inner for place, leaf in each.items()}


def steps_of(march: March) -> list[tuple[vc.ContactState | None, int, int]]:
    """Take the remaining steps: state, number of states done and left."""
    return [(state, march.done, march.left) for state in march]


def differing(
    ours: list[tuple[vc.ContactState | None, int, int]],
    theirs: list[tuple[vc.ContactState | None, int, int]],
) -> list[str]:
    """Differences between two ends of one run."""
    found = []
    assert len(ours) == len(theirs)
    for (one, *counts), (other, *other_counts) in zip(ours, theirs, strict=True):
        assert (one is None) == (other is None)
        assert counts == other_counts
        if one is None or other is None:
            continue
        names = [field.name for field in fields(vc.ContactState)]
        found += [
            f"{name} at t = {one.time:g}"
            for name in names
            if not same(getattr(one, name), getattr(other, name))
        ]
    return found


#: Of hundreds of steps; another one chooses its steps, and another has cycles.
LONG = "adaptive swing"


@pytest.fixture(
    params=[pytest.param(name, marks=pytest.mark.slow) if name == LONG else name for name in RUNS],
    scope="module",
)
def run(request: pytest.FixtureRequest) -> RunSetup:
    return RUNS[request.param]()


def test_run_continues_from_restart_data_after_any_step(run: RunSetup) -> None:
    whole = steps_of(March(run))
    assert len(whole) > 7
    march = March(run)
    every = max(1, len(whole) // 3)  # a swing has hundreds
    for count, _ in enumerate(march, 1):
        if count < 3 or count % every == 0:
            resumed = steps_of(March(run, through_a_file(march.restart_data())))
            assert differing(whole[count:], resumed) == []


def test_a_resumed_run_issues_the_warnings_of_the_whole_one() -> None:
    """Of long steps and of an end of the body in contact before: with the last state."""
    march = March(RUNS["moving punch that is lifted"]())
    for _, _ in zip(march, range(6), strict=False):
        restart_data = through_a_file(march.restart_data())
    *_, last = March(RUNS["moving punch that is lifted"](), restart_data)
    assert last is not None
    assert not last.in_contact.any()
    for text in (
        "for an error of the resistance of 1 % move at most",
        "reaches an end of the body",
    ):
        assert any(text in each for each in last.warnings)


def test_what_was_carried_is_what_is_carried_on(run: RunSetup) -> None:
    # Some of it counts only in runs that are rare, such as those with long steps after a jump.
    march = March(run)
    for _, _ in some(zip(march, range(8), strict=False)):
        restart_data = through_a_file(march.restart_data())
        assert leaves(March(run, restart_data).restart_data()) == leaves(restart_data)


@pytest.mark.parametrize("name", ["series law, up, jump, away and back", "rough, off both axes"])
def test_states_mark_the_cells_that_touch(name: str) -> None:
    run = RUNS[name]()
    for state in some(each for each in March(run) if each is not None):
        # Within the tolerance of the solver, closed cells are those in contact.
        closed = 2 * run.problem.tolerance * state.displacement.max()
        assert state.in_contact.dtype == bool
        assert not state.in_contact.flags.writeable  # shared with the run, which goes on from it
        assert (state.gap[state.in_contact] <= closed).all()
        assert (state.pressure[~state.in_contact] == 0).all()
        assert state.in_contact.any() == (state.outcome is Outcome.CONVERGED)
        assert state.without_fields().in_contact.size == 0
        own = state.with_own_fields()
        for field in FIELD_NAMES:
            assert getattr(own, field).base is None
            np.testing.assert_array_equal(getattr(own, field), getattr(state, field))


def test_no_contact_carries_more_than_its_largest_pressure_times_its_area() -> None:
    """At the beginning of a ramp there are four cells, which enclose next to no area."""
    steel, grid = vc.Material(vc.Elastic(1e9), 0.3), vc.Grid((16, 16), (2.6e-3, 2.6e-3))
    states = list(vc.march(vc.Sphere(0.01), steel, vc.ramp(50.0, 1.0), grid, [1e-4, 1e-2, 1.0]))
    assert states[0].cells_across == 2
    for state in states:
        assert state.contact_area * state.peak_pressure >= state.force * (1 - 1e-12)


def test_peak_before_the_first_instant_that_is_wanted_is_not_missed() -> None:
    """Only a peak between two instants of the run counts as missed, not one before the first."""
    rubber, grid = vc.Material(vc.Zener(1e9, 1e10, 1e9), 0.3), vc.Grid((24, 24), (2.6e-3, 2.6e-3))
    missed = []
    for force, first in (([90.0, 40.0, 40.0], 1.0), ([40.0, 90.0, 40.0], 0.0)):
        load = vc.ForceHistory([0.0, 0.5, 1.0], force)
        run = prepare_run(Problem(vc.Sphere(0.01), rubber, load, grid, [first, 2.0]))
        *_, last = March(run)
        missed.append("between the requested times" in " ".join(last.warnings))
    assert missed == [False, True]
