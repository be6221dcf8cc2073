"""Leakage: rate and critical gap over time or speed, and the flow over the surface."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.along_run import steps_grow
from viscontact.drawing.content.panel import FIRST, PERCENT, Axis, Curve, Ink, Mark, Panel
from viscontact.results.leakage.leakage import fields_of, instant_leakage, leakage
from viscontact.results.leakage.of_case import leakage_settings
from viscontact.results.run_axis import run_axis
from viscontact.results.snapshots import field_times
from viscontact.units.formatting import ReadableUnit, format_quantity, readable_unit
from viscontact.units.numbers import finite_array

#: Decades of the flow below its largest value that are drawn.
DECADES = 4


@dataclass(frozen=True, eq=False)
class LeakMap:
    """Gap, contact and flow of one instant."""

    heading: str
    x: Floats  # centres of the cells [m]
    y: Floats
    touched: Bools
    flow: Floats  # over the largest; NaN where nothing flows
    gap: Floats  # [m]
    pressure: Floats  # of the fluid over its difference; NaN outside the channels
    difference: float | None  # of the pressure, if the case names one [Pa]
    constriction: tuple[float, float] | None  # place of the critical gap [m]
    note: str


def leak_map(results: xr.Dataset, times: ArrayLike | None, along: str, figure: str) -> LeakMap:
    """Flow at the stored instant or speed nearest to a requested one, the last by default."""
    stored, axis = field_times(results, figure), run_axis(results)
    if along not in ("x", "y"):
        raise ValueError(f"{figure}: along must be 'x' or 'y', got {along!r}")
    wanted = stored[-1:]
    if times is not None:
        wanted = finite_array(f"{figure}: {axis.name}s", times, axis.unit).ravel()
    if not wanted.size:
        raise ValueError(f"{figure}: {axis.name}s must be finite numbers, got none")
    if wanted.size != 1:
        raise ValueError(f"{figure}: shows one {axis.row}, got {wanted.size}")
    index = int(np.abs(stored - wanted[0]).argmin())
    with _named(figure):
        found = instant_leakage(results, index, along, None)
        critical, i, j = found.critical
        grid, fields = found.grid, fields_of(found)
    flow = np.hypot(fields["flux_x"], fields["flux_y"])
    place = None if not critical else (float(grid.x[i]), float(grid.y[j]))
    note = "closed: no channel leads through"
    if critical:
        note = (
            f"effective gap {format_quantity(float(np.cbrt(12 * found.transmissivity)), 'm', 3)}, "
            f"critical gap {format_quantity(critical, 'm', 3)}"
        )
        flow = flow / flow.max()
    gap = np.where(np.isfinite(found.gap), found.gap, np.nan)
    return LeakMap(
        f"{axis.place(float(stored[index]))}, flow along {along}",
        *(grid.x, grid.y, found.touched, np.where(flow > 0, flow, np.nan), gap),
        *(fields["fluid_pressure"], leakage_settings(results).get("pressure_difference")),
        *(place, note),
    )


def shown_leakage(
    results: xr.Dataset, times: ArrayLike | None, along: str, figure: str
) -> xr.Dataset:
    """Leakage of a result, or as given, at the instants or speeds nearest to some; all if None."""
    if along not in ("x", "y"):
        raise ValueError(f"{figure}: along must be 'x' or 'y', got {along!r}")
    axis = run_axis(results)
    is_found = "percolates" in results
    stored = axis.values(results) if is_found else field_times(results, figure)
    chosen = np.arange(stored.size)
    if times is not None:
        wanted = finite_array(f"{figure}: {axis.name}s", times, axis.unit).ravel()
        if not wanted.size:
            raise ValueError(f"{figure}: {axis.name}s must be finite numbers, got none")
        chosen = np.unique([int(np.abs(stored - each).argmin()) for each in wanted])
    if is_found:
        return results.isel({axis.name: chosen})
    settings = {"viscosity": 1.0, **leakage_settings(results)}
    if settings.get("along") != "both":
        settings["along"] = along
    shown = results.isel({str(results["pressure"].dims[0]): chosen})
    with _named(figure):
        return leakage(shown, **settings)


@contextmanager
def _named(figure: str) -> Iterator[None]:
    """Give refusals of the flow the name of the figure that asks for it."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{figure}: {str(error).removeprefix('leakage: ')}") from None


def leak_panels(leak: xr.Dataset, along: str, over: str = "time") -> tuple[Panel, Panel]:
    """Panels of the leak rate, or the transmissivity without one, and of the critical gap."""
    one = leak
    if "direction" in leak.dims:
        one = leak.sel(direction=along)
    name = "leak_rate" if np.isfinite(one["leak_rate"].values).any() else "transmissivity"
    places, x = _places(leak, over)
    values, errors = one[name].values, one[f"{name}_error"].values
    opened = one["percolates"].values > 0
    closes = np.flatnonzero(opened[:-1] & ~opened[1:])
    marks = tuple(Mark(float(places[k + 1]), text="closed", look="dashed") for k in closes[:1])
    quantity = "Leak rate" if name == "leak_rate" else "Transmissivity"
    si = "m³/s" if name == "leak_rate" else "m³"
    shown = np.where(values > 0, values, np.nan)
    first = Panel(
        x,
        _decades(quantity, si, shown),
        (Curve(places, shown, "", FIRST, "joined", error=np.minimum(errors, 0.9 * values)),),
        marks=marks,
        name="leak-rate",
    )
    curves = []
    for k, label in enumerate(("critical gap", "effective gap", "mean gap")):
        gap = one[label.replace(" ", "_")].values
        shown, ink, error = np.where(gap > 0, gap, np.nan), Ink(place=k), None
        if label == "critical gap":
            error = np.minimum(one["critical_gap_error"].values, 0.9 * gap)
        curves.append(Curve(places, shown, label, ink, "joined", symbol=k, error=error))
    every = np.concatenate([curve.y for curve in curves])
    second = Panel(x, _decades("Gap", "m", every), tuple(curves), marks=marks, name="critical-gap")
    return first, second


def _places(leak: xr.Dataset, over: str) -> tuple[Floats, Axis]:
    """Values along the horizontal axis, and the axis: instants or speeds, forces or areas."""
    axis = run_axis(leak)
    if over == "time":
        return axis.values(leak), _along(axis.name.capitalize(), axis.unit, axis.values(leak))
    if over == "force":
        return leak["force"].values, Axis.of("Force", "N", leak["force"].values)
    if over == "area":
        return leak["area_fraction"].values, Axis("Real over nominal area", PERCENT)
    raise ValueError(f"leak-rate: over must be 'time', 'force' or 'area', got {over!r}")


def _along(name: str, si: str, places: Floats) -> Axis:
    unit, positive = readable_unit(si, places), places[places > 0]
    if positive.size > 2 and steps_grow(places):
        limits, first = (float(places.min()), float(places.max())), float(positive[0])
        return Axis(name, unit, limits, "time" if si == "s" else "log", first=first)
    return Axis(name, unit)


def _decades(quantity: str, si: str, values: Floats) -> Axis:
    """Logarithmic axis of what is above 0, or an empty one."""
    known = values[np.isfinite(values)]
    if not known.size:
        return Axis(quantity, ReadableUnit(si, 1.0), (0.0, 1.0))
    unit = readable_unit(si, float(known.max())) if si == "m" else _volume(si, float(known.max()))
    return Axis(quantity, unit, (float(known.min()) / 1.5, float(known.max()) * 1.5), "log")


def _volume(si: str, largest: float) -> ReadableUnit:
    """Cubic millimetres or micrometres, by size."""
    rest = si.removeprefix("m³")
    name, factor = ("mm³", 1e-9) if largest > 1e-12 else ("µm³", 1e-18)
    return ReadableUnit(f"{name}{rest}", factor)
