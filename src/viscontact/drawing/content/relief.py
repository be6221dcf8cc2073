"""Surface of a field over the plane, as quadrilaterals."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True, eq=False)
class Relief:
    """Quadrilaterals: corners x, y, height, as drawn, shape (n, 4, 3), and values, shape (n,)."""

    corners: Floats
    values: Floats


def relief(x: Floats, y: Floats, height: Floats, values: Floats, shown: Bools) -> Relief:
    """Quadrilaterals between the shown points of a mesh (nx, ny), coloured by mean values."""
    points = np.stack([x, y, height, values], axis=-1)
    around = (points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:])
    whole = shown[:-1, :-1] & shown[1:, :-1] & shown[1:, 1:] & shown[:-1, 1:]
    corners = np.stack([each[whole] for each in around], axis=1)
    return Relief(corners[..., :3], corners[..., 3].mean(axis=1))
