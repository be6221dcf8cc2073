"""Driver for ASPHER: nested grids and FFT operators, with a time loop for creep."""

from __future__ import annotations

from importlib.metadata import version

import aspher
import creep_loop
import numpy as np
from ladder import Problem, climb


def elastic(problem: Problem, tolerance: float) -> np.ndarray:
    cells = problem["gap"].shape[0]
    result = aspher.solve_nested(
        grid_size=cells,
        gap=problem["gap"].ravel(),
        p_nominal=float(problem["force"] / problem["size"].prod()),
        domain_size=float(problem["size"][0]),
        E_star=1 / float(problem["instant"]),
        tol=tolerance,
        backend="periodic" if problem["periodic"] else "fft",
        precond_engine="fft",
    )
    if result.status != "converged":
        raise RuntimeError(f"{result.status}: {result.status_reason}")
    return np.asarray(result.pressure).reshape(cells, cells)


def creep(problem: Problem, tolerance: float) -> np.ndarray:
    cells = problem["gap"].shape[0]
    solver = aspher.ContactSolver(
        grid_size=cells, domain_size=float(problem["size"][0]), E_star=1.0, backend="fft"
    )
    mean = float(problem["force"] / problem["size"].prod())

    def solve(gap: np.ndarray, start: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
        result = solver.solve(
            gap.ravel(),
            p_nominal=mean,
            tol=tolerance,
            precond="fourier-fft",
            p_init=None if start is None else start.ravel(),
        )
        if result.status != "converged":
            raise RuntimeError(f"{result.status}: {result.status_reason}")
        fields = (result.pressure, result.displacement)
        pressure, deflection = (np.array(field).reshape(cells, cells) for field in fields)
        return pressure, deflection

    return creep_loop.march(problem, solve)


def solve(problem: Problem, tolerance: float) -> np.ndarray:
    return creep(problem, tolerance) if "times" in problem else elastic(problem, tolerance)


if __name__ == "__main__":
    climb(solve, f"ASPHER {version('aspher')}")
