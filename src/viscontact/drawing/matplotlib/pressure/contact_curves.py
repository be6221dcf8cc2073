"""Pressure and line load along an axis of the contact (the paper's Figs. 10, 13 and 16)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import Runs
from viscontact.drawing.content.contact_curve import (
    LINE_LOAD,
    ContactCurve,
    contact_panels,
    pressure_curve,
)
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys


def pressure_profile(
    results: Runs,
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] | None = None,
    at: float | None = None,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the pressure on a line through the contact at several instants.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored; several by
        the names to print.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default five, from the
        first in contact to the last; of several results the first in contact and the last of the
        first one.
    along : {"x", "y"}, optional
        Direction of the line: along a roller, or across it. By default that of a motion, across the
        period of a grid that is periodic along one axis only, or else x; as for the first of
        several results.
    at : float, optional
        Position of the line on the other axis [m]; by default the middle of the grid. Between two
        rows of cells the pressure is interpolated.
    axes : matplotlib.axes.Axes, optional
        Axes to draw a single result in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One line per instant; of several results a panel per instant, and a line per run. Along a
        motion of a single one a full marker is at the leading edge of the contact, and a hollow
        one at the trailing edge.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch at these instants, the line misses the
        grid, or there is no result.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> axes = pressure_profile(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('x [µm]', 'Pressure [kPa]')
    """
    curve = pressure_curve(results, along, at, "pressure-profile")
    return _draw_curves(results, curve, times, axes, width)


def compare_pressure_profiles(
    runs: Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] | None = None,
    at: float | None = None,
    width: Width | None = None,
) -> Figure:
    """Overlay the pressure sections of several runs: `pressure_profile` of a mapping."""
    return pressure_profile(runs, times=times, along=along, at=at, width=width)


def line_load(
    results: Runs,
    *,
    times: ArrayLike | None = None,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the line load along the indenter at several instants.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored; several by
        the names to print.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default five, from the
        first in contact to the last; of several results the first in contact and the last of the
        first one.
    axes : matplotlib.axes.Axes, optional
        Axes to draw a single result in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One line per instant: the pressure integrated over y, q(x) = ∫ p dy. Of several results a
        panel per instant, and a line per run.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch at these instants, or there is no result.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid, body = vc.Grid((40, 24), (24e-3, 4e-3)), vc.Paraboloid(radius_x=0.2, radius_y=0.01)
    >>> ds = vc.simulate(body, rubber, vc.step(4.0), grid, [1.0], errors=False)
    >>> axes = line_load(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('x [mm]', 'Line load [N/m]')
    """
    return _draw_curves(results, LINE_LOAD, times, axes, width)


def compare_line_loads(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Overlay the line loads of several runs: `line_load` of a mapping."""
    return line_load(runs, times=times, width=width)


def _draw_curves(
    results: Runs,
    curve: ContactCurve,
    times: ArrayLike | None,
    axes: Axes | None,
    width: Width | None,
) -> Figure:
    """Draw a curve for each of several instants; for each of several runs, a panel per instant."""
    several = not isinstance(results, xr.Dataset)
    if several and axes is not None:
        raise ValueError(f"{curve.figure}: axes take a single result, got several")
    panels = contact_panels(results, curve, times)
    if several:
        return _draw_panels(panels, width)
    if axes is None:
        wide = page_width(width, style.TWO_COLUMNS * 0.8)
        axes = style.new_figure(wide, min(3.0, 0.75 * wide)).add_subplot()
    draw_panel(axes, panels[0])
    axes.set_ylim(bottom=0.0)
    style.add_legend(axes, *named_keys(panels[0].curves))
    return style.figure_of(axes)


def _draw_panels(panels: list[Panel], width: Width | None) -> Figure:
    figure = style.new_figure(page_width(width, style.TWO_COLUMNS), 2.2 * len(panels) + 0.4)
    shared = figure.subplots(len(panels), sharex=True, sharey=True, squeeze=False)[:, 0]
    for axes, panel in zip(shared, panels, strict=True):
        draw_panel(axes, panel)
    shared[0].set_ylim(bottom=0.0)  # once all curves have extended the common limits
    style.add_legend_below(figure, *named_keys(panels[0].curves))
    return figure
