"""Work per load cycle."""

from __future__ import annotations

import math
from collections.abc import Sequence

from viscontact.bodies.loads.history import Cycle, LoadInstant
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.restart_data import RestartData


class LoadCycleWork:
    """Work of the load over its last whole cycle, from the cycles (begin, end) in order."""

    def __init__(self, cycles: Sequence[Cycle]) -> None:
        self._cycles = list(cycles)
        # No work is done before a jump at time 0.
        self._begun = 0.0 if cycles and cycles[0][0] == (0.0, "left") else math.nan
        self.last_loss = math.nan

    def record_work(self, step: TimeStep, work: float) -> None:
        """Record the work [J] at the end of a step where a cycle ends or begins."""
        if self._cycles and _ends_at(step, self._cycles[0][1]):
            self.last_loss = work - self._begun
            del self._cycles[0]
        if self._cycles and _ends_at(step, self._cycles[0][0]):
            self._begun = work

    def restart_data(self) -> RestartData:
        """Return the state as plain data."""
        return {"left": len(self._cycles), "begun": self._begun, "last_loss": self.last_loss}

    def restore(self, restart_data: RestartData) -> None:
        """Continue under the same load from restart data."""
        self._cycles = self._cycles[len(self._cycles) - restart_data["left"] :]
        self._begun, self.last_loss = restart_data["begun"], restart_data["last_loss"]


def _ends_at(step: TimeStep, moment: LoadInstant) -> bool:
    """True if a step ends at a (time, side); without a jump there, on both sides."""
    time, side = moment
    other = (step.before_jump and side == "right") or (step.is_jump and side == "left")
    return step.time == time and not other
