"""Rows of many that a table or a figure shows, evenly spread."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Integers


def shown_rows(count: int, most: int) -> Integers:
    """Indices of at most so many of the rows, with the first and the last.

    >>> shown_rows(10, 4).tolist()
    [0, 3, 6, 9]
    """
    return np.unique(np.linspace(0, count - 1, min(most, count)).round().astype(int))
