"""A program's climb over a ladder of tolerances, and what its time and error come to beside ours.

Times are compared at equal measured error: at the error asked for where a program's ladder spans
it, else at the nearest error that it reached.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Climb:
    """What a program reached: a pressure and CPU and wall time [s] for each tolerance."""

    version: str
    tolerances: np.ndarray
    pressures: np.ndarray
    cpu: np.ndarray
    wall: np.ndarray

    def against(self, truth: np.ndarray) -> Rungs:
        """CPU times and errors; the truth itself, which has none, is left out."""
        errors = np.array([distance(pressure, truth) for pressure in self.pressures])
        order = np.argsort(errors)[(errors == 0).sum() :]
        # Where a looser tolerance took longer, its error was to be had for the least time beyond.
        cpu = np.minimum.accumulate(self.cpu[order])
        return Rungs(errors[order], cpu)


@dataclass(frozen=True, eq=False)
class Rungs:
    """CPU times [s] by error, errors ascending."""

    errors: np.ndarray
    cpu: np.ndarray

    def nearest(self, error: float) -> float:
        """The error asked for, or the end of the ladder that is nearest to it."""
        return float(np.clip(error, self.errors[0], self.errors[-1]))

    def seconds(self, error: float) -> float:
        """CPU time at an error or less, between the rungs (log-log)."""
        logs = np.log(error), np.log(self.errors), np.log(self.cpu)
        return float(np.exp(np.interp(*logs)))


@dataclass(frozen=True)
class Reading:
    """CPU time [s] at an error, and how many times ours at that error (or a smaller one) it is."""

    error: float
    seconds: float
    ratio: float


def distance(pressure: np.ndarray, truth: np.ndarray) -> float:
    """Relative L2 distance of a pressure."""
    return float(np.linalg.norm(pressure - truth) / np.linalg.norm(truth))


def readings(rungs: Rungs, ours: Rungs, targets: Sequence[float]) -> list[Reading]:
    """What a program took at the errors asked for, beside what we took."""
    found = []
    for target in targets:
        error = rungs.nearest(target)
        seconds = rungs.seconds(error)
        found.append(Reading(error, seconds, seconds / ours.seconds(error)))
    return found


def in_columns(found: Sequence[Reading], targets: Sequence[float]) -> str:
    """Seconds and ratios, and the error where it is not the one of the column."""
    cells = []
    for reading, target in zip(found, targets, strict=True):
        elsewhere = "" if np.isclose(reading.error, target) else f"at {reading.error:.0e}"
        cells.append(f"{reading.seconds:8.3g} {reading.ratio:7.2f} {elsewhere:9}")
    return "  ".join(cells)


def verdict(ours: str, peers: dict[str, list[Reading]]) -> str:
    """Whether ours is the fastest, and by how much at each error."""
    if not peers:
        return ""
    columns = zip(*peers.values(), strict=True)
    names = list(peers)
    parts, ahead = [], True
    for column in columns:
        ratios = [reading.ratio for reading in column]
        least = int(np.argmin(ratios))
        ahead = ahead and ratios[least] > 1
        parts.append((names[least], f"{ratios[least]:.2f}"))
    if len({name for name, _ in parts}) == 1:
        said = f"{parts[0][0]} takes {' and '.join(ratio for _, ratio in parts)} times as long"
    else:
        said = ", ".join(f"{name} takes {ratio} times as long" for name, ratio in parts)
    return f"{ours} is {'' if ahead else 'NOT '}the fastest: {said}"
