"""Free profile of a roller as one page of HTML, with the named ones under the same loads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib.resources import files
from pathlib import Path
from string import Template
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact import __version__
from viscontact.notebook.html import element, written
from viscontact.plot.sweeps.profiles import profiles
from viscontact.report.blocks import drawn_figure, listed_notes, text_table
from viscontact.report.creep_gains import gains_over_a_year
from viscontact.report.design_page import before_and_after
from viscontact.results.formatting import format_with_error
from viscontact.results.variables import SCALARS
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
    folder = files("viscontact.report")
    template = Template((folder / "sweep.html").read_text(encoding="utf-8"))
    page = template.substitute(
        generator=f"viscontact {__version__}",
        title=written(element("title", title)),
        style=(folder / "page.css").read_text(encoding="utf-8"),
        body="\n".join(map(written, _chapters(table, runs, years or {}, title, headline))),
        scripts="",
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
    drawing = drawn_figure(profiles(table), "Drop of the profiles below their highest point.")
    yield element("section", element("h2", "Profiles"), drawing, *_tables(table))
    yield element("section", element("h2", "Before and after"), *before_and_after(runs))
    if years:
        end, known = float(runs["free"]["time"][-1]), str(table.attrs.get("notes", ""))
        gains = gains_over_a_year(years, ["peak_pressure"], end, known)
        yield element("section", element("h2", "Gain over a year of creep"), *gains)
    yield element("p", f"Made by viscontact {__version__}.", class_="faint")


def _tables(table: xr.Dataset) -> Iterator[Element]:
    """Peak pressures of the profiles, in all scenarios, and within the production tolerance."""
    scenarios = table["scenario"].values.tolist() if table.sizes["scenario"] > 1 else []
    rows = []
    for name in table["profile"].values.tolist():
        row = table.sel(profile=name)
        each = [_peak(row.sel(scenario=scenario), "_of_scenarios") for scenario in scenarios]
        rows.append((name, str(row["parameter"].values), _peak(row), *each))
    label = SCALARS["peak_pressure"].label
    yield text_table(("profile", "", label, *scenarios), rows)
    if "deviation" in table.dims:
        names = table["deviation"].values.tolist()
        found = [_peak(table.sel(deviation=name), "_of_deviations") for name in names]
        within = format_quantity(float(table.attrs["drop_tolerance"]), "m", 3)
        yield element("p", f"The free profile within ± {within} of its drop:")
        yield text_table(("deviation", label), list(zip(names, found, strict=True)))


def _peak(row: xr.Dataset, suffix: str = "") -> str:
    value, error = (float(row[f"peak_pressure{suffix}{end}"]) for end in ("", "_error"))
    return "no limit" if np.isposinf(error) else format_with_error(value, error, "Pa")
