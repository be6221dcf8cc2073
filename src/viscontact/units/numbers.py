"""What counts as a plain number."""

from __future__ import annotations

import math
from numbers import Real


def as_real(value: object) -> float | None:
    """Return a plain number as a float.

    Parameters
    ----------
    value : object
        What the user gave.

    Returns
    -------
    float or None
        The number, inf for a whole number beyond all floats; None for a boolean, a text, an
        array or anything else that is no plain number.

    Examples
    --------
    >>> as_real(3), as_real(True), as_real("3"), as_real(10**400)
    (3.0, None, None, inf)
    """
    if isinstance(value, bool) or not isinstance(value, Real):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf
