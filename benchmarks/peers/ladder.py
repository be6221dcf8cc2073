"""What every driver does: a problem over a ladder of tolerances, timed; NumPy is all it needs.

A driver runs in its program's own environment as `python DRIVER PROBLEM.npz RESULT.npz`. The
problem is given in arrays; what comes back is a pressure for each tolerance, with the CPU and wall
time of the best of some repeats, from the arrays to the pressure with all that is set up between.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping

import numpy as np

Problem = Mapping[str, np.ndarray]
Solve = Callable[[Problem, float], np.ndarray]


def climb(solve: Solve, version: str) -> None:
    """Solve the problem named on the command line at each of its tolerances."""
    problem = dict(np.load(sys.argv[1]))
    solve(problem, 1e-3)  # what is paid once a process (imports, plans) is not the solver's
    tolerances, pressures, cpu, wall = [], [], [], []
    for tolerance in problem["tolerances"].tolist():
        try:
            pressure, seconds = _best(solve, problem, tolerance)
        except Exception as error:  # whatever a program says: the step is left out, and told
            print(f"{tolerance:g}: {type(error).__name__}: {error}", file=sys.stderr)
            continue
        tolerances.append(tolerance)
        pressures.append(pressure)
        cpu.append(seconds[0])
        wall.append(seconds[1])
    np.savez(
        sys.argv[2],
        tolerances=tolerances,
        pressures=pressures,
        cpu=cpu,
        wall=wall,
        version=version,
    )


def _best(solve: Solve, problem: Problem, tolerance: float) -> tuple[np.ndarray, list[float]]:
    """The pressure, and the least CPU and wall time [s] of repeats that fit the budget."""
    costs = []
    spent = 0.0
    while not costs or (len(costs) < problem["repeats"] and spent < problem["budget"]):
        begun = time.process_time(), time.perf_counter()
        pressure = solve(problem, tolerance)
        costs.append([time.process_time() - begun[0], time.perf_counter() - begun[1]])
        spent += costs[-1][1]
    return pressure, [min(cost) for cost in zip(*costs, strict=True)]
