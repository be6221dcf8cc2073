"""Whether a step puts on or takes off more of the load than it can follow."""

from __future__ import annotations

import numpy as np

from viscontact.checks.steps import relative_change, release_warnings, step_warnings, touch_warnings
from viscontact.simulation.setup import RunSetup
from viscontact.simulation.step_solution import StepSolution
from viscontact.state import Outcome
from viscontact.time_integration.fixed_steps import KINK_TOLERANCE, Step


def loading_warnings(
    run: RunSetup, step: Step, before: StepSolution | None, after: StepSolution
) -> dict[str, str]:
    """Return doubts about a step over which a creeping body is loaded or let go.

    Parameters
    ----------
    run : RunSetup
        The run.
    step : Step
        The step; none is raised by a jump.
    before : StepSolution or None
        Its begin; None for the first.
    after : StepSolution
        Its end.

    Returns
    -------
    dict of str to str
        Sentences by kind.
    """
    if before is None or step.is_jump:
        return {}
    touched, touches = (end.outcome is not Outcome.NO_CONTACT for end in (before, after))
    if not (touched and touches):
        if touched == touches or run.compliance(step.duration) == run.compliance.instant:
            return {}  # an elastic body takes the force however it comes
        if touches:
            return touch_warnings(step.duration, _rise(run, step))
        return release_warnings(step.duration, _fall(run, step))
    if after.resolved:
        return {}
    peaks = [float(end.pressure.max()) for end in (before, after)]
    forces = [float(end.pressure.sum()) * run.grid.cell_area for end in (before, after)]
    return step_warnings(step.duration, max(relative_change(*peaks), relative_change(*forces)))


def _rise(run: RunSetup, step: Step) -> float:
    """How far the load rises over a step that begins without contact, of its largest [-].

    A force begins from nothing then; but a dent is met again at an approach that may be far from 0,
    and only the way beyond the step's begin is made at once.
    """
    begin, end, largest = _levels(run, step)
    return (end - max(begin, 0.0)) / largest


def _fall(run: RunSetup, step: Step) -> float:
    """How far the load falls over a step that ends without contact, of its largest [-]."""
    begin, end, largest = _levels(run, step)
    return (begin - max(end, 0.0)) / largest


def _levels(run: RunSetup, step: Step) -> tuple[float, float, float]:
    """The load just after a step's begin, at its end, and the largest of the run [N or m]."""
    load, begin = run.load, step.time - step.duration * (1 - KINK_TOLERANCE)
    # A clamped tilt can press with no approach at all.
    largest = max(load.largest_level, np.finfo(float).tiny)
    end = load.level_at(step.time, side=step.side)
    return float(load.level_at(begin)), float(end), float(largest)
