"""Title block of a report, and the files that its run has read."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import xarray as xr

from viscontact.drawing.svg.html import element
from viscontact.report.page_elements import remark
from viscontact.results.filed_case import FiledCase, started_at


def title_entries(ds: xr.Dataset, start: str = "Run started") -> list[tuple[str, str]]:
    """Entries of the title block, and date and time of the start, those that are known."""
    entries = [
        (name.capitalize(), value) for name, value in FiledCase.of(ds.attrs).title_block.items()
    ]
    started = started_at(ds.attrs)
    return [*entries, (start, started)] if started else entries


def title_lines(ds: xr.Dataset, start: str = "Run started") -> Iterator[Element]:
    """Yield the title block, if it has entries."""
    if entries := title_entries(ds, start):
        pairs = (
            element("div", element("dt", name), element("dd", value)) for name, value in entries
        )
        yield element("dl", *pairs, class_="title-block")


def file_lines(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the table of input files, if there are any."""
    files = FiledCase.of(ds.attrs).input_files
    if not files:
        return
    yield element("h3", "Input files")
    head = element("tr", *(element("th", text) for text in ("file", "used for", "SHA-256")))
    rows = (
        element(
            "tr",
            element("th", each["name"], scope="row"),
            element("td", each["role"]),
            element("td", element("code", each["sha256"])),
        )
        for each in files
    )
    table = element("table", element("thead", head), element("tbody", *rows))
    yield element("div", table, class_="scroll files")
    yield remark("As they were when the run was made.")
