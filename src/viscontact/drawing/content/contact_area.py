"""Contact area over time, traced between the cells and by counting them, and areas of spots."""

from __future__ import annotations

from functools import partial

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.drawing.content.along_run import along_run, within_span
from viscontact.drawing.content.history import limits_around
from viscontact.drawing.content.panel import Axis, Curve, Ink, Panel
from viscontact.results.contact_spots import spots_of
from viscontact.results.snapshots import (
    Snapshot,
    field_times,
    labels_of,
    snapshot_reader,
    take_snapshots,
)
from viscontact.results.stated_errors import stated_error
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import ReadableUnit, format_number, readable_unit

_NAME = "contact_area"
#: Least number of spots on a logarithmic axis.
_MANY = 10
#: Largest number of separate dots.
_APART = 60


def area_panel(results: xr.Dataset, times: ArrayLike | None, figure: str) -> Panel:
    """Panel of the area with its error, and of the counted cells at the stored instants."""
    stored, read = field_times(results, figure), snapshot_reader(results)
    run = within_span(results, (_NAME, "force", "approach"), times, figure, "")
    first, last = run["time"].values[[0, -1]]
    shown = np.flatnonzero((stored >= first) & (stored <= last))
    counted = np.array([_area_of_cells(read(int(index))) for index in shown])
    area = run[_NAME].values
    instants, error = run["time"].values, stated_error(run, _NAME)
    smooth = Curve(instants, area, "between the cells", error=error, is_on_top=True)
    dots = partial(Curve, look="points", is_fine=counted.size > _APART, is_on_top=True)
    cells = dots(stored[shown], counted, "cells counted", Ink("fit"))
    y = Axis.of(SCALARS[_NAME].label, SCALARS[_NAME].units, area, counted)
    limits = limits_around([smooth, cells])
    # The line is above the dots, of which there may be many.
    return Panel(along_run([run]), Axis(y.quantity, y.unit, limits), (cells, smooth))


def _area_of_cells(snapshot: Snapshot) -> float:
    """Area of the cells in contact [m²]."""
    dx, dy = snapshot.cell_size
    return int(snapshot.in_contact.sum()) * dx * dy


def spots_panel(results: xr.Dataset, times: ArrayLike | None, figure: str) -> Panel:
    """Panel of the number of spots of an area or larger at some instants, named with the share."""
    snapshots = [each for each in take_snapshots(results, times, figure) if each.touching]
    found = [spots_of(results, each) for each in snapshots]
    inks = [Ink("ordered", place) for place in np.linspace(0.0, 1.0, len(found)).tolist()]
    curves = tuple(
        Curve(
            *(spots.areas, np.arange(1.0, spots.number + 1)),
            f"{label}: {spots.number}, {format_number(100 * spots.fraction, 3)} %",
            *(ink, "joined"),
        )
        for label, spots, ink in zip(labels_of(snapshots), found, inks, strict=True)
    )
    is_log = max(each.number for each in found) >= _MANY
    largest = readable_unit("m²", max(each.areas[0] for each in found))
    of = "period" if found[0].is_period else "convex hull"
    return Panel(
        Axis("Area of a spot", largest, scale="log"),
        Axis(
            *("Spots of this area or larger", ReadableUnit("-", 1.0)),
            scale="log" if is_log else "linear",
        ),
        curves,
        title=f"number of spots, contact in % of the {of}",
    )
