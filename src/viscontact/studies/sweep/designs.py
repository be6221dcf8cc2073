"""Designs of a sweep: the values of the varied keys in each run."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Hashable, Mapping, Sequence
from itertools import product
from typing import Literal

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.space import Range
from viscontact.studies.sweep.equal_values import comparable


class EqualValuesError(ValueError):
    """Values that are equal, however they are written, so that two runs would be the same."""


@dataclass(frozen=True)
class Heading:
    """Heading of a column of a table, and the unit in it; empty if the cells have their own."""

    text: str
    key: str
    unit: str


@dataclass(frozen=True)
class Design:
    """Values of the varied keys, as ``--set`` takes them: a row for each run, with its line."""

    kind: str  # grid, zip, table, sample, or cases without varied keys
    keys: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...] = ()
    headings: tuple[Heading, ...] = ()

    def settings(self, row: int) -> tuple[str, ...]:
        """Settings of a row, as KEY=VALUE."""
        return tuple(f"{key}={value}" for key, value in zip(self.keys, self.rows[row], strict=True))

    def name(self, row: int) -> str:
        """Name of a row for its directory: its values, or its number if values may be any."""
        if self.kind in ("table", "sample"):
            return f"{row:04d}"
        short = _short_names(self.keys)
        values = zip(short, self.rows[row], strict=True)
        return "_".join(f"{_safe_text(key)}={_safe_text(value)}" for key, value in values)


#: Design of cases of which no key is varied.
NOTHING_VARIED = Design("cases", (), ((),))


def grid_design(values: Mapping[str, Sequence[str]]) -> Design:
    """All combinations of the values of some keys; those of the last key change fastest."""
    for key, given in values.items():
        _refuse_equal((key,), [(value,) for value in given])
    return Design("grid", tuple(values), tuple(product(*values.values())))


def paired_design(values: Mapping[str, Sequence[str]]) -> Design:
    """The first values of all keys, the second ones, and so on."""
    count = {key: len(given) for key, given in values.items()}
    if len(set(count.values())) > 1:
        numbers = ", ".join(f"{number} of {key}" for key, number in count.items())
        raise ValueError(f"pairs need equal numbers of values, got {numbers}")
    rows = tuple(zip(*values.values(), strict=True))
    _refuse_equal(tuple(values), rows)
    return Design("zip", tuple(values), rows)


def _refuse_equal(keys: Sequence[str], rows: Sequence[tuple[str, ...]]) -> None:
    """Raise ValueError for two rows of equal values, which would be the same run twice."""
    seen: dict[Hashable, str] = {}
    for row in rows:
        pairs = list(zip(keys, row, strict=True))
        text = ", ".join(f"{key}={value}" for key, value in pairs)
        before = seen.setdefault(tuple(comparable(key, value) for key, value in pairs), text)
        if before is not text:
            raise EqualValuesError(f"{before} and {text} are equal; give each once")


def _short_names(keys: Sequence[str]) -> list[str]:
    """Last part of each key, or the whole key where that is ambiguous."""
    last = [key.rpartition(".")[2] for key in keys]
    count = Counter(last)
    return [name if count[name] == 1 else key for key, name in zip(keys, last, strict=True)]


def _safe_text(text: str) -> str:
    """Text with only those characters that directory names may have on any system."""
    words = re.sub(r"[^\w.+%-]+", "-", re.sub(r"\s+", "", text))
    return words.strip("-.") if text.strip()[:1] != "-" else "-" + words.strip("-.")


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
