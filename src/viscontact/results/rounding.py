"""Numbers that are only rounding, and not worth a row, a column or a panel."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

#: Of the approach: a tilt that moves the ends of the contact by less is rounding.
_NEGLIGIBLE_PART = 1e-6


def is_rounding_tilt(tilt: ArrayLike, contact_length: ArrayLike, approach: ArrayLike) -> bool:
    """Tell whether a tilt is what a centred load leaves by rounding.

    Parameters
    ----------
    tilt : array_like
        Rigid slope over time [rad].
    contact_length : array_like
        Extent of the contact over time [m].
    approach : array_like
        Rigid approach over time [m].

    Returns
    -------
    bool
        Whether it moves the ends of the longest contact by less than a millionth of the largest
        approach. NaN counts as nothing.

    Examples
    --------
    >>> is_rounding_tilt([0.0, 1e-12], 5e-3, 1e-4), is_rounding_tilt([0.0, 1e-6], 5e-3, 1e-4)
    (True, False)
    """
    return _largest(tilt) * _largest(contact_length) <= _NEGLIGIBLE_PART * _largest(approach)


def _largest(values: ArrayLike) -> float:
    magnitudes = np.abs(np.atleast_1d(np.asarray(values, dtype=np.float64)))
    return float(np.nanmax(magnitudes, initial=0.0))
