"""Tractions of a contact in steady motion over the creepage of the body."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Field, Floats
from viscontact.backend.errors import ConvergenceError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import Transforms
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.mechanics.contact.friction.discs import lengths
from viscontact.mechanics.contact.friction.entry import entry_compliance
from viscontact.mechanics.contact.friction.newton_step import OWN
from viscontact.mechanics.contact.friction.normal_contact import NormalContact
from viscontact.mechanics.contact.friction.region import Region, ShearDomain
from viscontact.mechanics.contact.friction.rolling import (
    RollingProblem,
    RollingSolution,
    solve_rolling,
)
from viscontact.mechanics.halfspace.moving_shear import (
    MovingShear,
    moving_shear_convolution,
    moving_shear_preconditioner,
)
from viscontact.mechanics.rolling_traction import RollingTraction
from viscontact.simulation.steady_motion.contact import SteadyContact
from viscontact.simulation.steady_motion.moving_law import ShearLaw, moving_shear
from viscontact.simulation.steady_motion.problem import SteadyProblem
from viscontact.units.formatting import format_quantity

#: Part of what friction carries that is rounding.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class TractionSolver:
    """Solver of the tractions under contacts of one run, over the creepages of its motion."""

    problem: SteadyProblem
    laws: tuple[ShearLaw, ...]
    transforms: Transforms

    def solve(self, contact: SteadyContact, along: Floats | None = None) -> RollingTraction:
        """Solve for the tractions under a contact; ConvergenceError at a creepage without them.

        Its pressure displaces the surface along itself by `along` [m], shape (2, nx, ny).
        """
        under = _Pressed.of(self.problem, contact, self.transforms)
        shear = moving_shear(self.laws, contact.speed, max(contact.grid.size_about_origin))
        askew = _askew(under, self.problem.motion)
        posed = replace(_posed(under, shear, self.transforms), askew=askew)
        if along is not None:
            stretch = along - np.roll(along, -1, axis=1 + under.axis)
            posed = replace(posed, stretch=stretch[:, *under.region.cut])
        found = []
        start = np.zeros((2, *under.region.shape))
        for creepage in self.problem.motion.creepages:
            if creepage or askew is not None or along is not None:
                solution = self._solved(posed, creepage, start, contact.speed)
                start = solution.traction
            else:
                solution = _without_traction(posed)
            found.append(_evaluated(under, posed, creepage, contact.speed, solution))
        return _joined(found)

    def _solved(
        self, posed: RollingProblem, creepage: float, start: Floats, speed: float
    ) -> RollingSolution:
        tolerance = self.problem.contact.tolerance
        found = solve_rolling(posed, creepage, start, tolerance=tolerance)
        if not found.converged:
            raise ConvergenceError(
                f"the solver of friction stopped at {format_quantity(speed, 'm/s', 6)} and a "
                f"creepage of {creepage:g} with residual {found.residual:.2g}, short of the "
                f"tolerance {tolerance:g}; likely causes: a grid too coarse for the contact, or a "
                "tolerance near rounding"
            )
        return found


@dataclass(frozen=True, eq=False)
class _Pressed:
    """Contact that tractions act in: its cells and pressure on the region around it."""

    grid: Grid
    axis: int
    region: Region
    contact: NormalContact  # on the whole grid
    coefficient: float  # of friction [-]
    radius: float  # of the body in the plane of its motion; inf without curvature [m]

    @classmethod
    def of(cls, problem: SteadyProblem, contact: SteadyContact, transforms: Transforms) -> _Pressed:
        """The contact of a solution."""
        pressure, friction = contact.pressure, problem.contact.friction
        assert friction is not None  # of a problem with creepages
        normal = NormalContact(pressure, contact.gap, contact.in_contact)
        curvature = problem.contact.indenter.curvatures[problem.axis]
        domain = ShearDomain(contact.grid, transforms)
        return cls(
            contact.grid,
            problem.axis,
            domain.region_of(contact.in_contact),
            normal,
            friction.coefficient,
            1 / curvature if curvature > 0 else math.inf,
        )

    @property
    def way(self) -> float:
        """Edge of a cell along the motion [m]."""
        return self.grid.cell_size[self.axis]

    @property
    def before(self) -> NormalContact:
        """Contact of the same material a cell earlier: where it was is one cell ahead."""

        def earlier(field: Field, beyond: float) -> Field:
            moved = np.roll(field, -1, axis=self.axis)
            last = (-1, slice(None)) if self.axis == 0 else (slice(None), -1)
            moved[last] = beyond
            return moved

        held = self.contact
        return NormalContact(
            earlier(held.pressure, 0.0),
            earlier(held.gap, math.inf),
            earlier(held.in_contact, 0.0),
        )


def _posed(under: _Pressed, shear: MovingShear, transforms: Transforms) -> RollingProblem:
    """The problem of friction under a contact, but for the creepage."""
    shape, axis, grid = under.region.shape, under.axis, under.grid
    # Cells enter over the way of a cell, too short for most of the creep.
    wave = np.array(1 / under.way)
    direct, poisson = (complex(each.at_wave_number(wave)) for each in (shear.direct, shear.poisson))
    entry = entry_compliance(
        under.contact, under.before, grid.cell_size, abs(poisson / direct), plane=True
    )
    gripping = under.contact.gripping[under.region.cut]
    options = {"transforms": transforms}
    return RollingProblem(
        gripping,
        under.coefficient * under.contact.pressure[under.region.cut] * gripping,
        entry[:, *under.region.cut] * gripping,
        OWN * abs(direct) * under.way,
        under.way,
        axis,
        moving_shear_convolution(grid, shape, shear, axis, **options),
        moving_shear_preconditioner(shape, grid.cell_size, shear, axis, **options),
    )


def _askew(under: _Pressed, motion: SteadyMotion) -> Floats | None:
    """Slip over the way of the half-space by lateral creepage and spin [-]; None without both."""
    lateral, spin, (rows, columns) = motion.lateral_creepage, motion.spin, under.region.cut
    if not (lateral or spin):
        return None
    # It stays behind a surface that moves to the right, which is +x for a motion towards +y.
    right = np.array([0.0, -1.0]) if under.axis == 0 else np.array([1.0, 0.0])
    found = -(lateral or 0.0) * right[:, None, None]
    if not spin:
        return found
    # In the middle of the way from one cell ahead.
    x, y = under.grid.x[rows, None], under.grid.y[None, columns]
    x, y = (x + under.way / 2, y) if under.axis == 0 else (x, y + under.way / 2)
    return np.asarray(found + spin * np.stack(np.broadcast_arrays(y, -x)))


def _without_traction(posed: RollingProblem) -> RollingSolution:
    nothing = np.zeros((2, *posed.bound.shape))
    state = posed.in_contact.astype(np.int8)
    return RollingSolution(nothing, nothing, nothing, state, 0.0, 0, 0, converged=True)


def _evaluated(
    under: _Pressed,
    posed: RollingProblem,
    creepage: float,
    speed: float,
    found: RollingSolution,
) -> dict[str, float | Floats]:
    """Scalars and fields at one creepage, on the whole grid."""
    axis, area = under.axis, under.grid.cell_area
    traction, bound = found.traction, posed.bound
    # By the rule of trapezoids over the way of a cell, as that of a rolling body in time: cells
    # that the edge leaves slip until it passes.
    mean_bound = (bound + posed.ahead(bound)) / 2
    leaves = ~posed.in_contact & posed.ahead(posed.in_contact)
    slip = np.where(leaves, found.change + posed.drift(creepage), found.slip)
    lost = mean_bound * lengths(slip)
    mean_traction = (traction + posed.ahead(traction)) / 2
    stored = float((mean_traction * found.change).sum())
    forces = traction.sum(axis=(1, 2)) * area
    forces[np.abs(forces) < ROUNDING * float(bound.sum()) * area] = 0.0
    rate = speed / under.way * area
    sticks, held = np.count_nonzero(found.state == 1), np.count_nonzero(found.state)
    torque = -float(forces[axis]) * under.radius if math.isfinite(under.radius) else math.nan
    since = posed.summed(found.slip, posed.in_contact)
    fields = {
        "traction_x": traction[0],
        "traction_y": traction[1],
        "slip_x": since[0],
        "slip_y": since[1],
        "slip_state": found.state,
        "friction_work": _since_entry(lost, axis),
    }
    spread = {name: _spread(under, field, name) for name, field in fields.items()}
    return {
        "creepage": creepage,
        "tangential_force_x": float(forces[0]),
        "tangential_force_y": float(forces[1]),
        "drive_torque": torque,
        "stick_area": sticks * area,
        "slip_fraction": 1 - sticks / held,
        "friction_power": float(lost.sum()) * rate,
        "traction_dissipation": stored * rate,
        "slip_residual": found.residual,
        **spread,
    }


def _since_entry(field: Floats, axis: int) -> Floats:
    """Sums of a field over the cells from the leading end on."""
    return np.flip(np.cumsum(np.flip(field, axis), axis=axis), axis)


def _spread(under: _Pressed, field: Floats, name: str) -> Floats:
    """Field of the region on the whole grid; work of friction stays on the track behind it."""
    whole = np.zeros(under.grid.shape, field.dtype)
    rows, columns = under.region.cut
    whole[rows, columns] = field
    if name == "friction_work":
        if under.axis == 0:
            whole[: rows.start] = whole[rows.start]
        else:
            whole[:, : columns.start] = whole[:, columns.start, None]
    return whole


def _joined(found: list[dict[str, float | Floats]]) -> RollingTraction:
    """Scalars and fields of all creepages."""
    return RollingTraction(**{name: np.stack([each[name] for each in found]) for name in found[0]})
