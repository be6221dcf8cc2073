"""Trends of gap and pressure, which show where a contact recedes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.rim_crossings import Recession

#: Relative change of a gap or a pressure from its last extreme from which it has turned.
TURNS = 1e-3


@dataclass(frozen=True, eq=False)
class Trend:
    """Values in each cell at their last turn, and whether they rise since then; shape (nx, ny)."""

    extreme: Floats  # largest while they rise, least while they fall
    rises: Bools

    def after(self, values: Floats, error: float) -> Trend:
        """Trend after another step, with the error of the values."""
        further = np.where(self.rises, values > self.extreme, values < self.extreme)
        less = (1 + TURNS) * values + error < self.extreme
        more = (1 + TURNS) * self.extreme + error < values
        turned = np.where(self.rises, less, more)
        return Trend(np.where(turned | further, values, self.extreme), self.rises ^ turned)

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
        nowhere = np.zeros(grid.shape, dtype=bool)
        return cls(
            Trend(np.full(grid.shape, np.inf), nowhere), Trend(np.zeros(grid.shape), ~nowhere)
        )

    def after(self, gap: Floats, pressure: Floats, in_contact: Bools, error: float) -> ContactTrend:
        """Trend after another step, with the solver's error of gaps [m]."""
        closed = np.where(in_contact, 0.0, np.maximum(gap, 0.0))
        return ContactTrend(self.gap.after(closed, error), self.pressure.after(pressure, 0.0))

    def on(self, small: Grid, large: Grid) -> ContactTrend:
        """The same trends on a larger grid."""
        return ContactTrend(self.gap.on(small, large, np.inf), self.pressure.on(small, large, 0.0))

    def recession(self, pressure: Floats) -> Recession:
        """Where the contact recedes, under the present pressure [Pa]."""
        return Recession(pressure, falls=~self.pressure.rises, opens=self.gap.rises)
