"""History of a run as a table."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from textwrap import wrap

import numpy as np
from rich.box import SIMPLE, SIMPLE_HEAD
from rich.table import Table

from viscontact.backend.arrays import Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.cli.results.accuracy import accuracy_lines, has_errors, knows_errors
from viscontact.cli.results.stored import early_end
from viscontact.cli.results.stored_findings import print_stored_findings
from viscontact.cli.terminal.console import TextConsole, styled
from viscontact.cli.terminal.messages import refuse
from viscontact.results.formatting import format_error, format_percent, format_supported
from viscontact.results.recorded_case import prescribes_approach
from viscontact.results.run_axis import run_axis
from viscontact.results.shown_rows import shown_rows
from viscontact.results.stated_errors import LargestError, is_rounding, largest_error, stated_error
from viscontact.results.stored_result import Result
from viscontact.results.variables import AXES, SCALARS, Place, shown_in, shown_name
from viscontact.units.formatting import (
    format_number,
    format_quantity,
    readable_unit,
    without_trailing_zeros,
)

_ROWS = 20
_FRICTION = "friction_coefficient"
#: Blanks between columns, and the spare width below which headings are wrapped here; rich would
#: also break words.
_GAP, _TO_SPARE = 2, 8


def print_history(
    ds: Result, directory: Path, *, everything: bool = False, errors: bool = False
) -> None:
    """Print scalars over time or speed in readable units, with their errors if requested."""
    if errors and not has_errors(ds):
        refuse("--errors: the result states none; it is older, or was run with errors: false")
    console = TextConsole()
    axis = run_axis(ds)
    count = ds.sizes[axis.name]
    rows = np.arange(count) if everything else shown_rows(count, _ROWS)
    shown = _shown_scalars(ds)
    columns = _columns(ds, [axis.name, *shown], rows, errors=errors)
    least = sum(column.width + _GAP for column in columns)
    table = _table(ds, columns, narrow=least + _TO_SPARE > console.width)
    # Never truncated, even where the table is wider than the terminal.
    console.print(table, crop=False)
    if len(rows) < count:
        console.print(f"{len(rows)} of {count} {axis.row}s; --all shows every one")
    for line in _footers(ds, shown, errors=errors):
        console.print(line, highlight=False)
    print_stored_findings(console, ds, directory)
    if ended := early_end(ds):
        console.print(styled(ended, "yellow"), soft_wrap=True)
    for line in str(ds.attrs.get("warnings", "")).splitlines():
        console.warn(line)


def _shown_scalars(ds: Result) -> list[str]:
    """Scalars of the table; over speed with the friction, and without a constant force."""
    shown = [name for name in shown_in(Place.TABLE, ds) if not is_rounding(ds, name)]
    if run_axis(ds).is_history:
        return shown
    left_out = () if prescribes_approach(ds) else (shown_name("force", ds),)
    friction = () if is_rounding(ds, _FRICTION) else (_FRICTION,)
    return [*friction, *(name for name in shown if name not in left_out)]


def _footers(ds: Result, shown: list[str], *, errors: bool) -> Iterator[str]:
    """Lines about the loss per cycle and about errors."""
    if not run_axis(ds).is_history and not prescribes_approach(ds):
        force = shown_name("force", ds)
        level = format_quantity(float(ds[force][0]), SCALARS[force].units)
        yield f"{force.replace('_', ' ')}: {level} at each speed"
    loss = shown_name("loss_per_cycle", ds)
    losses = ds[loss].values if loss in ds else np.empty(0)
    # The loss of a cycle is repeated until the next cycle is complete.
    known = losses[np.isfinite(losses)]
    if known.size:
        first, last = (format_quantity(float(each), SCALARS[loss].units) for each in known[[0, -1]])
        several = f"{first} in the first cycle, {last} in the last"
        yield f"loss per cycle: {last if np.ptp(known) == 0 else several}{_loss_error(ds)}"
    if knows_errors(ds, shown):
        legend = "largest error: of the whole run, in % of the largest value"
        yield (
            f"{legend}; ±: at that {run_axis(ds).row}"
            if errors
            else f"{legend}; --errors shows each one"
        )
    yield from accuracy_lines(ds, shown)


def _loss_error(ds: Result) -> str:
    found = largest_error(ds, "loss_per_cycle")
    return f", within {format_percent(found.part)}" if found and np.isfinite(found.part) else ""


def _largest_value(ds: Result, name: str) -> float:
    return float(np.nanmax(np.abs(ds[name].values), initial=0.0))


@dataclass(frozen=True)
class _HistoryColumn:
    """Column of the table: words of its heading, cells and footer."""

    head: tuple[str, ...]
    cells: list[str]
    foot: str

    @property
    def width(self) -> int:
        """Width of its longest word."""
        lines = (line for cell in self.cells for line in cell.splitlines())
        return max(map(len, (*self.head, *lines, *self.foot.splitlines())))


def _columns(ds: Result, names: list[str], rows: Integers, *, errors: bool) -> list[_HistoryColumn]:
    columns, axis = [], run_axis(ds)
    for name in names:
        largest = _largest_value(ds, name)
        if largest == 0:  # the time of a run with a single instant at 0
            continue
        unit = readable_unit(axis.unit if name == axis.name else SCALARS[name].units, largest)
        foot = "largest\nerror" if name in AXES else _error_in_percent(largest_error(ds, name))
        cells = _cells(ds, name, rows, unit.factor, errors=errors)
        head = unit.label(name.replace("_", " ")).split()
        columns.append(_HistoryColumn(tuple(head), cells, foot))
    return columns


def _table(ds: Result, columns: list[_HistoryColumn], *, narrow: bool) -> Table:
    stated = any(column.foot not in ("", format_error(np.nan)) for column in columns[1:])
    # Narrow enough for nine columns on eighty characters.
    table = Table(
        box=SIMPLE if stated else SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
        show_edge=False,
        show_footer=stated,
        title=ds.attrs.get("title") or None,
    )
    for each in columns:
        head = " ".join(each.head)
        head = "\n".join(wrap(head, each.width)) if narrow else head
        table.add_column(head, each.foot, justify="right", min_width=each.width)
    for row in zip(*(column.cells for column in columns), strict=True):
        table.add_row(*row)
    return table


def _cells(ds: Result, name: str, rows: Integers, factor: float, *, errors: bool) -> list[str]:
    values, error = ds[name].values[rows] / factor, stated_error(ds, name)
    if name in AXES:
        # Adaptive steps are short at first: "0.005" takes less space than "0.005000".
        times = [without_trailing_zeros(format_number(float(value))) for value in values]
        return [f"{time}\n" for time in times] if errors else times
    if error is None:
        return [format_number(float(value)) for value in values]
    bars = error[rows] / factor
    pairs = [(float(v), float(e)) for v, e in zip(values, bars, strict=True)]
    largest = _largest_value(ds, name) / factor
    numbers = [format_supported(*pair, largest=largest) for pair in pairs]
    if not errors:
        return numbers
    # Below its number; none where the number is a dash.
    below = ("" if np.isnan(value) else format_error(bar) for value, bar in pairs)
    return [f"{number}\n{bar}" for number, bar in zip(numbers, below, strict=True)]


def _error_in_percent(found: LargestError | None) -> str:
    if found is None:
        return ""
    if not np.isfinite(found.half_width):
        return format_error(found.half_width)
    percent = format_percent(found.part).replace(" ", "")
    return percent if percent.startswith("<") else f"±{percent}"
