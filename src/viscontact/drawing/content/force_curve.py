"""Force curve of bodies that adhere: force over approach, with jumps and the limits of spheres."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.along_run import within_span
from viscontact.drawing.content.panel import FAINT, FIRST, SECOND, Axis, Curve, Mark, Panel
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.shown_scalars import lacks_datum
from viscontact.results.stated_errors import stated_error
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import format_quantity

#: Pull-off forces of a sphere over π w R in the limits of short and of long ranges.
_LIMITS = {"JKR": 1.5, "DMT": 2.0}

#: Largest ratio of the curvatures of a body that counts as a sphere [-].
_ROUND = 1 + 1e-9


def adheres(run: xr.Dataset) -> bool:
    """True for bodies that adhere, whose approach has a datum."""
    return "least_pressure" in run and not lacks_datum(run)


def force_curve_panel(run: xr.Dataset, times: ArrayLike | None, figure: str) -> Panel:
    """Panel of force over approach, on the way in and out, with the jumps between them."""
    if not adheres(run):
        raise ValueError(
            f"{figure}: needs bodies that adhere and an approach with a datum; give adhesion, or "
            "draw history or hysteresis"
        )
    shown = within_span(run, ["force", "approach"], times, figure, "")
    jumps = _jumps(run)
    approach, force, error = _with_jumps(shown, jumps)
    turn = int(np.nanargmax(approach))
    ways = ((slice(0, turn + 1), "approach", FIRST), (slice(turn, None), "retraction", SECOND))
    curves = [
        Curve(approach[way], force[way], name, ink, error=error[way])
        for way, name, ink in ways
        if approach[way].size > 1
    ]
    curves += [Curve(each.approach, each.force, "", FAINT, "thin") for each in jumps]
    across, up = SCALARS["approach"], SCALARS["force"]
    return Panel(
        Axis.of(across.label, across.units, approach[np.isfinite(approach)]),
        Axis.of(up.label, up.units, force),
        tuple(curves),
        marks=_limits(run, figure),
        note=_pull_off(run),
        name="force-curve",
    )


class Jump(NamedTuple):
    """Jump into contact or off."""

    time: float  # [s]
    approach: Floats  # before and after it [m]
    force: Floats  # [N]


def _jumps(run: xr.Dataset) -> list[Jump]:
    """Jumps of a run whose both sides are known."""
    times, approaches, forces = (
        np.atleast_1d(run.attrs.get(name, [])).astype(float)
        for name in ("event_times", "event_approach", "event_force")
    )
    pairs = zip(times, approaches.reshape(-1, 2), forces.reshape(-1, 2), strict=True)
    return [Jump(float(t), x, y) for t, x, y in pairs if np.isfinite([*x, *y]).all()]


def _with_jumps(shown: xr.Dataset, jumps: Sequence[Jump]) -> tuple[Floats, Floats, Floats]:
    """Approach, force and its error at the instants, with both sides of each jump and a gap."""
    times = shown["time"].values
    found = (shown["approach"].values, shown["force"].values, stated_error(shown, "force"))
    columns = [np.full(times.size, np.nan) if each is None else each for each in found]
    for jump in sorted(jumps, key=lambda each: each.time, reverse=True):
        at = int(np.searchsorted(times, jump.time, side="left"))
        sides = (jump.approach, jump.force, np.full(2, np.nan))
        if 0 < at < times.size:
            columns = [
                np.insert(column, at, [before, np.nan, after])
                for column, (before, after) in zip(columns, sides, strict=True)
            ]
    approach, force, error = columns
    return approach, force, error


def _limits(run: xr.Dataset, figure: str) -> tuple[Mark, ...]:
    """Pull-off forces of elastic spheres in the limits of short and long ranges."""
    indenter = recorded_object(run, "indenter", figure)
    adhesion = recorded_object(run, "adhesion", figure)
    curvatures = sorted(getattr(indenter, "curvatures", (0.0, 0.0)))
    if adhesion is None or curvatures[0] <= 0 or curvatures[1] > _ROUND * curvatures[0]:
        return ()
    unit = math.pi * adhesion.work / curvatures[0]
    return tuple(
        Mark(-factor * unit, "y", name, "dashed", is_text_below=True)
        for name, factor in _LIMITS.items()
    )


def _pull_off(run: xr.Dataset) -> str:
    """Pull-off force with its error; empty where contact was not lost."""
    force = float(run.attrs.get("pull_off_force", math.nan))
    if math.isnan(force):
        return ""
    error = float(run.attrs.get("pull_off_force_error", math.nan))
    stated = "" if math.isnan(error) else f" ± {format_quantity(error, 'N', 2)}"
    return f"Pull-off force {format_quantity(force, 'N', 4)}{stated}"
