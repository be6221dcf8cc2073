"""A run, or the runs of a sweep, as a PDF: the content of the page with still figures."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element

import typst
import xarray as xr
from matplotlib import get_data_path

from viscontact import __version__
from viscontact.drawing.figures import Chapter
from viscontact.drawing.svg.html import element
from viscontact.report import result_chapters
from viscontact.report.page import run_chapters
from viscontact.report.pdf_content import blocks
from viscontact.report.still_figures import still_figures
from viscontact.report.sweep_page import sweep_content
from viscontact.report.title_block import title_lines
from viscontact.results.filed_case import FiledCase, started_at
from viscontact.results.run_axis import in_order, run_axis
from viscontact.units.visible import visible


def write_pdf(ds: xr.Dataset, path: str | Path, *, label: str = "") -> None:
    """Write a run as a PDF of A4 pages, with a label if given; ValueError without an instant."""
    axis = run_axis(ds)
    if not ds.sizes.get(axis.name):
        raise ValueError(
            f"a report needs one {axis.row} at least, got a result without any; run it"
        )
    ds = in_order(ds)
    name = result_chapters.heading_of(ds, label)
    author = _author(ds)
    _write(path, name, _run(ds, name), author=author, made=started_at(ds.attrs))


def write_sweep_pdf(ds: xr.Dataset, path: str | Path, *, title: str) -> None:
    """Write the runs of a sweep, from `open_many`, as a PDF; OSError if it cannot be written."""
    page, author = sweep_content(ds, title, interactive=False), _author(ds)
    _write(path, page.title, page.elements(), author=author, made=started_at(ds.attrs))


def _write(
    path: str | Path, title: str, parts: Iterable[Element], *, author: str = "", made: str = ""
) -> None:
    footer = " · ".join(filter(None, (title, made, f"viscontact {__version__}")))
    data = {
        **{"title": visible(title), "author": visible(author), "footer": visible(footer)},
        "blocks": [block for part in parts for block in blocks(part)],
    }
    template = (files("viscontact.report") / "report.typ").read_bytes()
    # Matplotlib brings the fonts, so that a page is the same on every machine.
    fonts: Any = [str(Path(get_data_path()) / "fonts" / "ttf")]
    pdf = typst.compile(
        template,
        font_paths=fonts,
        ignore_system_fonts=True,
        sys_inputs={"data": json.dumps(data, ensure_ascii=False)},
    )
    Path(path).write_bytes(pdf)


def _author(ds: xr.Dataset) -> str:
    return FiledCase.of(ds.attrs).title_block.get("operator", "")


def _run(ds: xr.Dataset, name: str) -> Iterator[Element]:
    yield from title_lines(ds)
    yield result_chapters.opening(name, ds, {})
    chapters: tuple[Chapter, ...] = ("pressure", "friction", "histories", "loops")
    for each in run_chapters(ds, {chapter: still_figures(ds, chapter) for chapter in chapters}):
        yield element("h2", each.title)
        yield from each.parts
