"""Random load histories: points of a level between 0 and 1 over a time from 0 to 1."""

from collections.abc import Callable

import numpy as np

import viscontact as vc

Array = np.ndarray
Points = tuple[Array, Array]  # times and levels; a time given twice is a jump


def step_and_hold(rng: np.random.Generator) -> Points:
    return np.array([0.0]), np.array([1.0])


def ramp_and_hold(rng: np.random.Generator) -> Points:
    return np.array([0.0, rng.uniform(0.05, 0.8)]), np.array([0.0, 1.0])


def triangle(rng: np.random.Generator) -> Points:
    rise = rng.uniform(0.2, 0.7)
    return np.array([0.0, rise, 1.0]), np.array([0.0, 1.0, 0.0])


def in_and_recover(rng: np.random.Generator) -> Points:
    """Loading, holding, unloading, and some time without load."""
    ends = np.cumsum(rng.uniform(0.1, 1.0, 4))
    return np.append(0.0, ends[:3] / ends[3]), np.array([0.0, 1.0, rng.uniform(0.6, 1.0), 0.0])


def two_cycles(rng: np.random.Generator) -> Points:
    """In and out, in again, with a rest between."""
    ends = np.append(0.0, np.cumsum(rng.uniform(0.2, 1.0, 5)))
    levels = [0.0, 1.0, 0.0, 0.0, rng.uniform(0.5, 1.3), rng.uniform(0.0, 0.6)]
    return ends / ends[-1], np.array(levels)


def reversals(rng: np.random.Generator) -> Points:
    """Partial unloadings."""
    count = int(rng.integers(3, 7))
    ends = np.append(0.0, np.cumsum(rng.uniform(0.3, 1.0, count)))
    levels = np.where(np.arange(count) % 2 == 0, rng.uniform(0.6, 1.0, count), 0.0)
    levels = np.where(levels > 0, levels, rng.uniform(0.2, 0.6, count))
    return ends / ends[-1], np.append(0.0, levels)


def staircase(rng: np.random.Generator) -> Points:
    """Jumps up and down, the load held between."""
    count = int(rng.integers(2, 5))
    jumps = np.append(0.0, np.sort(rng.uniform(0.1, 0.9, count - 1)))
    levels = rng.uniform(0.3, 1.0, count)
    return np.repeat(jumps, 2)[1:], np.repeat(levels, 2)[:-1]


def jump_and_ramp(rng: np.random.Generator) -> Points:
    """A jump, then a ramp up or down, then held."""
    return np.array([0.0, rng.uniform(0.3, 0.9)]), rng.uniform(0.3, 1.0, 2)


SMOOTH = (ramp_and_hold, triangle, in_and_recover, two_cycles, reversals)
WITH_JUMPS = (step_and_hold, staircase, jump_and_ramp)


def random_points(rng: np.random.Generator, *, jumps: bool) -> tuple[str, Points]:
    """One of the histories and its name; without `jumps` one that a body of J(0) = 0 can follow."""
    kinds = (*SMOOTH, *WITH_JUMPS) if jumps else SMOOTH
    kind: Callable = kinds[rng.integers(len(kinds))]
    return kind.__name__.replace("_", " "), kind(rng)


def withdrawn(rng: np.random.Generator, points: Points) -> Points:
    """A stage's history: where the level is 0 later on, the stage may be drawn back further."""
    times, levels = points
    back = -rng.uniform(0.0, 0.3) if rng.random() < 0.5 else 0.0
    later = (levels == 0) & (np.arange(len(levels)) > 0)
    return times, np.where(later, back, levels)


def history_of_points(
    points: Points, control: str, largest: float, end: float, **more: float
) -> vc.LoadHistory:
    """Load of a largest level [N or m] until an end [s]."""
    times, levels = points
    if control == "force":
        return vc.ForceHistory(end * times, largest * levels, **more)
    return vc.ApproachHistory(end * times, largest * levels, **more)


def random_times(rng: np.random.Generator, end: float, most: int = 50) -> Array:
    """Instants of the run: even, logarithmic or scattered, 5 to `most`."""
    count = round(np.exp(rng.uniform(np.log(5), np.log(most))))
    kind = rng.random()
    if kind < 0.55:
        return vc.uniform_times(end, count)
    if kind < 0.8:
        return vc.log_times(end * 10 ** -rng.uniform(1.5, 3.5), end, count)
    return np.unique(np.append(np.sort(rng.uniform(0.0, end, count)), [0.0, end]))
