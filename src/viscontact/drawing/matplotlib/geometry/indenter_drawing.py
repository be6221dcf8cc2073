"""Drawing of an indenter: sections along x and y, and the plan."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import ArrayLike, NDArray

from viscontact.bodies.indenters import Indenter
from viscontact.bodies.indenters.cross_section import Cut
from viscontact.drawing.content.indenter_facts import facts, in_lines, length
from viscontact.drawing.content.shape import DrawnShape, shape_of, stretch_note
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.units.formatting import ReadableUnit, readable_unit
from viscontact.units.numbers import both_lengths, finite_array, real_array

_PLAN_POINTS = 601
_BODY, _BODY_EDGE = "#dfe5ea", style.INK
# Largest aspect ratio of a plan that is drawn in true shape.
_TRUE_SHAPE = 3.0
# Shares of the page for texts below and next to the drawing, and the width of a letter [inch].
_WHOLE, _BESIDE, _LETTER = 0.8, 0.36, 0.065


def draw_indenter(
    indenter: Indenter,
    size: tuple[float, float],
    *,
    contact: tuple[float, float, float, float] | None = None,
    title: str = "",
    shaded: str = "expected contact",
    ends: ArrayLike = (),
    width: Width | None = None,
) -> Figure:
    """Draw an indenter: sections along x and y through its deepest point, and its plan.

    Parameters
    ----------
    indenter : Indenter
        The body.
    size : tuple of float
        Extents of the part that is drawn, along x and y, around the origin [m].
    contact : tuple of float, optional
        Middle and extents of an expected contact, x, y, length and width, which is shaded [m].
    title : str, optional
        Heading of the facts.
    shaded : str, optional
        Name of the shaded contact.
    ends : array_like, optional
        Positions x at which bodies end, which are marked [m].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Three panels; the exaggeration of heights is given above the sections.

    Raises
    ------
    ValueError
        If an extent is not positive, or none of the body lies within them.

    Examples
    --------
    >>> from viscontact.bodies.indenters import Sphere
    >>> figure = draw_indenter(Sphere(0.01), (4e-3, 4e-3))
    >>> [axes.get_xlabel() for axes in figure.axes]
    ['x [mm]', 'y [mm]', 'x [mm]', '']
    """
    size = both_lengths("size", size)
    if contact is not None:
        x, y, length, across = real_array("contact", contact, "m", 1).tolist()
        contact = x, y, length, across
    shape = shape_of(indenter, size, _PLAN_POINTS)
    figure, panels = _panels(page_width(width, style.TWO_COLUMNS))
    unit = readable_unit("m", *size)
    for number, axes in enumerate(panels[0]):
        _draw_section(axes, shape, number, unit, contact)
    _draw_plan(panels[1, 0], shape, unit, contact)
    texts = facts(indenter, shape.sections, shape.levels, contact, shaded)
    planes = np.unique(finite_array("ends", ends, "m")).tolist()
    _mark_ends((panels[0, 0], panels[1, 0]), planes, unit)
    _add_facts(panels[1, 1], chain([title] if title else [], texts, _ends_text(planes)))
    _add_stretch_notes(figure, panels, shape.sections)
    return figure


def _panels(width: float) -> tuple[Figure, NDArray[np.object_]]:
    """Panels: sections above, plan and facts below; all in one column on a narrow page."""
    if width > NARROW:
        figure = style.new_figure(width, 4.8)
        return figure, figure.subplots(2, 2, width_ratios=(1.35, 1), height_ratios=(1, 1.1))
    figure = style.new_figure(width, 7.6)
    return figure, figure.subplots(4, 1, height_ratios=(1, 1, 1.1, 0.9)).reshape(2, 2)


def _draw_section(
    axes: Axes,
    shape: DrawnShape,
    number: int,
    unit: ReadableUnit,
    contact: tuple[float, float, float, float] | None,
) -> None:
    """Draw the section along x or y, by its number."""
    section, place = shape.sections[number], shape.through[1 - number]
    along, fixed = "xy"[number], "yx"[number]
    style.dress(axes)
    height = readable_unit("m", section.top)
    position, gap, top = unit(section.position), height(section.gap), float(height(section.top))
    if contact is not None:
        middle, extent = contact[number], contact[2 + number]
        span = (float(unit(middle - extent / 2)), float(unit(middle + extent / 2)))
        axes.axvspan(*span, color=style.LINE, alpha=0.12, linewidth=0)
    axes.fill_between(position, np.minimum(gap, top), top, color=_BODY, linewidth=0)
    axes.plot(position, gap, color=_BODY_EDGE, linewidth=style.LINE_WIDTH)
    axes.axhline(0, color=style.FAINT, linewidth=style.THIN_LINE)
    for end in section.ends:
        axes.axvline(
            float(unit(end)),
            color=style.BODY,
            linewidth=style.THIN_LINE * 1.5,
            linestyle=(0, (4, 2)),
        )
    axes.set(
        xlim=(position[0], position[-1]),
        ylim=(-0.04 * top, top),
        xlabel=unit.label(along),
        ylabel=height.label("Gap"),
    )
    # The middle of an even mesh is zero up to rounding.
    # Three digits leave room for the exaggeration.
    where = length(place, digits=3) if abs(place) > 1e-6 * section.position[-1] else "0"
    style.add_heading(axes, f"along {along}, at {fixed} = {where}")


def _mark_ends(panels: tuple[Axes, ...], ends: list[float], unit: ReadableUnit) -> None:
    """Mark the planes across x at which bodies end, where they are on the drawing [m]."""
    for axes in panels:
        low, high = axes.get_xlim()
        for end in (float(unit(each)) for each in ends):
            if low <= end <= high:
                axes.axvline(end, color=style.INK, linewidth=1.0, linestyle=":")


def _ends_text(ends: list[float]) -> Iterator[str]:
    if ends:
        yield f"bodies end at x = {', '.join(length(each) for each in ends)} (dotted)"


def _draw_plan(
    axes: Axes,
    shape: DrawnShape,
    unit: ReadableUnit,
    contact: tuple[float, float, float, float] | None,
) -> None:
    style.dress(axes)
    x, y = shape.x, shape.y
    _draw_body(axes, shape, unit)
    if contact is not None:
        _shade_contact(axes, unit, contact)
    axes.set(
        xlim=(float(unit(x[0])), float(unit(x[-1]))),
        ylim=(float(unit(y[0])), float(unit(y[-1]))),
        xlabel=unit.label("x"),
        ylabel=unit.label("y"),
    )
    if 1 / _TRUE_SHAPE <= x[-1] / y[-1] <= _TRUE_SHAPE:
        axes.set_aspect("equal")
    style.add_heading(axes, "plan")


def _draw_body(axes: Axes, shape: DrawnShape, unit: ReadableUnit) -> None:
    """Fill the area of the body, with contour lines of the gap and the outline of its end."""
    x, y, solid = unit(shape.x), unit(shape.y), np.isfinite(shape.gap)
    there = solid.T.astype(float)
    axes.contourf(x, y, there, levels=[0.5, 1.5], colors=[_BODY], antialiased=True)
    if shape.levels:
        lines: dict[str, Any] = {"colors": [style.FAINT], "linewidths": style.THIN_LINE}
        axes.contour(x, y, np.where(solid, shape.gap, np.nan).T, levels=shape.levels, **lines)
    if not solid.all():
        axes.contour(x, y, there, levels=[0.5], colors=[style.BODY], linewidths=1.2)


def _shade_contact(
    axes: Axes, unit: ReadableUnit, contact: tuple[float, float, float, float]
) -> None:
    """Shade the box of the contact, given by its centre and its extents [m]."""
    middle_x, middle_y, length, width = contact
    corner = float(unit(middle_x - length / 2)), float(unit(middle_y - width / 2))
    box = Rectangle(
        *(corner, float(unit(length)), float(unit(width))),
        color=style.LINE,
        alpha=0.12,
        linewidth=0,
    )
    axes.add_patch(box)


def _add_facts(axes: Axes, texts: Iterator[str]) -> None:
    """Write the facts next to the drawing."""
    axes.set_axis_off()
    figure = style.figure_of(axes)
    narrow = figure.get_figwidth() <= NARROW
    room = figure.get_figwidth() * (_WHOLE if narrow else _BESIDE)
    axes.text(
        *(0.0, 1.0, style.literal(in_lines(texts, int(room / _LETTER)))),
        transform=axes.transAxes,
        verticalalignment="top",
        fontsize=style.TICK_SIZE,
        color=style.INK,
        linespacing=1.6,
    )


def _add_stretch_notes(
    figure: Figure, panels: NDArray[np.object_], sections: tuple[Cut, Cut]
) -> None:
    """Note the exaggeration of heights, and of y in the plan, once the layout is known."""
    figure.draw_without_rendering()
    for axes, section in zip(panels[0], sections, strict=True):
        box = axes.get_window_extent()
        extent = float(section.position[-1] - section.position[0])
        stretch = (box.height / (1.04 * section.top)) / (box.width / extent)
        style.add_heading(axes, stretch_note("heights", stretch), aside=True)
    box = panels[1, 0].get_window_extent()
    lengths = [float(each.position[-1] - each.position[0]) for each in sections]
    stretch = (box.height / lengths[1]) / (box.width / lengths[0])
    style.add_heading(panels[1, 0], stretch_note("y", stretch), aside=True)
