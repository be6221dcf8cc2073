"""Driver for tamaas: the solver of Polonsky, Keer and Rey with a time loop, or its Maxwell solver.

The argument `maxwell` after the files selects the latter.
"""

from __future__ import annotations

import sys

import creep_loop
import numpy as np
import tamaas as tm
from ladder import Problem, climb

MOST_ITERATIONS = 20000


def made(problem: Problem, modulus: float, poisson_ratio: float = 0.0) -> tm.Model:
    """Model with the given Young's modulus, which is E* for Poisson's ratio 0."""
    model = tm.ModelFactory.createModel(
        tm.model_type.basic_2d, problem["size"].tolist(), list(problem["gap"].shape)
    )
    model.E, model.nu = modulus, poisson_ratio  # before operators are created, which store them
    if not problem["periodic"]:
        tm.ModelFactory.registerNonPeriodic(model, "dcfft")
    return model


def solver_of(problem: Problem, model: tm.Model, surface: np.ndarray, tolerance: float):
    by = tm.PolonskyKeerRey.pressure
    solver = tm.PolonskyKeerRey(model, surface, tolerance, by, by)
    if not problem["periodic"]:
        solver.setIntegralOperator("dcfft")
    solver.max_iter = MOST_ITERATIONS
    return solver


def mean_pressure(problem: Problem) -> float:
    return float(problem["force"] / problem["size"].prod())


def elastic(problem: Problem, tolerance: float) -> np.ndarray:
    model = made(problem, 1 / float(problem["instant"]))
    solver = solver_of(problem, model, -problem["gap"], tolerance)
    reached = solver.solve(mean_pressure(problem))
    if not reached <= tolerance:
        raise RuntimeError(f"stopped at {reached:g}")
    return np.array(model.traction)


def adhesive(problem: Problem, tolerance: float) -> np.ndarray:
    """Solve each mean gap in the gaps, as is needed with adhesion."""
    work, reach = problem["adhesion"].tolist()
    by, found = tm.PolonskyKeerRey.gap, []
    surface = np.ascontiguousarray(-problem["gap"])
    for gap in problem["mean_gaps"].tolist():
        model = made(problem, 1 / float(problem["instant"]))
        solver = tm.PolonskyKeerRey(model, surface, tolerance, by, by)
        solver.max_iter = MOST_ITERATIONS
        attraction = tm.ExponentialAdhesionFunctional(surface)
        attraction.parameters = {"rho": reach, "surface_energy": work}
        solver.addFunctionalTerm(attraction)
        reached = solver.solve(gap)
        if not reached <= tolerance:
            raise RuntimeError(f"stopped at {reached:g}")
        found.append(np.array(model.traction))
    return np.stack(found)


def creep(problem: Problem, tolerance: float) -> np.ndarray:
    model = made(problem, 1.0)
    surface = np.zeros_like(problem["gap"])
    solver = solver_of(problem, model, surface, tolerance)
    operator = model.operators["dcfft"]

    def solve(gap: np.ndarray, start: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
        solver.surface[...] = -gap.ravel()
        if start is not None:
            model.traction[...] = start
        reached = solver.solve(mean_pressure(problem))
        if not reached <= tolerance:
            raise RuntimeError(f"stopped at {reached:g}")
        pressure, deflection = np.array(model.traction), np.zeros_like(gap)
        operator(pressure, deflection)
        return pressure, deflection

    return creep_loop.march(problem, solve)


def maxwell(problem: Problem, tolerance: float) -> np.ndarray:
    """Solve with the generalized Maxwell body of tamaas, by backward Euler in equal steps.

    The unit is the equilibrium shear modulus, which tamaas assumes to be 1 when it weights
    displacements (2.9.0: only then does a surface held in full contact relax by E* exp(-t/tau)).
    The first instant, at which the body is elastic, is a very short step.
    """
    unit = float(problem["equilibrium_modulus"]) / 4  # E* = 4 G of an incompressible body
    model = made(problem, 3.0, 0.5)
    steps = np.diff(problem["times"])
    solver = tm.MaxwellViscoelastic(
        model,
        -problem["gap"],
        tolerance,
        time_step=1e-9 * float(steps[0]),
        shear_moduli=(problem["moduli"] / 4 / unit).tolist(),
        characteristic_times=problem["maxwell_times"].tolist(),
    )
    solver.setIntegralOperator("dcfft")
    solver.max_iter = MOST_ITERATIONS
    recorded = []
    for step, duration in enumerate([0.0, *steps.tolist()]):
        if step:
            solver.time_step = duration
        solver.solve(mean_pressure(problem) / unit)  # also updates its internal variables
        if step in problem["recorded"]:
            recorded.append(unit * np.array(model.traction))
    return np.stack(recorded)


def solve(problem: Problem, tolerance: float) -> np.ndarray:
    if "adhesion" in problem:
        return adhesive(problem, tolerance)
    if "times" not in problem:
        return elastic(problem, tolerance)
    return (maxwell if "maxwell" in sys.argv[3:] else creep)(problem, tolerance)


if __name__ == "__main__":
    tm.set_log_level(tm.LogLevel.error)
    climb(solve, f"tamaas {tm.__version__}")
