"""Surface under a given pressure that stands or moves: its instants, displacement and error."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.motion import Motion
from viscontact.mechanics.problem.pressure_history import creep_weights, displacement_under
from viscontact.mechanics.problem.surface import SurfaceTerms
from viscontact.runs.given_pressure.formula import PressureFormula
from viscontact.runs.given_pressure.near_field import REACH, NearField
from viscontact.runs.given_pressure.pressure import GivenPressure
from viscontact.runs.given_pressure.resolved import BY_POINTS, COARSE, FINE, resolved
from viscontact.units.formatting import format_quantity

#: Tension over the largest pressure that is rounding.
ROUNDING = 1e-12

#: Error that a change does not show, over the tolerance; and cells fewer that are near where that
#: change is found.
OF_TOLERANCE, LESS_REACH = 5.0, 2

#: Most instants times cells along the grid at which the edges of a formula are found, with so many
#: cells at least.
MOST_EDGES, FOR_CALLS = 1500, 50

#: Cells over the thickness of a layer, from which on what is near is a half-space, and a good one;
#: error of that over the displacement and the fourth power of cell over thickness.
LEAST, ENOUGH, OF_LAYERS = 2.0, 8.0, 0.01

#: Parts of cells along each axis that layers may ask for, and most small cells then; of those on a
#: grid with one period, whose coefficients take longest.
PARTS, MOST_CELLS, MOST_OF_ONE_PERIOD = (1, 3, 9, 27), 1_500_000, 10_000


@dataclass(frozen=True, eq=False)
class LoadedSurface:
    """A given pressure on the cells of a grid."""

    given: GivenPressure
    grid: Grid
    motion: Motion
    tension: bool  # negative pressure is allowed

    def mean_pressures(self, times: Floats) -> Floats:
        """Pressures in the cells at times [Pa], shape (times, nx, ny)."""
        return np.stack(list(self._means(times)))

    def displacement_and_error(
        self, surface: SurfaceTerms, times: Floats, *, errors: bool = True
    ) -> tuple[Floats, Floats]:
        """Displacement at times [m], and its largest error over the cells over time [m]."""
        thickness = min(term.response.length for term in surface.terms)
        parts = self._parts(thickness)
        cell = max(self._edges_of_cells()) / parts
        if isinstance(self.given, PressureFormula) and LEAST * cell <= thickness:
            found, lost = self._of_formula(self.given, surface, times, parts)
            relative = OF_TOLERANCE * FINE.tolerance + OF_LAYERS * (cell / thickness) ** 4 + lost
            error = relative * np.abs(found).max(axis=(1, 2))
            if errors and self._has_edges(times):
                coarse, _ = self._of_formula(self.given, surface, times, parts, coarsely=True)
                error += np.abs(found - coarse).max(axis=(1, 2))
            elif errors:
                error += self._error_of_cells(surface, times)
        else:
            found = self._of_means(surface, times, self._halved(times))
            error = self._error_of_cells(surface, times) if errors else np.zeros(times.size)
        if errors and self._curved:
            fewer = self._of_means(surface, times, self.instants(times))
            change = fewer - self._of_means(surface, times, self._halved(times))
            error = error + np.abs(change).max(axis=(1, 2))
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

    def _has_edges(self, times: Floats) -> bool:
        """True at few enough instants that the edges of a formula are found."""
        cells = FOR_CALLS + math.prod(self.grid.shape) ** 0.5
        return self._held or self._halved(times).size * cells <= MOST_EDGES

    def _edges_of_cells(self) -> list[float]:
        """Edges of the cells, but for that along a strip [m]."""
        each = zip(self.grid.cell_size, self.grid.shape, strict=True)
        return [size for size, count in each if count > 1] or list(self.grid.cell_size)

    def _parts(self, thickness: float) -> int:
        """Parts of cells along each axis, so that they are small against the layers."""
        one_period = self.grid.periodic[0] != self.grid.periodic[1]
        most = MOST_OF_ONE_PERIOD if one_period else MOST_CELLS
        wanted = ENOUGH * max(self._edges_of_cells()) / thickness
        found = 1
        for number in PARTS[1:]:
            if wanted > found and math.prod(self._divided(number).shape) <= most:
                found = number
        return found

    def _divided(self, parts: int) -> Grid:
        along, across = (n * (parts if n > 1 else 1) for n in self.grid.shape)
        return self.grid if parts == 1 else replace(self.grid, shape=(along, across))

    def _of_formula(
        self,
        given: PressureFormula,
        surface: SurfaceTerms,
        times: Floats,
        parts: int,
        *,
        coarsely: bool = False,
    ) -> tuple[Floats, float]:
        """Displacement under a formula at times [m], on cells of so many parts.

        And the largest part of its force that is not found.
        """
        grid, instants = self._divided(parts), self._halved(times)
        field = NearField(grid, REACH - LESS_REACH if coarsely else REACH)
        effort = COARSE if coarsely else FINE if self._has_edges(times) else BY_POINTS
        near, lost = np.zeros((instants.size, *grid.shape)), np.zeros(instants.size)

        def carriers() -> Iterator[Floats]:
            for index, time in enumerate(instants.tolist()):
                values = given.values_at(time, self._position_at(time), grid)
                pressure = resolved(values, field, effort)
                near[index], lost[index] = pressure.near, pressure.relative_loss
                yield pressure.carriers

        far = displacement_under(carriers(), instants, surface, field.padded, times)
        weights = creep_weights(surface.compliance, instants, times)
        found = field.inner(far) + np.tensordot(weights, near, axes=1)
        first, second = (parts // 2 if n > 1 else 0 for n in self.grid.shape)
        steps = [parts if n > 1 else 1 for n in self.grid.shape]
        return np.asarray(found[:, first :: steps[0], second :: steps[1]]), float(lost.max())

    def _of_means(
        self,
        surface: SurfaceTerms,
        times: Floats,
        instants: Floats,
        change: Callable[[Floats], Floats] = np.asarray,
    ) -> Floats:
        """Displacement at times under the means over cells, perhaps changed [m]."""
        pressures = map(change, self._means(instants))
        return displacement_under(pressures, instants, surface, self.grid, times)

    def _means(self, instants: Floats) -> Iterator[Floats]:
        """Mean pressures at instants in the cells [Pa], one after the other."""
        pressure = None
        for time in instants.tolist():
            if pressure is None or not self._held:
                position = self._position_at(time)
                pressure = self.given.at(time, position, self.grid, edges=self._held)
                self._check(pressure, self.grid, time)
            yield pressure

    def _position_at(self, time: float) -> tuple[float, float]:
        along, across = self.motion.position_at(time).tolist()
        return along, across

    def _check(self, pressure: Floats, grid: Grid, time: float) -> None:
        if self._held and isinstance(self.given, PressureFormula) and not pressure.any():
            along, across = (
                f"{format_quantity(each[0], 'm', 4)} to {format_quantity(each[-1], 'm', 4)}"
                for each in (grid.x, grid.y)
            )
            raise ValueError(
                f"pressure: pressure(x, y) is 0 wherever it was tried in the cells, x = {along} "
                f"and y = {across}; give a grid around the load, of cells that are not much larger"
            )
        least = float(pressure.min())
        if not self.tension and least < -ROUNDING * np.abs(pressure).max():
            x, y = grid.largest_at(-pressure)
            raise ValueError(
                f"pressure: it pulls with {format_quantity(-least, 'Pa')} at "
                f"x = {format_quantity(x, 'm', 4)}, y = {format_quantity(y, 'm', 4)} and "
                f"t = {format_quantity(time, 's', 4)}; pressure is positive in compression: change "
                "its sign, or allow tension with tension=True"
            )

    def _error_of_cells(self, surface: SurfaceTerms, times: Floats) -> Floats:
        """Change of the displacement by cells twice as long and wide, over time [m]."""
        instants = self._halved(times)
        by_larger = self._of_means(surface, times, instants, self._averaged)
        change = by_larger - self._of_means(surface, times, instants)
        return np.asarray(np.abs(change).max(axis=(1, 2)))

    def _averaged(self, pressure: Floats) -> Floats:
        """Pressure averaged over cells twice as long and wide; a last odd line stays."""
        coarse = pressure.copy()
        for axis in (0, 1):
            lines = np.moveaxis(coarse, axis, 0)
            even = lines.shape[0] // 2 * 2
            lines[0:even:2] = (lines[0:even:2] + lines[1:even:2]) / 2
            lines[1:even:2] = lines[0:even:2]
        return coarse
