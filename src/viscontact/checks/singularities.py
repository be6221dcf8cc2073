"""Singular pressure: at the end of a body, and at its points and ridges."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.indenters import Indenter

#: Samples in one cell, in a quarter of one and in three. A change of slope counts as a corner if
#: this part of the change within three cells lies within a quarter of one; under even curvature a
#: twelfth does, and a third at the facets of a map, each a cell long.
SAMPLES, QUARTER, AROUND = 16, 4, 48
CORNER_SHARE = 0.5

#: Smallest angle of a corner that counts, as a part of the strain of the pressure. Halving the
#: cells then adds E* angle ln(2)/(2 pi), or 1 %, to a peak of 2/pi E* strain.
MIN_ANGLE = 0.06


def touches_end(open_gap: NDArray[np.float64], contact: NDArray[np.bool_]) -> bool:
    """True if a contact reaches a cell next to which the indenter ends (open gap +inf).

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
    """True if a body has a point, a ridge or a corner near a place, towards the half-space.

    The largest pressure lies at `place` [m], the point within `reach` of it along x and y [m]. A
    rounding within a quarter of a cell [m] counts as sharp; angles are compared with `strain`, from
    `strain_of` [-].

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
    return any(_angle(gap, axis, cell[axis] / SAMPLES) > MIN_ANGLE * strain for axis in (0, 1))


def strain_of(peak_pressure: float, compliance: float) -> float:
    """Strain (approach over half width) that belongs to a peak pressure by Hertz's theory [-].

    The compliance is the inverse of the contact modulus [1/Pa].

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
    """Positions on an axis around a place, wide enough to compare slopes all over the reach [m]."""
    count = int(np.ceil(reach / cell * SAMPLES)) + AROUND // 2
    return np.asarray(place + np.arange(-count, count + 1) * cell / SAMPLES)


def _angle(gap: NDArray[np.float64], axis: int, step: float) -> float:
    """Angle of the sharpest corner on lines along an axis, 0 if all are round [rad]."""
    slopes = np.diff(np.moveaxis(gap, axis, 0), axis=0) / step
    aside = (AROUND - QUARTER) // 2
    around = slopes[AROUND:] - slopes[:-AROUND]
    close = (slopes[QUARTER:] - slopes[:-QUARTER])[aside : aside + len(around)]
    is_corner = np.isfinite(around) & (close > CORNER_SHARE * around)
    return float(close[is_corner].max(initial=0.0))
