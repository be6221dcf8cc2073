"""A run, or the runs of a sweep, as a PDF: the content of the page with still figures."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
import typst
import xarray as xr
from matplotlib import get_data_path
from matplotlib.figure import Figure

from viscontact import __version__
from viscontact.drawing.matplotlib import (
    contact_outline,
    hysteresis,
    line_load,
    motion_profile,
    pressure_map,
    pressure_profile,
)
from viscontact.drawing.matplotlib.histories.history import history_with_load
from viscontact.drawing.svg.html import element
from viscontact.report import result_chapters
from viscontact.report.drawings import drawn
from viscontact.report.page import run_chapters
from viscontact.report.pdf_content import blocks
from viscontact.report.sweep_page import sweep_content
from viscontact.report.title_block import title_lines
from viscontact.results.filed_case import FiledCase, started_at
from viscontact.results.run_axis import in_order, run_axis
from viscontact.results.shown_scalars import is_long


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
        "title": title,
        "author": author,
        "footer": footer,
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
    history = _history(ds) if run_axis(ds).is_history else _over_speed(ds)
    for each in run_chapters(ds, _pressure(ds), history):
        yield element("h2", each.title)
        yield from each.parts


def _pressure(ds: xr.Dataset) -> Iterator[Element]:
    yield _figure(pressure_map, ds, "Pressure")
    yield element("h3", "Section through the pressure")
    yield _figure(pressure_profile, ds, "Section through the pressure")
    if is_long(ds) and "line_load" in ds:
        yield element("h3", "Line load along x: the pressure integrated over y")
        yield _figure(line_load, ds, "Line load")
    yield element("h3", "Outline of the contact")
    yield _figure(contact_outline, ds, "Outline of the contact")


def _history(ds: xr.Dataset) -> Iterator[Element]:
    yield _figure(history_with_load, ds, "History")
    if "loss_per_cycle" in ds and np.isfinite(ds["loss_per_cycle"].values).any():
        yield _figure(hysteresis, ds, "Force over approach")


def _over_speed(ds: xr.Dataset) -> Iterator[Element]:
    yield _figure(motion_profile, ds, "Pressure along the motion")


def _figure(draw: Callable[..., Figure], ds: xr.Dataset, about: str) -> Element:
    return drawn(partial(draw, ds), about)
