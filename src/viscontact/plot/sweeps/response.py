"""Chief scalars of a sweep against its varied keys: curves, contour maps, or points."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from numpy.typing import NDArray

from viscontact.plot.layout import style
from viscontact.plot.layout.page import NARROW, Width, page_width
from viscontact.results.largest_values import (
    compared_scalars,
    key_label,
    largest_values,
    run_dims,
    varied_keys,
)
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import ReadableUnit, format_compact, readable_unit

Floats = NDArray[np.float64]

#: Least number of values of both keys for a contour map, and most curves in a panel.
_LEAST_MAP, _MOST_CURVES = 5, 8
#: Number of points in a curve from which they are smaller.
_MANY = 200
#: Least ratio of the largest to the least value on a logarithmic axis.
_DECADE = 9.0
#: Most keys and contours that are drawn.
_MOST_KEYS, _CONTOURS = 4, 12


def response(results: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the largest values over time of a sweep against its varied keys.

    Parameters
    ----------
    results : xarray.Dataset
        Runs of a sweep, from `viscontact.open_many`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each chief scalar that differs between the runs. A grid of one or two keys has
        curves, or contours if both keys are numbers with five values or more; other sweeps have
        points over each key. Error bars are those of the results. A hollow marker is a value that
        depends on the mesh. Runs without a result are left out.

    Raises
    ------
    ValueError
        If no scalar differs between the runs, or no key is varied.

    Examples
    --------
    >>> coords = {"load.force": ("load.force", [1.0, 8.0], {"units": "N"}), "time": [0.0]}
    >>> approach = (("load.force", "time"), [[1e-5], [4e-5]])
    >>> runs = {"state": ("load.force", ["done", "done"]), "approach": approach}
    >>> axes = response(xr.Dataset(runs, coords)).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel(), axes.lines[0].get_ydata().round(9).tolist()
    ('force [N]', 'Approach [µm]', [10.0, 40.0])
    """
    scalars, keys = compared_scalars(results), varied_keys(results)
    if not scalars or not keys:
        what = "scalar differs between the finished runs" if keys else "key is varied"
        raise ValueError(f"response: no {what}; give a sweep of two finished runs or more")
    across = page_width(width, style.TWO_COLUMNS)
    single = [dim for dim in run_dims(results) if results.sizes[dim] == 1]
    results = results.squeeze(single, drop=True)
    dims = run_dims(results)
    if not set(keys) <= set(dims) or len(keys) > 2:
        return _points(results, scalars, keys[:_MOST_KEYS], across)
    keys = sorted(keys, key=lambda key: _is_number(results, key) * results.sizes[key], reverse=True)
    figure, panels = _panels(len(scalars), across)
    for name, axes in zip(scalars, panels, strict=True):
        sizes = [results.sizes[key] for key in keys]
        numbers = all(_is_number(results, key) for key in keys)
        if len(keys) == 2 and numbers and min(sizes) >= _LEAST_MAP:
            _draw_map(axes, results, name, *keys)
        else:
            _draw_curves(axes, results, name, *keys)
    _add_key(figure, panels, key_label(results, keys[-1]))
    return figure


def _points(ds: xr.Dataset, scalars: list[str], keys: list[str], across: float) -> Figure:
    """Points of all runs: a row of panels for each scalar, a column for each key."""
    figure = style.new_figure(across, 1.9 * len(scalars) + 0.2)
    grid = figure.subplots(len(scalars), len(keys), squeeze=False, sharey="row", sharex="col")
    for row, name in zip(grid, scalars, strict=True):
        values = _Values.of(ds, name)
        for key, axes in zip(keys, row, strict=True):
            style.dress(axes)
            places = xr.broadcast(ds[key], ds["state"])[0].transpose(*ds["state"].dims)
            axis = _Axis.of(ds, key)
            values.draw(axes, axis.at(places.values.ravel()), style.LINE, joined=False)
            axis.label(axes)
        for axes in row[1:]:
            axes.set_ylabel("")
    for axes in grid[:-1].flat:
        axes.set_xlabel("")
    return figure


def _panels(count: int, across: float) -> tuple[Figure, list[Axes]]:
    columns = 1 if across <= NARROW else 2 if count in (2, 4) else min(3, count)
    rows = -(-count // columns)
    figure = style.new_figure(across, {1: 2.6, 2: 2.6, 3: 2.3}[columns] * rows + 0.3)
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    for unused in panels[count:]:
        unused.remove()
    for axes in panels[:count]:
        style.dress(axes)
    return figure, panels[:count]


@dataclass(frozen=True)
class _Axis:
    """Axis of a key: numbers in a readable unit, or texts at equal distances."""

    name: str
    unit: ReadableUnit
    texts: tuple[str, ...]  # empty for numbers
    is_log: bool

    @classmethod
    def of(cls, ds: xr.Dataset, key: str) -> _Axis:
        values = ds[key].values
        if not _is_number(ds, key):
            texts = tuple(dict.fromkeys(map(str, values.ravel())))
            return cls(key_label(ds, key), ReadableUnit("", 1.0), texts, is_log=False)
        known = np.unique(values[np.isfinite(values)])
        unit = readable_unit(ds[key].attrs.get("units", "1"), known)
        return cls(key_label(ds, key), unit, (), _suits_logarithm(known))

    def at(self, values: NDArray[np.generic]) -> Floats:
        """Places of values on the axis."""
        if self.texts:
            return np.array([self.texts.index(str(value)) for value in values], dtype=np.float64)
        return self.unit(values)

    def place_ticks(self, axis: Axis) -> None:
        """Place plain numbers at the ticks of a logarithmic axis."""
        if self.is_log:
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter(FuncFormatter(lambda value, _: format_compact(value)))
            axis.set_minor_formatter(NullFormatter())

    def label(self, axes: Axes) -> None:
        """Label the horizontal axis, and choose its scale."""
        axes.set_xlabel(self.unit.label(self.name))
        if self.is_log:
            axes.set_xscale("log")
        self.place_ticks(axes.xaxis)
        if self.texts:
            axes.set_xticks(range(len(self.texts)), self.texts, rotation=30, ha="right")


@dataclass(frozen=True)
class _Values:
    """Largest values of a scalar and their errors, in the order of the runs."""

    name: str
    unit: ReadableUnit
    values: Floats
    errors: Floats

    @classmethod
    def of(cls, ds: xr.Dataset, name: str, *order: str) -> _Values:
        found = [each.transpose(*order).values for each in largest_values(ds, name)]
        values, errors = found if len(order) > 1 else (each.ravel() for each in found)
        return cls(name, readable_unit(SCALARS[name].units, values), values, errors)

    def draw(
        self,
        axes: Axes,
        places: Floats,
        colour: str,
        *,
        joined: bool,
        row: int | None = None,
        label: str = "",
    ) -> None:
        """Draw a curve or points with error bars; hollow markers depend on the mesh."""
        values = self.unit(self.values if row is None else self.values[:, row])
        errors = self.unit(self.errors if row is None else self.errors[:, row])
        marked = np.isposinf(errors)
        size = 3.5 if values.size <= _MANY else 2.0
        axes.plot(
            places, values, "o-" if joined else "o", color=colour, markersize=size, label=label
        )
        axes.plot(places[marked], values[marked], "o", color="white", markersize=0.6 * size)
        bars = np.where(np.isfinite(errors), errors, 0.0)
        if (bars > 0).any():
            axes.errorbar(places, values, bars, fmt="none", ecolor=colour, elinewidth=0.8)
        axes.set_ylabel(self.unit.label(SCALARS[self.name].label))


def _draw_curves(axes: Axes, ds: xr.Dataset, name: str, key: str, by: str | None = None) -> None:
    """Curves of a scalar over a key, one for each value of another one."""
    axis = _Axis.of(ds, key)
    places = axis.at(ds[key].values)
    if by is None:
        _Values.of(ds, name, key).draw(axes, places, style.LINE, joined=not axis.texts)
    else:
        values, labels = _Values.of(ds, name, key, by), _labels(ds, by)
        few = len(labels) <= _MOST_CURVES
        looks = style.run_styles(len(labels)) if few else ()
        colours = [look["color"] for look in looks] or style.time_colours(len(labels))
        for row, (label, colour) in enumerate(zip(labels, colours, strict=True)):
            label = label if few or row in (0, len(labels) - 1) else ""
            values.draw(axes, places, colour, joined=not axis.texts, row=row, label=label)
    axis.label(axes)


def _labels(ds: xr.Dataset, key: str) -> list[str]:
    """Values of a key for a legend."""
    values = ds[key].values
    if not _is_number(ds, key):
        return [str(value) for value in values]
    unit = readable_unit(ds[key].attrs.get("units", "1"), values)
    return [f"{format_compact(float(value))} {unit.symbol}".strip() for value in unit(values)]


def _draw_map(axes: Axes, ds: xr.Dataset, name: str, key: str, by: str) -> None:
    """Contours of a scalar over two keys, with a dot for each run."""
    found, across, up = _Values.of(ds, name, by, key), _Axis.of(ds, key), _Axis.of(ds, by)
    x, order_x = _increasing(across.at(ds[key].values))
    y, order_y = _increasing(up.at(ds[by].values))
    values = np.ma.masked_invalid(found.unit(found.values)[np.ix_(order_y, order_x)])
    drawn = axes.contourf(x, y, values, _CONTOURS, cmap="viridis")
    bar = style.figure_of(axes).colorbar(drawn, ax=axes)
    bar.ax.tick_params(labelsize=style.TICK_SIZE)
    has_result = ~np.ma.getmaskarray(values)
    points_x, points_y = np.meshgrid(x, y)
    axes.plot(points_x[has_result], points_y[has_result], ".", color="white", markersize=2.0)
    across.label(axes)
    axes.set_ylabel(up.unit.label(up.name))
    if up.is_log:
        axes.set_yscale("log")
    up.place_ticks(axes.yaxis)
    style.add_heading(axes, found.unit.label(SCALARS[name].label))


def _increasing(places: Floats) -> tuple[Floats, NDArray[np.intp]]:
    order = np.argsort(places)
    assert all(a < b for a, b in pairwise(places[order]))  # values of a dimension differ
    return places[order], order


def _add_key(figure: Figure, panels: list[Axes], key: str) -> None:
    """Legend of the curves, which differ in a key."""
    handles, labels = panels[0].get_legend_handles_labels()
    if labels:
        labels = [f"{key} {labels[0]}", *labels[1:]]
        style.add_legend_below(figure, handles, labels, columns=4)


def _suits_logarithm(values: Floats) -> bool:
    """Test for increasing values over a decade or so whose ratios vary less than their steps."""
    if values[0] <= 0 or values[-1] < _DECADE * values[0]:
        return False
    steps, ratios = np.diff(values), np.diff(np.log(values))
    return bool(ratios.std() / ratios.mean() < steps.std() / steps.mean())


def _is_number(ds: xr.Dataset, key: str) -> bool:
    return bool(np.issubdtype(ds[key].dtype, np.number))
