"""Warnings of a leakage: a channel of few cells, a fluid that pushes, gaps of few molecules."""

from __future__ import annotations

from collections.abc import Iterator

import xarray as xr

from viscontact.results.recorded_case import recorded_grid
from viscontact.units.formatting import format_quantity

#: Relative error of T beyond which only its order is known.
UNCERTAIN = 0.3

#: Largest pressure of the fluid, over the mean pressure of the contact.
PUSH = 0.05

#: Critical gaps below which a liquid is no continuum, and mean free path of air at 1 bar [m].
MOLECULES, FREE_PATH = 3e-9, 68e-9

#: Pressure at which the free path is that [Pa].
ATMOSPHERE = 1e5


def leakage_warnings(
    found: xr.Dataset, ds: xr.Dataset, pressure_difference: float | None, gas: float | None
) -> list[str]:
    """What makes some of the values uncertain, in sentences."""
    return [*_near_closing(found), *_push(ds, pressure_difference), *_continuum(found, gas)]


def _near_closing(found: xr.Dataset) -> Iterator[str]:
    value, error = found["transmissivity"], found["transmissivity_error"]
    wide = (value > 0) & (error > UNCERTAIN * value)
    if bool(wide.any()):
        worst = float((error / value.where(value > 0)).max())
        yield (
            f"the transmissivity has an error of up to {_size(worst)}: the channel is a few cells "
            "wide at its narrowest place; use a finer grid, and rely on the critical gap"
        )


def _size(error: float) -> str:
    """Relative error in words."""
    return f"{100 * error:.0f} %" if error < 1 else f"a factor of {1 + error:.2g}"


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
