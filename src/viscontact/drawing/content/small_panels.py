"""Panels of laws and of measured values, as small drawings show them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws import Elastic, Law, SeriesLaw, TabulatedCreep, TabulatedRelaxation
from viscontact.bodies.series_fits import Fit
from viscontact.drawing.content.panel import SECOND, Axis, Curve, Ink, Panel, spans_decades
from viscontact.identification import IndentationFit, IndentationRecord, Isotherm, MasterCurve
from viscontact.units.formatting import ReadableUnit

#: Number of points of a curve.
_POINTS = 121
#: A formula is drawn over its own times, and times shorter and longer by this factor.
_AROUND = 100.0
_FITTED = Ink("fit")
_PHI, _G = ("creep compliance Φ", "1/Pa"), ("relaxation modulus G", "Pa")


def law_panels(law: Law, part: str = "") -> list[Panel]:
    """Panels of compliance and modulus over log time, with rows of a table; none if elastic."""
    if isinstance(law, Elastic):
        return []
    span = law_span(law)
    if isinstance(law, TabulatedCreep):
        return [_law_panel(law, *_PHI, span, (law.times, law.compliance), part)]
    if isinstance(law, TabulatedRelaxation):
        return [_law_panel(law.relaxation, *_G, span, (law.times, law.modulus), part)]
    panels = [_law_panel(law, *_PHI, span, note=part)]
    if law(0.0) > 0 and law.inversion_error == 0:
        panels.append(_law_panel(law.relaxation, *_G, span, note=part))
    return panels


def law_span(law: Law) -> tuple[float, float]:
    """Return the first and the last time worth drawing, whole decades [s]."""
    if isinstance(law, TabulatedCreep | TabulatedRelaxation):
        times = [time for time in law.times if time > 0]
        return min(times), max(times) if len(times) > 1 else 10 * min(times)
    own = _own_times(law)
    if isinstance(law, SeriesLaw):
        own = (*own, *law.creep_series().times)
        own = (*own, *law.relaxation_series().times) if law(0.0) > 0 else own
    first, last = (min(own) / _AROUND, max(own) * _AROUND) if own else (1e-3, 1e3)
    return 10.0 ** math.floor(math.log10(first) + 1e-9), 10.0 ** math.ceil(math.log10(last) - 1e-9)


def _law_panel(
    of: Callable[[Floats], Floats],
    quantity: str,
    si: str,
    span: tuple[float, float],
    rows: tuple[Sequence[float], Sequence[float]] | None = None,
    note: str = "",
) -> Panel:
    times = np.geomspace(*span, _POINTS)
    values = of(times)
    curves = [Curve(times, values)]
    if rows is not None:
        at, known = (np.asarray(each, dtype=np.float64) for each in rows)
        curves.append(Curve(at, known, ink=SECOND, look="points"))
    x = Axis("Time", ReadableUnit("s", 1.0), span, "log", span[0], in_clock_units=True)
    known = values[np.isfinite(values)]
    # What flows; what relaxes goes to zero on a linear one.
    y = _values_axis(quantity.split()[-1], si, known, spans_decades(known[0], known[-1]))
    return Panel(x, y, tuple(curves), title=quantity, note=note)


def _own_times(law: Law) -> tuple[float, ...]:
    """All arguments above 0 that are times, those of laws within laws as well [s]."""
    found: list[float] = []
    for item in dataclasses.fields(law):
        value = getattr(law, item.name)
        if isinstance(value, Law):
            found += _own_times(value)
        elif item.metadata.get("unit") == "s":
            found += np.atleast_1d(np.asarray(value, dtype=np.float64)).tolist()
    return tuple(time for time in found if 0 < time < math.inf)


def record_panels(record: IndentationRecord) -> tuple[Panel, Panel]:
    """Panels of the force over the approach, and of the approach over time."""
    some = slice(None, None, math.ceil(record.times.size / (2 * _POINTS)))
    t, d, F = (each[some] for each in (record.times, record.approach, record.force))
    time, approach, force = _axis("Time", "s", t), _axis("Approach", "m", d), _axis("Force", "N", F)
    return (
        Panel(approach, force, (Curve(d, F),), title="force over approach"),
        Panel(time, approach, (Curve(t, d),), title="approach over time"),
    )


def fit_panels(fit: Fit) -> list[Panel]:
    """Panels of the columns of a fitted series."""
    least = float(fit.points[fit.points > 0].min())
    points = np.geomspace(least, float(fit.points.max()), _POINTS)
    curves, oscillates = fit.curve(points), "storage" in fit.measured
    return [
        _measured(name, [(fit.points, values)], oscillates, (points, curves[name]))
        for name, values in fit.measured.items()
    ]


def indentation_fit_panel(fit: IndentationFit) -> Panel:
    """Panel of the fitted quantity over time."""
    quantity, si = ("Force", "N") if fit.given == "approach" else ("Approach", "m")
    times, both = fit.record.times, np.concatenate([fit.measured, fit.fitted])
    curves = Curve(times, fit.measured, look="points"), Curve(times, fit.fitted, ink=_FITTED)
    title = f"{quantity.lower()} over time"
    return Panel(_axis("Time", "s", times), _axis(quantity, si, both), curves, title=title)


def isotherm_panels(isotherm: Isotherm) -> list[Panel]:
    """Panels of the columns of a test at one temperature."""
    return [
        _measured(name, [(isotherm.points, values)], isotherm.oscillates)
        for name, values in isotherm.measured.items()
    ]


def master_curve_panels(curve: MasterCurve) -> list[Panel]:
    """Panels of the columns of all shifted sets."""
    oscillates = curve.isotherms[0].oscillates
    each = list(zip(curve.reduced_points, curve.isotherms, strict=True))
    return [
        _measured(
            name, [(points, isotherm.measured[name]) for points, isotherm in each], oscillates
        )
        for name in curve.measured
    ]


def _measured(
    name: str,
    sets: list[tuple[Floats, Floats]],
    oscillates: bool,
    fitted: tuple[Floats, Floats] | None = None,
) -> Panel:
    """Values over time or frequency, neighbouring sets in two colours, and a curve over them."""
    curves = [Curve(*each, ink=Ink(place=k % 2), look="points") for k, each in enumerate(sets)]
    if fitted is not None:
        curves.append(Curve(*fitted, ink=_FITTED))
    x = _positive_axis(oscillates, (points for points, _ in sets))
    values = np.concatenate([each for _, each in sets])
    si = "1/Pa" if name == "compliance" else "Pa"
    y = _values_axis(name, si, values, spans_decades(values.min(), values.max()))
    return Panel(x, y, tuple(curves), title=name)


def _positive_axis(oscillates: bool, sets: Iterable[Floats]) -> Axis:
    """Logarithmic axis of times or frequencies above zero."""
    points = np.concatenate(list(sets))
    later = points[points > 0]
    low, high = float(later.min()) / 1.3, float(later.max()) * 1.3
    if oscillates:
        return Axis.over_decades("Angular frequency", "rad/s", low, high)
    return Axis("Time", ReadableUnit("s", 1.0), (low, high), "log", low, in_clock_units=True)


def _values_axis(quantity: str, si: str, values: Floats, is_log: bool) -> Axis:
    """Axis of values above zero."""
    low, high = float(values.min()), float(values.max())
    if is_log:
        return Axis.over_decades(quantity, si, 0.8 * low, 1.2 * high)
    top = 1.08 * high
    # A curve that moves little is drawn around itself; others down to zero.
    return Axis.between(quantity, si, low - 0.15 * (top - low) if low > 0.5 * top else 0.0, top)


def _axis(quantity: str, si: str, values: Floats) -> Axis:
    """Axis from zero, or the least value, with room at both ends."""
    low, high = float(min(values.min(), 0.0)), float(values.max())
    room = 0.06 * ((high - low) or 1.0)
    return Axis.between(quantity, si, low - room, high + room)
