"""Iso-contours of pressure over the contact (the paper's Figs. 8, 11 and 14)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal, get_args

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike
from scipy.ndimage import label

from viscontact.backend.arrays import Bools, Floats
from viscontact.drawing.content.compared_runs import headed_snapshots
from viscontact.drawing.content.notes import peak_note
from viscontact.drawing.content.rim import beyond_period, rim_curves
from viscontact.drawing.content.squared_pressure import squared_pressure
from viscontact.drawing.content.window import Window, window_around
from viscontact.plot.layout import style
from viscontact.plot.layout.contour_labels import label_contours
from viscontact.plot.layout.map_axes import rim_path, show_window
from viscontact.plot.layout.page import Width, page_width
from viscontact.plot.motion.body_mark import mark_body
from viscontact.results.snapshots import Snapshot
from viscontact.units.formatting import ReadableUnit, format_compact, readable_unit

_NAME = "pressure-map"
#: Appearance of the pressure: labelled iso-contours, or a colour for each cell.
MapStyle = Literal["contours", "colours"]
#: Largest number of spots with contour lines, which would cover more of them.
_MOST_SPOTS = 12
#: Height over width from which on maps are beside each other.
_HIGH = 1.6
#: Colours of cells: the palest one differs from the white without contact.
_CELL_COLOURS = ListedColormap(colormaps["YlGnBu"](np.linspace(0.18, 1.0, 256)))
# Percentiles of pressure over the contact between which contours have room for labels.
_LABELLED = (20.0, 97.0)
#: Quantile of the pressure up to which levels go where the peak depends on the mesh: up to the peak
#: they would concentrate at the edge.
ORDINARY = 0.85


def pressure_map(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
    style: MapStyle | None = None,
) -> Figure:
    """Draw the pressure, one panel per instant, with the outline of the contact.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default four, from the
        first in contact to the last.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].
    style : {"contours", "colours"}, optional
        Labelled iso-contours, or the mean pressure of each cell in colours up to the largest. By
        default colours for a contact of more than a dozen spots, contours otherwise.

    Returns
    -------
    matplotlib.figure.Figure
        Panels with common axes and pressure levels. A long narrow contact is drawn with its
        width stretched by the factor printed in the first panel. A note there
        states where the peak pressure depends on the mesh. A cross is the axis of a moving body, an
        arrow the direction of its motion.

    Raises
    ------
    ValueError
        If no fields are stored or the bodies do not touch at these instants.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> panel, scale = pressure_map(ds).axes
    >>> panel.get_xlabel(), scale.get_ylabel()
    ('x [µm]', 'Pressure [kPa]')
    """
    return _draw({"": results}, times, width, style, count=4)


def compare_pressure_maps(
    runs: Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
    style: MapStyle | None = None,
) -> Figure:
    """Draw the pressure maps of several runs in one figure.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print, with fields stored.
    times : array_like, optional
        Instants [s]; of each run the nearest stored ones are drawn. By default the last of each.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].
    style : {"contours", "colours"}, optional
        As in `pressure_map`.

    Returns
    -------
    matplotlib.figure.Figure
        Panels with common axes and pressure levels, those of a run one after the other.

    Raises
    ------
    ValueError
        If there are no runs, or one of them cannot be drawn.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ball = vc.Sphere(0.01)
    >>> one, two = (
    ...     vc.simulate(ball, rubber, vc.step(force), grid, [1.0], errors=False)
    ...     for force in (0.1, 0.2)
    ... )
    >>> runs = {"0.1 N": one, "0.2 N": two}
    >>> len(compare_pressure_maps(runs).axes)  # a panel for each, and the scale of both
    3
    """
    return _draw(runs, times, width, style)


def _draw(
    runs: Mapping[str, xr.Dataset],
    times: ArrayLike | None,
    width: Width | None,
    chosen: MapStyle | None,
    count: int = 1,
) -> Figure:
    snapshots, headings = headed_snapshots(runs, times, _NAME, count=count)
    note = peak_note(runs.values(), [snapshot.time for snapshot in snapshots])
    window = window_around(snapshots)
    figure, panels = _panels(len(snapshots), window, width)
    if chosen not in (None, *get_args(MapStyle)):
        raise ValueError(f"{_NAME}: style must be 'contours' or 'colours', got {chosen!r}")
    in_colours = chosen == "colours" or (chosen is None and any(map(has_many_spots, snapshots)))
    drawn = zip(panels, snapshots, strict=True)
    if in_colours:
        top = max(float(snapshot.pressure.max()) for snapshot in snapshots)
        for axes, snapshot in drawn:
            _draw_cells(axes, snapshot, top, window)
    else:
        pressed = (s.pressure[s.in_contact] for s in snapshots if s.touching)
        part = ORDINARY if note else 1.0
        levels, unit = pressure_levels(max(float(np.quantile(each, part)) for each in pressed))
        lines = [draw_contours(axes, snapshot, levels, window) for axes, snapshot in drawn]
    for axes, heading in zip(panels, headings, strict=True):
        style.add_heading(axes, heading)
    style.add_heading(panels[0], "; ".join(filter(None, (window.note, note))), aside=True)
    if len(runs) == 1:
        for axes, snapshot in zip(panels, snapshots, strict=True):
            mark_body(axes, next(iter(runs.values())), snapshot.time, window)
    if in_colours:
        _add_colour_scale(figure, panels, top)
    else:
        _add_colour_bar(figure, panels, levels, unit, "max" if note else "neither")
    figure.draw_without_rendering()  # The layout gives the room for texts.
    style.arrange_headings(figure)
    figure.draw_without_rendering()
    if in_colours:
        return figure
    for axes, snapshot, contours in zip(panels, snapshots, lines, strict=True):
        if contours is not None:
            _label_contours(axes, contours, snapshot, unit, window)
    return figure


def has_many_spots(snapshot: Snapshot) -> bool:
    """True for a contact of so many spots that lines around them would cover the pressure."""
    return bool(label(snapshot.in_contact)[1] > _MOST_SPOTS)


def _draw_cells(axes: Axes, snapshot: Snapshot, top: float, window: Window) -> None:
    """Draw the pressure of each cell in contact in a colour, from 0 to a largest one [Pa]."""
    # With what lies beyond the border of a period.
    wide = beyond_period(snapshot)
    pressure = np.ma.masked_array(wide.pressure.T, ~wide.in_contact.T)
    axes.pcolormesh(
        window.unit(wide.x),
        window.unit(wide.y),
        pressure,
        cmap=_CELL_COLOURS,
        norm=Normalize(0.0, top),
        shading="nearest",
        rasterized=True,
    )


def _add_colour_scale(figure: Figure, panels: list[Axes], top: float) -> None:
    unit = readable_unit("Pa", top)
    shown = ScalarMappable(Normalize(0.0, float(unit(top))), _CELL_COLOURS)
    bar = figure.colorbar(shown, ax=panels, shrink=0.9, aspect=25, pad=0.02)
    _dress_colour_bar(bar, unit)


def pressure_levels(highest: float) -> tuple[Floats, ReadableUnit]:
    """Round levels of pressure from 0 to beyond the highest [Pa], and their unit.

    >>> levels, unit = pressure_levels(152e6)
    >>> unit(levels).tolist()
    [0.0, 20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0, 160.0]
    """
    unit = readable_unit("Pa", highest)
    levels = MaxNLocator(nbins=10, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, highest / unit.factor)
    return np.asarray(levels) * unit.factor, unit


def _panels(count: int, window: Window, wanted: Width | None) -> tuple[Figure, list[Axes]]:
    long = window.height_to_width < 0.6
    # Two rows of high maps would not fit on a page.
    columns = 1 if long else min(count, 4 if window.height_to_width > _HIGH else 2)
    rows = -(-count // columns)
    usual = style.TWO_COLUMNS if columns >= 2 or long else style.ONE_COLUMN
    width = page_width(wanted, usual)
    panel_width = (width - 1.3) / columns
    height = rows * (panel_width * window.height_to_width + 0.22) + 0.45
    figure = style.new_figure(width, height, fixed_aspect=True)
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    panels = list(grid.flat)
    for unused in panels[count:]:
        unused.remove()
    for axes in panels[:count]:
        style.dress(axes)
        show_window(axes, window)
    for axes in grid[:, 0]:
        axes.set_ylabel(window.unit.label("y"))
    for axes in grid[-1, :]:
        axes.set_xlabel(window.unit.label("x"))
    return figure, panels[:count]


def draw_contours(
    axes: Axes, snapshot: Snapshot, levels: Floats, window: Window
) -> QuadContourSet | None:
    """Draw contours at levels [Pa], and the outline; return the lines, None without contact."""
    if not snapshot.touching:
        return None
    outline = rim_path(window.unit(polygon) for polygon in rim_curves(snapshot))
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
    axes.add_patch(PathPatch(outline, facecolor="none", edgecolor=style.INK, linewidth=1.1))
    return lines


def _label_contours(
    axes: Axes, lines: QuadContourSet, snapshot: Snapshot, unit: ReadableUnit, window: Window
) -> None:
    """Label the contours where there is room."""
    lowest, highest = np.percentile(snapshot.pressure[snapshot.in_contact], _LABELLED) ** 2
    texts = {
        square: format_compact(float(unit(math.sqrt(square))))
        for square in lines.levels
        if lowest < square < highest
    }

    def fits(corners: Floats) -> bool:
        return bool(np.all(_touched(snapshot, corners * window.unit.factor)))

    label_contours(axes, lines, texts, fits)


def _touched(snapshot: Snapshot, points: Floats) -> Bools:
    """Mask of points, shape (n, 2) [m], whose cells are in contact."""
    first = np.array([snapshot.x[0], snapshot.y[0]])
    i, j = np.rint((points - first) / snapshot.cell_size).astype(int).T
    i, j = np.clip(i, 0, snapshot.x.size - 1), np.clip(j, 0, snapshot.y.size - 1)
    return np.asarray(snapshot.in_contact[i, j])


def _add_colour_bar(
    figure: Figure, panels: list[Axes], levels: Floats, unit: ReadableUnit, extend: str
) -> None:
    shown = _level_colours(levels, unit)
    bar = figure.colorbar(shown, ax=panels, shrink=0.9, aspect=25, pad=0.02, extend=extend)
    _dress_colour_bar(bar, unit)


def fill_colour_bar(axes: Axes, levels: Floats, unit: ReadableUnit, extend: str) -> None:
    """Draw a colour bar for levels of pressure [Pa] in separate axes."""
    figure = style.figure_of(axes)
    _dress_colour_bar(figure.colorbar(_level_colours(levels, unit), cax=axes, extend=extend), unit)


def _level_colours(levels: Floats, unit: ReadableUnit) -> ScalarMappable:
    colours = style.pressure_colours(len(levels) - 1)
    return ScalarMappable(BoundaryNorm(unit(levels), colours.N), colours)


def _dress_colour_bar(bar: Colorbar, unit: ReadableUnit) -> None:
    bar.set_label(unit.label("Pressure"), size=style.LABEL_SIZE, color=style.INK)
    bar.ax.tick_params(labelsize=style.TICK_SIZE, width=style.THIN_LINE, length=2.5)
    bar.outline.set(linewidth=style.THIN_LINE, edgecolor=style.INK)
