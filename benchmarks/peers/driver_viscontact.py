"""Driver for this package: its contact solver on the common arrays, or its public run."""

from __future__ import annotations

import sys
from functools import cache

import numpy as np
from ladder import Problem, climb
from problems import PROBLEMS, RECORDED, STEPS, SharedProblem

import viscontact as vc
from viscontact.bodies.cohesive_laws import LAWS
from viscontact.mechanics.contact.adhesion.equilibrium import solve_from, traction_at
from viscontact.mechanics.contact.adhesion.problem import AdhesiveProblem
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import solve_contact
from viscontact.mechanics.contact.problem import ContactProblem
from viscontact.mechanics.contact.rigid_balance import Constraints


def elastic(problem: Problem, tolerance: float) -> np.ndarray:
    """The contact solver alone."""
    shape = problem["gap"].shape
    half_space = ContactDomain(_grid(shape, problem))
    posed = ContactProblem(
        problem["gap"],
        float(problem["instant"]),
        Constraints((float(problem["force"]), None, None)),
        1e-12 * float((problem["size"] / shape).max()),
    )
    solution = solve_contact(posed, half_space, tolerance=tolerance)
    if not solution.converged:
        raise RuntimeError(f"stopped at {solution.residual:g}")
    return solution.found.pressure


def adhesive(problem: Problem, tolerance: float) -> np.ndarray:
    """The adhesive solver alone, for each mean gap from the attraction of undeformed bodies."""
    law = LAWS["exponential"](*problem["adhesion"].tolist())
    held, found = Constraints((None, None, None), (0.0, 0.0, 0.0)), []
    for mean in problem["mean_gaps"].tolist():
        gap = problem["gap"] - problem["gap"].mean() + mean
        half_space = ContactDomain(_grid(gap.shape, problem))
        scale = 1e-12 * float((problem["size"] / gap.shape).max())
        posed = AdhesiveProblem(ContactProblem(gap, float(problem["instant"]), held, scale), law)
        start = traction_at(posed, half_space, np.maximum(gap, 0.0))
        solution = solve_from(posed, half_space, start, tolerance, from_afar=True)
        if solution is None or not solution.converged:
            raise RuntimeError("not converged")
        found.append(solution.found.pressure)
    return np.stack(found)


def run(case: SharedProblem, tolerance: float) -> np.ndarray:
    """The whole public run, with checks, symmetry, areas and warnings."""
    load = vc.step(case.force, tilt_x=0.0, tilt_y=0.0)
    times = vc.uniform_times(float(STEPS), STEPS) if case.creeps else [0.0]
    grid = _grid(case.shape, {"size": np.array(case.size), "periodic": case.periodic})
    arguments = (case.indenter, case.material, load, grid, times)
    recorded, pressures = RECORDED if case.creeps else (0,), []
    for step, state in enumerate(vc.march(*arguments, tolerance=tolerance)):
        if step in recorded:
            pressures.append(state.pressure)
    return np.stack(pressures) if case.creeps else pressures[0]


def _grid(shape: tuple[int, int], problem: Problem) -> vc.Grid:
    size = tuple(np.asarray(problem["size"]).tolist())
    if not problem["periodic"]:
        return vc.Grid(shape, size)
    return vc.Grid(shape, size, periodic=True)


@cache
def shared(name: str) -> SharedProblem:
    return PROBLEMS[name]()


def solve(problem: Problem, tolerance: float) -> np.ndarray:
    if "adhesion" in problem:
        return adhesive(problem, tolerance)
    wanted = sys.argv[3:]
    return run(shared(wanted[0]), tolerance) if wanted else elastic(problem, tolerance)


if __name__ == "__main__":
    climb(solve, f"viscontact {vc.__version__}")
