"""Gains of a design over a week and a year of creep, as a table of its report."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import itemgetter
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.drawing.svg.html import element
from viscontact.report.page_elements import remark, text_table
from viscontact.results.formatting import format_percent, format_with_error
from viscontact.results.stated_errors import errors_of
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import format_quantity

#: Instants that the table states where the runs have them, by their names [s].
INSTANTS = {
    **{"1 h": 3600.0, "1 day": 86400.0},
    **{"1 week": 7 * 86400.0, "1 year": 365.25 * 86400.0},
}


def gains_over_a_year(
    table: xr.Dataset,
    runs: Mapping[str, xr.Dataset],
    years: Mapping[str, xr.Dataset | str] | None,
    goals: Sequence[str],
) -> list[Element]:
    """Table of the goals of a design over a year, and remarks; empty without years."""
    # `years` are the results of two designs up to a year, the first one before, or why there is
    # none, `runs` those up to the end of the case; notes of the table are not repeated.
    found = {name: run for name, run in (years or {}).items() if isinstance(run, xr.Dataset)}
    parts = [
        remark(f"The run of the {name} stopped: {why}")
        for name, why in (years or {}).items()
        if isinstance(why, str)
    ]
    if not years or not found:
        return parts
    end = float(tuple(runs.values())[-1]["time"][-1])
    rows = [row for goal in goals for row in _rows(found, tuple(years), goal, end)]
    parts.append(text_table(("", "time", *years, "change"), rows))
    parts.append(element("p", "The load is held up to a year, in the scenario that decides."))
    after, known = tuple(found.values())[-1], str(table.attrs.get("notes", ""))
    lines = str(after.attrs.get("warnings", "")).splitlines()
    return parts + [remark(line) for line in lines if line not in known]


def _rows(
    runs: Mapping[str, xr.Dataset], names: Sequence[str], goal: str, end: float
) -> Iterator[tuple[str, ...]]:
    """Rows of a goal at the first instant, at the end of the case, and at those of `INSTANTS`."""
    times = next(iter(runs.values()))["time"].values
    chosen = {label: at for label, at in INSTANTS.items() if np.isclose(times, at, atol=0).any()}
    if not np.isclose(list(chosen.values()), end, atol=0).any():
        chosen[f"{format_quantity(end, 's', 3)} (end of the case)"] = end
    chosen[format_quantity(float(times[0]), "s", 3)] = float(times[0])
    for label, time in sorted(chosen.items(), key=itemgetter(1)):
        values = {name: _value_at(run, goal, time) for name, run in runs.items()}
        texts = (
            format_with_error(*values[name], SCALARS[goal].units) if name in values else ""
            for name in names
        )
        limited = len(values) == len(names) and not any(np.isinf(e) for _, e in values.values())
        change = relative_change(*(values[name][0] for name in names)) if limited else ""
        yield (SCALARS[goal].label, label, *texts, change)


def _value_at(run: xr.Dataset, goal: str, time: float) -> tuple[float, float]:
    """Magnitude of a goal at the instant next to a time, and its error."""
    row = int(np.abs(run["time"].values - time).argmin())
    return abs(float(run[goal].values[row])), float(errors_of(run, goal)[row])


def relative_change(before: float, after: float) -> str:
    """Relative change of a value; empty if it is not known."""
    if not (np.isfinite(before) and np.isfinite(after) and before):
        return ""
    part = after / before - 1
    return f"{'+' if part > 0 else '−'}{format_percent(abs(part))}"
