"""Contacts in steady motion: friction over speed, traction, and pressure along the motion."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.friction import friction_panel, frictions_panel
from viscontact.drawing.content.motion_profile import motion_panel
from viscontact.drawing.content.traction_creepage import traction_creepage_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys
from viscontact.results.shown_scalars import has_friction


def friction(
    results: xr.Dataset,
    *,
    theory: bool = False,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the friction coefficient over the speed, with the limits of slow and fast motion.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.steady`.
    theory : bool, optional
        Draw Persson's theory as a band beside it, for a rough body on a grid that is periodic along
        both axes; it is no error bar.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A point with its error bar for each speed, on logarithmic axes. The limit of slow motion is
        drawn for bodies that are round along the motion, on a solid; that of fast motion for round
        paraboloids and spheres; both for a law that is a series under a rigid or elastic body.

    Raises
    ------
    ValueError
        If the result is not one of steady motion, or the friction is not positive.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    >>> ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    >>> ds = vc.steady(ball, rubber, load, [0.01, 0.1, 1.0], errors=False, fields="none")
    >>> axes = friction(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel(), len(axes.lines)
    ('Speed [m/s]', 'Friction coefficient', 3)
    """
    if "speed" not in results.dims:
        raise ValueError("friction: the figure needs a result of steady motion, from steady()")
    if not has_friction(results):
        raise ValueError("friction: no friction coefficient is positive, as on an elastic body")
    if axes is None:
        wide = page_width(width, style.ONE_COLUMN)
        axes = style.new_figure(wide, 0.7 * wide).subplots()
    panel = friction_panel(results.sortby("speed"), theory=theory)
    draw_panel(axes, panel)
    axes.tick_params(which="both", labelsize=style.TICK_SIZE, colors=style.INK)
    handles, labels = named_keys(panel.curves)
    if len(handles) > 1:
        style.add_legend(axes, handles, labels, loc="best")
    return style.figure_of(axes)


def compare_frictions(
    runs: Mapping[str, xr.Dataset], *, axes: Axes | None = None, width: Width | None = None
) -> Figure:
    """Draw the friction coefficients of several results over the speed.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        From `viscontact.steady`, by name.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A line with a point and its error bar for each speed, on logarithmic axes.

    Raises
    ------
    ValueError
        If there are no runs, one is not of steady motion, or one has no positive friction.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    >>> ball, speeds = vc.Paraboloid(0.01, 0.01), [0.01, 0.1]
    >>> runs = {
    ...     f"{force} N": vc.steady(
    ...         ball, rubber, vc.step(force, tilt_x=0.0, tilt_y=0.0), speeds, errors=False
    ...     )
    ...     for force in (1.0, 2.0)
    ... }
    >>> axes = compare_frictions(runs).axes[0]
    >>> [text.get_text() for text in axes.get_legend().get_texts()]
    ['1.0 N', '2.0 N']
    """
    if not runs:
        raise ValueError("friction: needs at least one run to compare, got none")
    for name, run in runs.items():
        if "speed" not in run.dims:
            raise ValueError(f"friction: {name} is no result of steady motion")
        if not has_friction(run):
            raise ValueError(f"friction: no friction coefficient of {name} is positive")
    if axes is None:
        wide = page_width(width, style.ONE_COLUMN)
        axes = style.new_figure(wide, 0.7 * wide).subplots()
    panel = frictions_panel({name: run.sortby("speed") for name, run in runs.items()})
    draw_panel(axes, panel)
    axes.tick_params(which="both", labelsize=style.TICK_SIZE, colors=style.INK)
    style.add_legend(axes, *named_keys(panel.curves), loc="best")
    return style.figure_of(axes)


def traction_creepage(
    results: xr.Dataset, *, axes: Axes | None = None, width: Width | None = None
) -> Figure:
    """Draw the traction of a rolling body over its creepage, with Carter's limits.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.steady` with friction and creepages.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The traction over what friction carries, positive where the body drives, with its error
        bars: a line for each speed, of at most six. For long rollers Carter's (1926) curve is drawn
        beside them; for a body that creeps with the compliances of slow and of fast motion.

    Raises
    ------
    ValueError
        If the result has no creepages.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    >>> creepages = [0.0, 0.02, 0.1]
    >>> ds = vc.steady(ball, rubber, load, 0.1, friction=0.5, creepage=creepages, errors=False)
    >>> axes = traction_creepage(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('Creepage [%]', 'Traction over friction times force')
    """
    panel = traction_creepage_panel(results)
    if axes is None:
        wide = page_width(width, style.ONE_COLUMN)
        axes = style.new_figure(wide, 0.7 * wide).subplots()
    draw_panel(axes, panel)
    axes.tick_params(which="both", labelsize=style.TICK_SIZE, colors=style.INK)
    handles, labels = named_keys(panel.curves)
    if len(handles) > 1:
        style.add_legend(axes, handles, labels, loc="best")
    return style.figure_of(axes)


def motion_profile(
    results: xr.Dataset,
    *,
    speeds: ArrayLike | None = None,
    at: float = 0.0,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the pressure on a line along the motion, with the edges of the contact.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.steady`, with fields stored.
    speeds : array_like, optional
        Speeds [m/s]; the nearest stored ones are drawn. By default five, from the slowest to the
        fastest.
    at : float, optional
        Position of the line across the motion [m]; the nearest row of cells is taken.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A line per speed over the position relative to the body's axis, with a full marker at the
        leading edge and a hollow one at the trailing edge. The body moves to the right.

    Raises
    ------
    ValueError
        If the result is not one of steady motion, or has no fields.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    >>> ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    >>> ds = vc.steady(ball, rubber, load, [0.01, 0.1], errors=False)
    >>> axes = motion_profile(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('y from the axis, along the motion [mm]', 'Pressure [kPa]')
    """
    panel = motion_panel(results, speeds, at)
    if axes is None:
        wide = page_width(width, style.TWO_COLUMNS)
        axes = style.new_figure(wide, 0.45 * wide).subplots()
    draw_panel(axes, panel)
    style.add_legend(axes, *named_keys(panel.curves))
    return style.figure_of(axes)
