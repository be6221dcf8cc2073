"""Measured values, a fit and its residuals: over approach, and over time."""

from __future__ import annotations

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
from viscontact.identification import ContactPoint, IndentationFit
from viscontact.identification.contact_point import deflection_in_contact
from viscontact.units.formatting import readable_unit

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
    elastic = baseline + deflection_in_contact(
        contact.indenter, contact.contact_modulus, curve.spring_constant, along - contact.position
    )
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
