"""Error and observed order of convergence from values at three spacings (Richardson 1911)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass

#: Bounds of the order of convergence: errors of a rim between cells are of about first order, those
#: of smooth pressure of second.
LOWEST_ORDER, HIGHEST_ORDER = 0.5, 2.0

#: Values with a smaller observed order have no limit: a logarithm has order 0, the inverse square
#: root at an edge -1/2.
NO_ORDER = 0.2

#: Relative changes up to this do not show whether there is a limit.
UNCHANGED = 1e-3

#: Orders within which the observed one is looked for, and halvings that find it to 1e-12.
_SPAN, _HALVINGS = (-4.0, 8.0), 44


@dataclass(frozen=True, eq=False)
class Richardson:
    """Error, order and convergence of the values on the finest of three spacings.

    >>> found = richardson([1.01, 1.04, 1.16], [1.0, 2.0, 4.0])
    >>> round(float(found.error), 6), round(float(found.order), 6)
    (0.01, 2.0)
    """

    error: Floats  # estimated, without sign, in the unit of the values; inf: no limit
    order: Floats  # observed [-]; NaN where the values oscillate or do not change
    converges: Bools  # False where differences do not decrease, as at a singularity


def richardson(values: ArrayLike, spacings: ArrayLike) -> Richardson:
    """Estimate the error of the values on the finest of three spacings.

    `values` has shape (3, ...), finest first, all in one unit; `spacings` are three cell or step
    sizes, strictly increasing, in any unit. ValueError for other shapes or spacings.

    Notes
    -----
    With f = f0 + c h^p the three values give (f3 - f2)/(f2 - f1) = (h3^p - h2^p)/(h2^p - h1^p),
    whose right side rises with p (Roache 1998, Verification and Validation in Computational
    Science and Engineering, section 5.10). The error of f1 is then |f2 - f1|/((h2/h1)^p - 1), with
    p kept within 0.5 and 2. Where values oscillate no p is observed; the error is the larger one of
    the two first-order estimates from the differences.

    Examples
    --------
    >>> spacings = np.array([1.0, 2.0, 4.0])
    >>> found = richardson(5.0 + 0.01 * spacings**2, spacings)
    >>> round(float(found.error), 6), round(float(found.order), 6), bool(found.converges)
    (0.01, 2.0, True)
    >>> bool(richardson(-np.log(spacings), spacings).converges)
    False
    """
    found, lengths = _check_values(values, spacings)
    fine, coarse = found[1] - found[0], found[2] - found[1]
    order = _observed_order(fine, coarse, lengths)
    believed = np.clip(order, LOWEST_ORDER, HIGHEST_ORDER)
    smooth = np.abs(fine) / ((lengths[1] / lengths[0]) ** believed - 1)
    rough = lengths[0] * np.maximum(
        np.abs(fine) / (lengths[1] - lengths[0]), np.abs(coarse) / (lengths[2] - lengths[1])
    )
    moves = np.abs(fine) > UNCHANGED * np.abs(found[0])
    endless = moves & (order < NO_ORDER)
    error = np.where(np.isnan(order), rough, smooth)
    return Richardson(np.where(endless, np.inf, error), order, ~endless)


def _check_values(values: ArrayLike, spacings: ArrayLike) -> tuple[Floats, Floats]:
    found, lengths = np.asarray(values, dtype=float), np.asarray(spacings, dtype=float)
    if found.ndim == 0 or len(found) != 3:
        raise ValueError(f"values: wanted three sets of values, got shape {found.shape}")
    if lengths.shape != (3,) or not 0 < lengths[0] < lengths[1] < lengths[2] < np.inf:
        raise ValueError(f"spacings: wanted three, positive and increasing, got {spacings!r}")
    return found, lengths


def _observed_order(fine: Floats, coarse: Floats, lengths: Floats) -> Floats:
    """Order of the power law that both differences follow; NaN where there is none."""
    monotone = fine * coarse > 0
    wanted = np.where(monotone, np.abs(coarse), 1.0) / np.where(monotone, np.abs(fine), 1.0)
    low, high = (np.full(wanted.shape, end) for end in _SPAN)
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        below = _ratio(middle, lengths) < wanted
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.where(monotone, (low + high) / 2, np.nan)


def _ratio(order: Floats, lengths: Floats) -> Floats:
    """(h3^p - h2^p)/(h2^p - h1^p), at p = 0 the ratio of the logarithms."""
    # Avoids 0/0: an order that close to 0 differs from it by less than rounding.
    power = np.where(np.abs(order) < 1e-9, 1e-9, order)
    first, second = (np.log(lengths[k + 1] / lengths[k]) for k in (0, 1))
    ratio: Floats = (
        (lengths[1] / lengths[0]) ** power * np.expm1(power * second) / np.expm1(power * first)
    )
    return ratio
