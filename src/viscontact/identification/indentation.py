"""Fit of a law to an indentation record of a sphere, cone or punch."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from warnings import warn

import numpy as np

from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.threads import limit_loaded
from viscontact.bodies.laws import Elastic
from viscontact.bodies.materials.material import Material
from viscontact.identification.candidates import Candidate, candidate
from viscontact.identification.curve_problem import CurveProblem
from viscontact.identification.elastic_indentation import (
    WIDEST,
    ElasticIndentation,
    Film,
    elastic_indentation,
)
from viscontact.identification.fit_quality import fit_warnings, misfit_of
from viscontact.identification.fitted_part import fitted_rows, stroke_of
from viscontact.identification.fitting import fitted_curve, fitted_record
from viscontact.identification.indentation_fit import IndentationFit
from viscontact.identification.record import IndentationRecord
from viscontact.identification.record_problem import RecordProblem
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import positive, whole


def fit_indentation(  # noqa: PLR0913
    record: IndentationRecord,
    law: str,
    *,
    terms: int = 1,
    poisson_ratio: float | None = None,
    bulk_modulus: float | None = None,
    given: str = "approach",
    confidence: float = 0.95,
    until: str | float | None = None,
    reference_time: float | None = None,
    thickness: float | None = None,
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
    until : str or float, optional
        Part of the record that is fitted: up to the end of ``"loading"`` or of ``"hold"``, to the
        ``"end"``, or up to an instant [s]. By default the whole record; loading and hold only,
        with a warning, where the force becomes negative during retraction.
    reference_time : float, optional
        Time at which a power law states its compliance [s], so that those of several curves can be
        compared; by default the duration of the fitted part, from contact on.
    thickness : float, optional
        Thickness of a film that is bonded to a rigid base [m]; it needs a Poisson's ratio. By
        default the body is as deep as a half-space.

    Returns
    -------
    IndentationFit
        Material, parameters, intervals and the fitted curve; of a force curve also contact point
        and baseline.

    Raises
    ------
    ValueError
        If the law has no such name, an option is out of range, the record has fewer rows than
        twice the parameters, or the body is so stiff or soft that no fit exists; if the contact is
        more than 8 thicknesses of a film in radius, or a record on a film has a second approach.

    Warns
    -----
    AccuracyWarning
        If the record determines a parameter no better than within a factor of ten; if the law
        misses the record by more than 10 % (root mean square) or 25 % (largest) of the largest
        value; if the residuals are no noise, with the likely cause; if the force becomes negative
        during retraction; if a sphere is no paraboloid any more at the largest depth, or if that is
        more than a tenth of the thickness of a film.

    Notes
    -----
    A record of `ContactPoint.record` is a force curve. Its deflection is fitted over the position
    of the base, with contact point and baseline as further unknowns: offset, slope over the
    position, drift over time and drag over the velocity, as far as the curve tells them apart. The
    solution is that for the tip on its cantilever. Of any other record approach, or force, is
    taken as exact. One that begins in contact by less than two of its steps, or by less than
    the noise, is taken to begin at contact.

    The force under a given approach, or the reverse, is the exact solution for an axisymmetric
    contact on a viscoelastic half-space, of Hunter, Graham and Ting (1966), through
    unloading, loss of contact and renewed contact: `viscontact.reference.press_axisymmetric`.
    On a film the elastic force over the indentation is that of a layer on a rigid base, from the
    integral equation of `viscontact.reference.layer_sphere` (Dimitriadis et al. 2002 and Garcia and
    Garcia 2018 give expansions of it), and creep follows it as it does on a half-space.

    Least squares in the logarithms of the parameters (of n/(1 - n) for an exponent n). The
    intervals are those of the linearised model there, in all unknowns, with Student's t and the
    scatter that the residuals show. Where their spectrum is not that of independent noise, the
    covariance is the one under noise of this spectrum, taken to be at each frequency as strong as
    in the strongest band above it.

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
    material(Elastic(1.0))  # checks the bulk arguments
    film = None if thickness is None else _film(thickness, poisson_ratio, given)
    elastic = elastic_indentation(record.indenter, film)
    modulus = _apparent_modulus(record, poisson_ratio, elastic)
    fitted = record.first(fitted_rows(record, until))
    is_curve = record.cantilever is not None and given == "approach"
    if film is not None and not is_curve:
        _require_one_approach(fitted)
    if not is_curve:
        fitted = fitted.near_contact()
    if reference_time is not None:
        reference_time = positive("fit_indentation: reference_time", reference_time, "s")
    shape = _candidate(law, int(terms), modulus, fitted, reference_time)
    with limit_loaded():  # on matrices this small, more threads mostly wait
        if is_curve:
            curve = CurveProblem(fitted, stroke_of(fitted), shape, material, elastic)
            found = fitted_curve(curve, record, confidence)
        else:
            plain = RecordProblem(fitted, given, shape, material, elastic)
            found = fitted_record(plain, record, confidence)
    found = replace(found, thickness=thickness)
    found = replace(found, misfit=misfit_of(found))
    _require_narrow(found, elastic)
    for message in fit_warnings(found):
        warn(f"fit_indentation: {message}", AccuracyWarning, stacklevel=2)
    return found


def _candidate(
    law: str,
    terms: int,
    modulus: float,
    record: IndentationRecord,
    reference: float | None = None,
) -> Candidate:
    """Candidate law; refused if the record has fewer than two rows per parameter."""
    touched = record.times[int(np.argmax(record.approach > 0))]
    begin = record.times[0] if record.cantilever is None else touched
    shape = candidate(law, terms, modulus, float(record.times[-1] - begin), reference)
    if record.times.size < 2 * len(shape.names):
        raise ValueError(
            f"fit_indentation: {law} has {len(shape.names)} parameters and needs at least "
            f"{2 * len(shape.names)} rows, got {record.times.size}; take a simpler law"
        )
    return shape


def _film(thickness: float, poisson_ratio: float | None, given: str) -> Film:
    """Film of a thickness, if the options go with one."""
    if poisson_ratio is None:
        raise ValueError(
            "fit_indentation: thickness goes with poisson_ratio, not with bulk_modulus: the "
            "stiffness of a film depends on Poisson's ratio, which must be constant"
        )
    if given != "approach":
        raise ValueError("fit_indentation: thickness goes with given='approach'")
    return Film(positive("fit_indentation: thickness", thickness, "m"), float(poisson_ratio))


def _require_one_approach(record: IndentationRecord) -> None:
    """Refuse a record on a film that approaches again."""
    second = stroke_of(record).second_approach
    if second is not None:
        raise ValueError(
            "fit_indentation: on a film a record may have one approach and retraction, but a "
            f"second approach begins at {format_quantity(record.times[second], 's', 4)}; end the "
            "fit before with until, or fit through the simulator"
        )


def _require_narrow(fit: IndentationFit, elastic: ElasticIndentation) -> None:
    """Refuse a contact beyond the table of a film."""
    if not elastic.is_within_table(fit.deepest):
        raise ValueError(
            f"fit_indentation: the contact is more than {WIDEST:g} times as wide from its centre "
            "as the film is thick, where the solution ends; end the fit before with until, or fit "
            "through the simulator"
        )


def _apparent_modulus(
    record: IndentationRecord, poisson_ratio: float | None, elastic: ElasticIndentation
) -> float:
    """Shear modulus of the best-fitting elastic body [Pa]."""
    # Any Poisson's ratio suffices for a starting value.
    nu = 0.4 if poisson_ratio is None else poisson_ratio
    pressed = slice(stroke_of(record).hold_end + 1)  # adhesion acts later
    d, F = record.approach[pressed], record.force[pressed]
    unit = elastic.force(np.maximum(d, 0.0))  # for a contact modulus of 1 Pa
    contact_modulus = float(unit @ F) / max(float(unit @ unit), 1e-300)
    if not contact_modulus > 0:
        raise ValueError(
            "fit_indentation: the record's force is not positive where its approach is; "
            "force and approach are positive when the bodies are pressed together"
        )
    return contact_modulus * (1 - nu) / 2


def _require_options(terms: int, given: str, confidence: float) -> None:
    whole("fit_indentation: terms", terms, 1)
    if given not in ("approach", "force"):
        raise ValueError(f"fit_indentation: given must be approach or force, got {given!r}")
    if not 0 < confidence < 1:
        raise ValueError(
            f"fit_indentation: confidence must lie between 0 and 1, got {confidence!r}; 0.95 is "
            "customary"
        )
