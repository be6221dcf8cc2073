"""Shape of an indenter: sections through its deepest point, and its plan."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.indenters.cross_section import (
    POINTS,
    SHOWN_PART,
    Cut,
    cut,
    lines_through,
)
from viscontact.units.formatting import format_compact, format_quantity

#: Heights of the contour lines of a plan over the shown height.
_LEVELS = (0.02, 0.1, 0.25, 0.5, 1.0)
#: Of the smallest radius of curvature: bodies are drawn where their gap is below it.
_CAP = 1 / 8
#: Range in which the end of a body is searched: powers of ten [m], and steps in each.
_DECADES, _TRIALS = (-9, 2), 24
#: Bodies without any length of their own are drawn over this [m]; they look alike at any size.
_ANY_EXTENT = 1e-3
_PERIODS = 3
#: Scales that differ by less are the true shape [-].
_TRUE = 0.05


@dataclass(frozen=True, eq=False)
class DrawnShape:
    """An indenter over a part of the surface around the origin."""

    x: Floats  # mesh of the plan [m]
    y: Floats
    gap: Floats  # on the mesh, shape (nx, ny), infinite where there is no body [m]
    sections: tuple[Cut, Cut]  # along x and y
    through: tuple[float, float]  # x of the section along y, and y of that along x [m]

    @property
    def levels(self) -> list[float]:
        """Gaps of the contour lines of the plan [m]."""
        highest = float(np.quantile(self.gap[np.isfinite(self.gap)], SHOWN_PART))
        return [part * highest for part in _LEVELS] if highest > 0 else []

    @property
    def is_alike(self) -> bool:
        """True if both sections are the same."""
        first, second = self.sections
        return first.position.shape == second.position.shape and bool(
            np.allclose(first.position, second.position, atol=1e-9 * first.position[-1])
            and np.allclose(first.gap, second.gap, rtol=1e-6, atol=1e-6 * first.top, equal_nan=True)
        )


def shape_of(
    indenter: Indenter, size: tuple[float, float], mesh: int, points: int = POINTS
) -> DrawnShape:
    """Shape on extents [m], with numbers of points of plan and section; ValueError if empty."""
    x, y = (np.linspace(-extent / 2, extent / 2, mesh) for extent in size)
    gap = indenter.gap(x[:, None], y)
    if not np.isfinite(gap).any():
        raise ValueError(
            f"nothing of the body lies within {format_quantity(size[0], 'm', 3)} x "
            f"{format_quantity(size[1], 'm', 3)} around the origin; draw a larger part"
        )
    at_x, at_y = lines_through(indenter, x, y, gap)
    along = cut(indenter, size[0], at_y, 0, points)
    across = cut(indenter, size[1], at_x, 1, points)
    return DrawnShape(x, y, gap, (along, across), (at_x, at_y))


def stretch_note(what: str, stretch: float) -> str:
    """Note on the scale of heights or of y over that of lengths."""
    if abs(math.log(stretch)) < math.log(1 + _TRUE):
        return "true shape"
    return f"{what} {format_compact(stretch, 1 if stretch > 100 else 2)}×"


def natural_size(indenter: Indenter) -> tuple[float, float]:
    """Extents along x and y, around the origin, over which a body is drawn by default [m]."""
    found = [_reach(indenter, axis) for axis in (0, 1)]
    own = 0.5 * _PERIODS * indenter.period
    known = [reach for reach in found if math.isfinite(reach)]
    fallback = own if math.isfinite(own) else max(known, default=_ANY_EXTENT / 2)
    reaches = [reach if math.isfinite(reach) else fallback for reach in found]
    # A body that is far longer than wide looks so in numbers; one of no height is no drawing.
    return 2 * reaches[0], 2 * reaches[1]


def _reach(indenter: Indenter, axis: int) -> float:
    """Distance from the origin to which a body is drawn along an axis [m]; inf if unknown."""
    places = np.logspace(*_DECADES, (_DECADES[1] - _DECADES[0]) * _TRIALS + 1)
    gap = np.fmin(*(_along(indenter, sign * places, axis) for sign in (1.0, -1.0)))
    solid = np.flatnonzero(np.isfinite(gap))
    if not solid.size:
        return math.inf
    # The first place beyond the end leaves a margin.
    end = math.inf if solid[-1] == places.size - 1 else float(places[solid[-1] + 1])
    radius = indenter.radius_of_curvature
    if not math.isfinite(radius):
        return end
    below = np.flatnonzero(gap <= _CAP * radius)
    last = int(below[-1]) if below.size else 0
    if last == places.size - 1 or not math.isfinite(gap[last + 1]):
        return end
    low, high = places[last : last + 2].tolist()
    return min(end, _root(indenter, _CAP * radius, low, high, axis))


def _root(indenter: Indenter, height: float, low: float, high: float, axis: int) -> float:
    """Position between two others where the gap reaches a height [m]."""
    for _ in range(40):
        middle = (low + high) / 2
        gap = min(float(_along(indenter, np.array([s * middle]), axis)[0]) for s in (1.0, -1.0))
        low, high = (middle, high) if gap <= height else (low, middle)
    return high


def _along(indenter: Indenter, places: Floats, axis: int) -> Floats:
    idle = np.zeros_like(places)
    return indenter.gap(places, idle) if axis == 0 else indenter.gap(idle, places)
