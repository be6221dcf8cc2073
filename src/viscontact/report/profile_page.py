"""Free profile of a roller as a page, with the named ones under the same loads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.drawing.matplotlib.sweeps.design import profiles
from viscontact.drawing.svg.html import element
from viscontact.report.creep_gains import gains_over_a_year
from viscontact.report.design_page import before_and_after
from viscontact.report.page_elements import drawn_figure, listed_notes, text_table, value_cell
from viscontact.report.study_page import StudyPage
from viscontact.results.variables import SCALARS, error_name
from viscontact.units.formatting import format_quantity


def write_profile_report(
    table: xr.Dataset,
    runs: Mapping[str, xr.Dataset],
    path: str | Path,
    *,
    title: str,
    headline: str,
    years: Mapping[str, xr.Dataset | str] | None = None,
) -> None:
    """Write a free profile and the named ones under the same loads as one page of HTML.

    `runs` are results with fields by their names, in the scenario that decides, `years` such
    results up to a year, or why there is none; `headline` is the sentence of the result. OSError if
    the file cannot be written.
    """
    drawing = drawn_figure(profiles(table), "Drop of the profiles below their highest point.")
    chapters = {
        "Profiles": [drawing, *_tables(table)],
        "Before and after": list(before_and_after(runs)),
        "Gain over a year of creep": gains_over_a_year(table, runs, years, ["peak_pressure"]),
    }
    head = element("p", headline, class_="headline"), listed_notes(table)
    StudyPage(title, head, chapters).write(path)


def _tables(table: xr.Dataset) -> Iterator[Element]:
    """Peak pressures of the profiles, in all scenarios, and within the production tolerance."""
    scenarios = table["scenario"].values.tolist() if table.sizes["scenario"] > 1 else []
    rows = []
    for name in table["profile"].values.tolist():
        row = table.sel(profile=name)
        each = (_peak(row.sel(scenario=scenario), "_of_scenarios") for scenario in scenarios)
        rows.append((name, str(row["parameter"].values), _peak(row), *each))
    label = SCALARS["peak_pressure"].label
    yield text_table(("profile", "", label, *scenarios), rows)
    if "deviation" in table.dims:
        names = table["deviation"].values.tolist()
        peaks = (_peak(table.sel(deviation=name), "_of_deviations") for name in names)
        within = format_quantity(float(table.attrs["drop_tolerance"]), "m", 3)
        yield element("p", f"The free profile within ± {within} of its drop:")
        yield text_table(("deviation", label), zip(names, peaks, strict=True))


def _peak(row: xr.Dataset, suffix: str = "") -> str:
    name = f"peak_pressure{suffix}"
    return "no limit" if np.isposinf(row[error_name(name)]) else value_cell(row, name, "Pa")
