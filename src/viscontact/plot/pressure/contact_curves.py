"""Curves along an axis of the contact at several instants, of one run or of several."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.compared_runs import Runs, runs_of
from viscontact.drawing.content.notes import peak_note
from viscontact.plot.layout import style
from viscontact.plot.layout.page import Width, page_width
from viscontact.plot.layout.style import styles_of
from viscontact.results.recorded_motion import contact_edges, direction_at, motion_axis
from viscontact.results.snapshots import Snapshot, labels_of, take_snapshots
from viscontact.units.formatting import ReadableUnit, readable_unit


@dataclass(frozen=True)
class ContactCurve:
    """A quantity along an axis of the contact."""

    figure: str  # the name of its figure
    label: str
    units: str  # SI
    along: Literal["x", "y"]
    #: Positions [m], on a periodic grid slightly beyond the border, and the quantity [SI].
    values: Callable[[Snapshot], tuple[Floats, Floats]]
    largest: Callable[[Snapshot], float]  # which its unit is chosen for
    note: str  # of runs whose peak pressure depends on the mesh
    marks_edges: bool = (
        False  # with a mark at the leading and the trailing edge of a moving contact
    )


def cut_at_ends(
    snapshot: Snapshot, along: Literal["x", "y"], at: float | None, curve: tuple[Floats, Floats]
) -> tuple[Floats, Floats]:
    """The curve along an axis, falling to zero where the body ends, not at the next centre.

    The end is that on the row of cells next to `at` [m] on the other axis, by default the middle.
    """
    positions, values = curve
    if snapshot.body_end is None:
        return curve
    axis = 0 if along == "x" else 1
    across = (snapshot.y, snapshot.x)[axis]
    row = int(np.abs(across - (snapshot.middle[1 - axis] if at is None else at)).argmin())
    ends = (snapshot.body_end.along_x, snapshot.body_end.along_y.T)[axis][:, row]
    places, found = [], []
    for before in np.flatnonzero(np.isfinite(ends)):
        inner, outer = (before, before + 1) if values[before] > 0 else (before + 1, before)
        if values[inner] > 0 and values[outer] == 0:
            end = positions[inner] + ends[before] * (positions[outer] - positions[inner])
            # From the left, the value precedes the zero.
            places.append((before + 1, end, end))
            found.append((values[inner], 0.0) if inner < outer else (0.0, values[inner]))
    for (index, *ends_at), pair in reversed(list(zip(places, found, strict=True))):
        positions = np.insert(positions, [index, index], ends_at)
        values = np.insert(values, [index, index], pair)
    return positions, values


def draw_curves(
    results: Runs,
    curve: ContactCurve,
    times: ArrayLike | None,
    axes: Axes | None,
    width: Width | None,
) -> Figure:
    """Draw a curve for each of several instants; for each of several runs, a panel per instant."""
    if not isinstance(results, xr.Dataset):
        if axes is not None:
            raise ValueError(f"{curve.figure}: axes take a single result, got several")
        return _compared(runs_of(results, curve.figure), curve, times, width)
    snapshots = take_snapshots(results, times, curve.figure)
    if axes is None:
        wide = page_width(width, style.TWO_COLUMNS * 0.8)
        axes = style.new_figure(wide, min(3.0, 0.75 * wide)).add_subplot()
    units = _units(snapshots, curve)
    labels = labels_of(snapshots)
    colours = style.time_colours(len(snapshots))
    for snapshot, colour in zip(snapshots, colours, strict=True):
        _plot(axes, snapshot, curve, units, color=colour, linewidth=style.LINE_WIDTH)
    lines = axes.get_lines()[-len(snapshots) :]
    _frame(axes, snapshots, curve, units)
    note = _note([results], [s.time for s in snapshots], curve)
    if curve.marks_edges and motion_axis(results) == curve.along:
        for snapshot, colour in zip(snapshots, colours, strict=True):
            _mark_edges(axes, results, snapshot, curve, units, colour)
        note = "; ".join(filter(None, ("● leading, ○ trailing edge", note)))
    style.add_heading(axes, note, aside=True)
    style.add_legend(axes, lines, labels)
    return style.figure_of(axes)


def _compared(
    runs: Mapping[str, xr.Dataset],
    curve: ContactCurve,
    times: ArrayLike | None,
    width: Width | None,
) -> Figure:
    first = take_snapshots(next(iter(runs.values())), times, curve.figure, count=2)
    instants = [snapshot.time for snapshot in first]
    figure = style.new_figure(page_width(width, style.TWO_COLUMNS), 2.2 * len(instants) + 0.4)
    panels = list(figure.subplots(len(instants), sharex=True, sharey=True, squeeze=False).flat)
    drawn = {
        name: [take_snapshots(run, instant, curve.figure)[0] for instant in instants]
        for name, run in runs.items()
    }
    everything = [snapshot for snapshots in drawn.values() for snapshot in snapshots]
    units = _units(everything, curve)
    for column, axes in enumerate(panels):
        looks = styles_of(list(runs))
        for snapshots, look in zip(drawn.values(), looks, strict=True):
            _plot(axes, snapshots[column], curve, units, **look)
    # The panels share their limits, which the last curve may extend.
    for column, axes in enumerate(panels):
        at_instant = {name: snapshots[column] for name, snapshots in drawn.items()}
        _frame(axes, everything, curve, units)
        style.add_heading(axes, _instants_label(at_instant))
        style.add_heading(axes, _note(runs.values(), [instants[column]], curve), aside=True)
    for axes in panels[:-1]:
        axes.set_xlabel("")
    style.add_legend_below(figure, panels[0].get_lines(), list(runs))
    return figure


def under_pressure(values: Floats) -> Floats:
    """Values with NaN where they are zero, but for the zeros next to others."""
    pressed = values != 0
    near = pressed | np.append(pressed[1:], False) | np.append(False, pressed[:-1])
    return np.where(near, values, np.nan)


@dataclass(frozen=True)
class _Units:
    length: ReadableUnit
    values: ReadableUnit


def _plot(axes: Axes, snapshot: Snapshot, curve: ContactCurve, units: _Units, **look: Any) -> None:
    positions, values = curve.values(snapshot)
    axes.plot(units.length(positions), units.values(under_pressure(values)), **look)


def _mark_edges(
    axes: Axes,
    results: xr.Dataset,
    snapshot: Snapshot,
    curve: ContactCurve,
    units: _Units,
    colour: Any,
) -> None:
    """Mark the edges of a moving contact on its curve; none at rest."""
    direction = direction_at(results, snapshot.time)
    way = 0.0 if direction is None else direction["xy".index(curve.along)]
    positions, values = curve.values(snapshot)
    edges = contact_edges(positions, values != 0, way)
    for edge, fill in zip(edges or (), (colour, "white"), strict=False):  # the leading one first
        axes.scatter(
            units.length(edge), 0.0, s=16, color=fill, edgecolors=[colour], zorder=3, clip_on=False
        )


def _note(runs: Iterable[xr.Dataset], times: ArrayLike, curve: ContactCurve) -> str:
    return curve.note if peak_note(runs, times) else ""


def _instants_label(snapshots: Mapping[str, Snapshot]) -> str:
    shown = {snapshot.time: snapshot for snapshot in snapshots.values()}
    ordered = [shown[instant] for instant in sorted(shown)]
    return ordered[0].axis.symbol + ", ".join(labels_of(ordered))


def _units(snapshots: list[Snapshot], curve: ContactCurve) -> _Units:
    largest = [curve.largest(snapshot) for snapshot in snapshots]
    return _Units(
        readable_unit("m", _limits(snapshots, curve.along)), readable_unit(curve.units, largest)
    )


def _limits(snapshots: list[Snapshot], along: Literal["x", "y"]) -> tuple[float, float]:
    """Ends of the longest contact along the axis [m], with a margin within a period."""
    side = 0 if along == "x" else 2
    ends = np.array([s.extent()[side : side + 2] for s in snapshots if s.touching])
    low, high = float(ends[:, 0].min()), float(ends[:, 1].max())
    margin = 0.06 * (high - low)
    if not snapshots[0].periodic[side // 2]:
        return low - margin, high + margin
    borders = snapshots[0].borders()
    return max(low - margin, borders[side]), min(high + margin, borders[side + 1])


def _frame(axes: Axes, snapshots: list[Snapshot], curve: ContactCurve, units: _Units) -> None:
    axes.set(
        xlim=units.length(_limits(snapshots, curve.along)),
        xlabel=units.length.label(curve.along),
        ylabel=units.values.label(curve.label),
    )
    axes.set_ylim(bottom=0.0)
    style.dress(axes)
