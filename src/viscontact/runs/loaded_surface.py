"""Surface under a given pressure that stands or moves: its instants, displacement and error."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.motion import Motion
from viscontact.mechanics.problem.pressure_history import displacement_under
from viscontact.mechanics.problem.surface import SurfaceTerms
from viscontact.runs.given_pressure import GivenPressure
from viscontact.units.formatting import format_quantity

#: Tension over the largest pressure that is rounding.
ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class LoadedSurface:
    """A given pressure on the cells of a grid."""

    given: GivenPressure
    grid: Grid
    motion: Motion
    tension: bool  # negative pressure is allowed

    def pressures(self, instants: Floats) -> Iterator[Floats]:
        """Pressures at instants [Pa], one after the other, each of shape (nx, ny)."""
        for time in instants.tolist():
            along, across = self.motion.position_at(time).tolist()
            pressure = self.given.at(time, (along, across), self.grid)
            self._check(pressure, time)
            yield pressure

    def _check(self, pressure: Floats, time: float) -> None:
        least = float(pressure.min())
        if not self.tension and least < -ROUNDING * np.abs(pressure).max():
            x, y = self.grid.largest_at(-pressure)
            raise ValueError(
                f"pressure: it pulls with {format_quantity(-least, 'Pa')} at "
                f"x = {format_quantity(x, 'm', 4)}, y = {format_quantity(y, 'm', 4)} and "
                f"t = {format_quantity(time, 's', 4)}; pressure is positive in compression: change "
                "its sign, or allow tension with tension=True"
            )

    def instants(self, times: Floats) -> Floats:
        """Instants between which the pressure is taken as linear, from 0 to the last time [s]."""
        motion = self.motion
        marks = [np.zeros(1), times]
        if self.given.times is not None:
            marks.append(self.given.times)
        if not motion.stands:
            marks += [motion.times_at_cells(self.grid.cell_size), motion.kinks]
        found = np.unique(np.concatenate(marks))
        return np.asarray(found[(found >= 0) & (found <= times[-1])])

    def displacement(self, surface: SurfaceTerms, times: Floats) -> Floats:
        """Displacement at times [m], shape (times, nx, ny)."""
        return self._displacement(surface, times, self._halved(times))

    def error(self, surface: SurfaceTerms, times: Floats, displacement: Floats) -> Floats:
        """Change of the displacement by larger cells, and by fewer instants, over time [m]."""
        by_cells = self._displacement(surface, times, self._halved(times), self._averaged)
        error = np.abs(by_cells - displacement).max(axis=(1, 2))
        if self._curved:
            by_time = self._displacement(surface, times, self.instants(times))
            error += np.abs(by_time - displacement).max(axis=(1, 2))
        return np.asarray(error)

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

    def _displacement(
        self,
        surface: SurfaceTerms,
        times: Floats,
        instants: Floats,
        change: Callable[[Floats], Floats] = np.asarray,
    ) -> Floats:
        pressures = map(change, self.pressures(instants))
        return displacement_under(pressures, instants, surface, self.grid, times)

    def _averaged(self, pressure: Floats) -> Floats:
        """Pressure averaged over cells twice as long and wide; a last odd line stays."""
        coarse = pressure.copy()
        for axis in (0, 1):
            lines = np.moveaxis(coarse, axis, 0)
            even = lines.shape[0] // 2 * 2
            lines[0:even:2] = (lines[0:even:2] + lines[1:even:2]) / 2
            lines[1:even:2] = lines[0:even:2]
        return coarse
