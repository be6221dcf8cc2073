"""Checks of a periodic surface: shape and load must repeat with the period of the grid."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import CombinedIndenter, HeightMap, Indenter, PlacedIndenter
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.history_points import TAIL
from viscontact.units.formatting import format_quantity

#: Reason why a line contact has no approach (Johnson 1985, Contact Mechanics, section 2.3).
NO_DATUM = (
    "under a load that repeats along a line the surface sinks as the logarithm of the distance "
    "from which it is measured, so that the approach has no datum"
)

#: Relative difference below which a length equals the period.
LENGTH_TOLERANCE = 1e-6

#: Largest difference of gaps a period apart in a periodic texture, as a part of its depth.
TEXTURE_TOLERANCE = 1e-3


def check_period(
    indenter: Indenter,
    open_gap: Floats,
    grid: Grid,
    load: LoadHistory,
    *,
    supported: bool = False,
) -> None:
    """Refuse a shape or a load that does not fit into a period; `open_gap` is on the grid [m]."""
    if not any(grid.periodic):
        return
    for name in TAIL:
        if grid.periodic["xy".index(name[-1])] and np.any(getattr(load, name, None) or 0.0):
            raise ValueError(
                f"load.{name}: must be 0 on a periodic grid, where a body that tilted would not "
                "fit to its next period; leave it out"
            )
    for part in _parts(indenter):
        _refuse_misfit(part, grid)
    _refuse_variation(indenter, grid)
    # An approach must not close the gap everywhere. Along one periodic axis it has no datum, but on
    # layers that a rigid base supports.
    if supported:
        return
    if not grid.has_datum:
        refuse_approach(load)
        return
    mean = float(open_gap.mean())
    if load.control == "approach" and load.largest_level >= mean:
        raise ValueError(
            f"load.approach: at {format_quantity(mean, 'm', 6)} the surfaces of a periodic grid "
            "touch everywhere, and an approach says no more about the pressure, got "
            f"{format_quantity(load.largest_level, 'm', 6)}; prescribe the force"
        )


def check_endless(indenter: Indenter, grid: Grid | None) -> None:
    """Refuse a body without end along an axis that no period ends; `grid` None is automatic."""
    if grid is None and indenter.endless[0] != indenter.endless[1]:
        return  # a line contact, whose automatic grid has a period
    periodic = grid.periodic if grid is not None else (False, False)
    for name, endless, repeats in zip("xy", indenter.endless, periodic, strict=True):
        if endless and not repeats:
            pair = "[true, false]" if name == "x" else "[false, true]"
            raise ValueError(
                f"grid.periodic: the body continues along {name} without end, and the grid would "
                f"cut it off; use a grid that is periodic along {name}, with 'periodic: {pair}', "
                "'shape' and 'size'"
            )


def datum_warnings(
    grid: Grid, undefined: Sequence[str], *, supported: bool = False
) -> dict[str, str]:
    """Warn that approach and what follows from it, `undefined`, have no datum on some grids."""
    # Periodic along one axis only, unless layers are `supported` by a rigid base.
    if grid.has_datum or supported:
        return {}
    *others, last = undefined
    named = f"{', '.join(others)} and {last} are" if others else f"{last} is"
    return {
        "datum": (
            f"the grid is periodic along {'xy'[grid.periodic.index(True)]} only, and {NO_DATUM}: "
            f"{named} not defined (NaN)"
        )
    }


def refuse_approach(load: LoadHistory) -> None:
    """Refuse a prescribed approach where it has no datum."""
    if load.control != "force":
        raise ValueError(
            f"load.approach: on a grid that is periodic along one axis only {NO_DATUM}, and an "
            "approach cannot be prescribed; give the force, or use a grid with periodic=False"
        )


def _refuse_variation(indenter: Indenter, grid: Grid) -> None:
    """Refuse a body that varies along a period of a single cell."""
    for axis, name in enumerate("xy"):
        if grid.shape[axis] > 1:
            continue
        within = grid.centre[axis] + grid.size[axis] * np.linspace(-0.5, 0.5, 17)
        places = [grid.x[:, None], grid.y[None, :]]
        here = indenter.gap(*places)
        places[axis] = np.expand_dims(within, 1 - axis)
        there = indenter.gap(*places)
        depth = float(np.ptp(here[np.isfinite(here)])) if np.isfinite(here).any() else 0.0
        same = np.isclose(there, here, rtol=0.0, atol=LENGTH_TOLERANCE * depth)
        if not same.all():
            raise ValueError(
                f"grid.shape: a single cell along {name} holds a body along which nothing varies, "
                "and this one does; use at least 4 cells there"
            )


def _parts(indenter: Indenter) -> Iterator[Indenter]:
    """Shapes of a combined body, each placed where it lies."""
    if isinstance(indenter, CombinedIndenter):
        for part in indenter.parts:
            yield from _parts(part)
    elif isinstance(indenter, PlacedIndenter):
        yield from (replace(indenter, body=part) for part in _parts(indenter.body))
    else:
        yield indenter


def _refuse_misfit(part: Indenter, grid: Grid) -> None:
    """Refuse one shape of a body that does not repeat with the grid."""
    if isinstance(part, HeightMap):
        axes = zip("xy", (part.x, part.y), (grid.x, grid.y), grid.size, grid.periodic, strict=True)
        for name, lines, centres, period, repeats in axes:
            if repeats:
                _refuse_map(name, lines, centres, period)
    elif math.isfinite(part.period):
        _refuse_texture(part, grid)
    elif isinstance(part, PlacedIndenter) and isinstance(part.body, HeightMap):
        gap = part.gap(grid.x[:, None], grid.y[None, :])
        if not (part.body.holes or np.isfinite(gap).all()):
            raise ValueError(
                "grid.periodic: the height map is moved or turned, so that it does not cover the "
                "period; leave it where it is"
            )


def _refuse_map(axis: str, lines: Floats, centres: Floats, period: float) -> None:
    """Refuse a map that is not as long as the period along an axis, or does not cover its cells."""
    span = float(lines[-1] - lines[0])
    whole = span * lines.size / (lines.size - 1)
    if not any(math.isclose(period, each, rel_tol=LENGTH_TOLERANCE) for each in (span, whole)):
        raise ValueError(
            f"grid.size: one period along {axis} must be as long as the height map, which repeats "
            f"itself over {format_quantity(whole, 'm', 9)} there ({lines.size} points), got "
            f"{format_quantity(period, 'm', 9)}"
        )
    slack = LENGTH_TOLERANCE * period
    if centres[0] < lines[0] - slack or centres[-1] > lines[-1] + slack:
        raise ValueError(
            f"grid.shape: the height map has {lines.size} points along {axis}, so that a cell "
            f"next to its last one would lie outside it; use {lines.size} cells along {axis} or "
            "fewer, or resample the map"
        )


def _refuse_texture(part: Indenter, grid: Grid) -> None:
    """Refuse waves or dimples of which the period does not hold a whole number."""
    here = part.gap(grid.x[:, None], grid.y[None, :])
    for axis, (name, period) in enumerate(zip("xy", grid.size, strict=True)):
        if not grid.periodic[axis]:
            continue
        shift = np.where(np.arange(2) == axis, period, 0.0)
        there = part.gap(grid.x[:, None] + shift[0], grid.y[None, :] + shift[1])
        if float(np.abs(there - here).max()) > TEXTURE_TOLERANCE * float(here.max()):
            raise ValueError(
                "grid.size: the body does not repeat itself over "
                f"{format_quantity(period, 'm', 9)} along {name}; one period must hold a whole "
                "number of its waves or dimples"
            )
