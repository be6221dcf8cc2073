"""Time of a run with the compiled core over that with NumPy, step by step in turns.

A creeping sphere on a Zener body, centred (a quarter is computed) or eccentric (all cells are).
Both runs are in one process, and each step of one follows the same step of the other, so that
whatever else the machine does slows both. Prints CPU milliseconds a step, after the first one, and
the median of the ratios of the steps.

    python benchmarks/inner_loops.py [--sides 64 128 256 1024] [--threads 1]
"""

from __future__ import annotations

import argparse
import statistics
import time
import warnings
from collections.abc import Iterator

import viscontact as vc
from viscontact.backend import compiled

#: Steps of a run by the most cells that take as many.
STEPS = ((2**14, 240), (2**16, 60), (2**18, 30), (2**24, 12))


def march(side: int, steps: int, threads: int, *, eccentric: bool) -> Iterator[vc.ContactState]:
    off = {"eccentricity_x": 2e-5, "eccentricity_y": 1e-5} if eccentric else {}
    material = vc.Material(vc.Zener(10e6, 10e6, 10e6), 0.5)
    grid, times = vc.Grid((side, side), (3e-3, 3e-3)), vc.uniform_times(5.0, steps)
    given = vc.Sphere(10e-3), material, vc.step(4.0, **off), grid, times
    return iter(vc.march(*given, threads=threads))


def turns(side: int, threads: int, *, eccentric: bool) -> tuple[float, float, float]:
    """Milliseconds of a step with NumPy and with the core, and the median ratio."""
    core = compiled.core
    steps = next(count for most, count in STEPS if side**2 <= most)
    spent: tuple[list[float], list[float]] = ([], [])
    runs = []
    for chosen in (None, core):
        compiled.core = chosen
        runs.append(march(side, steps, threads, eccentric=eccentric))
        next(runs[-1])
    for _ in range(1, steps):
        for chosen, run, took in zip((None, core), runs, spent, strict=True):
            compiled.core = chosen
            begun = time.process_time()
            next(run)
            took.append(time.process_time() - begun)
    compiled.core = core
    ratio = statistics.median(a / b for a, b in zip(*spent, strict=True))
    numpy, cpp = (1e3 * statistics.median(each) for each in spent)
    return numpy, cpp, ratio


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sides", type=int, nargs="+", default=[64, 128, 256, 512, 1024])
    parser.add_argument("--threads", type=int, default=1)
    given = parser.parse_args()
    if compiled.core is None:
        parser.error(f"there is no compiled core: {compiled.absent}")
    warnings.simplefilter("ignore")
    print(f"{'cells':>12}{'computed':>10}{'NumPy ms':>10}{'core ms':>10}{'ratio':>8}")
    for side in given.sides:
        for eccentric, computed in ((False, "quarter"), (True, "all")):
            numpy, cpp, ratio = turns(side, given.threads, eccentric=eccentric)
            cells = f"{side} x {side}"
            print(f"{cells:>12}{computed:>10}{numpy:10.2f}{cpp:10.2f}{ratio:8.2f}", flush=True)


if __name__ == "__main__":
    main()
