"""Compliance of cells that come into contact during a step.

At the begin of the step such a cell is still free, and slides under the body while it closes its
gap; to hold it there would be false. Near the edge of a growing contact the surface moves along
itself, against the body, in the ratio of the tractions q/p to the movement that closes the gap,
times C: by modes II and III of a crack, C = n n^T + (1 + κ) t t^T with the normal n of the edge. So
a cell that sticks from its touch on has the slip -C (q/p) gap, as if it were more compliant by
C gap/p. In a first contact, all of which is new, Hertz's field of displacement has instead
C = (1 + κ/4) n n^T + (1 + 3 κ/4) t t^T, exact for a paraboloid.

References
----------
K. L. Johnson, Contact Mechanics, Cambridge (1985), sections 3.7, 5.1 and 7.2.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats


def entry_compliance(
    pressure: Floats,
    before: Floats,
    gap: Floats,
    cell_size: tuple[float, float],
    kappa: float,
) -> Floats:
    """Entries xx, xy and yy of C gap/p in cells that enter [m/Pa], shape (3, nx, ny).

    `before` and `gap` are pressure [Pa] and gap [m] at the begin of the step.
    """
    enters = (pressure > 0) & (before <= 0)
    compliance = np.divide(gap, pressure, out=np.zeros(gap.shape), where=enters & np.isfinite(gap))
    is_first = not (before > 0).any()
    along, across = (1 + kappa / 4, 1 + 3 * kappa / 4) if is_first else (1.0, 1 + kappa)
    x, y = _edge_normal(gap, cell_size)
    xx, yy = along * x * x + across * y * y, along * y * y + across * x * x
    return np.stack([xx, (along - across) * x * y, yy]) * np.maximum(compliance, 0.0)


def _edge_normal(gap: Floats, cell_size: tuple[float, float]) -> Floats:
    """Unit vectors along which the gap opens; along x where it is level or ends."""
    slopes = np.zeros((2, *gap.shape))
    for axis, cell in enumerate(cell_size):
        if gap.shape[axis] > 1:
            with np.errstate(invalid="ignore"):
                slopes[axis] = np.gradient(gap, cell, axis=axis)
    known = np.isfinite(slopes).all(axis=0)
    slopes = np.where(known, slopes, 0.0)
    length = np.hypot(*slopes)
    unit = np.divide(slopes, length, out=np.zeros(slopes.shape), where=length > 0)
    unit[0][length == 0] = 1.0
    return unit
