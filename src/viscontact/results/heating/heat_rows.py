"""Rows of heat balances in words, for the terminal and the page."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import xarray as xr

from viscontact.results.formatting import format_error, format_supported
from viscontact.results.heating.heat_notes import celsius
from viscontact.units.formatting import format_quantity
from viscontact.units.temperatures import in_celsius

#: Arguments with their units; temperatures are in °C.
_ARGUMENTS = {
    "cooling": "W/(m2 K)",
    "area": "m2",
    "thickness": "m",
    "conductivity": "W/(m K)",
    "heat_capacity": "J/(kg K)",
}
#: Temperatures through a cover that conducts.
_THROUGH = ("surface_temperature", "hot_spot")


def balance_headings(table: xr.Dataset) -> tuple[str, ...]:
    """Headings of the rows of balances."""
    through = ("surface", "hot spot") if "hot_spot" in table else ()
    return ("speed", "temperature", "", "power", *through)


def balance_rows(table: xr.Dataset) -> Iterator[tuple[str, ...]]:
    """Row of each balance, the coldest of a speed first; one that says so where there is none."""
    empty = ("",) * (len(balance_headings(table)) - 3)
    for n, speed in enumerate(table["speed"].values.tolist()):
        at = format_quantity(speed, "m/s", 3)
        roots = np.flatnonzero(np.isfinite(table["temperature"].values[n]))
        if not roots.size:
            yield at, "-", "beyond the curve", *empty
        for number, root in enumerate(roots):
            one = table.isel(speed=n, root=root)
            through = [celsius(float(one[name])) for name in _THROUGH if name in one]
            state = "stable" if bool(one["stable"]) else "unstable"
            power = format_quantity(float(one["power"]), "W", 3)
            yield at if number == 0 else "", _with_error(one), state, power, *through


def _with_error(one: xr.Dataset) -> str:
    value, error = float(in_celsius(one["temperature"].values)), float(one["temperature_error"])
    bar = f" {format_error(error).replace('±', '± ')}" if error > 0 else ""
    return f"{format_supported(value, error if error > 0 else math.nan)}{bar} °C"


def heat_argument_rows(table: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Names and values of the arguments that were given, or taken from the case."""
    yield "ambient", celsius(float(table.attrs["ambient"]))
    for name, unit in _ARGUMENTS.items():
        if name in table.attrs:
            yield name.replace("_", " "), format_quantity(float(table.attrs[name]), unit)
    if "density" in table.attrs:
        yield "density", f"{float(table.attrs['density']):.5g} kg/m³"
    if "conductivity" in table.attrs:
        core = table.attrs.get("core_temperature")
        yield "core", "insulated" if core is None else celsius(float(core))
    if "cooling_time" in table.attrs:
        yield "time to cool to 1/e", format_quantity(float(table.attrs["cooling_time"]), "s", 3)
