"""Start of a calibration of bodies that adhere: the exact solution for an elastic sphere."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies.indenters import Paraboloid, Sphere
from viscontact.bodies.laws import Elastic
from viscontact.bodies.loads import ApproachHistory
from viscontact.bodies.materials.material import Material
from viscontact.case import Case
from viscontact.identification import AdhesionFit, ForceCurve, fit_adhesion
from viscontact.studies.calibration.response import Experiment
from viscontact.studies.calibration.unknowns import CONTACT_POINT, Unknown, part_of

#: Stiffness of a prescribed approach, times the largest force over the largest approach.
_RIGID = 1e6


def adhesive_start(
    case: Case, experiment: Experiment, unknowns: Sequence[Unknown]
) -> Floats | None:
    """Parts of the ranges of what `fit_adhesion` finds in a record; None if that is nothing.

    Unknowns that it does not find begin where they do without it.
    """
    fit = _elastic_fit(case, experiment)
    if fit is None:
        return None
    found = {"adhesion.work": fit.parameters["work"], CONTACT_POINT: fit.contact.position}
    if fit.tells_range:
        found["adhesion.range"] = fit.parameters["range"]
        found["adhesion.strength"] = fit.parameters["work"] / fit.parameters["range"]
    if isinstance(case.material, Material) and isinstance(case.material.law, Elastic):
        stiffer = fit.parameters["contact_modulus"] * case.material.contact_compliance().instant
        found["material.shear_modulus"] = stiffer * case.material.law.shear_modulus
    return np.array(
        [part_of(u.bounds, found[u.name]) if u.name in found else u.start for u in unknowns]
    )


def _elastic_fit(case: Case, experiment: Experiment) -> AdhesionFit | None:
    """Fit to the record of a round body that adheres; None for others, or without a pull-off."""
    record, body = experiment.record, case.indenter
    if case.adhesion is None or not isinstance(body, Sphere | Paraboloid):
        return None
    force, approach = record.column("force"), record.column("approach")
    spring = case.load.stage_stiffness if isinstance(case.load, ApproachHistory) else None
    stiffness = spring or _RIGID * float(np.abs(force).max() / max(np.ptp(approach), 1e-300))
    try:
        curve = ForceCurve(record.times, approach + force / stiffness, force / stiffness, stiffness)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", AccuracyWarning)
            return fit_adhesion(curve, body, poisson_ratio=0.5)
    except ValueError:
        return None
