"""Pressure as a surface in three dimensions."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import Runs
from viscontact.drawing.content.map import maps_at
from viscontact.drawing.content.pressure_relief import pressure_relief
from viscontact.drawing.content.rim import rim_polygons
from viscontact.drawing.content.window import Window
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.lit_surface import draw_relief
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.solid_axes import (
    add_note,
    add_side_bar,
    add_title,
    solid_panels,
)
from viscontact.results.snapshots import Snapshot

_NAME = "pressure-3d"
#: A contact longer than this against its width is stretched: a blade shows nothing in space.
_SLENDER = 2.2


def pressure_surface(
    results: Runs, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the pressure as a lit surface over the contact, one panel per instant.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored; several by
        the names to print.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default the first in
        contact and the last; of several results the last of each.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Panels with common axes; height and colour are the pressure in the cells. The foot of
        the surface runs along the rim of the contact. A long narrow contact is drawn with its
        width stretched by the factor printed. Of grids with more than 180 cells across the
        contact, blocks of cells are drawn by their largest pressure.

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
    >>> figure = pressure_surface(ds)
    >>> figure.axes[1].get_ylabel()
    'Pressure [kPa]'
    """
    maps = maps_at(results, times, _NAME, count=2).stretched(_SLENDER)
    scale, (x, y) = maps.scale(), maps.axes()
    low, high = scale.unit(scale.limits).tolist()
    usual = style.TWO_COLUMNS if len(maps.maps) > 1 else style.ONE_COLUMN
    figure, panels = solid_panels(
        *(len(maps.maps), maps.window, (1.02 * low, 1.02 * high), (x.label, y.label)),
        page_width(width, usual),
    )
    shown = ScalarMappable(Normalize(low, high), ListedColormap(scale.colours(256)))
    for axes, each in zip(panels, maps.maps, strict=True):
        if each.snapshot.touching:
            _draw_foot(axes, each.snapshot, maps.window)
            draw_relief(axes, pressure_relief(each.snapshot, maps.window, scale.unit), shown)
        add_title(axes, each.heading)
    add_side_bar(figure, shown, scale.label)
    add_note(figure, maps.window.note, maps.peak_note)
    return figure


def compare_pressure_surfaces(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the pressures of several runs side by side: `pressure_surface` of a mapping."""
    return pressure_surface(runs, times=times, width=width)


def _draw_foot(axes: Axes3D, snapshot: Snapshot, window: Window) -> None:
    x_low, x_high, y_low, y_high = snapshot.borders()
    for polygon in rim_polygons(snapshot):
        # A rim that crosses the border of a period is known beyond it.
        within = (polygon >= (x_low, y_low)) & (polygon <= (x_high, y_high))
        x, y = window.unit(np.where(within.all(axis=1, keepdims=True), polygon, np.nan)).T
        axes.plot(x, y, 0 * x, color=style.INK, linewidth=0.7, zorder=0)
