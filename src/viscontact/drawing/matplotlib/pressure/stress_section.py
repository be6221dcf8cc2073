"""Von Mises stress below the contact, on a section."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.notes import peak_note
from viscontact.drawing.content.scale import ColourScale, pressure_scale
from viscontact.drawing.content.stress_planes import StressPlane, grouped_sections
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.contour_labels import label_contours
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.mechanics.halfspace.stress_lines import Progress
from viscontact.results.snapshots import headings_of, take_snapshots
from viscontact.results.stress_source import StressSource, at_largest_traction, stress_source
from viscontact.units.formatting import ReadableUnit, format_quantity, readable_unit

_NAME = "stress-section"

#: Height of a section that is as deep as wide, because the grid ends near the contact [inch].
_HIGHEST = 2.2
_FLAT = 2.2  # height of a figure [inch] below which its colour bar lies beneath
#: Number of areas between levels, at most.
_LEVELS = 9


def stress_section(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
    progress: Progress | None = None,
) -> Figure:
    """Draw contours of von Mises stress below the contact, one panel per instant.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn. By default the first in contact and the
        last.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].
    progress : callable, optional
        Called as ``progress(done, total)`` after each depth of the sections.

    Returns
    -------
    matplotlib.figure.Figure
        Planes across the contact, along its shorter extent, through the largest pressure, with
        their position; a cross where the stress is largest, and lines at the interfaces of layers.
        They are two half widths of the contact deep, below small spots only as deep as the stress
        is. Of several creepages that of the largest traction is shown. Instants between which the
        contact grows by more than three times have axes of their own.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch, Poisson's ratio is not known, or layers
        creep differently and the fields of some instants only are stored.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> [axes.get_ylabel() for axes in stress_section(ds).axes]
    ['Depth [mm]', 'Von Mises stress [kPa]']
    """
    snapshots = take_snapshots(results, times, _NAME, count=2)
    source = stress_source(at_largest_traction(results))
    groups = grouped_sections(source, snapshots, progress)
    alike, sections = len(groups) == 1, [section for group in groups for section in group]
    length = readable_unit("m", *(section.depths[-1] for section in sections))
    highest = max(section.largest[0] for section in sections)
    scale = pressure_scale(0.0, highest, quantity="Von Mises stress", most=_LEVELS)
    wide = page_width(width, style.ONE_COLUMN)
    # Next to a colour bar, below a heading of two lines: one line would be too long.
    heights = [
        min(section.depths[-1] / float(np.ptp(section.across)) * (wide - 1.3), _HIGHEST)
        for section in sections
    ]
    height = 0.45 + sum(heights) + (0.42 if alike else 0.75) * len(sections)
    is_flat = height < _FLAT  # too low for a colour bar at its side
    height += 0.7 if is_flat else 0.0
    figure = style.new_figure(wide, height, fixed_aspect=True)
    panels = figure.subplots(
        *(len(sections), 1), sharex=alike, sharey=alike, squeeze=False, height_ratios=heights
    )[:, 0]
    headings = headings_of([each for each in snapshots if each.touching])
    contours = []
    for axes, section, heading in zip(panels, sections, headings, strict=True):
        drawn, lines = _draw(axes, section, scale, length)
        contours.append(lines)
        largest, depth, _ = section.largest
        note = f"largest {format_quantity(largest, 'Pa', 3)}, {format_quantity(depth, 'm', 3)} deep"
        # Below an infinite pressure the largest stress is infinite too.
        note = peak_note([results], [section.time]) or note
        place = ", ".join(filter(None, (heading, _creepage(source), section.place_in_words)))
        style.add_heading(axes, f"{place}\n{note}")
    for axes, section in list(zip(panels, sections, strict=True))[-1 if alike else 0 :]:
        axes.set_xlabel(length.label(section.axis))
    look = {"location": "bottom", "pad": 0.04} if is_flat else {"shrink": 0.9, "pad": 0.02}
    bar = figure.colorbar(drawn, ax=panels.tolist(), aspect=25, **look)
    style.dress_colour_bar(bar, scale.label)
    figure.draw_without_rendering()  # The layout gives the room for labels.
    for axes, lines in zip(panels, contours, strict=True):
        label_contours(axes, lines, {level: f"{level:g}" for level in lines.levels})
    return figure


def _creepage(source: StressSource) -> str:
    """Creepage of tractions in steady motion, in words; empty without."""
    if "creepage" not in source.results.coords:
        return ""
    return f"creepage {100 * float(source.results['creepage']):.3g} %"


def _draw(
    axes: Axes, section: StressPlane, scale: ColourScale, length: ReadableUnit
) -> tuple[QuadContourSet, QuadContourSet]:
    """Draw filled contours and their lines."""
    across, depths = length(section.across), length(section.depths)
    levels, values = scale.unit(scale.levels), scale.unit(section.stress)
    colours = ListedColormap(scale.colours(len(levels) - 1))
    filled = axes.contourf(across, depths, values, levels=levels, cmap=colours)
    lines = axes.contour(
        across, depths, values, levels=levels[1:-1], colors=style.INK, linewidths=0.5
    )
    _, depth, place = section.largest
    axes.plot(length(place), length(depth), "+", color=style.INK, markersize=8)
    for depth in section.interfaces:
        axes.axhline(float(length(depth)), color=style.INK, linewidth=1.0)
    axes.set(aspect="equal", ylim=(float(depths[-1]), 0.0), ylabel=length.label("Depth"))
    style.dress(axes)
    return filled, lines
