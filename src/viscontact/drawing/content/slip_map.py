"""Maps of the cells that stick and slip, with arrows of the tractions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.map import Maps, maps_at
from viscontact.drawing.content.slip_states import slip_states
from viscontact.results.snapshots import Snapshot, field_at
from viscontact.units.formatting import format_quantity

#: Numbers of `slip_state`.
STICK, SLIP = 1, 2
#: Arrows along the longer side of a window, and least length of one over the longest.
_ARROWS, _SHORTEST = 17, 0.03


@dataclass(frozen=True, eq=False)
class SlipMap:
    """Cells that stick and slip at one instant or creepage, and some of their tractions."""

    state: Floats  # 0 open, 1 stick, 2 slip, shape (nx, ny)
    places: Floats  # where arrows begin [m], shape (n, 2)
    tractions: Floats  # along x and y [Pa], shape (n, 2)


@dataclass(frozen=True, eq=False)
class SlipMaps:
    """Maps of stick and slip with common window and scale."""

    maps: Maps
    slips: tuple[SlipMap, ...]

    @property
    def longest(self) -> float:
        """Largest traction of all arrows [Pa]."""
        return max(float(np.hypot(*each.tractions.T).max(initial=0.0)) for each in self.slips)

    @property
    def across(self) -> float:
        """Arrows along the window's x."""
        x, y = self.maps.window.x, self.maps.window.y
        longer = max(x[1] - x[0], y[1] - y[0])
        return _ARROWS * (x[1] - x[0]) / longer

    @property
    def note(self) -> str:
        """Traction of the longest arrow, and notes of the window."""
        longest = f"longest arrow: {format_quantity(self.longest, 'Pa', 3)}"
        return "; ".join(filter(None, (longest, self.maps.window.note)))


def slip_maps(run: xr.Dataset, times: ArrayLike | None, figure: str) -> SlipMaps:
    """Maps at requested instants [s] or speeds [m/s], by default some of a run."""
    states = slip_states(run, times, figure)
    # Maps of one speed differ in the creepage only.
    places = list(dict.fromkeys(each.shown.time for each in states))
    maps = maps_at(run, places, figure)
    known = {each.snapshot.time: each for each in maps.maps}
    shown = (replace(known[each.shown.time], heading=each.heading) for each in states)
    maps, window = replace(maps, maps=tuple(shown)), maps.window
    longer = max(window.x[1] - window.x[0], window.y[1] - window.y[0])
    found = tuple(_slip_map(each.run, each.shown, longer / _ARROWS, figure) for each in states)
    largest = max(float(np.hypot(*each.tractions.T).max(initial=0.0)) for each in found)
    return SlipMaps(maps, tuple(_without_short(each, _SHORTEST * largest) for each in found))


def _slip_map(run: xr.Dataset, shown: Snapshot, spacing: float, figure: str) -> SlipMap:
    state, along_x, along_y = (
        field_at(run, name, shown.time, figure)
        for name in ("slip_state", "traction_x", "traction_y")
    )
    # Cells at about the spacing, the same on both sides of the middle.
    rows, columns = (
        _spread(at.size, max(1, round(spacing / cell)))
        for at, cell in zip((shown.x, shown.y), shown.cell_size, strict=True)
    )
    chosen = np.ix_(rows, columns)
    touching = state[chosen] > 0
    x, y = np.meshgrid(shown.x[rows], shown.y[columns], indexing="ij")
    places = np.stack([x[touching], y[touching]], axis=1)
    tractions = np.stack([along_x[chosen][touching], along_y[chosen][touching]], axis=1)
    return SlipMap(state, places, tractions)


def _spread(count: int, stride: int) -> Integers:
    """Indices of cells at a stride, with equal parts left at both ends."""
    return np.arange((count - 1) % stride // 2, count, stride)


def _without_short(slip: SlipMap, least: float) -> SlipMap:
    kept = np.hypot(*slip.tractions.T) > least
    return SlipMap(slip.state, slip.places[kept], slip.tractions[kept])
