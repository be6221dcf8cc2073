"""Trends of gap and pressure, which show where a contact recedes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team, blocks_of
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.rim_crossings import Recession

#: Relative change of a gap or a pressure from its last extreme from which it has turned.
TURNS = 1e-3


@dataclass(frozen=True, eq=False)
class Trend:
    """Values in each cell at their last turn, and whether they rise since then; shape (nx, ny)."""

    extreme: Floats  # largest while they rise, least while they fall
    rises: Bools

    def after(self, values: Callable[[slice], Floats], error: float) -> Trend:
        """Trend after another step, by its values in some rows, with their error."""
        later = self.empty()
        # Rows of a block at once, without temporary arrays of the whole grid.
        for rows in blocks_of(len(self.extreme), self.extreme[0].nbytes):
            extreme, rises, given = self.extreme[rows], self.rises[rows], values(rows)
            further = np.where(rises, given > extreme, given < extreme)
            less = (1 + TURNS) * given + error < extreme
            more = (1 + TURNS) * extreme + error < given
            turned = np.where(rises, less, more)
            later.extreme[rows] = np.where(turned | further, given, extreme)
            later.rises[rows] = rises ^ turned
        return later

    def empty(self) -> Trend:
        """Trend of as many cells, without particular values."""
        return Trend(np.empty_like(self.extreme), np.empty_like(self.rises))

    def on(self, small: Grid, large: Grid, beyond: float) -> Trend:
        """The same trend on a larger grid, with a value beyond the smaller one."""
        extreme = small.embed(self.extreme, large, beyond)
        return Trend(extreme, small.embed(self.rises, large).astype(bool))


@dataclass(frozen=True, eq=False)
class ContactTrend:
    """Trends of gap [m] and pressure [Pa] of a contact on a creeping body."""

    gap: Trend
    pressure: Trend
    left: Bools  # cells that have been in contact since their gaps last closed

    @classmethod
    def at_first(cls, grid: Grid) -> ContactTrend:
        """Before the first contact."""
        gap = Trend(np.full(grid.shape, np.inf), np.zeros(grid.shape, dtype=bool))
        pressure = Trend(np.zeros(grid.shape), np.ones(grid.shape, dtype=bool))
        return cls(gap, pressure, np.zeros(grid.shape, dtype=bool))

    def after(
        self,
        gap: Floats,
        pressure: Floats,
        in_contact: Bools,
        error: float,
        team: Team | None = None,
    ) -> ContactTrend:
        """Trend after another step, with the solver's error of gaps [m]."""
        if team is not None and team.core is not None:
            found = ContactTrend(self.gap.empty(), self.pressure.empty(), np.empty_like(self.left))
            fields = gap, pressure, in_contact, error, TURNS, self.fields, found.fields
            team.core.follow_trends(*fields, team.threads)
            return found

        def closed(rows: slice) -> Floats:
            return np.where(in_contact[rows], 0.0, np.maximum(gap[rows], 0.0))

        def pressed(rows: slice) -> Floats:
            return pressure[rows]

        later = self.gap.after(closed, error)
        left = in_contact | (self.left & later.rises)
        return ContactTrend(later, self.pressure.after(pressed, 0.0), left)

    @property
    def fields(self) -> tuple[Floats, Bools, Floats, Bools, Bools]:
        """Extremes and rises of gap and pressure, and the cells left."""
        gap, pressure = self.gap, self.pressure
        return gap.extreme, gap.rises, pressure.extreme, pressure.rises, self.left

    def on(self, small: Grid, large: Grid) -> ContactTrend:
        """The same trends on a larger grid."""
        gap, pressure = self.gap.on(small, large, np.inf), self.pressure.on(small, large, 0.0)
        return ContactTrend(gap, pressure, small.embed(self.left, large).astype(bool))

    def restart_data(self) -> dict[str, Any]:
        """Return the trends as plain data."""
        return {"gap": vars(self.gap), "pressure": vars(self.pressure), "left": self.left}

    @classmethod
    def from_restart_data(cls, data: dict[str, Any]) -> ContactTrend:
        """Read the trends from plain data."""
        return cls(Trend(**data["gap"]), Trend(**data["pressure"]), data["left"])

    def recession(self, pressure: Floats) -> Recession:
        """Where the contact recedes, under the present pressure [Pa]."""
        falls = ~self.pressure.rises
        return Recession(pressure, falls=falls, opens=self.gap.rises, left=self.left)
