"""Isochronous stress-strain curves of creep tests, as ISO 899 defines them."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.tables.creep_tests import STRAIN_UNITS
from viscontact.tables.names import Data, meaning
from viscontact.tables.table import Table, read_only
from viscontact.tables.text import Row, decimal_number
from viscontact.units.formatting import format_quantity
from viscontact.units.parsing import UnitScale, parse_quantity, parse_scale

# "stress at 10 h [MPa]", "strain (10 h) [%]", "10 h [MPa]"
_AT_TIME = re.compile(
    r"(?:(?P<name>.+?)\s*(?:\bat\b|\bbei\b|\bnach\b|@|\()\s*)?"
    r"(?P<time>\d[\d.,]*\s*[^\W\d]+)\s*\)?\s*(?:\[(?P<square>[^\]]*)\]|\((?P<round>[^()]*)\))"
)
_ALONE = re.compile(r"(?P<name>.+?)\s*(?:\[(?P<square>[^\]]*)\]|\((?P<round>[^()]*)\))")


@dataclass(frozen=True)
class _Curve:
    """One curve: its heading, time [s], column, scale to SI, and quantity ("" if not stated)."""

    heading: str
    time: float
    place: int
    unit: str
    quantity: str


def isochronous_table(path: Path, rows: list[Row], stress: float | None) -> Table | None:
    """Creep compliance over time at a stress [Pa]; None if the header is of another table."""
    # The first column is the strain and the others are stresses at times (``stress at 10 h
    # [MPa]``), or the first is the stress and the others are strains. Curves may end early. The
    # strain at the stress is interpolated linearly; each curve begins at the origin.
    found = _layout(rows[0])
    if found is None:
        return None
    first, data, curves = found
    where = f"{path.name}:{rows[0].line}"
    if stress is None:
        raise ValueError(
            f"{where}: isochronous curves need the stress at which the creep is read: --stress "
            "'5 MPa' on the command line, or stress: 5 MPa in a case; a low one is nearest to "
            "linear behaviour"
        )
    cells = [cell for row in rows[1:] for cell in row.cells]
    mark = "," if any(re.fullmatch(r"[+-]?\d*,\d+.*", cell) for cell in cells) else "."
    second = "strain" if first.quantity == "stress" else "stress"
    scales = {
        each.place: _scale(where, each, second if each is not first else first.quantity)
        for each in (first, *curves)
    }
    strains = []
    for curve in curves:
        points = np.array(
            [
                [_value(path, row, each, scales[each.place], mark) for each in (first, curve)]
                for row in rows[1:]
                if curve.place < len(row.cells) and row.cells[curve.place]
            ]
        ).reshape(-1, 2)
        levels, strain = points.T if first.quantity == "stress" else points.T[::-1]
        strains.append(_strain_at(where, curve, levels, strain, stress))
    order = np.argsort([curve.time for curve in curves], kind="stable")
    times = np.array([curve.time for curve in curves])[order]
    columns = {
        "time": read_only(times),
        "creep_compliance": read_only(np.array(strains)[order] / stress),
    }
    headings = {"time": "times in the headings", "creep_compliance": curves[0].heading}
    return Table(path, columns, data, headings, np.full(times.size, rows[0].line))


def _layout(header: Row) -> tuple[_Curve, Data | None, list[_Curve]] | None:
    """First column and curves of a header; None if it is not that of isochronous curves."""
    alone = _ALONE.fullmatch(header.cells[0])
    stated = meaning(alone["name"]) if alone else None
    if alone is None or stated is None or stated.quantity not in ("strain", "stress"):
        return None
    curves = [_curve(place, cell) for place, cell in enumerate(header.cells) if place and cell]
    known = [each for each in curves if each is not None]
    other = "strain" if stated.quantity == "stress" else "stress"
    if len(known) < len(curves) or not known or {c.quantity for c in known} - {other, ""}:
        return None
    unit = (alone["square"] or alone["round"] or "").strip()
    return _Curve(header.cells[0], 0.0, 0, unit, stated.quantity), stated.data, known


def _curve(place: int, heading: str) -> _Curve | None:
    match = _AT_TIME.fullmatch(heading)
    if match is None:
        return None
    stated = meaning(match["name"]) if match["name"] else None
    if match["name"] and stated is None:
        return None
    try:
        time = parse_quantity(match["time"].replace(",", "."), "time")
    except ValueError:
        return None
    unit = (match["square"] or match["round"] or "").strip()
    return _Curve(heading, time, place, unit, stated.quantity if stated else "")


def _scale(where: str, curve: _Curve, quantity: str) -> UnitScale:
    try:
        if quantity == "stress":
            return parse_scale(curve.unit, "pressure")
        if curve.unit not in STRAIN_UNITS:
            raise ValueError(f"a strain has one of the units {', '.join(STRAIN_UNITS)}")
    except ValueError as error:
        raise ValueError(f"{where}: column {curve.heading!r}: {error}") from error
    return UnitScale(STRAIN_UNITS[curve.unit])


def _value(path: Path, row: Row, curve: _Curve, scale: UnitScale, mark: str) -> float:
    try:
        return scale.si(decimal_number(row.cells[curve.place], mark))
    except ValueError as error:
        raise ValueError(f"{path.name}:{row.line}: column {curve.heading!r}: {error}") from None


def _strain_at(where: str, curve: _Curve, levels: Floats, strain: Floats, at: float) -> float:
    """Strain of a curve at a stress [Pa]."""
    levels, strain = np.append(0.0, levels[levels != 0]), np.append(0.0, strain[levels != 0])
    if not ((np.diff(levels) > 0).all() and (np.diff(strain) > 0).all()):
        raise ValueError(
            f"{where}: column {curve.heading!r}: stress and strain must increase from row to row"
        )
    if not 0 < at <= levels[-1]:
        raise ValueError(
            f"{where}: column {curve.heading!r} ends at {format_quantity(levels[-1], 'Pa')}; "
            f"{format_quantity(at, 'Pa')} lies outside, choose a lower stress"
        )
    return float(np.interp(at, levels, strain))
