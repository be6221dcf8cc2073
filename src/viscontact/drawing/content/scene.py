"""Scene of an animation: fields, window and scale of all instants, and each instant in it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.map import BodyPlace, Map, body_of
from viscontact.drawing.content.notes import peak_note
from viscontact.drawing.content.scale import ColourScale, pressure_scale
from viscontact.drawing.content.window import Window, window_over
from viscontact.results.recorded_case import across_period
from viscontact.results.recorded_motion import contact_edges, motion_axis
from viscontact.results.snapshots import Snapshot, snapshot_reader
from viscontact.units.formatting import format_quantity


@dataclass(frozen=True, eq=False)
class Scene:
    """Fixed parts of an animation: fields, limits and colours."""

    stored: Floats
    read: Callable[[int], Snapshot]
    place: Callable[[float], BodyPlace] | None  # of a moving body at an instant [s]
    window: Window
    scale: ColourScale
    along: Literal["x", "y"]
    note: str
    top: float  # of the section, the largest pressure of all instants [Pa]

    def at(self, instant: float) -> Map:
        """Map at a stored instant [s]."""
        snapshot = self.read(int(np.abs(self.stored - instant).argmin()))
        return Map("", snapshot, body=self.place and self.place(snapshot.time))

    def edges(self, shown: Map) -> tuple[float, float] | None:
        """Leading and trailing edge of a moving contact on the section [m]."""
        way = 0.0 if shown.body is None else shown.body.way(self.along)
        return contact_edges(*shown.snapshot.contact_section(self.along), way)


def scene_of(results: xr.Dataset, stored: Floats, shown: Floats, figure: str) -> Scene:
    """Scene with the limits of all instants to be shown."""
    note, read = peak_note([results], shown), snapshot_reader(results)
    boxes, low, peak, ordinary = [], 0.0, 0.0, 0.0
    tops: dict[Literal["x", "y"], float] = {"x": 0.0, "y": 0.0}
    for index in np.flatnonzero(np.isin(stored, shown)):
        snapshot = read(int(index))
        if snapshot.touching:
            boxes.append(snapshot.extent())
            low = min(low, float(snapshot.pressure.min()))
            peak = max(peak, float(snapshot.pressure.max()))
            ordinary = max(ordinary, Map("", snapshot).ordinary)
            for way in tops:
                tops[way] = max(tops[way], float(snapshot.section(way)[1].max()))
    if not boxes:
        raise ValueError(
            f"{figure}: the bodies do not touch at any stored instant from "
            f"{format_quantity(shown[0], 's')} to {format_quantity(shown[-1], 's')}; choose other "
            "times"
        )
    window = window_over(boxes, snapshot.borders() if any(snapshot.periodic) else None)
    scale = pressure_scale(low, peak, ordinary if note else None)
    is_long = window.x[1] - window.x[0] >= window.y[1] - window.y[0]
    along = motion_axis(results) or across_period(results) or ("x" if is_long else "y")
    return Scene(stored, read, body_of(results), window, scale, along, note, tops[along])
