"""Iso-contours of pressure over the contact (the paper's Figs. 8, 11 and 14)."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import binary_erosion

from viscontact.plot import style
from viscontact.plot.error_band import peak_note
from viscontact.plot.readable import DisplayUnit, display_number, display_unit, time_labels
from viscontact.plot.rim_polygons import beyond_period, rim_path, rim_polygons
from viscontact.plot.snapshots import Snapshot, take_snapshots
from viscontact.plot.squared_pressure import squared_pressure
from viscontact.plot.window import Window, window_around

_NAME = "pressure-map"
# A rough contact of more spots and holes than this has no room for labels.
_SPOTS_AT_MOST = 6
# Percentiles of pressure over the contact between which contours have room for labels.
_LABELLED = (20.0, 97.0)
# Where the largest pressure depends on the mesh, levels go up to what so much of the contact has;
# up to the edge's they would crowd there, and show little of the rest.
_ORDINARY = 0.85


def pressure_map(results: xr.Dataset, *, times: ArrayLike | None = None) -> Figure:
    """Draw iso-contours of pressure, one panel an instant, with the outline of the contact.

    Parameters
    ----------
    results : xarray.Dataset
        What ``simulate`` or ``open_results`` returned, with fields stored.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default four, from the
        first in contact to the last.

    Returns
    -------
    matplotlib.figure.Figure
        Panels with common axes and pressure levels. A long narrow contact is drawn with its
        width stretched by the factor printed in the first panel. That also says where the peak
        pressure depends on the mesh.

    Raises
    ------
    ValueError
        If no fields are stored or the bodies do not touch at these instants.
    """
    snapshots = take_snapshots(results, times, _NAME, count=4)
    window = window_around(snapshots)
    note = peak_note([results], [snapshot.time for snapshot in snapshots])
    levels, unit = _levels(snapshots, _ORDINARY if note else 1.0)
    figure, panels = _panels(len(snapshots), window)
    for axes, snapshot, label in zip(
        panels, snapshots, time_labels(s.time for s in snapshots), strict=True
    ):
        _draw_contours(axes, snapshot, levels, unit, window)
        style.add_heading(axes, f"t = {label}")
    style.add_heading(panels[0], "; ".join(filter(None, (window.note, note))), aside=True)
    _add_colour_bar(figure, panels, levels, unit, "max" if note else "neither")
    return figure


def _levels(snapshots: list[Snapshot], part: float) -> tuple[NDArray[np.float64], DisplayUnit]:
    """Round pressure levels from 0 to above that of so much of the contact [Pa], and their unit."""
    pressed = (each.pressure[each.pressure > 0] for each in snapshots if each.touching)
    peak = max(float(np.quantile(pressure, part)) for pressure in pressed)
    unit = display_unit("Pa", peak)
    levels = MaxNLocator(nbins=10, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, peak / unit.factor)
    return np.asarray(levels) * unit.factor, unit


def _panels(count: int, window: Window) -> tuple[Figure, list[Axes]]:
    long = window.height_to_width < 0.6
    columns = 1 if long else min(count, 2)
    rows = -(-count // columns)
    width = style.TWO_COLUMNS if columns == 2 or long else style.ONE_COLUMN
    panel_width = (width - 1.3) / columns
    height = rows * (panel_width * window.height_to_width + 0.22) + 0.45
    figure = style.new_figure(width, height, fixed_aspect=True)
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    panels = list(grid.flat)
    for unused in panels[count:]:
        unused.remove()
    for axes in panels[:count]:
        style.dress(axes)
        window.show(axes)
    for axes in grid[:, 0]:
        axes.set_ylabel(window.unit.label("y"))
    for axes in grid[-1, :]:
        axes.set_xlabel(window.unit.label("x"))
    return figure, panels[:count]


def _draw_contours(
    axes: Axes,
    snapshot: Snapshot,
    levels: NDArray[np.float64],
    unit: DisplayUnit,
    window: Window,
) -> None:
    if not snapshot.touching:
        return
    polygons = rim_polygons(snapshot)
    outline = rim_path(window.unit(polygon) for polygon in polygons)
    # Contours are drawn between the centres of cells, so half a cell short of the last ones.
    wide = beyond_period(snapshot).with_border(1)
    x, y = window.unit(wide.x), window.unit(wide.y)
    # Contours of the square are the same lines, and smooth up to the rim.
    squared, heights = squared_pressure(wide).T, levels**2
    colours = style.pressure_colours(len(levels) - 1)
    norm = BoundaryNorm(heights, colours.N)
    fill = axes.contourf(x, y, squared, levels=heights, cmap=colours, norm=norm, extend="both")
    lines = axes.contour(x, y, squared, levels=heights[1:-1], colors=style.INK, linewidths=0.5)
    for contours in (fill, lines):
        contours.set_clip_path(outline, axes.transData)
    if len(polygons) <= _SPOTS_AT_MOST:
        _label_contours(axes, lines, snapshot, unit, window)
    axes.add_patch(PathPatch(outline, facecolor="none", edgecolor=style.INK, linewidth=1.1))


def _label_contours(
    axes: Axes, lines: QuadContourSet, snapshot: Snapshot, unit: DisplayUnit, window: Window
) -> None:
    """Write the pressure on the contours, but for those crowded at a rim or a tip."""
    pressure = snapshot.pressure
    lowest, highest = np.percentile(pressure[pressure > 0], _LABELLED) ** 2
    texts = {
        square: display_number(float(unit(math.sqrt(square))))
        for square in lines.levels
        if lowest < square < highest
    }
    inside = binary_erosion(pressure > 0, np.ones((3, 3)))
    for text in axes.clabel(lines, list(texts), fmt=texts, fontsize=6.5, inline_spacing=2):
        place = np.array(text.get_position()) * window.unit.factor
        i, j = (
            int(np.abs(at - p).argmin())
            for at, p in zip((snapshot.x, snapshot.y), place, strict=True)
        )
        if not inside[i, j]:
            text.remove()


def _add_colour_bar(
    figure: Figure, panels: list[Axes], levels: NDArray[np.float64], unit: DisplayUnit, extend: str
) -> None:
    colours = style.pressure_colours(len(levels) - 1)
    shown = ScalarMappable(BoundaryNorm(unit(levels), colours.N), colours)
    bar = figure.colorbar(shown, ax=panels, shrink=0.9, aspect=25, pad=0.02, extend=extend)
    bar.set_label(unit.label("Pressure"), size=style.LABEL_SIZE, color=style.INK)
    bar.ax.tick_params(labelsize=style.TICK_SIZE, width=style.THIN_LINE, length=2.5)
    bar.outline.set(linewidth=style.THIN_LINE, edgecolor=style.INK)
