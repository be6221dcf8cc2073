"""Design of a case as one page of HTML: before and after, and the trials."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact import __version__
from viscontact.notebook.html import element, written
from viscontact.plot.histories.history import compare_histories
from viscontact.plot.pressure.line_load import compare_line_loads
from viscontact.plot.pressure.pressure_profile import compare_pressure_profiles
from viscontact.plot.sweeps.trade_off import trade_off
from viscontact.plot.sweeps.trials import parameters_of, trials
from viscontact.report.blocks import drawn_figure, listed_notes, text_table
from viscontact.report.creep_gains import gains_over_a_year, relative_change
from viscontact.results.formatting import format_with_error
from viscontact.results.largest_values import key_label
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
    folder = files("viscontact.report")
    template = Template((folder / "sweep.html").read_text(encoding="utf-8"))
    page = template.substitute(
        generator=f"viscontact {__version__}",
        title=written(element("title", title)),
        style=(folder / "page.css").read_text(encoding="utf-8"),
        scripts="",
        body="\n".join(map(written, _chapters(table, runs, years or {}, title, headline))),
    )
    Path(path).write_text(page, encoding="utf-8")


def _chapters(
    table: xr.Dataset,
    runs: Mapping[str, xr.Dataset],
    years: Mapping[str, xr.Dataset | str],
    title: str,
    headline: str,
) -> Iterator[Element]:
    yield element(
        "header",
        element("h1", title),
        element("p", headline, class_="headline"),
        listed_notes(table),
    )
    compared = (*_values(table), *before_and_after(runs))
    yield element("section", element("h2", "Before and after"), *compared)
    if years:
        end, known = float(runs["best"]["time"][-1]), str(table.attrs.get("notes", ""))
        gains = gains_over_a_year(years, _goals(table), end, known)
        yield element("section", element("h2", "Gain over a year of creep"), *gains)
    if len(_goals(table)) > 1:
        yield element("section", element("h2", "Trade-off"), *_trade_off(table))
    figures = (_trials_figure(table, goal) for goal in _goals(table))
    yield element("section", element("h2", "Trials"), *figures, *_trials(table))
    yield element("p", f"Made by viscontact {__version__}.", class_="faint")


def _values(table: xr.Dataset) -> Iterator[Element]:
    """Parameters, and the goal in each scenario, before and after."""
    best = int(table.attrs["best"])
    rows = [
        (key_label(key), *(_parameter(table[key], trial) for trial in (0, best)), "")
        for key in parameters_of(table)
    ]
    for goal in _goals(table):
        rows.extend(_values_of(table, goal, best))
    for text in filter(None, str(table.attrs.get("constraints", "")).split("; ")):
        name = text.split()[0]
        rows.append((text, *(_goal(table, name, trial) for trial in (0, best)), ""))
    yield text_table(("", "case", "best", "change"), rows)


def _goals(table: xr.Dataset) -> list[str]:
    """Names of the scalars that are to be least or largest."""
    return str(table.attrs["goal"]).split()


def _values_of(table: xr.Dataset, goal: str, best: int) -> Iterator[tuple[str, ...]]:
    """Rows of a goal, in the worst scenario and in each one."""
    worst = f"{SCALARS[goal].label}, worst scenario"
    columns = [_goal(table, goal, trial) for trial in (0, best)]
    yield (worst, *columns, _gain(table, goal, best))
    if table.sizes["scenario"] > 1:
        for number, name in enumerate(table["scenario"].values.tolist()):
            one = table.isel(scenario=number)
            columns = [_goal(one, goal, trial, "_of_scenarios") for trial in (0, best)]
            gain = _gain(one, goal, best, "_of_scenarios")
            yield (f"{SCALARS[goal].label}, {name}", *columns, gain)


def _goal(table: xr.Dataset, name: str, trial: int, suffix: str = "") -> str:
    column = f"{name}{suffix}"
    value, error = (float(table[each].values[trial]) for each in (column, error_name(column)))
    return "" if np.isnan(value) else format_with_error(value, error, SCALARS[name].units)


def _gain(table: xr.Dataset, name: str, best: int, suffix: str = "") -> str:
    """Relative change; empty where a value is not known or has no limit."""
    column = f"{name}{suffix}"
    before, after = (float(table[column].values[trial]) for trial in (0, best))
    has_limit = not np.isposinf(table[error_name(column)].values[[0, best]]).any()
    return relative_change(before, after) if has_limit else ""


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
            yield element("p", f"{caption} Not drawn: {error}", class_="faint")


def _trials_figure(table: xr.Dataset, goal: str) -> Element:
    caption = f"{SCALARS[goal].label} in the worst scenario over each parameter."
    return drawn_figure(trials(table.assign_attrs(goal=goal)), caption)


def _trade_off(table: xr.Dataset) -> Iterator[Element]:
    """Figure and table of the trials that are not dominated."""
    yield drawn_figure(
        trade_off(table), "Trials of which no other one is better in one and as good in the others."
    )
    goals, keys = _goals(table), parameters_of(table)
    front = table.isel(trial=table["on_front"].values).sortby(goals[0])
    rows = [
        (
            str(front["trial"].values[row]),
            *(_parameter(front[key], row) for key in keys),
            *(_goal(front, goal, row) for goal in goals),
        )
        for row in range(front.sizes["trial"])
    ]
    labels = [SCALARS[goal].label for goal in goals]
    yield text_table(("trial", *map(key_label, keys), *labels), rows)


def _trials(table: xr.Dataset) -> Iterator[Element]:
    """Table of all trials."""
    goals, keys = _goals(table), parameters_of(table)
    rows = []
    for trial in range(table.sizes["trial"]):
        values = [_parameter(table[key], trial) for key in keys]
        level, message = (str(table[name].values[trial]) for name in ("level", "message"))
        has_limit = not any(np.isposinf(table[error_name(goal)].values[trial]) for goal in goals)
        why = "not feasible" if has_limit else "no limit"
        state = "feasible" if table["feasible"].values[trial] else message or why
        sizes = [_goal(table, goal, trial) for goal in goals]
        rows.append((str(trial), level, *values, *sizes, state))
    labels = [SCALARS[goal].label for goal in goals]
    head = ("trial", "cells", *map(key_label, keys), *labels, "")
    yield text_table(head, rows)
