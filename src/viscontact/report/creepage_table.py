"""Table of a report with the tractions of a rolling body over its creepage."""

from __future__ import annotations

import math
from collections.abc import Iterator
from xml.etree.ElementTree import Element

import xarray as xr

from viscontact.drawing.svg.html import element
from viscontact.report.page_elements import remark, stacked_table
from viscontact.results.formatting import format_with_error
from viscontact.results.rolling import has_creepages, tabled_names
from viscontact.results.run_axis import SPEED
from viscontact.results.shown_rows import shown_rows
from viscontact.results.variables import CURVES, error_name

#: Rows of the table, about: of more results some of the speeds are left out.
MOST_ROWS = 40


def creepage_table(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the table of tractions over speed and creepage; nothing of a result without."""
    if not has_creepages(ds):
        return
    names, speeds = tabled_names(ds), SPEED.values(ds)
    ordered = ds.sortby("creepage")
    most = max(MOST_ROWS // ordered.sizes["creepage"], 2)
    shown = shown_rows(speeds.size, most)
    heads = ["speed", "creepage", *(CURVES[name].label.lower() for name in names)]
    rows = []
    for at in shown.tolist():
        for place, creepage in enumerate(ordered["creepage"].values.tolist()):
            here = ordered.isel(speed=at, creepage=place)
            values = [
                format_with_error(float(here[name]), _error(here, name), CURVES[name].units)
                for name in names
            ]
            rows.append([SPEED.place(float(speeds[at])), f"{100 * creepage:.4g} %", *values])
    yield element("h3", "Traction over creepage")
    yield stacked_table(heads, rows, numbers=range(1, len(heads)))
    yield remark(
        "Creepage: surface speed of the body over its travel, less 1, positive where the body "
        "drives and pushes the half-space backwards. Friction power is heat between the surfaces, "
        "dissipation under tractions is lost in the bodies."
    )


def _error(here: xr.Dataset, name: str) -> float:
    error = error_name(name)
    return float(here[error]) if error in here else math.nan
