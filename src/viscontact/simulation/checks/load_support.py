"""Load support: the convex hull of the cells that can touch, within which a force can be balanced.

References
----------
A. M. Andrew, Inf. Process. Lett. 9 (1979) 216: another efficient algorithm for convex hulls.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.grid import Grid
from viscontact.units.formatting import format_quantity


class LoadSupport:
    """Region in which a force can be balanced by pressure >= 0 on cells that can touch, `solid`."""

    def __init__(self, solid: Bools, grid: Grid) -> None:
        self._solid, self._grid = solid, grid
        self._spans = tuple(
            (float(centres[0]), float(centres[-1]))
            for axis, lines in enumerate((grid.x, grid.y))
            if (centres := lines[solid.any(axis=1 - axis)]).size
        )

    def refuse_outside(self, where: tuple[float | None, float | None], time: float) -> None:
        """Refuse a force outside the hull; an eccentricity is None where its tilt is prescribed."""
        for name, eccentricity, (first, last) in zip("xy", where, self._spans, strict=True):
            if eccentricity is not None and not first <= eccentricity <= last:
                raise ValueError(
                    f"load.eccentricity_{name}: the force acts at "
                    f"{format_quantity(eccentricity, 'm', 6)} at t = "
                    f"{format_quantity(time, 's', 6)}, outside what can touch "
                    f"({format_quantity(first, 'm', 6)} to {format_quantity(last, 'm', 6)} along "
                    f"{name}): no pressure can balance it; move the force in, or enlarge the body "
                    "or the grid"
                )
        x, y = where
        if x is not None and y is not None and not self._is_supported(x, y):
            raise ValueError(
                f"load.eccentricity_x: the force acts at ({format_quantity(x, 'm', 6)}, "
                f"{format_quantity(y, 'm', 6)}) at t = {format_quantity(time, 's', 6)}, outside "
                "the hull of what can touch: no pressure can balance it; move the force in"
            )

    @cached_property
    def _envelopes(self) -> tuple[Floats, Floats]:
        """Corners of the hull's far and near side, as x and y [m]."""
        rows = np.flatnonzero(self._solid.any(axis=1))
        first = self._solid[rows].argmax(axis=1)
        last = self._solid.shape[1] - 1 - self._solid[rows, ::-1].argmax(axis=1)
        along_x, far, near = self._grid.x[rows], self._grid.y[last], self._grid.y[first]
        below = _upper_envelope(along_x, -near) * np.array([[1.0], [-1.0]])
        return _upper_envelope(along_x, far), below

    def _is_supported(self, x: float, y: float) -> bool:
        far, near = (float(np.interp(x, *corners)) for corners in self._envelopes)
        rounding = 1e-12 * self._grid.size[1]
        return near - rounding <= y <= far + rounding


def _upper_envelope(x: Floats, y: Floats) -> Floats:
    """Upper convex hull of points of ascending x (Andrew 1979)."""
    # Not by SciPy's hulls, whose import takes a tenth of a second.
    corners: list[tuple[float, float]] = []
    for x2, y2 in zip(x.tolist(), y.tolist(), strict=True):
        while len(corners) > 1:
            (x0, y0), (x1, y1) = corners[-2:]
            if (x1 - x0) * (y2 - y0) < (y1 - y0) * (x2 - x0):
                break
            corners.pop()
        corners.append((x2, y2))
    return np.array(corners).T
