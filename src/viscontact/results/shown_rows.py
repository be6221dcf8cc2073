"""Rows of many that a table or a figure shows, evenly spread."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Integers


def shown_rows(count: int, most: int) -> Integers:
    """Indices of at most so many of the rows, with the first and the last.

    They are equally far apart where that leaves out a quarter of them at most.

    >>> shown_rows(10, 4).tolist(), shown_rows(7, 5).tolist()
    ([0, 3, 6, 9], [0, 2, 4, 6])
    """
    most = min(most, count)
    numbers = range(most, 3 * most // 4, -1)
    shown = next((each for each in numbers if (count - 1) % max(each - 1, 1) == 0), most)
    return np.unique(np.linspace(0, count - 1, shown).round().astype(int))
