"""Largest von Mises stress below the contact, and its depth, over time."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import runs_of
from viscontact.drawing.content.von_mises import von_mises_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys
from viscontact.mechanics.halfspace.stress_lines import Progress

_NAME = "von-mises"


def von_mises_history(
    results: xr.Dataset | Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
    progress: Progress | None = None,
) -> Figure:
    """Draw the largest von Mises stress and its depth over time.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored; several
        results by the names to print.
    times : array_like, optional
        Instants [s]; by default all that are stored.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].
    progress : callable, optional
        Called as ``progress(done, total)`` after each depth of the sections.

    Returns
    -------
    matplotlib.figure.Figure
        The largest stress on planes across the contact through its largest pressure, above its
        depth. Time is logarithmic where it is in the run's history.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch, or Poisson's ratio is not known.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> [axes.get_ylabel() for axes in von_mises_history(ds).axes]
    ['Von Mises stress [kPa]', 'Depth [µm]']
    """
    runs = runs_of(results, _NAME)
    panels = von_mises_panels(runs, times, progress)
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), 3.6)
    axes = list(figure.subplots(2, 1, sharex=True))
    axes[-1].tick_params(labelbottom=True)
    for each, panel in zip(axes, panels, strict=True):
        draw_panel(each, panel)
    if len(runs) > 1:
        style.add_legend_below(figure, *named_keys(panels[0].curves), columns=2)
    figure.draw_without_rendering()
    style.arrange_headings(figure)
    return figure


def compare_von_mises(
    runs: Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
    progress: Progress | None = None,
) -> Figure:
    """Overlay the largest von Mises stresses of several runs, and their depths.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print, with fields stored.
    times : array_like, optional
        Instants [s]; by default all that are stored.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].
    progress : callable, optional
        Called as ``progress(done, total)`` after each depth of the sections.

    Returns
    -------
    matplotlib.figure.Figure
        As `von_mises_history`, one line per run.

    Raises
    ------
    ValueError
        If there are no runs, or as `von_mises_history` does.

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
    >>> [axes.get_ylabel() for axes in compare_von_mises(runs).axes]
    ['Von Mises stress [kPa]', 'Depth [µm]']
    """
    return von_mises_history(runs, times=times, width=width, progress=progress)
