"""Heat balances as a labelled table."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.results.heating.balances import Balance, Reach, Sink
from viscontact.results.heating.cover import Cover
from viscontact.results.heating.heating import heating
from viscontact.results.heating.power_curve import PowerCurve

#: Heating over time: multiples of the time that the cover takes to cool, and instants.
_COOLING_TIMES, _INSTANTS = 12.0, 181


def heat_table(
    curve: PowerCurve,
    cover: Cover,
    sink: Sink,
    speeds: Floats,
    balances: Sequence[Sequence[Balance]],
    reaches: Sequence[Reach],
    line: tuple[Floats, Floats],
) -> xr.Dataset:
    """Balances over speed, and the power and the balance speeds over temperature."""
    count = max(map(len, balances))
    temperature = np.full((speeds.size, count), np.nan)
    stable = np.zeros(temperature.shape, dtype=bool)
    for n, found in enumerate(balances):
        temperature[n, : len(found)] = [each.temperature for each in found]
        stable[n, : len(found)] = [each.is_stable for each in found]
    power = sink.power(temperature)
    of_root = ("speed", "root")
    data = {
        "temperature": _variable(of_root, temperature, "K", "mean temperature of a balance"),
        "stable": xr.Variable(of_root, stable, {"long_name": "the balance is stable"}),
        "temperature_error": _variable(
            of_root, _errors(curve, sink, speeds, temperature), "K", "error of the temperature"
        ),
        "power": _variable(of_root, power, "W", "power that heats the body"),
    }
    if cover.conductivity is not None:
        modes = np.full((*power.shape, cover.averages.size), np.nan)
        for at in np.argwhere(np.isfinite(power)):
            modes[*at] = cover.steady(power[*at] / (sink.conductance * cover.resistance))
        for name, values, what in (
            ("surface_temperature", cover.surface(modes), "temperature of the surface"),
            ("hot_spot", cover.hottest(modes), "highest temperature through the cover"),
        ):
            data[name] = _variable(of_root, values, "K", what)
    lows, highs = ([getattr(r, end) for r in reaches] for end in ("low", "high"))
    data["coldest"] = _variable("speed", lows, "K", "lowest temperature with a known power")
    data["hottest"] = _variable("speed", highs, "K", "highest temperature with a known power")
    data |= _over_temperature(curve, sink, speeds, reaches, line)
    coords = {
        "speed": _variable("speed", speeds, "m/s", "speed"),
        "root": np.arange(count),
        "at_temperature": _variable("at_temperature", line[0], "K", "temperature"),
    }
    return xr.Dataset(data, coords)


def _over_temperature(
    curve: PowerCurve,
    sink: Sink,
    speeds: Floats,
    reaches: Sequence[Reach],
    line: tuple[Floats, Floats],
) -> dict[str, xr.Variable]:
    """Power at each speed, cooling, and the speed of the balance, over temperature."""
    temperatures, balance_speeds = line
    power = np.full((speeds.size, temperatures.size), np.nan)
    for n, (speed, reach) in enumerate(zip(speeds, reaches, strict=True)):
        power[n] = curve.power(temperatures, speed)
        power[n, (temperatures < reach.low) | reach.is_empty] = np.nan
    over = "at_temperature"
    is_stable = np.gradient(balance_speeds, temperatures) > 0
    return {
        "power_at": _variable(("speed", over), power, "W", "power at a temperature"),
        "cooling_at": _variable(over, sink.power(temperatures), "W", "heat that flows off"),
        "speed_at": _variable(over, balance_speeds, "m/s", "speed with a balance there"),
        "stable_at": xr.Variable(over, is_stable, {"long_name": "this balance is stable"}),
    }


def with_heating(
    table: xr.Dataset,
    cover: Cover,
    area: float,
    curve: PowerCurve,
    reaches: Sequence[Reach],
) -> xr.Dataset:
    """Table with the temperatures over time from the start of the motion."""
    cooling_time = cover.capacity * cover.thickness * cover.resistance
    times = np.linspace(0.0, _COOLING_TIMES * cooling_time, _INSTANTS)
    speeds = table["speed"].values.tolist()
    modes = np.stack([
        heating(cover, area, curve, speed, reach, times)
        for speed, reach in zip(speeds, reaches, strict=True)
    ])  # fmt: skip
    over = ("speed", "time")
    found = {"heating_temperature": _variable(over, cover.mean(modes), "K", "mean temperature")}
    if cover.conductivity is not None:
        hot = cover.hottest(modes)
        found["heating_hot_spot"] = _variable(over, hot, "K", "highest temperature")
    coords = {"time": _variable("time", times, "s", "time")}
    return table.assign(found).assign_coords(coords).assign_attrs(cooling_time=cooling_time)


def _errors(curve: PowerCurve, sink: Sink, speeds: Floats, temperature: Floats) -> Floats:
    """Errors of the balances by that of the power: it moves a balance by dP/(hA - P') [K]."""
    errors = np.full(temperature.shape, np.nan)
    for n, root in np.argwhere(np.isfinite(temperature)):
        there, speed = float(temperature[n, root]), float(speeds[n])
        near = there + np.array([-1e-3, 1e-3])
        rise = float(np.diff(curve.power(near, speed))[0]) / 2e-3
        power = float(sink.power(np.array(there)))
        error = power * curve.relative_error(there, speed)
        errors[n, root] = abs(error / (sink.conductance - rise))
    return errors


def _variable(dims: str | tuple[str, ...], values: object, units: str, what: str) -> xr.Variable:
    return xr.Variable(dims, np.asarray(values), {"units": units, "long_name": what})
