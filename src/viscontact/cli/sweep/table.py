"""Summary table of several runs, one row each."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import Literal

import numpy as np
import xarray as xr
from rich.box import SIMPLE_HEAD
from rich.measure import Measurement
from rich.table import Table

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.cli.terminal.console import TextConsole
from viscontact.results.formatting import format_percent, format_supported
from viscontact.results.netcdf import open_results
from viscontact.results.run_axis import run_axis
from viscontact.results.shown_scalars import shown_scalars
from viscontact.results.stated_errors import largest_error, mesh_dependent
from viscontact.results.variables import SCALARS, Place, shown_in
from viscontact.results.verdicts import deciding, overall, verdicts
from viscontact.runs.processes.child import Ended
from viscontact.studies.sweep.states import state_at_end
from viscontact.units.formatting import ReadableUnit, format_quantity, readable_unit

#: Largest number of runs named with a warning.
_NAMED = 3

#: Where the name of a run goes on in the next line: before a value, which is not cut.
_AT_VALUE = re.compile(r"(?<==)(?=\S)")


@dataclass(frozen=True)
class _RunValues:
    """Results of a run: largest values [SI], their error, computing time [s] and warnings."""

    over: str  # axis of the result
    largest: dict[str, float]
    marked: frozenset[str]  # scalars that depend on the mesh at any instant
    error: float  # largest relative one [-], nan if unknown, inf if it depends on the mesh
    uncertain: str  # the scalar that has it
    seconds: float
    warnings: tuple[str, ...]
    verdict: str  # the worst on the allowable values, and on what; empty without any


@dataclass(frozen=True)
class _RunColumn:
    """A column of the table: heading, and a cell for each run."""

    heading: str
    cells: Sequence[str]
    is_number: bool = True


def print_table(runs: Sequence[Ended]) -> None:
    """Print the largest values over time or speed of several runs, and their warnings."""
    found = [_values_of_run(each) for each in runs]
    console = TextConsole()
    over = " or ".join(sorted({each.over for each in found if each})) or "time"
    states, values = list(_state_columns(runs, found)), list(_value_columns(found))
    verdicts = list(_verdict_columns(found))
    names = [each.job.name for each in runs]
    title = f"largest values over {over}"
    split = (
        bool(values)
        and _width(_table(names, [*states, *values, *verdicts]), console) > console.width
    )
    groups = [[*states, *verdicts], values] if split else [[*states, *values, *verdicts]]
    if any(_width(_table(names, group), console) > console.width for group in groups):
        names = [_AT_VALUE.sub("\n", name) for name in names]
    parts = [_table(names, group, title if group is groups[-1] else None) for group in groups]
    for part in parts:
        console.print(part, end="\n" if part is parts[-1] else "\n\n")
    for line in _warnings(runs, found):
        console.warn(line, highlight=False, soft_wrap=True)


def _values_of_run(ended: Ended) -> _RunValues | None:
    """Results in the directory of a run; None without any, or of another run."""
    if ended.outcome in ("refused", "not begun"):
        return None
    try:
        with open_results(ended.job.directory) as ds:
            return _values_of(ds) if ds.sizes[run_axis(ds).name] else None
    except (OSError, ValueError, LookupError):
        return None


def _values_of(ds: xr.Dataset) -> _RunValues:
    names = shown_scalars(ds, Place.KEY)
    largest = {name: float(np.nanmax(np.abs(ds[name].values), initial=0.0)) for name in names}
    warnings = tuple(str(ds.attrs.get("warnings", "")).splitlines())
    parts = {name: each.part for name in names if (each := largest_error(ds, name)) is not None}
    known = {name: part for name, part in parts.items() if not math.isnan(part)}
    uncertain = max(known, key=known.__getitem__, default="")
    error = known.get(uncertain, math.nan)
    marked = frozenset(name for name in names if mesh_dependent(ds, name).any())
    over = run_axis(ds).name
    judged, seconds = verdicts(ds), float(ds.attrs["wall_time"])
    verdict = ": ".join(filter(None, (overall(judged), deciding(judged).replace("_", " "))))
    return _RunValues(over, largest, marked, error, uncertain, seconds, warnings, verdict)


def _table(names: Sequence[str], columns: Sequence[_RunColumn], title: str | None = None) -> Table:
    # A long name goes on in the next line before a number is cut.
    table = Table(
        box=SIMPLE_HEAD, padding=(0, 1, 0, 0), show_edge=False, title=title, title_justify="right"
    )
    table.add_column("run", overflow="fold", vertical="bottom")
    for each in columns:
        justify: Literal["left", "right"] = "right" if each.is_number else "left"
        table.add_column(each.heading, justify=justify, no_wrap=True, vertical="bottom")
    for name, *cells in zip(names, *(each.cells for each in columns), strict=True):
        table.add_row(name, *cells)
    return table


def _width(table: Table, console: TextConsole) -> int:
    """Width of a table in one piece, in characters."""
    return Measurement.get(console, console.options.update(max_width=10_000), table).maximum


def _state_columns(
    runs: Sequence[Ended], found: Sequence[_RunValues | None]
) -> Iterator[_RunColumn]:
    yield _RunColumn("state", [state_at_end(each).value for each in runs], is_number=False)
    yield _RunColumn(
        "took", [format_quantity(each.seconds, "s", 2) if each else "" for each in found]
    )


def _value_columns(found: Sequence[_RunValues | None]) -> Iterator[_RunColumn]:
    """Largest values, with their units in the heading, and the largest of their errors."""
    shown = {name for each in found if each for name in each.largest}
    for name in shown_in(Place.KEY):
        if name in shown:
            largest = max((each.largest.get(name, 0.0) for each in found if each), default=0.0)
            unit = readable_unit(SCALARS[name].units, largest)
            heading = "\n".join([*name.split("_"), *([f"[{unit.symbol}]"] if unit.symbol else [])])
            yield _RunColumn(heading, [_value(each, name, unit) if each else "" for each in found])
    errors = [math.nan if each is None else each.error for each in found]
    if not all(map(math.isnan, errors)):
        texts = [
            "" if each is None or math.isnan(each.error) else _error_text(each) for each in found
        ]
        yield _RunColumn("largest\nerror", texts)


def _error_text(found: _RunValues) -> str:
    """The largest error, and of what."""
    return f"{format_percent(found.error)} {found.uncertain.replace('_', ' ')}"


def _verdict_columns(found: Sequence[_RunValues | None]) -> Iterator[_RunColumn]:
    worst = [each.verdict if each else "" for each in found]
    if any(worst):
        yield _RunColumn("verdict", worst, is_number=False)


def _value(found: _RunValues, name: str, unit: ReadableUnit) -> str:
    """Largest value in the unit of its column; empty where an older result lacks the scalar."""
    if name not in found.largest:
        return ""
    error = math.inf if name in found.marked else math.nan
    return format_supported(found.largest[name] / unit.factor, error)


def _warnings(runs: Sequence[Ended], found: Sequence[_RunValues | None]) -> list[str]:
    """Each warning once, with the names of its runs."""
    concerned: dict[str, list[str]] = {}
    for ended, each in zip(runs, found, strict=True):
        for text in each.warnings if each else ():
            concerned.setdefault(text, []).append(ended.job.name)
    return [f"{first_names(names, _NAMED)}: {text}" for text, names in concerned.items()]


def first_names(names: Sequence[str], most: int) -> str:
    """List the first of some names, and the number of the others."""
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {more} more" if more > 0 else "")
