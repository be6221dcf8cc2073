"""Samples: quasi-random values of inputs that scatter, in the order that Sobol' indices need."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from scipy.stats import norm, qmc

from viscontact.backend.arrays import Floats
from viscontact.studies.sensitivity.inputs import NO_INPUTS
from viscontact.studies.sweep.sampling import Range, range_of
from viscontact.units.numbers import whole

Shape = Literal["uniform", "log", "normal"]

#: Part of a normal distribution between its bounds.
BETWEEN = 0.95
#: Largest number of samples.
MOST_SAMPLES = 2**14


@dataclass(frozen=True)
class Scattered:
    """Input that scatters: uniform between two bounds, also of its logarithm, or normal.

    >>> middle = Scattered(Range("load.force", 1.0, 4.0, "kN"), "uniform")
    >>> middle.value(0.5), replace(middle, shape="log").value(0.5)
    ('2.5 kN', '2 kN')
    >>> replace(middle, shape="normal").value(0.025)  # 95 % lie between the bounds
    '1 kN'
    """

    bounds: Range
    shape: Shape

    @property
    def key(self) -> str:
        """Key of the case."""
        return self.bounds.key

    def value(self, part: float) -> str:
        """Value below which a part of the distribution lies, as ``--set`` takes it."""
        if self.shape != "normal":
            return replace(self.bounds, logarithmic=self.shape == "log").value(part)
        tail = (1 - BETWEEN) / 2
        within = float(norm.ppf(min(max(part, 1e-12), 1 - 1e-12)) / norm.ppf(1 - tail))
        return self.bounds.value((within + 1) / 2)

    def __str__(self) -> str:
        low, high = self.bounds.value(0.0), self.bounds.value(1.0)
        said = {"uniform": "", "log": ", uniform logarithm", "normal": ", normal (95 %)"}
        return f"{low} to {high}{said[self.shape]}"


@dataclass(frozen=True)
class Samples:
    """Two samples A and B of some inputs, and for each input A with its values of B.

    Points of one scrambled Sobol' sequence of twice as many dimensions (Saltelli and others 2010).
    """

    inputs: tuple[Scattered, ...]
    count: int  # of each sample, a power of two
    seed: int

    @property
    def labels(self) -> tuple[str, ...]:
        """Names of the samples."""
        return ("A", "B", *(each.key for each in self.inputs))

    def run_name(self, label: str, number: int) -> str:
        """Name of the run of a point."""
        return f"sample {label} {number:05d}"

    def runs(self) -> Iterator[tuple[str, dict[str, str]]]:
        """Yield name and settings of all points, sample by sample."""
        for label, points in zip(self.labels, self.points(), strict=True):
            for number, point in enumerate(points):
                settings = {
                    each.key: each.value(float(part))
                    for each, part in zip(self.inputs, point, strict=True)
                }
                yield self.run_name(label, number), settings

    def points(self) -> Floats:
        """Parts of the distributions, shape (samples, points, inputs)."""
        d = len(self.inputs)
        both = qmc.Sobol(2 * d, rng=np.random.default_rng(self.seed)).random(self.count)
        first, second = both[:, :d], both[:, d:]
        exchanged = np.tile(first, (d, 1, 1))
        for column in range(d):
            exchanged[column, :, column] = second[:, column]
        return np.concatenate([first[None], second[None], exchanged])


def samples_of(
    scatter: Mapping[str, Any], samples: int, seed: int
) -> tuple[Samples | None, list[str]]:
    """Return the samples of some scattered inputs, and notes; ValueError names the fault."""
    if not isinstance(scatter, Mapping):
        raise ValueError("scatter: must be a mapping, as {'load.force': ('9 kN', '11 kN')}")
    wanted, start = whole("samples", samples, 0, MOST_SAMPLES), whole("seed", seed, 0)
    inputs = tuple(_scattered(key, given) for key, given in scatter.items())
    if not inputs or wanted == 0:
        return None, []
    count = 2 ** max(1, math.ceil(math.log2(wanted)))
    note = f"samples: {wanted} are rounded up to {count}, a power of two"
    return Samples(inputs, count, start), [note] if count != wanted else []


def _scattered(key: str, given: Any) -> Scattered:
    texts = [given] if isinstance(given, str) else given if isinstance(given, tuple | list) else []
    texts = [str(each) for each in texts]
    shape: Shape = "uniform"
    if len(texts) > 1 and texts[-1] in ("log", "normal"):
        shape = "log" if texts[-1] == "log" else "normal"
        texts.pop()
    if len(texts) not in (1, 2):
        raise ValueError(
            f"scatter: {key}: must be two bounds, as ('9 kN', '11 kN'), or a number with its "
            "tolerance, as '10 kN ± 1 kN', and 'log' or 'normal' for another distribution than a "
            f"uniform one, got {given!r}"
        )
    if key.partition(".")[0] in NO_INPUTS:
        raise ValueError(
            f"scatter: {key}: cells, steps and output of a case are no inputs of the contact"
        )
    try:
        return Scattered(range_of(key, texts, logarithmic=shape == "log"), shape)
    except ValueError as error:
        raise ValueError(f"scatter: {key}: {error}") from None
