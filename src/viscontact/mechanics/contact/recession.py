"""Trends of gap and pressure, which show where a contact recedes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from viscontact.backend.arrays import Bools, Field, Floats, Numbers
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


@dataclass(frozen=True, eq=False)
class ContactTrend:
    """Trends of gap [m] and pressure [Pa] of a contact on a creeping body."""

    # Of a contact that is even along an axis, of the cells beyond its middle only.

    gap: Trend
    pressure: Trend
    left: Bools  # cells that have been in contact since their gaps last closed
    mirrored: tuple[bool, bool] = (False, False)

    @classmethod
    def at_first(cls, grid: Grid, mirrored: tuple[bool, bool] = (False, False)) -> ContactTrend:
        """Before the first contact."""
        nothing = np.zeros(_beyond_middle(np.broadcast_to(0.0, grid.shape), mirrored).shape)
        gap = Trend(nothing + np.inf, np.zeros(nothing.shape, dtype=bool))
        pressure = Trend(nothing, np.ones(nothing.shape, dtype=bool))
        return cls(gap, pressure, np.zeros(nothing.shape, dtype=bool), mirrored)

    def after(
        self,
        gap: Floats,
        pressure: Floats,
        in_contact: Bools,
        error: float,
        team: Team | None = None,
    ) -> ContactTrend:
        """Trend after another step, with the solver's error of gaps [m]; fields of the grid."""
        gap, pressure = (_beyond_middle(each, self.mirrored) for each in (gap, pressure))
        in_contact = _beyond_middle(in_contact, self.mirrored)
        if team is not None and team.core is not None:
            empty = self.gap.empty(), self.pressure.empty(), np.empty_like(self.left)
            found = ContactTrend(*empty, self.mirrored)
            fields = gap, pressure, in_contact, error, TURNS, self.fields, found.fields
            team.core.follow_trends(*fields, team.threads)
            return found

        def closed(rows: slice) -> Floats:
            return np.where(in_contact[rows], 0.0, np.maximum(gap[rows], 0.0))

        def pressed(rows: slice) -> Floats:
            return pressure[rows]

        later = self.gap.after(closed, error)
        left = in_contact | (self.left & later.rises)
        return replace(self, gap=later, pressure=self.pressure.after(pressed, 0.0), left=left)

    @property
    def fields(self) -> tuple[Floats, Bools, Floats, Bools, Bools]:
        """Extremes and rises of gap and pressure, and the cells left."""
        gap, pressure = self.gap, self.pressure
        return gap.extreme, gap.rises, pressure.extreme, pressure.rises, self.left

    def on(self, small: Grid, large: Grid) -> ContactTrend:
        """The same trends on a larger grid."""

        def grown(field: Numbers, beyond: float) -> Numbers:
            whole = small.embed(Team().unfold(field, self.mirrored), large, beyond)
            return np.ascontiguousarray(_beyond_middle(whole, self.mirrored))

        gap, pressure = (
            Trend(grown(of.extreme, beyond), grown(of.rises, 0.0).astype(bool))
            for of, beyond in ((self.gap, np.inf), (self.pressure, 0.0))
        )
        return replace(self, gap=gap, pressure=pressure, left=grown(self.left, 0.0).astype(bool))

    def restart_data(self) -> dict[str, Any]:
        """Return the trends as plain data."""
        trends = {"gap": vars(self.gap), "pressure": vars(self.pressure)}
        return trends | {"left": self.left, "mirrored": list(self.mirrored)}

    @classmethod
    def from_restart_data(cls, data: dict[str, Any]) -> ContactTrend:
        """Read the trends from plain data."""
        along_x, along_y = data["mirrored"]
        trends = Trend(**data["gap"]), Trend(**data["pressure"])
        return cls(*trends, data["left"], (along_x, along_y))

    def recession(self, pressure: Floats, team: Team | None = None) -> Recession:
        """Where the contact recedes, under the present pressure [Pa], on the grid."""
        flags = ~self.pressure.rises, self.gap.rises, self.left
        return Recession(
            pressure, *((team or Team()).unfold(each, self.mirrored) for each in flags)
        )


def _beyond_middle(field: Field, mirrored: tuple[bool, bool]) -> Field:
    """The cells of a field beyond the middle of the axes along which it is even."""
    rows = field.shape[0] // 2 if mirrored[0] else 0
    columns = field.shape[1] // 2 if mirrored[1] else 0
    return field[rows:, columns:]
