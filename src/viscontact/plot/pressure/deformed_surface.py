"""Deformed surface of the half-space and the indenter, in three dimensions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import ArrayLike
from scipy.interpolate import RegularGridInterpolator
from scipy.ndimage import distance_transform_edt

from viscontact.backend.arrays import Floats, Integers
from viscontact.drawing.content.compared_runs import headed_snapshots
from viscontact.drawing.content.relief import Relief, relief
from viscontact.drawing.content.rim import rim_curves
from viscontact.drawing.content.window import Window, window_around
from viscontact.plot.layout import style
from viscontact.plot.layout.lit_surface import draw_relief
from viscontact.plot.layout.page import Width, page_width
from viscontact.plot.layout.solid_axes import (
    add_note,
    add_side_bar,
    add_title,
    solid_panels,
    stretch_of_heights,
)
from viscontact.results.snapshots import Snapshot, field_at
from viscontact.units.formatting import ReadableUnit, format_compact, readable_unit

_NAME = "surface-3d"

#: Margin around the contact, and space above the surface for the indenter, relative [-].
_BESIDE, _ABOVE = 0.35, 0.3
#: Aspect ratio above which a contact is stretched, as for the pressure.
_SLENDER = 2.2
#: Points drawn along each axis at most.
_MOST = 130
_COLOURS = ListedColormap(colormaps["YlGnBu"](np.linspace(0.05, 0.8, 256)))
_BODY = "#D55E00"


@dataclass(frozen=True, eq=False)
class DeformedContact:
    """Surfaces of both bodies: gap, and displacement into the half-space [m], NaN if unknown."""

    snapshot: Snapshot
    displacement: Floats

    @property
    def indenter(self) -> Floats:
        """Depth of the indenter's lower side [m], shape (nx, ny), NaN where there is none."""
        depth = self.displacement - self.snapshot.gap
        return np.where(np.isfinite(depth), depth, np.nan)


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
    snapshots, headings = headed_snapshots({"": results}, times, _NAME, count=2)
    contacts = [
        DeformedContact(each, field_at(results, "displacement", each.time, _NAME))
        for each in snapshots
    ]
    window = _window(snapshots)
    unit, (low, high) = _depths(contacts, window)
    norm = Normalize(low, high)
    figure, panels = solid_panels(
        len(contacts),
        window,
        (high, low - _ABOVE * (high - low)),
        (window.unit.label("x"), window.unit.label("y")),
        page_width(width, style.TWO_COLUMNS if len(contacts) > 1 else style.ONE_COLUMN),
    )
    for axes, contact, heading in zip(panels, contacts, headings, strict=True):
        draw_relief(axes, displacement_relief(contact, window, unit), _COLOURS, norm)
        _draw_rim(axes, contact, window, unit)
        _draw_indenter(axes, contact, window, unit)
        add_title(axes, heading)
    add_side_bar(figure, _COLOURS, norm, unit.label("Displacement"), downwards=True)
    heights = f"heights {format_compact(stretch_of_heights(panels[0], window, unit), 2)}×"
    stretches = "; ".join(filter(None, (heights, window.note)))
    add_note(figure, "black: contact edge; orange: lower side of the indenter", stretches)
    return figure


def displacement_relief(contact: DeformedContact, window: Window, unit: ReadableUnit) -> Relief:
    """Relief of the displacement, with a limited number of points."""
    (x, i), (y, j) = (
        _points(at, limits)
        for at, limits in ((contact.snapshot.x, window.x), (contact.snapshot.y, window.y))
    )
    depth = unit(contact.displacement[np.ix_(i, j)])
    mesh = np.meshgrid(window.unit(x), window.unit(y), indexing="ij")
    return relief(*mesh, depth, depth, np.isfinite(depth))


def _points(at: Floats, limits: tuple[float, float]) -> tuple[Floats, Integers]:
    inside = np.flatnonzero((at >= limits[0]) & (at <= limits[1]))
    chosen = inside[:: -(-inside.size // _MOST)]
    return at[chosen], chosen


def _window(snapshots: list[Snapshot]) -> Window:
    """Window of the contact and the surface around it."""
    near = window_around(snapshots, slender=_SLENDER)
    x_low, x_high, y_low, y_high = snapshots[0].borders()
    limits = []
    for (low, high), start, end in ((near.x, x_low, x_high), (near.y, y_low, y_high)):
        margin = _BESIDE * (high - low)
        limits.append((max(low - margin, start), min(high + margin, end)))
    return Window(limits[0], limits[1], near.stretch)


def _depths(
    contacts: list[DeformedContact], window: Window
) -> tuple[ReadableUnit, tuple[float, float]]:
    """Unit of the displacement, and its limits in that unit."""
    shown = [
        displacement_relief(contact, window, ReadableUnit("m", 1.0)).values for contact in contacts
    ]
    low, high = min(map(np.min, shown)), max(map(np.max, shown))
    if high == low:
        high = low + 1e-3 * (window.x[1] - window.x[0])
    unit = readable_unit("m", low, high)
    return unit, (float(unit(low)), float(unit(high)))


def _draw_rim(axes: Axes3D, contact: DeformedContact, window: Window, unit: ReadableUnit) -> None:
    cells = (contact.snapshot.x, contact.snapshot.y)
    # On the rim the bodies touch: the indenter is smooth there, the surface falls next to a punch.
    depth = RegularGridInterpolator(cells, _continued(contact.indenter), bounds_error=False)
    for polygon in rim_curves(contact.snapshot):
        x, y = window.unit(polygon).T
        axes.plot(x, y, unit(depth(polygon)), color=style.INK, linewidth=0.9, zorder=3)


def _continued(depth: Floats) -> Floats:
    """Values continued beyond a body's end by those of its nearest cell."""
    nearest = distance_transform_edt(np.isnan(depth), return_distances=False, return_indices=True)
    return np.asarray(depth[tuple(nearest)])


def _draw_indenter(
    axes: Axes3D, contact: DeformedContact, window: Window, unit: ReadableUnit
) -> None:
    """Draw the lower side of the indenter on its middle lines, below the top of the axes."""
    _, top = axes.get_zlim()
    snapshot, depth = contact.snapshot, unit(contact.indenter)
    depth = np.where(depth >= top, depth, np.nan)
    i, j = (int(np.abs(2 * at - at[0] - at[-1]).argmin()) for at in (snapshot.x, snapshot.y))
    (x, chosen_x), (y, chosen_y) = _points(snapshot.x, window.x), _points(snapshot.y, window.y)
    look = {"color": _BODY, "linewidth": style.LINE_WIDTH, "zorder": 4}
    axes.plot(
        window.unit(x), np.full(x.size, window.unit(snapshot.y[j])), depth[chosen_x, j], **look
    )
    axes.plot(
        np.full(y.size, window.unit(snapshot.x[i])), window.unit(y), depth[i, chosen_y], **look
    )
