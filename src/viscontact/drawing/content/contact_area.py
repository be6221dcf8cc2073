"""Contact area over time, traced between the cells and by counting them, and areas of spots."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.along_run import along_run, within_span
from viscontact.drawing.content.history import limits_around
from viscontact.drawing.content.panel import FIRST, SECOND, Axis, Curve, Ink, Panel
from viscontact.results.contact_spots import spots_of
from viscontact.results.leakage.of_case import gaps_in_words
from viscontact.results.recorded_case import recorded_grid
from viscontact.results.recorded_theory import area_of_theory, recorded_surface
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


def area_panel(
    results: xr.Dataset, times: ArrayLike | None, figure: str, *, theory: bool = False
) -> Panel:
    """Panel of the area with its error, of the counted cells, and of Persson's theory."""
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
    others: tuple[Curve, ...] = ()
    if theory:
        persson = recorded_grid(results).area * _theory_over(run, results, figure)
        others = (Curve(instants, persson, "theory", SECOND, "dashed"),)
    y = Axis.of(SCALARS[_NAME].label, SCALARS[_NAME].units, area, counted)
    limits = limits_around([smooth, cells, *others])
    # The line is above the dots, of which there may be many.
    return Panel(along_run([run]), Axis(y.quantity, y.unit, limits), (cells, *others, smooth))


def _area_of_cells(snapshot: Snapshot) -> float:
    """Area of the cells in contact [m²]."""
    dx, dy = snapshot.cell_size
    return int(snapshot.in_contact.sum()) * dx * dy


def pressure_panel(
    results: xr.Dataset, times: ArrayLike | None, figure: str, *, theory: bool
) -> Panel:
    """Panel of the real over the nominal area over the nominal pressure, and of the theory."""
    run = within_span(results, (_NAME, "force", "approach"), times, figure, "")
    recorded_surface(results, figure)  # refuses what has no nominal pressure
    whole = recorded_grid(results).area
    pressure = np.asarray(run["force"].values, dtype=np.float64) / whole
    error = stated_error(run, _NAME)
    computed = Curve(
        *(pressure, run[_NAME].values / whole, "computed", FIRST, "joined"),
        error=None if error is None else error / whole,
    )
    curves = [computed]
    if theory:
        order = np.argsort(pressure)
        exact = _theory_over(run, results, figure)[order]
        curves.insert(0, Curve(pressure[order], exact, "theory", SECOND, "dashed"))
    x = Axis.of("Force over nominal area", "Pa", pressure)
    y = Axis("Real over nominal area", ReadableUnit("-", 1.0))
    return Panel(x, y, tuple(curves), name="area-pressure")


def spots_panel(
    results: xr.Dataset, times: ArrayLike | None, figure: str, *, theory: bool = False
) -> Panel:
    """Panel of the number of spots of an area or larger at some instants, named with the share."""
    snapshots = [each for each in take_snapshots(results, times, figure) if each.touching]
    found = [spots_of(results, each) for each in snapshots]
    inks = [Ink("ordered", place) for place in np.linspace(0.0, 1.0, len(found)).tolist()]
    asides = _theory_of_spots(results, snapshots, figure) if theory else [""] * len(found)
    curves = tuple(
        Curve(
            *(spots.areas, np.arange(1.0, spots.number + 1)),
            f"{label}: {spots.number}, {format_number(100 * spots.fraction, 3)} %{aside}",
            *(ink, "joined"),
        )
        for label, spots, ink, aside in zip(labels_of(snapshots), found, inks, asides, strict=True)
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
        title="\n".join([*gaps_in_words(results), f"number of spots, contact in % of the {of}"]),
    )


def _theory_over(run: xr.Dataset, results: xr.Dataset, figure: str) -> Floats:
    """Real over nominal area of the theory in a span of a result."""
    return area_of_theory(results, figure)[np.isin(results["time"].values, run["time"].values)]


def _theory_of_spots(results: xr.Dataset, snapshots: Sequence[Snapshot], figure: str) -> list[str]:
    """Real over nominal area of the theory at some instants, behind the computed one."""
    times, areas = results["time"].values, area_of_theory(results, figure)
    rows = [int(np.abs(times - each.time).argmin()) for each in snapshots]
    return [f" (theory {format_number(100 * float(areas[row]), 3)} %)" for row in rows]
