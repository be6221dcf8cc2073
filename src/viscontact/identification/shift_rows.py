"""Shift factors of a master curve as rows of a table, with their intervals."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from viscontact.bodies.laws import WLF
from viscontact.identification.master_curve import MasterCurve
from viscontact.identification.shift_fit import ShiftFit
from viscontact.units.temperatures import in_celsius

_VERTICAL = {
    "none": "no vertical shift: b_T = 1",
    "rubber": "vertical shift of a rubber: b_T = T ρ/(T_r ρ_r)",
    "found": "vertical shift b_T found from the sets; that of a rubber is T/T_r",
}


def shift_head(curve: MasterCurve) -> list[str]:
    """Return the headings of the columns."""
    vertical = [] if curve.vertical == "none" else ["b_T", "T/T_r", "correlation"]
    return ["T [°C]", "log10 a_T", *vertical, "mismatch with the colder set"]


def shift_row(curve: MasterCurve, k: int) -> list[str]:
    """Return the cells of a set: temperature, factors with 95 % intervals, and mismatch."""
    about, kelvin = curve.uncertainty, curve.temperatures[k]
    half = 0.0 if about is None else about.decades[k]
    cells = [f"{round(in_celsius(kelvin), 6):.2f}"]
    cells.append(_with_interval(float(np.log10(curve.factors[k])), half))
    if curve.vertical != "none":
        raised = float(curve.vertical_factors[k])
        own = 0.0 if about is None else raised * about.vertical[k]
        cells.append(_with_interval(raised, own))
        cells.append(f"{kelvin / curve.reference_temperature:.3f}")
        correlation = np.nan if about is None else about.correlations[k]
        cells.append(_or_dash(correlation, "{:.2f}"))
    mismatch = np.nan if k == 0 or curve.mismatches is None else curve.mismatches[k - 1]
    return [*cells, _or_dash(100 * mismatch, "{:.2g} %")]


def shift_notes(curve: MasterCurve, rules: list[ShiftFit]) -> Iterator[str]:
    """Yield the kind of the vertical shift, the scatter of the sets, and rules through a_T."""
    yield _VERTICAL[curve.vertical]
    if curve.uncertainty is not None:
        scatter = curve.uncertainty.scatter.items()
        each = ", ".join(f"{name} {100 * part:.2g} %" for name, part in scatter)
        yield f"scatter about the common curve: {each}"
    for rule in rules:
        yield f"{_constants(rule)}, deviates by {rule.residual:.2g} decades (rms)"


def shift_rules(curve: MasterCurve) -> list[ShiftFit]:
    """Return the WLF and the Arrhenius rule through the factors, where the sets suffice."""
    rules = []
    for fitted in (curve.fit_wlf, curve.fit_arrhenius):
        try:
            rules.append(fitted())
        except ValueError:  # too few different temperatures
            continue
    return rules


def celsius(kelvin: float) -> str:
    """Temperature in words."""
    return f"{round(in_celsius(kelvin), 6):.4g} °C"


def _with_interval(value: float, half: float) -> str:
    if np.isinf(half):
        return "unknown"
    return f"{value:.3f} ± {half:.3f}" if half > 0 else f"{value:.3f}"


def _or_dash(value: float, form: str) -> str:
    return form.format(value) if np.isfinite(value) else "-"


def _constants(rule: ShiftFit) -> str:
    shift = rule.shift
    if isinstance(shift, WLF):
        return f"WLF with C1 = {shift.c1:.4g} and C2 = {shift.c2:.4g} K"
    return f"Arrhenius with {shift.activation_energy / 1e3:.4g} kJ/mol"
