"""Small drawings of indenters."""

from __future__ import annotations

from xml.etree.ElementTree import Element

import numpy as np

from viscontact.bodies.indenters import Indenter
from viscontact.bodies.indenters.cross_section import Cut
from viscontact.drawing.content.shape import natural_size, shape_of, stretch_note
from viscontact.drawing.svg.svg_axes import linear
from viscontact.drawing.svg.svg_panel import ROOM, SvgCurve, panel

_POINTS, _MESH = 241, 121


def indenter_drawings(indenter: Indenter) -> list[Element]:
    """Draw sections through the deepest point of a body, along x and y; one if they are alike."""
    try:
        shape = shape_of(indenter, natural_size(indenter), _MESH, _POINTS)
    except ValueError:  # nothing of the body is near the origin
        return []
    first, second = shape.sections
    if shape.is_alike:
        return [_section(first, "x", "along x and y")]
    return [_section(first, "x", "along x"), _section(second, "y", "along y")]


def _section(section: Cut, along: str, heading: str) -> Element:
    half, top = float(section.position[-1]), section.top
    x = linear(along, "m", -half, half)
    y = linear("gap", "m", -0.16 * top, top, most=3)
    plane = SvgCurve(np.array([-half, half]), np.zeros(2), "ground")
    body = SvgCurve(section.position, section.gap, "body")
    across, up = ROOM
    stretch = (up / (1.16 * top)) / (across / (2 * half))
    return panel(heading, x, y, [plane, body], aside=stretch_note("heights", stretch))
