"""Time-temperature superposition: master curve from sets at several temperatures."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Unpack

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws import Shift, TabulatedShift
from viscontact.bodies.series_fits.columns import positive_column, require_trend
from viscontact.bodies.series_fits.fit import Fit
from viscontact.bodies.series_fits.prony import FitOptions
from viscontact.bodies.series_fits.table_fit import fit_measured
from viscontact.identification.isotherm import KINDS_OF_TEST, Isotherm
from viscontact.identification.overlap import log_shift
from viscontact.identification.shift_fit import ShiftFit, fit_arrhenius, fit_wlf
from viscontact.units.display import Displayable

_OWNER = "build_master_curve"
# Tolerance for a warmer set that is slower than a colder one by scatter.
_SCATTER = np.log(10.0) / 3


@dataclass(frozen=True, eq=False)
class MasterCurve(Displayable):
    """Master curve at a reference temperature, from sets at several temperatures.

    Made by `build_master_curve`.

    Attributes
    ----------
    reference_temperature : float
        The temperature it holds at [K].
    isotherms : tuple of Isotherm
        Its sets, from cold to warm.
    factors : ndarray, shape (sets,)
        Shift factor a_T of each set: everything takes a_T times as long as at the reference [-].
    mismatches : ndarray, shape (sets - 1,) or None
        Root mean square relative difference of each two neighbours where they overlap, NaN
        where they do not [-]; None where the factors were given.
    shift : WLF, Arrhenius or TabulatedShift
        The rule given, or the table of the factors found.

    Examples
    --------
    Ten times as fast for each ten degrees:

    >>> times = np.geomspace(1.0, 100.0, 9)
    >>> sets = [
    ...     Isotherm(283.15 + 10 * k, times, {"compliance": 1e-9 * (10**k * times) ** 0.2})
    ...     for k in (1, 2, 3)
    ... ]
    >>> build_master_curve(sets, 293.15).factors.round(4).tolist()
    [1.0, 0.1, 0.01]
    """

    reference_temperature: float
    isotherms: tuple[Isotherm, ...]
    factors: Floats
    mismatches: Floats | None
    shift: Shift

    @property
    def temperatures(self) -> Floats:
        """Temperatures of the sets, increasing [K]."""
        return np.array([isotherm.temperature for isotherm in self.isotherms])

    @property
    def reduced_points(self) -> tuple[Floats, ...]:
        """Points of each set, reduced to the reference temperature.

        Times t/a_T [s], or angular frequencies ω a_T [rad/s].
        """
        return tuple(
            isotherm.points * factor if isotherm.oscillates else isotherm.points / factor
            for isotherm, factor in zip(self.isotherms, self.factors, strict=True)
        )

    @property
    def points(self) -> Floats:
        """All reduced points, increasing."""
        return np.sort(np.concatenate(self.reduced_points), kind="stable")

    @property
    def measured(self) -> dict[str, Floats]:
        """All measured values by column, in the order of `points`."""
        order = np.argsort(np.concatenate(self.reduced_points), kind="stable")
        return {
            name: np.concatenate([isotherm.measured[name] for isotherm in self.isotherms])[order]
            for name in self.isotherms[0].measured
        }

    def fit_wlf(self) -> ShiftFit:
        """Return the WLF rule that fits the factors, as `fit_wlf` does."""
        return fit_wlf(self.temperatures, self.factors, self.reference_temperature)

    def fit_arrhenius(self) -> ShiftFit:
        """Return the Arrhenius rule that fits the factors, as `fit_arrhenius` does."""
        return fit_arrhenius(self.temperatures, self.factors, self.reference_temperature)


def build_master_curve(
    isotherms: Sequence[Isotherm], reference_temperature: float, shift: Shift | None = None
) -> MasterCurve:
    """Return the master curve of sets at several temperatures.

    Parameters
    ----------
    isotherms : sequence of Isotherm
        Sets of one kind of test, in any order; two or more unless `shift` is given.
    reference_temperature : float
        Temperature of the master curve [K]; within the temperatures of the sets unless
        `shift` is given.
    shift : WLF, Arrhenius or TabulatedShift, optional
        The rule for the shift factors; found when left out.

    Returns
    -------
    MasterCurve
        The curve and the shift factors.

    Raises
    ------
    ValueError
        If the sets are of different kinds, two have the same temperature, a set goes the wrong
        way as a whole, neighbours have no value in common, or a warmer set is slower.

    Notes
    -----
    Each set is shifted along ln(time) onto its colder neighbour, see
    `viscontact.identification.overlap`; the sum of the shifts is ln a_T, taken to be straight
    between two temperatures. Nothing is shifted in value.

    Examples
    --------
    >>> from viscontact.bodies.laws import WLF, RelaxationSeries
    >>> law, rule = RelaxationSeries(1e6, [1e9], [10.0]), WLF(293.15, 12.0, 70.0)
    >>> t = np.geomspace(0.01, 10.0, 16)
    >>> sets = [
    ...     Isotherm(T, t, {"modulus": law.slowed(rule.factor(T)).relaxation(t)})
    ...     for T in (288.15, 293.15, 298.15)
    ... ]
    >>> curve = build_master_curve(sets, 293.15)
    >>> [round(float(a), 2) for a in np.log10(curve.factors)]
    [0.92, 0.0, -0.8]
    """
    [reference] = positive_column(_OWNER, "reference_temperature", [reference_temperature], "K")
    ordered = _order_isotherms(isotherms, least=2 if shift is None else 1)
    temperatures = np.array([isotherm.temperature for isotherm in ordered])
    if shift is not None:
        factors = shift.factor(temperatures) / shift.factor(float(reference))
        return MasterCurve(float(reference), ordered, factors, None, shift)
    if not temperatures[0] <= reference <= temperatures[-1]:
        raise ValueError(
            f"{_OWNER}: reference_temperature must lie within those of the sets, "
            f"{temperatures[0]:.6g} to {temperatures[-1]:.6g} K, got {reference:.6g} K; beyond "
            "them give shift=WLF(...) or Arrhenius(...)"
        )
    steps, mismatches = np.transpose([_step(*pair) for pair in itertools.pairwise(ordered)])
    logs = -np.concatenate([[0.0], np.cumsum(steps)])
    factors = np.exp(logs - np.interp(reference, temperatures, logs))
    found = TabulatedShift(temperatures.tolist(), factors.tolist())
    return MasterCurve(float(reference), ordered, factors, mismatches, found)


def fit_master_curve(
    curve: MasterCurve,
    *,
    weights: Mapping[str, float] | None = None,
    **options: Unpack[FitOptions],
) -> Fit:
    """Return the Prony series of a master curve.

    Parameters
    ----------
    curve : MasterCurve
        From `build_master_curve`.
    weights : mapping of str to float, optional
        Those of `fit_dynamic`, for an oscillation.
    **options
        Those of `fit_creep`, `fit_relaxation` or `fit_dynamic`, by the kind of test; `data` is
        needed.

    Returns
    -------
    Fit
        The law at the reference temperature; ``fit.law.slowed(curve.shift.factor(T))`` is the
        law at another temperature T.

    Examples
    --------
    >>> times = np.geomspace(1.0, 100.0, 9)
    >>> sets = [
    ...     Isotherm(283.15 + 10 * k, times, {"compliance": 1e-9 * (10**k * times) ** 0.2})
    ...     for k in (1, 2, 3)
    ... ]
    >>> fit = fit_master_curve(build_master_curve(sets, 293.15), data="deviatoric")
    >>> bool(abs(fit.law(1e4) / (1e-9 * 1e5**0.2) - 1) < 0.02)
    True
    """
    return fit_measured(curve.points, curve.measured, weights=weights, **options)


def _order_isotherms(isotherms: Sequence[Isotherm], least: int) -> tuple[Isotherm, ...]:
    if len(isotherms) < least:
        raise ValueError(f"{_OWNER}: needs at least {least} sets, got {len(isotherms)}")
    ordered = tuple(sorted(isotherms, key=lambda isotherm: isotherm.temperature))
    kinds = {tuple(sorted(isotherm.measured)) for isotherm in ordered}
    if len(kinds) > 1:
        found = " and ".join(" with ".join(kind) for kind in sorted(kinds))
        raise ValueError(f"{_OWNER}: all sets must be of one kind of test, got {found}")
    for one, other in itertools.pairwise(ordered):
        if one.temperature == other.temperature:
            raise ValueError(
                f"{_OWNER}: two sets have the temperature {one.temperature:.6g} K; "
                "join them into one"
            )
    for isotherm in ordered:
        columns, rises = next(
            kind for kind in KINDS_OF_TEST if set(kind[0]) == set(isotherm.measured)
        )
        curve = isotherm.curve()
        values = np.exp(curve.log_columns[0])
        where = f"{_OWNER}: set at {isotherm.temperature:.6g} K"
        require_trend(where, columns[0], curve.log_times, values, rises)
    return ordered


def _step(colder: Isotherm, warmer: Isotherm) -> tuple[float, float]:
    """Decrease of ln a_T from one set to the next, and their mismatch [-]."""
    between = f"{_OWNER}: sets at {colder.temperature:.6g} K and {warmer.temperature:.6g} K"
    try:
        step, mismatch = log_shift(colder.curve(), warmer.curve())
    except ValueError as error:
        raise ValueError(
            f"{between}: {error}; give shift=, or measure at a temperature between them"
        ) from None
    if step < -_SCATTER:
        raise ValueError(
            f"{between}: the warmer one is slower, by {-step / np.log(10.0):.2g} decades; "
            "have temperatures been exchanged, or times and frequencies?"
        )
    return max(step, 0.0), mismatch
