"""Common part of the drivers: solve a problem at a ladder of tolerances and measure the time.

A driver runs in the environment of its program as `python DRIVER PROBLEM.npz RESULT.npz` and needs
only NumPy. The problem is given as arrays. The result is a pressure for each tolerance, with the
minimum CPU time and wall time of several repetitions, including the set-up after reading the
arrays.
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
    solve(problem, 1e-3)  # exclude costs that occur once per process (imports, plans)
    tolerances, pressures, cpu, wall = [], [], [], []
    for tolerance in problem["tolerances"].tolist():
        try:
            pressure, seconds = _best(solve, problem, tolerance)
        except Exception as error:  # any error of a program: print it and leave out this tolerance
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
    """Pressure, and minimum CPU and wall time [s] of the repetitions within the time budget."""
    costs = []
    spent = 0.0
    while not costs or (len(costs) < problem["repeats"] and spent < problem["budget"]):
        begun = time.process_time(), time.perf_counter()
        pressure = solve(problem, tolerance)
        costs.append([time.process_time() - begun[0], time.perf_counter() - begun[1]])
        spent += costs[-1][1]
    return pressure, [min(cost) for cost in zip(*costs, strict=True)]
