"""Shift factors of a master curve, printed with their intervals."""

from __future__ import annotations

import numpy as np

from viscontact.bodies.laws import WLF
from viscontact.cli.terminal.messages import put
from viscontact.identification import MasterCurve, ShiftFit
from viscontact.units.temperatures import in_celsius

_VERTICAL = {
    "none": "no vertical shift: b_T = 1",
    "rubber": "vertical shift of a rubber: b_T = T ρ/(T_r ρ_r)",
    "found": "vertical shift b_T found from the sets; that of a rubber is T/T_r",
}


def print_shifts(curve: MasterCurve, rules: list[ShiftFit]) -> None:
    """Print a_T and b_T of each set with their 95 % intervals, and rules through a_T."""
    sets, reference = len(curve.isotherms), celsius(curve.reference_temperature)
    put(f"{sets} sets, shifted to {reference}; intervals are those of 95 %:")
    vertical = (
        "" if curve.vertical == "none" else f"  {'b_T':>13}  {'T/T_r':>6}  {'correlation':>11}"
    )
    put(f"{'T [°C]':>9}  {'log10 a_T':>15}{vertical}  mismatch with the colder set")
    for k in range(sets):
        put(_row(curve, k))
    put(_VERTICAL[curve.vertical])
    if curve.uncertainty is not None:
        scatter = curve.uncertainty.scatter.items()
        each = ", ".join(f"{name} {100 * part:.2g} %" for name, part in scatter)
        put(f"scatter about the common curve: {each}")
    for rule in rules:
        put(f"{_constants(rule)}, deviates by {rule.residual:.2g} decades (rms)")


def _row(curve: MasterCurve, k: int) -> str:
    about, kelvin = curve.uncertainty, curve.temperatures[k]
    half = 0.0 if about is None else about.decades[k]
    words = [f"{round(in_celsius(kelvin), 6):9.2f}"]
    words.append(_with_interval(float(np.log10(curve.factors[k])), half).rjust(15))
    if curve.vertical != "none" and about is not None:
        raised = float(curve.vertical_factors[k])
        words.append(_with_interval(raised, raised * about.vertical[k]).rjust(13))
        words.append(f"{kelvin / curve.reference_temperature:6.3f}")
        words.append(_or_dash(about.correlations[k], "{:.2f}").rjust(11))
    mismatch = np.nan if k == 0 or curve.mismatches is None else curve.mismatches[k - 1]
    words.append(_or_dash(100 * mismatch, "{:.2g} %"))
    return "  ".join(words)


def _with_interval(value: float, half: float) -> str:
    if np.isinf(half):
        return "unknown"
    return f"{value:.3f} ± {half:.3f}" if half > 0 else f"{value:.3f}        "


def _or_dash(value: float, form: str) -> str:
    return form.format(value) if np.isfinite(value) else "-"


def _constants(rule: ShiftFit) -> str:
    shift = rule.shift
    if isinstance(shift, WLF):
        return f"WLF with C1 = {shift.c1:.4g} and C2 = {shift.c2:.4g} K"
    return f"Arrhenius with {shift.activation_energy / 1e3:.4g} kJ/mol"


def celsius(kelvin: float) -> str:
    """Temperature in words."""
    return f"{round(in_celsius(kelvin), 6):.4g} °C"
