"""Chapters of the page: inputs, geometry, material, accuracy, limits, versions."""

from __future__ import annotations

import platform
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from urllib.parse import quote
from xml.etree.ElementTree import Element

import numpy as np
import plotly
import scipy
import xarray as xr

from viscontact import __version__
from viscontact.drawing.svg.html import element
from viscontact.report import accuracy, drawings, limits
from viscontact.report.clocks import clock_line
from viscontact.report.inputs import InputRow, case_file, inputs
from viscontact.report.measured import measured_lines
from viscontact.report.page_elements import remark, stacked_table
from viscontact.report.title_block import file_lines
from viscontact.results.citation import citations
from viscontact.results.filed_case import FiledCase
from viscontact.results.formatting import format_scalar
from viscontact.results.run_axis import SPEED, run_axis
from viscontact.results.run_files import CASE_NAME
from viscontact.results.shown_scalars import is_shown
from viscontact.results.summary import legend
from viscontact.results.variables import SCALARS, shown_name
from viscontact.units.formatting import format_quantity


def inputs_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the table of inputs, and the case as it was written."""
    tables = [_part(part, list(rows)) for part, rows in groupby(inputs(ds), lambda each: each.part)]
    if tables:
        yield element("div", *tables, class_="inputs")
        if FiledCase.of(ds.attrs).case_as_typed:
            text = "An empty field: computed with the typed value, or with what follows from it."
            yield remark(text)
    else:
        yield remark("This result does not contain its case.")
    yield from file_lines(ds)
    if text := case_file(ds):
        source = f"data:application/yaml;charset=utf-8,{quote(text)}"
        link = element("a", "Download", class_="download", download=CASE_NAME, href=source)
        yield element(
            "details", element("summary", "The case as it was run"), link, element("pre", text)
        )


def geometry_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the drawing of the indenter."""
    yield element("figure", drawings.geometry(ds))
    if drawings.is_drawn_from_fields(ds):
        yield remark(
            "A result does not keep a measured surface. Drawn is the body as the grid of this run "
            "resolves it, from the stored gap, displacement and approach; its lowest point is at "
            "zero.",
        )


def material_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the curves of each body's material."""
    for title, drawing in drawings.materials(ds):
        yield element("h3", title)
        if clock := clock_line(ds, title):
            yield element("p", clock)
        yield element("figure", drawing)
        yield from measured_lines(ds, title)
    yield remark(
        "Φ is the strain deviator per unit stress deviator, so that Φ(0) = 1/(2 G(0)); G is the "
        "shear modulus.",
    )


def speed_table(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the table of the chief scalars of a result over speed; nothing over time."""
    if run_axis(ds) is not SPEED:
        return
    resistance = shown_name(f"resistance_{ds.attrs.get('along', 'y')}", ds)
    names = ["friction_coefficient", resistance]
    chief = ("peak_pressure", shown_name("contact_area", ds), "approach")
    names += [name for name in chief if is_shown(ds, name)]
    heads = ["speed", *(SCALARS[name].label.lower() for name in names)]
    rows = [
        [SPEED.place(float(speed)), *(format_scalar(ds, name, row) for name in names)]
        for row, speed in enumerate(SPEED.values(ds))
    ]
    yield stacked_table(heads, rows, numbers=range(1, len(heads)))


def accuracy_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the table of errors, and the estimates behind them."""
    axis = run_axis(ds)
    ends = (axis.place(float(ds[axis.name][k])) for k in (0, -1))
    heads = ("", *ends, "largest", "largest error", "when" if axis.is_history else "at")
    yield stacked_table(heads, accuracy.error_rows(ds), numbers=range(1, len(heads)))
    yield remark(legend(ds))
    yield _account(accuracy.accuracy_lines(ds))


def limits_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield the run's warnings, then the assumptions of the theory."""
    warnings = limits.warnings_of(ds)
    if warnings:
        items = (element("li", text) for text in warnings)
        yield element(
            "div", element("p", "This run warns:"), element("ul", *items), class_="warnings"
        )
    else:
        yield element("p", "This run has no warnings.")
    yield element("h3", "What the theory always assumes")
    yield _account(limits.assumptions(ds))


def about_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield versions and citation."""
    version = str(ds.attrs.get("version", "not known"))
    lines = [("Computed by", f"viscontact {version}")]
    if "wall_time" in ds.attrs:
        lines[0] = ("Computed by", f"{lines[0][1]}, {_effort(ds)}")
    if "transforms" in ds.attrs:
        lines.append(("Fourier transforms", str(ds.attrs["transforms"])))
        lines.append(("inner loops", str(ds.attrs.get("inner_loops", "numpy"))))
    lines.append(
        (
            "Page written by",
            f"viscontact {__version__}, Python {platform.python_version()}, NumPy "
            f"{np.__version__}, SciPy {scipy.__version__}, xarray {xr.__version__}, Plotly "
            f"{plotly.__version__}",
        )
    )
    yield _account(lines)
    yield element("h3", "How to cite")
    yield element("p", "If this result is published, please cite the program and the paper:")
    cited = (element("li", text) for text in citations(version))
    yield element("ul", *cited)


def _effort(ds: xr.Dataset) -> str:
    seconds = format_quantity(float(ds.attrs["wall_time"]), "s", 3)
    axis = run_axis(ds)
    return (
        f"{ds.sizes[axis.name]} {axis.row}s in {seconds}, {int(ds['iterations'].sum())} iterations"
    )


def _part(title: str, given: Sequence[InputRow]) -> Element:
    """Table of a part: one column, or two if values were typed."""
    caption, both = element("caption", title), any(each.typed for each in given)
    rows = (
        element(
            "tr",
            element("th", each.name, scope="row"),
            element("td", each.typed) if both else None,
            element("td", each.value),
        )
        for each in given
    )
    if not both:
        return element("table", caption, element("tbody", *rows))
    head = element("tr", *(element("th", text) for text in ("", "as typed", "computed with")))
    return element("table", caption, element("thead", head), element("tbody", *rows))


def _account(lines: Iterable[tuple[str, str]]) -> Element:
    entries = [part for name, text in lines for part in (element("dt", name), element("dd", text))]
    return element("dl", *entries, class_="account")
