"""Error bars as bands along a curve, and what is said of a peak that depends on the mesh."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.patches import Patch
from numpy.typing import ArrayLike, NDArray

from viscontact.plot import style
from viscontact.stated_errors import MESH_DEPENDENT, mesh_dependent

#: What a legend calls a band.
BAND = "band: error estimate"

_OPACITY = 0.25
#: An axis goes beyond its curve by so much of the curve's own span or, if that is more, of its
#: largest value: one wild error is not to flatten what there is to see.
_SPAN, _SIZE = 1.0, 0.5


def draw_band(
    axes: Axes,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    error: NDArray[np.float64] | None,
    colour: str,
    *,
    sideways: bool = False,
) -> bool:
    """Shade a curve's error, where it is known and finite.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where the curve is drawn.
    x, y : ndarray
        The curve, as drawn.
    error : ndarray or None
        Half width of its error along y, in the unit of the axis; None for no band.
    colour : str
        The curve's.
    sideways : bool, optional
        The error is one along x.

    Returns
    -------
    bool
        Whether there is a band.

    Examples
    --------
    >>> axes = style.new_figure(4.0, 3.0).subplots()
    >>> draw_band(axes, np.arange(2.0), np.ones(2), np.array([0.1, 0.2]), "black")
    True
    >>> axes.collections[0].get_datalim(axes.transData).intervaly.round(12).tolist()
    [0.8, 1.2]
    """
    known = np.zeros(x.shape, dtype=np.bool_) if error is None else np.isfinite(error) & (error > 0)
    if error is None or not known.any():
        return False
    # Zero errors between others keep the band together.
    shown = np.isfinite(error)
    middle, along = (x, y) if sideways else (y, x)
    half_width = np.where(shown, error, 0.0)
    low, high = middle - half_width, middle + half_width
    fill = axes.fill_betweenx if sideways else axes.fill_between
    fill(along, low, high, shown, color=colour, alpha=_OPACITY, linewidth=0.0, zorder=1.5)
    return True


def has_bands(axes: Axes) -> bool:
    """Tell whether errors are shaded in axes."""
    return any(isinstance(each, PolyCollection) for each in axes.collections)


def band_key(colour: str = style.FAINT) -> tuple[Patch, str]:
    """Return a handle for a legend, and its label."""
    return Patch(color=colour, alpha=_OPACITY, linewidth=0.0), BAND


def keep_curves_in_sight(axes: Axes, *curves: ArrayLike) -> None:
    """Let no band stretch the vertical axis far beyond the curves.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where curves and bands are drawn.
    *curves : array_like
        Values of the curves, in the unit of the axis.
    """
    values = np.concatenate([np.ravel(np.asarray(curve, dtype=np.float64)) for curve in curves])
    values = values[np.isfinite(values)]
    if not values.size:
        return
    room = max(_SPAN * np.ptp(values), _SIZE * np.abs(values).max())
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, values.min() - room), min(high, values.max() + room))


def peak_note(runs: Iterable[xr.Dataset], times: ArrayLike | None = None) -> str:
    """Return what to say of peak pressures that depend on the mesh.

    Parameters
    ----------
    runs : iterable of xarray.Dataset
        Results that are drawn together.
    times : array_like, optional
        The instants that are drawn [s]; of each run the nearest ones count. By default all.

    Returns
    -------
    str
        Empty where none depends on it.

    Examples
    --------
    >>> peak = ("time", [np.inf, 1.0])
    >>> run = xr.Dataset({"peak_pressure_error": peak}, coords={"time": [0.0, 1.0]})
    >>> peak_note([run]), peak_note([run], [0.9])
    ('peak depends on the mesh', '')
    """
    for run in runs:
        marked, instants = mesh_dependent(run, "peak_pressure"), run["time"].values
        wanted = instants if times is None else np.atleast_1d(np.asarray(times, dtype=float))
        if any(marked[np.abs(instants - instant).argmin()] for instant in wanted):
            return f"peak {MESH_DEPENDENT}"
    return ""
