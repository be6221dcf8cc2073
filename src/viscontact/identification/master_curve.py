"""Time-temperature superposition: master curve from sets at several temperatures."""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import ClassVar, Unpack

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Shift, TabulatedShift
from viscontact.bodies.series_fits.columns import positive_column, require_trend
from viscontact.bodies.series_fits.fit import Fit
from viscontact.bodies.series_fits.prony import FitOptions
from viscontact.bodies.series_fits.quality import Misfit, Reason
from viscontact.bodies.series_fits.table_fit import fit_measured
from viscontact.identification.found_shifts import found_shifts
from viscontact.identification.isotherm import KINDS_OF_TEST, Isotherm
from viscontact.identification.overlap import mismatch, require_common_values
from viscontact.identification.shift_fit import ShiftFit, fit_arrhenius, fit_wlf
from viscontact.identification.shift_uncertainty import ShiftUncertainty
from viscontact.identification.tabulated_sets import isotherms_of, usual_reference
from viscontact.identification.vertical_shift import VERTICALS, Vertical
from viscontact.tables import Table
from viscontact.units.display import Displayable, Plotted

_OWNER = "build_master_curve"
_SAME = 1e-6  # K: temperatures that differ by less are equal


@dataclass(frozen=True, eq=False)
class MasterCurve(Displayable, Plotted):
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
        The rule given, or the table of the factors found, vertical ones included.
    vertical_factors : ndarray, shape (sets,)
        Vertical shift factor b_T of each set: moduli are b_T times those at the reference in the
        same state [-].
    vertical : {"none", "rubber", "found"}
        How they were chosen.
    uncertainty : ShiftUncertainty or None
        Intervals and correlations of the factors found; None where they were given.
    warnings : tuple of str
        What is doubtful: factors that are uncertain or unknown, sets that contradict each other.

    Examples
    --------
    Ten times as fast for each ten degrees:

    >>> times = np.geomspace(1.0, 100.0, 9)
    >>> sets = [
    ...     Isotherm(283.15 + 10 * k, times, {"compliance": 1e-9 * (10**k * times) ** 0.2})
    ...     for k in (1, 2, 3)
    ... ]
    >>> build_master_curve(sets, 293.15, vertical="none").factors.round(4).tolist()
    [1.0, 0.1, 0.01]
    """

    _figure: ClassVar[str] = "master_curve"

    reference_temperature: float
    isotherms: tuple[Isotherm, ...]
    factors: Floats
    mismatches: Floats | None
    shift: Shift
    vertical_factors: Floats
    vertical: Vertical = "none"
    uncertainty: ShiftUncertainty | None = None
    warnings: tuple[str, ...] = ()

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
        """All values by column, reduced by b_T, in the order of `points`."""
        order = np.argsort(np.concatenate(self.reduced_points), kind="stable")
        return {
            name: np.concatenate([reduced[name] for reduced in self.reduced_values])[order]
            for name in self.isotherms[0].measured
        }

    @property
    def reduced_values(self) -> tuple[dict[str, Floats], ...]:
        """Values of each set by column, reduced to the reference: modulus/b_T, compliance b_T."""
        return tuple(
            {
                name: values * factor if name == "compliance" else values / factor
                for name, values in isotherm.measured.items()
            }
            for isotherm, factor in zip(self.isotherms, self.vertical_factors, strict=True)
        )

    def fit_wlf(self) -> ShiftFit:
        """Return the WLF rule that fits the factors, as `fit_wlf` does."""
        return fit_wlf(self.temperatures, self.factors, self.reference_temperature)

    def fit_arrhenius(self) -> ShiftFit:
        """Return the Arrhenius rule that fits the factors, as `fit_arrhenius` does."""
        return fit_arrhenius(self.temperatures, self.factors, self.reference_temperature)


def build_master_curve(
    isotherms: Sequence[Isotherm] | Table,
    reference_temperature: float | None = None,
    shift: Shift | None = None,
    *,
    vertical: Vertical | None = None,
    expansion: float = 0.0,
) -> MasterCurve:
    """Return the master curve of sets at several temperatures.

    Parameters
    ----------
    isotherms : sequence of Isotherm, or Table
        Sets of one kind of test, in any order; two or more unless `shift` is given. Or a table that
        has them, from `read_table`.
    reference_temperature : float, optional
        Temperature of the master curve [K]; within the temperatures of the sets unless
        `shift` is given. By default that of the set nearest 20 °C.
    shift : WLF, Arrhenius or TabulatedShift, optional
        The rule for the shift factors; found when left out.
    vertical : {"none", "rubber", "found"}, optional
        Vertical shift factors b_T: 1; that of a rubber or a melt, T ρ/(T_r ρ_r); or found from the
        sets. Left out, it is found from storage and loss, and of one modulus or compliance alone,
        which hardly shows it, it is 1 unless the sets join much better with one.
    expansion : float, optional
        Coefficient of thermal expansion in volume, for ρ of ``"rubber"`` [1/K]; 0 if left out.

    Returns
    -------
    MasterCurve
        The curve and the shift factors, with their intervals.

    Raises
    ------
    ValueError
        If the sets are of different kinds, two have the same temperature, a set goes the wrong
        way as a whole, neighbours have no value in common, or a warmer set is slower.

    Warns
    -----
    AccuracyWarning
        If a factor is uncertain by more than 0.1 decades (95 %), or unknown, as nothing overlaps;
        if the sets contradict each other; if one modulus or compliance leaves open whether there
        is a vertical shift, and that matters. `MasterCurve.warnings` keeps it.

    Notes
    -----
    All sets are superposed at once: each response has one smooth curve, and ln a_T and ln b_T of
    all sets follow from its marginal likelihood, see the page on the theory. A response counts by
    its slope over its scatter, so one that is flat has no say. ln a_T is taken to be straight
    between two temperatures.

    Examples
    --------
    >>> from viscontact.bodies.laws import WLF, RelaxationSeries
    >>> law, rule = RelaxationSeries(1e6, [1e9], [10.0]), WLF(293.15, 12.0, 70.0)
    >>> w, sets = np.geomspace(0.1, 100.0, 16), []
    >>> for T in (288.15, 293.15, 298.15):
    ...     modulus = law.slowed(rule.factor(T)).complex_modulus(w) * T / 293.15
    ...     sets.append(Isotherm(T, w, {"storage": modulus.real, "loss": modulus.imag}))
    >>> curve = build_master_curve(sets, 293.15)
    >>> [round(float(a), 2) for a in np.log10(curve.factors)]
    [0.92, 0.0, -0.8]
    >>> curve.vertical_factors.round(3).tolist()
    [0.983, 1.0, 1.017]
    """
    sets = isotherms_of(isotherms.sets()) if isinstance(isotherms, Table) else isotherms
    ordered = _order_isotherms(sets, least=2 if shift is None else 1)
    wanted = usual_reference(ordered) if reference_temperature is None else reference_temperature
    [reference] = positive_column(_OWNER, "reference_temperature", [wanted], "K")
    # 20 °C is the temperature of a set at 20 °C, however both are rounded in kelvin.
    near = min((each.temperature for each in ordered), key=lambda each: abs(each - reference))
    reference = near if abs(near - reference) < _SAME else reference
    temperatures = np.array([isotherm.temperature for isotherm in ordered])
    _require_vertical(vertical, shift)
    if shift is not None:
        factors = shift.factor(temperatures) / shift.factor(float(reference))
        raised = shift.vertical_factor(temperatures) / shift.vertical_factor(float(reference))
        return MasterCurve(float(reference), ordered, factors, None, shift, raised)
    if not temperatures[0] <= reference <= temperatures[-1]:
        raise ValueError(
            f"{_OWNER}: reference_temperature must lie within those of the sets, "
            f"{temperatures[0]:.6g} to {temperatures[-1]:.6g} K, got {reference:.6g} K; beyond "
            "them give shift=WLF(...) or Arrhenius(...)"
        )
    return _found(ordered, float(reference), vertical, expansion)


def _found(
    ordered: tuple[Isotherm, ...], reference: float, vertical: Vertical | None, expansion: float
) -> MasterCurve:
    """Master curve with the shift factors of the sets; warns of what is doubtful."""
    for pair in itertools.pairwise(ordered):
        _require_common_values(*pair)
    found = found_shifts(_OWNER, ordered, reference, vertical, expansion)
    curves = [
        isotherm.curve().moved(log_a, -log_b if "compliance" in isotherm.measured else log_b)
        for isotherm, log_a, log_b in zip(ordered, found.logs_a, found.logs_b, strict=True)
    ]
    factors, raised = np.exp(found.logs_a), np.exp(found.logs_b)
    for doubt in found.doubts:
        warnings.warn(doubt, AccuracyWarning, stacklevel=3)
    return MasterCurve(
        reference,
        ordered,
        factors,
        np.array([mismatch(*pair) for pair in itertools.pairwise(curves)]),
        TabulatedShift(
            [isotherm.temperature for isotherm in ordered], factors.tolist(), raised.tolist()
        ),
        raised,
        found.vertical,
        found.uncertainty,
        found.doubts,
    )


def _require_vertical(vertical: Vertical | None, shift: Shift | None) -> None:
    if vertical is None:
        return
    if shift is not None:
        raise ValueError(
            f"{_OWNER}: vertical goes with shift factors that are found; leave it out, and give "
            "TabulatedShift(..., vertical=...) if the shift has one"
        )
    if vertical not in VERTICALS:
        raise ValueError(
            f"{_OWNER}: vertical must be one of {', '.join(VERTICALS)}, got {vertical!r}"
        )


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
        The law at the reference temperature; ``fit.law.slowed(curve.shift.factor(T))``
        times the vertical factor is the law at another temperature T, as `Material.at` gives it.

    Raises
    ------
    ValueError
        If `curve` is no MasterCurve, or as in `fit_creep`.

    Warns
    -----
    AccuracyWarning
        As in `fit_creep`; where each set alone is met, the shift factors are the reason.

    Examples
    --------
    >>> times = np.geomspace(1.0, 100.0, 9)
    >>> sets = [
    ...     Isotherm(283.15 + 10 * k, times, {"compliance": 1e-9 * (10**k * times) ** 0.2})
    ...     for k in (1, 2, 3)
    ... ]
    >>> fit = fit_master_curve(build_master_curve(sets, 293.15, vertical="none"), data="deviatoric")
    >>> bool(abs(fit.law(1e4) / (1e-9 * 1e5**0.2) - 1) < 0.02)
    True
    """
    if not isinstance(curve, MasterCurve):
        raise ValueError(
            "fit_master_curve: curve must be a MasterCurve, such as build_master_curve(table) "
            f"returns, got {type(curve).__name__}"
        )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        fit = fit_measured(curve.points, curve.measured, weights=weights, **options)
        fit = _without_blame(curve, fit, **options)
    if fit.misfit is not None:
        warnings.warn(fit.misfit.message, AccuracyWarning, stacklevel=2)
    return fit


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


def _require_common_values(colder: Isotherm, warmer: Isotherm) -> None:
    try:
        require_common_values(colder.curve(), warmer.curve())
    except ValueError as error:
        raise ValueError(
            f"{_OWNER}: sets at {colder.temperature:.6g} K and {warmer.temperature:.6g} K: "
            f"{error}; give shift=, or measure at a temperature between them"
        ) from None


def _without_blame(curve: MasterCurve, fit: Fit, **options: Unpack[FitOptions]) -> Fit:
    """Return the fit, its misfit blamed on the shift factors where each set alone is met."""
    misfit = fit.misfit
    if misfit is None or misfit.reason not in (Reason.DISAGREEMENT, Reason.SCATTER):
        return fit
    for isotherm in curve.isotherms:
        try:
            alone = fit_measured(isotherm.points, isotherm.measured, **options)
        except ValueError:  # too few rows, or flat
            continue
        if alone.misfit is not None:
            return fit
    size = misfit.message.partition(": ")[0]
    why = (
        f"{size}: {Reason.SUPERPOSITION.value}, though each set alone is met; the shift factors "
        "are the likely culprit. Look at their intervals, at temperatures that may be exchanged, "
        "and at the vertical shift; if they are right, the material is not thermorheologically "
        "simple"
    )
    return replace(fit, misfit=Misfit(Reason.SUPERPOSITION, why))
