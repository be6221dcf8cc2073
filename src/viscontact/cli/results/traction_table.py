"""Table of the tractions of a rolling body over its creepage."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr
from rich.box import SIMPLE_HEAD
from rich.table import Table

from viscontact.results.formatting import format_with_error_in
from viscontact.results.rolling import shown_forces
from viscontact.results.run_axis import SPEED
from viscontact.results.shown_rows import shown_rows
from viscontact.results.variables import CURVES, error_name
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Numbers of creepages and of speeds that fit on a terminal.
MOST_CREEPAGES, MOST_SPEEDS = 4, 8


def traction_tables(ds: xr.Dataset) -> list[Table]:
    """A table for each tangential force of a body that rolls."""
    return [_traction_table(ds, name) for name in shown_forces(ds)]


def _traction_table(ds: xr.Dataset, name: str) -> Table:
    """A force at some of the creepages, and the least one at which the body slides."""
    ordered = ds.sortby(["speed", "creepage"])
    creepages = shown_rows(ordered.sizes["creepage"], MOST_CREEPAGES)
    unit = readable_unit(CURVES[name].units, float(np.nanmax(np.abs(ds[name].values))))
    title = f"{unit.label(CURVES[name].label)} at a creepage of"
    table = Table(box=SIMPLE_HEAD, show_edge=False, title=title, title_justify="left")
    table.add_column("speed", justify="right")
    for creepage in ordered["creepage"].values[creepages].tolist():
        table.add_column(_percent(creepage), justify="right")
    table.add_column("slides from", justify="right")
    for speed in shown_rows(ordered.sizes["speed"], MOST_SPEEDS).tolist():
        here = ordered.isel(speed=speed)
        forces = [_force(here.isel(creepage=at), name, unit) for at in creepages.tolist()]
        table.add_row(SPEED.place(float(here["speed"])), *forces, _sliding(here))
    return table


def _force(here: xr.Dataset, name: str, unit: ReadableUnit) -> str:
    error = error_name(name)
    half_width = float(here[error]) if error in here else math.nan
    return format_with_error_in(unit, float(here[name]), half_width).replace("± ", "±")


def _sliding(here: xr.Dataset) -> str:
    """Least creepage in size at which no cell sticks; a dash if there is none."""
    slides = np.abs(here["creepage"].values[here["slip_fraction"].values == 1])
    return _percent(float(slides.min())) if slides.size else "-"


def _percent(creepage: float) -> str:
    return f"{100 * creepage:.4g} %"
