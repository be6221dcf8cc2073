"""Pressure that is given as a formula: a function of x, y and perhaps time."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.runs.given_pressure.boxes import PointValues
from viscontact.runs.given_pressure.near_field import NearField
from viscontact.runs.given_pressure.pressure import GivenPressure
from viscontact.runs.given_pressure.resolved import BY_POINTS, FINE, resolved
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array


@dataclass(frozen=True, eq=False)
class PressureFormula(GivenPressure):
    """Pressure as a function of x, y and perhaps time."""

    function: Callable[..., Any]
    timed: bool  # with a third argument, the time

    @property
    def varies(self) -> bool:
        """True if the time is an argument."""
        return self.timed

    def at(
        self, time: float, position: tuple[float, float], grid: Grid, *, edges: bool = True
    ) -> Floats:
        """Mean pressure in each cell."""
        values = self.values_at(time, position, grid)
        return resolved(values, NearField(grid), FINE if edges else BY_POINTS).means

    def values_at(self, time: float, position: tuple[float, float], grid: Grid) -> PointValues:
        """Pressure at points at a time [s], with its frame at a position [m]."""

        def value(x: Floats, y: Floats) -> Floats:
            along, across = (
                _wrapped(each - way, axis, grid)
                for axis, (each, way) in enumerate(zip((x, y), position, strict=True))
            )
            return self._value(along, across, time)

        return value

    def _value(self, x: Floats, y: Floats, time: float) -> Floats:
        wanted = np.broadcast_shapes(x.shape, y.shape)
        try:
            given = self.function(x, y, time) if self.timed else self.function(x, y)
            value = real_array("pressure(x, y)", given, "Pa")
            whole = np.broadcast_to(value, wanted)
        except (ValueError, TypeError, IndexError) as error:
            raise ValueError(
                f"pressure(x, y) must give a value for each point of arrays x and y of any shape, "
                f"as here {x.shape} and {y.shape}: {error}; compute with NumPy's functions, value "
                "by value"
            ) from None
        if not np.isfinite(whole).all():
            raise ValueError(
                f"pressure(x, y) must be finite, got {whole[~np.isfinite(whole)][0]} at "
                f"t = {format_quantity(time, 's')}; a formula with an edge needs np.where or "
                "np.maximum"
            )
        return whole


def pressure_formula(function: Callable[..., Any]) -> PressureFormula:
    """Pressure as a function, which must take (x, y) or (x, y, t)."""
    try:
        arguments = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):  # built in: of two arguments
        return PressureFormula(function, timed=False)
    needed = [
        each
        for each in arguments
        if each.default is each.empty
        and each.kind in (each.POSITIONAL_ONLY, each.POSITIONAL_OR_KEYWORD)
    ]
    if len(needed) not in (2, 3):
        raise ValueError(
            "pressure: a function must take (x, y), or (x, y, t) for one that varies in time, got "
            f"one of {len(needed)} arguments"
        )
    return PressureFormula(function, timed=len(needed) == 3)


def _wrapped(positions: Floats, axis: int, grid: Grid) -> Floats:
    """Positions, along a period those in the grid [m]."""
    if not grid.periodic[axis]:
        return positions
    period, low = grid.size[axis], grid.centre[axis] - grid.size[axis] / 2
    return np.asarray(low + (positions - low) % period)
