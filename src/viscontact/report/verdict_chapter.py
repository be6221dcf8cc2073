"""Chapter of a report on the allowable values of its case."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import xarray as xr

from viscontact.drawing.matplotlib.histories.margins import margin_history
from viscontact.report.page_elements import drawn_figure, remark, stacked_table
from viscontact.results.run_axis import run_axis
from viscontact.results.verdicts import Verdict, verdicts

#: Headings of the table.
HEADINGS = ("quantity", "largest magnitude", "at", "allowable", "margin", "verdict")


def verdict_rows(ds: xr.Dataset) -> list[tuple[str, ...]]:
    """Rows of the table of verdicts; empty without allowable values."""
    return [_row(ds, each) for each in verdicts(ds)]


def verdict_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the table of verdicts, if the case has allowable values."""
    rows = verdict_rows(ds)
    if not rows:
        return
    yield stacked_table(HEADINGS, rows, judged=True)
    yield remark(LEGEND)
    try:
        drawn = margin_history(ds)
    except ValueError:  # over speed, or without a margin of a scalar
        return
    yield drawn_figure(drawn, "Margin of each scalar with its error, over time.")


#: Meaning of the verdicts.
LEGEND = (
    "Passed: every magnitude of the run with its error is within the limit. Failed: one of them "
    "less its error is beyond it, or one that depends on the mesh. Otherwise undecided. Margin: "
    "the part of the limit that the magnitude with its error leaves."
)


def _row(ds: xr.Dataset, each: Verdict) -> tuple[str, ...]:
    at = run_axis(ds).place(each.at) if each.found else ""
    outcome = f"{each.verdict}: {each.reason}" if each.reason else each.verdict
    return each.label, each.found, at, each.allowed, each.shown_margin, outcome
