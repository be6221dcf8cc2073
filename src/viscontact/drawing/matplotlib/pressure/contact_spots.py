"""Sizes of the contact spots of a rough contact."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike

from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.results.contact_spots import spots_of
from viscontact.results.snapshots import labels_of, take_snapshots
from viscontact.units.formatting import format_number, readable_unit

_NAME = "contact-spots"


def contact_spots(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw how many contact spots are as large as an area or larger.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instants [s], or speeds [m/s]; the nearest stored ones are drawn and named. By default
        five, from the first in contact to the last.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Number of spots over their area, by counting cells; the legend states the number of all
        spots and the real over the nominal area, as `viscontact.contact_spots` defines them.

    Raises
    ------
    ValueError
        If no fields are stored, or the bodies do not touch at these instants.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> contact_spots(ds).axes[0].get_ylabel()
    'Spots of this area or larger [-]'
    """
    snapshots = [each for each in take_snapshots(results, times, _NAME) if each.touching]
    found = [spots_of(results, each) for each in snapshots]
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), 3.4)
    axes = figure.subplots()
    unit = readable_unit("m²", max(each.areas[0] for each in found))
    for each, colour in zip(found, style.time_colours(len(found)), strict=True):
        counts = np.arange(1, each.number + 1)
        dot = {"marker": "o", "markersize": 3.2, "color": colour}
        axes.loglog(unit(each.areas), counts, linewidth=style.LINE_WIDTH, **dot)
    if max(each.number for each in found) < 10:
        axes.set_yscale("linear")
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
        axes.set_ylim(0, None)
    axes.set_xlabel(unit.label("Area of a spot"))
    axes.set_ylabel("Spots of this area or larger [-]")
    of = "period" if found[0].is_period else "convex hull"
    labels = [
        f"{label}: {each.number}, {format_number(100 * each.fraction, 3)} %"
        for label, each in zip(labels_of(snapshots), found, strict=True)
    ]
    style.add_heading(axes, f"number of spots, contact in % of the {of}")
    style.add_legend_below(figure, axes.get_lines(), labels)
    style.dress(axes)
    return figure
