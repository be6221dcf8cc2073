"""Given pressure of any kind: means over cells at a time."""

from __future__ import annotations

from abc import ABC, abstractmethod

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid


class GivenPressure(ABC):
    """Pressure over a grid in time, in the frame of what carries it."""

    #: Instants of maps over time [s]; None for a pressure that is held, or a formula.
    times: Floats | None = None
    #: Coordinates x and y of the cells as given [m]; None for those of the grid.
    axes: tuple[Floats, Floats] | None = None

    @property
    def varies(self) -> bool:
        """True for a pressure that is not linear in time between its instants."""
        return False

    @abstractmethod
    def at(
        self, time: float, position: tuple[float, float], grid: Grid, *, edges: bool = True
    ) -> Floats:
        """Mean pressure in each cell at a time [s], with its frame at a position [m]; (nx, ny).

        Without edges those of a formula are not looked for.
        """
