"""Cost per step and memory during a run of many steps, for a law that is not a series.

For such a law the hereditary integral is a sum over all earlier steps if these are few, and a
Prony series within a stated error bound otherwise. Neither the cost of a step nor the memory may
grow with the number of previous steps.

    python benchmarks/long_runs.py [--cells 64] [--steps 10000]
"""

from __future__ import annotations

import argparse
import resource
import sys
import time

import numpy as np

import viscontact as vc
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.transient.setup import prepare_run

RADIUS, FORCE, PERIOD = 0.01, 10.0, 100.0
LAW = vc.FractionalZener(1.5e9, 5e8, 100.0, 0.5)

#: Numbers of steps at which results are printed, and number of steps for their means.
REPORTS, MEAN_OVER = (100, 300, 1000, 2000, 5000, 10000), 100


def peak_memory() -> float:
    """Largest resident set so far [MiB]."""
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / 2**20


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cells", type=int, default=64)
    parser.add_argument("--steps", type=int, default=10000)
    options = parser.parse_args()
    material = vc.Material(LAW, 0.3)
    end = options.steps / 128 * PERIOD
    largest = np.cbrt(0.75 * RADIUS * 1.5 * FORCE * 0.7 * LAW(end))
    grid = vc.Grid((options.cells,) * 2, (2.5 * largest,) * 2)
    load = vc.harmonic(FORCE, FORCE / 2, PERIOD, int(np.ceil(options.steps / 128)))
    case = (vc.Paraboloid(RADIUS, RADIUS), material, load, grid)
    times = vc.uniform_times(end, options.steps)
    plan = prepare_run(Problem(*case, times)).hereditary
    print(f"{options.cells} x {options.cells} cells, {options.steps} steps, one thread")
    print(f"memory: {plan.method}; {plan.fields_kept} fields; error {plan.error:.1e}")
    print(f"{peak_memory():8.0f} MiB before the first step")
    print("    step  ms a step  iterations     peak MiB")
    clock, iterations = [time.process_time()], []
    for step, state in enumerate(vc.march(*case, times)):
        clock.append(time.process_time())
        iterations.append(state.iterations)
        if step in REPORTS or step == options.steps:
            mean = (clock[-1] - clock[-1 - MEAN_OVER]) / MEAN_OVER
            each = float(np.mean(iterations[-MEAN_OVER:]))
            print(f"{step:8d} {mean * 1e3:10.2f} {each:11.2f} {peak_memory():12.0f}", flush=True)


if __name__ == "__main__":
    main()
