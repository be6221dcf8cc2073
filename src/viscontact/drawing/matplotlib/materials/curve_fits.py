"""Distribution of what many curves gave, and where."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from scipy.spatial import cKDTree

from viscontact.backend.arrays import Floats
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.log_ticks import plain_log_ticks
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.units.formatting import format_quantity, readable_unit

if TYPE_CHECKING:
    from viscontact.identification.curve_batch import CurveFits
    from viscontact.identification.fitted_curve import FittedCurve

#: Ratio of the values beyond which their axis is logarithmic.
_WIDE = 10.0
#: Least and most bars of a histogram, and parts of the values that it may leave out at either end.
_BARS, _OUTLIERS = (5, 40), 0.005


def curve_fits(fits: CurveFits, *, width: Width | None = None) -> Figure:
    """Draw histograms of the parameters that were fitted to many curves.

    Parameters
    ----------
    fits : CurveFits
        From `viscontact.identification.fit_each`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each parameter that a curve determines, over a logarithmic axis where the values
        differ by more than a factor of ten; a line marks the median, a band half of the curves.
        Curves whose places are known have a map of each parameter beside it.

    Raises
    ------
    ValueError
        If no curve has a fit.

    Examples
    --------
    >>> from viscontact.identification import CurveFits, FittedCurve
    >>> curves = tuple(
    ...     FittedCurve(str(G), {"shear_modulus": G}, {}, {"shear_modulus": "Pa"})
    ...     for G in (1e3, 2e3, 2.5e3, 4e3)
    ... )
    >>> [axes.get_xlabel() for axes in curve_fits(CurveFits(curves)).axes]
    ['Shear modulus [kPa]']
    """
    names = [each for each in fits.parameters if np.isfinite(fits.values_of(each)).any()]
    if not names:
        raise ValueError("curve_fits: no curve has a fit")
    count = len(names) * (2 if fits.has_places else 1)
    across = min(count, 2)
    rows = -(-count // across)
    wide = page_width(width, style.TWO_COLUMNS if across > 1 else style.ONE_COLUMN)
    figure = style.new_figure(wide, 2.4 * rows)
    panels = iter(figure.subplots(rows, across, squeeze=False).flat)
    for name in names:
        values, unit = fits.values_of(name), fits.unit_of(name)
        _histogram(next(panels), name, unit, values)
        if fits.has_places:
            beside = next(panels)
            if any(_is_mapped(each, name) for each in fits.curves):
                _map(beside, fits, name)
            else:
                beside.remove()
    for unused in panels:
        unused.remove()
    return figure


def _is_mapped(curve: FittedCurve, name: str) -> bool:
    """Whether place and value of a curve are known."""
    return curve.place is not None and math.isfinite(curve.values.get(name, math.nan))


def _map(axes: Axes, fits: CurveFits, name: str) -> None:
    """Map of a parameter, a square for each place; crosses where it is not known."""
    placed = [each for each in fits.curves if each.place is not None]
    places = np.array([each.place for each in placed])
    values = np.array([each.values.get(name, math.nan) for each in placed])
    known = np.isfinite(values)
    length = readable_unit("m", np.ptp(places, axis=0).max())
    unit = readable_unit(fits.unit_of(name), np.median(values[known]))
    low, high = np.percentile(values[known], (100 * _OUTLIERS, 100 - 100 * _OUTLIERS)).tolist()
    scale = LogNorm if low > 0 and high > _WIDE * low else Normalize
    half = _spacing(places) / 2
    corners = half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    squares = PolyCollection(
        [length(place + corners) for place in places[known]],
        array=unit(values[known]),
        cmap="viridis",
        norm=scale(*unit([low, high]).tolist()),
        edgecolors="face",
        linewidths=0.2,
    )
    style.dress(axes)
    axes.add_collection(squares)
    axes.plot(*length(places[~known]).T, "x", color=style.FAINT, ms=4, mew=0.8)
    x, y = (length([each.min() - half, each.max() + half]).tolist() for each in places.T)
    axes.set(aspect="equal", xlim=x, ylim=y, xlabel=length.label("x"), ylabel=length.label("y"))
    beyond = "both" if values[known].size > 2 / _OUTLIERS else "neither"
    bar = style.figure_of(axes).colorbar(squares, ax=axes, aspect=25, extend=beyond)
    style.dress_colour_bar(bar, unit.label(_label(name)))


def _spacing(places: Floats) -> float:
    """Usual distance from a place to the nearest other one [m]."""
    nearest = cKDTree(places).query(places, 2)[0][:, 1]
    apart = nearest[np.isfinite(nearest) & (nearest > 0)]
    return float(np.median(apart)) if apart.size else 1e-6


def _label(name: str) -> str:
    """Name of a parameter as a label."""
    label = name.replace("_", " ").replace("youngs", "Young's").replace("pull off", "pull-off")
    return label[0].upper() + label[1:]


def _histogram(axes: Axes, name: str, si: str, every: Floats) -> None:
    """Histogram of a parameter [SI] with its median and its quartiles; NaN where not determined."""
    values = every[np.isfinite(every)]
    style.dress(axes)
    low, middle, high = np.percentile(values, (25.0, 50.0, 75.0)).tolist()
    unit = readable_unit(si, middle)
    first, last = np.percentile(values, (100 * _OUTLIERS, 100 - 100 * _OUTLIERS)).tolist()
    is_wide = first > 0 and last > _WIDE * first
    scaled = np.log10(values) if is_wide else values
    start, end = (math.log10(each) if is_wide else each for each in (first, last))
    count = int(np.clip(np.sqrt(values.size) * 1.5, *_BARS))
    if end > start:
        edges = np.linspace(start, end, count + 1)
    else:
        edges = start + np.array([-0.05, 0.05]) * max(abs(start), 1e-30)
    inside = np.clip(scaled, edges[0], edges[-1])
    bars, _ = np.histogram(inside, edges)
    places = unit(10.0**edges if is_wide else edges)
    axes.axvspan(*unit([low, high]).tolist(), color=style.SHADE, lw=0)
    axes.bar(places[:-1], bars, np.diff(places), align="edge", color=style.LINE, alpha=0.85)
    axes.axvline(float(unit(middle)), color=style.INK, lw=1.2)
    if is_wide:
        axes.set_xscale("log")
        plain_log_ticks(axes.xaxis)
    axes.set_xlabel(unit.label(_label(name)))
    axes.set_ylabel("Curves")
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    known = f"{values.size} of " if values.size < every.size else ""
    text = f"median {format_quantity(middle, si, 3)}, {known}{every.size} curves"
    style.add_heading(axes, text)
