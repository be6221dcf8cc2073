"""Where pressure has no bound: at the end of a body, and at its points and ridges."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.indenters import Indenter

#: Samples in a cell, and those of a quarter of one and of three: a change of slope is a corner to
#: the grid if so much of what lies within three cells lies within a quarter of one; of an even
#: curvature a twelfth does, of a map's facets, a cell long each, a third.
SAMPLES, QUARTER, AROUND = 16, 4, 48
CONCENTRATED = 0.5

#: A corner counts from this angle on, as part of the strain that makes the pressure. Halving the
#: cells adds E* angle ln(2)/(2 pi) to a peak of 2/pi E* strain then, which is 1 %.
MILD = 0.06


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
    if not outside.any():
        return False
    return bool(
        (contact[1:] & outside[:-1]).any()
        or (contact[:-1] & outside[1:]).any()
        or (contact[:, 1:] & outside[:, :-1]).any()
        or (contact[:, :-1] & outside[:, 1:]).any()
    )


def is_sharp(
    indenter: Indenter,
    place: tuple[float, float],
    reach: tuple[float, float],
    cell: tuple[float, float],
    strain: float,
) -> bool:
    """Whether a body has a point, a ridge or a corner near a place, towards the half-space.

    Parameters
    ----------
    indenter : Indenter
        The body.
    place : tuple of float
        Where pressure is largest [m].
    reach : tuple of float
        How far from there along x and y the point may lie [m].
    cell : tuple of float
        Edges of a cell [m]: what is rounded within a quarter of one is sharp to the grid.
    strain : float
        That makes the largest pressure, `strain_of`; angles are compared to it [-].

    Returns
    -------
    bool
        Whether the slope jumps there: theory's pressure is infinite, or as good as that.

    Notes
    -----
    Under a wedge or a cone of slope s the pressure goes as E* s log(a/r) (Johnson 1985, Contact
    Mechanics, sections 5.2 and 5.3).

    Examples
    --------
    >>> from viscontact.indenters import Cone, Sphere
    >>> near = (0.0, 0.0), (1e-4, 1e-4), (1e-4, 1e-4)
    >>> is_sharp(Cone(1.5), *near, strain=0.07), is_sharp(Sphere(0.01), *near, strain=0.01)
    (True, False)
    """
    x, y = (_samples(*each) for each in zip(place, reach, cell, strict=True))
    gap = indenter.gap(x[:, None], y[None, :])
    gap = np.where(np.isinf(gap), np.nan, gap)  # where the body ends, nothing bends
    return any(_angle(gap, axis, cell[axis] / SAMPLES) > MILD * strain for axis in (0, 1))


def strain_of(peak_pressure: float, compliance: float) -> float:
    """Return the strain that a peak of pressure stands for: the approach over the half width.

    Parameters
    ----------
    peak_pressure : float
        Largest pressure [Pa].
    compliance : float
        Contact compliance, of which the contact modulus is the inverse [1/Pa].

    Notes
    -----
    p0 = 2/pi E* delta/a (Hertz).

    Examples
    --------
    >>> round(strain_of(1e6, 1e-9), 5)
    0.00157
    """
    return np.pi / 2 * peak_pressure * compliance


def _samples(place: float, reach: float, cell: float) -> NDArray[np.float64]:
    """Positions along an axis, so far that there is something around whatever is within reach."""
    count = int(np.ceil(reach / cell * SAMPLES)) + AROUND // 2
    return np.asarray(place + np.arange(-count, count + 1) * cell / SAMPLES)


def _angle(gap: NDArray[np.float64], axis: int, step: float) -> float:
    """Angle of the sharpest corner on lines along an axis, 0 if all are round [rad]."""
    slopes = np.diff(np.moveaxis(gap, axis, 0), axis=0) / step
    aside = (AROUND - QUARTER) // 2
    around = slopes[AROUND:] - slopes[:-AROUND]
    close = (slopes[QUARTER:] - slopes[:-QUARTER])[aside : aside + len(around)]
    is_corner = np.isfinite(around) & (close > CONCENTRATED * around)
    return float(close[is_corner].max(initial=0.0))
