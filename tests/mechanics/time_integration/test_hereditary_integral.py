"""The recursion against Boltzmann's integral, written out for each law and history."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from verification.independent import superposed
from viscontact.bodies.materials.compliance import LawCompliance, SeriesCompliance
from viscontact.laws import PowerLaw
from viscontact.mechanics.time_integration.boltzmann_sum import BoltzmannSum
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.mechanics.time_integration.prony_approximation import as_exponentials

ELASTIC = SeriesCompliance(2.0, (), ())
KELVIN = SeriesCompliance(2.0, [1.5], [3.0])
FLUID = SeriesCompliance(2.0, (), (), 0.7)
WIDE = SeriesCompliance(2.0, [0.3, 0.5, 1.1], [1e-5, 1.0, 1e6], 0.01)


def follow(compliance, times, values, *, jump=True):
    """Displacements at the instants, for a field that takes the values there."""
    memory, displacements = InternalVariables(compliance, (1,)), []
    before = 0.0
    for i, (time, value) in enumerate(zip(times, values, strict=True)):
        response = memory.jump() if (i == 0 and jump) else memory.ramp(time - before)
        field = np.array([float(value)])
        displacements.append(float((response.history + response.compliance * field)[0]))
        memory.accept(field)
        before = time
    return np.array(displacements)


def uneven(end, seed=2, steps=12):
    """Instants to `end`, in steps whose lengths are up to a thousand apart."""
    lengths = 10.0 ** np.random.default_rng(seed).uniform(-3, 0, steps)
    return np.concatenate([[0.0], np.cumsum(lengths) * end / lengths.sum()])


@pytest.mark.parametrize("law", [ELASTIC, KELVIN, FLUID, WIDE])
def test_under_a_held_value_the_displacement_is_the_creep_compliance(law):
    times = uneven(40.0)
    # Exact; rounding only, as in all of the following.
    assert follow(law, times, np.ones(13)) == close_to(law(times), rel=1e-13)


def test_a_ramp_then_held_follows_the_integral_for_each_term():
    # u(t) of a unit ramp over T: elastic J0 s, Kelvin J1 (s - tau (1 - exp(-s/tau))) - the same
    # from T on, fluid phi s²/2 - ..., each over T; integrals of J done by hand.
    end, times = 4.0, np.unique(np.concatenate([uneven(4.0), uneven(9.0, seed=5)]))

    def kelvin(s):
        return np.where(s > 0, 1.5 * (s - 3 * (1 - np.exp(-np.maximum(s, 0) / 3))), 0.0)

    def fluid(s):
        return np.where(s > 0, 0.7 * s**2 / 2, 0.0)

    values, held = np.minimum(times / end, 1.0), 2 * np.minimum(times / end, 1.0)
    for law, integral in ((KELVIN, kelvin), (FLUID, fluid)):
        expected = held + (integral(times) - integral(times - end)) / end
        assert follow(law, times, values) == close_to(expected, rel=1e-12)


def test_every_history_is_the_superposition_of_its_steps():
    values = np.random.default_rng(8).standard_normal(13)
    times = uneven(3.0)
    expected = [superposed(WIDE, times[: i + 1], values[: i + 1]) for i in range(13)]
    assert follow(WIDE, times, values) == close_to(expected, rel=1e-12)


def test_a_jump_meets_the_instant_compliance_only():
    memory = InternalVariables(KELVIN, (1,))
    memory.jump()
    memory.accept(np.array([1.0]))
    memory.ramp(5.0)
    memory.accept(np.array([1.0]))
    response = memory.jump()
    # Held 5 s, then taken away at once: what is left is the delayed part.
    assert response.compliance == 2.0
    assert response.history[0] == close_to(1.5 * (1 - np.exp(-5 / 3)), rel=1e-14)
    memory.accept(np.array([0.0]))
    later = memory.ramp(7.0)
    fading = 1.5 * (1 - np.exp(-5 / 3)) * np.exp(-7 / 3)
    assert later.history[0] == close_to(fading, rel=1e-13)


@given(st.floats(1e-6, 1.0), st.floats(0.01, 0.99), st.floats(-1, 1), st.floats(-1, 1))
def test_splitting_a_step_in_two_changes_nothing(length, part, start, end):
    middle = start + part * (end - start)
    one = follow(KELVIN, [0.0, length], [start, end])[-1]
    two = follow(KELVIN, [0.0, part * length, length], [start, middle, end])[-1]
    assert two == close_to(one, rel=1e-12, abs=1e-14)


def test_smooth_histories_converge_with_the_square_of_the_step():
    # q = sin t on a Kelvin body: tau d' + d = J1 sin t has a closed solution.
    tau, end = 3.0, 5.0
    delayed = (np.sin(end) - tau * np.cos(end) + tau * np.exp(-end / tau)) / (1 + tau**2)
    exact = 2 * np.sin(end) + 1.5 * delayed
    errors = []
    for steps in (16, 32, 64, 128):
        times = np.linspace(0.0, end, steps + 1)
        errors.append(abs(follow(KELVIN, times, np.sin(times))[-1] - exact))
    rates = np.log2(np.divide(errors[:-1], errors[1:]))
    assert rates == close_to(2.0, abs=0.02)
    assert errors[-1] < 1e-4


@pytest.mark.parametrize("ratio", 10.0 ** np.arange(-15.0, 0.0, 2.0))
def test_a_step_tiny_against_the_law_is_taken_to_rounding(ratio):
    # The mean of J over a ramp of length h: J0 + J1 h/(2 tau) (1 - h/(3 tau) + ...).
    h = 3.0 * ratio
    response = InternalVariables(KELVIN, (1,)).ramp(h)
    series = 1.5 * ratio / 2 * (1 - ratio / 3 * (1 - ratio / 4 * (1 - ratio / 5 * (1 - ratio / 6))))
    assert response.compliance - 2.0 == close_to(series, rel=1e-4 * ratio**4, abs=5e-16)


@pytest.mark.parametrize("law", [KELVIN, SeriesCompliance(0.1, [5.0, 9.0], [1e-6, 1e-3])])
@pytest.mark.parametrize("length", [1e3, 1e9])
def test_a_step_huge_against_the_law_neither_overflows_nor_rings(law, length):
    # A constant displacement asked for over long steps, as a contact does.
    memory, values = InternalVariables(law, (1,)), []
    for i in range(8):
        response = memory.jump() if i == 0 else memory.ramp(length)
        value = (1.0 - response.history) / response.compliance
        memory.accept(value)
        values.append(float(value[0]))
    assert np.isfinite(values).all()
    changes = np.abs(np.diff(values))
    # What error is left in a value is at least halved by each step.
    assert (changes[1:] <= 0.5 * changes[:-1] + 1e-14).all()
    assert 0 <= values[-1] < values[0]


@pytest.mark.parametrize("exponent", [0.2, 0.35, 0.5])
def test_equation_of_the_first_kind_is_solved_to_second_order(exponent):
    # J = t^n, q = t²: u = Γ(1+n) Γ(3)/Γ(3+n) t^(2+n). Abel's equation by the trapezoidal rule.
    n, errors = exponent, []
    for steps in (20, 40, 80):
        times = np.linspace(0.0, 1.0, steps + 1)
        wanted = math.gamma(1 + n) * 2 / math.gamma(3 + n) * times ** (2 + n)
        found = solved(LawCompliance(PowerLaw(1.0, n, 1.0), 1.0), times, wanted)
        errors.append(np.abs(found - times**2)[steps // 2 :].max())
    rates = np.log2(np.divide(errors[:-1], errors[1:]))
    assert rates == close_to(2.0, abs=0.1)
    assert errors[-1] < 1e-4


@pytest.mark.parametrize("exponent", [0.2, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("growth", [1.0, 1.2, 0.9])
def test_without_instant_compliance_a_wrong_value_is_forgotten(exponent, growth):
    # A first value that the displacement, zero, does not ask for: what follows it dies out.
    times = np.append(0.0, np.cumsum(growth ** np.arange(30.0)))
    compliance = LawCompliance(PowerLaw(1.0, exponent, 1.0), 1.0)
    memory, values = BoltzmannSum(compliance, (1,), times), []
    memory.jump()
    memory.accept(np.zeros(1))
    for duration in np.diff(times):
        response = memory.ramp(duration)
        values.append(-response.history / response.compliance if values else np.ones(1))
        memory.accept(values[-1])
    # What has crept meanwhile is pulled back at first: by 1.6 for a dashpot.
    found = np.abs(values)[1:, 0]
    assert found[0] < 1.7
    assert (found[1:] <= 0.55 * found[0]).all()
    assert (found[10:] < 0.02).all()


@pytest.mark.parametrize("delayed", [0.0, 1.0, 10.0])
def test_a_resolved_step_after_a_jump_errs_by_less_than_two_percent(delayed):
    # Maxwell, M = exp(-t); Zener with J1 = delayed, M = (1 + J1 exp(-(1 + J1) t))/(1 + J1).
    law = SeriesCompliance(1.0, [delayed], [1.0], fluidity=0.0 if delayed else 1.0)
    for memory in (InternalVariables(law, (1,)), BoltzmannSum(law, (1,))):
        resolved = {}
        for length in np.geomspace(1e-3, 10.0, 400):
            memory = type(memory)(law, (1,))
            memory.jump()
            memory.accept(np.ones(1))
            response = memory.ramp(length)
            left = float((1.0 - response.history[0]) / response.compliance)
            fast = (1 + delayed) * length if delayed else length
            exact = (1 + delayed * math.exp(-fast)) / (1 + delayed) if delayed else math.exp(-fast)
            resolved[length] = (response.resolved, abs(left - exact))
        longest = max(length for length, (short, _) in resolved.items() if short)
        assert law(longest) - 1.0 == close_to(0.5, rel=0.03)
        assert max(error for short, error in resolved.values() if short) < 0.02
        assert max(error for _, error in resolved.values()) > 0.05


@pytest.mark.parametrize("length", np.geomspace(0.01, 1e3, 26))
def test_a_held_displacement_relaxes_in_one_step_of_any_length(length):
    # Maxwell, J = 1 + t, M = exp(-t); Zener of M(0)/M(inf) = 11: M = (1 + 10 exp(-11 t/100))/11.
    laws = [
        (SeriesCompliance(1.0, (), (), 1.0), math.exp(-length)),
        (SeriesCompliance(1.0, [10.0], [100.0]), (1 + 10 * math.exp(-11 * length / 100)) / 11),
    ]
    for law, exact in laws:
        memory = InternalVariables(law, (1,))
        memory.jump()
        memory.accept(np.ones(1))  # and so the displacement is J(0) = 1
        response = memory.ramp(length)
        left = float((1.0 - response.history[0]) / response.compliance)
        assert left == close_to(exact, abs=0.08)
        assert left > 0  # a body that is held down is never let go


def solved(compliance, times, wanted):
    """Values whose displacements are those wanted, step by step from rest."""
    memory, values = BoltzmannSum(compliance, (1,), times), [0.0]
    memory.jump()
    memory.accept(np.zeros(1))
    for duration, displacement in zip(np.diff(times), wanted[1:], strict=True):
        response = memory.ramp(duration)
        value = (displacement - response.history) / response.compliance
        memory.accept(value)
        values.append(float(value[0]))
    return np.array(values)


def displaced(memory, fields, durations):
    """Displacements after a jump to the first field and smooth ramps to the others."""
    found = []
    for field, duration in zip(fields, durations, strict=True):
        response = memory.ramp(duration, smooth=True) if duration else memory.jump()
        found.append(response.history + response.compliance * field)
        memory.accept(field)
    return np.array(found)


def test_a_field_grown_on_the_way_goes_on_as_one_that_was_as_large_from_the_beginning():
    # A law that creeps far more than it gives at once, so that the trend of a step is continued.
    law, planned = LawCompliance(PowerLaw(1.0, 0.4, 1.0, 0.01), 1.0), np.arange(7.0)
    durations = np.append(0.0, np.diff(planned))
    fields = np.sqrt(1 + planned)[:, None] * np.array([1.0, 2.0])
    grown = np.pad(fields, ((0, 0), (1, 1)))
    small, large = BoltzmannSum(law, (2,), planned), BoltzmannSum(law, (4,), planned)
    displaced(small, fields[:4], durations[:4])
    small.map_fields(lambda field: np.pad(field, [(0, 0)] * (field.ndim - 1) + [(1, 1)]))
    found = displaced(small, grown[4:], durations[4:])
    whole = displaced(large, grown, durations)
    np.testing.assert_allclose(found, whole[4:], rtol=1e-13)


def test_a_sum_resumed_after_a_jump_goes_on_to_the_same_bits():
    law = LawCompliance(PowerLaw(1.0, 0.4, 1.0, 0.01), 1.0)
    memory, resumed = BoltzmannSum(law, (1,)), BoltzmannSum(law, (1,))
    memory.jump()
    memory.accept(np.ones(1))
    resumed.restore(memory.restart_data())
    one, other = memory.ramp(50.0), resumed.ramp(50.0)
    assert (one.history[0], one.compliance) == (other.history[0], other.compliance)
    assert (one.resolved, one.held) == (other.resolved, other.held)


@pytest.mark.parametrize("kind", [InternalVariables, BoltzmannSum])
def test_what_is_taken_into_the_memory_is_a_copy(kind):
    memory, field = kind(KELVIN, (1,)), np.array([1.0])
    memory.jump()
    memory.accept(field)
    field[0] = 99.0
    unchanged = kind(KELVIN, (1,))
    unchanged.jump()
    unchanged.accept(np.array([1.0]))
    # What a held 1 has crept in 2 s, and the ramp down to 0 leaves of it: less than J(2).
    assert memory.ramp(2.0).history[0] == unchanged.ramp(2.0).history[0] < KELVIN(2.0)


@pytest.mark.parametrize("exponent", [0.1, 0.3, 0.5])  # above, a step is a rise and a hold
@pytest.mark.parametrize("instant", [0.0, 1.0])
def test_exponentials_follow_even_ramps_of_a_power_within_the_error_they_state(exponent, instant):
    # The first step of an even run meets the mean of J from 0 to its end, before any value of J
    # that can be fitted there: of t^n it is 1/(n + 1) of the value, by hand.
    step, steps = 0.1, 50
    law = LawCompliance(PowerLaw(1.0, exponent, 1.0, instant), 1.0)
    series, error = as_exponentials(law, step, step * steps)
    t = step * np.arange(1, steps + 1)
    displacements = follow(series, np.append(0.0, t), np.append(0.0, t))[1:]
    exact = instant * t + t ** (exponent + 1) / (exponent + 1)
    # The error is looked for at so many times that little is missed in between.
    assert np.abs(displacements / exact - 1).max() <= 1.05 * error
    assert error < 1e-6  # what the fit takes for good enough
