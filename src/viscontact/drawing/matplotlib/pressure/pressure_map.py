"""Iso-contours of pressure over the contact (the paper's Figs. 8, 11 and 14)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, get_args

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.transforms import Bbox
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats
from viscontact.drawing.content.compared_runs import Runs
from viscontact.drawing.content.map import Map, Maps, maps_at
from viscontact.drawing.content.rim import beyond_period
from viscontact.drawing.content.scale import ColourScale
from viscontact.drawing.content.squared_pressure import squared_pressure
from viscontact.drawing.content.window import Window
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.contour_labels import label_contours
from viscontact.drawing.matplotlib.layout.map_axes import map_panels, mark_body, rim_path
from viscontact.drawing.matplotlib.layout.page import Width
from viscontact.results.snapshots import Snapshot
from viscontact.units.formatting import format_compact

_NAME = "pressure-map"
#: Appearance of the pressure: labelled iso-contours, or a colour for each cell.
MapStyle = Literal["contours", "colours"]
#: Colours of one scale in all panels, or of one for each.
MapScale = Literal["all", "each"]
#: Percentiles of pressure over the contact between which contours have room for labels.
_LABELLED = (20.0, 97.0)
#: Number of colours of cells.
_COLOURS = 256


def pressure_map(
    results: Runs,
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
    style: MapStyle | None = None,
    scale: MapScale = "all",
) -> Figure:
    """Draw the pressure, one panel per instant, with the outline of the contact.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored; several by
        the names to print.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default four, from the
        first in contact to the last; of several results the last of each.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].
    style : {"contours", "colours"}, optional
        Labelled iso-contours, or the mean pressure of each cell in colours up to the largest. By
        default colours for a contact of more than a dozen spots, contours otherwise.
    scale : {"all", "each"}, optional
        Colours of one scale in all panels, or of one for each, which shows small pressures beside
        large ones.

    Returns
    -------
    matplotlib.figure.Figure
        Panels with common axes, and common pressure levels unless each has its own. A long narrow
        contact is drawn with its width stretched by the factor printed in the first panel. A note
        there states where the peak pressure depends on the mesh. A cross is the axis of a moving
        body, an arrow the direction of its motion.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch at these instants, or there is no result.

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
    if style not in (None, *get_args(MapStyle)):
        raise ValueError(f"{_NAME}: style must be 'contours' or 'colours', got {style!r}")
    if scale not in get_args(MapScale):
        raise ValueError(f"{_NAME}: scale must be 'all' or 'each', got {scale!r}")
    maps = maps_at(results, times, _NAME, count=4)
    scales = (maps.scale(),) if scale == "all" else maps.own_scales()
    in_colours = maps.many_spots if style is None else style == "colours"
    return _draw(maps, width, scales, in_colours=in_colours)


def compare_pressure_maps(
    runs: Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
    style: MapStyle | None = None,
    scale: MapScale = "all",
) -> Figure:
    """Draw the pressure maps of several runs in one figure: `pressure_map` of a mapping."""
    return pressure_map(runs, times=times, width=width, style=style, scale=scale)


def _draw(
    maps: Maps, width: Width | None, scales: tuple[ColourScale, ...], *, in_colours: bool
) -> Figure:
    """Draw the maps in one scale, or in one each."""
    figure, panels = map_panels(maps, width)
    draw = _draw_cells if in_colours else draw_contours
    own = scales if len(scales) > 1 else scales * len(panels)
    lines = [
        draw(axes, each, maps.window, scale)
        for axes, each, scale in zip(panels, maps.maps, own, strict=True)
    ]
    for axes, each in zip(panels, maps.maps, strict=True):
        style.add_heading(axes, each.heading)
        mark_body(axes, each.body, maps.window)
    note = maps.note if in_colours else "; ".join(filter(None, (maps.note, maps.zone_note)))
    style.add_heading(panels[0], note, aside=True)
    places: Sequence[Axes | Sequence[Axes]] = panels if len(scales) > 1 else [panels]
    for beside, scale in zip(places, scales, strict=True):
        colours = _cell_colours(scale) if in_colours else _level_colours(scale)
        extend = "max" if scale.is_open and not in_colours else "neither"
        bar = figure.colorbar(colours, ax=beside, shrink=0.9, aspect=25, pad=0.02, extend=extend)
        style.dress_colour_bar(bar, scale.label)
    figure.draw_without_rendering()  # The layout gives the room for texts.
    style.arrange_headings(figure)
    figure.draw_without_rendering()
    for axes, each, contours, scale in zip(panels, maps.maps, lines, own, strict=True):
        if contours is not None:
            _label_contours(axes, contours, each.snapshot, maps.window, scale)
    return figure


def _draw_cells(axes: Axes, shown: Map, window: Window, scale: ColourScale) -> None:
    """Draw each cell in the colour of its pressure, and those beyond the border of a period."""
    wide, colours = beyond_period(shown.snapshot), _cell_colours(scale).cmap
    axes.pcolormesh(
        window.unit(wide.x),
        window.unit(wide.y),
        np.ma.masked_where(~(wide.in_contact | wide.in_zone).T, scale.unit(wide.pressure.T)),
        cmap=colours,
        norm=Normalize(*scale.unit(scale.limits)),
        shading="nearest",
        rasterized=True,
    )


def draw_contours(
    axes: Axes, shown: Map, window: Window, scale: ColourScale
) -> QuadContourSet | None:
    """Draw contours and the outline; return the lines, None without contact."""
    if not shown.snapshot.touching:
        return None
    outline = rim_path(window.unit(curve) for curve in shown.outline)
    # It replaces the border of the axes, beyond which a period goes on.
    (x_low, x_high), (y_low, y_high) = (window.unit(ends).tolist() for ends in (window.x, window.y))
    outline = outline.clip_to_bbox(Bbox.from_extents(x_low, y_low, x_high, y_high))
    # Contours are drawn between the centres of cells, so half a cell short of the last ones.
    wide = beyond_period(shown.snapshot).with_border(1)
    if wide.in_zone.any():
        # Without the contact, in which the pressure rises within a cell.
        pulls = np.where(wide.in_contact, float(wide.pressure.min()), wide.pressure)
        _fill_levels(axes, wide, window, scale, pulls, _zone_end(axes, wide, window, pulls))
    values = wide.pressure if scale.diverges else squared_pressure(wide)
    lines = _fill_levels(axes, wide, window, scale, values, outline)
    axes.add_patch(PathPatch(outline, facecolor="none", edgecolor=style.INK, linewidth=1.1))
    return lines


def _fill_levels(
    axes: Axes, wide: Snapshot, window: Window, scale: ColourScale, values: Floats, edge: Path
) -> QuadContourSet:
    """Fill between levels, within an edge; return the lines at the levels."""
    at = window.unit(wide.x), window.unit(wide.y), values.T
    colours, heights = _level_colours(scale), _heights(scale)
    norm = BoundaryNorm(heights, colours.cmap.N)
    fill = axes.contourf(*at, levels=heights, cmap=colours.cmap, norm=norm, extend="both")
    lines = axes.contour(
        *at, levels=heights[1:-1], colors=style.INK, linewidths=0.5, linestyles="solid"
    )
    for contours in (fill, lines):
        contours.set_clip_path(edge, axes.transData)
    return lines


def _zone_end(axes: Axes, wide: Snapshot, window: Window, pulls: Floats) -> Path:
    """Draw the line at which the cohesive zone ends."""
    at = window.unit(wide.x), window.unit(wide.y), pulls.T
    level = [-wide.least_pull]
    ends = axes.contour(*at, levels=level, colors=style.INK, linewidths=0.8, linestyles="dashed")
    return ends.get_paths()[0]


def _heights(scale: ColourScale) -> Floats:
    """Levels of what is contoured: the square of a pressure without tension."""
    # Contours of the square are the same lines, and smooth up to the rim.
    return scale.levels if scale.diverges else scale.levels**2


def _label_contours(
    axes: Axes, lines: QuadContourSet, snapshot: Snapshot, window: Window, scale: ColourScale
) -> None:
    """Label the contours where there is room."""
    pressed = snapshot.pressure[snapshot.in_contact]
    lowest, highest = np.percentile(pressed, _LABELLED)
    texts = {
        height: format_compact(float(scale.unit(level)))
        for height, level in zip(_heights(scale)[1:-1], scale.levels[1:-1], strict=True)
        if lowest < level < highest
    }

    def fits(corners: Floats) -> bool:
        return bool(np.all(_is_in_contact(snapshot, corners * window.unit.factor)))

    label_contours(axes, lines, texts, fits)


def _is_in_contact(snapshot: Snapshot, points: Floats) -> Bools:
    """Mask of points, shape (n, 2) [m], whose cells are in contact."""
    first = np.array([snapshot.x[0], snapshot.y[0]])
    i, j = np.rint((points - first) / snapshot.cell_size).astype(int).T
    i, j = np.clip(i, 0, snapshot.x.size - 1), np.clip(j, 0, snapshot.y.size - 1)
    return np.asarray(snapshot.in_contact[i, j])


def fill_colour_bar(axes: Axes, scale: ColourScale) -> None:
    """Draw a colour bar for the levels of a scale in separate axes."""
    extend = "max" if scale.is_open else "neither"
    bar = style.figure_of(axes).colorbar(_level_colours(scale), cax=axes, extend=extend)
    style.dress_colour_bar(bar, scale.label)


def _level_colours(scale: ColourScale) -> ScalarMappable:
    """Colours of the areas between levels."""
    colours = ListedColormap(scale.colours(len(scale.levels) - 1))
    return ScalarMappable(BoundaryNorm(scale.unit(scale.levels), colours.N), colours)


def _cell_colours(scale: ColourScale) -> ScalarMappable:
    """Colours of cells."""
    colours = ListedColormap(scale.colours(_COLOURS))
    return ScalarMappable(Normalize(*scale.unit(scale.limits)), colours)
