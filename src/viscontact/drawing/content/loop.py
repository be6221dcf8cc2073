"""Loops of runs: force over approach, resistance over position."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.ordered_names import inks_of
from viscontact.drawing.content.panel import FAINT, FIRST, SECOND, Axis, Curve, Ink, Panel, Units
from viscontact.results.last_cycle_values import LoadCycle, last_cycle
from viscontact.results.recorded_case import case_of, is_prescribed
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.run_axis import run_axis
from viscontact.results.shown_scalars import lacks_datum
from viscontact.results.stated_errors import drawn_values, is_rounding, stated_error
from viscontact.results.variables import SCALARS, shown_name
from viscontact.units.formatting import format_quantity, readable_unit

#: Relative change below which a force is steady, and its level over the length of the axis.
_STEADY, _ABOVE = 1e-4, 1.15


@dataclass(frozen=True)
class Loop:
    """Two scalars of a run over each other, and the instants of the last cycle."""

    name: str
    along: str  # scalar on the horizontal axis [m]
    value: str  # scalar on the vertical axis [N]
    area: str = "loss"  # what the area inside is
    last: int = 0  # indices of the first and last instant; without cycles, of all
    end: int = -1


def loops_of(run: xr.Dataset) -> list[Loop]:
    """Return force over approach of a cyclic load, and resistance over position along each axis."""
    # Resistance has a loop along axes on which the body turns back; over speed nothing has one.
    if not run_axis(run).is_history:
        return []
    found = [_resistance(run, axis) for axis in "xy" if _turns_back(run, axis)]
    cycle = last_cycle(run, least=1)
    if cycle is None or lacks_datum(run):
        return found
    return [_hysteresis(cycle), *found]


def loop_panel(runs: Mapping[str, xr.Dataset], loop: Loop, units: Units = readable_unit) -> Panel:
    """Panel of whole loops of runs by name, with the errors of both scalars."""
    curves = tuple(
        _curve(run, loop, name, ink)
        for (name, run), ink in zip(runs.items(), inks_of(list(runs)), strict=True)
    )
    note = _last_loss(list(runs.values())) if loop.value == "force" else ""
    return _panel(loop, curves, units, note)


def cycle_panel(
    run: xr.Dataset, loop: Loop, units: Units = readable_unit, reference: xr.Dataset | None = None
) -> Panel:
    """Panel of a loop whose last cycle stands out, beside that of a reference."""
    whole = _curve(run, loop, "", FIRST)
    parts = (
        (slice(0, loop.last + 1), FAINT),
        (slice(loop.last, loop.end + 1), FIRST),
        (slice(loop.end, None), FAINT),
    )
    curves = tuple(Curve(whole.x[part], whole.y[part], ink=ink) for part, ink in parts)
    if reference is not None:
        curves = (_curve(reference, loop, "", SECOND), *curves)
    bold = "Bold: the last cycle. " if loop.last or -1 < loop.end < whole.x.size - 1 else ""
    return _panel(loop, curves, units, f"{bold}The area inside is the {loop.area} of a cycle.")


def _panel(loop: Loop, curves: tuple[Curve, ...], units: Units, note: str) -> Panel:
    across, up = SCALARS[loop.along], SCALARS[loop.value]
    return Panel(
        Axis(across.label, units(across.units, *(curve.x for curve in curves))),
        Axis(up.label, units(up.units, *(curve.y for curve in curves)), _limits(curves)),
        curves,
        note=note,
        name=loop.name,
    )


def _curve(run: xr.Dataset, loop: Loop, name: str, ink: Ink) -> Curve:
    error, error_x = (
        None if is_prescribed(run, scalar) else stated_error(run, scalar)
        for scalar in (loop.value, loop.along)
    )
    x = np.asarray(run[loop.along].values, dtype=np.float64)
    y = drawn_values(run, loop.value)
    return Curve(x, y, name, ink, error=error, error_x=error_x)


def _limits(curves: tuple[Curve, ...]) -> tuple[float, float] | None:
    """Axis from zero where the force is steady, so that rounding does not fill it."""
    values = np.concatenate([curve.y[np.isfinite(curve.y)] for curve in curves])
    if not values.size or np.ptp(values) > _STEADY * abs(values.max()):
        return None
    return 0.0, _ABOVE * float(values.max()) or 1.0


def _turns_back(run: xr.Dataset, axis: str) -> bool:
    if f"position_{axis}" not in run or is_rounding(run, f"resistance_{axis}"):
        return False
    ways = np.diff(run[f"position_{axis}"].values)
    return bool((ways > 0).any() and (ways < 0).any())


def _resistance(run: xr.Dataset, axis: str) -> Loop:
    scalars = f"position_{axis}", shown_name(f"resistance_{axis}", run)
    return Loop(f"loop-{axis}", *scalars, "motion work", *_ends(run))


def _hysteresis(cycle: LoadCycle) -> Loop:
    return Loop("loop-force", "approach", "force", "loss", cycle.first, cycle.last)


def _ends(run: xr.Dataset) -> tuple[int, int]:
    """Indices of first and last instant of the motion's last complete cycle, or of the run."""
    times = run["time"].values
    moves = case_of(run).get("motion")
    cycles = recorded_object(run, "motion", "resistance").cycles if moves else ()
    whole = [(begin, end) for (begin, _), (end, _) in cycles if end <= times[-1] * (1 + 1e-9)]
    ends = whole[-1] if whole else times[[0, -1]]
    first, last = (int(np.abs(times - each).argmin()) for each in ends)
    return first, last


def _last_loss(runs: list[xr.Dataset]) -> str:
    """Loss of the last complete cycle of a single run, in words."""
    if len(runs) > 1 or "loss_per_cycle" not in runs[0]:
        return ""
    name = shown_name("loss_per_cycle", runs[0])
    losses, unit = runs[0][name].values, SCALARS[name].units
    known = losses[np.isfinite(losses)]
    return f"loss per cycle {format_quantity(float(known[-1]), unit, 3)}" if known.size else ""
