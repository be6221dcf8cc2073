"""Vertical sections through an indenter, for drawings."""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter

POINTS = 1601
# An axis touches the deepest level if its distance is below this part of all heights drawn.
_TOUCHING = 1e-3
# Halvings of a step that locate an end to rounding.
_BISECTIONS = 60
# A section is drawn up to the height that this part of it is below: ends may rise without limit.
SHOWN_PART, _ROOM = 0.96, 1.35


@dataclass(frozen=True, eq=False)
class Cut:
    """Positions along a section, gap there (NaN: no body) and ends of the body in it [m]."""

    position: Floats
    gap: Floats
    ends: tuple[float, ...]

    @property
    def top(self) -> float:
        """Height up to which the section is drawn [m]."""
        solid = self.gap[np.isfinite(self.gap)]
        shown = _ROOM * float(np.quantile(solid, SHOWN_PART)) if solid.size else 0.0
        extent = float(self.position[-1] - self.position[0])
        return shown if shown > 1e-12 * extent else 0.02 * extent


def lines_through(
    indenter: Indenter,
    x: Floats,
    y: Floats,
    gap: Floats,
) -> tuple[float, float]:
    """Choose x and y of the two sections [m]: 0 if the axis touches, else the deepest points."""
    step = float(max(x[1] - x[0], y[1] - y[0]))
    at_x, at_y = _deepest(indenter, x, y, gap, step)
    solid = gap[np.isfinite(gap)]
    touching = float(solid.min()) + _TOUCHING * float(np.ptp(solid)) + 1e-9 * step
    middle = np.zeros(1)
    along_y, along_x = indenter.gap(middle, y), indenter.gap(x, middle)
    return (
        0.0 if along_y.min() <= touching else at_x,
        0.0 if along_x.min() <= touching else at_y,
    )


def _deepest(
    indenter: Indenter,
    x: Floats,
    y: Floats,
    gap: Floats,
    step: float,
) -> tuple[float, float]:
    """Coordinates of the deepest points, the x and the y that are nearest to zero [m]."""
    i, j = np.nonzero(gap <= gap.min() + 1e-9 * step)
    at = float(x[i][np.abs(x[i]).argmin()]), float(y[j][np.abs(y[j]).argmin()])
    if gap.min() <= 1e-9 * step:
        return at
    # The deepest point lies between those of the mesh.
    start = np.array([x[i[0]], y[j[0]]])
    found = scipy.optimize.minimize(
        lambda u: float(np.nan_to_num(indenter.gap(*(start + step * u)), posinf=1e30)) / step,
        np.zeros(2),
        method="Nelder-Mead",
        options={"initial_simplex": [[0, 0], [1, 0], [0, 1]], "xatol": 1e-6, "fatol": 1e-15},
    )
    deepest = start + step * found.x
    return float(deepest[0]), float(deepest[1])


def cut(indenter: Indenter, extent: float, at: float, axis: int, points: int = POINTS) -> Cut:
    """Section of length `extent` along an axis (0: x, 1: y) at the other coordinate `at` [m]."""
    position = np.linspace(-extent / 2, extent / 2, points)

    def gap_at(along: Floats) -> Floats:
        fixed = np.full_like(along, at)
        return indenter.gap(along, fixed) if axis == 0 else indenter.gap(fixed, along)

    solid = np.isfinite(gap_at(position))
    ends = []
    for k in np.flatnonzero(solid[1:] != solid[:-1]).tolist():
        inside, outside = (k, k + 1) if solid[k] else (k + 1, k)
        low, high = float(position[inside]), float(position[outside])
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            within = bool(np.isfinite(gap_at(np.array([middle])))[0])
            low, high = (middle, high) if within else (low, middle)
        ends.append(low)
    position = np.sort(np.concatenate([position, ends]))
    gap = gap_at(position)
    return Cut(position, np.where(np.isfinite(gap), gap, np.nan), tuple(ends))
