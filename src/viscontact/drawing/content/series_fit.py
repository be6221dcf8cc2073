"""Series fitted to measured values, and master curves with their shift factors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.panel import (
    FIRST,
    PERCENT,
    TEXT,
    Axis,
    Curve,
    Ink,
    Mark,
    MarkLook,
    Panel,
    spans_decades,
)
from viscontact.units.formatting import ReadableUnit, readable_unit
from viscontact.units.temperatures import in_celsius

if TYPE_CHECKING:
    from viscontact.bodies.series_fits import Fit
    from viscontact.identification import MasterCurve, ShiftFit

#: Curves among many.
_fine = partial(Curve, is_fine=True)
_LABELS = {
    "compliance": "Creep compliance",
    "modulus": "Relaxation modulus",
    "storage": "Storage modulus",
    "loss": "Loss modulus",
}


def fit_panels(fit: Fit) -> tuple[Panel, Panel]:
    """Panels of values and fit, with ticks at the times of the terms, and of the residuals."""
    later = fit.points > 0  # time 0 is not on a logarithmic axis
    points, along = fit.points[later], _geometric(fit.points[later])
    fitted, above, below = fit.curve(along), list[Curve](), list[Curve]()
    for (name, values), ink in zip(fit.measured.items(), (FIRST, Ink("fit")), strict=False):
        label, symbol = _LABELS[name] if len(fit.measured) > 1 else "", int(name == "loss")
        above.append(Curve(points, values[later], label, ink, "hollow", symbol=symbol))
        above.append(Curve(along, fitted[name], ink=ink))
        rest = fit.residuals[name][later]
        below.append(Curve(points, rest, ink=ink, look="points", symbol=symbol))
    times = np.array(fit.series.times)
    ticks = 1.0 / times if "storage" in fit.measured else times
    ticks = ticks[(ticks >= points.min()) & (ticks <= points.max())]
    note = f"{_count_of_terms(fit)} (ticks), residual {_residual_note(fit)}"
    reach = 1.15 * fit.largest_residual or 0.01
    x = _abscissa(fit.measured)
    if fit.found_shift is not None:
        x = replace(x, quantity=r"Reduced time $\xi$")
    return (
        Panel(
            *(x, _values_axis(fit.measured, f" {_symbol(fit)}"), tuple(above)),
            marks=tuple(Mark(float(place), look="tick", ink=TEXT) for place in ticks),
            title=f"{note}\n{_misfit_note(fit)}" if fit.misfit else "",
            note="" if fit.misfit else note,
        ),
        Panel(
            *(x, Axis("Residual", PERCENT, (-reach, reach)), tuple(below)), marks=(Mark(0.0, "y"),)
        ),
    )


def master_panels(
    curve: MasterCurve, fit: Fit | None, rules: Sequence[ShiftFit]
) -> tuple[Panel, Panel, Panel]:
    """Panels of the sets as measured, of the shift factors, and of the master curve."""
    celsius = in_celsius(curve.temperatures)
    places = (celsius - celsius.min()) / max(float(np.ptp(celsius)), 1.0)
    sets, master = [], []
    each = zip(
        curve.isotherms, curve.reduced_points, curve.reduced_values, places.tolist(), strict=True
    )
    for isotherm, reduced, raised, place in each:
        later, ink = isotherm.points > 0, Ink("temperature", place)
        for name, values in isotherm.measured.items():
            shown, symbol = values[later], int(name == "loss")
            set_look: MarkLook = "linked" if symbol else "joined"
            sets.append(_fine(isotherm.points[later], shown, "", ink, set_look, symbol=symbol))
            look: MarkLook = "hollow" if symbol else "points"
            joined = raised[name][later]
            master.append(_fine(reduced[later], joined, "", ink, look, symbol=symbol))
    if fit is not None:
        along = _geometric(curve.points)
        master += [_fine(along, values, ink=TEXT) for values in fit.curve(along).values()]
    measured, y = curve.measured, _values_axis(curve.measured)
    marked = ": ● storage, □ loss" if len(measured) > 1 else ""
    title = f"Master curve at {in_celsius(curve.reference_temperature):.4g} °C"
    if fit is not None:
        title += f", {_count_of_terms(fit)}, residual {_residual_note(fit)}"
        title += f"\n{_misfit_note(fit)}" if fit.misfit else ""
    return (
        Panel(_abscissa(measured), y, tuple(sets), title=f"As measured{marked}"),
        _shift_panel(curve, rules),
        Panel(_abscissa(measured, reduced=True), y, tuple(master), title=title),
    )


def _shift_panel(curve: MasterCurve, rules: Sequence[ShiftFit]) -> Panel:
    """Panel of shift factors, and of rules through them, over the temperature in °C."""
    between = np.linspace(curve.temperatures[0], curve.temperatures[-1], 200)
    source = "found" if curve.mismatches is not None else "given"
    factors = np.log10(curve.factors)
    curves = [
        Curve(
            in_celsius(between),
            np.log10(rule.shift.factor(between)),
            f"{type(rule.shift).__name__} ± {rule.residual:.2g} decades",
            Ink(place=number),
        )
        for number, rule in enumerate(rules)
    ]
    return Panel(
        Axis("Temperature", ReadableUnit("°C", 1.0)),
        Axis("log₁₀ of shift factor $a_T$", ReadableUnit("", 1.0)),
        (Curve(in_celsius(curve.temperatures), factors, source, TEXT, "hollow"), *curves),
        marks=(Mark(0.0, "y"),),
        title="Shift factors",
    )


def _values_axis(measured: Mapping[str, Floats], symbol: str = "") -> Axis:
    """Axis of measured columns, logarithmic if they span decades."""
    values = np.concatenate(list(measured.values()))
    quantity = _LABELS[next(iter(measured))] if len(measured) == 1 else "Modulus"
    unit = readable_unit("1/Pa" if "compliance" in measured else "Pa", values)
    is_log = spans_decades(float(values.min()), float(values.max()))
    return Axis(f"{quantity}{symbol}", unit, scale="log" if is_log else "linear")


def _abscissa(measured: Mapping[str, Floats], *, reduced: bool = False) -> Axis:
    """Axis of time or frequency, reduced by the shift factors or not."""
    oscillates = "storage" in measured
    name, symbol = ("Angular frequency", r"$\omega a_T$") if oscillates else ("Time", "$t/a_T$")
    unit = ReadableUnit("rad/s" if oscillates else "s", 1.0)
    return Axis(f"Reduced {name.lower()} {symbol}" if reduced else name, unit, scale="log")


def _count_of_terms(fit: Fit) -> str:
    """Number of terms of a fit, in words."""
    return f"{fit.terms} term{'' if fit.terms == 1 else 's'}"


def _residual_note(fit: Fit) -> str:
    """Residuals in words, of each column where there are two."""
    parts = {name: 100 * np.sqrt(np.mean(r**2)) for name, r in fit.residuals.items()}
    if len(parts) == 1:
        return f"{100 * fit.residual:.2g} % rms"
    return ", ".join(f"{value:.2g} % ({name})" for name, value in parts.items()) + " rms"


def _misfit_note(fit: Fit) -> str:
    """Misfit and its reason in words; empty for a fit that meets the data."""
    return f"Misses the data: {fit.misfit.reason.value}" if fit.misfit else ""


def _symbol(fit: Fit) -> str:
    """Symbol of the fitted quantity, by the convention of the data."""
    if "compliance" in fit.measured:
        return {"deviatoric": "Φ", "shear": "J", "uniaxial": "D"}[fit.data]
    letter = "E" if fit.data == "uniaxial" else "G"
    return letter if "modulus" in fit.measured else f"{letter}′, {letter}″"


def _geometric(points: Floats) -> Floats:
    """Points for a curve over the range of measured ones, even on a logarithmic axis."""
    return np.geomspace(points.min(), points.max(), 400)
