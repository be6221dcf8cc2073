"""Cost of the whole roller run, in reference convolutions.

A reference convolution is one plain zero-padded scipy.fft rfft2, multiply, irfft2 on the same
grid. One is timed after every step of the run, so that both see the same machine in the same
mood; a second column takes the fastest of many in a row, which find their memory warm and are
the hardest yardstick. Ratios travel from machine to machine; seconds do not.

    python benchmarks/run.py [--tolerance 1e-6] [--repeat 3]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import fft

import viscontact as vc

CELLS = (256, 256)
STEPS = 120


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


def cost_of_run(crown_radius: float, eccentricity: float, tolerance: float) -> Cost:
    law = vc.CreepSeries(5.545e-10, [6.17e-11, 8.38e-11], [10.0, 133.87])
    size = (60e-3, 3e-3) if crown_radius < 1 else (170e-3, 1.6e-3)
    convolve = reference_convolution(CELLS)
    convolve()
    references, iterations = [], []

    def observe(state: vc.ContactState, done: int, total: int) -> None:
        iterations.append(state.iterations)
        references.append(seconds_of(convolve))

    def run() -> None:
        states = vc.march(
            vc.Roller(5e-3, 9.565e-3, crown_radius),
            vc.Material(law, 0.38),
            vc.step(1e4, eccentricity_x=eccentricity * 9.565e-3),
            vc.Grid(CELLS, size),
            vc.uniform_times(1000.0, STEPS),
            tolerance=tolerance,
            progress=observe,
        )
        for _ in states:
            pass

    seconds = seconds_of(run) - sum(references)
    in_a_row = min(seconds_of(convolve) for _ in range(60))
    return Cost(seconds, float(np.mean(references)), in_a_row, float(np.mean(iterations[1:])))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tolerance", type=float, nargs="+", default=[1e-5, 1e-6, 1e-8])
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    print(f"{CELLS[0]} x {CELLS[1]} cells, {STEPS} steps, one thread; best of {options.repeat}")
    print("                                            reference convolutions")
    print("crown mm   e/L  tolerance  its/step   run s     between steps  in a row")
    for tolerance in options.tolerance:
        for crown_radius in (75e-3, 7500e-3):
            for eccentricity in (0.0, 0.5, 1.0):
                costs = [
                    cost_of_run(crown_radius, eccentricity, tolerance)
                    for _ in range(options.repeat)
                ]
                cost = min(costs, key=lambda cost: cost.run)
                print(
                    f"{crown_radius * 1e3:8g} {eccentricity:5g} {tolerance:10g}"
                    f" {cost.iterations:9.2f} {cost.run:7.2f}"
                    f" {cost.run / cost.reference:17.0f} {cost.run / cost.reference_in_a_row:9.0f}",
                    flush=True,
                )


if __name__ == "__main__":
    main()
