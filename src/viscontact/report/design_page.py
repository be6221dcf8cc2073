"""Design of a case as a page: before and after, and the trials."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.drawing.content.design import constraints_of, parameters_of, shown_scalars
from viscontact.drawing.matplotlib.histories.history import compare_histories
from viscontact.drawing.matplotlib.pressure.contact_curves import (
    compare_line_loads,
    compare_pressure_profiles,
)
from viscontact.drawing.matplotlib.sweeps.design import trade_off, trials
from viscontact.drawing.svg.html import element
from viscontact.report.creep_gains import gains_over_a_year, relative_change
from viscontact.report.page_elements import (
    drawn_figure,
    listed_notes,
    remark,
    text_table,
    value_cell,
)
from viscontact.report.study_page import StudyPage, StudyRows
from viscontact.results.sweep_axes import key_label
from viscontact.results.variables import SCALARS, error_name
from viscontact.units.formatting import format_quantity


def write_design_report(
    table: xr.Dataset,
    runs: Mapping[str, xr.Dataset],
    path: str | Path,
    *,
    title: str,
    headline: str,
    years: Mapping[str, xr.Dataset | str] | None = None,
) -> None:
    """Write the trials of a design, and its runs before and after, as one page of HTML.

    `runs` are results with fields by their names, in the scenario that decides, `years` such
    results up to a year, or why there is none; `headline` is the sentence of the result. OSError if
    the file cannot be written.
    """
    scalars = shown_scalars(table)
    drawn = (_trials_figure(table, scalar) for scalar in scalars)
    chapters = {
        "Before and after": [*_values(table), *before_and_after(runs)],
        "Gain over a year of creep": gains_over_a_year(table, runs, years, scalars),
        "Trade-off": list(_trade_off(table)) if len(_goals(table)) > 1 else [],
        "Trials": [*drawn, *_trials(table)],
    }
    head = element("p", headline, class_="headline"), listed_notes(table)
    StudyPage(title, head, chapters).write(path)


def _values(table: xr.Dataset) -> Iterator[Element]:
    """Parameters, and the goal in each scenario, before and after."""
    best = int(table.attrs["best"])
    rows = [
        (key_label(key), *(_parameter(table[key], trial) for trial in (0, best)), "")
        for key in parameters_of(table)
    ]
    for goal in _goals(table):
        if goal in table.data_vars:
            rows.extend(_values_of(table, goal, best))
    for text in constraints_of(table):
        name = text.split()[0]
        rows.append((text, *(_goal(table, name, trial) for trial in (0, best)), ""))
    yield text_table(("", "case", "best", "change"), rows)


def _goals(table: xr.Dataset) -> list[str]:
    """Names of the scalars and parameters that are to be least or largest."""
    return str(table.attrs["goal"]).split()


def _values_of(table: xr.Dataset, goal: str, best: int) -> Iterator[tuple[str, ...]]:
    """Rows of a goal, in the worst scenario and in each one."""
    label, of_scenarios = SCALARS[goal].label, f"{goal}_of_scenarios"
    yield (f"{label}, worst scenario", *_change(table, goal, goal, best))
    if table.sizes["scenario"] > 1:
        for number, name in enumerate(table["scenario"].values.tolist()):
            one = table.isel(scenario=number)
            yield (f"{label}, {name}", *_change(one, goal, of_scenarios, best))


def _change(table: xr.Dataset, goal: str, column: str, best: int) -> tuple[str, str, str]:
    """Values of a column before and after, and the change unless one of them has no limit."""
    units, ends = SCALARS[goal].units, table.isel(trial=[0, best])
    before, after = (value_cell(ends.isel(trial=end), column, units) for end in (0, 1))
    has_limit = not np.isposinf(ends[error_name(column)].values).any()
    change = relative_change(*ends[column].values.tolist()) if has_limit else ""
    return before, after, change


def _goal(table: xr.Dataset, name: str, trial: int) -> str:
    return value_cell(table.isel(trial=trial), name, SCALARS[name].units)


def _parameter(column: xr.DataArray, trial: int) -> str:
    value: Any = column.values[trial]
    if not np.issubdtype(column.dtype, np.number):
        return str(value)
    return format_quantity(float(value), str(column.attrs.get("units", "1")), 5)


def before_and_after(runs: Mapping[str, xr.Dataset]) -> Iterator[Element]:
    """Pressure and line load at the first and the last instant, and the scalars over time."""
    if not runs:
        return
    for draw, caption in (
        (
            compare_pressure_profiles,
            "Pressure along x in the scenario that decides, first and last instant.",
        ),
        (compare_line_loads, "Line load: the pressure integrated over y."),
        (compare_histories, "Over time, as the body creeps."),
    ):
        is_history = draw is compare_histories
        if is_history and any(run.sizes.get("time", 1) < 3 for run in runs.values()):
            continue
        try:
            yield drawn_figure(draw(runs), caption)
        except ValueError as error:  # no contact at these instants
            yield remark(f"{caption} Not drawn: {error}")


def _trials_figure(table: xr.Dataset, scalar: str) -> Element:
    caption = f"{SCALARS[scalar].label} in the worst scenario over each parameter."
    return drawn_figure(trials(table, scalar=scalar), caption)


def _trade_off(table: xr.Dataset) -> Iterator[Element]:
    """Figure and table of the trials that are not dominated."""
    yield drawn_figure(
        trade_off(table), "Trials of which no other one is better in one and as good in the others."
    )
    front = table.isel(trial=table["on_front"].values).sortby(_goals(table)[0])
    rows = ((str(front["trial"].values[n]), *_trial(front, n)) for n in range(front.sizes["trial"]))
    yield text_table(("trial", *_labels(table)), rows)


def _trials(table: xr.Dataset) -> Iterator[Element]:
    """Table of all trials."""
    found = trial_rows(table)
    yield text_table(found.head, found.rows)


def trial_rows(table: xr.Dataset) -> StudyRows:
    """Return the table of all trials: cells, parameters, scalars with their errors, and states."""
    rows = []
    for number in range(table.sizes["trial"]):
        trial = table.isel(trial=number)
        has_limit = not any(np.isposinf(trial[error_name(name)]) for name in shown_scalars(table))
        why = str(trial["message"].values) or ("not feasible" if has_limit else "no limit")
        state = "feasible" if trial["feasible"] else why
        rows.append((str(number), str(trial["level"].values), *_trial(table, number), state))
    head = ("trial", "cells", *_labels(table), "")
    return StudyRows(head, rows, range(2, len(head) - 1))


def _labels(table: xr.Dataset) -> list[str]:
    """Headings of the parameters and of the scalars."""
    scalars = (SCALARS[name].label for name in shown_scalars(table))
    return [*map(key_label, parameters_of(table)), *scalars]


def _trial(table: xr.Dataset, number: int) -> list[str]:
    """Parameters and scalars of a trial."""
    values = (_parameter(table[key], number) for key in parameters_of(table))
    return [*values, *(_goal(table, name, number) for name in shown_scalars(table))]
