"""Events of bodies that adhere: jumps into contact, and pull-off with the largest pull."""

from __future__ import annotations

import math
from dataclasses import astuple

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.state import ContactEvent, ContactState, EventKind, Outcome, as_event
from viscontact.mechanics.time_integration.restart_data import RestartData

#: Time from a pull-off to the end of the segment that it ends, as a part of its instant: within it
#: the run has lost contact, too, which takes other steps.
PULL_OFF_MARGIN = 1e-3

#: Part of the largest pull by which a pull falls and grows again where another withdrawal begins.
RENEWED = 0.1

#: Fall of the pull, as a part of the largest one, in which its bend there is found.
NEAR = 0.05

#: Time from the largest pull to where it has fallen by this part, over that of the states before,
#: at most [-].
BEYOND = 2.0


@dataclass(frozen=True)
class Instant:
    """State of a contact, as far as events need it."""

    time: float  # [s]
    force: float  # [N]
    approach: float  # [m]
    touches: bool


class ContactEvents:
    """Finds where contact begins and ends; keeps the events that no state has reported yet."""

    def __init__(self) -> None:
        self._recent: list[Instant] = []
        #: Largest pull of the present withdrawal [N], and its time [s]; least pull since then.
        self._pull, self._least = (-math.inf, math.nan), math.inf
        #: Times and pulls near the largest one.
        self._near: list[tuple[float, float]] = []
        self._waiting: list[ContactEvent] = []

    def after(self, state: ContactState) -> None:
        """Take the state at the end of a step."""
        touches = state.outcome is Outcome.CONVERGED
        now = Instant(state.time, state.force, state.approach, touches)
        before = self._recent[-1] if self._recent else None
        self._recent = [*self._recent[-2:], now]
        if touches and (before is None or not before.touches):
            self._begin_anew()
        if touches:
            self._follow(now)
        if before is not None and before.touches != touches:
            kind: EventKind = "jump_in" if touches else "pull_off"
            forces, approaches = (before.force, now.force), (before.approach, now.approach)
            pull = (*self._pull, self._bend()) if kind == "pull_off" else (math.nan,) * 3
            event = ContactEvent(kind, now.time, forces, approaches, *pull)
            self._waiting = [*self._waiting, event]  # copies of this may go on by themselves

    def reported(self) -> tuple[ContactEvent, ...]:
        """Return the events since the last report."""
        found, self._waiting = tuple(self._waiting), []
        return found

    def restart_data(self) -> RestartData:
        """Return what is kept as plain data."""
        return {
            "recent": [list(astuple(each)) for each in self._recent],
            "pull": [*self._pull, self._least],
            "near": [list(each) for each in self._near],
            "waiting": [list(event) for event in self._waiting],
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data."""
        self._recent = [Instant(*each) for each in restart_data["recent"]]
        pull, time, self._least = restart_data["pull"]
        self._pull = pull, time
        self._near = [(each[0], each[1]) for each in restart_data["near"]]
        self._waiting = [as_event(each) for each in restart_data["waiting"]]

    def _follow(self, now: Instant) -> None:
        """Take the pull of a contact; one that grows again after it has fallen begins anew."""
        pull, largest = -now.force, self._pull[0]
        if self._least < (1 - RENEWED) * largest and pull > self._least + RENEWED * largest:
            self._begin_anew()
        self._pull = max(self._pull, (pull, now.time), self._between())
        self._least = min(self._least, pull) if pull < self._pull[0] else math.inf
        least = max((1 - NEAR) * self._pull[0], 0.0)
        self._near = [each for each in (*self._near, (now.time, pull)) if each[1] > least]

    def _begin_anew(self) -> None:
        self._pull, self._least, self._near = (-math.inf, math.nan), math.inf, []

    def _bend(self) -> float:
        """Fall of the pull beside the largest one over the square of the time from there [N/s²]."""
        largest, time = self._pull
        times, pulls = np.array(self._near, dtype=float).reshape(-1, 2).T
        squares = np.square(times - time)
        if not (times > time).any() or not squares.any():
            return math.inf
        bend = float((largest - pulls) @ squares / np.square(squares).sum())
        # A pull that hardly falls in these states falls beyond them.
        return max(bend, NEAR * largest / (BEYOND**2 * float(squares.max())))

    def _between(self) -> tuple[float, float]:
        """Largest pull of the parabola through the last three states, where it has one."""
        # The force changes by percents in a step: the largest pull lies between two states.
        if len(self._recent) < 3 or not all(each.touches for each in self._recent):
            return -math.inf, math.nan
        times, pulls = (
            np.array(values)
            for values in zip(*((each.time, -each.force) for each in self._recent), strict=True)
        )
        steps = np.diff(times)
        if steps.min() <= 0 or pulls[1] < pulls[0] or pulls[1] < pulls[2]:
            return -math.inf, math.nan
        slopes = np.diff(pulls) / steps
        bend = (slopes[1] - slopes[0]) / (times[2] - times[0])
        if bend >= 0:
            return -math.inf, math.nan
        middle = (times[0] + times[1]) / 2 - slopes[0] / (2 * bend)
        pull = pulls[0] + (middle - times[0]) * (slopes[0] + bend * (middle - times[1]))
        return float(pull), float(middle)
