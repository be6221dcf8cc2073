"""Table of the runs of a sweep."""

from __future__ import annotations

import numpy as np

from viscontact.studies.sweep.run_table import _instants


def test_row_has_the_last_value_and_that_of_the_largest_magnitude() -> None:
    force, nan = np.array([1.0, 1.0, 1.0, np.nan]), np.full(4, np.nan)
    assert _instants(np.array([1.0, -5.0, 2.0, np.nan]), force) == (2, 1)
    assert _instants(nan, force) == (2, None)  # no such scalar in this run
    assert _instants(nan, nan) == (None, None)  # no result
