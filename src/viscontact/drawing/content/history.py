"""Histories: the scalars of runs over time or speed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import xarray as xr

from viscontact.drawing.content.along_run import along_run
from viscontact.drawing.content.ordered_names import inks_of
from viscontact.drawing.content.panel import (
    PERCENT,
    SECOND,
    Aside,
    Axis,
    Curve,
    Ink,
    Mark,
    Panel,
    Units,
)
from viscontact.drawing.content.temperature_course import temperature_aside
from viscontact.mechanics.state import FRICTION, OF_CLOCKS
from viscontact.results.margins import PREFIX, margins
from viscontact.results.recorded_case import across_period, is_prescribed, prescribes_approach
from viscontact.results.recorded_events import recorded_events
from viscontact.results.recorded_motion import motion_axis
from viscontact.results.recorded_objects import recorded_temperature
from viscontact.results.run_axis import run_axis
from viscontact.results.shown_scalars import has_friction, shown_scalars
from viscontact.results.stated_errors import (
    NOT_DRAWN,
    drawn_values,
    errors_of,
    is_centred,
    is_rounding,
    lacks_curve,
    mesh_dependent,
)
from viscontact.results.variables import (
    MESH_DEPENDENT,
    SCALARS,
    Place,
    along_line,
    is_of_period,
    per_length,
    scalars_in,
    shown_in,
    shown_name,
)
from viscontact.units.formatting import readable_unit
from viscontact.units.temperatures import CELSIUS

#: Remark on a scalar without any error.
UNKNOWN = "error not known"
#: A curve with a smaller relative variation is drawn as a constant.
_CONSTANT = 1e-6
#: Largest room for bands beyond the curves, in their span or, if more, in their largest value: one
#: very large error does not flatten them.
_SPAN, _SIZE = 1.0, 0.5
#: Margin of an axis over its length, and level of a constant over the length of its axis.
_MARGIN, _ABOVE = 0.05, 1.15


def drawn_scalars(runs: Mapping[str, xr.Dataset]) -> list[str]:
    """Names of the scalars of a printed figure, which all runs have: without a constant load."""
    each = list(runs.values())
    common = [
        name
        for name in shown_in(Place.FIGURE)
        if all(scalars_in(run, [name]) for run in each)
        and not all(is_of_period(name, run) for run in each)
    ]
    return [name for name in common if _is_worth_a_panel(name, each)]


def needed_variables(run: xr.Dataset) -> list[str]:
    """Names of the scalars that histories need, those by which rounding is found included."""
    shown = shown_scalars(run, Place.FIGURE)
    others = ["contact_length", "position_x", "position_y", "force"]
    others += [SCALARS[name].per_length_of for name in shown]
    return [*shown, *(name for name in dict.fromkeys(others) if name in run and name not in shown)]


def load_names(run: xr.Dataset) -> list[str]:
    """Names of the scalars that are prescribed, for a page; none over a single speed."""
    if _has_one_speed(run):
        return []
    force = shown_name("force", run)
    names = [name for name in shown_in(Place.LOAD, run) if name == force or _varies(run, name)]
    if not run_axis(run).is_history:
        names = []  # a constant load
    if not prescribes_approach(run):
        return names
    return ["approach", *(name for name in names if SCALARS[name].moving)]


def response_names(run: xr.Dataset) -> list[str]:
    """Names of the scalars that answer the load, for a page: without idle ones."""
    # A table has the values at a single speed, and friction over speed is a figure of its own.
    if _has_one_speed(run):
        return []
    answer = {"approach": shown_name("force", run)} if prescribes_approach(run) else {}
    own = ["friction_coefficient"] if has_friction(run) else []
    shown = [name for name in shown_scalars(run, Place.RESPONSE) if name not in own]
    if not run_axis(run).is_history:
        shown.append(f"eccentricity_{motion_axis(run)}")  # the contact lies ahead of the axis
    return [answer.get(name, name) for name in shown if not is_idle(run, name)]


def _has_one_speed(run: xr.Dataset) -> bool:
    return run.sizes.get("speed") == 1


def is_idle(run: xr.Dataset, name: str) -> bool:
    """Test for rounding under a centred load, on an elastic body, or across motion or load."""
    of_part = (
        SCALARS[name].moving
        or along_line(FRICTION) == SCALARS[name].of
        or SCALARS[name].of == FRICTION
    )
    return is_rounding(run, name) if of_part else is_centred(run, name)


def _is_worth_a_panel(name: str, runs: list[xr.Dataset]) -> bool:
    if name in ("force", per_length("force")) or (
        name == "peak_line_load" and all(map(across_period, runs))
    ):
        return any(np.ptp(run[name].values) > _CONSTANT * np.max(run[name].values) for run in runs)
    return not all(is_idle(run, name) for run in runs)


def _varies(run: xr.Dataset, name: str) -> bool:
    values = run[name].values[np.isfinite(run[name].values)]
    least = 0.0 if SCALARS[name].moving else max(1e-9, _CONSTANT * np.abs(values).max(initial=0.0))
    return bool(values.size and np.ptp(values) > least)


def history_panel(
    runs: Mapping[str, xr.Dataset],
    name: str,
    units: Units = readable_unit,
    reference: xr.Dataset | None = None,
) -> Panel:
    """Panel of a scalar of runs by name, and of a reference beside them without its errors."""
    each = list(runs.values())
    others = [reference] if reference is not None and name in reference else []
    variable = SCALARS[name]
    y = units(variable.units, *(run[name].values for run in [*each, *others]))
    if name == "temperature":
        y = CELSIUS
    curves = [
        *(_curve(run, name, label, ink) for (label, run), ink in _with_inks(runs)),
        *(_curve(run, name, "", SECOND, has_error=False) for run in others),
    ]
    is_drawn = not all(lacks_curve(run, name) for run in each)
    return Panel(
        along_run([*each, *([] if reference is None else [reference])], units),
        Axis(
            variable.label,
            y,
            limits_around(curves, from_zero=name in ("force", per_length("force"))),
        ),
        tuple(curves),
        marks=event_marks(each[0]) if len(runs) == 1 else (),
        note=_note(each, name),
        in_place="" if is_drawn else NOT_DRAWN,
        name=name,
        aside=_temperature(each[0], name) if len(each) == 1 else None,
    )


def _temperature(run: xr.Dataset, name: str) -> Aside | None:
    """Temperature of a run over its time beside a scalar that answers it, if it varies."""
    if not run_axis(run).is_history or name in OF_CLOCKS or is_prescribed(run, name):
        return None
    return temperature_aside(recorded_temperature(run), float(run["time"].values[-1]))


def _with_inks(runs: Mapping[str, xr.Dataset]) -> Iterable[tuple[tuple[str, xr.Dataset], Ink]]:
    return zip(runs.items(), inks_of(list(runs)), strict=True)


def _curve(run: xr.Dataset, name: str, label: str, ink: Ink, *, has_error: bool = True) -> Curve:
    over, is_given = run_axis(run), is_prescribed(run, name)
    return Curve(
        over.values(run),
        drawn_values(run, name),
        label,
        ink,
        "line" if over.is_history else "joined",
        error=errors_of(run, name) if has_error and not is_given else None,
    )


def margin_panel(run: xr.Dataset) -> Panel:
    """Panel of the margins of the limited scalars; ValueError if there is none."""
    found = margins(run)
    drawn = {name: found[name].values for name in map(str, found.data_vars)}
    drawn = {name: values for name, values in drawn.items() if np.isfinite(values).any()}
    if not drawn:
        raise ValueError("margins: the result has no allowable value of a scalar with an error")
    labels = [SCALARS[name.removeprefix(PREFIX)].label for name in drawn]
    instants = run_axis(run).values(run)
    curves = tuple(
        Curve(instants, np.where(np.isfinite(values), values, np.nan), label, ink)
        for values, label, ink in zip(drawn.values(), labels, inks_of(labels), strict=True)
    )
    return Panel(
        along_run([run]), Axis("Margin", PERCENT), curves, marks=(Mark(0.0, "y", look="dashed"),)
    )


def event_marks(run: xr.Dataset) -> tuple[Mark, ...]:
    """Marks of the events of a load program within the instants of a run."""
    if not run_axis(run).is_history:
        return ()
    first, last = run["time"].values[[0, -1]]
    events = [event for event in recorded_events(run) if first <= event.time <= last]
    return tuple(Mark(event.time, text=event.text, look="dotted") for event in events)


def _note(runs: list[xr.Dataset], name: str) -> str:
    """Remark on curves that are not drawn, and on errors that bands do not show."""
    if any(mesh_dependent(run, name).any() for run in runs):
        missing = sum(lacks_curve(run, name) for run in runs)
        left_out = f"{missing} of {len(runs)} runs not drawn: " if 0 < missing < len(runs) else ""
        return left_out + MESH_DEPENDENT
    run = runs[0]
    if len(runs) > 1 or not _has_errors(run) or is_prescribed(run, name):
        return ""
    given = np.isfinite(run[name].values)
    unknown = int(np.isnan(errors_of(run, name)[given]).sum())
    if not SCALARS[name].has_error or not unknown:
        return ""
    return UNKNOWN + (
        "" if unknown == given.sum() else f" at {unknown} of {given.size} {run_axis(run).rows}"
    )


def _has_errors(run: xr.Dataset) -> bool:
    """False for a run without error bars, of which no panel needs to say so."""
    return any(np.isfinite(errors_of(run, name)).any() for name in scalars_in(run))


def limits_around(
    curves: Sequence[Curve], *, from_zero: bool = False
) -> tuple[float, float] | None:
    """Range of curves with their errors [SI]; None without any value."""
    values = np.concatenate([curve.y[np.isfinite(curve.y)] for curve in curves])
    if not values.size:
        return None
    low, high = float(values.min()), float(values.max())
    size = max(abs(low), abs(high))
    if high - low <= _CONSTANT * size:
        bottom, top = sorted((0.0, _ABOVE * high or 1.0))
        return bottom, top
    room = max(_SPAN * (high - low), _SIZE * size)
    ends = np.concatenate([curve.y + sign * _bars(curve) for curve in curves for sign in (-1, 1)])
    least = max(float(np.nanmin(ends)), low - room)
    most = min(float(np.nanmax(ends)), high + room)
    if from_zero and least > 0:
        least = 0.0
    margin = _MARGIN * (most - least)
    return 0.0 if least == 0 else least - margin, most + margin


def _bars(curve: Curve) -> np.ndarray:
    if curve.error is None:
        return np.zeros(curve.y.shape)
    return np.where(np.isfinite(curve.error), curve.error, 0.0)
