"""Onset of yield in contacts: the pressure of Hertz at which the stress below reaches a limit."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import scipy

from viscontact.backend.arrays import Floats

#: Depths on the axis, in half widths of the contact.
_DEEPEST = 3.0


@cache
def onset_ratio(poisson_ratio: float, *, is_line: bool = False) -> float:
    """Peak pressure over the largest von Mises stress below a contact of Hertz [-].

    Parameters
    ----------
    poisson_ratio : float
        Of the body [-].
    is_line : bool, optional
        A line contact, in plane strain; else a circular one. That of an ellipse lies between.

    Returns
    -------
    float
        A body begins to yield below the surface at this many times its yield stress.

    Notes
    -----
    The stresses on the axis are those of Johnson (1985, Contact Mechanics, eqs. 3.45 and 4.46).

    Examples
    --------
    >>> round(onset_ratio(0.3), 2), round(onset_ratio(0.3, is_line=True), 2)  # Johnson 1985, 6.1
    (1.61, 1.79)
    """
    stress: Callable[[Floats, float], Floats] = _below_line if is_line else _below_point
    found = scipy.optimize.minimize_scalar(
        lambda depth: -float(stress(np.array(depth), poisson_ratio)),
        bounds=(0.0, _DEEPEST),
        method="bounded",
        options={"xatol": 1e-8},
    )
    at_surface = float(stress(np.array(0.0), poisson_ratio))
    return 1.0 / max(-float(found.fun), at_surface)


def _below_point(depth: Floats, ratio: float) -> Floats:
    """Von Mises stress on the axis of a circular contact, over its peak pressure."""
    with np.errstate(divide="ignore"):
        angle = np.arctan2(1.0, depth)
    along = 1.0 / (1.0 + depth**2)
    radial = (1 + ratio) * (1 - depth * angle) - along / 2
    return np.asarray(np.abs(along - radial))


def _below_line(depth: Floats, ratio: float) -> Floats:
    """Von Mises stress on the axis of a line contact in plane strain, over its peak pressure."""
    root = np.sqrt(1 + depth**2)
    across, down = (1 + 2 * depth**2) / root - 2 * depth, 1 / root
    along = ratio * (across + down)
    differences = (across - down) ** 2 + (down - along) ** 2 + (along - across) ** 2
    return np.asarray(np.sqrt(differences / 2))
