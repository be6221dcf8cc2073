"""State of a frictional contact from step to step, and the tractions found in a step."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from viscontact.backend.arrays import Bools, Flags, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.friction.discs import lengths, on_circle
from viscontact.mechanics.contact.friction.normal_contact import NormalContact
from viscontact.mechanics.contact.friction.problem import SlipSolution
from viscontact.mechanics.contact.friction.region import Region, ShearDomain
from viscontact.mechanics.contact.friction.rigid_shift import ShiftConstraints
from viscontact.simulation.transient.grid_enlargement import GridEnlargement

#: Part of what friction carries, and of the displacements of a step, that counts as rounding.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class StepSlip:
    """Tractions at the end of a step and slip over it, on the whole grid."""

    traction: Floats  # [Pa], (2, nx, ny)
    slip: Floats  # of the surface under the body in the step [m], (2, nx, ny)
    state: Flags  # 0 open, 1 stick, 2 slip
    motion: Floats  # shifts [m] and rotation [rad] of the body in the step
    forces: Floats  # along x and y [N] and torque [N m]
    duality_gap: float = 0.0  # [-]
    residual: float = 0.0  # of the friction law [-]
    displacement: float = 0.0  # largest one of the step [m]
    way: Floats | None = None  # slip of all cells, open ones as well, if kept [m], (2, nx, ny)

    @classmethod
    def apart(cls, shape: tuple[int, int], constraints: ShiftConstraints) -> StepSlip:
        """Step without contact: only a prescribed motion goes on."""
        nothing, nowhere = np.zeros((2, *shape)), np.zeros(shape, np.int8)
        return cls(nothing, nothing, nowhere, constraints.motions, np.zeros(3))

    @classmethod
    def at_rest(cls, contact: NormalContact) -> StepSlip:
        """Step of bodies that nothing moves along each other: all cells stick without traction."""
        nothing, sticks = np.zeros((2, *contact.gap.shape)), contact.gripping.astype(np.int8)
        return cls(nothing, nothing, sticks, np.zeros(3), np.zeros(3), way=nothing)


def step_slip(
    found: SlipSolution,
    constraints: ShiftConstraints,
    domain: ShearDomain,
    region: Region,
    carried: float,
) -> StepSlip:
    """Solution on a region, as that of the whole grid; friction carries up to `carried` [N]."""
    traction, slip, state = (
        domain.spread(region, each) for each in (found.traction, found.slip, found.state)
    )
    arms = np.array([1.0, 1.0, constraints.arm])
    forces = domain.shift(region).resultants(found.traction)
    # What rounding leaves of symmetric loads is none.
    forces[np.abs(forces) < ROUNDING * carried * arms] = 0.0
    moved = found.motion * arms
    noise = ROUNDING * max(float(np.abs(moved).max()), found.displacement)
    moved[constraints.free & (np.abs(moved) < noise)] = 0.0
    return StepSlip(
        traction,
        slip,
        state,
        moved / arms,
        forces,
        found.duality_gap,
        found.residual,
        found.displacement,
    )


@dataclass(frozen=True, eq=False)
class SlipState:
    """What a frictional contact keeps from step to step, over the whole grid."""

    traction: Floats  # [Pa], (2, nx, ny)
    slip: Floats  # since the contact of each cell [m], (2, nx, ny)
    work: Floats  # of friction per area since the start [J/m²], (nx, ny)
    contact: NormalContact  # at the end of the step before
    touched: Bools  # cells that have carried a traction
    motion: Floats  # shifts [m] and rotation [rad] of the body
    forces: Floats  # along x and y [N] and torque [N m]
    heat: float = 0.0  # of friction since the start [J]

    @classmethod
    def at_first(cls, gap: Floats) -> SlipState:
        """State before a run, of bodies that just touch."""
        pair, field = np.zeros((2, *gap.shape)), np.zeros(gap.shape)
        contact = NormalContact.apart(gap)
        return cls(pair, pair, field, contact, contact.in_contact, np.zeros(3), np.zeros(3))

    def on(self, enlargement: GridEnlargement) -> SlipState:
        """The same state on a larger grid."""
        small, large = enlargement.small.grid, enlargement.large.grid

        def embedded(field: Any, beyond: Any = 0.0) -> Any:
            if field.ndim == 2:
                return small.embed(field, large, beyond=beyond)
            return np.stack([small.embed(part, large, beyond=beyond) for part in field])

        return replace(
            self,
            traction=embedded(self.traction),
            slip=embedded(self.slip),
            work=embedded(self.work),
            contact=self.contact.on(embedded),
            touched=embedded(self.touched, False),
        )

    def after(
        self,
        contact: NormalContact,
        step: StepSlip,
        coefficient: float,
        cell_area: float,
        *,
        cut: tuple[slice, slice] = (slice(None), slice(None)),
        moves: bool = False,
    ) -> SlipState:
        """State after a step in contact, of a body that moves over the surface or stands.

        The contact is in a part of the grid.
        """
        # The friction of the mean pressure over the way of the slip: exact where both grow
        # linearly, while the mean traction over it loses a quarter in one step.
        lost = lengths(step.slip[:, *cut])
        lost *= self.contact.pressure[cut] + contact.pressure[cut]
        lost *= coefficient / 2
        slip, work = np.zeros(self.slip.shape), self.work.copy()
        slip[:, *cut] = (self.slip[:, *cut] + step.slip[:, *cut]) * contact.in_contact[cut]
        work[cut] += lost
        if moves:
            left = self._lost_on_leaving(contact, step, coefficient)
            work, lost = work + left, lost + left[cut]
        return SlipState(
            step.traction,
            slip,
            work,
            contact,
            self.touched | contact.in_contact,
            self.motion + step.motion,
            step.forces,
            self.heat + float(lost.sum()) * cell_area,
        )

    def _lost_on_leaving(
        self, contact: NormalContact, step: StepSlip, coefficient: float
    ) -> Floats:
        """Work of friction per area in cells that a moving body leaves in a step [J/m²]."""
        # They slip until the edge passes. As their pressure falls to zero within the step, half of
        # their traction over the whole way of the step completes the rule of trapezoids.
        assert step.way is not None  # kept for a body that moves
        leaves = self.contact.in_contact & ~contact.in_contact
        slips = on_circle(self.traction, coefficient * self.contact.pressure, leaves)
        work = -(self.traction * step.way).sum(axis=0) / 2
        return np.asarray(np.where(slips, np.maximum(work, 0.0), 0.0))

    def apart(self, gap: Floats, step: StepSlip) -> SlipState:
        """State after a step without contact, at whose end the bodies are apart by a gap [m]."""
        return replace(
            self,
            traction=step.traction,
            slip=np.zeros_like(self.slip),
            contact=NormalContact.apart(gap),
            motion=self.motion + step.motion,
            forces=step.forces,
        )
