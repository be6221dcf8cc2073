"""Pressure that is given as maps: one that is held, or several in time."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.runs.given_pressure.pressure import GivenPressure
from viscontact.units.formatting import format_quantity

#: Part of the force that is not lost beyond the grid.
LOST = 1e-9


@dataclass(frozen=True, eq=False)
class PressureMap(GivenPressure):
    """Pressure uniform in each cell, held or linear in time between maps."""

    maps: Floats  # shape (maps, nx, ny) [Pa]
    times: Floats | None = None  # of the maps [s]
    axes: tuple[Floats, Floats] | None = None  # of the cells, along x and y [m]

    def at(
        self, time: float, position: tuple[float, float], grid: Grid, *, edges: bool = True
    ) -> Floats:
        """Mean pressure in each cell; a map that moves is shared out to those that it covers."""
        field = self._held(time)
        for axis, way in enumerate(position):
            if way:
                field = _moved(field, way / grid.cell_size[axis], axis, grid.periodic[axis])
        self._require_kept(field, time, position)
        return field

    def _held(self, time: float) -> Floats:
        if self.times is None:
            return np.asarray(self.maps[0])
        place = float(np.interp(time, self.times, np.arange(self.times.size)))
        below = min(int(place), self.times.size - 2) if self.times.size > 1 else 0
        share = place - below
        if not share:
            return np.asarray(self.maps[below])
        return np.asarray((1 - share) * self.maps[below] + share * self.maps[below + 1])

    def _require_kept(self, field: Floats, time: float, position: tuple[float, float]) -> None:
        whole = self._held(time)
        if np.abs(whole).sum() - np.abs(field).sum() > LOST * np.abs(whole).sum():
            at = " and ".join(format_quantity(each, "m", 4) for each in position)
            raise ValueError(
                f"grid: the pressure leaves it at t = {format_quantity(time, 's', 4)}, moved by "
                f"{at} along x and y; give a grid that holds the whole path, or a periodic one"
            )


def _moved(field: Floats, cells: float, axis: int, periodic: bool) -> Floats:
    """Field moved by a number of cells; what leaves a grid without period is lost."""
    whole = int(np.floor(cells))
    share = cells - whole
    return (1 - share) * _rolled(field, whole, axis, periodic) + share * _rolled(
        field, whole + 1, axis, periodic
    )


def _rolled(field: Floats, cells: int, axis: int, periodic: bool) -> Floats:
    rolled = np.roll(field, cells, axis)
    if periodic or not cells:
        return rolled
    lines = np.moveaxis(rolled, axis, 0)
    count = min(abs(cells), lines.shape[0])
    lines[slice(count) if cells > 0 else slice(lines.shape[0] - count, None)] = 0.0
    return rolled
