"""Chapter of a report on the allowable values of its case."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import xarray as xr

from viscontact.notebook.html import element
from viscontact.plot.histories.margins import margin_history
from viscontact.report.blocks import drawn_figure
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
    head = element("tr", *(element("th", text) for text in HEADINGS))
    body = (
        element(
            "tr",
            element("th", row[0], scope="row"),
            *(
                element("td", text, data_head=head)
                for head, text in zip(HEADINGS[1:-1], row[1:-1], strict=True)
            ),
            element("td", row[-1], class_=row[-1].split(":")[0], data_head=HEADINGS[-1]),
        )
        for row in rows
    )
    table = element("table", element("thead", head), element("tbody", *body), class_="stacked")
    yield element("div", table, class_="scroll verdicts")
    yield element("p", LEGEND, class_="faint")
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
