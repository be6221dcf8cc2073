"""Fit of WLF and Arrhenius rules to shift factors."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import least_squares

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import WLF, Arrhenius
from viscontact.bodies.laws.time_temperature import GAS_CONSTANT
from viscontact.bodies.series_fits.columns import positive_column, require_rows

# Starting values: the universal constants.
_UNIVERSAL = (17.44, 51.6)
_LARGEST_C2 = 1e5  # [K]; with a larger one the rule is an exponential


@dataclass(frozen=True)
class ShiftFit:
    """Rule fitted to shift factors.

    Attributes
    ----------
    shift : WLF or Arrhenius
        The rule.
    residual : float
        Root mean square of the difference in log10 a_T [decades].
    largest_residual : float
        Its largest magnitude [decades].

    Examples
    --------
    >>> fit = fit_wlf([293.15, 303.15, 313.15], [1.0, 0.0316228, 0.00215443], 293.15)
    >>> fit.residual < 1e-3
    True
    """

    shift: WLF | Arrhenius
    residual: float
    largest_residual: float


def fit_wlf(temperatures: ArrayLike, factors: ArrayLike, reference_temperature: float) -> ShiftFit:
    """Fit a WLF rule with a_T = 1 at the reference temperature to shift factors.

    Parameters
    ----------
    temperatures : array_like, shape (n,)
        Absolute temperatures, three or more [K].
    factors : array_like, shape (n,)
        Shift factors a_T > 0 [-].
    reference_temperature : float
        Temperature at which a_T = 1 [K].

    Returns
    -------
    ShiftFit
        The rule and its residuals.

    Raises
    ------
    ValueError
        If a number is not positive or there are fewer than three.

    Notes
    -----
    Least squares in log10 a_T; C_2 is kept so large that the rule's pole lies below the lowest
    temperature. Below the glass transition the rule does not hold, and the residual shows it.

    Examples
    --------
    >>> T = [353.15, 373.15, 393.15, 413.15]
    >>> fit = fit_wlf(T, WLF(373.15, 12.0, 70.0).factor(T), 373.15)
    >>> round(fit.shift.c1, 4), round(fit.shift.c2, 4)
    (12.0, 70.0)
    """
    above, logs = _check("fit_wlf", temperatures, factors, reference_temperature, least=3)
    pole = max(0.0, -float(above.min()))

    def rule(parameters: Floats) -> Floats:
        c1, beyond_pole = np.exp(parameters)
        return np.asarray(-c1 * above / (pole + beyond_pole + above))

    start = np.log([_UNIVERSAL[0], max(_UNIVERSAL[1] - pole, 1.0)])
    limits = np.log([[1e-3, 1e-3], [_LARGEST_C2, _LARGEST_C2]])
    found = least_squares(
        lambda parameters: rule(parameters) - logs, start, bounds=limits, xtol=1e-12, ftol=1e-14
    )
    c1, beyond_pole = np.exp(found.x)
    shift = WLF(reference_temperature, float(c1), float(pole + beyond_pole))
    return _fit(shift, rule(found.x) - logs)


def fit_arrhenius(
    temperatures: ArrayLike, factors: ArrayLike, reference_temperature: float
) -> ShiftFit:
    """Fit an Arrhenius rule with a_T = 1 at the reference temperature to shift factors.

    Parameters
    ----------
    temperatures : array_like, shape (n,)
        Absolute temperatures, two or more [K].
    factors : array_like, shape (n,)
        Shift factors a_T > 0 [-].
    reference_temperature : float
        Temperature at which a_T = 1 [K].

    Returns
    -------
    ShiftFit
        The rule and its residuals.

    Raises
    ------
    ValueError
        If a number is not positive, there are fewer than two, or the factors rise with
        temperature.

    Examples
    --------
    >>> T = [283.15, 293.15, 303.15]
    >>> fit = fit_arrhenius(T, Arrhenius(293.15, 90e3).factor(T), 293.15)
    >>> round(fit.shift.activation_energy, 3)
    90000.0
    """
    above, logs = _check("fit_arrhenius", temperatures, factors, reference_temperature, least=2)
    inverse = 1.0 / (above + reference_temperature) - 1.0 / reference_temperature
    slope = np.log(10.0) * float(inverse @ logs) / float(inverse @ inverse)
    if not slope > 0:
        raise ValueError(
            "fit_arrhenius: factors rise with temperature, but a body is not slower where it is "
            "warmer; are these 1/a_T?"
        )
    shift = Arrhenius(reference_temperature, slope * GAS_CONSTANT)
    return _fit(shift, slope * inverse / np.log(10.0) - logs)


def _check(
    owner: str, temperatures: ArrayLike, factors: ArrayLike, reference: float, least: int
) -> tuple[Floats, Floats]:
    T = positive_column(owner, "temperatures", temperatures, "K")
    a_T = positive_column(owner, "factors", factors, "1")
    require_rows(owner, least, temperatures=T, factors=a_T)
    positive_column(owner, "reference_temperature", [reference], "K")
    if np.unique(T).size < least:
        raise ValueError(
            f"{owner}: needs at least {least} different temperatures, got {np.unique(T).size}"
        )
    return T - reference, np.log10(a_T)


def _fit(shift: WLF | Arrhenius, residuals: Floats) -> ShiftFit:
    rms = float(np.sqrt(np.mean(residuals**2)))
    return ShiftFit(shift, rms, float(np.abs(residuals).max()))
