"""Elements of a page of HTML: drawn figures, tables of texts, lists and notes."""

from __future__ import annotations

import base64
from collections.abc import Collection, Iterable, Sequence
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.saving import as_svg
from viscontact.drawing.svg.html import element
from viscontact.results.formatting import format_with_error
from viscontact.results.variables import error_name


def drawn_figure(drawn: Figure, caption: str, about: str = "") -> Element:
    """Figure as a drawing within the page, with its caption; one of a column stays narrow."""
    drawing = base64.b64encode(as_svg(drawn)).decode()
    image = element("img", src=f"data:image/svg+xml;base64,{drawing}", alt=about or caption)
    frame = element("div", image, class_="scroll")
    return element("figure", frame, element("figcaption", caption), **width_of(drawn))


def width_of(drawn: Figure) -> dict[str, str]:
    """Class of a figure that stays narrow, one column wide."""
    return {"class": "single"} if drawn.get_figwidth() <= style.ONE_COLUMN else {}


def remark(*content: str | Element) -> Element:
    """Remark in faint letters."""
    return element("p", *content, class_="faint")


def facts(pairs: Iterable[tuple[str, str]]) -> Element:
    """Names and values as tiles."""
    tiles = (element("div", element("dt", name), element("dd", value)) for name, value in pairs)
    return element("dl", *tiles, class_="facts")


def listed(lines: Iterable[str]) -> Element | None:
    """List of warnings, without the empty ones; None without any."""
    items = [element("li", line) for line in lines if line]
    return element("div", element("ul", *items), class_="warnings") if items else None


def listed_notes(table: xr.Dataset) -> Element | None:
    """List of the lines of the attribute `notes`; None without any."""
    return listed(str(table.attrs.get("notes", "")).splitlines())


def text_table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> Element:
    """Table of texts."""
    heads = element("tr", *(element("th", text) for text in head))
    body = [element("tr", *(element("td", text) for text in row)) for row in rows]
    table = element("table", element("thead", heads), element("tbody", *body))
    return element("div", table, class_="scroll")


def stacked_table(
    head: Sequence[str],
    rows: Iterable[Sequence[str]],
    *,
    numbers: Collection[int] = (),
    judged: bool = False,
    kind: str = "",
) -> Element:
    """Table whose rows become lists on a narrow page; `numbers` are the columns of numbers."""
    last = len(head) - 1 if judged else len(head)

    def cell(column: int, text: str) -> Element:
        if column == 0:
            return element("th", text, scope="row")
        name = "number" if column in numbers else text.split(":")[0] if column == last else None
        about = {} if name is None else {"class": name}
        return element("td", text, **about, data_head=head[column])

    heads = (
        element("th", text, **({"class": "number"} if column in numbers else {}))
        for column, text in enumerate(head)
    )
    body = (element("tr", *(cell(*each) for each in enumerate(row))) for row in rows)
    parts = element("thead", element("tr", *heads)), element("tbody", *body)
    table = element("table", *parts, class_=f"stacked {kind}".rstrip())
    return element("div", table, class_="scroll verdicts" if judged else "scroll")


def value_cell(of: xr.Dataset, name: str, units: str, unknown: str = "") -> str:
    """Single value of a dataset with its error, both in SI."""
    value, error = float(of[name]), float(of[error_name(name)])
    return unknown if np.isnan(value) else format_with_error(value, error, units)
