"""Rollers with crowns, sharp, logarithmic and chamfered ends; eccentric and tilted ones.

No closed form is known. The values are those of a ladder of grids and steps, each with half the
cells and half the steps of the one before, extrapolated with the observed order (Richardson 1911):
`python -m verification.families.rollers` computes them and writes `rollers.json`. They are of the
same solver, and so show its convergence only; `test_roller_ends.py` compares rollers with theory.
"""

import json
import math
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import viscontact as vc
from verification.families.exact_run import ExactRun

Array = np.ndarray

DATA = Path(__file__).with_name("rollers.json")
COUNT = 32  # stored rollers

#: Steps of a stored history, and levels of the ladder: cells on half the length, across half the
#: width, and steps in a stored one.
STEPS = 24
LEVELS = ((80, 24, 1), (160, 48, 2), (320, 96, 4))

NAMES = (
    *("force", "approach", "tilt_x", "eccentricity_x", "contact_area", "contact_length"),
    *("contact_width", "peak_pressure", "mean_pressure", "work"),
)


@dataclass(frozen=True)
class RollerProblem:
    """A roller, its load and its body; times of the stored values."""

    name: str
    indenter: vc.Roller
    material: vc.Material
    load: vc.LoadHistory
    times: Array
    half_length: float  # of the body [m]
    half_width: float  # of a line contact under the largest load [m]


def roller_problem(index: int) -> RollerProblem:
    """The roller with a number."""
    rng = np.random.default_rng([15, index])
    kind = ("crowned", "full", "fujiwara", "lundberg", "johns-gohar", "sharp", "sharp", "chamfer")[
        index % 8
    ]
    radius = 10 ** rng.uniform(-2.5, -1.5)
    length = radius * rng.uniform(0.6, 2.0)
    width = length / rng.uniform(10, 25)
    shear, ratio = 10 ** rng.uniform(7, 10), rng.uniform(0.25, 0.5)
    creeps = rng.random() < 0.5
    more = rng.uniform(0.5, 4.0) if creeps else 0.0
    law = vc.Zener(shear, shear / more, shear / more) if creeps else vc.Elastic(shear)
    settled = 2 * shear / (1 - ratio) / (1 + more)  # contact modulus in the end
    force = math.pi * settled * width**2 / (4 * radius) * 2 * length
    roller = _roller(rng, kind, radius, length, width, force, settled)
    load, loading = _load(rng, force, length, width**2 / radius, creeps=creeps)
    times = vc.uniform_times(4.0, STEPS) if creeps else np.array([0.0])
    name = f"{kind} roller {index}, {loading}, {'Zener' if creeps else 'elastic'}"
    return RollerProblem(name, roller, vc.Material(law, ratio), load, times, length, width)


def _roller(
    rng: np.random.Generator,
    kind: str,
    radius: float,
    length: float,
    width: float,
    force: float,
    modulus: float,
) -> vc.Roller:
    """A roller designed for the load; all of them end at or within half the length."""
    section = {"cross_section": "parabola"}
    design = {"force": force, "effective_modulus": modulus}
    deep = 2 * width**2 / radius  # about the approach [m]
    if kind == "crowned":
        straight = length * rng.uniform(0.6, 0.8)
        crown = (length - straight) ** 2 / (2 * deep * rng.uniform(1.2, 2.5))
        return vc.Roller(radius, straight, crown, **section)
    if kind == "full":
        crown = length**2 / (2 * deep * rng.uniform(0.8, 2.0))
        return vc.Roller(radius, length, profile="full", crown_radius=crown, **section)
    if kind == "fujiwara":
        shape = {"load_factor": rng.uniform(1.2, 2.5), "crown_ratio": rng.uniform(0.4, 0.8)}
        shape["end_drop"] = deep * rng.uniform(2.0, 4.0)
        return vc.Roller(radius, length, profile="fujiwara-kawase", **design, **shape, **section)
    if kind in ("lundberg", "johns-gohar"):
        return vc.Roller(radius, length, profile=kind, **design, **section)
    if kind == "chamfer":
        shape = {"length": length * rng.uniform(0.08, 0.2), "angle": rng.uniform(0.02, 0.06)}
        shape["corner_radius"] = length * rng.uniform(1.0, 3.0)
        return vc.Roller(radius, length, profile="chamfer", **shape, **section)
    return vc.Roller(radius, length, **section)


def _load(
    rng: np.random.Generator, force: float, length: float, deep: float, *, creeps: bool
) -> tuple[vc.LoadHistory, str]:
    """Held, or let go in part; through the middle, eccentric, or at a given tilt."""
    levels = (1.0, 1.0)
    if creeps and rng.random() < 0.5:
        levels = (1.0, rng.uniform(0.3, 0.8))
    place: dict[str, float] = {}
    loading = ("central", "eccentric", "tilted")[rng.integers(3)]
    if loading == "eccentric":
        place = {"eccentricity_x": length * rng.uniform(0.02, 0.12)}
    elif loading == "tilted":
        place = {"tilt_x": deep / length * rng.uniform(0.05, 0.3)}
    times = [0.0, 2.0] if creeps else [0.0, 1.0]
    return vc.ForceHistory(times, force * np.array(levels), **place), loading


def solve_level(problem: RollerProblem, level: tuple[int, int, int]) -> dict[str, Array]:
    """Scalars at the stored times on a grid of the ladder; the ends of the body are cell edges."""
    along, across, finer = level
    dx, dy = problem.half_length / along, problem.half_width / across
    shape = 2 * math.ceil(1.15 * along), 2 * math.ceil(1.9 * across)
    grid = vc.Grid(shape, (shape[0] * dx, shape[1] * dy))
    times = problem.times
    if len(times) > 1:
        times = vc.uniform_times(float(times[-1]), finer * (len(times) - 1))
    states = list(
        vc.march(problem.indenter, problem.material, problem.load, grid, times, tolerance=1e-7)
    )
    kept = states[::finer] if len(times) > 1 else states
    return {name: np.array([getattr(state, name) for state in kept]) for name in NAMES}


def extrapolated(values: Array) -> tuple[Array, Array]:
    """Limits of values on three levels, coarse first, and their uncertainties.

    The order is that of the differences, kept between 0.7 and 2.5; where they alternate, the
    finest value stays. The uncertainty is what the extrapolation adds, and a tenth of the last
    difference.
    """
    first, second = values[1] - values[0], values[2] - values[1]
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(first * second > 0, first / second, np.nan)
    ratio = np.clip(ratio, 2**0.7, 2**2.5)
    added = np.where(np.isnan(ratio), 0.0, second / (ratio - 1))
    spread = np.where(np.isnan(ratio), np.abs(second), 0.5 * np.abs(added))
    return values[2] + added, spread + 0.1 * np.abs(second)


def is_singular(peaks: Array) -> Array:
    """Peaks that grow by as much from level to level, at a sharp end: they have no limit."""
    first, second = peaks[1] - peaks[0], peaks[2] - peaks[1]
    return (second > 0.7 * first) & (second > 5e-3 * peaks[2])


def main() -> None:
    """Compute the stored values."""
    stored = {}
    for index in range(COUNT):
        problem = roller_problem(index)
        levels = [solve_level(problem, level) for level in LEVELS]
        entry: dict[str, Any] = {"name": problem.name}
        for name in NAMES:
            found = np.array([level[name] for level in levels])
            value, spread = extrapolated(found)
            if name == "peak_pressure":
                value = np.where(is_singular(found), np.inf, value)
            entry[name] = [[float(f"{each:.8g}") if each < np.inf else None for each in value]]
            entry[name].append([float(f"{each:.2g}") for each in spread.tolist()])
        stored[str(index)] = entry
        print(index, problem.name, flush=True)
        DATA.write_text(json.dumps(stored, indent=None, separators=(",", ":")) + "\n")


@cache
def stored_values() -> dict[str, Any]:
    return dict(json.loads(DATA.read_text()))


def roller(rng: np.random.Generator) -> ExactRun:
    """A stored roller on a grid of 20 to 60 cells along it and 10 to 26 across its contact."""
    index = int(rng.integers(COUNT))
    problem, entry = roller_problem(index), stored_values()[str(index)]
    along, across = rng.uniform(20, 60), rng.uniform(10, 26)
    dx, dy = 2 * problem.half_length / along, 2 * problem.half_width / across
    shape = math.ceil(1.25 * along), math.ceil(1.9 * across)
    grid = vc.Grid(shape, (shape[0] * dx, shape[1] * dy))
    keep = int(rng.choice([1, 2, 3, 4]))
    times = problem.times[:: keep if len(problem.times) > 1 else 1]

    def exact(t: Array) -> dict[str, Array]:
        at = np.searchsorted(problem.times, t * (1 - 1e-9))
        values = {name: np.array(entry[name][0], float)[at] for name in NAMES}
        peak = values["peak_pressure"]
        peak[np.isnan(peak)] = np.inf  # stored as null
        prescribed = ["force", "eccentricity_x"]
        if problem.load.at(0.0).tilt_x is not None:
            prescribed = ["force", "tilt_x"]
        return {name: value for name, value in values.items() if name not in prescribed}

    def uncertainty(t: Array) -> dict[str, Array]:
        at = np.searchsorted(problem.times, t * (1 - 1e-9))
        return {name: np.array(entry[name][1])[at] for name in NAMES}

    return ExactRun(
        problem.name,
        problem.indenter,
        problem.material,
        problem.load,
        grid,
        times,
        exact,
        uncertainty=uncertainty,
    )


if __name__ == "__main__":
    main()
