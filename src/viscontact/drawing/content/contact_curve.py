"""Curves along an axis of the contact at several instants, of one run or of several."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Literal

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.compared_runs import Runs, runs_of
from viscontact.drawing.content.notes import peak_note
from viscontact.drawing.content.ordered_names import inks_of
from viscontact.drawing.content.panel import Axis, Curve, Ink, Mark, Panel
from viscontact.results.recorded_case import across_period, recorded_ends
from viscontact.results.recorded_motion import contact_edges, direction_at, motion_axis
from viscontact.results.snapshots import Snapshot, labels_of, take_snapshots
from viscontact.results.variables import MESH_DEPENDENT
from viscontact.units.formatting import readable_unit

#: Positions [m], on a periodic grid slightly beyond the border, a quantity [SI], and contact.
ContactLine = tuple[Floats, Floats, Bools]


@dataclass(frozen=True)
class ContactCurve:
    """A quantity along an axis of the contact."""

    figure: str  # the name of its figure
    label: str
    units: str  # SI
    along: Literal["x", "y"]
    line: Callable[[Snapshot], ContactLine]
    largest: Callable[[Snapshot], float]  # which its unit is chosen for
    note: str  # of runs whose peak pressure depends on the mesh
    marks_edges: bool = False  # the leading and the trailing one of a moving contact


def cut_at_ends(
    snapshot: Snapshot, along: Literal["x", "y"], at: float | None, line: ContactLine
) -> ContactLine:
    """Line along an axis, falling to zero where the body ends, not at the next centre."""
    # The end is that on the row of cells next to `at` [m] on the other axis, by default the middle.
    positions, values, touched = line
    if snapshot.body_end is None:
        return line
    axis = 0 if along == "x" else 1
    across = (snapshot.y, snapshot.x)[axis]
    row = int(np.abs(across - (snapshot.middle[1 - axis] if at is None else at)).argmin())
    ends = (snapshot.body_end.along_x, snapshot.body_end.along_y.T)[axis][:, row]
    places, found = [], []
    for before in np.flatnonzero(np.isfinite(ends)):
        inner, outer = (before, before + 1) if touched[before] else (before + 1, before)
        if touched[inner] and not touched[outer]:
            end = positions[inner] + ends[before] * (positions[outer] - positions[inner])
            # From the left, the value precedes the zero.
            places.append((before + 1, end, end))
            found.append((values[inner], 0.0) if inner < outer else (0.0, values[inner]))
    for (index, *ends_at), pair in reversed(list(zip(places, found, strict=True))):
        positions = np.insert(positions, [index, index], ends_at)
        values = np.insert(values, [index, index], pair)
        touched = np.insert(touched, [index, index], np.array(pair) != 0)
    return positions, values, touched


def contact_panels(results: Runs, curve: ContactCurve, times: ArrayLike | None) -> list[Panel]:
    """Panel with a curve for each instant; of several runs a panel for each instant."""
    if isinstance(results, xr.Dataset):
        return [_at_instants(results, curve, times)]
    runs = runs_of(results, curve.figure)
    first = take_snapshots(next(iter(runs.values())), times, curve.figure, count=2)
    shown = [
        {name: take_snapshots(run, each.time, curve.figure)[0] for name, run in runs.items()}
        for each in first
    ]
    x, y = _axes([each for snapshots in shown for each in snapshots.values()], curve)
    inks = inks_of(list(runs))
    return [
        Panel(
            *(x, y),
            tuple(
                _curve(snapshot, curve, name, ink)
                for (name, snapshot), ink in zip(snapshots.items(), inks, strict=True)
            ),
            marks=_marks(runs.values(), curve, x.limits),
            title=_instants_label(snapshots),
            note=_note(runs.values(), [at.time], curve),
        )
        for at, snapshots in zip(first, shown, strict=True)
    ]


def _at_instants(run: xr.Dataset, curve: ContactCurve, times: ArrayLike | None) -> Panel:
    """Panel of a run, with its leading and trailing edges along a motion."""
    snapshots = take_snapshots(run, times, curve.figure)
    inks = [Ink("ordered", place) for place in np.linspace(0.0, 1.0, len(snapshots)).tolist()]
    each = list(zip(snapshots, labels_of(snapshots), inks, strict=True))
    curves = [_curve(snapshot, curve, label, ink) for snapshot, label, ink in each]
    note = _note([run], [snapshot.time for snapshot in snapshots], curve)
    if curve.marks_edges and motion_axis(run) == curve.along:
        curves += [edge for snapshot, _, ink in each for edge in _edges(run, snapshot, curve, ink)]
        note = "; ".join(filter(None, ("● leading, ○ trailing edge", note)))
    x, y = _axes(snapshots, curve)
    return Panel(x, y, tuple(curves), marks=_marks([run], curve, x.limits), note=note)


def _marks(
    runs: Iterable[xr.Dataset], curve: ContactCurve, limits: tuple[float, float] | None
) -> tuple[Mark, ...]:
    """Lines at the ends of the bodies, along x and within limits [m]."""
    if curve.along != "x" or limits is None:
        return ()
    ends = dict.fromkeys(end.place for run in runs for end in recorded_ends(run))
    return tuple(Mark(place, look="dotted") for place in ends if limits[0] < place < limits[1])


def _curve(snapshot: Snapshot, curve: ContactCurve, name: str, ink: Ink) -> Curve:
    positions, values, touched = curve.line(snapshot)
    # The zeros next to the contact belong to the curve.
    near = touched | np.append(touched[1:], False) | np.append(False, touched[:-1])
    return Curve(positions, np.where(near, values, np.nan), name, ink)


def _edges(run: xr.Dataset, snapshot: Snapshot, curve: ContactCurve, ink: Ink) -> Iterator[Curve]:
    """Yield the leading and the trailing edge of a moving contact; none at rest."""
    direction = direction_at(run, snapshot.time)
    way = 0.0 if direction is None else direction["xy".index(curve.along)]
    positions, _, touched = curve.line(snapshot)
    edges = contact_edges(positions, touched, way)
    if edges is not None:
        leading, trailing = (np.array([edge]) for edge in edges)
        yield Curve(leading, np.zeros(1), ink=ink, look="leading", is_on_top=True)
        yield Curve(trailing, np.zeros(1), ink=ink, look="trailing", is_on_top=True)


def _note(runs: Iterable[xr.Dataset], times: ArrayLike, curve: ContactCurve) -> str:
    return curve.note if peak_note(runs, times) else ""


def _instants_label(snapshots: Mapping[str, Snapshot]) -> str:
    shown = {snapshot.time: snapshot for snapshot in snapshots.values()}
    ordered = [shown[instant] for instant in sorted(shown)]
    return ordered[0].axis.symbol + ", ".join(labels_of(ordered))


def _axes(snapshots: list[Snapshot], curve: ContactCurve) -> tuple[Axis, Axis]:
    """Axis along the contact, and that of the quantity."""
    limits = _limits(snapshots, curve.along)
    along = Axis(curve.along, readable_unit("m", limits), limits)
    return along, Axis.of(curve.label, curve.units, [curve.largest(each) for each in snapshots])


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


def pressure_curve(
    results: Runs, along: Literal["x", "y"] | None, at: float | None, figure: str
) -> ContactCurve:
    """Pressure along a line up to the ends of the body, by default along the motion."""
    first = next(iter(runs_of(results, figure).values()))
    way = along or motion_axis(first) or across_period(first) or "x"

    def section(snapshot: Snapshot) -> ContactLine:
        # On a periodic grid continued by a cell.
        shown = snapshot.with_border(1) if any(snapshot.periodic) else snapshot
        (positions, values), (_, touched) = shown.section(way, at), shown.contact_section(way, at)
        return cut_at_ends(shown, way, at, (positions, values, touched))

    return ContactCurve(
        *(figure, "Pressure", "Pa", way, section),
        largest=lambda snapshot: float(snapshot.pressure.max()),
        note=f"peak {MESH_DEPENDENT}",
        marks_edges=True,
    )


def _line_load(snapshot: Snapshot) -> ContactLine:
    (x, load), touched = snapshot.line_load(), np.asarray(snapshot.in_contact.any(axis=1))
    cell, _ = snapshot.cell_size
    if snapshot.periodic[0]:
        beyond = np.concatenate([x[:1] - cell, x, x[-1:] + cell])
        return beyond, np.pad(load, 1, mode="wrap"), np.pad(touched, 1, mode="wrap")
    inside = np.flatnonzero(touched)
    if not inside.size:
        return x, load, touched
    # The contact ends within half a cell of the border of its last cells.
    rows = slice(int(inside[0]), int(inside[-1]) + 1)
    ends = x[inside[0]] - cell / 2, x[inside[-1]] + cell / 2
    positions = np.concatenate([ends[:1], x[rows], ends[1:]])
    return positions, np.pad(load[rows], 1), np.pad(touched[rows], 1)


LINE_LOAD = ContactCurve(
    *("line-load", "Line load", "N/m", "x", _line_load),
    largest=lambda snapshot: float(snapshot.line_load()[1].max()),
    note=f"at a sharp end it {MESH_DEPENDENT}",
)
