"""Fields on a page: a selection of instants and a window on the surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.window import Window, window_around
from viscontact.plot.pressure.pressure_map import has_many_spots
from viscontact.results.recorded_motion import body_axis_at, direction_at, motion_axis
from viscontact.results.run_axis import run_axis
from viscontact.results.snapshots import Snapshot, field_times, take_snapshots
from viscontact.results.stated_errors import mesh_dependent

#: More instants than these make a page large and show no more.
MOST_INSTANTS = 24


@dataclass(frozen=True)
class BodyPlace:
    """A moving body at an instant: its axis x, y [m], and its direction, None at rest."""

    axis: tuple[float, float]
    direction: tuple[float, float] | None

    def way(self, along: str) -> float:
        """Part of the direction along x or y, 0 at rest."""
        return 0.0 if self.direction is None else self.direction["xy".index(along)]


@dataclass(frozen=True)
class ShownFields:
    """Fields on a page."""

    snapshots: tuple[Snapshot, ...]  # at least one of them in contact
    window: Window  # part of the surface that contains every contact
    stored: int  # number of instants with fields in the result
    marked: tuple[bool, ...]  # at which the peak pressure depends on the mesh
    body: tuple[BodyPlace, ...] = ()  # at each instant shown; empty for a standing contact

    @property
    def peak(self) -> float:
        """Largest pressure [Pa]."""
        return max(float(snapshot.pressure.max()) for snapshot in self.snapshots)

    @property
    def start(self) -> int:
        """The instant that is shown first: the last one in contact."""
        return max(index for index, each in enumerate(self.snapshots) if each.touching)

    @cached_property
    def inside(self) -> tuple[slice, slice]:
        """The cells along x and y within the window."""
        first, window = self.snapshots[0], self.window
        return _between(first.x, window.x), _between(first.y, window.y)

    @cached_property
    def through(self) -> tuple[tuple[float, float], ...]:
        """Position of the sections at each instant, x and y [m].

        Those of a standing contact are through the resultant of the first instant shown, those of a
        moving one follow it.
        """
        if not self.body:
            return (_middle_of(self.snapshots[self.start]),) * len(self.snapshots)
        pairs = zip(self.snapshots, self.body, strict=True)
        return tuple(_middle_of(each) if each.touching else place.axis for each, place in pairs)

    @cached_property
    def many_spots(self) -> bool:
        """True if the contact has so many spots at an instant that outlines cover its pressure."""
        return any(map(has_many_spots, self.snapshots))

    def beside(self, other: ShownFields | None) -> ShownFields:
        """The same fields in a window that contains the contacts of other fields as well."""
        if other is None:
            return self
        return replace(self, window=window_around([*self.snapshots, *other.snapshots]))


def shown_fields(ds: xr.Dataset) -> ShownFields:
    """Choose the instants and the window to show of a result's fields."""
    stored = field_times(ds, "map")
    chosen = np.unique(np.linspace(0, stored.size - 1, MOST_INSTANTS).round().astype(int))
    snapshots = tuple(take_snapshots(ds, stored[chosen], "map"))
    window, marked, body = window_around(snapshots), _marked(ds, snapshots), _body(ds, snapshots)
    return ShownFields(snapshots, window, stored.size, marked, body)


def _middle_of(shown: Snapshot) -> tuple[float, float]:
    """Resultant of the pressure [m], or, without contact there, place of the largest pressure."""
    pressure, (dx, dy) = shown.pressure, shown.cell_size
    force = pressure.sum()
    # To a hundredth of a cell: the rest is rounding, and zero reads better.
    x = round(float(shown.x @ pressure.sum(axis=1) / force) / dx, 2) * dx + 0.0
    y = round(float(pressure.sum(axis=0) @ shown.y / force) / dy, 2) * dy + 0.0
    if shown.in_contact[np.abs(shown.x - x).argmin(), np.abs(shown.y - y).argmin()]:
        return x, y
    i, j = np.unravel_index(int(pressure.argmax()), pressure.shape)
    return float(shown.x[i]), float(shown.y[j])


def _body(ds: xr.Dataset, snapshots: Sequence[Snapshot]) -> tuple[BodyPlace, ...]:
    if motion_axis(ds) is None:
        return ()
    times = [each.time for each in snapshots]
    return tuple(BodyPlace(body_axis_at(ds, time), direction_at(ds, time)) for time in times)


def _marked(ds: xr.Dataset, snapshots: Sequence[Snapshot]) -> tuple[bool, ...]:
    instants, marked = run_axis(ds).values(ds), mesh_dependent(ds, "peak_pressure")
    return tuple(bool(marked[np.abs(instants - each.time).argmin()]) for each in snapshots)


def _between(positions: Floats, limits: tuple[float, float]) -> slice:
    within = np.flatnonzero((positions >= limits[0]) & (positions <= limits[1]))
    return slice(int(within[0]), int(within[-1]) + 1)
