"""Steps that are long against the law: the trend they continue, order and stability."""

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.mechanics.time_integration.boltzmann_sum import BoltzmannSum
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.mechanics.time_integration.step_shape import Trend, step_shape

FLUID = SeriesCompliance(1.0, (), (), 1.0)
#: M(0)/M(inf) = 10 000.
SOFT = SeriesCompliance(1.0, [9999.0], [9999.0])


def solved(memory, times, wanted, *, smooth=True):
    """Values whose displacements are those wanted, the first after a jump."""
    values = []
    for i, displacement in enumerate(wanted):
        duration = times[i] - times[i - 1]
        response = memory.ramp(duration, smooth=smooth and i > 1) if i else memory.jump()
        values.append((displacement - response.history) / response.compliance)
        memory.accept(values[-1])
    return np.array(values)[:, 0]


@pytest.mark.parametrize("kind", [InternalVariables, BoltzmannSum])
def test_slow_change_of_a_fluid_is_followed_to_second_order_and_else_to_first(kind):
    # J = 1 + t under q = 1 + (t/T)² has u = (1 + t) + (t² + t³/3)/T².
    last = 1e5
    errors = {True: [], False: []}
    for smooth, found in errors.items():
        for steps in (20, 40, 80, 160):
            times = np.linspace(0.0, last, steps + 1)
            wanted = 1 + times + (times**2 + times**3 / 3) / last**2
            values = solved(kind(FLUID, (1,)), times, wanted, smooth=smooth)
            found.append(np.abs(values - 1 - (times / last) ** 2)[-5:].max())
    orders = {smooth: np.log2(np.divide(each[:-1], each[1:])) for smooth, each in errors.items()}
    assert orders[True] == close_to(2.0, abs=0.1)
    assert orders[False] == close_to(1.0, abs=0.1)
    # Backward differences of two steps miss h² q''/3.
    assert errors[True][-1] == close_to((last / 160) ** 2 / 3 * 2 / last**2, rel=0.1)


@pytest.mark.parametrize("law", [FLUID, SOFT, SeriesCompliance(1.0, [9.0, 90.0], [9.0, 9e3])])
@pytest.mark.parametrize("growth", [1.0, 1.2, 1.5, 2.0, 10.0])
@pytest.mark.parametrize("first", [0.1, 1.0, 3.0, 20.0])
def test_held_displacement_is_never_let_go_by_steps_of_any_length(law, growth, first):
    times = np.append(0.0, np.cumsum(first * growth ** np.arange(12.0)))
    memory = InternalVariables(law, (1,))
    values = solved(memory, times, np.ones(13))
    assert values.min() > -1e-12
    assert (values <= values[0]).all()


@pytest.mark.parametrize("law", [FLUID, SOFT])
def test_sum_and_recursion_take_the_same_steps(law):
    times = np.append(0.0, np.geomspace(0.1, 1e4, 40))
    wanted = law(times) ** (2 / 3)  # the approach of a sphere under a held force
    one, other = (
        solved(kind(law, (1,)), times, wanted) for kind in (InternalVariables, BoltzmannSum)
    )
    np.testing.assert_allclose(one, other, rtol=1e-9)


@pytest.mark.parametrize("kind", [InternalVariables, BoltzmannSum])
def test_continued_integral_keeps_the_trend(kind):
    law, times = SOFT, np.append(0.0, np.geomspace(0.1, 1e4, 40))
    wanted = law(times) ** (2 / 3)
    begun = kind(law, (1,))
    solved(begun, times[:30], wanted[:30])
    resumed = kind(law, (1,))
    resumed.restore(begun.restart_data())
    responses = [each.ramp(times[30] - times[29], smooth=True) for each in (begun, resumed)]
    assert responses[0].trended > 0.5
    assert responses[0].history == responses[1].history


def test_trend_is_not_continued_after_a_kink_or_into_a_much_longer_step():
    trend = Trend(np.ones(1), age=10.0)
    assert step_shape(FLUID, 30.0, trend=trend).trended > 0.9
    assert step_shape(FLUID, 300.0, trend=trend).held > 0.9
    assert step_shape(FLUID, 30.0).held > 0.9
    # A short step is linear in any case, and so has no trend.
    assert step_shape(FLUID, 1.0, trend=trend).slow == 0
    assert step_shape(FLUID, 1.0).trend(np.ones(1), None) is None
