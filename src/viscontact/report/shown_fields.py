"""The fields that a page shows: which instants, and which part of the surface."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.plot.snapshots import Snapshot, field_times, take_snapshots
from viscontact.plot.window import Window, window_around

#: More instants than these make a page large and show no more.
MOST_INSTANTS = 24
#: Cells whose pressures differ by so little share the peak; sections run through the one that is
#: nearest to the axes.
_SAME_PEAK = 1e-3


@dataclass(frozen=True)
class ShownFields:
    """Fields on a page.

    Attributes
    ----------
    snapshots : tuple of Snapshot
        Instants, at least one of them in contact.
    window : Window
        The part of the surface that holds every contact.
    stored : int
        How many instants the result has, of which these are some.
    """

    snapshots: tuple[Snapshot, ...]
    window: Window
    stored: int

    @property
    def peak(self) -> float:
        """Largest pressure [Pa]."""
        return max(float(snapshot.pressure.max()) for snapshot in self.snapshots)

    @cached_property
    def inside(self) -> tuple[slice, slice]:
        """The cells along x and y within the window."""
        first, window = self.snapshots[0], self.window
        return _between(first.x, window.x), _between(first.y, window.y)

    @cached_property
    def through(self) -> tuple[float, float]:
        """Where sections run, x and y: through the last instant's largest pressure [m]."""
        last = next(each for each in reversed(self.snapshots) if each.touching)
        i, j = np.nonzero(last.pressure >= (1 - _SAME_PEAK) * last.pressure.max())
        x, y = last.x[i], last.y[j]
        nearest = int(np.hypot(x / np.ptp(last.x), y / np.ptp(last.y)).argmin())
        # On an even grid no row of cells lies on an axis: the section there is between two.
        dx, dy = last.cell_size
        at_x, at_y = float(x[nearest]), float(y[nearest])
        return (0.0 if abs(at_x) <= 0.51 * dx else at_x), (0.0 if abs(at_y) <= 0.51 * dy else at_y)


def shown_fields(ds: xr.Dataset) -> ShownFields:
    """Choose what to show of the fields of a result.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.

    Raises
    ------
    ValueError
        If it has no fields, or no contact in them.
    """
    stored = field_times(ds, "map")
    chosen = np.unique(np.linspace(0, stored.size - 1, MOST_INSTANTS).round().astype(int))
    snapshots = tuple(take_snapshots(ds, stored[chosen], "map"))
    return ShownFields(snapshots, window_around(snapshots), stored.size)


def _between(positions: NDArray[np.float64], limits: tuple[float, float]) -> slice:
    within = np.flatnonzero((positions >= limits[0]) & (positions <= limits[1]))
    return slice(int(within[0]), int(within[-1]) + 1)
