"""Data of a material as they were measured, in a report."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any
from xml.etree.ElementTree import Element

import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.log_time import label_log_time
from viscontact.drawing.svg.html import element
from viscontact.report.drawings import BODIES, drawn
from viscontact.report.page_elements import remark
from viscontact.results.filed_case import FiledCase
from viscontact.units.formatting import readable_unit

_SYMBOLS = {
    "creep_compliance": {"uniaxial": "D", "shear": "J", "deviatoric": "Φ"},
    "creep_modulus": {"uniaxial": "E_c", "shear": "G_c"},
    "relaxation_modulus": {"uniaxial": "E", "shear": "G"},
    "storage_modulus": {"uniaxial": "E′", "shear": "G′"},
    "loss_modulus": {"uniaxial": "E″", "shear": "G″"},
    "loss_tangent": {"uniaxial": "tan δ", "shear": "tan δ"},
}
#: Size of a figure [inch]: width and height of each of its panels.
_WIDTH, _HEIGHT = 4.2, 2.8


def measured_lines(ds: xr.Dataset, body: str) -> Iterator[Element]:
    """Yield the table of a body's law as it was measured; nothing for other laws."""
    for part, record in FiledCase.of(ds.attrs).measured.items():
        if BODIES.get(part) == body:
            drawing = drawn(partial(measured_figure, record), f"Measured: {body.lower()}")
            # Of one quantity, besides time or frequency, the figure is narrow.
            look = "single" if len(record["columns"]) == 2 else "several"
            yield element("figure", drawing, class_=look)
            yield remark(measured_text(record))


def measured_text(record: Mapping[str, Any]) -> str:
    """Describe a table of measured values in a sentence."""
    columns, rows = record["columns"], record["rows"]
    names = " and ".join(f"“{each['heading']}”" for each in columns)
    shown = len(columns[0]["values"])
    some = f", {shown} of them drawn" if shown < rows else ""
    row = "row" if rows == 1 else "rows"
    return (
        f"As measured: {rows} {row} of {record['file']}{some}, columns {names} "
        f"({record['data']} test)."
    )


def measured_figure(record: Mapping[str, Any]) -> Figure:
    """Draw the measured quantities over time or frequency, each in a panel of its own."""
    over, *measured = record["columns"]
    figure = style.new_figure(_WIDTH * len(measured), _HEIGHT)
    unit = readable_unit(over["units"], over["values"])
    spread = max(over["values"]) > 30 * min(over["values"]) > 0
    for place, each in enumerate(measured, 1):
        axes = figure.add_subplot(1, len(measured), place)
        own = readable_unit(each["units"], each["values"])
        axes.plot(unit(over["values"]), own(each["values"]), "o", markersize=4)
        axes.set_xlabel(unit.label(over["quantity"].replace("_", " ").capitalize()))
        if spread:
            axes.set_xscale("log")
        if spread and over["units"] == "s":
            axes.set_xlabel(label_log_time(axes, unit, *unit(over["values"])[[0, -1]].tolist()))
        name = each["quantity"].replace("_", " ").capitalize()
        axes.set_ylabel(own.label(f"{name} {_SYMBOLS[each['quantity']][record['data']]}"))
        style.dress(axes)
    return figure
