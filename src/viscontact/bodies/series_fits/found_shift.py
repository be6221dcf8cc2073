"""Shift found together with a law from a record under a temperature that varies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Shift
from viscontact.units.temperatures import in_celsius

_UNITS = {"activation_energy": ("kJ/mol", 1e3), "c1": ("", 1.0), "c2": ("K", 1.0)}
_WORDS = {"activation_energy": "activation energy", "c1": "C1", "c2": "C2"}


@dataclass(frozen=True, eq=False, repr=False)
class FoundShift:
    """Shift of a creep or relaxation test under a temperature that varies.

    Made by `fit_creep` and `fit_relaxation` with `temperature`.

    Attributes
    ----------
    shift : WLF, Arrhenius or TabulatedShift
        The rule, with the temperature of the law as reference.
    reference_temperature : float
        Temperature of the law [K].
    parameters : mapping of str to float
        Parameters that were found, in SI units: ``activation_energy`` [J/mol]; ``c1`` [-] and
        ``c2`` [K]; or the factors of a table. Empty for a given shift.
    intervals : mapping of str to (float, float)
        Interval of each.
    confidence : float
        Probability of the intervals [-].
    temperatures, decades, errors : ndarray, shape (m,)
        Temperatures at which the record dwells, or some that it passes [K], log10 a_T there, and
        half the width of its interval [-].
    criteria : mapping of str to float
        By rule, the information criterion of Schwarz above that of the chosen one [-].
    expansion : float or None
        Strain per unit stress and per kelvin that was found as thermal expansion [1/(Pa K)];
        times the stress it is the coefficient of linear expansion. None if it was not sought.
    expansion_error : float
        Half the width of its interval.
    widening : float
        Largest ratio of an interval to that of white noise of the same size [-].
    warnings : tuple of str
        What is doubtful.

    Examples
    --------
    A step of 10 K after an hour of creep, which makes it four times as fast:

    >>> from viscontact.bodies.laws import Arrhenius, CreepSeries
    >>> from viscontact.bodies.loads.temperature import TemperatureHistory
    >>> from viscontact.bodies.series_fits.prony import fit_creep
    >>> times, rate = np.linspace(60.0, 7200.0, 120), 1 / Arrhenius(293.15, 100e3).factor(303.15)
    >>> reduced = np.minimum(times, 3600.0) + rate * np.maximum(times - 3600.0, 0.0)
    >>> history = TemperatureHistory([0, 3600, 3600], [293.15, 293.15, 303.15])
    >>> creep = CreepSeries(1e-9, [1e-9, 2e-9], [500.0, 2e4])(reduced)
    >>> fit = fit_creep(
    ...     times, creep, data="shear", temperature=history, shift="arrhenius", thermal_strain=False
    ... )
    >>> round(fit.found_shift.parameters["activation_energy"] / 1e3, 3)
    100.0
    """

    shift: Shift
    reference_temperature: float
    temperatures: Floats
    decades: Floats
    errors: Floats
    parameters: Mapping[str, float] = field(default_factory=dict)
    intervals: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    confidence: float = 0.95
    criteria: Mapping[str, float] = field(default_factory=dict)
    expansion: float | None = None
    expansion_error: float = 0.0
    widening: float = 1.0
    warnings: tuple[str, ...] = ()

    def __repr__(self) -> str:
        lines = [
            f"Shift: {type(self.shift).__name__}{self._constants()}; the law is that at "
            f"{round(in_celsius(self.reference_temperature), 2):.6g} °C, over the reduced time"
        ]
        lines += [
            f"     {round(in_celsius(kelvin), 2):8.2f} °C: log10 a_T = {value:.3f} ± {error:.3f}"
            for kelvin, value, error in zip(
                self.temperatures.tolist(), self.decades.tolist(), self.errors.tolist(), strict=True
            )
        ]
        if self.expansion is not None:
            found, error = 1e6 * self.expansion, 1e6 * self.expansion_error
            lines.append(f"     thermal strain per stress {found:.4g} ± {error:.2g} /(MPa K)")
        others = [f"{name} {value:.1f}" for name, value in self.criteria.items() if value > 0]
        if others:
            lines.append(f"     information criterion above this rule: {', '.join(others)}")
        return "\n".join(lines)

    def _constants(self) -> str:
        """Parameters with their intervals, those of a table left out."""
        parts = []
        for name, value in self.parameters.items():
            if name not in _UNITS:
                continue
            unit, size = _UNITS[name]
            low, high = (each / size for each in self.intervals[name])
            parts.append(f"{_WORDS[name]} {value / size:.4g} {unit}".rstrip())
            parts[-1] += f" ({low:.4g} to {high:.4g})"
        return f", {', '.join(parts)}" if parts else ""


def factors_over(shift: Shift, temperatures: ArrayLike) -> Floats:
    """log10 a_T at temperatures [K]."""
    return np.asarray(np.log10(shift.factor(np.asarray(temperatures, dtype=float))))
