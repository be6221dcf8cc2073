"""Heat balances of a rolling body: power and cooling, temperature over speed and over time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Bools, Floats
from viscontact.drawing.content.panel import (
    FAINT,
    FIRST,
    SECOND,
    TEXT,
    Axis,
    Curve,
    Ink,
    Mark,
    Panel,
)
from viscontact.results.shown_rows import shown_rows
from viscontact.units.formatting import ReadableUnit, format_quantity, readable_unit, time_labels
from viscontact.units.temperatures import in_celsius

_CELSIUS = ReadableUnit("°C", 1.0)
#: Most speeds with a curve of their own, and room beyond the warmest balance.
_MOST, _ROOM = 5, 1.25
#: Least range of temperatures that is drawn [K].
_LEAST_RANGE = 2.0
#: Ratio of the largest to the least speed from which on the axis is logarithmic.
_LOGARITHMIC = 50.0


def _shown_speeds(table: xr.Dataset) -> xr.Dataset:
    """Rows of a few speeds with a known power, from the slowest to the fastest."""
    rows = np.flatnonzero(np.isfinite(table["power_at"].values).any(axis=1))
    chosen = rows[shown_rows(rows.size, _MOST)]
    return table.isel(speed=chosen)


def _kinds(table: xr.Dataset) -> Iterator[tuple[Bools, str]]:
    """Stable and unstable balances, with the look of their markers."""
    there = np.isfinite(table["temperature"].values)
    stable = table["stable"].values.astype(bool)
    yield there & stable, "points"
    yield there & ~stable, "hollow"


def balance_panel(table: xr.Dataset) -> Panel:
    """Panel of power and cooling over temperature, with their balances."""
    shown = _shown_speeds(table)
    at = in_celsius(table["at_temperature"].values)
    idle = in_celsius(float(table.attrs["idle_temperature"]))
    warmest = in_celsius(float(np.nanmax(table["temperature"].values)))
    end = idle + max(_ROOM * (warmest - idle), _LEAST_RANGE)
    most = float(np.nanmax(table["power"].values))
    inks = [Ink("ordered", place) for place in np.linspace(0, 1, shown.sizes["speed"])]
    labels = time_labels(shown["speed"].values.tolist(), "m/s")
    curves = [Curve(at, table["cooling_at"].values, "cooling", TEXT, "dashed")]
    for row, (ink, label) in enumerate(zip(inks, labels, strict=True)):
        one = shown.isel(speed=[row])
        curves.append(Curve(at, one["power_at"].values[0], label, ink))
        for chosen, look in _kinds(one):
            where = in_celsius(one["temperature"].values[chosen]), one["power"].values[chosen]
            curves.append(Curve(*where, "", ink, "points" if look == "points" else "hollow"))
    return Panel(
        Axis("Temperature", _CELSIUS, (idle, end)),
        Axis("Power", readable_unit("W", most), (0.0, _ROOM * most)),
        tuple(curves),
        name="heat-balance",
    )


def temperature_panel(table: xr.Dataset) -> Panel:
    """Panel of the temperatures of balances over speed, with the runaway."""
    speeds = table["speed"].values
    first, last = float(speeds.min()), float(speeds.max())
    runaway = float(table.attrs["runaway_speed"])
    is_near = last / _MOST < runaway < _MOST * last
    low, high = first, max(last, 1.1 * runaway) if is_near else last
    if low == high:  # the branches around a single speed
        low, high = low / 2, 2 * high
    curves = []
    for is_stable, look, name in ((True, "line", "stable"), (False, "dashed", "unstable")):
        x, y = _branch(table, is_stable, (low, high))
        if np.isfinite(x).any():
            curves.append(Curve(x, y, name, FIRST, "line" if look == "line" else "dashed"))
    along = np.broadcast_to(speeds[:, None], table["temperature"].shape)
    for chosen, look in _kinds(table):
        if chosen.any():
            where = along[chosen], in_celsius(table["temperature"].values[chosen])
            curves.append(Curve(*where, "", FIRST, "points" if look == "points" else "hollow"))
    if "hot_spot" in table:
        chosen = next(_kinds(table))[0]
        where = along[chosen], in_celsius(table["hot_spot"].values[chosen])
        curves.append(Curve(*where, "hot spot, stable", SECOND, "cross"))
    is_seen = low < runaway < high
    x_axis = Axis("Speed", readable_unit("m/s", last), (low, high))
    if high > _LOGARITHMIC * low:
        x_axis = Axis.over_decades("Speed", "m/s", low, high)
    return Panel(
        x_axis,
        Axis("Temperature", _CELSIUS),
        tuple(curves),
        marks=(Mark(runaway, look="dotted"),) if is_seen else (),
        note=f"runaway at {format_quantity(runaway, 'm/s', 3)}" if is_seen else "",
        name="rolling-temperature",
    )


def _branch(
    table: xr.Dataset, is_stable: bool, speeds: tuple[float, float]
) -> tuple[Floats, Floats]:
    """Speeds and temperatures of all balances of a kind within some speeds, NaN in between."""
    x, stable = table["speed_at"].values, table["stable_at"].values.astype(bool)
    # A branch reaches to the first point of the other kind, so that both meet.
    near = stable == is_stable
    near = near | np.r_[near[1:], False] if is_stable else near
    within = near & (x >= speeds[0]) & (x <= speeds[1])
    return np.where(within, x, np.nan), in_celsius(table["at_temperature"].values)


def heating_panel(table: xr.Dataset) -> Panel:
    """Panel of the temperature over time from the start of the motion, at a few speeds."""
    started = np.isfinite(table["heating_temperature"].values[:, 0])
    if not started.any():
        raise ValueError("rolling_heating: the curve gives no power of the cold body at any speed")
    shown = _shown_speeds(table.isel(speed=started))
    times = table["time"].values
    inks = [Ink("ordered", place) for place in np.linspace(0, 1, shown.sizes["speed"])]
    labels = time_labels(shown["speed"].values.tolist(), "m/s")
    curves = []
    for row, (ink, label) in enumerate(zip(inks, labels, strict=True)):
        one = shown.isel(speed=row)
        curves.append(Curve(times, in_celsius(one["heating_temperature"].values), label, ink))
        if "heating_hot_spot" in one:
            hot = in_celsius(one["heating_hot_spot"].values)
            curves.append(Curve(times, hot, "hot spot" if row == 0 else "", ink, "dotted"))
    idle = in_celsius(float(table.attrs["idle_temperature"]))
    return Panel(
        Axis.of("Time", "s", times),
        Axis("Temperature", _CELSIUS),
        tuple(curves),
        marks=(Mark(idle, "y", look="dotted", ink=FAINT),),
        name="rolling-heating",
    )
