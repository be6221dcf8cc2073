"""Cost of the whole roller run, in reference convolutions, and beside the published algorithm.

A reference convolution is one plain zero-padded scipy.fft rfft2, multiply, irfft2 on the same
grid. Runs and references take turns, each in a process of its own: between the steps of a run a
reference would empty the caches that the run has filled, and find memory that the run has left. A
second column takes the fastest of many in a row after a run, which is the hardest yardstick: where
the allocator has kept memory it takes a third of the time. Ratios travel from machine to machine;
seconds do not.

For the load at half the length, both libraries for transforms are compared with what is promised:
convolutions at most, 2^18 cells against 2^16 in their own reference convolutions, and times as fast
as the published algorithm, whose whole run is estimated from its first steps (published.py).

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

from viscontact.marching import march_run
from viscontact.run import prepare_run
from viscontact.transforms import fastest_transforms

CELLS, LARGE = (256, 256), (512, 512)
STEPS = 120
CROWNS = (75e-3, 7500e-3)

#: Reference convolutions at most, by library and tolerance; their growth from 2^16 to 2^18 cells at
#: most; and how many times as fast as the published algorithm, by ducc0, at least.
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
    """CPU time [s] of a run without output, of the reference convolution, iterations a step."""

    run: float
    reference: float
    reference_in_a_row: float
    iterations: float

    @property
    def convolutions(self) -> float:
        """Reference convolutions that the run comes to."""
        return self.run / self.reference


def cost_of_run(case: Case, tolerance: float, library: str) -> tuple[float, float, float]:
    """CPU time [s] from the arguments to the last state, of a reference afterwards; iterations."""
    iterations = []

    def run() -> None:
        given = (case.indenter, case.material, case.load, case.grid, case.times)
        prepared = replace(prepare_run(*given, tolerance=tolerance), transforms=library)
        iterations.extend(state.iterations for state in march_run(prepared))

    seconds = seconds_of(run)
    convolve = reference_convolution(case.grid.shape)
    in_a_row = min(seconds_of(convolve) for _ in range(60))
    return seconds, in_a_row, float(np.mean(iterations[1:]))


def cost_of_reference(cells: tuple[int, int]) -> float:
    """CPU time [s] of one of many references, in a process that does nothing else."""
    convolve = reference_convolution(cells)
    return float(np.median([seconds_of(convolve) for _ in range(60)]))


def least(case: Case, tolerance: float, library: str, repeat: int) -> Cost:
    """The least that a run and a reference took, each of several in turn."""
    runs, references = [], []
    for _ in range(repeat):
        references.append(afresh(cost_of_reference, case.grid.shape))
        runs.append(afresh(cost_of_run, case, tolerance, library))
    seconds, in_a_row, iterations = (min(each) for each in zip(*runs, strict=True))
    return Cost(seconds, min(references), in_a_row, iterations)


def afresh(measure: Callable[..., Any], *arguments: Any) -> Any:
    """What a function returns in a process of its own.

    Once large arrays have been freed, the allocator keeps memory: the reference of a process that
    has had more cells takes less than half the time.
    """
    with ProcessPoolExecutor(1, get_context("spawn")) as one:
        return one.submit(measure, *arguments).result()


def print_runs(tolerances: Sequence[float], repeat: int) -> None:
    """All rollers of the paper, by the fastest library."""
    library = fastest_transforms()
    print(f"{library}; {CELLS[0]} x {CELLS[1]} cells, {STEPS} steps, one thread; best of {repeat}")
    print("                                            reference convolutions")
    print("crown mm   e/L  tolerance  its/step   run s             alone  in a row")
    for tolerance in tolerances:
        for crown_radius in CROWNS:
            for eccentricity in (0.0, 0.5, 1.0):
                case = roller(crown_radius, eccentricity, CELLS, STEPS)
                cost = least(case, tolerance, library, repeat)
                print(
                    f"{crown_radius * 1e3:8g} {eccentricity:5g} {tolerance:10g}"
                    f" {cost.iterations:9.2f} {cost.run:7.2f}"
                    f" {cost.convolutions:17.0f} {cost.run / cost.reference_in_a_row:9.0f}",
                    flush=True,
                )


def print_promised(tolerances: Sequence[float], repeat: int) -> None:
    """What is promised of e/L = 0.5, and what it comes to."""
    print(f"\ne/L = 0.5, {STEPS} steps: reference convolutions, and the published algorithm")
    print(
        "crown mm  tolerance  library   2^16  at most   2^18   /2^16  at most"
        "  published s  / 2^16  at least"
    )
    libraries = sorted({"scipy", fastest_transforms()})
    for crown_radius in CROWNS:
        for tolerance in tolerances:
            small, large = (roller(crown_radius, 0.5, cells, STEPS) for cells in (CELLS, LARGE))
            theirs = afresh(estimate, small, tolerance, STEPS).seconds
            for library in libraries:
                cost, fine = (least(case, tolerance, library, repeat) for case in (small, large))
                most = PROMISED.get((library, tolerance), "-")
                times = LEAST_TIMES if library == "ducc0" else "-"
                print(
                    f"{crown_radius * 1e3:8g} {tolerance:10g}  {library:7}"
                    f" {cost.convolutions:6.0f} {most:>8} {fine.convolutions:6.0f}"
                    f" {fine.convolutions / cost.convolutions:7.2f} {LARGER:8.1f}"
                    f" {theirs:12.0f} {theirs / cost.run:7.0f} {times:>9}",
                    flush=True,
                )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tolerance", type=float, nargs="+", default=[1e-5, 1e-8])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--promised", action="store_true", help="only what is promised")
    options = parser.parse_args()
    if not options.promised:
        print_runs(options.tolerance, options.repeat)
    print_promised(options.tolerance, options.repeat)


if __name__ == "__main__":
    main()
