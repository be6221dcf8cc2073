"""What the time steps cost: an estimate of the pressure's error, from step to step.

Within a step the pressure is taken for linear in time. What it is not, a bulge of d² q''/12 in the
mean over a step of length d, enters the memory and acts on as long as the body remembers it: the
displacement e(t) it amounts to has to be made good by a wrong pressure, J * dq = -e. Memories of a
single number follow both, with all bulges of one sign: an estimate of the most that they can have
come to, not of what they cancel to.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.carried import Carried
from viscontact.load import LoadHistory
from viscontact.memory import Enlarging, MemoryPlan, RecursiveMemory, Response
from viscontact.schedule import Step

#: The bulge of a first step after a kink is guessed from the curvature in its successor, which is
#: smaller: after a first touch, where q grows as t^(2/3), by 2.9.
FIRST = 3.0

#: Curvatures are taken from the steps behind, and lag where they grow.
SAFETY = 2.0

#: Without any successor: this part of the change over the step, as the central pressure after a
#: first touch, which goes as t^(1/3), has; under t² from rest it is a sixth.
ALONE = 1 / 4

#: By this power of the load's level what it does is taken to grow.
GROWTH = 1 / 4


@dataclass(frozen=True)
class StepError:
    """What one step adds to the error.

    Attributes
    ----------
    bulge : float
        Mean distance of the deflection from the path the memory takes [Pa m].
    relative : float
        What it adds to the pressure's error, relative to the largest still to come [-].
    size : float
        Largest deflection so far [Pa m].
    level : float
        Largest level of the load so far [N or m].
    """

    bulge: float
    relative: float
    size: float
    level: float


class TimeErrors:
    """Follows a run, and estimates the relative error of its pressure owed to the steps so far.

    Parameters
    ----------
    plan : MemoryPlan
        How the run remembers.
    load : LoadHistory
        What presses. A first touch is alike at every scale: relative to what it has come to
        itself, its error would never be small. So a step is judged relative to what is still to
        come under the largest level, guessed by the fourth root of the level: a sphere's pressure
        grows as the third root of the force, a cone's not at all.
    """

    def __init__(self, plan: MemoryPlan, load: LoadHistory) -> None:
        self._load = load
        self._level = 0.0
        self._compliance = plan.sketch
        self._bulges = RecursiveMemory(plan.sketch, (1,))
        self._wrong = RecursiveMemory(plan.sketch, (1,))
        for memory in (self._bulges, self._wrong):
            memory.jump()
            memory.accept(np.zeros(1))
        self._error = 0.0
        self._past: list[tuple[float, NDArray[np.float64]]] = []
        self._pending: tuple[float, float] | None = None
        self._size = 0.0

    def of_step(self, step: Step, values: NDArray[np.float64], response: Response) -> StepError:
        """Return what a step adds to the error of the pressure at its end.

        Parameters
        ----------
        step : Step
            The step, not taken yet.
        values : ndarray, shape (2, nx, ny)
            Pressure ``p`` [Pa] and deflection ``K p`` [Pa m] at its end.
        response : Response
            Of the memory to it.

        Returns
        -------
        StepError
            For the first step after a kink a guess from the change over it.
        """
        # Deflections are positive: the kernel is.
        size, level = max(self._size, float(values[1].max())), self._level_after(step)
        if step.is_jump or size == 0:
            return StepError(0.0, 0.0, size, level)
        bulge = self._bulge(step, values[1], response)
        crept = self._compliance(step.duration) - self._compliance.instant
        to_come = size * self._growth_to_come(level)
        return StepError(bulge, bulge * crept / (response.compliance * to_come), size, level)

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
            Relative to the largest deflection of the run so far [-].
        """
        self._size, self._level = error.size, error.level
        if not step.smooth or step.is_jump:
            self._settle(alone=True)
            self._past = self._past[-1:]
        if step.is_jump:
            self._past = []
            if self._compliance.instant > 0:  # else nothing jumps
                self._make_good(self._wrong.jump())
        elif len(self._past) < 2:
            change = float(np.abs(self._change_to(values[1])).max()) if self._past else 0.0
            self._pending = (step.duration, change)
        else:
            self._settle(alone=False, bulge=error.bulge / step.duration**2)
            self._remember(step.duration, error.bulge)
        self._past = [*self._past[-1:], (step.time, values)]
        return self._error / self._size if self._size > 0 else 0.0

    def carried(self) -> Carried:
        """What has to be kept to go on from here."""
        return {
            "bulges": self._bulges.carried(),
            "wrong": self._wrong.carried(),
            "past": [{"time": time, "values": values} for time, values in self._past],
            "pending": None if self._pending is None else list(self._pending),
            "error": self._error,
            "size": self._size,
            "level": self._level,
        }

    def restore(self, carried: Carried) -> None:
        """Go on from what was `carried` under the same load by the same law."""
        self._bulges.restore(carried["bulges"])
        self._wrong.restore(carried["wrong"])
        self._past = [(point["time"], point["values"]) for point in carried["past"]]
        pending = carried["pending"]
        self._pending = None if pending is None else (pending[0], pending[1])
        self._error, self._size, self._level = (
            carried[name] for name in ("error", "size", "level")
        )

    def enlarge(self, grown: Enlarging) -> None:
        """Go on with larger fields, which `grown` makes of those that are remembered."""
        self._past = [(time, grown(values)) for time, values in self._past]

    def _growth_to_come(self, level: float) -> float:
        """By how much pressure and deflection will still grow with the load, at least."""
        return (self._load.largest_level / level) ** GROWTH if level > 0 else 1.0

    def _level_after(self, step: Step) -> float:
        """Largest level of the load so far, the step's end included [N or m]."""
        return max(self._level, float(self._load.level_at(step.time, side=step.side)))

    def _bulge(self, step: Step, field: NDArray[np.float64], response: Response) -> float:
        """Mean distance of the field from the path that the memory takes, within a step."""
        if step.is_jump or not self._past:
            return 0.0
        change = self._change_to(field)
        travel = _largest(change)
        late = response.held * travel / 2
        if not step.smooth or len(self._past) < 2:
            return max(late, ALONE * travel)
        before = self._past[-1][0] - self._past[-2][0]
        earlier = self._past[-1][1][1] - self._past[-2][1][1]
        earlier /= before
        change /= step.duration
        change -= earlier
        curvature = 2 * _largest(change) / (step.duration + before)
        return SAFETY * step.duration**2 / 12 * curvature + late

    def _change_to(self, deflection: NDArray[np.float64]) -> NDArray[np.float64]:
        """From the last deflection on."""
        return np.asarray(deflection - self._past[-1][1][1])

    def _settle(self, *, alone: bool, bulge: float = 0.0) -> None:
        """Remember a first step, with or without a successor that tells the bulge per d²."""
        if self._pending is None:
            return
        duration, change = self._pending
        guess = ALONE * change
        if not alone:
            guess = min(guess, FIRST * duration**2 * bulge)
        self._remember(duration, guess)
        self._pending = None

    def _remember(self, duration: float, bulge: float) -> None:
        """Let a bulge over a step enter the memory, and the pressure go wrong by what it does."""
        held, nothing = np.array([bulge]), np.zeros(1)
        self._bulges.jump()
        self._bulges.accept(held)
        self._bulges.ramp(duration)
        self._bulges.accept(held)
        self._bulges.jump()
        self._bulges.accept(nothing)
        self._make_good(self._wrong.ramp(duration))

    def _make_good(self, response: Response) -> None:
        left = self._bulges.jump().history
        wrong = -(response.history + left) / response.compliance
        self._wrong.accept(wrong)
        self._error = abs(float(wrong[0]))


def _largest(field: NDArray[np.float64]) -> float:
    """Largest absolute value."""
    return max(float(field.max()), -float(field.min()))
