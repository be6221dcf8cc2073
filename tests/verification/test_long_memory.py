"""What a run remembers over many steps: three ways to the same Boltzmann integral.

The recursion and the sum over all steps are exact for a series; a sum of exponentials stands for
any other law where steps are many, within a bound that the plan of the run tells.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from verification.creeping_bodies import BODIES
from verification.indenting import deviation
from verification.pressing import BALL, FORCE, RADIUS, grid_around, over_time
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.time_integration import plan as choice
from viscontact.mechanics.time_integration.boltzmann_sum import BoltzmannSum
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.simulation.transient.setup import prepare_run


@st.composite
def series(draw):
    """Solids and fluids over eight decades of time, some without instant compliance."""
    count = draw(st.integers(0, 4))
    amplitudes = [draw(st.floats(0.01, 10.0)) for _ in range(count)]
    times = [10.0 ** draw(st.floats(-4, 4)) for _ in range(count)]
    fluidity = draw(st.sampled_from([0.0, 0.3]))
    return SeriesCompliance(draw(st.sampled_from([1.0, 0.01])), amplitudes, times, fluidity)


steps = st.lists(
    st.tuples(st.one_of(st.just(0.0), st.floats(-3, 2)), st.floats(-1, 1)), min_size=1, max_size=40
)


@settings(max_examples=60)
@given(law=series(), history=steps, planned=st.booleans())
def test_recursion_and_sum_over_all_steps_agree_to_rounding(law, history, planned):
    """Jumps, ramps of all lengths, values of both signs; with the sums made ahead, and without."""
    lengths = np.array([10.0**power if power else 0.0 for power, _ in history])
    instants = np.cumsum(lengths) if planned else np.zeros(0)
    memories = [InternalVariables(law, (2,)), BoltzmannSum(law, (2,), instants)]
    size = 0.0
    for (_, value), length in zip(history, lengths, strict=True):
        recursive, superposed = (
            memory.ramp(float(length)) if length else memory.jump() for memory in memories
        )
        assert recursive.compliance == close_to(superposed.compliance, rel=1e-12)
        assert recursive.resolved == superposed.resolved
        fields = [response.of(np.array([value, 1.0])) for response in (recursive, superposed)]
        # Each step's part is rounded, and these may be as large as all that has crept.
        size = max(size, law(float(lengths.sum())))
        assert np.abs(fields[0] - fields[1]).max() <= 1e-12 * size
        for memory in memories:
            memory.accept(np.array([value, 1.0]))


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning")  # the same in both
@pytest.mark.parametrize("name", ["fractional_zener", "power_law", "tabulated_creep"])
def test_a_sum_of_exponentials_is_as_good_as_it_says(name, monkeypatch):
    """The same run with room for all steps, and without.

    Measured: 0.1 of the bound in approach and work, 0.4 to 2 times the bound in pressure.
    """
    body, times = BODIES[name], vc.uniform_times(400.0, 160)
    radius = np.cbrt(0.75 * RADIUS * FORCE * body.creep(times[-1:])[0])
    grid = grid_around((radius, radius), (8.3, 8.3), margin=1.2)
    load = vc.triangle(FORCE, 200.0)
    case = (BALL, body.material, load, grid, times)

    def marched():
        plan = prepare_run(Problem(*case)).hereditary
        return plan, list(vc.march(*case, tolerance=1e-10))

    exact, kept = marched()
    assert (exact.error, exact.fields_kept) == (0.0, len(exact.instants))
    monkeypatch.setattr(choice, "MAX_HISTORY_BYTES", 0)
    approximate, summed = marched()
    assert approximate.fields_kept < 60
    assert 0 < approximate.error < 1e-3
    middle = grid.shape[0] // 2
    for of in ("approach", "work"):
        found, truth = (over_time(states, of) for states in (summed, kept))
        assert deviation(found, truth) < approximate.error + 1e-8
    found, truth = (
        np.array([state.pressure[middle, middle] for state in states]) for states in (summed, kept)
    )
    assert deviation(found, truth) < 5 * approximate.error + 1e-8


def test_memory_of_ten_thousand_steps_is_bounded_and_says_so():
    """A plan keeps one field for each exponential, however many steps; they are counted here."""
    body = BODIES["fractional_zener"]
    grid = vc.Grid((256, 256), (1e-3, 1e-3))
    for steps in (3000, 10_000, 100_000):
        times = vc.uniform_times(1000.0, steps)
        plan = prepare_run(Problem(BALL, body.material, vc.step(FORCE), grid, times)).hereditary
        assert plan.fields_kept <= 40
        assert plan.error < 1e-6
        assert str(len(plan.integral((1,)).restart_data()["fields"])) in plan.method


@pytest.mark.slow
def test_the_last_of_four_thousand_steps_does_what_the_first_did():
    """Steady swing of a punch on a fractional solid: loss per cycle by J*, with 128 steps a cycle.

    J* = 1/(4 G (1 + 2 x/(1 + x))), x = sqrt(i omega tau). Measured: 5e-4, of which the polygon
    within the ellipse is 4e-4.
    """
    body, period, cycles = BODIES["fractional_zener"], 10.0, 32
    punch, grid = vc.FlatPunch(5e-3), vc.Grid((16, 16), (11e-3, 11e-3))
    root = np.sqrt(2j * np.pi / period * 100.0)
    compliance = 1 / (4 * 5e8 * (1 + 2 * root / (1 + root)))
    unit = vc.Material(vc.Elastic(2.5e8), 0.5)  # J = 1e-9/Pa
    times = vc.uniform_times(period * cycles, 128 * cycles)
    load = vc.harmonic(10.0, 8.0, period, cycles)
    with pytest.warns(vc.AccuracyWarning, match="end of the indenter's profile"):
        (alike,) = vc.march(punch, unit, vc.step(1.0), grid, [0.0], tolerance=1e-10)
    with pytest.warns(vc.AccuracyWarning, match="end of the indenter's profile"):
        *_, last = vc.march(punch, body.material, load, grid, times)
    loss = np.pi * 64 * -compliance.imag * alike.approach * 1e9
    # What still creeps under the mean is work, too.
    crept = body.creep(times[-1:]) - body.creep(times[-129:-128])
    mean = 100 * float(crept[0]) * alike.approach * 1e9
    assert last.loss_per_cycle == close_to(loss + mean, rel=2e-3)
