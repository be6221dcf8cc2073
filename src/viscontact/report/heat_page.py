"""Heat balances of a rolling body as a page."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.drawing.matplotlib.sweeps.heat_balance import (
    heat_balance,
    rolling_heating,
    rolling_temperature,
)
from viscontact.drawing.svg.html import element
from viscontact.report.page_elements import drawn_figure, listed_notes, remark, text_table
from viscontact.report.study_page import StudyPage
from viscontact.results.heating.heat_rows import balance_headings, balance_rows, heat_argument_rows


def write_heat_report(table: xr.Dataset, path: str | Path, *, headline: str) -> None:
    """Write the heat balances of a rolling body as one page of HTML.

    `headline` is the sentence of the result. OSError if the file cannot be written.
    """
    chapters = {
        "Temperature": list(_temperatures(table)),
        "Power and cooling": [
            drawn_figure(
                heat_balance(table), "Power at some speeds, and cooling: balances where they meet."
            )
        ],
        "Heating": list(_heating(table)),
        "Cooling": [text_table(("", ""), heat_argument_rows(table))],
    }
    head = element("p", headline, class_="headline"), listed_notes(table)
    StudyPage(f"Heat balance: {table.attrs['title']}", head, chapters).write(path)


def _temperatures(table: xr.Dataset) -> Iterator[Element]:
    yield drawn_figure(rolling_temperature(table), "Balances over speed.")
    yield text_table(balance_headings(table), balance_rows(table))
    yield remark(
        "The power at other temperatures is that of the curve at the speed times the shift factor. "
        "A balance is stable if a rise of the temperature adds less heat than it makes flow off."
    )


def _heating(table: xr.Dataset) -> Iterator[Element]:
    if "time" in table.dims and np.isfinite(table["heating_temperature"].values).any():
        caption = "From the start of the motion at rest, with the power of each temperature."
        yield drawn_figure(rolling_heating(table), caption)
