"""Error bars as bands along a curve, and what is said of a peak that depends on the mesh."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import ArrayLike, NDArray

from viscontact.plot.layout import style
from viscontact.results.stated_errors import MESH_DEPENDENT, mesh_dependent

#: What a legend says of bands: all stand out, some do, none does.
BAND = "band: error estimate"
BAND_IN_PARTS = "band: error estimate, where wider than the line"
NO_BAND = "error estimate within the line's width"

_OPACITY = 0.25
#: An axis goes beyond its curve by so much of the curve's own span or, if that is more, of its
#: largest value: one wild error is not to flatten what there is to see.
_SPAN, _SIZE = 1.0, 0.5
#: A band is seen where it stands out so far beyond its line, to either side [points].
_SEEN = 0.4


@dataclass(frozen=True, eq=False)
class Band:
    """A curve's error, shaded.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where it is drawn.
    x, y : ndarray
        The curve, as drawn.
    error : ndarray
        Half width of the band, in the unit of the axis it goes along.
    sideways : bool
        Along x.
    """

    axes: Axes
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    error: NDArray[np.float64]
    sideways: bool

    @property
    def seen(self) -> bool:
        """Whether it stands out beside the line, as the figure is laid out at present."""
        dots_per_point = style.figure_of(self.axes).dpi / 72
        to_points = self.axes.transData.transform
        curve = to_points(np.column_stack([self.x, self.y])) / dots_per_point
        shift = (self.error, 0 * self.error) if self.sideways else (0 * self.error, self.error)
        reach = to_points(np.column_stack([self.x, self.y]) + np.column_stack(shift))
        reach = reach / dots_per_point - curve
        along = np.gradient(curve, axis=0)
        length = np.hypot(*along.T)
        # Across the curve: beside a steep one a high band is narrow.
        across = np.abs(along[:, 0] * reach[:, 1] - along[:, 1] * reach[:, 0])
        with np.errstate(divide="ignore", invalid="ignore"):
            return bool(np.nanmax(across / length, initial=0.0) > style.LINE_WIDTH / 2 + _SEEN)


def draw_band(
    axes: Axes,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    error: NDArray[np.float64] | None,
    colour: str,
    *,
    sideways: bool = False,
) -> Band | None:
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
    Band or None
        None where nothing is to be shaded.

    Examples
    --------
    >>> axes = style.new_figure(4.0, 3.0).subplots()
    >>> draw_band(axes, np.arange(2.0), np.ones(2), np.array([0.1, 0.2]), "black").seen
    True
    >>> axes.collections[0].get_datalim(axes.transData).intervaly.round(12).tolist()
    [0.8, 1.2]
    """
    known = np.zeros(x.shape, dtype=np.bool_) if error is None else np.isfinite(error) & (error > 0)
    if error is None or not known.any():
        return None
    # Zero errors between others keep the band together.
    shown = np.isfinite(error)
    middle, along = (x, y) if sideways else (y, x)
    half_width = np.where(shown, error, 0.0)
    low, high = middle - half_width, middle + half_width
    fill = axes.fill_betweenx if sideways else axes.fill_between
    fill(along, low, high, shown, color=colour, alpha=_OPACITY, linewidth=0.0, zorder=1.5)
    return Band(axes, x, y, np.where(shown, error, np.nan), sideways)


def band_key(bands: Sequence[Band], colour: str) -> list[tuple[Artist, str]]:
    """Say in a legend what bands are, or that they are too narrow to be seen.

    Parameters
    ----------
    bands : sequence of Band
        All that are drawn in a figure.
    colour : str
        Of the curve, or of none if there are several.

    Returns
    -------
    list of tuple
        A handle and its label; nothing if there are no bands.

    Examples
    --------
    >>> axes = style.new_figure(4.0, 3.0).subplots()
    >>> wide, narrow = (
    ...     draw_band(axes, np.arange(2.0), np.arange(2.0), np.full(2, each), "black")
    ...     for each in (0.1, 1e-9)
    ... )
    >>> [band_key(each, "black")[0][1] for each in ([wide], [wide, narrow], [narrow])]
    ['band: error estimate', 'band: error estimate', "error estimate within the line's width"]
    """
    if not bands:
        return []
    style.figure_of(bands[0].axes).draw_without_rendering()
    seen = {band.axes for band in bands if band.seen}
    if not seen:
        return [(Line2D([], [], color=colour, linewidth=style.LINE_WIDTH), NO_BAND)]
    everywhere = all(band.axes in seen for band in bands)
    shade = Patch(color=colour, alpha=_OPACITY, linewidth=0.0)
    return [(shade, BAND if everywhere else BAND_IN_PARTS)]


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
