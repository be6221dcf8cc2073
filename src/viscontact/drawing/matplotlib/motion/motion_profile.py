"""Pressure along the motion of a body in steady motion, with leading and trailing edge."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.results.stored_contact import cells_in_contact
from viscontact.units.formatting import format_quantity, readable_unit

#: Most speeds that are drawn by default, and digits of a speed.
_MOST, _DIGITS = 5, 3


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
    if "speed" not in results.dims or "pressure" not in results:
        raise ValueError(
            "motion_profile: the figure needs a result of steady motion with fields, from steady()"
        )
    along = str(results.attrs["along"])
    across = "y" if along == "x" else "x"
    dimension = str(results["pressure"].dims[0])
    stored = results["pressure"].sel({across: at}, method="nearest").sortby(dimension)
    chosen = _chosen(stored[dimension].values, speeds)
    lines, places = stored.values[chosen], stored[along].values
    touched = cells_in_contact(results).sel({across: at}, method="nearest").sortby(dimension)
    if axes is None:
        wide = page_width(width, style.TWO_COLUMNS)
        axes = style.new_figure(wide, 0.45 * wide).subplots()
    style.dress(axes)
    x_unit, y_unit = readable_unit("m", places), readable_unit("Pa", lines)
    curves, colours = [], style.time_colours(len(chosen))
    for index, (number, pressure) in enumerate(zip(chosen.tolist(), lines, strict=True)):
        colour = colours[index]
        curves += axes.plot(x_unit(places), y_unit(pressure), color=colour, lw=style.LINE_WIDTH)
        _mark_edges(axes, x_unit(places), touched.values[number], colour)
        label = format_quantity(float(stored[dimension].values[number]), "m/s", _DIGITS)
        curves[-1].set_label(label)
    axes.axvline(0.0, color=style.FAINT, linewidth=style.THIN_LINE)
    axes.set(
        xlabel=x_unit.label(f"{along} from the axis, along the motion"),
        ylabel=y_unit.label("Pressure"),
    )
    style.add_legend(axes, curves, [str(curve.get_label()) for curve in curves])
    return style.figure_of(axes)


def _chosen(stored: Floats, speeds: ArrayLike | None) -> Integers:
    """Positions of the speeds to draw among the stored ones, ascending."""
    if speeds is None:
        count = min(_MOST, len(stored))
        return np.unique(np.rint(np.linspace(0, len(stored) - 1, count)).astype(int))
    wanted = np.atleast_1d(np.asarray(speeds, dtype=float))
    return np.unique(np.abs(np.log(stored / wanted[:, None])).argmin(axis=1))


def _mark_edges(axes: Axes, places: Floats, touched: Bools, colour: str) -> None:
    """Mark the trailing edge (hollow) and the leading edge (full) of a contact."""
    inside = np.flatnonzero(touched)
    if not inside.size:
        return
    half = (places[1] - places[0]) / 2
    for place, fill in (
        (places[inside[0]] - half, "white"),
        (places[inside[-1]] + half, colour),
    ):
        axes.plot(place, 0.0, "o", color=colour, mfc=fill, ms=4, clip_on=False, zorder=3)
