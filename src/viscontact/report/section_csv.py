"""Sections and line load as CSV, in SI units."""

from __future__ import annotations

import csv
import io
from typing import Literal

from viscontact.figures.sections import Curve, crossings, section_lines
from viscontact.figures.shown_fields import ShownFields


def section_csv(fields: ShownFields, along: Literal["x", "y"]) -> str:
    """Write the section at every instant shown as CSV, in SI units."""
    places_of, other = crossings(fields, along), "y" if along == "x" else "x"
    places = [f", {other} = {at!r} m" if fields.body else "" for at in places_of]
    return _csv(fields, along, "pressure", "Pa", section_lines(fields, along), places)


def line_load_csv(fields: ShownFields) -> str:
    """Write the line load at every instant shown as CSV, in SI units."""
    lines = [each.line_load() for each in fields.snapshots]
    return _csv(fields, "x", "line load", "N/m", lines, [""] * len(lines))


def _csv(
    fields: ShownFields,
    along: str,
    quantity: str,
    units: str,
    lines: list[Curve],
    places: list[str],
) -> str:
    """Write positions, and a column of values for each instant, with its place in the heading."""
    heads = [
        f"{quantity} at {each.time!r} {each.axis.unit}{place} [{units}]"
        for each, place in zip(fields.snapshots, places, strict=True)
    ]
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow([f"{along} [m]", *heads])
    columns = [lines[0][0].tolist(), *(values.tolist() for _, values in lines)]
    writer.writerows(zip(*columns, strict=True))
    return file.getvalue()
