"""Maps of the pressure over the surface: instants, window, scale, outlines, and a moving body."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property

import numpy as np
import scipy
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.compared_runs import Runs, headed_snapshots, runs_of
from viscontact.drawing.content.panel import Axis, Units
from viscontact.drawing.content.rim import rim_curves
from viscontact.drawing.content.scale import ColourScale, pressure_scale
from viscontact.drawing.content.window import Window, window_around
from viscontact.results.recorded_case import RecordedEnd, recorded_ends
from viscontact.results.recorded_motion import body_axis_at, direction_at, motion_axis
from viscontact.results.shown_rows import shown_rows
from viscontact.results.snapshots import Snapshot, field_times
from viscontact.results.variables import MESH_DEPENDENT
from viscontact.units.formatting import readable_unit

#: More instants than these make a page large and show no more.
MOST_INSTANTS = 24
#: Largest number of spots with contour lines, which would cover more of them.
_MOST_SPOTS = 12
#: Quantile of the pressure up to which levels go where the peak depends on the mesh.
_ORDINARY = 0.85


@dataclass(frozen=True)
class BodyPlace:
    """A moving body at an instant: its axis x, y [m], and its direction, None at rest."""

    axis: tuple[float, float]
    direction: tuple[float, float] | None

    def way(self, along: str) -> float:
        """Part of the direction along x or y, 0 at rest."""
        return 0.0 if self.direction is None else self.direction["xy".index(along)]

    def arrow(self, stretch: float, length: float) -> tuple[float, float] | None:
        """Arrow along the motion in a drawing whose y is stretched; None at rest."""
        if self.direction is None:
            return None
        across, up = self.direction[0], stretch * self.direction[1]
        part = length / math.hypot(across, up)
        return part * across, part * up


@dataclass(frozen=True, eq=False)
class Map:
    """Pressure over the surface at one instant or speed."""

    heading: str
    snapshot: Snapshot
    depends_on_mesh: bool = False  # the largest pressure
    body: BodyPlace | None = None  # a moving one

    @cached_property
    def outline(self) -> list[Floats]:
        """Closed curves of the rim of the contact, shape (n, 2) [m]; none without contact."""
        return rim_curves(self.snapshot) if self.snapshot.touching else []

    @property
    def has_many_spots(self) -> bool:
        """True for a contact of so many spots that lines around them would cover the pressure."""
        return bool(scipy.ndimage.label(self.snapshot.in_contact)[1] > _MOST_SPOTS)

    @property
    def ordinary(self) -> float:
        """Largest pressure that does not depend on the mesh, roughly [Pa]."""
        return float(np.quantile(self.snapshot.pressure[self.snapshot.in_contact], _ORDINARY))


@dataclass(frozen=True, eq=False)
class Maps:
    """Maps with a common window and scale; at least one is of a contact."""

    maps: tuple[Map, ...]
    window: Window  # part of the surface that contains every contact
    stored: int = 0  # number of instants with fields in the result, if it is a single one
    motion: str | None = None  # axis of a motion of a single result
    reference: Maps | None = None  # compared with them
    ends: tuple[RecordedEnd, ...] = ()  # of the bodies of a single result

    @property
    def snapshots(self) -> tuple[Snapshot, ...]:
        """Fields of each map."""
        return tuple(each.snapshot for each in self.maps)

    @property
    def moves(self) -> bool:
        """True if each map shows the place of a moving body."""
        return self.motion is not None

    @property
    def peak_note(self) -> str:
        """Note on peaks that depend on the mesh; empty if none does."""
        return f"peak {MESH_DEPENDENT}" if any(each.depends_on_mesh for each in self.maps) else ""

    @property
    def note(self) -> str:
        """Notes on the stretch of the window and on peaks."""
        return "; ".join(filter(None, (self.window.note, self.peak_note)))

    @property
    def zone_note(self) -> str:
        """Meaning of the line around a cohesive zone; empty without one."""
        pulls = any(each.in_zone.any() for each in self.snapshots)
        return "dashed: end of the cohesive zone" if pulls else ""

    def axes(self, units: Units = readable_unit) -> tuple[Axis, Axis]:
        """Axes x and y in the unit of the longer one."""
        unit = units("m", self.window.x, self.window.y)
        return Axis("x", unit, self.window.x), Axis("y", unit, self.window.y)

    def scale(self, units: Units = readable_unit) -> ColourScale:
        """Scale of the pressure of all maps."""
        fields = [each.pressure for each in self.snapshots]
        low, high = min(map(np.min, fields)), max(map(np.max, fields))
        touching = [each for each in self.maps if each.snapshot.touching]
        ordinary = max(each.ordinary for each in touching) if self.peak_note else None
        return pressure_scale(float(low), float(high), ordinary, units=units)

    def own_scales(self, units: Units = readable_unit) -> tuple[ColourScale, ...]:
        """Scale of each map for itself; without contact there that of all."""
        return tuple(
            replace(self, maps=(each,)).scale(units)
            if each.snapshot.touching
            else self.scale(units)
            for each in self.maps
        )

    @property
    def start(self) -> int:
        """The instant that is shown first: the last one in contact."""
        return max(index for index, each in enumerate(self.snapshots) if each.touching)

    @cached_property
    def inside(self) -> tuple[slice, slice]:
        """The cells along x and y within the window."""
        first, window = self.snapshots[0], self.window
        return _slice_between(first.x, window.x), _slice_between(first.y, window.y)

    def strides(self, most: int) -> tuple[int, int]:
        """Numbers of cells along x and y that are averaged to have at most so many of each."""
        along_x, along_y = (-(-(part.stop - part.start) // most) for part in self.inside)
        return along_x, along_y

    def centres(self, most: int) -> tuple[Floats, Floats]:
        """Centres of the averaged cells within the window, x and y [m]."""
        first, strides = self.snapshots[0], self.strides(most)
        x, y = (
            _averaged(at[part], stride)
            for at, part, stride in zip((first.x, first.y), self.inside, strides, strict=True)
        )
        return x, y

    def cells(self, index: int, most: int) -> Floats:
        """Pressure of the averaged cells within the window [Pa]; NaN without contact."""
        shown = self.snapshots[index]
        joined = shown.pressure[self.inside]
        share = (shown.in_contact | shown.in_zone)[self.inside].astype(float)
        for axis, stride in enumerate(self.strides(most)):
            joined, share = (_averaged(each, stride, axis) for each in (joined, share))
        return np.where(share > 0, joined, np.nan)

    @cached_property
    def through(self) -> tuple[tuple[float, float], ...]:
        """Position of the sections at each instant, x and y [m]; it follows a moving contact."""
        if not self.moves:
            return (_middle_of(self.snapshots[self.start]),) * len(self.maps)
        return tuple(
            each.body.axis
            if each.body and not each.snapshot.touching
            else _middle_of(each.snapshot)
            for each in self.maps
        )

    @cached_property
    def many_spots(self) -> bool:
        """True if the contact has so many spots at an instant that outlines cover its pressure."""
        return any(each.has_many_spots for each in self.maps)

    def nearest(self, place: float) -> int:
        """Index of the nearest instant [s] or speed [m/s]."""
        return int(np.abs([each.time - place for each in self.snapshots]).argmin())

    def stretched(self, slender: float) -> Maps:
        """Maps with a long contact shown at most so many times longer than wide."""
        return replace(self, window=window_around(self.snapshots, slender=slender))

    def beside(self, reference: Maps | None) -> Maps:
        """Maps in a window that contains the contacts of a reference, too."""
        if reference is None:
            return self
        window = window_around([*self.snapshots, *reference.snapshots])
        return replace(self, window=window, reference=reference)


def maps_at(results: Runs, times: ArrayLike | None, figure: str, *, count: int = 1) -> Maps:
    """Maps at requested instants [s], by default some of a run, or the last of each of several."""
    # A moving body is shown where there is one run.
    runs = list(runs_of(results, figure).values())
    place = body_of(runs[0]) if len(runs) == 1 else None
    maps = tuple(
        Map(heading, each, marked, place and place(each.time))
        for heading, each, marked in headed_snapshots(results, times, figure, count=count)
    )
    window = window_around([each.snapshot for each in maps])
    if len(runs) > 1:
        return Maps(maps, window)
    stored, motion = field_times(runs[0], figure).size, motion_axis(runs[0])
    return Maps(maps, window, stored, motion, ends=recorded_ends(runs[0]))


def maps_over(run: xr.Dataset) -> Maps:
    """Maps at instants over a whole run, at most `MOST_INSTANTS`."""
    stored = field_times(run, "map")
    chosen = shown_rows(stored.size, MOST_INSTANTS)
    return maps_at(run, stored[chosen], "map")


def maps_if_any(run: xr.Dataset) -> Maps | None:
    """Maps over a run; None if it stores no fields, or none of a contact."""
    try:
        return maps_over(run)
    except ValueError:
        return None


def body_of(run: xr.Dataset) -> Callable[[float], BodyPlace] | None:
    """Place of a moving body at an instant [s] or a speed [m/s]; None for a standing contact."""
    if motion_axis(run) is None:
        return None
    return lambda time: BodyPlace(body_axis_at(run, time), direction_at(run, time))


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


def _averaged(values: Floats, stride: int, axis: int = 0) -> Floats:
    """Means over a number of neighbours; the last may have fewer."""
    starts = np.arange(0, values.shape[axis], stride)
    counts = np.diff([*starts, values.shape[axis]])
    sums = np.add.reduceat(values, starts, axis=axis)
    return np.asarray(sums / np.expand_dims(counts, 1 - axis) if values.ndim > 1 else sums / counts)


def _slice_between(positions: Floats, limits: tuple[float, float]) -> slice:
    within = np.flatnonzero((positions >= limits[0]) & (positions <= limits[1]))
    if not within.size:  # a part of the cells of a line contact, which are long
        after = int(np.searchsorted(positions, limits[0]))
        return slice(max(after - 1, 0), min(after + 1, positions.size))
    return slice(int(within[0]), int(within[-1]) + 1)
