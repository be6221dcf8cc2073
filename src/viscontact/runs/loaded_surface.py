"""Surface under a given pressure that stands or moves: its instants, displacement and error."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.motion import Motion
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE
from viscontact.mechanics.problem.pressure_history import displacement_under
from viscontact.mechanics.problem.surface import SurfaceTerms
from viscontact.runs.given_pressure import GivenPressure
from viscontact.units.formatting import format_quantity

#: Tension over the largest pressure that is rounding.
ROUNDING = 1e-12


#: Cells into which a cell is divided along each axis for a formula, most first: odd, so that one
#: lies in its middle.
PARTS = (27, 9, 3)

#: Most small cells times pressures, with as many for a pressure at least as take the time of its
#: calls; also for layers on a grid with one period, whose coefficients take longest.
MOST_CELLS, FOR_CALLS, MOST_OF_ONE_PERIOD = 1_500_000, 20_000, 10_000

#: Relative tolerance of the means of a formula over cells; over small ones it is this times the
#: power 2/3 of their number along an axis, so that edges take the same time.
TOLERANCE = 3e-6

#: Error of the extrapolation over the change by cells three times as long and wide: 3/8 beside an
#: edge across which the pressure jumps, where it is of first order, and twice that as it is uneven.
OF_CHANGE = 0.75


@dataclass(frozen=True, eq=False)
class LoadedSurface:
    """A given pressure on the cells of a grid."""

    given: GivenPressure
    grid: Grid
    motion: Motion
    tension: bool  # negative pressure is allowed

    def mean_pressures(self, times: Floats) -> Floats:
        """Pressures in the cells at times [Pa], shape (times, nx, ny)."""
        return np.stack(list(self._pressures(times, (1, 1))))

    def displacement_and_error(
        self, surface: SurfaceTerms, times: Floats, *, errors: bool = True
    ) -> tuple[Floats, Floats]:
        """Displacement at times [m], and its largest error over the cells over time [m].

        A formula is averaged over small cells, and the displacement extrapolated from two sizes of
        them, as its error falls with their square where the pressure is smooth.
        """
        instants, number = self._halved(times), self._parts(surface, times)
        found = self._displacement(surface, times, instants, number)
        if number == 1:
            error = self._error_of_cells(surface, times, found) if errors else np.zeros(times.size)
            coarse = found
        else:
            coarse = self._displacement(surface, times, instants, number // 3)
            change = found - coarse
            found, error = found + change / 8, OF_CHANGE * np.abs(change).max(axis=(1, 2))
        if errors and self._curved:
            at_fewer = self._displacement(surface, times, self.instants(times), max(number // 3, 1))
            error = error + np.abs(at_fewer - coarse).max(axis=(1, 2))
        return found, np.asarray(error)

    def instants(self, times: Floats) -> Floats:
        """Instants between which the pressure is taken as linear, from 0 to the last time [s]."""
        if self._held:
            return np.zeros(1)
        motion = self.motion
        marks = [np.zeros(1), times]
        if self.given.times is not None:
            marks.append(self.given.times)
        if not motion.stands:
            marks += [motion.times_at_cells(self.grid.cell_size), motion.kinks]
        found = np.unique(np.concatenate(marks))
        return np.asarray(found[(found >= 0) & (found <= times[-1])])

    @property
    def _held(self) -> bool:
        """True for a pressure that comes and does not change."""
        return self.given.times is None and not self._curved

    @property
    def _curved(self) -> bool:
        """True if the pressure is not linear in time between the instants."""
        return self.given.varies or not self.motion.stands

    def _halved(self, times: Floats) -> Floats:
        """Instants, with the middles between them where the pressure is curved."""
        instants = self.instants(times)
        if not self._curved:
            return instants
        return np.sort(np.concatenate([instants, (instants[1:] + instants[:-1]) / 2]))

    def _parts(self, surface: SurfaceTerms, times: Floats) -> int:
        """Small cells along each axis of a cell: 1 for a map, or if there would be too many."""
        if not self.given.is_known_everywhere:
            return 1
        layered = any(term.response is not HALF_SPACE for term in surface.terms)
        slow = layered and self.grid.periodic[0] != self.grid.periodic[1]
        fields = 1 if self._held else max(self._halved(times).size, times.size)
        most = (MOST_OF_ONE_PERIOD if slow else MOST_CELLS) // fields
        return next((m for m in PARTS if most >= max(self._cells(m), FOR_CALLS * (not slow))), 1)

    def _cells(self, number: int) -> int:
        return math.prod(self.grid.shape) * math.prod(self._along_axes(number))

    def _along_axes(self, number: int) -> tuple[int, int]:
        """Small cells along x and y; one along an axis of a single cell, a long strip."""
        along, across = (number if count > 1 else 1 for count in self.grid.shape)
        return along, across

    def _displacement(
        self,
        surface: SurfaceTerms,
        times: Floats,
        instants: Floats,
        number: int,
        change: Callable[[Floats], Floats] = np.asarray,
    ) -> Floats:
        parts = self._along_axes(number)
        pressures = map(change, self._pressures(instants, parts))
        grid = self._divided(parts)
        return displacement_under(pressures, instants, surface, grid, times, parts)

    def _divided(self, parts: tuple[int, int]) -> Grid:
        shape = (self.grid.shape[0] * parts[0], self.grid.shape[1] * parts[1])
        return self.grid if parts == (1, 1) else replace(self.grid, shape=shape)

    def _pressures(self, instants: Floats, parts: tuple[int, int]) -> Iterator[Floats]:
        """Mean pressures at instants in small cells [Pa], one after the other."""
        grid, pressure = self._divided(parts), None
        tolerance = TOLERANCE * max(parts) ** (2 / 3)
        if max(parts) == 1 and not self._held:
            tolerance = np.inf  # edges are not worth their time in cells that are not divided
        for time in instants.tolist():
            if pressure is None or not self._held:
                along, across = self.motion.position_at(time).tolist()
                pressure = self.given.at(time, (along, across), grid, tolerance)
                self._check(pressure, grid, time)
            yield pressure

    def _check(self, pressure: Floats, grid: Grid, time: float) -> None:
        least = float(pressure.min())
        if not self.tension and least < -ROUNDING * np.abs(pressure).max():
            x, y = grid.largest_at(-pressure)
            raise ValueError(
                f"pressure: it pulls with {format_quantity(-least, 'Pa')} at "
                f"x = {format_quantity(x, 'm', 4)}, y = {format_quantity(y, 'm', 4)} and "
                f"t = {format_quantity(time, 's', 4)}; pressure is positive in compression: change "
                "its sign, or allow tension with tension=True"
            )

    def _error_of_cells(self, surface: SurfaceTerms, times: Floats, displacement: Floats) -> Floats:
        """Change of the displacement by cells twice as long and wide, over time [m]."""
        by_cells = self._displacement(surface, times, self._halved(times), 1, self._averaged)
        return np.asarray(np.abs(by_cells - displacement).max(axis=(1, 2)))

    def _averaged(self, pressure: Floats) -> Floats:
        """Pressure averaged over cells twice as long and wide; a last odd line stays."""
        coarse = pressure.copy()
        for axis in (0, 1):
            lines = np.moveaxis(coarse, axis, 0)
            even = lines.shape[0] // 2 * 2
            lines[0:even:2] = (lines[0:even:2] + lines[1:even:2]) / 2
            lines[1:even:2] = lines[0:even:2]
        return coarse
