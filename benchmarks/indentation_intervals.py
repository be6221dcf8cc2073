"""Share of the intervals of indentation fits that hold the truth, over random force curves.

Each law has one exact curve (approach, loading, hold, retraction), to which each seed adds offset,
tilt and drift of the baseline and noise; also correlated noise, interference and a random walk. A
line is a law under one kind of noise: the number of curves whose interval holds the truth, for each
parameter.

    python benchmarks/indentation_intervals.py [--seeds 100] [--first 0] [--law zener]
        [--kind 'random walk'] [--until hold]
"""

from __future__ import annotations

import argparse
import sys
import warnings
from collections import Counter
from pathlib import Path

import numpy as np
from scipy.signal import lfilter

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from identification.gel_curves import GELS, Course, drawn_curve, held


def correlated(course: Course, rng: np.random.Generator) -> np.ndarray:
    """Noise of 0.5 nm with a correlation of 0.9 from row to row [m]."""
    steps = rng.standard_normal(course.times.size + 200)
    return 5e-10 * np.sqrt(1 - 0.9**2) * lfilter([1.0], [1.0, -0.9], steps)[200:]


def interference(course: Course, rng: np.random.Generator) -> np.ndarray:
    """Interference of 1 nm with a period of 350 nm of the position [m]."""
    return 1e-9 * np.sin(2 * np.pi * course.position / 3.5e-7 + rng.uniform(0, 2 * np.pi))


def walk(course: Course, rng: np.random.Generator) -> np.ndarray:
    """Random walk of the baseline, by 2 nm in all [m]."""
    steps = rng.standard_normal(course.times.size)
    return 2e-9 * np.cumsum(steps) / np.sqrt(steps.size)


def drag(course: Course, rng: np.random.Generator) -> np.ndarray:
    """Drag of a liquid, 0.6 nm at 2 um/s [m]."""
    return 3e-4 * np.gradient(course.position, course.times)


KINDS = {
    "noise alone": None,
    "correlated": correlated,
    "interference": interference,
    "random walk": walk,
    "drag": drag,
}


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--law", choices=GELS, action="append")
    parser.add_argument("--kind", choices=KINDS, action="append")
    parser.add_argument("--until", choices=("loading", "hold", "end"))
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    for kind in given.kind or KINDS:
        for law in given.law or GELS:
            count: Counter[str] = Counter()
            for seed in range(given.first, given.first + given.seeds):
                drawn = drawn_curve(law, seed, added=KINDS[kind])
                count.update(held(law, drawn, until=given.until))
            shares = ", ".join(f"{name} {number}" for name, number in count.items())
            print(f"{kind}, {law}: of {given.seeds}: {shares}", flush=True)


if __name__ == "__main__":
    main()
