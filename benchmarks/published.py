"""The published algorithm, as in the paper: the baseline for the speed of the package.

S. Spinu, D. Cerlinca (2018): in every step the contact is computed by the conjugate gradient method
of Polonsky and Keer, with equilibrium of the moments and the force. Displacements are zero-padded
discrete convolutions by FFT. The pressure is constant over a step, so the displacement due to past
pressures is a sum over all earlier steps (eq. 12), with one convolution each. The algorithm is
implemented as published: in every step the past is convolved again, the iteration starts from the
last pressure, each iteration needs two convolutions, and there is no preconditioner.

    python benchmarks/published.py [--steps 120] [--taken 3] [--cells 256 256]

A whole run takes minutes to hours. Only the first steps are computed, and the rest is estimated:
the convolutions of the past are equal to the number of earlier steps, and those of an iteration are
taken as in the last computed step.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from cases import Case, roller
from scipy import fft

from viscontact.mechanics.halfspace.influence import influence_table

MOST_ITERATIONS = 2000


@dataclass
class PlainConvolution:
    """Displacement per unit compliance due to a pressure, by a zero-padded FFT and its inverse."""

    shape: tuple[int, int]
    cell_size: tuple[float, float]
    count: int = 0
    seconds: float = 0.0
    _spectrum: np.ndarray = field(init=False, repr=False)

    def __post_init__(self) -> None:
        distances = [np.minimum(np.arange(2 * n), 2 * n - np.arange(2 * n)) for n in self.shape]
        # The table is mirrored; the offset of a whole block is never read.
        near, across = (np.minimum(d, n - 1) for d, n in zip(distances, self.shape, strict=True))
        table = influence_table(self.shape, self.cell_size)
        self._spectrum = fft.rfft2(table[near[:, None], across[None, :]])

    def __call__(self, pressure: np.ndarray) -> np.ndarray:
        begun = time.process_time()
        nx, ny = self.shape
        padded = (2 * nx, 2 * ny)
        displacement = fft.irfft2(fft.rfft2(pressure, padded) * self._spectrum, padded)[:nx, :ny]
        self.count += 1
        self.seconds += time.process_time() - begun
        return displacement


@dataclass(frozen=True, eq=False)
class Balance:
    """Planes over the cells, and the force [N] and moments [N m] of the pressure."""

    x: np.ndarray
    y: np.ndarray
    cell_area: float
    force: float
    eccentricity: tuple[float, float]

    def planes(self) -> tuple[np.ndarray, np.ndarray]:
        """Scaled 1, x and y on each cell, and the required sums of the pressure with them."""
        scale = np.array([1.0, np.abs(self.x).max(), np.abs(self.y).max()])
        fields = [
            np.ones((len(self.x), len(self.y))),
            np.broadcast_to(self.x[:, None], (len(self.x), len(self.y))),
            np.broadcast_to(self.y[None, :], (len(self.x), len(self.y))),
        ]
        moments = self.force * np.array([1.0, *self.eccentricity]) / self.cell_area
        return np.stack(fields, axis=-1) / scale, moments / scale


def solve(
    gap: np.ndarray,
    compliance: float,
    balance: Balance,
    convolve: Callable[[np.ndarray], np.ndarray],
    start: np.ndarray,
    tolerance: float,
) -> np.ndarray:
    """Polonsky and Keer (1999), section 4, steps 1 to 8, with planes instead of the mean."""
    planes, wanted = balance.planes()
    solid = np.isfinite(gap)
    shape = np.where(solid, gap, 0.0)

    def level(values: np.ndarray, cells: np.ndarray) -> np.ndarray:
        on_cells = planes[cells]
        fit = np.linalg.lstsq(on_cells.T @ on_cells, on_cells.T @ values[cells], rcond=None)[0]
        return values - planes @ fit

    def balanced(pressure: np.ndarray) -> np.ndarray:
        gram = np.einsum("ija,ijb,ij->ab", planes, planes, pressure, optimize=True)
        return pressure * (planes @ np.linalg.solve(gram, wanted))

    pressure = balanced(np.where(solid, start, 0.0))
    direction, norm, keep = np.zeros_like(shape), 1.0, 0.0
    for _ in range(MOST_ITERATIONS):
        touching = pressure > 0
        residual = level(shape + compliance * convolve(pressure), touching)
        before_norm, norm = norm, float((residual[touching] ** 2).sum())
        direction = np.where(touching, residual + keep * norm / before_norm * direction, 0.0)
        change = level(compliance * convolve(direction), touching)
        length = float(
            (residual * direction)[touching].sum() / (change * direction)[touching].sum()
        )
        before = pressure
        pressure = np.where(touching, np.maximum(pressure - length * direction, 0.0), 0.0)
        overlapping = (pressure == 0) & (residual < 0) & solid
        pressure = np.where(overlapping, pressure - length * residual, pressure)
        keep = 0.0 if overlapping.any() else 1.0
        pressure = balanced(pressure)
        if np.abs(pressure - before).sum() <= tolerance * pressure.sum():
            return pressure
    raise RuntimeError(f"no equilibrium within {MOST_ITERATIONS} iterations")


def march(
    gap: np.ndarray,
    compliance: Callable[[float], float],
    balance: Balance,
    convolve: Callable[[np.ndarray], np.ndarray],
    times: np.ndarray,
    tolerance: float,
) -> Iterator[np.ndarray]:
    """Pressure at uniformly spaced instants from 0 on, under a load applied at 0.

    Eq. 12: the displacement at instant k is the sum over n <= k of compliance(t_k - t_n) times the
    convolution of the difference between pressures n and n - 1. The solver computes the last term;
    the others are convolved again in every step.
    """
    pressures: list[np.ndarray] = []
    for k, instant in enumerate(times):
        past = np.zeros_like(gap)
        for n, pressure in enumerate(pressures):
            increment = pressure - (pressures[n - 1] if n else 0.0)
            past += compliance(instant - times[n]) * convolve(increment)
        instantly = compliance(0.0)
        if k:
            past -= instantly * convolve(pressures[-1])
        start = pressures[-1] if pressures else np.ones_like(gap)
        pressures.append(solve(gap + past, instantly, balance, convolve, start, tolerance))
        yield pressures[-1]


def convolutions_of_run(steps: int, of_first: int, of_search: int) -> int:
    """Estimate for a whole run: in each step all earlier instants and an iteration."""
    return of_first + sum(k + 1 + of_search for k in range(1, steps + 1))


@dataclass(frozen=True)
class Estimate:
    """Convolutions of the first step, of a later step, of a whole run, and its CPU time [s]."""

    first: int
    search: int
    whole: int
    seconds: float


def estimate(case: Case, tolerance: float, steps: int, taken: int = 3) -> Estimate:
    """Compute the first steps of a run, and estimate the whole run."""
    grid = case.grid
    convolve = PlainConvolution(grid.shape, grid.cell_size)
    load = case.load.at(0.0)
    eccentricity = (load.eccentricity_x, load.eccentricity_y)
    balance = Balance(grid.x, grid.y, grid.cell_area, load.force or 0.0, eccentricity)
    law = case.material.contact_compliance()
    gap = np.array(case.indenter.gap(grid.x[:, None], grid.y[None, :]))
    begun, counts = time.process_time(), []
    for _ in march(gap, law, balance, convolve, case.times[: taken + 1], tolerance):
        counts.append(convolve.count - sum(counts))
    each = (time.process_time() - begun) / convolve.count
    of_search = counts[-1] - (taken + 1)
    whole = convolutions_of_run(steps, counts[0], of_search)
    return Estimate(counts[0], of_search, whole, whole * each)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=120)
    parser.add_argument("--taken", type=int, default=3, help="number of computed steps")
    parser.add_argument("--cells", type=int, nargs=2, default=(256, 256))
    parser.add_argument("--tolerance", type=float, nargs="+", default=[1e-5, 1e-8])
    parser.add_argument("--crown", type=float, nargs="+", default=[75.0, 7500.0], help="mm")
    options = parser.parse_args()
    print("crown mm  tolerance  first step  later step  whole run  s (estimated)   ours s   ratio")
    for crown in options.crown:
        case = roller(crown * 1e-3, 0.5, tuple(options.cells), options.steps)
        for tolerance in options.tolerance:
            found = estimate(case, tolerance, options.steps, options.taken)
            ours = min(_seconds(case, tolerance) for _ in range(3))
            print(
                f"{crown:8g} {tolerance:10g} {found.first:11d} {found.search:11d}"
                f" {found.whole:10d} {found.seconds:14.0f} {ours:8.2f} {found.seconds / ours:7.0f}",
                flush=True,
            )


def _seconds(case: Case, tolerance: float) -> float:
    """CPU time of the package's run [s]."""
    begun = time.process_time()
    for _ in case.march(tolerance):
        pass
    return time.process_time() - begun


if __name__ == "__main__":
    main()
