"""Random designs of a sweep: points that fill the ranges of some keys evenly."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.studies.sweep.designs import Design
from viscontact.units.parsing import parse_any_quantity, split_quantity
from viscontact.units.tolerances import read_toleranced

Method = Literal["sobol", "latin-hypercube"]

#: Kinds of random points.
METHODS: tuple[Method, ...] = ("sobol", "latin-hypercube")

#: Most runs of a design.
MOST_RUNS = 1_000_000


@dataclass(frozen=True)
class Range:
    """Range of a key: two numbers in one unit, and the scale on which points are even.

    >>> Range("load.force", 1.0, 100.0, "kN", logarithmic=True).value(0.5)
    '10 kN'
    """

    key: str
    low: float
    high: float
    unit: str  # empty for a plain number
    logarithmic: bool = False

    def value(self, part: float) -> str:
        """Value at a part of the range, 0 to 1, as ``--set`` takes it."""
        if self.logarithmic:
            number = self.low * (self.high / self.low) ** part
        else:
            number = self.low + (self.high - self.low) * part
        return f"{number:.12g} {self.unit}".rstrip()


def read_range(text: str) -> Range:
    """Read a range, ``KEY=LOW:HIGH`` or ``KEY=LOW:HIGH:log``; ValueError names the fault.

    >>> read_range("load.force=500 N:2 kN:log")
    Range(key='load.force', low=500.0, high=2000.0, unit='N', logarithmic=True)
    """
    name, equals, given = text.partition("=")
    key, (low, *others) = name.strip(), (part.strip() for part in given.split(":"))
    logarithmic = others[1:] == ["log"]
    if not (key and equals and low and others and others[0]) or (others[1:] and not logarithmic):
        raise ValueError("write KEY=LOW:HIGH or KEY=LOW:HIGH:log, e.g. 'load.force=5 kN:20 kN:log'")
    return bounded(key, low, others[0], logarithmic=logarithmic)


def bounded(key: str, low: str, high: str, *, logarithmic: bool = False) -> Range:
    """Return the range of a key between two quantities; ValueError names the fault."""
    first, last, unit = _bounds(low, high)
    if not (math.isfinite(first) and math.isfinite(last)):
        raise ValueError(f"the bounds must be finite, got {low} and {high}")
    if not first < last:
        raise ValueError(f"the lower bound comes first, and differs; got {low} and {high}")
    if logarithmic and first <= 0:
        raise ValueError(f"a logarithmic range needs bounds above zero, got {low}")
    return Range(key, first, last, unit, logarithmic)


def range_of(key: str, bounds: Sequence[str], *, logarithmic: bool = False) -> Range:
    """Return the range of a key between two quantities, or of one with its tolerance.

    ValueError names the fault.

    >>> range_of("indenter.radius", ["12 mm ± 0.02 mm"]).value(0.0)
    '11.98 mm'
    """
    if len(bounds) == 1:
        found = read_toleranced(bounds[0])
        if found is None:
            raise ValueError(
                f"must be two bounds, or a number with its tolerance, as '12 mm ± 0.02 mm', got "
                f"{bounds[0]!r}"
            )
        bounds = found.low, found.high
    return bounded(key, *bounds, logarithmic=logarithmic)


def sample_design(
    ranges: Sequence[Range], number: int, seed: int = 0, method: Method = "sobol"
) -> Design:
    """Points of a scrambled Sobol sequence or a latin hypercube in the ranges of some keys.

    The same seed gives the same points; a longer Sobol sequence begins with the shorter one. A
    latin hypercube of N points has one in each N-th of every range. Sobol' (1967), scrambled as by
    Matousek (1998); McKay, Beckman and Conover (1979).
    """
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


def _bounds(low: str, high: str) -> tuple[float, float, str]:
    """Both bounds as numbers in one unit: the given one, or the SI unit if they differ."""
    (first, unit), (last, other) = split_quantity(low), split_quantity(high)
    if unit == other:
        return float(first), float(last), unit
    if not (unit and other):
        raise ValueError(f"both bounds need a unit, or none; got {low!r} and {high!r}")
    with suppress(ValueError):
        (smallest, base), (largest, same) = parse_any_quantity(low), parse_any_quantity(high)
        # A number of kelvin may be a temperature or a difference.
        if base == same and base != "K":
            return smallest, largest, base
    raise ValueError(f"the units of {low!r} and {high!r} do not fit; write one unit in both")
