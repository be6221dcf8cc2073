"""What a run says of its own accuracy in time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

#: How the memory of a series law begins to describe itself; there is nothing to doubt about it.
_EXACT = "recursion, exact"


def accuracy_lines(time_error: ArrayLike, memory: str, inversion_error: float) -> Iterator[str]:
    """Yield what is to be known of errors in time, as far as there is any.

    Parameters
    ----------
    time_error : array_like
        Estimated relative error of the pressure owed to the steps, at each instant [-].
    memory : str
        How the past was remembered, with its error if it has one.
    inversion_error : float
        Estimated relative error of a numerical conversion of the law [-].

    Yields
    ------
    str
        A line each.
    """
    largest = float(np.nanmax(np.asarray(time_error, dtype=float), initial=0.0))
    if largest > 0:
        yield f"error owed to the time steps: {largest:.1e} of the pressure at most (estimated)"
    if memory and not memory.startswith(_EXACT):
        yield f"memory: {memory}"
    if inversion_error > 0:
        yield f"the law was converted numerically, within {inversion_error:.1e} (estimated)"
