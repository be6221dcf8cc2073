"""Page of a study of many runs: head, and chapters of tables, figures and remarks."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import field
from pathlib import Path
from xml.etree.ElementTree import Element

from plotly.graph_objects import Figure

from viscontact import __version__
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.svg.html import element
from viscontact.report.html_page import html_page
from viscontact.report.page_elements import remark


@dataclass(frozen=True)
class StudyRows:
    """Table of the runs of a study, a row of texts for each."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    numbers: Collection[int]  # columns of numbers
    judged: bool = False  # the last column has verdicts


@dataclass(frozen=True)
class StudyPage:
    """Content of the page of a study, in the order of the page."""

    title: str
    head: Sequence[Element | None]  # below the title: sentence, facts, notes
    chapters: Mapping[str, Sequence[Element]]  # by title; those without content are left out
    title_block: Sequence[Element] = ()
    files: Sequence[Element] = ()  # table of the input files
    figures: Sequence[Figure] = field(default=(), repr=False)  # drawn in boxes of the chapters

    def elements(self) -> Iterator[Element]:
        """Yield the parts from top to bottom."""
        yield from self.title_block
        yield element("header", element("h1", self.title), *self.head)
        for title, parts in self.chapters.items():
            if parts:
                yield element("section", element("h2", title), *parts)
        if self.files:
            yield element("section", *self.files)
        yield remark(f"Made by viscontact {__version__}.")

    def html(self) -> str:
        """Return the page of HTML, which needs nothing from outside."""
        return html_page(self.title, self.elements(), self.figures)

    def write(self, path: str | Path) -> None:
        """Write the page; OSError if the file cannot be written."""
        Path(path).write_text(self.html(), encoding="utf-8")
