"""Time in which the edge of a contact that is lost passes the width of its cohesive zone."""

from __future__ import annotations

import math

from viscontact.mechanics.state import ContactState, Outcome
from viscontact.mechanics.time_integration.restart_data import RestartData


class ZonePassage:
    """Follows the largest contact since the bodies met, up to where they part."""

    def __init__(self) -> None:
        self._area, self._zone, self._time = 0.0, 0.0, 0.0

    def after(self, state: ContactState) -> float:
        """Take the state at the end of a step; return the time where contact was lost, else inf."""
        if state.outcome is Outcome.CONVERGED:
            if state.contact_area >= self._area:
                self._area, self._zone = state.contact_area, state.tensile_area or 0.0
                self._time = state.time
            return math.inf
        area, self._area = self._area, 0.0
        if not area or state.outcome is Outcome.NOT_CONVERGED:
            return math.inf
        # A ring around a round contact of the area π a² has the area 2 π a times its width.
        return (state.time - self._time) * self._zone / (2 * area)

    def restart_data(self) -> RestartData:
        """Return what is kept as plain data."""
        return {"area": self._area, "zone": self._zone, "time": self._time}

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data."""
        self._area, self._zone = restart_data["area"], restart_data["zone"]
        self._time = restart_data["time"]
