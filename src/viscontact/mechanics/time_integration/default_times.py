"""Times of a run for which none are given: adaptive steps of a contact of one cell.

The displacement of the cell is prescribed: the approach or, under a force, that of Hertz's sphere
on a body that only grows into contact, which is the power 2/3 of S = ∫ J dF (Lee & Radok 1960, J.
Appl. Mech. 27, 438). Its unit displacement q, with J * dq equal to that displacement, shows how
short the steps must be after each kink of the load, whatever the body's shape and the grid.
"""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.clock import TIME
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.mechanics.time_integration.adaptive_steps import AdaptiveSteps
from viscontact.mechanics.time_integration.fixed_steps import KINK_TOLERANCE
from viscontact.mechanics.time_integration.hereditary_integral import response_to
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.mechanics.time_integration.plan import plan_hereditary_integral
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes, uniform_times
from viscontact.mechanics.time_integration.step_error import TimeErrors

#: Relative error that the steps may cause [-].
DEFAULT_TIME_ERROR = 3e-3

#: Number of even steps that are taken in any case, as histories are drawn over them.
EVEN_STEPS = 60

#: Most kinks and steps within cycles for which steps are chosen; a load of more has short steps.
MAX_LOAD_STEPS = 500

#: Least distance of a chosen time from an even one, in steps.
MIN_DISTANCE = 0.3

#: Power of S that the approach of a sphere is proportional to.
SPHERE_EXPONENT = 2 / 3


def default_times(load: LoadHistory, compliance: ContactCompliance) -> Floats:
    """Times up to the end of the load, or of the creep under a load that is held [s]."""
    end = default_end(load, compliance)
    if end == 0:
        return np.zeros(1)
    even = uniform_times(end, EVEN_STEPS)
    kinks = load.kinks[load.kinks <= end]
    chosen = kinks[:0]
    load_steps = len(kinks) + min(end, float(load.kinks[-1])) / load.longest_step
    if load_steps <= MAX_LOAD_STEPS and compliance(end) > compliance.instant:
        chosen = steps_of_one_cell(load, compliance, end)
        if math.isfinite(load.longest_step):  # every run divides its steps while it oscillates
            chosen = chosen[chosen >= load.kinks[-1]]
        chosen = _distinct_times(chosen, even)
    even = even[np.abs(even[:, None] - kinks).min(axis=1) > KINK_TOLERANCE * end]
    return np.unique(np.concatenate([even, chosen, kinks]))


def _distinct_times(times: Floats, others: Floats) -> Floats:
    """Times that do not nearly coincide with others, compared with the steps between them."""
    if len(times) < 2:
        return times[:0]
    steps = np.diff(times)
    shortest = np.minimum(np.append(steps[0], steps), np.append(steps, steps[-1]))
    distance = np.abs(times[:, None] - others).min(axis=1)
    return np.asarray(times[distance > MIN_DISTANCE * shortest])


def default_end(load: LoadHistory, compliance: ContactCompliance) -> float:
    """End of the load, or of the creep under a load that is held at last [s]."""
    # The last change of the temperature counts as one of the load.
    end = float(max(load.kinks[-1], *compliance.clock.kinks, 0.0))
    if load.level_at(end) <= 0:
        return end
    settled = compliance.settled_after
    clock, law = compliance.clock, compliance.over_reduced_time
    if math.isinf(settled):
        why = "the law does not say when its creep is over"
        if math.isfinite(law.settled_after):
            why = "the creep slows down, with age or in the cold, before it is over"
        raise ValueError(
            f"times: {why}; say when the run ends, e.g. times=log_times(first, end, n)"
        )
    if math.isfinite(law.measured_until):
        return max(end, settled)
    passed = float(clock.reduced(np.array(end)))
    return clock.time_at(passed + law.settled_after) if clock is not TIME else end + settled


def steps_of_one_cell(load: LoadHistory, compliance: ContactCompliance, end: float) -> Floats:
    """Ends of the adaptive steps of a contact of one cell up to `end`, and 0 [s]."""
    ages = np.append(0.0, np.geomspace(1e-9 * end, end, 100))
    plan = plan_hereditary_integral(compliance, ages, 2)
    request = AdaptiveTimes(end, DEFAULT_TIME_ERROR)
    series, clock = plan.prony_approximation, plan.clock
    clocks = () if clock is TIME else (clock,)
    steps = AdaptiveSteps(request, np.zeros(0), load, compliance, clocks=clocks)
    errors = TimeErrors(plan, load)
    memory, force_memory = (
        InternalVariables(series, shape, clock=clock) for shape in ((2, 1), (1,))
    )
    times = [0.0]
    while (step := steps.next_step()) is not None:
        point = load.at(step.time, side=step.side)
        response, force_response = (response_to(step, each) for each in (memory, force_memory))
        level = wanted = np.array([max(point.level, 0.0)])
        if point.force is not None:
            wanted = np.maximum(force_response.of(level), 0.0) ** SPHERE_EXPONENT
        values = np.zeros((2, 1))  # pressure and unit displacement of the cell, 0 out of contact
        if response.compliance > 0:
            values += np.maximum((wanted - response.history) / response.compliance, 0.0)
        error = errors.of_step(step, point, values, response)
        if steps.accept_step(error.relative):
            memory.accept(values)
            force_memory.accept(level)
            errors.after(step, values, error)
            times.append(step.time)
    return np.unique(times)
