"""Result of a series fit: the law and its residuals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import CreepSeries, RelaxationSeries
from viscontact.bodies.series_fits.found_shift import FoundShift
from viscontact.bodies.series_fits.quality import Misfit
from viscontact.units.display import Displayable, Plotted

_SHOWN = 6  # terms that are printed


@dataclass(frozen=True, eq=False, repr=False)
class Fit(Displayable, Plotted):
    """Series fitted to measured values.

    Made by `fit_creep`, `fit_relaxation` and `fit_dynamic`.

    Attributes
    ----------
    law : CreepSeries or RelaxationSeries
        The law in shear, as everything else in the package takes it.
    series : CreepSeries or RelaxationSeries
        The same series in the terms of the data: with ``data="uniaxial"`` its numbers are D or
        E, with ``data="shear"`` compliances are 1/G.
    data : str
        Meaning of the values: ``"deviatoric"``, ``"shear"`` or ``"uniaxial"``.
    points : ndarray, shape (n,)
        Times [s], or angular frequencies [rad/s] of an oscillation.
    measured : mapping of str to ndarray
        The measured columns by name: ``compliance`` [1/Pa], ``modulus`` [Pa], or ``storage``
        and ``loss`` [Pa], or ``storage`` alone.
    weights : mapping of str to float
        Weight of the relative residuals of each of these columns [-].
    misfit : Misfit or None
        Size, reason and remedy of a misfit beyond 10 % (root mean square) or 25 % (largest) of a
        column; None for a fit within these limits.
    poisson_ratio, bulk_modulus : float or None
        Bulk behaviour used to convert uniaxial data [-, Pa].
    found_shift : FoundShift or None
        Shift of a test under a temperature that varied: the law is that at its reference
        temperature, and `points` are reduced times; None of a test at one temperature.

    Examples
    --------
    >>> from viscontact.bodies.series_fits.prony import fit_creep
    >>> times = np.geomspace(0.1, 100.0, 13)
    >>> fit = fit_creep(times, 1.0 - 0.5 * np.exp(-times / 5.0), data="deviatoric")
    >>> fit.terms, round(float(fit.law(1e9)), 3)
    (1, 1.0)
    """

    _figure: ClassVar[str] = "fitted_series"

    law: CreepSeries | RelaxationSeries
    series: CreepSeries | RelaxationSeries
    data: str
    points: Floats
    measured: Mapping[str, Floats]
    weights: Mapping[str, float]
    misfit: Misfit | None = None
    poisson_ratio: float | None = None
    bulk_modulus: float | None = None
    found_shift: FoundShift | None = None

    @property
    def terms(self) -> int:
        """Number of exponential terms of the series."""
        return len(self.series.times)

    @property
    def fitted(self) -> dict[str, Floats]:
        """Values of the series in place of each measured column."""
        return self.curve(self.points)

    @property
    def residuals(self) -> dict[str, Floats]:
        """Fitted over measured values, less 1, for each column [-]."""
        fitted = self.fitted
        return {name: fitted[name] / values - 1.0 for name, values in self.measured.items()}

    @property
    def residual(self) -> float:
        """Root mean square of all relative residuals [-]."""
        return float(np.sqrt(np.mean(np.concatenate(list(self.residuals.values())) ** 2)))

    @property
    def largest_residual(self) -> float:
        """Largest relative residual in magnitude [-]."""
        return self._worst()[0]

    def curve(self, points: ArrayLike) -> dict[str, Floats]:
        """Return the series at other points, in the convention of the data.

        Parameters
        ----------
        points : array_like, shape (m,)
            Times [s], or angular frequencies [rad/s] of an oscillation.

        Returns
        -------
        dict of str to ndarray
            The columns of `measured`, at these points.
        """
        at = np.asarray(points, dtype=np.float64)
        if "compliance" in self.measured:
            return {"compliance": self.series(at)}
        if "modulus" in self.measured:
            return {"modulus": self.series.relaxation(at)}
        modulus = np.asarray(self.series.complex_modulus(at))
        found = {"storage": modulus.real, "loss": modulus.imag}
        return {name: found[name] for name in self.measured}

    def __repr__(self) -> str:
        largest, column, row = self._worst()
        points, unit = np.sort(self.points), "rad/s" if "storage" in self.measured else "s"
        count = f"{self.terms} term{'' if self.terms == 1 else 's'}"
        return (
            f"Fit: {type(self.law).__name__} of {count} to {points.size} rows of {self.data} data "
            f"at {points[0]:.4g} to {points[-1]:.4g} {unit}\n"
            f"     relative residual {self._rms()} (root mean square), "
            f"largest {largest:.2e} ({column}, row {row})\n"
            f"{self._weights()}"
            f"     {_in_short(self.law)}"
            f"{'' if self.found_shift is None else f'{chr(10)}{self.found_shift!r}'}"
        )

    def _weights(self) -> str:
        """Line with the weights, where there are several columns."""
        if len(self.weights) == 1:
            return ""
        each = ", ".join(f"{name} {value:.3g}" for name, value in self.weights.items())
        return f"     weights of the relative residuals: {each}\n"

    def _rms(self) -> str:
        """Root mean square in words, of each column where there are two."""
        if len(self.measured) == 1:
            return f"{self.residual:.2e}"
        rms = {name: np.sqrt(np.mean(each**2)) for name, each in self.residuals.items()}
        return ", ".join(f"{value:.2e} of {name}" for name, value in rms.items())

    def _worst(self) -> tuple[float, str, int]:
        worst = (0.0, next(iter(self.measured)), 0)
        for name, residuals in self.residuals.items():
            row = int(np.argmax(np.abs(residuals)))
            worst = max(worst, (float(np.abs(residuals[row])), name, row))
        return worst


def _in_short(law: CreepSeries | RelaxationSeries) -> str:
    """Law with four digits and at most six terms."""
    parts = []
    for field in fields(law):
        value = getattr(law, field.name)
        if isinstance(value, tuple):
            numbers = [f"{number:.4g}" for number in value[:_SHOWN]]
            more = ["..."] if len(value) > _SHOWN else []
            parts.append(f"{field.name}=({', '.join(numbers + more)})")
        else:
            parts.append(f"{field.name}={value:.4g}")
    return f"{type(law).__name__}({', '.join(parts)})"
