"""Loads given as tables: rows denser than the steps, as dense, sparser; spikes; late first touch.

Between its rows a load is linear, and so is that of the exact solution by rods.
"""

import math

import numpy as np

import viscontact as vc
from verification.families.creep_curves import random_creep
from verification.families.exact_run import ExactRun
from verification.families.random_loads import history_of_points, random_times
from verification.families.round_bodies import contact_size, largest_level, run_of
from verification.families.round_profiles import random_body

Array = np.ndarray


def _smooth(rng: np.random.Generator, part: Array) -> Array:
    """A smooth level between 0 and 1 over the parts 0 to 1 of a history."""
    kind = rng.integers(4)
    if kind == 0:
        return np.sin(math.pi * part) ** 2
    if kind == 1:
        return np.sin(math.pi * part / 2) ** 2
    if kind == 2:
        return 1 - np.exp(-rng.uniform(2, 6) * part)
    waves = 1 + rng.uniform(0.3, 0.9) * np.cos(2 * math.pi * rng.uniform(0.8, 2.5) * part)
    return waves * np.minimum(1.0, 8 * part) / 2


def table_of_load(rng: np.random.Generator) -> ExactRun:
    """A smooth load by rows; the run's steps are fewer, the same, or more."""
    creep, a = random_creep(rng, creeping=True), contact_size(rng)
    body = random_body(rng, a)
    control = "force" if creep.jumps and rng.random() < 0.5 else "approach"
    end = creep.time * 10 ** rng.uniform(-0.5, 0.8)
    steps = int(rng.integers(6, 33))
    relation = ("denser", "equal", "sparser")[rng.integers(3)]
    rows = steps
    if relation == "denser":
        rows = round(steps * rng.uniform(1.3, 6.0))
    elif relation == "sparser":
        rows = max(3, round(steps / rng.uniform(1.5, 4.0)))
    part = np.linspace(0.0, 1.0, rows + 1)
    if relation != "equal" and rng.random() < 0.5:
        part[1:-1] += rng.uniform(-0.3, 0.3, rows - 1) / rows
    levels = _smooth(rng, part)
    levels[0] = 0.0
    load = history_of_points(
        (part, levels / levels.max()), control, largest_level(body, creep, control, a, end), end
    )
    times = np.linspace(0.0, end, steps + 1)
    if relation == "equal":
        times = np.asarray(load.times)
    name = f"{body.name}, {relation} table of {control}, {rows}/{steps}, {creep.name}"
    return run_of(rng, body, creep, load, times, name, most=28)


def spike(rng: np.random.Generator) -> ExactRun:
    """A short spike between two instants of the run, on a load that is ramped and held."""
    creep, a = random_creep(rng, creeping=True), contact_size(rng)
    body = random_body(rng, a)
    control = "force" if creep.jumps and rng.random() < 0.5 else "approach"
    end = creep.time * 10 ** rng.uniform(-0.5, 0.8)
    times = vc.uniform_times(end, int(rng.integers(8, 25)))
    gap = end / (len(times) - 1)
    begin = gap * (rng.integers(1, len(times) - 2) + rng.uniform(0.1, 0.5))
    width = gap * 10 ** rng.uniform(-2, -0.4)
    rise, top = rng.uniform(0.05, 0.5) * begin, rng.uniform(0.4, 0.8)
    rows = np.array([0.0, rise, begin, begin + width / 2, begin + width])
    levels = np.array([0.0, top, top, 1.0, top])
    largest = largest_level(body, creep, control, a, end)
    load = history_of_points((rows / end, levels), control, largest, end)
    name = f"{body.name}, spike of {control}, {creep.name}"
    return run_of(rng, body, creep, load, times, name, most=28)


def first_touch(rng: np.random.Generator) -> ExactRun:
    """A stage that starts above the body and touches within a step, some of them twice."""
    creep, a = random_creep(rng), contact_size(rng)
    body = random_body(rng, a)
    end = creep.time * 10 ** rng.uniform(-0.5, 0.8)
    begin = -rng.uniform(0.05, 1.0)
    points = [(0.0, begin), (1.0, 1.0)]
    if rng.random() < 0.5:
        corner = rng.uniform(0.4, 0.8)
        points = [(0.0, begin), (corner, 1.0), (1.0, rng.uniform(-0.2, 0.9))]
    times, levels = np.array(points).T
    largest = largest_level(body, creep, "approach", a, end)
    load = history_of_points((times, levels), "approach", largest, end)
    instants = random_times(rng, end, most=30)
    return run_of(rng, body, creep, load, instants, f"{body.name}, late touch, {creep.name}")
