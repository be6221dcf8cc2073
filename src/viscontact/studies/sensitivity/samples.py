"""Samples: quasi-random values of inputs that scatter, in the order that Sobol' indices need."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from scipy.stats import qmc

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.sensitivity.inputs import NO_INPUTS
from viscontact.studies.space import Scatter, given_scatter
from viscontact.units.numbers import whole

#: Largest number of samples.
MOST_SAMPLES = 2**14


@dataclass(frozen=True)
class Samples:
    """Two samples A and B of some inputs, and for each input A with its values of B."""

    # Points of one scrambled Sobol' sequence of twice as many dimensions (Saltelli and others
    # 2010).

    inputs: tuple[Scatter, ...]
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
    inputs = tuple(_scatter_of(key, given) for key, given in scatter.items())
    if not inputs or wanted == 0:
        return None, []
    count = 2 ** max(1, math.ceil(math.log2(wanted)))
    note = f"samples: {wanted} are rounded up to {count}, a power of two"
    return Samples(inputs, count, start), [note] if count != wanted else []


def _scatter_of(key: str, given: Any) -> Scatter:
    if key.partition(".")[0] in NO_INPUTS:
        raise ValueError(
            f"scatter: {key}: cells, steps and output of a case are no inputs of the contact"
        )
    return given_scatter("scatter", key, given, is_sampled=True)
