"""Growth of the cost of a run with cells, steps, exponentials of the law, rows of a table.

The paper's roller (crown 75 mm, e/L = 0.5) at tolerance 1e-6, from the preparation to the last
state. Prints CPU time, reference convolutions per step, and the convolutions that a step makes on
the grid of the run and its patch. `large` goes on to 2^24 cells, once and without references,
in about ten minutes.

    python benchmarks/growth.py [cells large steps terms rows]
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Iterator
from typing import Any
from unittest.mock import patch

import numpy as np
from cases import PMMA, Case, roller
from run import reference_convolution, seconds_of

import viscontact as vc
from viscontact.mechanics.contact.passes.compiled_passes import CompiledPasses
from viscontact.mechanics.halfspace.convolution import Convolution

#: Rows of the largest grid on which a reference convolution is timed.
LARGEST_WITH_REFERENCE = 1024

CROWN, ECCENTRICITY, TOLERANCE = 75e-3, 0.5, 1e-6
BASE_CELLS, BASE_STEPS = (128, 128), 120


def series(terms: int) -> vc.Law:
    """PMMA's creep, distributed over exponentials with times between 1 s and 1000 s."""
    amplitude = (6.17e-11 + 8.38e-11) / terms
    return vc.CreepSeries(5.545e-10, [amplitude] * terms, np.geomspace(1.0, 1000.0, terms))


def measured(rows: int) -> vc.Law:
    """PMMA's creep as a table with the given number of rows."""
    times = np.concatenate([[0.0], np.geomspace(1e-2, 2000.0, rows - 1)])
    return vc.TabulatedCreep(times, PMMA(times))


def cells() -> Iterator[tuple[str, Case]]:
    for shape in ((64, 64), (128, 128), (256, 256), (512, 512), (1024, 1024)):
        yield f"{np.prod(shape)} cells", roller(CROWN, ECCENTRICITY, shape, 30)


def large() -> Iterator[tuple[str, Case]]:
    for side in (2048, 4096):
        yield f"{side * side} cells", roller(CROWN, ECCENTRICITY, (side, side), 30)


def steps() -> Iterator[tuple[str, Case]]:
    for count in (30, 120, 480, 1000):
        yield f"{count} steps", roller(CROWN, ECCENTRICITY, BASE_CELLS, count)


def terms() -> Iterator[tuple[str, Case]]:
    for count in (1, 2, 5, 10, 20):
        law = series(count)
        yield f"{count} exponentials", roller(CROWN, ECCENTRICITY, BASE_CELLS, BASE_STEPS, law)


def rows() -> Iterator[tuple[str, Case]]:
    for count in (10, 100, 1000):
        law = measured(count)
        yield f"table of {count} rows", roller(CROWN, ECCENTRICITY, BASE_CELLS, BASE_STEPS, law)


GROWTHS = {"cells": cells, "large": large, "steps": steps, "terms": terms, "rows": rows}


def convolutions(case: Case, run: Callable[[], None]) -> tuple[int, float]:
    """Convolutions of a run on at least a quarter of its computed cells, and its time [s]."""
    plain, at_once, sizes = Convolution.apply, CompiledPasses.advance, list[int]()

    def counted(self: Convolution, *args: Any, **options: Any) -> Any:
        sizes.append(self.shape[0] * self.shape[1])
        return plain(self, *args, **options)

    def advanced(self: CompiledPasses, operators: Any, fields: Any, *others: Any) -> Any:
        sizes.append(fields[0][0].size)  # an iteration of the core convolves once
        return at_once(self, operators, fields, *others)

    with (
        patch.object(Convolution, "apply", counted),
        patch.object(CompiledPasses, "advance", advanced),
    ):
        seconds = seconds_of(run)
    least = case.grid.shape[0] * case.grid.shape[1] / 2 / 4  # one half of the roller is computed
    return sum(size >= least for size in sizes), seconds


def cost(case: Case, repeats: int) -> str:
    is_large = case.grid.shape[0] > LARGEST_WITH_REFERENCE
    reference = math.nan
    if not is_large:
        convolve = reference_convolution(case.grid.shape)
        convolve()
        reference = min(seconds_of(convolve) for _ in range(20))

    def run() -> None:
        for _ in case.march(TOLERANCE):
            pass

    count, seconds = convolutions(case, run)
    steps = len(case.times) - 1
    if not is_large:
        seconds = min([seconds, *(seconds_of(run) for _ in range(repeats - 1))])
    per_step = seconds / steps
    cost = f"{seconds:8.2f} s {per_step * 1e3:9.2f} ms {per_step / reference:14.2f}"
    return f"{cost} {count / steps:20.2f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    usual = [name for name in GROWTHS if name != "large"]
    parser.add_argument("which", nargs="*", default=usual, help=", ".join(GROWTHS))
    parser.add_argument("--repeat", type=int, default=2)
    options = parser.parse_args()
    print(f"{'':22}  the run       a step   in references  convolutions a step")
    for which in options.which:
        for name, case in GROWTHS[which]():
            print(f"{name:22} {cost(case, options.repeat)}", flush=True)


if __name__ == "__main__":
    main()
