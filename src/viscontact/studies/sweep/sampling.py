"""Random designs of a sweep: points that fill the ranges of some keys evenly."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.studies.space import Range
from viscontact.studies.sweep.designs import Design

Method = Literal["sobol", "latin-hypercube"]

#: Kinds of random points.
METHODS: tuple[Method, ...] = ("sobol", "latin-hypercube")

#: Most runs of a design.
MOST_RUNS = 1_000_000


def sample_design(
    ranges: Sequence[Range], number: int, seed: int = 0, method: Method = "sobol"
) -> Design:
    """Points of a scrambled Sobol sequence or a latin hypercube in the ranges of some keys."""
    # A longer Sobol sequence begins with the shorter one. Sobol' (1967), scrambled as by Matousek
    # (1998); McKay, Beckman and Conover (1979).
    if not 1 <= number <= MOST_RUNS:
        raise ValueError(f"must be a number of runs from 1 to {MOST_RUNS}, got {number}")
    if seed < 0:
        raise ValueError(f"the seed must be zero or more, got {seed}")
    points = _points(len(ranges), number, seed, method)
    rows = (
        tuple(each.value(float(part)) for each, part in zip(ranges, point, strict=True))
        for point in points
    )
    return Design("sample", tuple(each.key for each in ranges), tuple(rows))


def _points(dimensions: int, number: int, seed: int, method: Method) -> Floats:
    """Points in the unit cube, shape (number, dimensions)."""
    generator = np.random.default_rng(seed)
    if method == "latin-hypercube":
        return np.asarray(scipy.stats.qmc.LatinHypercube(dimensions, rng=generator).random(number))
    # Whole blocks of a power of two, of which the last points are left out.
    power = math.ceil(math.log2(number))
    return np.asarray(scipy.stats.qmc.Sobol(dimensions, rng=generator).random_base2(power))[:number]
