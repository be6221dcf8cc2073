"""Blocks of a page of HTML: drawn figures, tables of texts, and notes."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from xml.etree.ElementTree import Element

import xarray as xr
from matplotlib.figure import Figure

from viscontact.notebook.html import element
from viscontact.plot.layout import style
from viscontact.plot.layout.saving import as_svg


def drawn_figure(drawn: Figure, caption: str) -> Element:
    """Figure as a drawing within the page, with its caption; one of a column stays narrow."""
    drawing = base64.b64encode(as_svg(drawn)).decode()
    image = element("img", src=f"data:image/svg+xml;base64,{drawing}", alt=caption)
    frame = element("div", image, class_="scroll")
    is_narrow = drawn.get_figwidth() <= style.ONE_COLUMN
    width = {"class": "single"} if is_narrow else {}
    return element("figure", frame, element("figcaption", caption), **width)


def text_table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> Element:
    """Table of texts."""
    heads = element("tr", *(element("th", text) for text in head))
    body = [element("tr", *(element("td", text) for text in row)) for row in rows]
    table = element("table", element("thead", heads), element("tbody", *body))
    return element("div", table, class_="scroll")


def listed_notes(table: xr.Dataset) -> Element | None:
    """List of the lines of the attribute `notes`; None without any."""
    notes = [line for line in str(table.attrs.get("notes", "")).splitlines() if line]
    if not notes:
        return None
    lines = element("ul", *(element("li", note) for note in notes))
    return element("div", lines, class_="warnings")
