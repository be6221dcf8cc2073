"""Pressure as a surface in three dimensions."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import headed_snapshots
from viscontact.drawing.content.notes import peak_note
from viscontact.drawing.content.pressure_relief import pressure_relief
from viscontact.drawing.content.rim import rim_polygons
from viscontact.drawing.content.window import Window, window_around
from viscontact.plot.layout import style
from viscontact.plot.layout.lit_surface import draw_relief
from viscontact.plot.layout.page import Width, page_width
from viscontact.plot.layout.solid_axes import add_note, add_side_bar, add_title, solid_panels
from viscontact.results.snapshots import Snapshot
from viscontact.units.formatting import readable_unit

_NAME = "pressure-3d"
#: A contact longer than this against its width is stretched: a blade shows nothing in space.
_SLENDER = 2.2
_COLOURS = ListedColormap(colormaps["YlGnBu"](np.linspace(0.12, 0.95, 256)))


def pressure_surface(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the pressure as a lit surface over the contact, one panel per instant.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default the first in
        contact and the last.
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
        If no fields are stored or the bodies do not touch at these instants.

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
    return _draw({"": results}, times, width, count=2)


def compare_pressure_surfaces(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the pressures of several runs as surfaces side by side.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print, with fields stored.
    times : array_like, optional
        Instants [s]; of each run the nearest stored ones are drawn. By default the last of each.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Panels with common axes, those of a run one after the other.

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
    >>> len(compare_pressure_surfaces(runs).axes)  # a panel for each, and the scale of both
    3
    """
    return _draw(runs, times, width)


def _draw(
    runs: Mapping[str, xr.Dataset], times: ArrayLike | None, width: Width | None, count: int = 1
) -> Figure:
    snapshots, headings = headed_snapshots(runs, times, _NAME, count=count)
    note = peak_note(runs.values(), [snapshot.time for snapshot in snapshots])
    window = window_around(snapshots, slender=_SLENDER)
    peak = max(float(snapshot.pressure.max()) for snapshot in snapshots)
    unit = readable_unit("Pa", peak)
    top = float(unit(peak))
    norm = Normalize(0.0, top)
    usual = style.TWO_COLUMNS if len(snapshots) > 1 else style.ONE_COLUMN
    figure, panels = solid_panels(
        len(snapshots),
        window,
        (0.0, 1.02 * top),
        (window.unit.label("x"), window.unit.label("y")),
        page_width(width, usual),
    )
    for axes, snapshot, heading in zip(panels, snapshots, headings, strict=True):
        if snapshot.touching:
            _draw_foot(axes, snapshot, window)
            draw_relief(axes, pressure_relief(snapshot, window, unit), _COLOURS, norm)
        add_title(axes, heading)
    add_side_bar(figure, _COLOURS, norm, unit.label("Pressure"))
    add_note(figure, window.note, note)
    return figure


def _draw_foot(axes: Axes3D, snapshot: Snapshot, window: Window) -> None:
    x_low, x_high, y_low, y_high = snapshot.borders()
    for polygon in rim_polygons(snapshot):
        # A rim that crosses the border of a period is known beyond it.
        within = (polygon >= (x_low, y_low)) & (polygon <= (x_high, y_high))
        x, y = window.unit(np.where(within.all(axis=1, keepdims=True), polygon, np.nan)).T
        axes.plot(x, y, 0 * x, color=style.INK, linewidth=0.7, zorder=0)
