"""The estimate of what time steps cost, where the error is known in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.loads import ramp, step
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.mechanics.time_integration.plan import plan_hereditary_integral
from viscontact.mechanics.time_integration.step_error import (
    CURVATURE_SAFETY,
    FIRST_STEP_CURVATURE,
    ISOLATED_STEP_SHARE,
    LARGEST_OVER_MEAN,
    TimeErrors,
)

FLUID = SeriesCompliance(1.0, [], [], 0.01)  # so stiff that steps of 1 s rise all the way
LOAD = step(1.0)
FIELD = np.array([[1.0, 1.0], [0.5, 1.0]])  # pressure, all in contact, and unit displacement


def follow(values, duration=1.0, compliance=FLUID):
    """Estimates and exact errors along a field that takes the values step by step."""
    errors = TimeErrors(
        plan_hereditary_integral(compliance, np.arange(len(values)) * duration, 2), LOAD
    )
    memory = InternalVariables(compliance, FIELD.shape)
    estimates = []
    for k, value in enumerate(values):
        each = TimeStep(k * duration, duration if k else 0.0, None, smooth=k > 1)
        response = memory.ramp(duration) if k else memory.jump()
        field = value * FIELD
        estimates.append(
            errors.after(each, field, errors.of_step(each, LOAD.at(each.time), field, response))
        )
        memory.accept(field)
    return np.array(estimates), response.compliance


def test_a_held_and_a_steadily_growing_field_have_no_error():
    assert follow(np.ones(6))[0].max() == 0.0
    # Rounding of second differences alone.
    assert follow(np.arange(6.0))[0][2:].max() < 1e-15


@pytest.mark.parametrize("steps", [4, 16])
def test_under_a_parabola_the_estimate_is_the_sum_of_its_bulges(steps):
    times = np.arange(steps + 1.0)
    # So slow a flow that nothing relaxes meanwhile, to some 1e-5.
    estimates, met = follow(times**2, compliance=SeriesCompliance(1.0, [], [], 1e-6))
    # A line through a step of t² lies above it by d²/6 in the mean, and flow adds them all up; the
    # first step's is taken from its change, which is less than the guess from its successor.
    assert ISOLATED_STEP_SHARE < FIRST_STEP_CURVATURE * CURVATURE_SAFETY / 6
    bulges = LARGEST_OVER_MEAN * (ISOLATED_STEP_SHARE + CURVATURE_SAFETY / 6 * (steps - 1))
    assert estimates[-1] == close_to(1e-6 * bulges / (met * steps**2), rel=1e-4)


def test_the_wrong_pressure_relaxes_as_the_body_does():
    rise = np.arange(9.0) ** 2
    estimates, _ = follow(np.append(rise, np.full(40, rise[-1])))
    # In the first step held, the bend at its beginning still counts.
    held = estimates[10:]
    assert held[-1] / held[0] == close_to(math.exp(-0.01 * (len(held) - 1)), rel=1e-3)


def test_the_estimate_is_of_second_order_in_the_step():
    ends = [follow(np.sin(np.linspace(0, 1.5, n + 1)), 1.5 / n)[0][-1] for n in (20, 40, 80)]
    orders = np.log2(np.divide(ends[:-1], ends[1:]))
    assert orders == close_to([2.0, 2.0], abs=0.15)


def test_a_first_step_without_a_successor_counts_by_its_change():
    errors = TimeErrors(plan_hereditary_integral(FLUID, np.arange(3.0), 2), step(1.0))
    memory = InternalVariables(FLUID, FIELD.shape)
    for each, value in (
        (TimeStep(0.0, 0.0, 0.0, smooth=False), 0.0),
        (TimeStep(1.0, 1.0, 1.0, smooth=False), 1.0),
        (TimeStep(2.0, 1.0, 2.0, smooth=False), 1.0),
    ):
        response = memory.jump() if each.is_jump else memory.ramp(each.duration)
        measured = errors.of_step(each, LOAD.at(each.time), value * FIELD, response)
        estimate = errors.after(each, value * FIELD, measured)
        memory.accept(value * FIELD)
    expected = LARGEST_OVER_MEAN * ISOLATED_STEP_SHARE * 0.01 / response.compliance
    assert estimate == close_to(expected, rel=1e-12)


def test_an_elastic_body_has_no_error_of_time():
    assert follow(np.arange(8.0) ** 2, compliance=SeriesCompliance(1.0, [], []))[0].max() == 0.0


def test_what_touches_first_is_measured_against_what_the_load_will_come_to():
    """A tenth of the way up a ramp there is the fourth root of ten yet to come."""
    parts = []
    for load, time in ((step(1.0), 1.0), (ramp(1.0, 10.0), 1.0)):
        errors = TimeErrors(plan_hereditary_integral(FLUID, np.arange(3.0), 2), load)
        memory = InternalVariables(FLUID, FIELD.shape)
        for each in (TimeStep(0.0, 0.0, 0.0, smooth=False), TimeStep(time, 1.0, 1.0, smooth=False)):
            response = memory.jump() if each.is_jump else memory.ramp(each.duration)
            measured = errors.of_step(each, load.at(each.time), each.time * FIELD, response)
            errors.after(each, each.time * FIELD, measured)
            memory.accept(each.time * FIELD)
        parts.append(measured.relative)
    assert parts[0] / parts[1] == close_to(10.0**0.25, rel=1e-12)
