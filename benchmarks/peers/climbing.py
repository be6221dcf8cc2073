"""Runs of a program at a ladder of tolerances, and comparison of their times with the package.

Times are compared at equal measured error: at the requested error if the results of a program
include it, otherwise at the nearest error that it reached.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Climb:
    """Results of a program: pressure, CPU time and wall time [s] for each tolerance."""

    version: str
    tolerances: np.ndarray
    pressures: np.ndarray
    cpu: np.ndarray
    wall: np.ndarray

    def against(self, truth: np.ndarray) -> Rungs:
        """CPU times and errors, without the reference solution itself."""
        errors = np.array([distance(pressure, truth) for pressure in self.pressures])
        order = np.argsort(errors)[(errors == 0).sum() :]
        # If a looser tolerance took longer, use the smallest time of the tighter ones.
        cpu = np.minimum.accumulate(self.cpu[order])
        return Rungs(errors[order], cpu)


@dataclass(frozen=True, eq=False)
class Rungs:
    """CPU times [s] by error, errors ascending."""

    errors: np.ndarray
    cpu: np.ndarray

    def nearest(self, error: float) -> float:
        """The requested error, limited to the range of the ladder."""
        return float(np.clip(error, self.errors[0], self.errors[-1]))

    def seconds(self, error: float) -> float:
        """CPU time [s] at an error, by log-log interpolation between the tolerances."""
        logs = np.log(error), np.log(self.errors), np.log(self.cpu)
        return float(np.exp(np.interp(*logs)))


@dataclass(frozen=True)
class Reading:
    """CPU time [s] at an error, and its ratio to that of the package at this error or below."""

    error: float
    seconds: float
    ratio: float


def distance(pressure: np.ndarray, truth: np.ndarray) -> float:
    """Relative L2 distance of a pressure."""
    return float(np.linalg.norm(pressure - truth) / np.linalg.norm(truth))


def readings(rungs: Rungs, ours: Rungs, targets: Sequence[float]) -> list[Reading]:
    """Times of a program at the requested errors, and their ratios to those of the package."""
    found = []
    for target in targets:
        error = rungs.nearest(target)
        seconds = rungs.seconds(error)
        found.append(Reading(error, seconds, seconds / ours.seconds(error)))
    return found


def in_columns(found: Sequence[Reading], targets: Sequence[float]) -> str:
    """Seconds and ratios, with the error if it differs from that of the column."""
    cells = []
    for reading, target in zip(found, targets, strict=True):
        elsewhere = "" if np.isclose(reading.error, target, atol=0) else f"at {reading.error:.0e}"
        cells.append(f"{reading.seconds:8.3g} {reading.ratio:7.2f} {elsewhere:9}")
    return "  ".join(cells)


def verdict(ours: str, peers: dict[str, list[Reading]]) -> str:
    """Sentence on whether the package is the fastest, with the ratio at each error."""
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
