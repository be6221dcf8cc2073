"""Sections through the pressure (the paper's Figs. 10, 13 and 16)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from viscontact.plot.layout import style
from viscontact.plot.layout.compared_runs import require_runs
from viscontact.plot.layout.error_band import peak_note
from viscontact.plot.layout.page import Width, page_width
from viscontact.results.snapshots import Snapshot, take_snapshots
from viscontact.units.formatting import ReadableUnit, readable_unit, time_labels

_NAME = "pressure-profile"


def pressure_profile(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] = "x",
    at: float = 0.0,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the pressure on a line through the contact at several instants.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default five, from the
        first in contact to the last.
    along : {"x", "y"}, optional
        Direction of the line: along a roller, or across it.
    at : float, optional
        Position of the line on the other axis [m]; between two rows of cells the pressure is
        interpolated.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One line per instant.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch at these instants, or the line
        misses the grid.

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
    snapshots = take_snapshots(results, times, _NAME)
    if axes is None:
        wide = page_width(width, style.TWO_COLUMNS * 0.8)
        axes = style.new_figure(wide, min(3.0, 0.75 * wide)).add_subplot()
    length, pressure = _units(snapshots, along)
    labels = time_labels(s.time for s in snapshots)
    lines = []
    for snapshot, colour in zip(snapshots, style.time_colours(len(snapshots)), strict=True):
        positions, values = _in_contact(*_section(snapshot, along, at))
        lines += axes.plot(
            length(positions), pressure(values), color=colour, linewidth=style.LINE_WIDTH
        )
    _frame(axes, snapshots, along, length, pressure)
    drawn = [snapshot.time for snapshot in snapshots]
    style.add_heading(axes, peak_note([results], drawn), aside=True)
    style.add_legend(axes, lines, labels)
    return style.figure_of(axes)


def compare_pressure_profiles(
    runs: Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] = "x",
    at: float = 0.0,
    width: Width | None = None,
) -> Figure:
    """Overlay the pressure sections of several runs, one panel per instant.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print, with fields stored.
    times : array_like, optional
        Instants [s]; of each run the nearest stored ones are drawn. By default the first in
        contact and the last of the first run.
    along, at : optional
        Direction and position of the line, as for `pressure_profile`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Panels with common axes, one line per run.

    Raises
    ------
    ValueError
        If there are no runs, or one of them cannot be drawn.

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
    >>> axes = compare_pressure_profiles(runs, along="y").axes[-1]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('y [µm]', 'Pressure [kPa]')
    """
    require_runs(runs, _NAME)
    first = take_snapshots(next(iter(runs.values())), times, _NAME, count=2)
    instants = [snapshot.time for snapshot in first]
    figure = style.new_figure(page_width(width, style.TWO_COLUMNS), 2.2 * len(instants) + 0.4)
    panels = list(figure.subplots(len(instants), sharex=True, sharey=True, squeeze=False).flat)
    drawn = {
        name: [take_snapshots(run, instant, _NAME)[0] for instant in instants]
        for name, run in runs.items()
    }
    everything = [snapshot for snapshots in drawn.values() for snapshot in snapshots]
    length, pressure = _units(everything, along)
    for column, axes in enumerate(panels):
        at_instant = {name: snapshots[column] for name, snapshots in drawn.items()}
        looks = style.run_styles(len(runs))
        for snapshot, look in zip(at_instant.values(), looks, strict=True):
            positions, values = _in_contact(*_section(snapshot, along, at))
            axes.plot(length(positions), pressure(values), **look)
        _frame(axes, everything, along, length, pressure)
        style.add_heading(axes, _instants_label(at_instant))
        style.add_heading(axes, peak_note(runs.values(), [instants[column]]), aside=True)
    for axes in panels[:-1]:
        axes.set_xlabel("")
    style.add_legend_below(figure, panels[0].get_lines(), list(runs))
    return figure


def _section(
    snapshot: Snapshot, along: Literal["x", "y"], at: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Pressure on the line; on a periodic grid slightly beyond the border."""
    return (snapshot.with_border(1) if snapshot.periodic else snapshot).section(along, at)


def _instants_label(snapshots: Mapping[str, Snapshot]) -> str:
    instants = sorted({snapshot.time for snapshot in snapshots.values()})
    return "t = " + ", ".join(time_labels(instants))


def _units(
    snapshots: list[Snapshot], along: Literal["x", "y"]
) -> tuple[ReadableUnit, ReadableUnit]:
    length = readable_unit("m", _limits(snapshots, along))
    return length, readable_unit("Pa", *(snapshot.pressure for snapshot in snapshots))


def _limits(snapshots: list[Snapshot], along: Literal["x", "y"]) -> tuple[float, float]:
    """Ends of the longest contact along the line [m], with a margin within a period."""
    side = 0 if along == "x" else 2
    ends = np.array([s.extent()[side : side + 2] for s in snapshots if s.touching])
    low, high = float(ends[:, 0].min()), float(ends[:, 1].max())
    margin = 0.06 * (high - low)
    if not snapshots[0].periodic:
        return low - margin, high + margin
    borders = snapshots[0].borders()
    return max(low - margin, borders[side]), min(high + margin, borders[side + 1])


def _in_contact(
    positions: NDArray[np.float64], pressure: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Positions, and pressure with NaN outside the contact but for the zeros at its ends."""
    pressed = pressure > 0
    near = pressed | np.append(pressed[1:], False) | np.append(False, pressed[:-1])
    return positions, np.where(near, pressure, np.nan)


def _frame(
    axes: Axes,
    snapshots: list[Snapshot],
    along: Literal["x", "y"],
    length: ReadableUnit,
    pressure: ReadableUnit,
) -> None:
    axes.set(
        xlim=length(_limits(snapshots, along)),
        xlabel=length.label(along),
        ylabel=pressure.label("Pressure"),
    )
    axes.set_ylim(bottom=0.0)
    style.dress(axes)
