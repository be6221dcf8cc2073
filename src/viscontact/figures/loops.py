"""Loops of a run: force over approach, resistance over position."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.figures.look import LIGHT, Look, Part, drawn, numbers
from viscontact.results.recorded_case import case_of, recorded_object
from viscontact.results.run_axis import TIME, run_axis
from viscontact.results.shown_scalars import lacks_datum
from viscontact.results.stated_errors import drawn_values, errors_of, is_rounding
from viscontact.results.worst_values import LoadCycle, last_cycle
from viscontact.units.formatting import format_quantity


@dataclass(frozen=True)
class Loop:
    """Two scalars of a run over each other, and the instants of the last cycle.

    `last` and `end` are the indices of its first and last instant, of the whole path if it has no
    cycles.
    """

    name: str
    title: str
    across: str  # label of the horizontal axis
    along: str  # scalar on it [m]
    value: str  # scalar on the vertical axis [N]
    area: str  # what the area inside is
    last: int
    end: int


def loops_of(ds: xr.Dataset) -> list[Loop]:
    """Return force over approach of a cyclic load, and resistance over position along each axis.

    Resistance is shown along axes on which the body turns back.
    """
    found = [_resistance(ds, axis) for axis in "xy" if _turns_back(ds, axis)]
    cycle = last_cycle(ds, least=1)
    if cycle is None or lacks_datum(ds):
        return found
    return [_hysteresis(cycle), *found]


def loops(
    ds: xr.Dataset, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> list[go.Figure]:
    """Draw the loops of a run, each beside that of a reference; none of a result over speed."""
    if run_axis(ds) is not TIME:
        return []
    others = {} if reference is None else {each.name: each for each in loops_of(reference)}
    return [_drawn(ds, loop, look, reference, others.get(loop.name)) for loop in loops_of(ds)]


def _turns_back(ds: xr.Dataset, axis: str) -> bool:
    if f"position_{axis}" not in ds or is_rounding(ds, f"resistance_{axis}"):
        return False
    ways = np.diff(ds[f"position_{axis}"].values)
    return bool((ways > 0).any() and (ways < 0).any())


def _resistance(ds: xr.Dataset, axis: str) -> Loop:
    scalars = f"position_{axis}", f"resistance_{axis}"
    titles = f"Resistance along {axis}", f"Position along {axis}"
    ends = _last_cycle(ds), ds.sizes["time"] - 1
    return Loop(f"loop-{axis}", *titles, *scalars, "motion work", *ends)


def _hysteresis(cycle: LoadCycle) -> Loop:
    scalars = "approach", "force"
    return Loop("loop-force", "Force", "Approach", *scalars, "loss", cycle.first, cycle.last)


def _drawn(
    ds: xr.Dataset, loop: Loop, look: Look, reference: xr.Dataset | None, other: Loop | None
) -> go.Figure:
    """Draw a loop: earlier and later cycles thin, the last whole one bold."""
    position, values = ds[loop.along].values, drawn_values(ds, loop.value)
    length, force = look.unit("m", position), look.unit("N", values)
    hover = _hover(ds, loop, look)
    thin, bold = {"color": look.line, "width": 1}, {"color": look.blue, "width": 2.2}

    def part(begin: int, end: int | None, line: Part) -> Part:
        return {
            "x": numbers(length(position[begin:end])),
            "y": numbers(force(values[begin:end])),
            "mode": "lines",
            "text": hover[begin:end],
            "hovertemplate": f"{loop.across} %{{x:.4g}} {length.symbol}, %{{text}}<extra></extra>",
            "line": line,
        }

    traces = [
        part(0, loop.last + 1, thin),
        part(loop.last, loop.end + 1, bold),
        part(loop.end, None, thin),
    ]
    if reference is not None and other is not None:
        dashed = {"color": look.warm, "width": 1.6, "dash": "dash"}
        where = numbers(length(reference[other.along].values))
        what = numbers(force(drawn_values(reference, other.value)))
        look_of = {"mode": "lines", "line": dashed, "hoverinfo": "skip"}
        traces.insert(0, {"x": where, "y": what, **look_of})
    meta = {
        "name": loop.name,
        "title": f"{loop.title} over {loop.across.lower()} [{force.symbol}]",
        "note": f"{'Bold: the last cycle. ' if loop.last else ''}"
        f"The area inside is the {loop.area} of a cycle.",
    }
    across = {"title": {"text": length.label(loop.across)}}
    return drawn(traces, look, meta, xaxis=across, yaxis={"zeroline": True})


def _hover(ds: xr.Dataset, loop: Loop, look: Look) -> list[str]:
    """Instant and value of each point."""
    values, errors = drawn_values(ds, loop.value), errors_of(ds, loop.value)
    return [
        f"t = {format_quantity(float(time), 's')}: {look.text(value, error, 'N')}"
        for time, value, error in zip(
            ds["time"].values, values.tolist(), errors.tolist(), strict=True
        )
    ]


def _last_cycle(ds: xr.Dataset) -> int:
    """Index of the instant at which the last complete cycle of the motion begins, or 0."""
    if not case_of(ds).get("motion"):
        return 0
    times = ds["time"].values
    cycles = recorded_object(ds, "motion", "resistance").cycles
    begins = [begin for (begin, _), (end, _) in cycles if end <= times[-1] * (1 + 1e-9)]
    return int(np.abs(times - begins[-1]).argmin()) if begins else 0
