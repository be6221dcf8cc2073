"""Overview of an object: a title, drawings, and a table of names and values."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.etree.ElementTree import Element

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.svg.html import element, written
from viscontact.units.visible import visible

_BOX = "display:flex;flex-wrap:wrap;gap:4px 20px;align-items:flex-start;margin:2px 0 8px"
_TABLE = "border-collapse:collapse;font-size:13px;margin:0"
_CELL = "text-align:left;padding:2px 14px 2px 0;border:0;vertical-align:top;background:none"
_NAME = f"{_CELL};font-weight:400;opacity:.72;white-space:nowrap"
_WRAP = f"{_CELL};max-width:34em;white-space:normal"

Rows = Sequence[tuple[str, ...]]


@dataclass(frozen=True)
class Overview:
    """Title, table and drawings of one object."""

    title: str
    rows: Rows  # of the table: a name, and one value or more
    drawings: Sequence[Element] = ()  # to the left of the table
    heads: tuple[str, ...] = ()  # of the columns of values; none for a single column
    lead: str = ""  # sentence below the title

    def text(self) -> str:
        """Write title, sentence and table for a terminal."""
        table = [("", *self.heads), *self.rows] if self.heads else list(self.rows)
        columns = max((len(row) for row in table), default=0)
        widths = [max(len(row[k]) for row in table if k < len(row)) for k in range(columns)]
        lines = [
            "  " + "  ".join(each.ljust(width) for each, width in zip(row, widths, strict=False))
            for row in table
        ]
        texts = filter(None, [self.title, self.lead, *lines])
        return visible("\n".join(line.rstrip() for line in texts))

    def element(self) -> Element:
        """The overview in HTML: drawings, and the table to their right."""
        title = element("div", self.title, style="font-weight:600;margin:2px 0")
        lead = element("div", self.lead, style="margin:0 0 4px;max-width:60em")
        head = (
            element("tr", *(element("th", text, style=_NAME) for text in ("", *self.heads)))
            if self.heads
            else None
        )
        table = element("table", head, *map(_row, self.rows), style=_TABLE)
        figures = (element("div", each) for each in self.drawings)
        box = element("div", *figures, element("div", table) if self.rows else None, style=_BOX)
        return element("div", title, lead if self.lead else None, box)


def as_html(overviews: Iterable[Overview]) -> str:
    """Write overviews, one below the other, as a piece of HTML."""
    return written(element("div", *(each.element() for each in overviews), class_="viscontact"))


def as_text(overviews: Iterable[Overview]) -> str:
    """Write the tables of overviews for a terminal."""
    return "\n\n".join(each.text() for each in overviews)


def _row(row: tuple[str, ...]) -> Element:
    name, *values = row
    cells = (element("td", value, style=_WRAP) for value in values)
    return element("tr", element("th", name, scope="row", style=_NAME), *cells)
