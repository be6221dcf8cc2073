"""Warnings of a leakage: a channel of few cells, a map of few waves, a fluid that pushes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import xarray as xr

from viscontact.results.leakage.closing import contact_shares
from viscontact.results.leakage.effective_medium import CLOSED
from viscontact.results.leakage.fluid import Fluid
from viscontact.results.leakage.instant import InstantLeakage
from viscontact.results.leakage.waves import MapWaves, map_waves
from viscontact.results.recorded_case import recorded_grid
from viscontact.units.formatting import format_quantity

#: Relative error of T beyond which only its order is known, and cells across the constriction.
UNCERTAIN, ACROSS = 0.3, 4

#: Cells on the shortest wave of a rough map, waves of the mean length on its period, and distance
#: from the closing part of contact below which T is that of the map, not of its surface.
CELLS, WAVES, NEAR = 8.0, 5.0, 0.03

#: Largest pressure of the fluid, over the mean pressure of the contact.
PUSH = 0.05

#: Critical gaps below which a liquid is no continuum, and mean free path of air at 1 bar [m].
MOLECULES, FREE_PATH = 3e-9, 68e-9

#: Pressure at which the free path is that [Pa], and density of air at it and of water [kg/m³].
ATMOSPHERE, AIR, WATER = 1e5, 1.2, 1000.0

#: Slope of the gap, and Reynolds number, beyond which the equation of thin films is not exact; and
#: the part of the channel that may be steeper.
SLOPE, REYNOLDS, STEEP_PART = 0.3, 1.0, 0.05


def leakage_warnings(
    found: xr.Dataset, ds: xr.Dataset, instants: Sequence[Sequence[InstantLeakage]], fluid: Fluid
) -> list[str]:
    """What makes some of the values uncertain, in sentences."""
    opened = [each for at in instants for each in at if each.percolates]
    waves = map_waves(ds) if opened else None
    return [
        *_narrow(found, opened),
        *(_map_notes(waves) if waves is not None else ()),
        *(_near_closing(found, ds) if waves is not None else ()),
        *_steep(opened),
        *_push(ds, fluid.pressure_difference),
        *_continuum(found, fluid.gas),
        *_inertia(found, instants[0], fluid),
    ]


def _narrow(found: xr.Dataset, opened: Sequence[InstantLeakage]) -> Iterator[str]:
    value, error = found["transmissivity"], found["transmissivity_error"]
    narrowest = min((each.cells_across for each in opened), default=ACROSS)
    worst = float((error / value.where(value > 0)).max()) if opened else 0.0
    if worst > UNCERTAIN:
        yield (
            f"the transmissivity has an error of up to {_size(worst)}: the channel is a few cells "
            "wide at its narrowest place; use a finer grid, and rely on the critical gap"
        )
    elif narrowest < ACROSS:
        yield (
            f"the channel is {narrowest} cells wide at its narrowest place, {ACROSS} or more are "
            "wanted; use a finer grid, and rely on the critical gap"
        )


def _size(error: float) -> str:
    """Relative error in words."""
    return f"{100 * error:.0f} %" if error < 1 else f"a factor of {1 + error:.2g}"


def _map_notes(waves: MapWaves) -> Iterator[str]:
    if waves.cells < CELLS:
        yield (
            f"{waves.cells:.1f} cells lie on the shortest waves of the surface, {CELLS:g} or more "
            "are wanted for the leak rate; use a finer grid, or a smoother map"
        )
    if waves.count < WAVES:
        yield (
            f"the period holds {waves.count:.1f} waves of the surface's mean length, {WAVES:g} or "
            "more are wanted: another map of the same surface may leak several times more or less; "
            "try several maps, or a larger one"
        )


def _near_closing(found: xr.Dataset, ds: xr.Dataset) -> Iterator[str]:
    shares = contact_shares(ds)
    closed = np.asarray(found["percolates"].values) == 0
    closed = closed.all(axis=1) if closed.ndim > 1 else closed
    limit = min(float(shares[closed].min(initial=np.inf)), CLOSED)
    near = ~closed & (shares > limit - NEAR)
    if near.any():
        yield (
            f"the contact is {100 * float(shares[near].max()):.3g} % of the nominal area, near the "
            f"{100 * limit:.3g} % at which rough surfaces close: the leak rate is that of this map "
            "and its last constriction, not of the surface"
        )


def _steep(opened: Sequence[InstantLeakage]) -> Iterator[str]:
    slope = max((each.slope(1 - STEEP_PART) for each in opened), default=0.0)
    if slope > SLOPE:
        yield (
            f"the gap has slopes of {slope:.2g} and more in {100 * STEEP_PART:.0f} % of the "
            f"channel; above {SLOPE:g} the equation of thin films gives too much"
        )


def _push(ds: xr.Dataset, pressure_difference: float | None) -> Iterator[str]:
    if pressure_difference is None or "force" not in ds:
        return
    nominal = float(ds["force"].max()) / recorded_grid(ds).area
    if nominal > 0 and pressure_difference > PUSH * nominal:
        yield (
            f"the pressure difference, {format_quantity(pressure_difference, 'Pa')}, is more than "
            f"{100 * PUSH:.0f} % of the mean pressure on the grid, "
            f"{format_quantity(nominal, 'Pa')}: the fluid carries a part of the load and opens "
            "the gap, which is left out"
        )


def _continuum(found: xr.Dataset, gas: float | None) -> Iterator[str]:
    gaps = found["critical_gap"].where(found["critical_gap"] > 0)
    least = float(gaps.min())
    limit = MOLECULES if gas is None else 10 * FREE_PATH * ATMOSPHERE / gas
    if least < limit:
        yield (
            f"the critical gap falls to {format_quantity(least, 'm', 3)}, below "
            f"{format_quantity(limit, 'm', 2)}, where "
            + ("a liquid is no continuum" if gas is None else "a gas slips along the walls")
        )


def _inertia(
    found: xr.Dataset, directions: Sequence[InstantLeakage], fluid: Fluid
) -> Iterator[str]:
    density = WATER if fluid.gas is None else AIR * fluid.gas / ATMOSPHERE
    widths = np.array([fluid.width or each.extents[1] for each in directions])
    rates, critical, mean = (
        found[name].values.reshape(-1, widths.size)
        for name in ("leak_rate", "critical_gap", "mean_gap")
    )
    known = np.isfinite(mean) & (mean > 0)
    narrowing = np.divide(critical, mean, out=np.zeros(mean.shape), where=known)
    numbers = density / fluid.viscosity * rates / widths * narrowing
    largest = float(np.max(numbers, initial=0.0, where=np.isfinite(numbers)))
    if largest > REYNOLDS:
        yield (
            f"the Reynolds number is {largest:.2g}, with the density of "
            f"{'water' if fluid.gas is None else 'air'}; above {REYNOLDS:g} inertia slows the "
            "flow, which is left out"
        )
