"""Contact area over time: traced between the cells, and by counting cells."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.along_run import along_run, within_span
from viscontact.plot.layout import style
from viscontact.plot.layout.error_band import band_key, draw_band, limit_axis_to_curves
from viscontact.plot.layout.page import Width, page_width
from viscontact.plot.layout.panels import scale_along
from viscontact.results.snapshots import Snapshot, field_times, snapshot_reader
from viscontact.results.stated_errors import stated_error
from viscontact.units.formatting import readable_unit

_NAME = "contact-area"
_COUNTED = "#D55E00"
#: Largest number of separate dots.
_APART = 60


def contact_area(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the contact area over time, compared with counted cells in contact.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s]; by
        default all of it.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A line for the area found between the cells, which grows smoothly, with its error; dots
        at the stored instants for the number of cells in contact times a cell's area, which
        grows in jumps.

    Raises
    ------
    ValueError
        If no fields are stored, or fewer than two steps lie in the span.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> contact_area(ds).axes[0].get_ylabel()
    'Contact area [mm²]'
    """
    stored, read = field_times(results, _NAME), snapshot_reader(results)
    run = within_span(results, ("contact_area", "force", "approach"), times, _NAME, "")
    first, last = run["time"].values[[0, -1]]
    shown = np.flatnonzero((stored >= first) & (stored <= last))
    counted = [_counted(read(int(index))) for index in shown]
    shares_axes = axes is not None
    if axes is None:
        wide = page_width(width, style.ONE_COLUMN)
        axes = style.new_figure(wide, min(3.4, 0.85 * wide)).add_subplot()
    style.dress(axes)
    area = run["contact_area"].values
    unit, time = readable_unit("m2", area, counted), along_run([run])
    instants, error = time.unit(run["time"].values), stated_error(run, "contact_area")
    look: dict[str, Any] = {"color": style.LINE, "linewidth": style.LINE_WIDTH}
    # Above the dots, of which there may be many.
    smooth = axes.plot(instants, unit(area), zorder=3, **look)[0]
    dots = axes.plot(time.unit(stored[shown]), unit(counted), "o", color=_COUNTED)[0]
    dots.set_clip_on(False)  # the first and last dot are on the frame
    dots.set(markersize=3.5 if len(counted) <= _APART else 2.0)
    bar = None if error is None else unit(error)
    band = draw_band(axes, instants, unit(area), bar, style.LINE)
    handles: list[Artist] = [smooth, dots]
    labels = ["between the cells", "cells counted"]
    if band is not None:
        limit_axis_to_curves(axes, unit(area), unit(counted))
    axes.set_ylabel(unit.label("Contact area"))
    scale_along(axes, time)
    for handle, words in band_key([band] if band else [], style.LINE):
        handles, labels = [*handles, handle], [*labels, words]
    if shares_axes:
        style.add_legend(axes, handles, labels, loc="best")
    else:
        figure = style.figure_of(axes)
        style.add_legend_below(figure, handles, labels, columns=2)
    return style.figure_of(axes)


def _counted(snapshot: Snapshot) -> float:
    """Area of the cells in contact [m²]."""
    dx, dy = snapshot.cell_size
    return int(snapshot.in_contact.sum()) * dx * dy
