"""Map of the cells that stick and slip, with arrows of the tractions."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import ArrayLike

from viscontact.drawing.content.slip_map import SlipMap, SlipMaps, slip_maps
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.map_axes import map_panels
from viscontact.drawing.matplotlib.layout.page import Width

#: Colours of cells that stick and slip: dark and light to every reader.
_COLOURS = {"sticks": "#9ec4e8", "slips": "#fbd9a5"}
#: Length of the longest arrow over the distance of two.
_LONGEST = 1.4


def stick_map(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the cells that stick and slip, a panel per instant or creepage, with their tractions.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate`, `viscontact.steady` or `viscontact.open_results`, with friction
        and fields stored.
    times : array_like, optional
        Instants [s], or in steady motion speeds [m/s]; the nearest stored ones are drawn and named.
        By default four instants of the last cycle of the tangential load, or of the time under it,
        or the largest speed. Of one speed up to four creepages are drawn, of several speeds that of
        the largest traction; ``results.sel(creepage=...)`` chooses one.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Panels with common axes. Arrows are the tractions of the body on the half-space, in true
        direction; the note above the first panel states the longest.

    Raises
    ------
    ValueError
        If the run has no friction or stores no fields, or the bodies do not touch.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid, pull = vc.Grid((24, 24), (2e-3, 2e-3)), vc.TangentialHistory([1.0], force_x=0.02)
    >>> grip = {"friction": 0.3, "tangential": pull, "errors": False}
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], **grip)
    >>> stick_map(ds).axes[0].get_xlabel()
    'x [µm]'
    """
    shown = slip_maps(results, times, "stick-map")
    figure, panels = map_panels(shown.maps, width)
    for axes, each, slip in zip(panels, shown.maps.maps, shown.slips, strict=True):
        style.add_heading(axes, each.heading)
        _draw(axes, shown, slip)
    style.add_heading(panels[0], shown.note, aside=True)
    keys = [Patch(facecolor=colour, label=name) for name, colour in _COLOURS.items()]
    style.add_legend_below(figure, keys, list(_COLOURS))
    figure.draw_without_rendering()  # The layout gives the room for texts.
    style.arrange_headings(figure)
    return figure


def _draw(axes: Axes, shown: SlipMaps, slip: SlipMap) -> None:
    snapshot, unit = shown.maps.snapshots[0], shown.maps.window.unit
    axes.pcolormesh(
        unit(snapshot.x),
        unit(snapshot.y),
        np.ma.masked_equal(slip.state.T, 0),
        cmap=ListedColormap(list(_COLOURS.values())),
        vmin=1,
        vmax=2,
        shading="nearest",
        rasterized=True,
    )
    if not slip.places.size:
        return
    axes.quiver(
        *unit(slip.places).T,
        *slip.tractions.T,
        scale=shown.longest * shown.across / _LONGEST,
        scale_units="width",
        angles="uv",
        pivot="mid",
        color=style.INK,
        width=0.004,
    )
