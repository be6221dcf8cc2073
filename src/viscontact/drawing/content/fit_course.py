"""Measured values, a fit and its residuals: over approach, and over time."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.panel import (
    FAINT,
    FIRST,
    PERCENT,
    Axis,
    Curve,
    Ink,
    Mark,
    Panel,
    Units,
)
from viscontact.units.formatting import readable_unit

if TYPE_CHECKING:
    from viscontact.identification import AdhesionFit, ContactPoint, IndentationFit

#: Colour of what was fitted.
FITTED = Ink("fit")
#: Parts of the largest approach that are shown before contact, and beyond the outermost rows: all
#: rows before and after contact would leave the contact little room.
_BEFORE, _BEYOND = 0.15, 0.05
#: Most points of a measured curve, of longer ones every so many; and points of a fitted one.
_MOST, _SAMPLES = 3000, 300


def force_panel(fit: IndentationFit, units: Units = readable_unit) -> Panel:
    """Force over approach, measured and from the fitted law."""
    record, counted = fit.record, np.isfinite(fit.residuals)
    d, F = (record.approach, fit.fitted) if fit.given == "approach" else (fit.fitted, record.force)
    low, deepest = float(record.approach.min()), float(record.approach.max())
    shown = max(low - _BEYOND * deepest, -_BEFORE * deepest), (1 + _BEYOND) * deepest
    within = record.approach[record.approach >= shown[0]]
    return Panel(
        Axis("Approach", units("m", within), shown if deepest > 0 else None),
        Axis.of("Force", "N", record.force, units=units),
        (
            Curve(record.approach, record.force, "measured", look="hollow"),
            Curve(d[counted], F[counted], "fitted", FITTED),
        ),
    )


def adhesion_panel(fit: AdhesionFit) -> Panel:
    """Force over the approach of the tip, measured and fitted, with the jumps of the fit."""
    measured, approach, fitted = fit.approach, fit.fitted_approach, fit.fitted
    jumps = _jumps(fit)
    held = approach[np.isfinite(fitted) & (fitted != 0)]
    reached = np.concatenate([held, *(jump.x for jump in jumps)])
    low, high = float(reached.min()), float(reached.max())
    beyond = _BEYOND * (high - low)
    low, high = low - beyond, high + beyond
    shown = (measured >= low) & (measured <= high)
    return Panel(
        Axis.between("Approach", "m", low, high),
        Axis.of("Force", "N", fit.measured),
        (
            Curve(measured[shown], fit.measured[shown], "measured", look="hollow", is_fine=True),
            Curve(approach, fitted, "fitted", FITTED),
            *jumps,
        ),
        note=_work(fit),
    )


def _jumps(fit: AdhesionFit) -> list[Curve]:
    """Jumps into contact and off, at the base position of the last row before each.

    There the tip moves with its cantilever, between no force and the contact, which is that of the
    retraction: the rows of the approach beside the jump were not fitted.
    """
    base = fit.curve.position - fit.contact.position
    turn, counted = fit.curve.loading_rows, np.isfinite(fit.fitted)
    held = counted & (fit.fitted != 0)
    back = np.flatnonzero(held[turn:])[::-1] + turn
    into = int(np.flatnonzero(counted & ~held & (np.arange(held.size) < turn))[-1])
    spring, jumps = fit.curve.spring_constant, []
    if back.size:
        at = max(base[into], base[back[0]])
        jumps.append((at, 0.0, float(np.interp(at, base[back], fit.fitted[back]))))
    if back.size and back[0] + 1 < held.size:
        jumps.append((base[back[0]], float(fit.fitted[back[0]]), 0.0))
    return [
        Curve(at - np.array(forces) / spring, np.array(forces), "", FITTED, "dashed")
        for at, *forces in jumps
    ]


def _work(fit: AdhesionFit) -> str:
    """Work of adhesion and its interval."""
    found, (low, high) = fit.parameters["work"], fit.intervals["work"]
    unit = readable_unit("J/m^2", high)
    value, least, most = (f"{each:.3g}" for each in unit([found, low, high]))
    return f"work {value} {unit.symbol} ({fit.confidence:.0%}: {least} to {most})"


def adhesion_course(fit: AdhesionFit) -> tuple[Panel, Panel]:
    """Measured and fitted force over time, interrupted beside jumps, and the residuals."""
    times = fit.curve.times
    above, below = course_panels("Force", "N", times, fit.measured, fit.fitted, fit.residuals)
    measured, _ = above.curves
    drawn = (measured, Curve(times, fit.fitted, "fitted", FITTED))
    return replace(above, curves=drawn), below


def course_of(fit: IndentationFit, units: Units = readable_unit) -> tuple[Panel, Panel]:
    """Fitted quantity of a record over time, and its residuals."""
    quantity, si = ("Force", "N") if fit.given == "approach" else ("Approach", "m")
    columns = (fit.record.times, fit.measured, fit.fitted, fit.residuals)
    return course_panels(quantity, si, *columns, units=units)


def course_panels(
    quantity: str,
    si: str,
    times: Floats,
    measured: Floats,
    fitted: Floats,
    residuals: Floats,
    *,
    units: Units = readable_unit,
) -> tuple[Panel, Panel]:
    """Panels of measured and fitted values over time [s], and of their residuals [-]."""
    x, counted = Axis.of("Time", "s", times, units=units), np.isfinite(residuals)
    curves = (
        Curve(times, measured, "measured", look="hollow"),
        Curve(times[counted], fitted[counted], "fitted", FITTED),
    )
    return (
        Panel(x, Axis.of(quantity, si, measured, units=units), curves),
        Panel(
            x,
            Axis("Residual", PERCENT),
            (Curve(times, residuals, look="hollow"),),
            marks=(Mark(0.0, "y"),),
        ),
    )


def contact_panel(contact: ContactPoint, units: Units = readable_unit) -> Panel:
    """Force curve with its baseline and the elastic body that gives the contact point."""
    curve = contact.curve
    every = slice(None, None, -(-curve.position.size // _MOST))
    along = np.linspace(curve.position.min(), curve.position.max(), _SAMPLES)
    baseline = contact.offset + contact.slope * along
    elastic = baseline + contact.elastic_bending(along)
    return Panel(
        Axis.of("Position", "m", curve.position, units=units),
        Axis.of("Deflection", "m", curve.deflection, units=units),
        (
            Curve(curve.position[every], curve.deflection[every], ink=FIRST, look="hollow"),
            Curve(along, elastic, ink=FITTED),
            Curve(along, baseline, ink=FAINT, look="dashed"),
        ),
        marks=(Mark(contact.position),),
        note="line: elastic body from the contact point on; dashed: baseline",
    )
