"""Small drawings of indenters and grids."""

from __future__ import annotations

import math
from xml.etree.ElementTree import Element

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.indenters import Indenter
from viscontact.indenters.cross_section import Section, cut, lines_through
from viscontact.notebook.svg_axes import linear
from viscontact.notebook.svg_panel import ROOM, Mark, panel

_POINTS, _MESH = 241, 121
#: Of the smallest radius of curvature: bodies are drawn where their gap is below it.
_CAP = 1 / 8
#: Range in which the end of a body is searched: powers of ten [m], and steps in each.
_DECADES, _TRIALS = (-9, 2), 24
#: Bodies without any length of their own are drawn over this [m]; they look alike at any size.
_ANY_EXTENT = 1e-3
_PERIODS = 3


def indenter_drawings(indenter: Indenter) -> list[Element]:
    """Draw sections through the deepest point of a body, along x and y; one if they are alike."""
    along, across = natural_size(indenter)
    x, y = (np.linspace(-extent / 2, extent / 2, _MESH) for extent in (along, across))
    gap = indenter.gap(x[:, None], y)
    if not np.isfinite(gap).any():
        return []
    at_x, at_y = lines_through(indenter, x, y, gap)
    first = cut(indenter, along, at_y, 0, _POINTS)
    second = cut(indenter, across, at_x, 1, _POINTS)
    if _alike(first, second):
        return [_section(first, "x", "along x and y")]
    return [_section(first, "x", "along x"), _section(second, "y", "along y")]


def natural_size(indenter: Indenter) -> tuple[float, float]:
    """Extents along x and y, around the origin, over which a body is drawn by default [m].

    Examples
    --------
    A cap an eighth of the radius high:

    >>> from viscontact.indenters import Sphere
    >>> [round(extent, 3) for extent in natural_size(Sphere(radius=1.0))]
    [0.968, 0.968]
    """
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
    return min(end, _where(indenter, _CAP * radius, low, high, axis))


def _where(indenter: Indenter, height: float, low: float, high: float, axis: int) -> float:
    """Position between two others where the gap reaches a height [m]."""
    for _ in range(40):
        middle = (low + high) / 2
        gap = min(float(_along(indenter, np.array([s * middle]), axis)[0]) for s in (1.0, -1.0))
        low, high = (middle, high) if gap <= height else (low, middle)
    return high


def _along(indenter: Indenter, places: Floats, axis: int) -> Floats:
    idle = np.zeros_like(places)
    return indenter.gap(places, idle) if axis == 0 else indenter.gap(idle, places)


def _alike(first: Section, second: Section) -> bool:
    same = first.position.shape == second.position.shape
    return same and bool(
        np.allclose(first.position, second.position)
        and np.allclose(first.gap, second.gap, rtol=1e-6, atol=1e-6 * first.top, equal_nan=True)
    )


def _section(section: Section, along: str, heading: str) -> Element:
    half, top = float(section.position[-1]), section.top
    x = linear(along, "m", -half, half)
    y = linear("gap", "m", -0.16 * top, top, most=3)
    plane = Mark(np.array([-half, half]), np.zeros(2), "ground")
    body = Mark(section.position, section.gap, "body")
    across, up = ROOM
    stretch = (up / (1.16 * top)) / (across / (2 * half))
    aside = f"heights ×{stretch:.2g}" if abs(stretch - 1) > 0.05 else ""
    if stretch >= 100:
        aside = f"heights ×{round(stretch, 1 - math.floor(math.log10(stretch))):.0f}"
    return panel(heading, x, y, [plane, body], aside=aside)
