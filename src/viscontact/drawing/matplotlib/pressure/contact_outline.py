"""Outlines of the contact as it grows (the paper's Figs. 9, 12 and 15)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import Runs
from viscontact.drawing.content.map import Maps, maps_at
from viscontact.drawing.content.window import Window
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.map_axes import rim_path, show_window
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.style import styles_of
from viscontact.results.snapshots import headings_of, labels_of

_NAME = "contact-outline"


def contact_outline(
    results: Runs,
    *,
    times: ArrayLike | None = None,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the outline of the contact at several instants.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored; several by
        the names to print.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default five, from the
        first in contact to the last. One for several results, by default the last of each.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Outlines found between the cells, from the way the gap opens outside the contact. Those
        of a periodic contact end at the border of the period; full contact has none. Of several
        results, the instant stands above, or with each where they differ.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch at these instants, there is no result, or
        several instants are given for several results.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> axes = contact_outline(ds).axes[0]
    >>> len(axes.patches), axes.get_xlabel()
    (2, 'x [µm]')
    """
    maps = maps_at(results, times, _NAME, count=5)
    several = [] if isinstance(results, xr.Dataset) else list(results)
    if several and len(maps.maps) > len(several):
        raise ValueError(f"{_NAME}: runs are compared at one instant, got {times!r} s")
    looks = styles_of(several) if several else _styles(len(maps.maps))
    axes = _new_axes(maps.window, len(looks), width, below=bool(several)) if axes is None else axes
    for each, look in zip(maps.maps, looks, strict=True):
        path = rim_path(maps.window.unit(curve) for curve in each.outline)
        how = {"edgecolor" if key == "color" else key: value for key, value in look.items()}
        axes.add_patch(PathPatch(path, fill=False, **how))
    x, y = maps.axes()
    axes.set(xlabel=x.label, ylabel=y.label)
    style.dress(axes)
    show_window(axes, maps.window)
    style.add_heading(axes, maps.window.note, aside=True)
    lines = [Line2D([], [], **look) for look in looks]
    if several:
        heading, labels = _names_of_runs(several, maps)
        style.add_heading(axes, heading)
        style.add_legend_below(style.figure_of(axes), lines, labels, columns=4)
    else:
        style.add_legend(axes, lines, _instants(maps))
    return style.figure_of(axes)


def compare_contact_outlines(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Overlay the outlines of the contacts of several runs: `contact_outline` of a mapping."""
    return contact_outline(runs, times=times, width=width)


def _styles(count: int) -> list[dict[str, Any]]:
    """Looks of the outlines of one run at some instants."""
    colours = style.time_colours(count)
    return [{"color": colour, "linewidth": style.LINE_WIDTH} for colour in colours]


def _instants(maps: Maps) -> list[str]:
    """Labels of the instants of one run."""
    labels = labels_of(maps.snapshots)
    whole = [bool(snapshot.in_contact.all()) for snapshot in maps.snapshots]
    return [f"{a}, full contact" if full else a for a, full in zip(labels, whole, strict=True)]


def _names_of_runs(names: list[str], maps: Maps) -> tuple[str, list[str]]:
    """Common instant of runs, and their names, or instants with the names if they differ."""
    instants = {heading for each in maps.snapshots for heading in headings_of([each])}
    if len(instants) == 1:
        return instants.pop(), names
    return "", [each.heading for each in maps.maps]


def _new_axes(window: Window, count: int, wanted: Width | None, *, below: bool = False) -> Axes:
    """Axes of the window's shape, with room for a legend."""
    usual = style.TWO_COLUMNS if window.height_to_width < 0.6 else style.ONE_COLUMN
    width = page_width(wanted, usual)
    if below:
        height = (width - 0.8) * window.height_to_width + 0.75 + 0.2 * min(count, 3)
    else:  # as high as the legend at least
        height = max((width - 1.6) * window.height_to_width + 0.6, 0.2 * count + 0.3)
    return style.new_figure(width, height, fixed_aspect=True).add_subplot()
