"""Runs of a sweep as one page of HTML: states, response, and a table of the runs."""

from __future__ import annotations

import base64
from collections import Counter
from collections.abc import Iterator, Sequence
from importlib.resources import files
from pathlib import Path
from string import Template
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr
from plotly.graph_objects import Figure

from viscontact import __version__
from viscontact.figures.responses import responses
from viscontact.notebook.html import element, written
from viscontact.plot.layout.saving import as_svg
from viscontact.plot.sweeps.response import response
from viscontact.report.result_chapters import heading_of, panel
from viscontact.report.scripts import scripts_of
from viscontact.report.title_block import file_lines, title_lines
from viscontact.report.verdict_chapter import LEGEND
from viscontact.results.formatting import format_with_error_in
from viscontact.results.largest_values import (
    chief_scalars,
    compared_scalars,
    key_label,
    largest_values,
    over_of,
    run_dims,
    varied_keys,
)
from viscontact.results.stated_errors import WHY_MESH_DEPENDENT
from viscontact.results.variables import SCALARS
from viscontact.results.verdicts import limits_of, stated_limits
from viscontact.units.formatting import format_compact, readable_unit

#: Most rows of the table, and most runs with a message.
MOST_ROWS, MOST_REASONS = 1000, 10


def write_sweep_report(ds: xr.Dataset, path: str | Path, *, title: str) -> None:
    """Write the runs of a sweep, from `open_many`, as one page of HTML.

    OSError if the file cannot be written.
    """
    Path(path).write_text(sweep_page(ds, title=title), encoding="utf-8")


def sweep_page(ds: xr.Dataset, *, title: str) -> str:
    """Return the runs of a sweep as one page of HTML that needs nothing from outside.

    It has the title block, the number of runs in each state, a figure of the chief scalars over the
    varied keys, a row for each run, and the input files.
    """
    folder, figures = files("viscontact.report"), _interactive(ds)
    template = Template((folder / "sweep.html").read_text(encoding="utf-8"))
    return template.substitute(
        generator=f"viscontact {__version__}",
        title=written(element("title", sweep_heading(ds, title))),
        style=(folder / "page.css").read_text(encoding="utf-8"),
        body="\n".join(map(written, sweep_chapters(ds, title, figures))),
        scripts=scripts_of(figures),
    )


def sweep_chapters(
    ds: xr.Dataset, title: str, figures: Sequence[Figure] | None = None
) -> Iterator[Element]:
    """Yield title block, states, figures of the response, table of the runs, and input files.

    The response is a drawing, unless places for interactive figures are wanted.
    """
    heading = element("h1", sweep_heading(ds, title))
    yield from title_lines(ds, "First run started")
    yield element("header", heading, _states(ds), _reasons(ds), _changes(ds))
    if (ds["state"] == "done").any():
        response = _figure(ds) if figures is None else _panels(ds, figures)
        yield element("section", element("h2", "Response"), *response)
    yield element("section", element("h2", "Runs"), *_limits(ds), *_table(ds))
    if files := list(file_lines(ds)):
        yield element("section", *files)
    yield element("p", f"Made by viscontact {__version__}.", class_="faint")


def sweep_heading(ds: xr.Dataset, title: str) -> str:
    """Heading of a sweep: the title of its case with that of the sweep, or the latter alone.

    >>> sweep_heading(xr.Dataset(attrs={"title": "Ball"}), "forces")
    'Ball (forces)'
    """
    return heading_of(ds, title) if ds.attrs.get("title") else title


def _limits(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the allowable values with which all runs were compared, and what a verdict means."""
    if "verdict" in ds:
        given = (" ".join(each) for each in stated_limits(ds))
        allowed = "; ".join(given) or "of each run"
        yield element("p", f"Allowable: {allowed}. The verdict of a run is its worst.")
        yield element("p", LEGEND, class_="faint")


def _states(ds: xr.Dataset) -> Element:
    """Number of all runs, and of those in each state."""
    counts = Counter(ds["state"].values.ravel().tolist())
    facts = {"runs": counts.total(), **dict(counts.most_common())}
    tiles = (
        element("div", element("dt", name), element("dd", str(count)))
        for name, count in facts.items()
    )
    return element("dl", *tiles, class_="facts")


def _interactive(ds: xr.Dataset) -> list[Figure]:
    try:
        return responses(ds)
    except ValueError:  # too few runs, or all alike
        return []


def _panels(ds: xr.Dataset, figures: Sequence[Figure]) -> Iterator[Element]:
    """Places of the interactive figures."""
    if not figures:
        yield _not_drawn(ds)
        return
    yield element("noscript", element("p", "The figures of this page need JavaScript."))
    yield element("div", *map(panel, figures), class_="panels")
    red = " Red: beyond the allowable value." if limits_of(ds) else ""
    yield element("p", _caption(ds) + red, class_="faint")


def _figure(ds: xr.Dataset) -> Iterator[Element]:
    """Drawing of the response."""
    try:
        drawing = base64.b64encode(as_svg(response(ds))).decode()
    except ValueError:
        yield _not_drawn(ds)
        return
    image = element("img", src=f"data:image/svg+xml;base64,{drawing}", alt="Response over the keys")
    said = element("figcaption", _caption(ds))
    yield element("figure", element("div", image, class_="scroll"), said)


def _not_drawn(ds: xr.Dataset) -> Element:
    few = int((ds["state"] == "done").sum()) < 2
    why = "One run is finished." if few else "The finished runs have the same chief values."
    return element("p", f"Not drawn: {why}", class_="faint")


def _caption(ds: xr.Dataset) -> str:
    said = f"Largest values over {over_of(ds)}; bars are their errors."
    if any(np.isposinf(largest_values(ds, name)[1]).any() for name in compared_scalars(ds)):
        said += f" Hollow: the value depends on the mesh ({WHY_MESH_DEPENDENT})."
    return said


def _reasons(ds: xr.Dataset) -> Element | None:
    """List of the runs with a message; None without any."""
    states, messages, names = (ds[name].values.ravel() for name in ("state", "message", "name"))
    numbers = np.flatnonzero(messages != "").tolist()
    return _listed([f"{names[run]} ({states[run]}): {messages[run]}" for run in numbers])


def _changes(ds: xr.Dataset) -> Element | None:
    """List of the runs with settings of their own; None without any."""
    if "changed" not in ds:
        return None
    names, settings = (ds[name].values.ravel() for name in ("name", "changed"))
    numbers = np.flatnonzero(settings != "").tolist()
    return _listed([f"{names[run]}: with its own {settings[run]}" for run in numbers])


def _listed(lines: list[str]) -> Element | None:
    """List of the first lines; None without any."""
    if not lines:
        return None
    said = lines[:MOST_REASONS]
    if (more := len(lines) - MOST_REASONS) > 0:
        said.append(f"... and {more} more")
    return element("div", element("ul", *(element("li", text) for text in said)), class_="warnings")


def _table(ds: xr.Dataset) -> Iterator[Element]:
    columns = [*_key_columns(ds), *_scalar_columns(ds)]
    judged = ds["verdict"].values.ravel().tolist() if "verdict" in ds else None
    reasons = _deciding(ds)
    states, runs = ds["state"].values.ravel(), ds["run"].values.ravel()
    rows = [
        element(
            "tr",
            element("th", str(runs[run])),
            element("td", str(states[run]), data_head="state"),
            *(
                element("td", texts[run], class_="number", data_head=heading)
                for heading, texts in columns
            ),
            element("td", judged[run] + reasons[run], class_=judged[run], data_head="verdict")
            if judged
            else None,
        )
        for run in range(min(states.size, MOST_ROWS))
    ]
    heads = (element("th", heading, class_="number") for heading, _ in columns)
    last = element("th", "verdict") if judged else None
    head = element("tr", element("th", "run"), element("th", "state"), *heads, last)
    table = element("table", element("thead", head), element("tbody", *rows), class_="stacked runs")
    yield element("div", table, class_="scroll verdicts" if judged else "scroll")
    more = "" if states.size <= MOST_ROWS else f"The first {MOST_ROWS} of {states.size} runs. "
    collect = element("code", "viscontact collect")
    legend = f"{more}Largest values over {over_of(ds)}, with their errors. "
    yield element("p", legend, collect, " writes all numbers to one file.", class_="faint")


def _deciding(ds: xr.Dataset) -> list[str]:
    """What the verdict of each run is about, behind a colon; empty if all have passed."""
    if "decided_by" not in ds:
        return ds["state"].size * [""]
    names = ds["decided_by"].values.ravel().tolist()
    return [f": {each.replace('_', ' ')}" if each else "" for each in names]


def _key_columns(ds: xr.Dataset) -> Iterator[tuple[str, list[str]]]:
    """Heading and cells of each varied key; names where no key is varied."""
    keys = varied_keys(ds)
    if not keys:
        yield "Name", [str(name) for name in ds["name"].values.ravel()]
    for key in keys:
        values = xr.broadcast(ds[key], ds["state"])[0].transpose(*run_dims(ds)).values.ravel()
        if not np.issubdtype(values.dtype, np.number):
            yield key_label(key), [str(value) for value in values]
            continue
        unit = readable_unit(ds[key].attrs.get("units", "1"), values)
        texts = [format_compact(value, 4) if np.isfinite(value) else "" for value in unit(values)]
        yield unit.label(key_label(key)), texts


def _scalar_columns(ds: xr.Dataset) -> Iterator[tuple[str, list[str]]]:
    """Heading and cells of each chief scalar, of those that differ if there are any."""
    for name in compared_scalars(ds) or chief_scalars(ds):
        values, errors = (each.values.ravel() for each in largest_values(ds, name))
        unit = readable_unit(SCALARS[name].units, values)
        texts = [
            "" if np.isnan(value) else format_with_error_in(unit, float(value), float(error))
            for value, error in zip(values, errors, strict=True)
        ]
        yield unit.label(SCALARS[name].label), texts
