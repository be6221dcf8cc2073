"""Tractions along a line through the contact, between friction times pressure."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.panel import Axis, Curve, Ink, Panel
from viscontact.drawing.content.slip_states import SlipState, slip_states
from viscontact.results.fretting import recorded_friction
from viscontact.results.recorded_case import across_period
from viscontact.results.snapshots import field_at
from viscontact.units.formatting import readable_unit

#: Room beside the contact over its extent.
_MARGIN = 0.06

_Along = Literal["x", "y"]


def traction_panel(
    run: xr.Dataset, times: ArrayLike | None, along: _Along | None, at: float | None, figure: str
) -> Panel:
    """Panel of the larger component on a line, between friction times pressure on both sides."""
    shown = slip_states(run, times, figure)
    way, tractions = _larger_component(shown, figure)
    line = along or across_period(run) or way
    friction = recorded_friction(run, figure).coefficient
    inks = [Ink("ordered", place) for place in np.linspace(0.0, 1.0, len(shown)).tolist()]
    curves = tuple(
        curve
        for each, traction, ink in zip(shown, tractions, inks, strict=True)
        for curve in _curves(each, (traction, friction * each.shown.pressure), (line, at), ink)
    )
    reached = np.concatenate([each.x[np.isfinite(each.y)] for each in curves])
    margin = _MARGIN * float(np.ptp(reached))
    limits = float(reached.min()) - margin, float(reached.max()) + margin
    return Panel(
        Axis(line, readable_unit("m", limits), limits),
        Axis.of(f"Traction along {way}", "Pa", *(each.y[np.isfinite(each.y)] for each in curves)),
        curves,
        note="dotted: ± friction coefficient times pressure",
    )


def _larger_component(shown: list[SlipState], figure: str) -> tuple[_Along, list[Floats]]:
    """Direction of the larger component of the tractions, and this component at instants [Pa]."""
    x, y = (
        [field_at(each.run, f"traction_{axis}", each.shown.time, figure) for each in shown]
        for axis in "xy"
    )
    larger_x = max(np.abs(each).max() for each in x) >= max(np.abs(each).max() for each in y)
    return ("x", x) if larger_x else ("y", y)


def _curves(
    state: SlipState,
    fields: tuple[Floats, Floats],
    place: tuple[_Along, float | None],
    ink: Ink,
) -> Iterator[Curve]:
    """Yield a traction within the contact, and its bound on both sides."""
    shown = state.shown
    (positions, traction), (_, bound) = (shown.line(field, *place) for field in fields)
    _, touched = shown.contact_section(*place)
    # The zeros next to the contact belong to the curves.
    near = touched | np.append(touched[1:], False) | np.append(False, touched[:-1])
    traction, bound = (np.where(near, values, np.nan) for values in (traction, bound))
    yield Curve(positions, traction, state.label, ink)
    for side in (bound, -bound):
        yield Curve(positions, side, "", ink, "dotted")
