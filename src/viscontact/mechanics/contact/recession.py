"""Trends of gap and pressure, which show where a contact recedes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.team import blocks_of
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.rim_crossings import Recession

#: Relative change of a gap or a pressure from its last extreme from which it has turned.
TURNS = 1e-3


@dataclass(frozen=True, eq=False)
class Trend:
    """Values in each cell at their last turn, and whether they rise since then; shape (nx, ny)."""

    extreme: Floats  # largest while they rise, least while they fall
    rises: Bools

    def follow(self, rows: slice, values: Floats, error: float) -> None:
        """Take in the values of another step in some rows, in place, with the error of values."""
        extreme, rises = self.extreme[rows], self.rises[rows]
        further = np.where(rises, values > extreme, values < extreme)
        less = (1 + TURNS) * values + error < extreme
        more = (1 + TURNS) * extreme + error < values
        turned = np.where(rises, less, more)
        np.copyto(extreme, values, where=turned | further)
        rises ^= turned

    def on(self, small: Grid, large: Grid, beyond: float) -> Trend:
        """The same trend on a larger grid, with a value beyond the smaller one."""
        extreme = small.embed(self.extreme, large, beyond)
        return Trend(extreme, small.embed(self.rises, large).astype(bool))


@dataclass(frozen=True, eq=False)
class ContactTrend:
    """Trends of gap [m] and pressure [Pa] of a contact on a creeping body."""

    gap: Trend
    pressure: Trend

    @classmethod
    def at_first(cls, grid: Grid) -> ContactTrend:
        """Before the first contact."""
        gap = Trend(np.full(grid.shape, np.inf), np.zeros(grid.shape, dtype=bool))
        return cls(gap, Trend(np.zeros(grid.shape), np.ones(grid.shape, dtype=bool)))

    def follow(self, gap: Floats, pressure: Floats, in_contact: Bools, error: float) -> None:
        """Take in another step, in place, with the solver's error of gaps [m]."""
        for rows in blocks_of(len(gap), gap[0].nbytes):
            closed = np.where(in_contact[rows], 0.0, np.maximum(gap[rows], 0.0))
            self.gap.follow(rows, closed, error)
            self.pressure.follow(rows, pressure[rows], 0.0)

    def on(self, small: Grid, large: Grid) -> ContactTrend:
        """The same trends on a larger grid."""
        return ContactTrend(self.gap.on(small, large, np.inf), self.pressure.on(small, large, 0.0))

    def recession(self, pressure: Floats) -> Recession:
        """Where the contact recedes, under the present pressure [Pa]."""
        return Recession(pressure, falls=~self.pressure.rises, opens=self.gap.rises)
