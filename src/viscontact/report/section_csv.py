"""Sections and line load as CSV, in SI units."""

from __future__ import annotations

import csv
import io

from viscontact.drawing.content.map import Maps
from viscontact.drawing.content.section import Lines


def lines_csv(maps: Maps, lines: Lines) -> str:
    """Write positions, and a column of values for each instant, with the place of a moving line."""
    other = "y" if lines.along == "x" else "x"
    places = [f", {other} = {at!r} m" if maps.moves else "" for at in lines.crossings]
    heads = [
        f"{lines.quantity.lower()} at {each.time!r} {each.axis.unit}{place} [{lines.si}]"
        for each, place in zip(maps.snapshots, places or [""] * len(maps.maps), strict=True)
    ]
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow([f"{lines.along} [m]", *heads])
    columns = [lines.positions.tolist(), *(values.tolist() for values in lines.values)]
    writer.writerows(zip(*columns, strict=True))
    return file.getvalue()
