"""Pressure over distance from the axis of a round contact, computed and exact."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.bodies.indenters import Indenter
from viscontact.drawing.content.exact_history import exact_label, exact_sphere
from viscontact.drawing.content.notes import peak_note
from viscontact.drawing.content.panel import TEXT, Axis, Curve, Ink, Mark, Panel
from viscontact.reference import LeeRadokContact
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.snapshots import Snapshot, labels_of, take_snapshots
from viscontact.units.formatting import ReadableUnit, format_quantity, readable_unit

_NAME = "pressure-radial"
_EXACT_POINTS = 160
#: Room beyond the largest values on both axes, as a factor.
_ROOM = 1.05
#: Most markers of a curve; of more cells, every so many has one.
_MARKERS = 26


def radial_panels(results: xr.Dataset, times: ArrayLike | None) -> list[Panel]:
    """Panels of the pressure, and of the difference from Lee and Radok's where they apply."""
    snapshots = take_snapshots(results, times, _NAME)
    furthest = max(each.extent()[1] for each in snapshots if each.touching)
    _require_round(results, furthest)
    exact, curves, differences = exact_sphere(results, _NAME), list[Curve](), list[Curve]()
    label = exact_label(results, "Lee–Radok", _NAME)
    places = np.linspace(0.0, 1.0, len(snapshots)).tolist()
    each = zip(snapshots, labels_of(snapshots), places, strict=True)
    for number, (snapshot, name, place) in enumerate(each):
        ink, (r, ours) = Ink("ordered", place), _near_x_axis(snapshot)
        if exact is None:  # something to guide the eye from marker to marker
            curves.append(Curve(r, ours, ink=ink, look="thin"))
        else:
            radius = float(exact.contact_radius(snapshot.time))
            curves.append(_exact_curve(exact, snapshot.time, label, ink))
            inner = r < radius - snapshot.cell_size[0]
            if inner.any():
                theirs = np.asarray(exact.pressure(r[inner], snapshot.time))
                part = (ours[inner] - theirs) / theirs.max()
                differences.append(_markers(r[inner], part, "", ink, number))
        curves.append(_markers(r, ours, name, ink, number))
    outer, top = (
        float(max(each.max(initial=0.0) for each in of))
        for of in ([curve.x for curve in curves], [curve.y for curve in curves])
    )
    x = Axis("Distance from the axis", readable_unit("m", furthest), (0.0, _ROOM * outer))
    unit = readable_unit("Pa", *(snapshot.pressure for snapshot in snapshots))
    note = peak_note([results], [snapshot.time for snapshot in snapshots])
    above = Panel(x, Axis("Pressure", unit, (0.0, _ROOM * top)), tuple(curves), note=note)
    if exact is None:
        return [above]
    of_peak, zero = Axis("Difference", ReadableUnit("% of peak", 0.01)), Mark(0.0, "y", ink=TEXT)
    note = "cells at the edge left out"
    return [above, Panel(x, of_peak, tuple(differences), marks=(zero,), note=note)]


def _markers(r: Floats, values: Floats, name: str, ink: Ink, number: int) -> Curve:
    every = slice(None, None, max(1, -(-r.size // _MARKERS)))
    return Curve(r[every], values[every], name, ink, "white", symbol=number)


def _exact_curve(exact: LeeRadokContact, time: float, name: str, ink: Ink) -> Curve:
    # Closer together towards the rim, where the pressure falls like a square root.
    r = float(exact.contact_radius(time)) * np.sin(np.linspace(0.0, np.pi / 2, _EXACT_POINTS))
    return Curve(r, np.asarray(exact.pressure(r, time)), name, ink)


def _require_round(results: xr.Dataset, radius: float) -> None:
    indenter = recorded_object(results, "indenter", _NAME)
    kind = type(indenter).__name__
    if not _is_round(indenter, radius):
        raise ValueError(
            f"{_NAME}: needs a body of revolution, got a {kind} that is not; "
            "draw pressure-profile instead"
        )
    offset = np.hypot(results["eccentricity_x"].values, results["eccentricity_y"].values)
    if np.nanmax(offset / np.maximum(results["contact_length"].values, 1e-300)) > 1e-3:
        raise ValueError(
            f"{_NAME}: needs a load on the axis, got one up to "
            f"{format_quantity(np.nanmax(offset), 'm')} off it; draw pressure-profile instead"
        )


def _is_round(indenter: Indenter, radius: float) -> bool:
    distance = radius * np.linspace(0.1, 1.0, 10)
    angle = np.linspace(0.0, np.pi, 9)[:, None]
    gaps = indenter.gap(distance * np.cos(angle), distance * np.sin(angle))
    return bool(np.allclose(gaps, gaps[0], rtol=1e-9, atol=0.0))


def _near_x_axis(snapshot: Snapshot) -> tuple[Floats, Floats]:
    """Distance and pressure of the cells in contact next to the positive x axis."""
    row = int(np.argmin(np.abs(snapshot.y)))
    chosen = (snapshot.x >= 0) & snapshot.in_contact[:, row]
    r = np.hypot(snapshot.x[chosen], snapshot.y[row])
    return r, snapshot.pressure[chosen, row]
