"""Traction of a rolling body over its creepage, with the limits of Carter."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.bodies.indenters import Paraboloid
from viscontact.drawing.content.friction import contact_series, round_body
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.panel import FAINT, FIRST, PERCENT, Axis, Curve, Ink, Mark, Panel
from viscontact.results.recorded_case import case_of
from viscontact.results.rolling import TractionCurves, rolls_askew, traction_curves
from viscontact.results.shown_rows import shown_rows
from viscontact.units.formatting import format_quantity, readable_unit

#: Most speeds that are drawn, digits of a speed, and points of an exact curve.
_MOST, _DIGITS, _POINTS = 6, 3, 200
#: Speeds that differ by less than this part in the limits of Carter have one curve.
_ALIKE = 1e-3
#: Range of the axis over that of the values.
_ROOM = 1.08


def traction_creepage_panel(run: xr.Dataset, look: Look = LIGHT) -> Panel:
    """Panel of the traction over friction times force at each creepage, a curve a speed."""
    found = traction_curves(run)
    creepages = found.creepages
    chosen = shown_rows(found.speeds.size, _MOST)
    places = np.linspace(0.0, 1.0, chosen.size).tolist() if chosen.size > 1 else [0.0]
    curves = tuple(
        Curve(
            creepages,
            found.parts[number],
            format_quantity(float(found.speeds[number]), "m/s", _DIGITS),
            Ink("ordered", place) if chosen.size > 1 else FIRST,
            "joined",
            error=found.errors[number],
            texts=_texts(found, int(number), look),
        )
        for number, place in zip(chosen, places, strict=True)
    )
    drives = creepages.max() > 0
    brakes = creepages.min() < 0
    drawn = found.parts[chosen]
    limits = min(float(drawn.min()), 0.0) * _ROOM, max(float(drawn.max()), 0.0) * _ROOM
    return Panel(
        Axis("Creepage", PERCENT, _with_zero(creepages)),
        Axis("Traction over friction times force", readable_unit("1"), limits),
        (*curves, *_carter(run, creepages)),
        marks=(Mark(0.0), Mark(0.0, "y")) if drives and brakes else (),
        name="traction-creepage",
    )


def _texts(found: TractionCurves, number: int, look: Look) -> tuple[str, ...]:
    speed = format_quantity(float(found.speeds[number]), "m/s", _DIGITS)
    return tuple(
        f"{speed}, creepage {100 * creepage:.4g} %: {look.text(part, error, '1')}"
        for creepage, part, error in zip(
            found.creepages.tolist(),
            found.parts[number].tolist(),
            found.errors[number].tolist(),
            strict=True,
        )
    )


def _with_zero(creepages: Floats) -> tuple[float, float]:
    """Range of the creepages, from none on, with a little room."""
    low, high = min(float(creepages.min()), 0.0), max(float(creepages.max()), 0.0)
    room = 0.02 * (high - low)
    return low - room * (low < 0), high + room * (high > 0)


def _carter(run: xr.Dataset, creepages: Floats) -> list[Curve]:
    """Curves of Carter for a long roller, with the compliances of slow and of fast motion."""
    body, series = round_body(run, "traction-creepage"), contact_series(run, "traction-creepage")
    along = "xy".index(str(run.attrs["along"]))
    line = run["force_per_length"].values if "force_per_length" in run else None
    if not isinstance(body, Paraboloid) or series is None or line is None:
        return []
    if rolls_askew(run):  # which takes a part of the friction
        return []
    coefficient = float(case_of(run)["friction"]["coefficient"])
    relaxed = series.instant + float(series.amplitudes.sum())
    elastic = relaxed <= (1 + _ALIKE) * series.instant
    named = [("Carter", relaxed, "dashed")]
    if not elastic:
        slow = [] if series.fluidity else [("Carter, slow motion", relaxed, "dashed")]
        fast = [("Carter, fast motion", series.instant, "dotted")] if series.instant > 0 else []
        named = slow + fast
    at = np.linspace(*_with_zero(creepages), _POINTS)
    found = []
    for name, compliance, look in named:
        curvature = body.curvatures[along]
        half = math.sqrt(4 * float(line.max()) * compliance / (math.pi * curvature))
        share = np.minimum(np.abs(at) / (coefficient * half * curvature), 1.0)
        values = np.sign(at) * (1 - (1 - share) ** 2)
        found.append(Curve(at, values, name, FAINT, "dashed" if look == "dashed" else "dotted"))
    return found
