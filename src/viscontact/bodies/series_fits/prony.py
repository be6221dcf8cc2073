"""Fit of Prony series to creep, relaxation or oscillation tests."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Required, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies.laws import CreepSeries, RelaxationSeries, Shift
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.series_fits.columns import positive_column, require_rows, require_trend
from viscontact.bodies.series_fits.conventions import CREEP, MODULI, bulk_arguments, shear_law
from viscontact.bodies.series_fits.fit import Fit
from viscontact.bodies.series_fits.quality import Misfit, misfit_of
from viscontact.bodies.series_fits.reduced_record import ShiftOptions, reduced_record
from viscontact.bodies.series_fits.responses import (
    CreepResponse,
    DynamicResponse,
    RelaxationResponse,
    StorageResponse,
)
from viscontact.bodies.series_fits.spectrum import (
    Observed,
    Spectrum,
    parsimonious_spectrum,
    spectrum_of,
    unweighted,
)
from viscontact.bodies.series_fits.weights import given_weights, scatter_weights, weighted
from viscontact.units.numbers import whole

_LEAST_ROWS = 3
_EXCESS, _TOLERANCE = 1.05, 1e-3


class FitOptions(TypedDict, total=False):
    """Options that `fit_creep`, `fit_relaxation` and `fit_dynamic` have in common."""

    data: Required[str]
    poisson_ratio: float | None
    bulk_modulus: float | None
    fluid: bool
    terms: int | None
    excess: float
    tolerance: float


def fit_creep(  # noqa: PLR0913
    times: ArrayLike,
    compliance: ArrayLike,
    *,
    data: str,
    poisson_ratio: float | None = None,
    bulk_modulus: float | None = None,
    fluid: bool = False,
    terms: int | None = None,
    excess: float = _EXCESS,
    tolerance: float = _TOLERANCE,
    temperature: ArrayLike | TemperatureHistory | None = None,
    shift: str | Shift | None = None,
    reference_temperature: float | None = None,
    thermal_strain: bool | None = None,
) -> Fit:
    """Fit the creep series of fewest terms to a creep test.

    Parameters
    ----------
    times : array_like, shape (n,)
        Times since the step in stress, >= 0, in any order [s].
    compliance : array_like, shape (n,)
        Measured compliances > 0 [1/Pa].
    data : str
        Convention: ``"deviatoric"`` (Phi, strain deviator per stress deviator, 1/(2G) at
        once), ``"shear"`` (a rheometer's 1/G) or ``"uniaxial"`` (1/E).
    poisson_ratio : float, optional
        With uniaxial data, constant Poisson's ratio.
    bulk_modulus : float, optional
        With uniaxial data, elastic bulk modulus [Pa]; exactly one of the two.
    fluid : bool, optional
        True to allow steady flow.
    terms : int, optional
        Largest number of terms, instead of as few as needed.
    excess : float, optional
        The residual accepted, in multiples of the best that any number of terms can reach;
        1.05 if left out.
    tolerance : float, optional
        A relative residual that is good enough in any case; 1e-3 if left out.
    temperature : array_like, shape (n,), or TemperatureHistory, optional
        Temperature at each row, or over time, of a test in which it varied, such as by the
        stepped isothermal method [K]. The shift is then found with the law.
    shift : {"arrhenius", "wlf", "table"} or Shift, optional
        Rule of the shift that goes with `temperature`: by name to be found, a table with a factor
        for each temperature that is held; or known. Arrhenius or WLF, by an information
        criterion, if left out.
    reference_temperature : float, optional
        Temperature of the law [K]; the first one that is held if left out.
    thermal_strain : bool, optional
        True to find a strain proportional to the change of temperature, the thermal expansion,
        False if there is none; by an information criterion if left out.

    Returns
    -------
    Fit
        The law and how well it fits; with a temperature its points are the reduced times, and
        `Fit.found_shift` is the shift.

    Raises
    ------
    ValueError
        If a value is no positive number, naming its row; if the compliance falls as a whole; if
        an option is out of range; if temperature and time cannot be told apart, as along one ramp.

    Warns
    -----
    AccuracyWarning
        If the series misses the data by more than 10 % (root mean square) or 25 % (largest), with
        the reason; `Fit.misfit` keeps it. If the shift is uncertain, or a thermal strain was
        found.

    Notes
    -----
    Phi(t) = J_0 + sum J_i (1 - exp(-t/τ_i)) + φ t with J_0, J_i, φ >= 0 minimises the sum of
    squares of the *relative* residuals. The choice of the terms is described in
    `viscontact.bodies.series_fits.spectrum`. With a temperature, t is the reduced time
    ξ(t) = ∫ dt'/a_T(T(t')); see ``viscontact.bodies.series_fits.joint_fit``.

    Examples
    --------
    >>> from viscontact.bodies.laws import CreepSeries
    >>> t = np.geomspace(0.1, 100.0, 40)
    >>> fit = fit_creep(t, CreepSeries(1e-9, [2e-9], [5.0])(t), data="deviatoric")
    >>> fit.terms, round(fit.law.times[0], 6)
    (1, 5.0)
    """
    owner = "fit_creep"
    instants, values = _over_time(owner, times, ("compliance", compliance, "1/Pa"), rises=True)
    on_clock = ShiftOptions(
        temperature=temperature, shift=shift, reference_temperature=reference_temperature
    )
    instants, values, found_shift = reduced_record(
        *(owner, instants, values),
        rises=True,
        fluid=fluid,
        thermal_strain=thermal_strain,
        **on_clock,
    )
    make = shear_law(owner, CREEP, data)
    volume = bulk_arguments(owner, data, poisson_ratio, bulk_modulus)
    observed = unweighted(CreepResponse(instants, fluid), values)
    found, misfit = _fitted_spectrum(owner, observed, ("compliance",), terms, excess, tolerance)
    flow = float(found.constants[1]) if fluid else 0.0
    series = CreepSeries(
        float(found.constants[0]), found.strengths.tolist(), found.times.tolist(), flow
    )
    law = make(series.instant, series.amplitudes, series.times, series.fluidity, **volume)
    measured, weights = {"compliance": values}, {"compliance": 1.0}
    bulk = volume.get("poisson_ratio"), volume.get("bulk_modulus")
    return Fit(law, series, data, instants, measured, weights, misfit, *bulk, found_shift)


def fit_relaxation(  # noqa: PLR0913
    times: ArrayLike,
    modulus: ArrayLike,
    *,
    data: str,
    poisson_ratio: float | None = None,
    bulk_modulus: float | None = None,
    fluid: bool = False,
    terms: int | None = None,
    excess: float = _EXCESS,
    tolerance: float = _TOLERANCE,
    temperature: ArrayLike | TemperatureHistory | None = None,
    shift: str | Shift | None = None,
    reference_temperature: float | None = None,
) -> Fit:
    """Fit the Prony series of fewest terms to a relaxation test.

    Parameters
    ----------
    times : array_like, shape (n,)
        Times since the step in strain, >= 0, in any order [s].
    modulus : array_like, shape (n,)
        Measured relaxation moduli > 0 [Pa].
    data : str
        Convention: ``"shear"`` (G) or ``"uniaxial"`` (E).
    poisson_ratio, bulk_modulus
        As in `fit_creep`.
    fluid : bool, optional
        True for an equilibrium modulus of zero.
    terms, excess, tolerance, temperature, shift, reference_temperature
        As in `fit_creep`.

    Returns
    -------
    Fit
        The law and how well it fits.

    Raises
    ------
    ValueError
        As in `fit_creep`, or if the modulus rises as a whole.

    Warns
    -----
    AccuracyWarning
        As in `fit_creep`.

    Notes
    -----
    As in `fit_creep`, with G(t) = G_inf + sum G_i exp(-t/τ_i).

    Examples
    --------
    >>> from viscontact.bodies.laws import RelaxationSeries
    >>> t = np.geomspace(0.1, 100.0, 40)
    >>> E = RelaxationSeries(3e9, [6e9], [5.0]).relaxation(t)
    >>> fit = fit_relaxation(t, E, data="uniaxial", poisson_ratio=0.5)
    >>> print(f"{fit.law.equilibrium:.4g} Pa, {fit.law.moduli[0]:.4g} Pa")
    1e+09 Pa, 2e+09 Pa
    """
    owner = "fit_relaxation"
    instants, values = _over_time(owner, times, ("modulus", modulus, "Pa"), rises=False)
    on_clock = ShiftOptions(
        temperature=temperature, shift=shift, reference_temperature=reference_temperature
    )
    instants, values, found_shift = reduced_record(
        owner, instants, values, rises=False, fluid=fluid, **on_clock
    )
    make = shear_law(owner, MODULI, data)
    volume = bulk_arguments(owner, data, poisson_ratio, bulk_modulus)
    observed = unweighted(RelaxationResponse(instants, fluid), values)
    found, misfit = _fitted_spectrum(owner, observed, ("modulus",), terms, excess, tolerance)
    series = _relaxation_series(found)
    law = make(series.equilibrium, series.moduli, series.times, **volume)
    measured, weights = {"modulus": values}, {"modulus": 1.0}
    bulk = volume.get("poisson_ratio"), volume.get("bulk_modulus")
    return Fit(law, series, data, instants, measured, weights, misfit, *bulk, found_shift)


def fit_dynamic(  # noqa: PLR0913
    angular_frequency: ArrayLike,
    storage: ArrayLike,
    loss: ArrayLike | None = None,
    *,
    data: str,
    weights: Mapping[str, float] | None = None,
    poisson_ratio: float | None = None,
    bulk_modulus: float | None = None,
    fluid: bool = False,
    terms: int | None = None,
    excess: float = _EXCESS,
    tolerance: float = _TOLERANCE,
) -> Fit:
    """Fit the Prony series of fewest terms to an oscillation test.

    Parameters
    ----------
    angular_frequency : array_like, shape (n,)
        Angular frequencies ω > 0, in any order [rad/s]: 2π times those in Hz.
    storage, loss : array_like, shape (n,)
        Measured moduli in phase, G', and out of phase, G'', each > 0 [Pa]. Without `loss` the
        series is fitted to the storage modulus, which determines the losses in theory
        (Kramers-Kronig), but those at the ends of the frequencies only roughly.
    data : str
        As in `fit_relaxation`.
    weights : mapping of str to float, optional
        Weights > 0 of the columns ``"storage"`` and ``"loss"``, 1 for one that is left out, such
        as ``{"storage": 10}``. By default the inverse scatter of each column.
    poisson_ratio, bulk_modulus, fluid, terms, excess, tolerance
        As in `fit_relaxation`.

    Returns
    -------
    Fit
        The law and how well it fits.

    Raises
    ------
    ValueError
        As in `fit_creep`, or if the storage modulus falls as a whole with the frequency.

    Warns
    -----
    AccuracyWarning
        As in `fit_creep`.

    Notes
    -----
    G' = G_inf + sum G_i a²/(1 + a²) and G'' = sum G_i a/(1 + a²) with a = ωτ, both at once. The
    sum of squares of the relative residuals, each times the weight of its column, is minimised.
    Losses scatter more than storage, and superpose less well from several temperatures. By default
    the weight of a column is therefore the inverse of its scatter about the best fit to it alone,
    with a ratio of at most 30.

    Examples
    --------
    >>> from viscontact.bodies.laws import RelaxationSeries
    >>> frequency = np.geomspace(0.01, 10.0, 30)
    >>> G = RelaxationSeries(1e6, [2e6], [5.0]).complex_modulus(frequency)
    >>> fit = fit_dynamic(frequency, G.real, G.imag, data="shear")
    >>> fit.terms, round(fit.law.times[0], 6)
    (1, 5.0)
    """
    owner = "fit_dynamic"
    frequencies = positive_column(owner, "angular_frequency", angular_frequency, "rad/s")
    columns = {"storage": positive_column(owner, "storage", storage, "Pa")}
    if loss is not None:
        columns["loss"] = positive_column(owner, "loss", loss, "Pa")
    require_rows(owner, _LEAST_ROWS, angular_frequency=frequencies, **columns)
    require_trend(owner, "storage", frequencies, columns["storage"], rises=True)
    _require_span(owner, "angular_frequency", frequencies)
    make = shear_law(owner, MODULI, data)
    volume = bulk_arguments(owner, data, poisson_ratio, bulk_modulus)
    response = StorageResponse if loss is None else DynamicResponse
    observed = unweighted(response(frequencies, fluid), np.concatenate(list(columns.values())))
    names = tuple(columns)
    if weights is not None:
        used = given_weights(owner, weights, names)
    else:
        used = {"storage": 1.0} if loss is None else scatter_weights(observed, tolerance, names)
    observed = weighted(observed, used)
    found, misfit = _fitted_spectrum(owner, observed, names, terms, excess, tolerance)
    series = _relaxation_series(found)
    law = make(series.equilibrium, series.moduli, series.times, **volume)
    bulk = volume.get("poisson_ratio"), volume.get("bulk_modulus")
    return Fit(law, series, data, frequencies, columns, used, misfit, *bulk)


def _over_time(
    owner: str, times: ArrayLike, column: tuple[str, ArrayLike, str], *, rises: bool
) -> tuple[Floats, Floats]:
    """Times [s] and a column of name, values and unit, checked."""
    name, given, unit = column
    instants = positive_column(owner, "times", times, "s", zero=True)
    values = positive_column(owner, name, given, unit)
    require_rows(owner, _LEAST_ROWS, times=instants, **{name: values})
    require_trend(owner, name, instants, values, rises=rises)
    _require_span(owner, "times", instants)
    return instants, values


def _fitted_spectrum(
    owner: str,
    observed: Observed,
    names: tuple[str, ...],
    terms: int | None,
    excess: float,
    tolerance: float,
) -> tuple[Spectrum, Misfit | None]:
    """Spectrum of the measured columns, with a warning where it misses them."""
    if not (excess > 1.0 and tolerance >= 0.0):
        raise ValueError(
            f"{owner}: excess must be above 1 and tolerance at least 0, "
            f"got excess={excess!r} and tolerance={tolerance!r}"
        )
    if terms is None:
        found = parsimonious_spectrum(observed, excess=excess, tolerance=tolerance)
    else:
        most = observed.values.size // 2
        count = whole(f"{owner}: terms, at most half the number of values,", terms, 0, most)
        found = spectrum_of(observed, count)
    misfit = misfit_of(observed, found, names)
    if misfit is not None:
        warnings.warn(misfit.message, AccuracyWarning, stacklevel=3)
    return found, misfit


def _relaxation_series(found: Spectrum) -> RelaxationSeries:
    return RelaxationSeries(
        float(found.constants.sum()), found.strengths.tolist(), found.times.tolist()
    )


def _require_span(owner: str, name: str, points: Floats) -> None:
    positive = points[points > 0]
    if positive.size < 2 or not positive.max() > positive.min():
        raise ValueError(f"{owner}: {name} must hold at least two different values above 0")
