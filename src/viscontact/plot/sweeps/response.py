"""Chief scalars of a sweep against its varied keys: curves, contour maps, or points."""

from __future__ import annotations

from dataclasses import dataclass
from textwrap import fill
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.backend.arrays import Bools, Floats
from viscontact.plot.layout import style
from viscontact.plot.layout.page import NARROW, Width, page_width
from viscontact.plot.layout.style import styles_of
from viscontact.plot.sweeps.key_axis import KeyAxis, is_number, key_labels, place_log_ticks
from viscontact.results.largest_values import (
    compared_scalars,
    key_label,
    largest_values,
    over_of,
    run_dims,
    varied_keys,
)
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Least number of values of both keys for a contour map, and most curves in a panel.
_LEAST_MAP, _MOST_CURVES = 5, 8
#: Number of points in a curve from which they are smaller.
_MANY = 200
#: Width of a letter of a label [inch].
_LETTER = 0.068
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
        depends on the mesh; no curve runs through it. A cross at the lower edge, or in a map, is a
        run without a result.

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
    ('Load force [N]', 'Approach [µm]', [10.0, 40.0])
    """
    scalars, keys = compared_scalars(results), varied_keys(results)
    if not scalars or not keys:
        what = "scalar differs between the finished runs" if keys else "key is varied"
        raise ValueError(f"response: no {what}; give a sweep of two finished runs or more")
    across = page_width(width, style.TWO_COLUMNS)
    single = [dim for dim in run_dims(results) if results.sizes[dim] == 1]
    ds = results.squeeze(single, drop=True)
    if not set(keys) <= set(run_dims(ds)) or len(keys) > 2:
        figure, has_bars = _points(ds, scalars, keys[:_MOST_KEYS], across), True
    else:
        has_bars = not _suits_map(ds, keys)
        figure = _panels(ds, scalars, keys, across, is_map=not has_bars)
    heading = fill(_heading(ds, scalars, has_bars=has_bars), _letters(across))
    figure.suptitle(heading, x=0.01, ha="left", fontsize=style.TICK_SIZE, color=style.INK)
    return figure


def _suits_map(ds: xr.Dataset, keys: list[str]) -> bool:
    numbers = [key for key in keys if is_number(ds, key)]
    return len(numbers) == 2 and min(ds.sizes[key] for key in keys) >= _LEAST_MAP


def _heading(ds: xr.Dataset, scalars: list[str], *, has_bars: bool) -> str:
    """Description of the values, and the number of runs without one."""
    errors = [largest_values(ds, name)[1].values for name in scalars]
    said = f"Largest values over {over_of(ds)}"
    if has_bars and any((np.isfinite(each) & (each > 0)).any() for each in errors):
        said += ", with error bars"
    if has_bars and any(np.isposinf(each).any() for each in errors):
        said += "; hollow: depends on the mesh"
    if missing := int((ds["state"] != "done").sum()):
        runs = "1 run" if missing == 1 else f"{missing} runs"
        said += f"; ×: no result ({runs} of {ds['state'].size})"
    return said


def _panels(
    ds: xr.Dataset, scalars: list[str], keys: list[str], across: float, *, is_map: bool
) -> Figure:
    """Maps or curves of a grid of one or two keys: a panel for each scalar."""
    numbers = [key for key in keys if is_number(ds, key)]
    ds = ds.sortby(numbers)
    keys = sorted(keys, key=lambda key: (key in numbers) * ds.sizes[key], reverse=True)
    has_legend = len(keys) == 2 and not is_map
    columns = 1 if across <= NARROW else 2 if len(scalars) in (2, 4) else min(3, len(scalars))
    rows = -(-len(scalars) // columns)
    height = (2.3 if columns == 3 else 2.6) * rows + (0.7 if has_legend else 0.3)
    figure = style.new_figure(across, height)
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    for unused in panels[len(scalars) :]:
        unused.remove()
    axis = KeyAxis.of(ds, keys[0])
    for name, axes in zip(scalars, panels, strict=False):
        style.dress(axes)
        (_draw_map if is_map else _draw_curves)(axes, ds, name, axis, *keys)
        axis.label(axes, _letters(across, columns))
    if has_legend:
        handles, labels = panels[0].get_legend_handles_labels()
        style.add_legend_below(figure, handles, labels, columns=4, title=key_label(keys[1]))
    return figure


def _points(ds: xr.Dataset, scalars: list[str], keys: list[str], across: float) -> Figure:
    """Points of all runs: a row of panels for each scalar, a column for each key."""
    figure = style.new_figure(across, 1.9 * len(scalars) + 0.4)
    grid = figure.subplots(len(scalars), len(keys), squeeze=False, sharey="row", sharex="col")
    for row, name in zip(grid, scalars, strict=True):
        values = _Values.of(ds, name)
        for key, axes in zip(keys, row, strict=True):
            style.dress(axes)
            places = xr.broadcast(ds[key], ds["state"])[0].transpose(*ds["state"].dims)
            axis = KeyAxis.of(ds, key)
            values.draw(axes, axis.at(places.values.ravel()), style.LINE, joined=False)
            axis.label(axes, _letters(across, len(keys)))
        for axes in row[1:]:
            axes.set_ylabel("")
    for axes in grid[:-1].flat:
        axes.set_xlabel("")
    return figure


def _letters(across: float, columns: int = 1) -> int:
    """Number of letters in a line below one of some panels [inch]."""
    return int(across / columns / _LETTER)


@dataclass(frozen=True)
class _Values:
    """Largest values of a scalar, their errors, and the runs without a result, in their order."""

    name: str
    unit: ReadableUnit
    values: Floats
    errors: Floats
    missing: Bools

    @classmethod
    def of(cls, ds: xr.Dataset, name: str, *order: str) -> _Values:
        arrays = (*largest_values(ds, name), ds["state"] != "done")
        found = [each.transpose(*order).values for each in arrays]
        values, errors, missing = found if len(order) > 1 else (each.ravel() for each in found)
        return cls(name, readable_unit(SCALARS[name].units, values), values, errors, missing)

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
        # Values that depend on the mesh of each run are no curve.
        sure = np.where(marked, np.nan, values)
        axes.plot(places, sure, "o-" if joined else "o", color=colour, markersize=size, label=label)
        hollow: dict[str, Any] = {
            "markerfacecolor": "white",
            "markeredgecolor": colour,
            "markersize": size,
        }
        axes.plot(places[marked], values[marked], "o", color=colour, **hollow)
        missing = places[self.missing if row is None else self.missing[:, row]]
        low = axes.get_xaxis_transform()
        axes.plot(
            missing, np.full(missing.size, 0.02), "x", color=colour, markersize=4, transform=low
        )
        bars = np.where(np.isfinite(errors), errors, 0.0)
        if (bars > 0).any():
            axes.errorbar(places, values, bars, fmt="none", ecolor=colour, elinewidth=0.8)
        axes.set_ylabel(self.unit.label(SCALARS[self.name].label))


def _draw_curves(
    axes: Axes, ds: xr.Dataset, name: str, axis: KeyAxis, key: str, by: str | None = None
) -> None:
    """Curves of a scalar over a key, one for each value of another one."""
    places = axis.at(ds[key].values)
    if by is None:
        _Values.of(ds, name, key).draw(axes, places, style.LINE, joined=not axis.texts)
    else:
        values, labels = _Values.of(ds, name, key, by), key_labels(ds, by)
        few = len(labels) <= _MOST_CURVES
        looks = styles_of(labels) if few else ()
        colours = [look["color"] for look in looks] or style.time_colours(len(labels))
        for row, (label, colour) in enumerate(zip(labels, colours, strict=True)):
            label = label if few or row in (0, len(labels) - 1) else ""
            values.draw(axes, places, colour, joined=not axis.texts, row=row, label=label)


def _draw_map(axes: Axes, ds: xr.Dataset, name: str, across: KeyAxis, key: str, by: str) -> None:
    """Contours of a scalar over two keys, with a dot for each run."""
    found, up = _Values.of(ds, name, by, key), KeyAxis.of(ds, by)
    x, y = across.at(ds[key].values), up.at(ds[by].values)
    values = np.ma.masked_invalid(found.unit(found.values))
    drawn = axes.contourf(x, y, values, _CONTOURS, cmap="viridis")
    bar = style.figure_of(axes).colorbar(drawn, ax=axes)
    bar.ax.tick_params(labelsize=style.TICK_SIZE)
    has_value = ~np.ma.getmaskarray(values)
    points_x, points_y = np.meshgrid(x, y)
    axes.plot(points_x[has_value], points_y[has_value], ".", color="white", markersize=2.0)
    axes.plot(points_x[found.missing], points_y[found.missing], "x", color=style.INK, markersize=3)
    axes.set_ylabel(up.unit.label(up.name))
    if up.is_log:
        axes.set_yscale("log")
        place_log_ticks(axes.yaxis, up.span)
    style.add_heading(axes, found.unit.label(SCALARS[name].label))
