"""Fit of a case to records as a page: values, records with residuals, and sections of the case."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import xarray as xr

from viscontact.drawing.matplotlib.materials.fitted import fitted_records
from viscontact.drawing.svg.html import element
from viscontact.report.page_elements import drawn_figure, listed_notes, remark, text_table
from viscontact.report.study_page import StudyPage


def write_fit_report(
    curves: xr.Dataset,
    values: Sequence[Sequence[str]],
    correlation: Sequence[Sequence[str]],
    path: str | Path,
    *,
    title: str,
    headline: str,
    section: str,
) -> None:
    """Write the values and curves of a fit as one page of HTML; OSError if it cannot be written.

    `values` are name, value, interval and discretisation error of each parameter, `correlation` two
    names and their correlation, and `section` the fitted sections of the case. The curves have
    the attributes `notes` and `confidence`, the level of the intervals.
    """
    interval = f"{curves.attrs['confidence']:.0%} interval"
    table = text_table(("", "value", interval, "discretisation"), values)
    pairs = [text_table(("", "", "correlation"), correlation)] if correlation else []
    about = remark("Intervals from the scatter of the records, in the units of the values.")
    drawing = drawn_figure(fitted_records(curves), "Measured and fitted values, and residuals.")
    chapters = {
        "Values": [table, about, *pairs],
        "Records": [drawing],
        "Sections of the case": [element("pre", section)],
    }
    head = element("p", headline, class_="headline"), listed_notes(curves)
    StudyPage(title, head, chapters).write(path)
