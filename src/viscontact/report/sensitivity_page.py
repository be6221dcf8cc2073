"""Sensitivity of a case as one page of HTML: tornado figure and table."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from string import Template
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact import __version__
from viscontact.notebook.html import element, written
from viscontact.plot.sweeps.scatter_bands import scatter_bands
from viscontact.plot.sweeps.tornado import tornado
from viscontact.report.blocks import drawn_figure, listed_notes, text_table
from viscontact.results.formatting import format_with_error
from viscontact.results.largest_values import key_label
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import format_quantity


def write_sensitivity_report(table: xr.Dataset, path: str | Path, *, title: str) -> None:
    """Write the table of a sensitivity as one page of HTML; OSError if it cannot be written."""
    folder = files("viscontact.report")
    template = Template((folder / "sweep.html").read_text(encoding="utf-8"))
    page = template.substitute(
        generator=f"viscontact {__version__}",
        title=written(element("title", title)),
        style=(folder / "page.css").read_text(encoding="utf-8"),
        body="\n".join(map(written, _chapters(table, title))),
        scripts="",
    )
    Path(path).write_text(page, encoding="utf-8")


def _chapters(table: xr.Dataset, title: str) -> Iterator[Element]:
    yield element(
        "header",
        element("h1", title),
        _values(table),
        listed_notes(table),
    )
    if table.sizes["input"]:
        yield element("section", element("h2", "What matters"), *_elasticities(table))
    if "percentile" in table:
        yield element("section", element("h2", "Scatter"), *_scatter(table))
    if table.sizes["input"]:
        yield element("section", element("h2", "Derivatives"), *_derivatives(table))
    yield element("p", f"Made by viscontact {__version__}.", class_="faint")


def _values(table: xr.Dataset) -> Element:
    """Outputs of the case itself."""
    tiles = (
        element("div", element("dt", SCALARS[name].label), element("dd", _value(table, name)))
        for name in map(str, table["output"].values)
    )
    return element("dl", *tiles, class_="facts")


def _value(table: xr.Dataset, name: str) -> str:
    one = table.sel(output=name)
    return format_with_error(float(one["value"]), float(one["value_error"]), SCALARS[name].units)


def _elasticities(table: xr.Dataset) -> Iterator[Element]:
    yield drawn_figure(tornado(table), "Elasticities with their errors, the largest first.")
    rows = [
        (key_label(key), text, *(_pair(table, name, key, "elasticity") for name in _names(table)))
        for key, text in _inputs(table)
    ]
    yield text_table(("Input", "in the case", *_labels(table)), rows)
    said = "Relative change of the output per relative change of the input."
    yield element("p", said, class_="faint")


def _scatter(table: xr.Dataset) -> Iterator[Element]:
    """Percentiles of the outputs, their bands over time, and the parts of the variance."""
    percents = [f"{each:g} %" for each in table["percent"].values]
    rows = [
        (
            SCALARS[name].label,
            *(
                format_quantity(float(each), SCALARS[name].units)
                for each in table["percentile"].sel(output=name).values
            ),
        )
        for name in _names(table)
    ]
    yield text_table(("Output", *percents), rows)
    if "band" in table and table.sizes[str(table["band"].dims[-1])] > 1:
        caption = "Band from 5 to 95 % of the samples, their median, and the values of the case."
        yield drawn_figure(scatter_bands(table), caption)
    for name in _names(table):
        one = table.sel(output=name)
        parts = [
            (key_label(key), about, *(_index(one.sel(scattered=key), each) for each in _ORDERS))
            for key, about in zip(
                table["scattered"].values.tolist(), table["distribution"].values, strict=True
            )
        ]
        yield element("h3", f"Variance of: {SCALARS[name].label}")
        yield text_table(("Input", "scatter", "alone", "in total"), parts)
    count = table.sizes["point"]
    said = f"Sobol' indices with 95 % intervals; percentiles of {count} samples."
    yield element("p", said, class_="faint")


_ORDERS = ("first_order", "total_order")


def _index(of: xr.Dataset, name: str) -> str:
    value, low, high = (float(of[f"{name}{end}"]) for end in ("", "_low", "_high"))
    return "not known" if np.isnan(value) else f"{value:.2f} ({low:.2f} to {high:.2f})"


def _derivatives(table: xr.Dataset) -> Iterator[Element]:
    rows = [
        (key_label(key), *(_pair(table, name, key, "derivative") for name in _names(table)))
        for key, _ in _inputs(table)
    ]
    yield text_table(("Input", *_labels(table)), rows)
    yield element("p", "In SI units: unit of the output per unit of the input.", class_="faint")


def _names(table: xr.Dataset) -> list[str]:
    return [str(name) for name in table["output"].values]


def _labels(table: xr.Dataset) -> list[str]:
    return [SCALARS[name].label for name in _names(table)]


def _inputs(table: xr.Dataset) -> list[tuple[str, str]]:
    keys, texts = (table[name].values.tolist() for name in ("input", "input_text"))
    return list(zip(map(str, keys), map(str, texts), strict=True))


def _pair(table: xr.Dataset, output: str, key: str, quantity: str) -> str:
    """Elasticity or derivative with its error."""
    one = table.sel(output=output, input=key)
    value, error = (float(one[name]) for name in (quantity, f"{quantity}_error"))
    return "not known" if np.isnan(value) else format_with_error(value, error, "1")
