"""Runs with extreme values of the varied keys, which represent the others of a large sweep."""

from __future__ import annotations

from contextlib import suppress
from itertools import product

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.studies.sweep.designs import Design
from viscontact.units.parsing import parse_any_quantity

#: Largest number of runs of which none is left out.
MOST_PREPARED = 100
#: Largest number of keys whose corners are all searched.
_MOST_CORNERS = 5


def extreme_rows(design: Design) -> list[int]:
    """Rows of a design near the corners of the ranges of its keys; all rows of a small design."""
    count = len(design.rows)
    if count <= MOST_PREPARED:
        return list(range(count))
    columns = [_ranks(column) for column in zip(*design.rows, strict=True)]
    ranks = np.array(columns).T
    number = len(columns)
    if number <= _MOST_CORNERS:
        directions = np.array(list(product((-1.0, 1.0), repeat=number)))
    else:
        directions = np.vstack([np.eye(number), -np.eye(number)])
    found = np.argmax(directions @ ranks.T, axis=1)
    return sorted({0, *(int(row) for row in found)})


def _ranks(values: tuple[str, ...]) -> Floats:
    """Places of values in their order, from -1 to 1; texts are in the order of the design."""
    numbers = _numbers(list(dict.fromkeys(values)))
    order = {text: place for place, text in enumerate(sorted(numbers, key=numbers.__getitem__))}
    places = np.array([order[text] for text in values], dtype=float)
    return 2 * places / max(1, len(order) - 1) - 1


def _numbers(texts: list[str]) -> dict[str, float]:
    """Numbers of texts in SI units; their places in the list where they are no quantities."""
    with suppress(ValueError):
        found = {text: parse_any_quantity(text) for text in texts}
        if len({unit for _, unit in found.values()}) == 1:
            return {text: number for text, (number, _) in found.items()}
    return {text: float(place) for place, text in enumerate(texts)}
