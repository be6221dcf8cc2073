"""Overviews of measurements and fits: data as dots, the identified law as a line."""

from __future__ import annotations

import math
from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.look import BLUE, ORANGE
from viscontact.drawing.svg.overview import Overview
from viscontact.drawing.svg.svg_axes import AxisScale, linear, logarithmic
from viscontact.drawing.svg.svg_panel import SvgCurve, panel
from viscontact.identification import Fit, IndentationFit, IndentationRecord, Isotherm, MasterCurve
from viscontact.results.argument_table import in_plain_words
from viscontact.results.formatting import format_percent
from viscontact.units.formatting import format_number, format_quantity
from viscontact.units.temperatures import in_celsius

#: Number of rows that are drawn as dots, and of points of a curve.
_DOTS, _POINTS = 40, 121
#: Beyond this ratio of largest to smallest value the axis is logarithmic.
_DECADES = 20.0
_UNITS = {"compliance": "1/Pa", "modulus": "Pa", "storage": "Pa", "loss": "Pa"}


def record_overview(record: IndentationRecord) -> Overview:
    """Make the overview of an indentation record."""
    rows = [
        ("indenter", in_plain_words(type(record.indenter).__name__)),
        ("rows", str(record.times.size)),
        ("duration", format_quantity(float(np.ptp(record.times)), "s")),
        ("largest approach", format_quantity(float(record.approach.max()), "m")),
        ("largest force", format_quantity(float(record.force.max()), "N")),
    ]
    drawn = [
        _lines("force over approach", record.approach, ("approach", "m"), record.force, "N"),
        _lines("approach over time", record.times, ("time", "s"), record.approach, "m"),
    ]
    return Overview("Indentation record", rows, drawn)


def fit_overview(fit: Fit) -> Overview:
    """Make the overview of a series fitted to measured values."""
    oscillates = "storage" in fit.measured
    parts = {name: float(np.sqrt(np.mean(each**2))) for name, each in fit.residuals.items()}
    rows = [
        ("law", f"{in_plain_words(type(fit.law).__name__)}, terms: {fit.terms}"),
        *_point_rows(fit.points, oscillates),
        ("data", fit.data),
        *(
            (f"misses the {name} by", f"{format_percent(part)} (rms)")
            for name, part in parts.items()
        ),
        ("at most by", format_percent(fit.largest_residual)),
        *((f"weight of the {name}", format_number(value)) for name, value in _weights(fit)),
        *([("warning", fit.misfit.reason.value)] if fit.misfit else []),
    ]
    least = float(fit.points[fit.points > 0].min())
    points = np.geomspace(least, float(fit.points.max()), _POINTS)
    curves = fit.curve(points)
    drawn = [
        _scatter(name, [(fit.points, values)], oscillates, (points, curves[name]))
        for name, values in fit.measured.items()
    ]
    return Overview("Fit", rows, drawn)


def _weights(fit: Fit) -> list[tuple[str, float]]:
    """Weights of the columns, where there are several."""
    return list(fit.weights.items()) if len(fit.weights) > 1 else []


def indentation_fit_overview(fit: IndentationFit) -> Overview:
    """Make the overview of a law fitted to an indentation record."""
    level = f"{fit.confidence:.0%}".replace("%", " %")
    rows = [("law", in_plain_words(type(fit.law).__name__))]
    for (name, value), unit in zip(fit.parameters.items(), fit.units, strict=True):
        low, high = (_format(end, unit) for end in fit.intervals[name])
        interval = f"{_format(value, unit)} ({level}: {low} to {high})"
        rows.append((name.replace("_", " "), interval))
    other, unit = ("force", "N") if fit.given == "approach" else ("approach", "m")
    rows += [
        ("given", f"{fit.given} over {format_quantity(float(np.ptp(fit.record.times)), 's')}"),
        (f"misses the {other} by", f"{format_percent(fit.residual)} of the largest (rms)"),
    ]
    times, some = fit.record.times, _thin_slice(fit.record.times.size)
    marks = [SvgCurve(times[some], fit.measured[some], "dots", ORANGE), SvgCurve(times, fit.fitted)]
    both = np.concatenate([fit.measured, fit.fitted])
    drawn = panel(f"{other} over time", _axis("time", "s", times), _axis(other, unit, both), marks)
    return Overview("Fit of an indentation", rows, [drawn])


def isotherm_overview(isotherm: Isotherm) -> Overview:
    """Make the overview of a test at one temperature."""
    points = isotherm.points
    rows = [
        ("temperature", _celsius(isotherm.temperature)),
        *_point_rows(points, isotherm.oscillates),
        ("columns", ", ".join(isotherm.measured)),
    ]
    drawn = [
        _scatter(name, [(points, values)], isotherm.oscillates)
        for name, values in isotherm.measured.items()
    ]
    return Overview("Isotherm", rows, drawn)


def master_curve_overview(curve: MasterCurve) -> Overview:
    """Make the overview of a master curve."""
    oscillates = curve.isotherms[0].oscillates
    rows = [
        ("reference temperature", _celsius(curve.reference_temperature)),
        ("made of", f"{len(curve.isotherms)} sets"),
        *_point_rows(curve.points, oscillates),
        *(
            (f"shift factor at {_celsius(each.temperature)}", format_number(float(factor)))
            for each, factor in zip(curve.isotherms, curve.factors, strict=True)
        ),
    ]
    drawn = [
        _scatter(
            name,
            [
                (points, each.measured[name])
                for points, each in zip(curve.reduced_points, curve.isotherms, strict=True)
            ],
            oscillates,
        )
        for name in curve.measured
    ]
    return Overview("Master curve", rows, drawn)


def _point_rows(points: Floats, oscillates: bool) -> Iterator[tuple[str, str]]:
    yield "rows", str(points.size)
    ends = float(points.min()), float(points.max())
    if oscillates:
        yield "angular frequency", " to ".join(f"{format_number(end)} rad/s" for end in ends)
    else:
        yield "time", " to ".join(format_quantity(end, "s") for end in ends)


def _scatter(
    name: str,
    sets: list[tuple[Floats, Floats]],
    oscillates: bool,
    curve: tuple[Floats, Floats] | None = None,
) -> Element:
    """Values over time or frequency, neighbouring sets in two colours, and a curve over them."""
    points = np.concatenate([each for each, _ in sets])
    later = points[points > 0]
    ends = float(later.min()) / 1.3, float(later.max()) * 1.3
    x = logarithmic("angular frequency", "rad/s", *ends)
    if not oscillates:
        x = logarithmic("time", "s", *ends, each_with_unit=True)
    marks = []
    for index, (at, values) in enumerate(sets):
        some = _thin_slice(at.size, max(4, _DOTS // len(sets)))
        # Neighbouring sets differ.
        colour = BLUE if index % 2 else ORANGE
        marks.append(SvgCurve(at[some], values[some], "dots", colour))
    if curve is not None:
        marks.append(SvgCurve(*curve))
    values = np.concatenate([each for _, each in sets])
    return panel(name, x, _positive_axis(name, values), marks)


def _positive_axis(name: str, values: Floats) -> AxisScale:
    low, high = float(values.min()), float(values.max())
    if high > _DECADES * low:
        return logarithmic(name, _UNITS[name], 0.8 * low, 1.2 * high)
    return linear(name, _UNITS[name], 0.0, 1.08 * high, 3)


def _lines(head: str, x: Floats, along: tuple[str, str], y: Floats, unit: str) -> Element:
    some = _thin_slice(x.size, 2 * _POINTS)
    marks = [SvgCurve(x[some], y[some], colour=ORANGE)]
    return panel(head, _axis(*along, x), _axis(head.split()[0], unit, y), marks)


def _axis(name: str, unit: str, values: Floats) -> AxisScale:
    low, high = float(min(values.min(), 0.0)), float(values.max())
    room = 0.06 * ((high - low) or 1.0)
    return linear(name, unit, low - room, high + room, 3)


def _thin_slice(count: int, most: int = _DOTS) -> slice:
    return slice(None, None, math.ceil(count / most))


def _format(value: float, unit: str) -> str:
    return format_quantity(value, unit) if unit else format_number(value)


def _celsius(kelvin: float) -> str:
    return f"{round(in_celsius(kelvin), 6):.4g} °C"
