"""Where pressure has no bound: at the end of a body, and at its points and ridges."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.indenters import Indenter

#: Samples each way within a neighbourhood that may hide a point or a ridge.
SAMPLES = 96

#: A shape bends at one point where this part of the bend is left between neighbours four times
#: closer; where it is smooth a quarter is left.
BENT = 0.6

#: Bends by a smaller change of slope, as part of the contact's mean slope, raise a pressure that
#: is no matter.
MILD = 0.3


def touches_end(open_gap: NDArray[np.float64], contact: NDArray[np.bool_]) -> bool:
    """Whether a contact reaches a place where the indenter ends.

    Parameters
    ----------
    open_gap : ndarray, shape (nx, ny)
        Initial gap, +inf outside the outline [m].
    contact : ndarray of bool, shape (nx, ny)
        Cells under pressure.

    Examples
    --------
    >>> touches_end(np.array([[np.inf, 0.0, 0.0]]), np.array([[False, False, True]]))
    False
    """
    outside = np.isinf(open_gap)
    return bool(
        (contact[1:] & outside[:-1]).any()
        or (contact[:-1] & outside[1:]).any()
        or (contact[:, 1:] & outside[:, :-1]).any()
        or (contact[:, :-1] & outside[:, 1:]).any()
    )


def is_sharp(
    indenter: Indenter, place: tuple[float, float], reach: tuple[float, float], slope: float
) -> bool:
    """Whether a body has a point or a ridge near a place, towards the half-space.

    Parameters
    ----------
    indenter : Indenter
        The body.
    place : tuple of float
        Where pressure is largest [m].
    reach : tuple of float
        How far from there along x and y the point may lie [m].
    slope : float
        Mean slope of the body within the contact, to which bends are compared [-].

    Returns
    -------
    bool
        Whether the slope jumps there, from one sample to the next however close they are: theory's
        pressure is infinite then.

    Notes
    -----
    Under a wedge or a cone of slope s the pressure goes as E* s log(a/r) (Johnson 1985, Contact
    Mechanics, sections 5.2 and 5.3).

    Examples
    --------
    >>> from viscontact.indenters import Cone, Sphere
    >>> is_sharp(Cone(1.5), (0.0, 0.0), (1e-4, 1e-4), slope=0.07)
    True
    >>> is_sharp(Sphere(0.01), (0.0, 0.0), (1e-4, 1e-4), slope=0.01)
    False
    """
    part = np.linspace(-1.0, 1.0, 2 * SAMPLES + 1)
    x, y = (centre + part * far for centre, far in zip(place, reach, strict=True))
    gap = indenter.gap(x[:, None], y[None, :])
    gap = np.where(np.isinf(gap), np.nan, gap)  # where the body ends, nothing bends
    for axis, far in enumerate(reach):
        close, wide = (_bend(gap, axis, step) / (step * far / SAMPLES) for step in (1, 4))
        if close > MILD * slope and close > BENT * wide:
            return True
    return False


def _bend(gap: NDArray[np.float64], axis: int, step: int) -> float:
    """Largest second difference along an axis, positive where the body points downwards [m]."""
    lines = np.moveaxis(gap, axis, 0)
    bends = lines[2 * step :] - 2 * lines[step:-step] + lines[: -2 * step]
    return float(bends[np.isfinite(bends)].max(initial=0.0))
