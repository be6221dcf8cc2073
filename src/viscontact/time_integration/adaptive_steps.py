"""Steps that are as long as the error allows: short where the load moves, growing under creep."""

from __future__ import annotations

import math
from dataclasses import asdict

import numpy as np
import scipy
from numpy.typing import NDArray

from viscontact.loads import LoadHistory
from viscontact.materials.compliance import ContactCompliance
from viscontact.time_integration.fixed_steps import Step, snap_to_kink
from viscontact.time_integration.requested_times import AdaptiveTimes
from viscontact.time_integration.restart_data import RestartData
from viscontact.time_integration.step_error import ISOLATED_STEP_SHARE

#: A single step may add this part of the tolerance, since what the body remembers adds up.
STEP_TOLERANCE_SHARE = 0.2

#: A step's error falls with its cube; it is aimed below what is allowed, so that few are refused.
SAFETY_FACTOR, ERROR_ORDER = 0.7, 3.0

#: From one step to the next the duration changes by factors between these.
MIN_FACTOR, MAX_FACTOR = 0.2, 2.0

#: No step is shorter than this part of the run.
MIN_STEP_FRACTION = 1e-12

#: After a kink, the first step is this part of the way to the next one at most.
FIRST_STEP_FRACTION = 0.02

#: Steps from one kink of the load to the next, at a tolerance of 1e-3, and for a body that does not
#: creep; measured on spheres, good to a factor of two.
STEPS_PER_INTERVAL, ELASTIC_STEPS_PER_INTERVAL = 25.0, 7.0


def estimated_steps(
    wanted: AdaptiveTimes, load: LoadHistory, compliance: ContactCompliance
) -> float:
    """About how many steps a run will choose.

    Parameters
    ----------
    wanted : AdaptiveTimes
        End of the run and tolerance.
    load : LoadHistory
        What presses.
    compliance : ContactCompliance
        J(t).

    Returns
    -------
    float
        Good to a factor of two where the law has an instant compliance.

    Examples
    --------
    >>> from viscontact.materials.compliance import SeriesCompliance
    >>> from viscontact.loads import step
    >>> zener = SeriesCompliance(1.0, [1.0], [2.0])
    >>> estimated_steps(AdaptiveTimes(10.0, 1e-3), step(1.0), zener)
    25.0
    """
    stretches = float((load.kinks < wanted.end).sum())
    creeps = compliance(wanted.end) > compliance.instant
    # Errors of a step fall with its cube, those of the run with its square.
    finer = (1e-3 / wanted.tolerance) ** (1 / 3)
    each = (
        max(ELASTIC_STEPS_PER_INTERVAL, STEPS_PER_INTERVAL * finer)
        if creeps
        else ELASTIC_STEPS_PER_INTERVAL
    )
    return stretches * each + min(wanted.end, float(load.kinks[-1])) / load.longest_step


class AdaptiveSteps:
    """Chooses each step by the error of the last.

    Parameters
    ----------
    wanted : AdaptiveTimes
        End of the run and tolerance.
    stops : ndarray
        Instants to be hit, besides the load's kinks and the end [s].
    load : LoadHistory
        What presses.
    compliance : ContactCompliance
        J(t).
    """

    def __init__(
        self,
        wanted: AdaptiveTimes,
        stops: NDArray[np.float64],
        load: LoadHistory,
        compliance: ContactCompliance,
    ) -> None:
        self._end, self._allowed = wanted.end, STEP_TOLERANCE_SHARE * wanted.tolerance
        self._load, self._compliance = load, compliance
        self._kinks = set(load.kinks.tolist())
        self._jumps = set(load.jumps.tolist())
        asked = {snap_to_kink(stop, load.stops) for stop in [*stops.tolist(), wanted.end]}
        inner = {stop for stop in load.stops.tolist() if stop < self._end}
        self._stops = sorted((asked | inner) - {0.0})
        self._end = max(self._stops)
        self._time, self._duration = 0.0, 0.0
        self._step: Step | None = Step(0.0, 0.0, 0.0, smooth=False)
        self._growth = MAX_FACTOR

    @property
    def left(self) -> int:
        """About how many steps are still to come, if they go on growing as they did."""
        way = self._end - self._time
        if way <= 0:
            return 0
        if self._duration == 0:
            return 100
        growth = min(max(self._growth, 1.0), 1.3)
        if growth < 1.01:
            return math.ceil(way / self._duration)
        return math.ceil(math.log1p((growth - 1) * way / self._duration) / math.log(growth))

    def next_step(self) -> Step | None:
        """The next step; None at the end."""
        return self._step

    def accept_step(self, error: float) -> bool:
        """Whether a step may be closed; if not, a shorter one is upcoming.

        Parameters
        ----------
        error : float
            What it adds to the relative error [-].

        Returns
        -------
        bool
            False if it is to be taken again.
        """
        step = self._step
        assert step is not None  # there was one to be judged
        if step.is_jump:
            self._advance(step)
            return True
        factor = SAFETY_FACTOR * (self._allowed / max(error, 1e-30)) ** (1 / ERROR_ORDER)
        if error > self._allowed and step.duration > MIN_STEP_FRACTION * self._end:
            self._duration = step.duration * min(max(factor, MIN_FACTOR), 0.8)
            self._step = self._next(step.smooth)
            return False
        self._growth = min(max(factor, MIN_FACTOR), MAX_FACTOR) if error > 0 else MAX_FACTOR
        # A step cut short by a stop says nothing against the duration it was cut from.
        self._duration = min(self._duration, MAX_FACTOR * step.duration)
        self._duration = max(self._duration, self._growth * step.duration)
        self._advance(step)
        return True

    def restart_data(self) -> RestartData:
        """What has to be kept to go on from here."""
        return {
            "time": self._time,
            "duration": self._duration,
            "growth": self._growth,
            "step": None if self._step is None else asdict(self._step),
        }

    def restore(self, restart_data: RestartData) -> None:
        """Go on from what was `restart_data` on the same way."""
        self._time, self._duration, self._growth = (
            restart_data[name] for name in ("time", "duration", "growth")
        )
        self._step = None if restart_data["step"] is None else Step(**restart_data["step"])

    def _advance(self, step: Step) -> None:
        self._time = step.time
        if step.before_jump:
            self._step = Step(step.time, 0.0, step.time, smooth=False)
        elif self._time >= self._end:
            self._step = None
        else:
            after_kink = self._time == 0 or self._time in self._kinks
            if after_kink:
                # A kink that changes little lets the steps go on as they were.
                before = 0.0 if step.is_jump else step.duration
                self._duration = max(self._first_duration(), before)
            self._step = self._next(smooth=not after_kink)

    def _next(self, smooth: bool) -> Step:
        stop = next(stop for stop in self._stops if stop > self._time)
        way = stop - self._time
        duration = self._duration
        if self._time < self._load.kinks[-1]:
            duration = min(duration, self._load.longest_step)
        # Without a sliver at the end: the last two steps share what is left.
        parts = math.ceil(way / duration * (1 - 1e-9))
        duration = way if parts <= 1 else way / 2 if parts == 2 else duration
        time = stop if parts <= 1 else self._time + duration
        jumps = parts <= 1 and stop in self._jumps
        return Step(time, duration, None if jumps else time, smooth, before_jump=jumps)

    def _first_duration(self) -> float:
        """A first step over which the law creeps little, as nothing else is known."""
        way = next(stop for stop in (*sorted(self._kinks), self._end) if stop > self._time)
        shortest = MIN_STEP_FRACTION * self._end
        way = max(FIRST_STEP_FRACTION * (way - self._time), shortest)
        instant = self._compliance.instant or self._compliance(way)
        part = 0.5 * (12 * self._allowed) ** (1 / ERROR_ORDER)
        if self._load.level_at(self._time) <= 0:
            part = min(
                part, self._allowed / ISOLATED_STEP_SHARE
            )  # a first touch, after which all goes by roots
        wanted = part * instant + self._compliance.instant

        def excess(log_time: float) -> float:
            crept: float = self._compliance(math.exp(log_time)) - wanted
            return crept

        if excess(math.log(way)) <= 0:
            return float(way)
        if excess(math.log(shortest)) >= 0:
            return shortest
        logarithms = math.log(shortest), math.log(way)
        return math.exp(float(scipy.optimize.brentq(excess, *logarithms, rtol=1e-3)))
