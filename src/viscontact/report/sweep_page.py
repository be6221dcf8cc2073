"""Runs of a sweep as a page: states, response, and a table of the runs."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr
from plotly.graph_objects import Figure

from viscontact.drawing.matplotlib.sweeps.response import response
from viscontact.drawing.plotly.responses import responses
from viscontact.drawing.svg.html import element
from viscontact.report.page_elements import drawn_figure, facts, listed, remark, stacked_table
from viscontact.report.result_chapters import heading_of, panel
from viscontact.report.study_page import StudyPage, StudyRows
from viscontact.report.title_block import file_lines, title_lines
from viscontact.report.verdict_chapter import LEGEND
from viscontact.results.formatting import format_with_error_in
from viscontact.results.largest_values import chief_scalars, compared_scalars, largest_values
from viscontact.results.stated_errors import WHY_MESH_DEPENDENT
from viscontact.results.sweep_axes import key_label, over_of, run_dims, varied_keys
from viscontact.results.variables import variable_of
from viscontact.results.verdicts import limits_of, stated_limits
from viscontact.units.formatting import format_compact, readable_unit

#: Number with its prefix and unit, as warnings state it.
_NUMBER = re.compile(r"[-+]?\d[\d.,e+-]*\s?(?:[^\W\d_]{1,4}\b)?")
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
    return sweep_content(ds, title, interactive=True).html()


def sweep_content(ds: xr.Dataset, title: str, *, interactive: bool) -> StudyPage:
    """Content of the page of a sweep; its figures are drawings unless they are `interactive`."""
    figures = _interactive(ds) if interactive else []
    chapters = {"Response": _panels(ds, figures) if interactive else _drawing(ds)}
    if not (ds["state"] == "done").any():
        chapters = {}
    return StudyPage(
        # The title of the case with that of the sweep, or the latter alone.
        title=heading_of(ds, title) if ds.attrs.get("title") else title,
        head=[_states(ds), _reasons(ds), _changes(ds), _warnings(ds)],
        chapters={**chapters, "Runs": [*_limits(ds), *_table(ds)]},
        title_block=list(title_lines(ds, "First run started")),
        files=list(file_lines(ds)),
        figures=figures,
    )


def _limits(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the allowable values with which all runs were compared, and what a verdict means."""
    if "verdict" in ds:
        given = (" ".join(each) for each in stated_limits(ds))
        allowed = "; ".join(given) or "of each run"
        yield element("p", f"Allowable: {allowed}. The verdict of a run is its worst.")
        yield remark(LEGEND)


def _states(ds: xr.Dataset) -> Element:
    """Number of all runs, and of those in each state."""
    counts = Counter(ds["state"].values.ravel().tolist())
    numbers = {"runs": counts.total(), **dict(counts.most_common())}
    return facts((name, str(count)) for name, count in numbers.items())


def _interactive(ds: xr.Dataset) -> list[Figure]:
    try:
        return responses(ds)
    except ValueError:  # too few runs, or all alike
        return []


def _panels(ds: xr.Dataset, figures: list[Figure]) -> list[Element]:
    """Boxes of the interactive figures."""
    if not figures:
        return [remark(why_not_drawn(ds))]
    red = " Red: beyond the allowable value." if limits_of(ds) else ""
    return [
        element("noscript", element("p", "The figures of this page need JavaScript.")),
        element("div", *map(panel, figures), class_="panels"),
        remark(response_caption(ds) + red),
    ]


def _drawing(ds: xr.Dataset) -> list[Element]:
    """Drawing of the response."""
    try:
        return [drawn_figure(response(ds), response_caption(ds), "Response over the keys")]
    except ValueError:
        return [remark(why_not_drawn(ds))]


def why_not_drawn(ds: xr.Dataset) -> str:
    """Return the reason why there is no figure of the response."""
    few = int((ds["state"] == "done").sum()) < 2
    why = "One run is finished." if few else "The finished runs have the same chief values."
    return f"Not drawn: {why}"


def response_caption(ds: xr.Dataset) -> str:
    """Return the caption of the response."""
    caption = f"Largest values over {over_of(ds)}; bars are their errors."
    if any(np.isposinf(largest_values(ds, name)[1]).any() for name in compared_scalars(ds)):
        caption += f" Hollow: the value depends on the mesh ({WHY_MESH_DEPENDENT})."
    return caption


def _reasons(ds: xr.Dataset) -> Element | None:
    """List of the runs with a message; None without any."""
    return _list_of_first(messages_of(ds))


def messages_of(ds: xr.Dataset) -> list[str]:
    """Return the messages of the runs that have one, each with the name and state of its run."""
    states, messages, names = (ds[name].values.ravel() for name in ("state", "message", "name"))
    numbers = np.flatnonzero(messages != "").tolist()
    return [f"{names[run]} ({states[run]}): {messages[run]}" for run in numbers]


def _changes(ds: xr.Dataset) -> Element | None:
    """List of the runs with settings of their own; None without any."""
    if "changed" not in ds:
        return None
    names, settings = (ds[name].values.ravel() for name in ("name", "changed"))
    numbers = np.flatnonzero(settings != "").tolist()
    return _list_of_first([f"{names[run]}: with its own {settings[run]}" for run in numbers])


def _warnings(ds: xr.Dataset) -> Element | None:
    """List of the warnings of the runs; None without any."""
    return _list_of_first(warnings_of(ds))


def warnings_of(ds: xr.Dataset) -> list[str]:
    """Return the warnings of the runs: those that differ in numbers alone as one."""
    if "warnings" not in ds:
        return []
    alike: dict[str, list[tuple[str, str]]] = {}
    names = ds["name"].values.ravel()
    for name, texts in zip(names, ds["warnings"].values.ravel(), strict=True):
        for text in str(texts).splitlines():
            alike.setdefault(_NUMBER.sub("#", text), []).append((str(name), text))
    return [_stated(each) for each in alike.values()]


def _stated(warnings: list[tuple[str, str]]) -> str:
    """Sentence for warnings of runs that differ in numbers alone: that of the largest one."""
    count = len({name for name, _ in warnings})
    name, text = max(warnings, key=lambda each: _first_number(each[1]))
    return f"{name}: {text}" if count == 1 else f"{count} runs warn, as {name}: {text}"


def _first_number(text: str) -> float:
    """First number of a sentence, without its unit; 0 without one."""
    found = re.search(r"\d+(?:\.\d+)?", text)
    return float(found[0]) if found else 0.0


def _list_of_first(lines: list[str]) -> Element | None:
    """List of the first lines, and the number of the others; None without any."""
    more = len(lines) - MOST_REASONS
    return listed([*lines[:MOST_REASONS], f"... and {more} more" if more > 0 else ""])


def run_rows(ds: xr.Dataset) -> StudyRows:
    """Return the table of the runs: states, keys, and chief scalars with their errors."""
    columns = [*_key_columns(ds), *_scalar_columns(ds)]
    texts = [ds[name].values.ravel().astype(str).tolist() for name in ("run", "state")]
    texts += [cells for _, cells in columns]
    head, judged = ["run", "state", *(heading for heading, _ in columns)], "verdict" in ds
    if judged:
        head, texts = [*head, "verdict"], [*texts, _verdicts(ds)]
    rows = list(zip(*texts, strict=True))[:MOST_ROWS]
    return StudyRows(head, rows, range(2, 2 + len(columns)), judged)


def _table(ds: xr.Dataset) -> Iterator[Element]:
    found, count = run_rows(ds), ds["state"].size
    yield stacked_table(
        found.head, found.rows, numbers=found.numbers, judged=found.judged, kind="runs"
    )
    more = "" if count <= MOST_ROWS else f"The first {MOST_ROWS} of {count} runs. "
    collect = element("code", "viscontact collect")
    legend = f"{more}Largest values over {over_of(ds)}, with their errors. "
    yield remark(legend, collect, " writes all numbers to one file.")


def _verdicts(ds: xr.Dataset) -> list[str]:
    """Verdict of each run, and what it is about unless all have passed."""
    judged = ds["verdict"].values.ravel().tolist()
    if "decided_by" not in ds:
        return judged
    names = ds["decided_by"].values.ravel().tolist()
    reasons = [f": {each.replace('_', ' ')}" if each else "" for each in names]
    return [verdict + reason for verdict, reason in zip(judged, reasons, strict=True)]


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
        unit = readable_unit(variable_of(name).units, values)
        texts = [
            "" if np.isnan(value) else format_with_error_in(unit, float(value), float(error))
            for value, error in zip(values, errors, strict=True)
        ]
        yield unit.label(variable_of(name).label), texts
