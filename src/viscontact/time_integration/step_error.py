"""What the time steps cost: an estimate of the pressure's error, from step to step.

Within a step the pressure is taken for linear in time. What it is not, a interpolation_error of d²
q''/12 in the
mean over a step of length d, enters the memory and acts on as long as the body remembers it: the
displacement e(t) it amounts to has to be made good by a wrong pressure, J * dq = -e. A memory of
single numbers follows both, with all bulges of one sign: an estimate of the most that they can have
come to, not of what they cancel to.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.loads import LoadHistory, LoadPoint
from viscontact.time_integration.fixed_steps import Step
from viscontact.time_integration.hereditary_integral import FieldMap, HereditaryResponse
from viscontact.time_integration.internal_variables import ramp_weights
from viscontact.time_integration.plan import HereditaryPlan
from viscontact.time_integration.restart_data import RestartData

#: The interpolation_error of a first step after a kink is guessed from the curvature in its
#: successor, which is smaller: after a first touch, where q grows as t^(2/3), by 2.9.
FIRST_STEP_CURVATURE = 3.0

#: Curvatures are taken from the steps behind, and lag where they grow.
CURVATURE_SAFETY = 2.0

#: Without any successor: this part of the change over the step, as the central pressure after a
#: first touch, which goes as t^(1/3), has; under t² from rest it is a sixth.
ISOLATED_STEP_SHARE = 1 / 4

#: By this power of the load's level what it does is taken to grow.
LOAD_GROWTH_EXPONENT = 1 / 4


@dataclass(frozen=True, eq=False)
class StepError:
    """What one step adds to the error.

    Attributes
    ----------
    interpolation_error : float
        Mean distance of the unit_displacement from the path the memory takes [Pa m].
    relative : float
        What it adds to the pressure's error, relative to the largest still to come [-].
    size : float
        Largest unit_displacement so far [Pa m].
    level : float
        Largest level of the load so far [N or m].
    rate : ndarray, shape (nx, ny), or None
        Rate of the unit_displacement over the step [Pa m/s]; None for a jump.
    """

    interpolation_error: float
    relative: float
    size: float
    level: float
    rate: NDArray[np.float64] | None = None


class TimeErrors:
    """Follows a run, and estimates the relative error of its pressure owed to the steps so far.

    Parameters
    ----------
    plan : HereditaryPlan
        How the run remembers.
    load : LoadHistory
        What presses. A first touch is alike at every scale: relative to what it has come to
        itself, its error would never be small. So a step is judged relative to what is still to
        come under the largest level, guessed by the fourth root of the level: a sphere's pressure
        grows as the third root of the force, a cone's not at all.
    """

    def __init__(self, plan: HereditaryPlan, load: LoadHistory) -> None:
        self._load = load
        self._level = 0.0
        self._compliance = plan.prony_approximation
        #: What each term of J still owes, to bulges and to the wrong pressure together [m].
        self._term_errors = np.zeros(plan.prony_approximation.term_count)
        self._pressure_error, self._jumped = 0.0, True
        #: Lengths of the last two steps since a kink, values at their ends; rate over the last.
        self._past: list[tuple[float, NDArray[np.float64]]] = []
        self._rate: NDArray[np.float64] | None = None
        self._pending: tuple[float, float] | None = None
        self._size = 0.0

    def of_step(
        self,
        step: Step,
        point: LoadPoint,
        values: NDArray[np.float64],
        response: HereditaryResponse,
    ) -> StepError:
        """Return what a step adds to the error of the pressure at its end.

        Parameters
        ----------
        step : Step
            The step, not taken yet.
        point : LoadPoint
            The load at its end.
        values : ndarray, shape (2, nx, ny)
            Pressure ``p`` [Pa] and unit_displacement ``K p`` [Pa m] at its end.
        response : HereditaryResponse
            Of the memory to it.

        Returns
        -------
        StepError
            For the first step after a kink a guess from the change over it.
        """
        # Deflections are positive: the kernel is.
        size, level = max(self._size, float(values[1].max())), max(self._level, point.level)
        if step.is_jump or not self._past:
            return StepError(0.0, 0.0, size, level)
        rate = values[1] - self._past[-1][1][1]
        rate /= step.duration
        interpolation_error = self._interpolation_error(step, rate, response)
        crept = self._compliance(step.duration) - self._compliance.instant
        to_come = size * self._growth_to_come(level)
        relative = (
            interpolation_error * crept / (response.compliance * to_come) if size > 0 else 0.0
        )
        return StepError(interpolation_error, relative, size, level, rate)

    def after(self, step: Step, values: NDArray[np.float64], error: StepError) -> float:
        """Take a step, and return the estimated relative error of the pressure after it.

        Parameters
        ----------
        step, values
            As in `of_step`.
        error : StepError
            From `of_step`.

        Returns
        -------
        float
            Relative to the largest unit_displacement of the run so far [-].
        """
        self._size, self._level = error.size, error.level
        if not step.smooth or step.is_jump:
            self._settle(alone=True)
            self._past = self._past[-1:]
        if step.is_jump:
            self._past = []
            if self._compliance.instant > 0:  # else nothing jumps
                self._pressure_error = -float(self._term_errors.sum()) / self._compliance.instant
                self._jumped = True
        elif len(self._past) < 2:
            change = 0.0 if error.rate is None else step.duration * _largest(error.rate)
            self._pending = (step.duration, change)
        else:
            self._settle(
                alone=False, interpolation_error=error.interpolation_error / step.duration**2
            )
            self._remember(step.duration, error.interpolation_error)
        self._past = [*self._past[-1:], (step.duration, values)]
        self._rate = error.rate
        return abs(self._pressure_error) / self._size if self._size > 0 else 0.0

    def restart_data(self) -> RestartData:
        """What has to be kept to go on from here."""
        return {
            "owed": self._term_errors,
            "wrong": self._pressure_error,
            "jumped": self._jumped,
            "past": [{"duration": duration, "values": values} for duration, values in self._past],
            "pending": None if self._pending is None else list(self._pending),
            "size": self._size,
            "level": self._level,
        }

    def restore(self, restart_data: RestartData) -> None:
        """Go on from what was `restart_data`, in the same run."""
        self._term_errors, self._pressure_error = restart_data["owed"], restart_data["wrong"]
        self._jumped = restart_data["jumped"]
        self._past = [(point["duration"], point["values"]) for point in restart_data["past"]]
        self._rate = self._last_rate()
        pending = restart_data["pending"]
        self._pending = None if pending is None else (pending[0], pending[1])
        self._size, self._level = restart_data["size"], restart_data["level"]

    def map_fields(self, grown: FieldMap) -> None:
        """Go on with larger fields, which `grown` makes of those that are remembered."""
        self._past = [(duration, grown(values)) for duration, values in self._past]
        self._rate = self._last_rate()

    def _growth_to_come(self, level: float) -> float:
        """By how much pressure and unit_displacement will still grow with the load, at least."""
        return (self._load.largest_level / level) ** LOAD_GROWTH_EXPONENT if level > 0 else 1.0

    def _interpolation_error(
        self, step: Step, rate: NDArray[np.float64], response: HereditaryResponse
    ) -> float:
        before = self._rate if step.smooth else None
        travel = step.duration * _largest(rate) if response.held or before is None else 0.0
        late = response.held * travel / 2
        if before is None:
            return max(late, ISOLATED_STEP_SHARE * travel)
        change = _largest(rate - before)
        curvature = 2 * change / (step.duration + self._past[-1][0])
        return CURVATURE_SAFETY * step.duration**2 / 12 * curvature + late

    def _last_rate(self) -> NDArray[np.float64] | None:
        if len(self._past) < 2:
            return None
        (_, before), (duration, last) = self._past
        return np.asarray((last[1] - before[1]) / duration)

    def _settle(self, *, alone: bool, interpolation_error: float = 0.0) -> None:
        """Keep a first step, whose interpolation error per d² its successor may supply."""
        if self._pending is None:
            return
        duration, change = self._pending
        guess = ISOLATED_STEP_SHARE * change
        if not alone:
            guess = min(guess, FIRST_STEP_CURVATURE * duration**2 * interpolation_error)
        self._remember(duration, guess)
        self._pending = None

    def _remember(self, duration: float, interpolation_error: float) -> None:
        """Add the interpolation error of a step to the history, and its effect on the pressure."""
        held = ramp_weights(self._compliance, duration, after_jump=True)
        wrong = ramp_weights(self._compliance, duration, after_jump=self._jumped)
        self._term_errors = (
            wrong.decay * self._term_errors + (held.old + held.new) * interpolation_error
        )
        self._term_errors += wrong.old * self._pressure_error
        met = self._compliance.instant + float(wrong.new.sum())
        self._pressure_error, self._jumped = -float(self._term_errors.sum()) / met, False
        self._term_errors += wrong.new * self._pressure_error


def _largest(field: NDArray[np.float64]) -> float:
    """Largest absolute value."""
    return max(float(field.max()), -float(field.min()))
