"""Sensitivity of a case as a page: tornado figure, scatter and derivatives."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.drawing.matplotlib.sweeps.sensitivity import scatter_bands, tornado
from viscontact.drawing.svg.html import element
from viscontact.report.page_elements import (
    drawn_figure,
    facts,
    listed_notes,
    remark,
    text_table,
    value_cell,
)
from viscontact.report.study_page import StudyPage
from viscontact.results.sweep_axes import key_label
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import format_quantity


def write_sensitivity_report(table: xr.Dataset, path: str | Path, *, title: str) -> None:
    """Write the table of a sensitivity as one page of HTML; OSError if it cannot be written."""
    has_inputs = table.sizes["input"] > 0
    chapters = {
        "What matters": list(_elasticities(table)) if has_inputs else [],
        "Scatter": list(_scatter(table)) if "percentile" in table else [],
        "Derivatives": list(_derivatives(table)) if has_inputs else [],
    }
    values = facts((SCALARS[name].label, _value(table, name)) for name in _names(table))
    StudyPage(title, (values, listed_notes(table)), chapters).write(path)


def _value(table: xr.Dataset, name: str) -> str:
    """Output of the case itself."""
    return value_cell(table.sel(output=name), "value", SCALARS[name].units)


def _elasticities(table: xr.Dataset) -> Iterator[Element]:
    yield drawn_figure(tornado(table), "Elasticities with their errors, the largest first.")
    keys, texts = (table[name].values.tolist() for name in ("input", "input_text"))
    rows = (
        (key_label(key), str(text), *_by_input(table, key, "elasticity"))
        for key, text in zip(keys, texts, strict=True)
    )
    yield text_table(("Input", "in the case", *_labels(table)), rows)
    yield remark("Relative change of the output per relative change of the input.")


def _scatter(table: xr.Dataset) -> Iterator[Element]:
    """Percentiles of the outputs, their bands over time, and the parts of the variance."""
    percents = [f"{each:g} %" for each in table["percent"].values]
    rows = []
    for name in _names(table):
        values = table["percentile"].sel(output=name).values.tolist()
        texts = (format_quantity(each, SCALARS[name].units) for each in values)
        rows.append((SCALARS[name].label, *texts))
    yield text_table(("Output", *percents), rows)
    if "band" in table and table.sizes[str(table["band"].dims[-1])] > 1:
        caption = "Band from 5 to 95 % of the samples, their median, and the values of the case."
        yield drawn_figure(scatter_bands(table), caption)
    keys, about = (table[name].values.tolist() for name in ("scattered", "distribution"))
    for name in _names(table):
        one = table.sel(output=name)
        parts = (
            (key_label(key), text, *(_index(one.sel(scattered=key), each) for each in _ORDERS))
            for key, text in zip(keys, about, strict=True)
        )
        yield element("h3", f"Variance of: {SCALARS[name].label}")
        yield text_table(("Input", "scatter", "alone", "in total"), parts)
    count = table.sizes["point"]
    yield remark(f"Sobol' indices with 95 % intervals; percentiles of {count} samples.")


_ORDERS = ("first_order", "total_order")


def _index(of: xr.Dataset, name: str) -> str:
    value, low, high = (float(of[f"{name}{end}"]) for end in ("", "_low", "_high"))
    return "not known" if np.isnan(value) else f"{value:.2f} ({low:.2f} to {high:.2f})"


def _derivatives(table: xr.Dataset) -> Iterator[Element]:
    rows = (
        (key_label(key), *_by_input(table, key, "derivative"))
        for key in table["input"].values.tolist()
    )
    yield text_table(("Input", *_labels(table)), rows)
    yield remark("In SI units: unit of the output per unit of the input.")


def _names(table: xr.Dataset) -> list[str]:
    return [str(name) for name in table["output"].values]


def _labels(table: xr.Dataset) -> list[str]:
    return [SCALARS[name].label for name in _names(table)]


def _by_input(table: xr.Dataset, key: str, quantity: str) -> Iterator[str]:
    """Elasticity or derivative of each output by an input, with its error."""
    for name in _names(table):
        yield value_cell(table.sel(output=name, input=key), quantity, "1", unknown="not known")
