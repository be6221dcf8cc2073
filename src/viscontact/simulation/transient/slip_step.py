"""Frictional problem of one step of a run: its constraints, its solution, and what is refused."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.errors import ConvergenceError, SlidingError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.tangential import TangentialPoint
from viscontact.mechanics.contact.friction.discs import lengths
from viscontact.mechanics.contact.friction.entry import OfLayers, entry_compliance
from viscontact.mechanics.contact.friction.equilibrium import IMBALANCE, solve_slip
from viscontact.mechanics.contact.friction.normal_contact import NormalContact
from viscontact.mechanics.contact.friction.problem import SlipProblem, SlipSolution
from viscontact.mechanics.contact.friction.region import Region, ShearDomain, ShearSymmetry
from viscontact.mechanics.contact.friction.rigid_shift import RigidShift, ShiftConstraints
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.shear_history import ShearStep
from viscontact.simulation.transient.slip_state import SlipState, StepSlip
from viscontact.units.formatting import format_quantity

#: Waves that tell how layers answer to a growth of the contact are as long as that.
WAVE = 2 * np.pi

TINY = float(np.finfo(np.float64).tiny)

#: Least displacement that errors are relative to, over friction times that under pressure [-].
LEAST_SHIFT = 0.01


@dataclass(frozen=True, eq=False)
class SlipGuess:
    """Tractions on the whole grid that a solve begins with."""

    traction: Floats  # [Pa], (2, nx, ny)
    motion: Floats | None = None  # shifts [m] and rotation [rad] in the step, if known


@dataclass(frozen=True, eq=False)
class SlipStep:
    """What is known of a step before its tractions are."""

    time: float  # at its end [s]
    before: SlipState
    contact: NormalContact  # at its end
    response: ShearStep
    # Displacement along the surface of a region in it, but by new tractions [m]; or new tractions
    # that caused the same [Pa].
    past: Floats | None
    earlier: Floats | None
    constraints: ShiftConstraints
    coefficient: float  # of friction [-]

    @property
    def is_at_rest(self) -> bool:
        """True if nothing moves the bodies along each other, now or from earlier."""
        loads = self.constraints.resultants, self.constraints.motions, self.past, self.earlier
        return not any(load is not None and load.any() for load in loads)

    @property
    def carried(self) -> float:
        """Force that friction carries [N]."""
        return self.coefficient * self.contact.force


def symmetry_of(run: RunSetup) -> ShearSymmetry | None:
    """Symmetry of tractions: of coupled ones the pressure's, of others with both mirror planes."""
    load, mirrored = run.problem.shear_load, run.mirrored
    if not run.problem.motion.stands:
        # The plane along the motion, if there is one.
        across = load is not None and any(np.logical_and(mirrored, load.acts[:2]))
        return ShearSymmetry.of_pressure(mirrored) if any(mirrored) and not across else None
    if run.problem.is_coupled:
        return ShearSymmetry.of_pressure(mirrored) if any(mirrored) else None
    acting = [mode for mode in range(3) if load is not None and load.acts[mode]]
    if not all(mirrored) or len(acting) > 1:
        return None
    return ShearSymmetry.of_load(acting[0] if acting else 0)


def shift_constraints(
    run: RunSetup, point: TangentialPoint, motion_before: Floats
) -> ShiftConstraints:
    """Constraints of the change of the body's motion in a step that ends at a load."""
    symmetry, motions = symmetry_of(run), list(point.motions)
    # A body without end does not turn, nor one that rolls on its axle.
    if any(run.grid.periodic) or not run.problem.motion.stands:
        motions[2] = 0.0
    free = np.array([motion is None for motion in motions])
    if symmetry is not None:  # what does not act is zero
        free &= symmetry.modes
    forces = np.array([0.0 if force is None else force for force in point.forces])
    there = np.array([motion or 0.0 for motion in motions])
    change = np.where(free, 0.0, there - motion_before)
    arm = max(run.grid.size) / 4
    return ShiftConstraints(free, np.where(free, forces, 0.0), change, arm)


def solved_on(
    run: RunSetup,
    domain: ShearDomain,
    region: Region,
    step: SlipStep,
    start: SlipGuess,
    tolerance: float,
) -> SlipSolution:
    """Tractions of a step on a region, from a guess on the whole grid."""
    problem = _slip_problem(run, domain, region, step)
    block = domain.block(region, step.response.kappa, step.response.layers)
    traction = start.traction[:, *region.cut]
    found = solve_slip(problem, block, traction, tolerance=tolerance, motion=start.motion)
    if not found.converged:
        raise _failure(step, found, block.shift)
    return found


def rescaled(
    slip: StepSlip,
    last: NormalContact,
    contact: NormalContact,
    coefficient: float,
    fresh: Bools,
) -> SlipGuess:
    """Tractions of the last pressure on the circles of the next one, in cells that slip."""
    # Those of cells that enter in the step are in proportion to the pressure as well.
    slips = ((slip.state == 2) | fresh) & last.in_contact
    ratio = np.divide(contact.pressure, last.pressure, out=np.ones(slips.shape), where=slips)
    traction = slip.traction * ratio
    # A cell that has come into contact since then is at the rim, where it slips.
    enters = contact.in_contact & ~last.in_contact
    if enters.any() and slip.way is not None:
        way = slip.way[:, enters]
        against = way / np.maximum(lengths(way), TINY)
        traction[:, enters] = -coefficient * contact.pressure[enters] * against
    return SlipGuess(traction, slip.motion)


def refuse_force_apart(step: SlipStep) -> None:
    """Refuse a force on bodies that do not touch."""
    if np.abs(step.constraints.resultants).any():
        raise SlidingError(
            f"tangential: the bodies are apart at t = {format_quantity(step.time, 's', 6)} and "
            "nothing carries the prescribed force; let it end before contact is lost, or "
            "prescribe a displacement"
        )


def _slip_problem(
    run: RunSetup, domain: ShearDomain, region: Region, step: SlipStep
) -> SlipProblem:
    contact, before = step.contact, step.before.contact
    # Cells that a body rolls on to enter at its leading edge, not all around.
    rolls = not run.problem.motion.stands and before.cells > 0
    entry = entry_compliance(
        *(contact, before, run.grid.cell_size, step.response.kappa),
        plane=rolls or not run.grid.has_datum,
        layers=_of_layers(run, domain, step.response),
        cut=region.cut,
    )
    gripping = contact.gripping[region.cut]
    return SlipProblem(
        gripping,
        step.coefficient * contact.pressure[region.cut] * gripping,
        step.past,
        step.response.compliance,
        entry * gripping,
        step.constraints,
        LEAST_SHIFT * step.coefficient * contact.displacement,
        step.earlier,
    )


def _of_layers(run: RunSetup, domain: ShearDomain, response: ShearStep) -> OfLayers | None:
    """Compliance of layers along the surface over that into it, and κ, over lengths of growth."""
    if not response.layers:
        return None
    kappa, normal = response.kappa, run.problem.surface.response_at(0.0)
    in_plane = domain.in_plane(kappa, response.layers)

    def factors(growth: Floats) -> tuple[Floats, Floats]:
        q = WAVE / np.maximum(growth, WAVE / domain.shortest_wave)
        along, across = in_plane(q)
        into = normal.ratio(q) / normal.short_waves
        return along / into, across / along - 1

    return factors


def _failure(step: SlipStep, found: SlipSolution, shift: RigidShift) -> ConvergenceError:
    """Error of a step whose tractions were not found."""
    time, resultants = format_quantity(step.time, "s", 6), shift.resultants(found.traction)
    if step.constraints.imbalance(resultants, step.carried) > IMBALANCE:
        missing = step.constraints.lacking(resultants)
        force, torque = float(np.hypot(*missing[:2])), float(abs(missing[2]))
        left = [format_quantity(force, "N", 4)] * (force > 0)
        left += [format_quantity(torque, "N m", 4)] * (torque > 0)
        return SlidingError(
            f"tangential: the body slides away at t = {time}: friction carries up to "
            f"{format_quantity(step.carried, 'N', 4)}, which is too little by "
            f"{' and '.join(left)}; prescribe less, or a displacement in place of the force"
        )
    return ConvergenceError(
        f"the solver of friction stopped at t = {time} with residual {found.residual:.2g} after "
        f"{found.iterations} iterations, short of the tolerance; likely causes: a force close to "
        "what friction carries, or a tolerance near rounding"
    )
