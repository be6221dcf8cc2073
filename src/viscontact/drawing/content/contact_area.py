"""Contact area over time: traced between the cells, and by counting cells."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.drawing.content.along_run import along_run, within_span
from viscontact.drawing.content.history import limits_around
from viscontact.drawing.content.panel import Axis, Curve, Ink, Panel
from viscontact.results.snapshots import Snapshot, field_times, snapshot_reader
from viscontact.results.stated_errors import stated_error
from viscontact.results.variables import SCALARS

_NAME = "contact_area"


def area_panel(results: xr.Dataset, times: ArrayLike | None, figure: str) -> Panel:
    """Panel of the area with its error, and of the counted cells at the stored instants."""
    stored, read = field_times(results, figure), snapshot_reader(results)
    run = within_span(results, (_NAME, "force", "approach"), times, figure, "")
    first, last = run["time"].values[[0, -1]]
    shown = np.flatnonzero((stored >= first) & (stored <= last))
    counted = np.array([_area_of_cells(read(int(index))) for index in shown])
    area = run[_NAME].values
    smooth = Curve(run["time"].values, area, "between the cells", error=stated_error(run, _NAME))
    cells = Curve(stored[shown], counted, "cells counted", Ink("fit"), "points")
    y = Axis.of(SCALARS[_NAME].label, SCALARS[_NAME].units, area, counted)
    limits = limits_around([smooth, cells])
    return Panel(along_run([run]), Axis(y.quantity, y.unit, limits), (smooth, cells))


def _area_of_cells(snapshot: Snapshot) -> float:
    """Area of the cells in contact [m²]."""
    dx, dy = snapshot.cell_size
    return int(snapshot.in_contact.sum()) * dx * dy
