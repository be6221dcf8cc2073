"""Contacts of the cases: grids by cells on a radius, runs and their histories."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter, Paraboloid
from viscontact.bodies.loads import LoadHistory, TemperatureHistory
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.state import ContactState, Outcome
from viscontact.simulation.transient.state_generator import march

RADIUS, FORCE = 0.01, 10.0  # of the ball [m], on it [N]
BALL = Paraboloid(RADIUS, RADIUS)  # Hertz's sphere is a paraboloid

#: Parts of a step within which contact is lost or made.
PARTS = 40


@dataclass(frozen=True, eq=False)
class CaseRun:
    """Run of a case: its grid and the states at all times."""

    grid: Grid
    states: tuple[ContactState, ...]  # at all times

    def over_time(self, name: str) -> Floats:
        """Attribute of the states at each time."""
        return np.array([getattr(state, name) for state in self.states], dtype=float)

    @property
    def radius(self) -> Floats:
        """Radius of the circle of the contact area [m]."""
        return np.sqrt(self.over_time("contact_area") / math.pi)

    @property
    def central_pressure(self) -> Floats:
        """Pressure of the central cell of an odd grid [Pa]."""
        middle = tuple(n // 2 for n in self.grid.shape)
        return np.array([state.pressure[middle] for state in self.states])

    @property
    def changes(self) -> list[tuple[float, float]]:
        """Steps within which contact is made or lost: begin and end [s]."""
        touching = self.over_time("outcome") == Outcome.CONVERGED
        ends = np.flatnonzero(np.diff(touching))
        times = self.over_time("time")
        return [(float(times[k]), float(times[k + 1])) for k in ends]


def grid_around(
    semi_axes: tuple[float, float], cells: float, *, margin: float = 1.25, odd: bool = True
) -> Grid:
    """Grid with `cells` cells on each semi-axis of a contact [m]."""
    count = 2 * int(margin * cells + 1) + odd
    return Grid((count, count), (count * semi_axes[0] / cells, count * semi_axes[1] / cells))


def press(  # noqa: PLR0913
    material: Material | Layered,
    load: LoadHistory,
    times: Iterable[float],
    grid: Grid,
    *,
    indenter: Indenter = BALL,
    indenter_material: Material | None = None,
    tolerance: float = 1e-7,
    temperature: TemperatureHistory | None = None,
) -> CaseRun:
    """Run a contact and keep all states."""
    states = march(
        indenter,
        material,
        load,
        grid,
        list(times),
        indenter_material=indenter_material,
        tolerance=tolerance,
        temperature=temperature,
    )
    return CaseRun(grid, tuple(states))


def press_ball(
    material: Material,
    load: LoadHistory,
    times: Iterable[float],
    radius: float,
    cells: float,
    *,
    indenter_material: Material | None = None,
    margin: float = 1.25,
) -> CaseRun:
    """Run the contact of the ball on an odd grid with `cells` cells on a contact radius [m]."""
    # Not a whole number, so that no mesh meets the rim by design.
    grid = grid_around((radius, radius), cells + 0.3, margin=margin)
    return press(material, load, times, grid, indenter_material=indenter_material)


def instants_of_change(
    material: Material, load: LoadHistory, times: Floats, radius: float, cells: float
) -> list[float]:
    """Instants of contact made and lost, without the first contact [s]."""
    # The middles of the parts of divided steps, found in a second run on the same mesh.
    first = press_ball(material, load, times, radius, cells)
    between = [np.linspace(begin, end, PARTS + 1) for begin, end in first.changes[1:]]
    finer = np.unique(np.concatenate([times, *between]))
    second = press_ball(material, load, finer, radius, cells)
    return [(begin + end) / 2 for begin, end in second.changes[1:]]
