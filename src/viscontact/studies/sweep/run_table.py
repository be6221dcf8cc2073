"""Table of a sweep: a row for each run, with its settings, last and largest scalars, and state."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from typing import IO, Any

import numpy as np

from viscontact.backend.arrays import Floats, Numbers
from viscontact.results.variables import RUN_VALUES, SCALARS, Place, error_name, shown_in
from viscontact.studies.sweep.joint_layout import JointLayout, Progress
from viscontact.units.formatting import column_heading

#: Scalars of the table.
LISTED = shown_in(Place.TABLE | Place.KEY)


def write_run_table(layout: JointLayout, file: IO[str], progress: Progress) -> None:
    """Write the table of a sweep as CSV, in SI units with every digit; empty without a result."""
    writer = csv.writer(file, lineterminator="\n")
    names = [name for name in LISTED if name in layout.columns]
    writer.writerow(_header(layout, names))
    settings = [layout.axes.coords[key] for key in layout.axes.keys]
    along = [np.broadcast_to(_spread(layout, each), layout.axes.shape).ravel() for each in settings]
    for runs, values in layout.blocks():
        for run in range(runs.start, runs.stop):
            state = layout.states[run]
            about = (run, layout.runs[run].name, *(each[run].item() for each in along))
            scalars = [
                *_run_values(layout, run),
                *_scalars(layout, names, values[run - runs.start]),
            ]
            changed = [layout.runs[run].own_settings] if layout.has_changed else []
            judged = [state.verdict, state.decided_by] if layout.has_verdicts else []
            warned = [" | ".join(state.warnings)] if layout.has_warnings else []
            own = (*changed, *judged, *warned, state.message)
            writer.writerow([*about, state.state.value, *scalars, *own])
        progress(runs.stop, len(layout.runs))


def _spread(layout: JointLayout, coordinate: Any) -> Numbers:
    """Values of a coordinate over all dimensions of the runs."""
    sizes = [
        size if dim in coordinate.dims else 1
        for dim, size in zip(layout.axes.dims, layout.axes.shape, strict=True)
    ]
    return np.asarray(coordinate.values).reshape(sizes)


def _header(layout: JointLayout, names: list[str]) -> Iterator[str]:
    yield from ("run", "name")
    for key in layout.axes.keys:
        yield column_heading(key, layout.axes.coords[key].attrs.get("units", "1"))
    yield "state"
    for name in _value_names(layout):
        yield column_heading(name, RUN_VALUES[name].units)
        yield column_heading(f"error of {name}", RUN_VALUES[name].units)
    for name in names:
        for column in (name, f"largest {name}"):
            yield column_heading(column, SCALARS[name].units)
            if error_name(name) in layout.columns:
                yield column_heading(f"error of {column}", SCALARS[name].units)
    if layout.has_changed:
        yield "changed"
    if layout.has_verdicts:
        yield from ("verdict", "decided_by")
    if layout.has_warnings:
        yield "warnings"
    yield "message"


def _value_names(layout: JointLayout) -> list[str]:
    """Names of the values of whole runs that any run states."""
    return [name for name in RUN_VALUES if any(name in each for each in layout.values)]


def _run_values(layout: JointLayout, run: int) -> Iterator[float | str]:
    """Cells of the values of a whole run, each with its error."""
    for name in _value_names(layout):
        for column in (name, error_name(name)):
            yield _cell(np.array([layout.values[run].get(column, np.nan)]), 0)


def _scalars(layout: JointLayout, names: list[str], values: Floats) -> Iterator[float | str]:
    """Cells of the scalars of a run from the values of `JointLayout.names` over its instants."""
    for name in names:
        row = values[layout.names.index(name)]
        error = error_name(name)
        bars = values[layout.names.index(error)] if error in layout.columns else None
        for at in _instants(row, values[layout.names.index("force")]):
            yield _cell(row, at)
            if bars is not None:
                yield _cell(bars, at)


def _instants(row: Floats, force: Floats) -> tuple[int | None, ...]:
    """Places of the last instant, and of the largest magnitude; None without a value."""
    reached = np.flatnonzero(np.isfinite(force))
    if not reached.size:
        return None, None
    size = np.abs(row)
    largest = int(np.nanargmax(size)) if np.isfinite(row).any() else None
    return int(reached[-1]), largest


def _cell(values: Floats, at: int | None) -> float | str:
    """Value at an instant; empty without one, as a spreadsheet has no NaN."""
    value = np.nan if at is None else float(values[at])
    return "" if np.isnan(value) else value
