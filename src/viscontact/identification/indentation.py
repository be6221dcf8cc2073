"""Fit of a law to an indentation record of a sphere, cone or punch."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from warnings import warn

import numpy as np
from scipy.optimize import least_squares
from scipy.special import stdtrit

from viscontact import reference
from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies.laws import Elastic
from viscontact.bodies.materials.material import Material
from viscontact.identification.candidates import Candidate, candidate
from viscontact.identification.indentation_fit import IndentationFit, compared
from viscontact.identification.record import IndentationRecord
from viscontact.units.numbers import whole

_ELEMENTS = 60  # relative error of the force about 1e-4, far below the scatter of any record
_STEP = 1e-4  # of ln p, for differences: well above rounding, well below the curvature
_REACH = np.log(1e8)  # largest change of ln p from its start
_VAGUE = 10.0  # ratio of an interval's bound to its value from which on it is undetermined


def fit_indentation(
    record: IndentationRecord,
    law: str,
    *,
    terms: int = 1,
    poisson_ratio: float | None = None,
    bulk_modulus: float | None = None,
    given: str = "approach",
    confidence: float = 0.95,
) -> IndentationFit:
    """Fit a law to an indentation record by its exact solution, with confidence intervals.

    Parameters
    ----------
    record : IndentationRecord
        Times, approach and force of an indenter, loading and unloading.
    law : str
        ``"elastic"``, ``"maxwell"``, ``"zener"``, ``"burgers"``, ``"creep-series"``,
        ``"power-law"`` (without instant compliance) or ``"power-law-with-instant"``.
    terms : int, optional
        Number of exponentials of a creep series.
    poisson_ratio : float, optional
        Constant Poisson's ratio of the body.
    bulk_modulus : float, optional
        Its elastic bulk modulus [Pa] instead; exactly one of the two.
    given : str, optional
        Quantity taken as exact: ``"approach"``, and the force is fitted; or ``"force"``, and the
        approach is fitted where the force is above a twentieth of its largest.
    confidence : float, optional
        Level of the intervals, between 0 and 1.

    Returns
    -------
    IndentationFit
        Material, parameters, intervals and the fitted curve.

    Raises
    ------
    ValueError
        If the law has no such name, an option is out of range, the record has fewer rows than
        twice the parameters, or the body is so stiff or soft that no fit exists.

    Warns
    -----
    AccuracyWarning
        If the record determines a parameter no better than within a factor of ten.

    Notes
    -----
    The force under a given approach, or the reverse, is the exact solution for an axisymmetric
    contact on a viscoelastic half-space, of Hunter, Graham and Ting (1966), through
    unloading, loss of contact and renewed contact: `viscontact.reference.press_axisymmetric`.
    Least squares in the logarithms of the parameters (of n/(1 - n) for an exponent n). The
    intervals are those of the linearised model there, with Student's t and the scatter that the
    residuals show: valid for scatter that is independent from row to row and as large at small
    forces as at large ones. A drift of the instrument is no such scatter.

    A power law is given by its compliance at the end of the record.

    Examples
    --------
    >>> from viscontact.bodies.indenters import Sphere
    >>> from viscontact.bodies.laws import Elastic
    >>> d = 1e-6 * np.concatenate([np.linspace(0, 1, 11), np.linspace(0.9, 0, 10)])
    >>> force = 16 / 3 * 2e6 * np.sqrt(5e-6) * d**1.5  # Hertz, nu = 0.5: 8/3 G R^0.5 2 d^1.5
    >>> record = IndentationRecord(Sphere(5e-6), np.linspace(0, 2, 21), d, force)
    >>> fit = fit_indentation(record, "elastic", poisson_ratio=0.5)
    >>> print(f"{fit.law.shear_modulus:.4g} Pa")
    2e+06 Pa
    """
    _require_options(terms, given, confidence)
    material = partial(Material, poisson_ratio=poisson_ratio, bulk_modulus=bulk_modulus)
    modulus = _apparent_modulus(record, poisson_ratio)
    material(Elastic(modulus))  # checks the bulk arguments
    shape = _candidate(law, int(terms), modulus, record.times)
    measured, counted = compared(record, given)
    scale = float(np.abs(measured).max())

    def residuals(free: Floats) -> Floats:
        response = _exact_response(
            record, given, material(shape.build(*shape.values(free).tolist()))
        )
        return (response - measured)[counted] / scale

    found, jacobian = _minimise(residuals, shape)
    intervals, correlation = _confidence(shape, found, residuals(found), jacobian, confidence)
    _warn_of_vague(shape, intervals)
    values = shape.values(found)
    best = material(shape.build(*values.tolist()))
    return IndentationFit(
        material=best,
        parameters=dict(zip(shape.names, values.tolist(), strict=True)),
        intervals=dict(zip(shape.names, intervals, strict=True)),
        confidence=confidence,
        correlation=correlation,
        record=record,
        given=given,
        fitted=_exact_response(record, given, best),
        units=shape.units,
    )


def _candidate(law: str, terms: int, modulus: float, times: Floats) -> Candidate:
    """Candidate law; refused if the record has fewer than two rows per parameter."""
    shape = candidate(law, terms, modulus, float(np.ptp(times)))
    if times.size < 2 * len(shape.names):
        raise ValueError(
            f"fit_indentation: {law} has {len(shape.names)} parameters and needs at least "
            f"{2 * len(shape.names)} rows, got {times.size}; take a simpler law"
        )
    return shape


def _exact_response(record: IndentationRecord, given: str, material: Material) -> Floats:
    """Exact solution for the other quantity of a record [N or m]."""
    contact = reference.press_axisymmetric(
        record.profile,
        record.times,
        creep_compliance=material.contact_compliance(),
        elements=_ELEMENTS,
        approach=record.approach if given == "approach" else None,
        force=np.maximum(record.force, 0.0) if given == "force" else None,
    )
    response = contact.force if given == "approach" else contact.approach
    if not np.isfinite(response).all():
        row = int(np.argmax(~np.isfinite(response)))
        raise ValueError(f"fit_indentation: the exact solution gives no number in row {row}")
    return response


def _apparent_modulus(record: IndentationRecord, poisson_ratio: float | None) -> float:
    """Shear modulus of the best-fitting elastic body [Pa]."""
    # Any Poisson's ratio suffices for a starting value.
    nu = 0.4 if poisson_ratio is None else poisson_ratio
    d, F = record.approach, record.force
    unit = record.elastic_force(np.maximum(d, 0.0))  # for a contact modulus of 1 Pa
    contact_modulus = float(unit @ F) / float(unit @ unit)
    if not contact_modulus > 0:
        raise ValueError(
            "fit_indentation: the record's force is not positive where its approach is; "
            "force and approach are positive when the bodies are pressed together"
        )
    return contact_modulus * (1 - nu) / 2


def _minimise(residuals: Callable[[Floats], Floats], shape: Candidate) -> tuple[Floats, Floats]:
    starts = [shape.free(np.array(start)) for start in shape.starts]
    tried = [_sum_of_squares(residuals, start) for start in starts]
    best = int(np.argmin(tried))
    if not np.isfinite(tried[best]):
        residuals(starts[best])  # raises the error
    start = starts[best]
    penalty = residuals(start)  # exceeded where there is no solution

    def guarded(free: Floats) -> Floats:
        try:
            return residuals(free)
        except ValueError:
            return 10.0 + np.abs(penalty)

    ended = least_squares(
        guarded,
        start,
        jac=lambda free: _differences(guarded, free),
        bounds=(start - _REACH, start + _REACH),
        xtol=1e-7,
        ftol=1e-9,
        max_nfev=60,
    )
    return ended.x, ended.jac


def _differences(function: Callable[[Floats], Floats], free: Floats) -> Floats:
    """Jacobian by forward differences in the logarithms of the parameters."""
    here = function(free)
    steps = _STEP * np.eye(free.size)
    return np.stack([(function(free + step) - here) / _STEP for step in steps], axis=1)


def _sum_of_squares(residuals: Callable[[Floats], Floats], free: Floats) -> float:
    try:
        return float(np.sum(residuals(free) ** 2))
    except ValueError:
        return float("inf")


def _confidence(
    shape: Candidate, found: Floats, residuals: Floats, jacobian: Floats, confidence: float
) -> tuple[list[tuple[float, float]], Floats]:
    """Intervals of the parameters and the correlation of their logarithms."""
    freedom = residuals.size - found.size
    variance = float(residuals @ residuals) / freedom
    _, singular, directions = np.linalg.svd(jacobian, full_matrices=False)
    spread = directions / np.maximum(singular, np.finfo(np.float64).tiny ** 0.25)[:, None]
    covariance = variance * spread.T @ spread
    errors = np.sqrt(np.diag(covariance))
    reach = float(stdtrit(freedom, 0.5 + confidence / 2)) * errors
    low, high = shape.values(found - reach), shape.values(found + reach)
    correlation = covariance / np.maximum(np.outer(errors, errors), np.finfo(np.float64).tiny)
    return list(zip(low.tolist(), high.tolist(), strict=True)), correlation


def _warn_of_vague(shape: Candidate, intervals: list[tuple[float, float]]) -> None:
    vague = [
        f"{name} ({low:.2g} to {high:.2g} {unit})"
        for name, unit, (low, high) in zip(shape.names, shape.units, intervals, strict=True)
        if high > _VAGUE**2 * low
    ]
    if vague:
        warn(
            f"fit_indentation: the record leaves open {', '.join(vague)}; take a law with fewer "
            "parameters, or a record with other rates or a hold",
            AccuracyWarning,
            stacklevel=3,
        )


def _require_options(terms: int, given: str, confidence: float) -> None:
    whole("fit_indentation: terms", terms, 1)
    if given not in ("approach", "force"):
        raise ValueError(f"fit_indentation: given must be approach or force, got {given!r}")
    if not 0 < confidence < 1:
        raise ValueError(
            f"fit_indentation: confidence must lie between 0 and 1, got {confidence!r}; 0.95 is "
            "customary"
        )
