"""Outlines of the contact as it grows (the paper's Figs. 9, 12 and 15)."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import headed_snapshots
from viscontact.drawing.content.rim import rim_curves
from viscontact.drawing.content.window import Window, window_around
from viscontact.plot.layout import style
from viscontact.plot.layout.map_axes import rim_path, show_window
from viscontact.plot.layout.page import Width, page_width
from viscontact.plot.layout.style import styles_of
from viscontact.results.snapshots import headings_of, labels_of, take_snapshots

_NAME = "contact-outline"


def contact_outline(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the outline of the contact at several instants.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default five, from the
        first in contact to the last.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Outlines found between the cells, from the way the gap opens outside the contact. Those
        of a periodic contact end at the border of the period; full contact has none.

    Raises
    ------
    ValueError
        If no fields are stored or the bodies do not touch at these instants.

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
    snapshots = take_snapshots(results, times, _NAME)
    window = window_around(snapshots)
    axes = _new_axes(window, len(snapshots), width) if axes is None else axes
    colours = style.time_colours(len(snapshots))
    for snapshot, colour in zip(snapshots, colours, strict=True):
        if snapshot.touching:
            path = rim_path(window.unit(polygon) for polygon in rim_curves(snapshot))
            axes.add_patch(
                PathPatch(path, fill=False, edgecolor=colour, linewidth=style.LINE_WIDTH)
            )
    axes.set(xlabel=window.unit.label("x"), ylabel=window.unit.label("y"))
    style.dress(axes)
    show_window(axes, window)
    style.add_heading(axes, window.note, aside=True)
    lines = [Line2D([], [], color=colour, linewidth=style.LINE_WIDTH) for colour in colours]
    labels = labels_of(snapshots)
    whole = [bool(snapshot.in_contact.all()) for snapshot in snapshots]
    style.add_legend(
        axes,
        lines,
        [f"{a}, full contact" if full else a for a, full in zip(labels, whole, strict=True)],
    )
    return style.figure_of(axes)


def compare_contact_outlines(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Overlay the outlines of the contacts of several runs.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print, with fields stored.
    times : array_like, optional
        An instant [s]; of each run the nearest stored one is drawn. By default the last of each.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One outline per run; the instant stands above, or with each run where they differ.

    Raises
    ------
    ValueError
        If there are no runs, one of them cannot be drawn, or several instants are given.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ball = vc.Sphere(0.01)
    >>> one, two = (
    ...     vc.simulate(ball, rubber, vc.step(force), grid, [0.0, 1.0], errors=False)
    ...     for force in (0.1, 0.2)
    ... )
    >>> runs = {"0.1 N": one, "0.2 N": two}
    >>> figure = compare_contact_outlines(runs)
    >>> [text.get_text() for text in figure.legends[0].get_texts()]
    ['0.1 N', '0.2 N']
    >>> figure.axes[0].get_title(loc="left")
    't = 1 s'
    """
    snapshots, labels = headed_snapshots(runs, times, _NAME)
    if len(snapshots) > len(runs):
        raise ValueError(f"{_NAME}: runs are compared at one instant, got {times!r} s")
    window = window_around(snapshots)
    axes = _new_axes(window, len(snapshots), width, below=True)
    looks = styles_of(list(runs))
    for snapshot, look in zip(snapshots, looks, strict=True):
        path = rim_path(window.unit(polygon) for polygon in rim_curves(snapshot))
        how = {"edgecolor" if key == "color" else key: value for key, value in look.items()}
        axes.add_patch(PathPatch(path, fill=False, **how))
    axes.set(xlabel=window.unit.label("x"), ylabel=window.unit.label("y"))
    style.dress(axes)
    show_window(axes, window)
    style.add_heading(axes, window.note, aside=True)
    instants = {heading for snapshot in snapshots for heading in headings_of([snapshot])}
    if len(instants) == 1:
        style.add_heading(axes, instants.pop())
        labels = list(runs)
    lines = [Line2D([], [], **look) for look in looks]
    style.add_legend_below(style.figure_of(axes), lines, labels, columns=4)
    return style.figure_of(axes)


def _new_axes(window: Window, count: int, wanted: Width | None, *, below: bool = False) -> Axes:
    """Axes of the window's shape, with room for a legend."""
    usual = style.TWO_COLUMNS if window.height_to_width < 0.6 else style.ONE_COLUMN
    width = page_width(wanted, usual)
    if below:
        height = (width - 0.8) * window.height_to_width + 0.75 + 0.2 * min(count, 3)
    else:  # as high as the legend at least
        height = max((width - 1.6) * window.height_to_width + 0.6, 0.2 * count + 0.3)
    return style.new_figure(width, height, fixed_aspect=True).add_subplot()
