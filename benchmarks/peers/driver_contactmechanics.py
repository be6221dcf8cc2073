"""Driver for ContactMechanics: constrained conjugate gradients (elastic problems only)."""

from __future__ import annotations

from importlib.metadata import version

import numpy as np
from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
from ContactMechanics.Optimization import constrained_conjugate_gradients
from ladder import Problem, climb
from SurfaceTopography import Topography


def solve(problem: Problem, tolerance: float) -> np.ndarray:
    size = tuple(problem["size"].tolist())
    shape = problem["gap"].shape
    made = PeriodicFFTElasticHalfSpace if problem["periodic"] else FreeFFTElasticHalfSpace
    substrate = made(shape, 1 / float(problem["instant"]), size)
    periodic = bool(problem["periodic"])
    topography = Topography(-problem["gap"], physical_sizes=size, periodic=periodic)
    # Its tolerance is a length; the others are relative to the largest displacement.
    found = constrained_conjugate_gradients(
        substrate,
        topography,
        external_force=float(problem["force"]),
        pentol=tolerance * float(problem["displacement_scale"]),
        forcetol=tolerance * float(problem["force"]) / problem["gap"].size,
        maxiter=20000,
    )
    if not found.success:
        raise RuntimeError(str(found.message))
    cell = np.prod(size) / problem["gap"].size
    return np.asarray(found.jac)[: shape[0], : shape[1]] / cell


if __name__ == "__main__":
    climb(solve, f"ContactMechanics {version('ContactMechanics')}")
