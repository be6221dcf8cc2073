"""Deformed surface of the half-space and the indenter, in three dimensions."""

from __future__ import annotations

from typing import Any

import xarray as xr
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.deformed_surface import deformed_contacts, depth_scale
from viscontact.drawing.content.look import PRESSURE, shades
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.lit_surface import draw_relief
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.solid_axes import (
    add_note,
    add_side_bar,
    add_title,
    solid_panels,
    stretch_of_heights,
)
from viscontact.units.formatting import ReadableUnit, format_compact

_NAME = "surface-3d"
#: Space above the surface for the indenter, relative [-], and part of the colours.
_ABOVE, _COLOURS = 0.3, (0.05, 0.8)


def deformed_surface(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the deformed surface of the half-space and the indenter, one panel per instant.

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
        Panels with common axes. Colour and depth are the displacement of the surface; the dark
        line on it is the edge of the contact, the orange ones are the lower side of the indenter on
        its two middle lines, where it is. The stretch of heights and of y is given below.

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
    >>> figure = deformed_surface(ds)
    >>> figure.axes[0].get_xlabel(), figure.axes[1].get_ylabel()
    ('x [mm]', 'Displacement [µm]')
    """
    maps, contacts = deformed_contacts(results, times, _NAME)
    unit, (low, high) = depth_scale(contacts)
    x, y = maps.axes()
    figure, panels = solid_panels(
        *(len(contacts), maps.window, (high, low - _ABOVE * (high - low)), (x.label, y.label)),
        page_width(width, style.TWO_COLUMNS if len(contacts) > 1 else style.ONE_COLUMN),
    )
    shown = ScalarMappable(Normalize(low, high), ListedColormap(shades(PRESSURE, 256, *_COLOURS)))
    for axes, contact in zip(panels, contacts, strict=True):
        draw_relief(axes, contact.relief(unit), shown)
        for curve in contact.rim():
            _draw(axes, curve, maps.window.unit, unit, color=style.INK, linewidth=0.9, zorder=3)
        for line in contact.middle_lines(unit.factor * axes.get_zlim()[1]):
            how = {"color": style.BODY, "linewidth": style.LINE_WIDTH, "zorder": 4}
            _draw(axes, line, maps.window.unit, unit, **how)
        add_title(axes, contact.map.heading)
    add_side_bar(figure, shown, unit.label("Displacement"), downwards=True)
    heights = f"heights {format_compact(stretch_of_heights(panels[0], maps.window, unit), 2)}×"
    stretches = "; ".join(filter(None, (heights, maps.window.note)))
    add_note(figure, "black: contact edge; orange: lower side of the indenter", stretches)
    return figure


def _draw(
    axes: Axes3D, points: Floats, length: ReadableUnit, depth: ReadableUnit, **look: Any
) -> None:
    """Draw a line through points x, y, depth [m]."""
    x, y, z = points.T
    axes.plot(length(x), length(y), depth(z), **look)
