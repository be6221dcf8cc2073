"""Deformed surface of the half-space, and the indenter on it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import scipy
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.map import Map, Maps, maps_at
from viscontact.drawing.content.relief import Relief, relief
from viscontact.drawing.content.window import Window
from viscontact.results.snapshots import field_at
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Margin around the contact, relative [-].
_BESIDE = 0.35
#: Aspect ratio above which a contact is stretched, as for the pressure.
_SLENDER = 2.2
#: Points drawn along each axis at most.
_MOST = 130


@dataclass(frozen=True, eq=False)
class DeformedContact:
    """Surfaces of both bodies: gap, and displacement into the half-space [m], NaN if unknown."""

    map: Map
    displacement: Floats
    window: Window

    @property
    def indenter(self) -> Floats:
        """Depth of the indenter's lower side [m], shape (nx, ny), NaN where there is none."""
        depth = self.displacement - self.map.snapshot.gap
        return np.where(np.isfinite(depth), depth, np.nan)

    def relief(self, unit: ReadableUnit) -> Relief:
        """Relief of the displacement, with a limited number of points."""
        (x, i), (y, j) = self._points()
        depth = unit(self.displacement[np.ix_(i, j)])
        mesh = np.meshgrid(self.window.unit(x), self.window.unit(y), indexing="ij")
        return relief(*mesh, depth, depth, np.isfinite(depth))

    def rim(self) -> Iterator[Floats]:
        """Yield the curves of the edge of the contact: points x, y, depth [m]."""
        cells = (self.map.snapshot.x, self.map.snapshot.y)
        # On the rim the bodies touch: the indenter is smooth there, the surface falls next to a
        # punch.
        depth = scipy.interpolate.RegularGridInterpolator(
            cells, _beyond_ends(self.indenter), bounds_error=False
        )
        for curve in self.map.outline:
            yield np.column_stack([curve, depth(curve)])

    def middle_lines(self, top: float) -> Iterator[Floats]:
        """Yield the indenter's two middle lines, below a depth: points x, y, depth [m]."""
        snapshot, depth = self.map.snapshot, self.indenter
        depth = np.where(depth >= top, depth, np.nan)
        i, j = (int(np.abs(2 * at - at[0] - at[-1]).argmin()) for at in (snapshot.x, snapshot.y))
        (x, at_x), (y, at_y) = self._points()
        yield np.column_stack([x, np.full(x.size, snapshot.y[j]), depth[at_x, j]])
        yield np.column_stack([np.full(y.size, snapshot.x[i]), y, depth[i, at_y]])

    def _points(self) -> tuple[tuple[Floats, Integers], tuple[Floats, Integers]]:
        """Positions of the points drawn along x and y [m], and their numbers."""
        snapshot = self.map.snapshot
        return _sampled(snapshot.x, self.window.x), _sampled(snapshot.y, self.window.y)


def deformed_contacts(
    results: xr.Dataset, times: ArrayLike | None, figure: str
) -> tuple[Maps, list[DeformedContact]]:
    """Maps in a window that shows the surface around the contact, and both surfaces of each."""
    maps = maps_at(results, times, figure, count=2).stretched(_SLENDER)
    x_low, x_high, y_low, y_high = maps.snapshots[0].borders()
    limits = []
    for (low, high), start, end in ((maps.window.x, x_low, x_high), (maps.window.y, y_low, y_high)):
        margin = _BESIDE * (high - low)
        limits.append((max(low - margin, start), min(high + margin, end)))
    window = Window(limits[0], limits[1], maps.window.stretch)
    contacts = [
        DeformedContact(each, field_at(results, "displacement", each.snapshot.time, figure), window)
        for each in maps.maps
    ]
    return replace(maps, window=window), contacts


def depth_scale(contacts: list[DeformedContact]) -> tuple[ReadableUnit, tuple[float, float]]:
    """Unit of the displacement, and its limits in that unit."""
    shown = [contact.relief(ReadableUnit("m", 1.0)).values for contact in contacts]
    low, high = min(map(np.min, shown)), max(map(np.max, shown))
    if high == low:
        high = low + 1e-3 * (contacts[0].window.x[1] - contacts[0].window.x[0])
    unit = readable_unit("m", low, high)
    return unit, (float(unit(low)), float(unit(high)))


def _sampled(at: Floats, limits: tuple[float, float]) -> tuple[Floats, Integers]:
    """Positions within limits at equal steps [m], and their numbers."""
    inside = np.flatnonzero((at >= limits[0]) & (at <= limits[1]))
    chosen = inside[:: -(-inside.size // _MOST)]
    return at[chosen], chosen


def _beyond_ends(depth: Floats) -> Floats:
    """Values continued beyond a body's end by those of its nearest cell."""
    nearest = scipy.ndimage.distance_transform_edt(
        np.isnan(depth), return_distances=False, return_indices=True
    )
    return np.asarray(depth[tuple(nearest)])
