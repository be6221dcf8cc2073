"""Fretting: loops of force over shift, heat of their cycles, and slip over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.along_run import along_run, within_span
from viscontact.drawing.content.history import history_panel
from viscontact.drawing.content.panel import FAINT, FIRST, PERCENT, SECOND, Axis, Curve, Ink, Panel
from viscontact.results.fretting import (
    FrettingCycle,
    acting_directions,
    fretting_cycles,
    require_grip,
    slip_over_time,
)
from viscontact.results.shown_scalars import lacks_datum
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import ReadableUnit, format_quantity, readable_unit

#: Most cycles that are named one by one.
_NAMED = 6


def fretting_panels(run: xr.Dataset, times: ArrayLike | None, figure: str) -> list[Panel]:
    """Panel of the loop in each direction, and of the heat of each cycle if there are several."""
    require_grip(run, figure)
    if lacks_datum(run):
        raise ValueError(f"{figure}: the shift of a line contact has no datum; draw history")
    directions = acting_directions(run)
    if not directions:
        raise ValueError(f"{figure}: no tangential load acts during this run")
    names = [*(name for pair in directions for name in pair), "friction_heat"]
    shown = within_span(run, names, times, figure, "")
    first, last = shown["time"].values[[0, -1]] * np.array([1 - 1e-9, 1 + 1e-9])
    cycles = [
        each for each in fretting_cycles(run, figure) if first <= each.begin and each.end <= last
    ]
    panels = [_loop(shown, force, shift, cycles) for force, shift in directions]
    return [*panels, _heats(cycles)] if len(cycles) > 1 else panels


def _loop(run: xr.Dataset, force: str, shift: str, cycles: Sequence[FrettingCycle]) -> Panel:
    """Force over shift: the whole way, with the cycles on it."""
    times, x, y = (run[name].values for name in ("time", shift, force))
    curves = [Curve(x, y, "", FAINT, "thin") if cycles else Curve(x, y, "", FIRST)]
    for number, cycle in enumerate(cycles):
        inside = _between(times, cycle)
        ink = Ink("ordered", number / max(1, len(cycles) - 1)) if len(cycles) > 1 else FIRST
        name = _name(number, cycle) if _is_named(number, len(cycles)) else ""
        curves.append(Curve(x[inside], y[inside], name, ink))
    return Panel(
        Axis.of(SCALARS[shift].label, SCALARS[shift].units, x),
        Axis.of(SCALARS[force].label, SCALARS[force].units, y),
        tuple(curves),
        name=f"fretting-{force}",
    )


def _between(times: Floats, cycle: FrettingCycle) -> slice:
    first, last = (int(np.abs(times - at).argmin()) for at in (cycle.begin, cycle.end))
    return slice(first, last + 1)


def _is_named(number: int, count: int) -> bool:
    return count <= _NAMED or number in (0, count - 1)


def _name(number: int, cycle: FrettingCycle) -> str:
    return f"cycle {number + 1}: {format_quantity(cycle.heat, 'J', 3)}"


def _heats(cycles: Sequence[FrettingCycle]) -> Panel:
    """Heat of friction of each cycle."""
    heats, errors = (
        np.array([getattr(each, name) for each in cycles]) for name in ("heat", "error")
    )
    unit, numbers = readable_unit("J", heats), np.arange(1.0, len(cycles) + 1)
    most = 1.2 * float((heats + np.nan_to_num(errors)).max()) or 1.0
    return Panel(
        Axis("Cycle", ReadableUnit("-", 1.0), (0.5, len(cycles) + 0.5)),
        Axis("Heat of the cycle", unit, (0.0, most)),
        (Curve(numbers, heats, "", FIRST, "points", error=errors),),
        name="fretting-heat",
    )


def slip_panels(run: xr.Dataset, times: ArrayLike | None, figure: str) -> list[Panel]:
    """Panels of the part that slips and, where fields are stored, of the slip of the cells."""
    require_grip(run, figure)
    shown = within_span(run, ["slip_fraction"], times, figure, "")
    fraction = history_panel({"": shown}, "slip_fraction")
    panels = [replace(fraction, y=Axis(fraction.y.quantity, PERCENT, fraction.y.limits))]
    slip = slip_over_time(run)
    if slip is None:
        return panels
    first, last = shown["time"].values[[0, -1]]
    inside = (slip.times >= first) & (slip.times <= last)
    curves = tuple(
        Curve(slip.times[inside], values[inside], name, ink, "joined")
        for values, name, ink in (
            (slip.largest, "largest of all cells", FIRST),
            (slip.mean, "mean of the contact", SECOND),
        )
    )
    return [
        *panels,
        Panel(along_run([shown]), Axis.of("Slip", "m", slip.largest), curves, name="slip"),
    ]
