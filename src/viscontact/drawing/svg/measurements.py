"""Overviews of measurements and fits: data as dots, the identified law as a line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.series_fits import Fit
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.content.small_panels import (
    fit_panels,
    indentation_fit_panel,
    isotherm_panels,
    master_curve_panels,
    record_panels,
)
from viscontact.drawing.svg.overview import Overview
from viscontact.drawing.svg.panel_drawing import panel_drawing
from viscontact.identification import (
    CurveFits,
    IndentationFit,
    IndentationRecord,
    Isotherm,
    MasterCurve,
)
from viscontact.results.argument_table import in_plain_words
from viscontact.results.formatting import format_percent
from viscontact.units.formatting import format_number, format_quantity
from viscontact.units.temperatures import in_celsius


def record_overview(record: IndentationRecord) -> Overview:
    """Make the overview of an indentation record."""
    rows = [
        ("indenter", in_plain_words(type(record.indenter).__name__)),
        ("rows", str(record.times.size)),
        ("duration", format_quantity(float(np.ptp(record.times)), "s")),
        ("largest approach", format_quantity(float(record.approach.max()), "m")),
        ("largest force", format_quantity(float(record.force.max()), "N")),
    ]
    return _overview("Indentation record", rows, record_panels(record))


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
    return _overview("Fit", rows, fit_panels(fit))


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
    if fit.thickness is not None:
        rows.append(("film", f"{format_quantity(fit.thickness, 'm', 4)} on a rigid base"))
    if fit.contact is not None:
        low, high = (format_quantity(end, "m", 5) for end in fit.contact.position_interval)
        at = format_quantity(fit.contact.position, "m", 5)
        rows.append(("contact point", f"{at} ({level}: {low} to {high})"))
    other, unit = ("force", "N") if fit.given == "approach" else ("approach", "m")
    duration = min(fit.until, float(fit.record.times[-1])) - float(fit.record.times[0])
    rows += [
        ("given", f"{fit.given} over {format_quantity(duration, 's')}"),
        (f"misses the {other} by", f"{format_percent(fit.residual)} of the largest (rms)"),
        *([("warning", fit.misfit.reason.value)] if fit.misfit else []),
    ]
    return _overview("Fit of an indentation", rows, [indentation_fit_panel(fit)])


def curve_fits_overview(fits: CurveFits) -> Overview:
    """Make the overview of fits to many curves: medians, and the range of half of the curves."""
    title, *rows = repr(fits).splitlines()
    stated = [tuple(row.strip().split(" = ", 1)) for row in rows if " = " in row]
    named = [(name.replace("_", " "), value) for name, value in stated]
    return _overview("Fits of many curves", [("curves", title.partition(": ")[2]), *named], [])


def isotherm_overview(isotherm: Isotherm) -> Overview:
    """Make the overview of a test at one temperature."""
    points = isotherm.points
    rows = [
        ("temperature", _celsius(isotherm.temperature)),
        *_point_rows(points, isotherm.oscillates),
        ("columns", ", ".join(isotherm.measured)),
    ]
    return _overview("Isotherm", rows, isotherm_panels(isotherm))


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
    return _overview("Master curve", rows, master_curve_panels(curve))


def _overview(title: str, rows: list[tuple[str, str]], panels: Iterable[Panel]) -> Overview:
    return Overview(title, rows, list(map(panel_drawing, panels)))


def _point_rows(points: Floats, oscillates: bool) -> Iterator[tuple[str, str]]:
    yield "rows", str(points.size)
    ends = float(points.min()), float(points.max())
    if oscillates:
        yield "angular frequency", " to ".join(f"{format_number(end)} rad/s" for end in ends)
    else:
        yield "time", " to ".join(format_quantity(end, "s") for end in ends)


def _format(value: float, unit: str) -> str:
    return format_quantity(value, unit) if unit else format_number(value)


def _celsius(kelvin: float) -> str:
    return f"{round(in_celsius(kelvin), 6):.4g} °C"
