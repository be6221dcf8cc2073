"""Passes of the search for the pressure of one contact over the cells of a patch.

`NumPyPasses` has them in NumPy. `CompiledPasses` has the same in C++, where a few cells take a
fiftieth and many cells half of the time. The two agree to rounding, not to the bit, so that a run
keeps the passes that it began with.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TypeAlias

from viscontact.backend.arrays import Bools, Floats, Numbers, Singles
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.rigid_balance import Constraints

#: Inverse Gram matrix: an array, or rows of plain numbers of passes that take them so.
Gram: TypeAlias = Floats | tuple[tuple[float, float, float], ...]


@dataclass(frozen=True, eq=False)
class Measured:
    """Gap under a pressure, with the rigid motion that fits it best."""

    motion: Floats  # approach [m], tilts [rad]
    inverse_gram: Gram  # of the planes over the cells under pressure
    largest: float  # displacement [m]
    error: float  # largest gap under pressure or penetration, in the unit of the gap


@dataclass(frozen=True, eq=False)
class Way:
    """Next direction of a search and the step that is tried first, as products of it."""

    slope: float  # of the direction against the residual
    #: The step leads to a pressure set aside, cut off and balanced; else it is the direction.
    is_projected: bool
    curvature: float  # product of the step and its unit displacement
    along: float  # product of the step and the residual


@dataclass(frozen=True, eq=False)
class StepAhead:
    """Step towards a pressure that has been set aside, still to be taken."""

    ahead: Floats  # that pressure [Pa]
    step: Singles  # way to it, in a unit of pressure
    change: Singles  # unit displacement of the step
    part: float  # of the way; 1 and more: all of it
    unit: float  # unit of the step [Pa]


class SearchPasses(ABC):
    """Passes over the cells of one patch. Fields are those of the patch, shape (nx, ny).

    Pressure [Pa] and unit displacement [Pa m] are the two fields of `values`; directions and steps
    are in single precision.
    """

    @abstractmethod
    def measure(
        self,
        values: Floats,
        motion: Floats,
        spring: tuple[Floats, float],
        constraints: Constraints,
        into: tuple[Bools, Numbers],
        unit: float = 1.0,
        step: StepAhead | None = None,
    ) -> Measured:
        """Fit the free motions by least squares over the cells under pressure.

        `spring` is the open gap [m] and the compliance [1/Pa]. Cells under pressure and gap, in a
        `unit` [m], are written to `into`, after a `step` if there is one.
        """

    @abstractmethod
    def release(
        self, active: Bools, last: Bools, gap: Singles, constraints: Constraints
    ) -> tuple[int, Gram | None]:
        """Add overlapped cells to the active ones, and set the gap of the others to zero.

        Returns the number of active cells unlike the last ones, and the inverse Gram matrix over
        the active ones, or None where no cell was added.
        """

    @abstractmethod
    def follow(self, stiffness: Singles, active: Bools, last: Bools, near: Singles) -> None:
        """Add the stiffness `near` (3, 3) changed cells to those around them [1/m]."""

    @abstractmethod
    def direct(
        self,
        found: Singles,
        last: tuple[Singles, Singles, float],
        residual: tuple[Singles, Bools],
        stiffness: tuple[Singles, float],
        inverse_gram: Gram,
        shift: float,
        *,
        changed: bool,
    ) -> float:
        """Turn a preconditioned residual into the next direction, in its memory.

        The correction at the rim, a part of the `stiffness` there, and a uniform `shift` come
        first. Then direction and, where active cells have `changed`, the last one are projected: on
        the active cells, without force and moments. They are conjugated by Polak & Ribiere's
        formula. `last` is the last direction, residual and slope; returns the new slope.
        """

    @abstractmethod
    def trial(
        self,
        pressure: Floats,
        direction: tuple[Singles, float],
        ahead: Floats,
        step: tuple[Singles, float],
        constraints: Constraints,
        size: tuple[float, float],
    ) -> bool:
        """Step along a direction by a length; whether that leads to tension that can be cut off.

        The pressure after it, cut off and balanced, is written to `ahead`, and the way there to
        `step`, in a unit [Pa]. `size` is the area of a cell [m²], and the arm of moments [m].
        """

    @abstractmethod
    def balance(
        self, pressure: Floats, constraints: Constraints, cell_area: float, arm: float
    ) -> bool:
        """Cut off tension and balance by a plane factor; False where no factor does it."""

    @abstractmethod
    def weigh(
        self, pressure: Floats, constraints: Constraints, cell_area: float, arm: float
    ) -> tuple[float, float]:
        """Least pressure [Pa], and largest error of its resultants over the force [-]."""

    @abstractmethod
    def difference(self, ahead: Floats, pressure: Floats, unit: float, step: Singles) -> None:
        """Write the way from one pressure to another to `step`, in a unit [Pa]."""

    @abstractmethod
    def inner(self, field: Singles, first: Singles, second: Singles) -> tuple[float, float]:
        """Inner products of a field with two others, in double precision."""

    @abstractmethod
    def move(self, values: Floats, step: Singles, change: Singles, length: float) -> float:
        """Take a step of known unit displacement, and return the least pressure [Pa]."""

    @abstractmethod
    def sums(self, values: Floats) -> Floats:
        """Sums of a field against 1, x, y."""
