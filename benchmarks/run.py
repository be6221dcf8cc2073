"""Cost of the roller's run in reference convolutions, and compared with the published algorithm.

A reference convolution is one plain zero-padded scipy.fft rfft2, multiply, irfft2 on the same
grid. It is timed in two ways. *Alone*: runs and references alternate, each in its own process.
*Between*: one reference is timed after every step of the run, so both are measured under the same
load of the machine, but they evict each other's data from the caches. Ratios can be compared
between machines; seconds cannot.

For the load at half the length, both transform libraries are compared with the promised limits:
number of convolutions, growth from 2^16 to 2^18 cells in their own reference convolutions, and
ratio to the published algorithm, whose whole run is estimated from its first steps (published.py).

    python benchmarks/run.py [--tolerance 1e-5 1e-8] [--repeat 3] [--promised]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context
from typing import Any

import numpy as np
from cases import Case, roller
from published import estimate
from scipy import fft

from viscontact.backend.transforms import fastest_transforms
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.transient.setup import RunSetup, prepare_run
from viscontact.simulation.transient.state_generator import march_run

CELLS, LARGE = (256, 256), (512, 512)
STEPS = 120
CROWNS = (75e-3, 7500e-3)

#: Largest number of reference convolutions, by library and tolerance; its largest growth from 2^16
#: to 2^18 cells; and the smallest ratio to the published algorithm, with ducc0.
PROMISED = {
    ("ducc0", 1e-5): 100,
    ("ducc0", 1e-8): 200,
    ("scipy", 1e-5): 150,
    ("scipy", 1e-8): 300,
}
LARGER, LEAST_TIMES = 1.2, 150


def reference_convolution(cells: tuple[int, int]) -> Callable[[], np.ndarray]:
    nx, ny = cells
    generator = np.random.default_rng(1)
    pressure = generator.random(cells)
    spectrum = fft.rfft2(generator.random((2 * nx, 2 * ny)))

    def convolve() -> np.ndarray:
        transformed = fft.rfft2(pressure, (2 * nx, 2 * ny))
        return fft.irfft2(transformed * spectrum, (2 * nx, 2 * ny))[:nx, :ny]

    return convolve


def seconds_of(act: Callable[[], object]) -> float:
    started = time.process_time()
    act()
    return time.process_time() - started


@dataclass(frozen=True)
class Cost:
    """Cost of a run without output: CPU time [s], convolutions in both ways, iterations."""

    run: float
    alone: float
    between: float
    iterations: float


def run_alone(case: Case, tolerance: float, library: str) -> tuple[float, float]:
    """CPU time [s] from the arguments to the last state; iterations per step."""
    begun = time.process_time()
    iterations = [state.iterations for state in march_run(prepared(case, tolerance, library))]
    return time.process_time() - begun, float(np.mean(iterations[1:]))


def run_between(case: Case, tolerance: float, library: str) -> float:
    """Cost of the run in reference convolutions, one of which is timed after each step."""
    convolve = reference_convolution(case.grid.shape)
    convolve()
    begun = time.process_time()
    run = march_run(prepared(case, tolerance, library))
    references = [seconds_of(convolve) for _ in run]
    seconds = time.process_time() - begun - sum(references)
    return seconds / float(np.mean(references))


def prepared(case: Case, tolerance: float, library: str) -> RunSetup:
    given = (case.indenter, case.material, case.load, case.grid, case.times)
    return replace(prepare_run(Problem(*given, tolerance=tolerance)), transforms=library)


def reference_alone(cells: tuple[int, int]) -> float:
    """Median CPU time [s] of many references, in a process that does nothing else."""
    convolve = reference_convolution(cells)
    return float(np.median([seconds_of(convolve) for _ in range(60)]))


def least(case: Case, tolerance: float, library: str, repeat: int) -> Cost:
    """Minimum cost of several alternating runs and references."""
    references, runs, between = [], [], []
    for _ in range(repeat):
        references.append(afresh(reference_alone, case.grid.shape))
        runs.append(afresh(run_alone, case, tolerance, library))
        between.append(afresh(run_between, case, tolerance, library))
    seconds, iterations = min(runs)
    return Cost(seconds, seconds / min(references), min(between), iterations)


def afresh(measure: Callable[..., Any], *arguments: Any) -> Any:
    """Call a function in a new process and return its result.

    After large arrays have been freed, the allocator keeps memory: in a process that has computed
    larger grids, the reference takes less than half the time.
    """
    with ProcessPoolExecutor(1, get_context("spawn")) as one:
        return one.submit(measure, *arguments).result()


def print_runs(tolerances: Sequence[float], repeat: int) -> None:
    """Print the cost of all rollers of the paper, with the fastest library."""
    library = fastest_transforms()
    print(f"{library}; {CELLS[0]} x {CELLS[1]} cells, {STEPS} steps, one thread; best of {repeat}")
    print("                                       reference convolutions")
    print("crown mm   e/L  tolerance  its/step   run s     alone   between")
    for tolerance in tolerances:
        for crown_radius in CROWNS:
            for eccentricity in (0.0, 0.5, 1.0):
                case = roller(crown_radius, eccentricity, CELLS, STEPS)
                cost = least(case, tolerance, library, repeat)
                print(
                    f"{crown_radius * 1e3:8g} {eccentricity:5g} {tolerance:10g}"
                    f" {cost.iterations:9.2f} {cost.run:7.2f}"
                    f" {cost.alone:9.0f} {cost.between:9.0f}",
                    flush=True,
                )


def print_promised(tolerances: Sequence[float], repeat: int) -> None:
    """Print promised and measured cost for e/L = 0.5."""
    print(
        f"\ne/L = 0.5, {STEPS} steps: reference convolutions, and the published algorithm\n"
        "                                        2^16           2^18           2^18/2^16\n"
        "crown mm  tolerance  library   run s  alone between  alone between  alone between"
        "  published s    / 2^16"
    )
    libraries = sorted({"scipy", fastest_transforms()})
    for crown_radius in CROWNS:
        for tolerance in tolerances:
            small, large = (roller(crown_radius, 0.5, cells, STEPS) for cells in (CELLS, LARGE))
            theirs = afresh(estimate, small, tolerance, STEPS).seconds
            for library in libraries:
                cost, fine = (least(case, tolerance, library, repeat) for case in (small, large))
                print(
                    f"{crown_radius * 1e3:8g} {tolerance:10g}  {library:7} {cost.run:6.2f}"
                    f" {cost.alone:6.0f} {cost.between:7.0f} {fine.alone:6.0f} {fine.between:7.0f}"
                    f" {fine.alone / cost.alone:6.2f} {fine.between / cost.between:7.2f}"
                    f" {theirs:12.0f} {theirs / cost.run:9.0f}",
                    flush=True,
                )
            most = (f"{name} {PROMISED.get((name, tolerance), '-')}" for name in libraries)
            print(
                f"{'promised':>19}: at most {', '.join(most)}; at most {LARGER:g} times as many;"
                f" by ducc0 at least {LEAST_TIMES} times as fast"
            )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tolerance", type=float, nargs="+", default=[1e-5, 1e-8])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument(
        "--promised", action="store_true", help="only the comparison with the promised limits"
    )
    options = parser.parse_args()
    if not options.promised:
        print_runs(options.tolerance, options.repeat)
    print_promised(options.tolerance, options.repeat)


if __name__ == "__main__":
    main()
