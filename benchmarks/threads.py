"""Speed of a run on several threads, compared with one, in turns.

A creeping sphere that is eccentric both ways, so that all cells are computed, after its first step.
Prints wall-clock seconds, the least of the repetitions, and their ratios; the machine must be idle.

    python benchmarks/threads.py [--sides 256 1024 2048] [--threads 2] [--repeat 3]
"""

from __future__ import annotations

import argparse
import subprocess
import sys

RUN = """
import sys, time, warnings
import viscontact as vc

side, steps, threads = map(int, sys.argv[1:])
warnings.simplefilter("ignore")
law = vc.CreepSeries(5e-7, [2e-7, 2e-7, 1e-7], [0.1, 1.0, 10.0])
load = vc.step(0.0676, eccentricity_x=2e-6, eccentricity_y=1e-6)
given = vc.Sphere(0.01), vc.Material(law, 0.4), load
grid, times = vc.Grid((side, side), (2e-3, 2e-3)), vc.uniform_times(2.0, steps)
states = vc.march(*given, grid, times, threads=threads)
next(states)
begun = time.perf_counter()
for _ in states:
    pass
print(time.perf_counter() - begun)
"""


def seconds(side: int, steps: int, threads: int) -> float:
    words = [sys.executable, "-c", RUN, str(side), str(steps), str(threads)]
    done = subprocess.run(words, check=True, capture_output=True, text=True)
    return float(done.stdout)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sides", type=int, nargs="+", default=[256, 512, 1024, 2048])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeat", type=int, default=3)
    given = parser.parse_args()
    print(
        f"{'cells':>10}{'steps':>7}{'1 thread s':>12}{f'{given.threads} threads s':>13}{'ratio':>8}"
    )
    for side in given.sides:
        steps = max(2, 2**22 // side**2)
        steps = min(steps, 40)
        turns = [
            [seconds(side, steps, threads) for threads in (1, given.threads)]
            for _ in range(given.repeat)
        ]
        alone, together = map(min, zip(*turns, strict=True))
        print(
            f"{side * side:10}{steps:7}{alone:12.2f}{together:13.2f}{alone / together:8.2f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
