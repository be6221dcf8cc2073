"""Friction over the steps of a run: tractions, slip, heat, and the memory of earlier tractions.

In each step, after the normal contact, the tractions of the new instant solve a frictional problem
for the pressure found (`slip_step`, `mechanics.contact.friction`), with the displacement by earlier
tractions (`shear_history`). A contact without friction is `Frictionless`.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.transforms import transforms_by
from viscontact.bodies.friction import Friction
from viscontact.bodies.loads.tangential import TangentialLoad
from viscontact.mechanics.contact.friction.normal_contact import NormalContact
from viscontact.mechanics.contact.friction.region import Region, ShearDomain
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation.checks.friction import ring_warnings
from viscontact.simulation.transient.frictionless import JointSlip, SlipTrial, Uncoupled
from viscontact.simulation.transient.grid_enlargement import GridEnlargement
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.shear_history import ShearHistory, ShearStep
from viscontact.simulation.transient.slip_results import (
    grip_of,
    rolling_scalars,
    slip_fields,
    slip_scalars,
)
from viscontact.simulation.transient.slip_state import SlipState, StepSlip, step_slip
from viscontact.simulation.transient.slip_step import (
    SlipGuess,
    SlipStep,
    refuse_force_apart,
    shift_constraints,
    solved_on,
    symmetry_of,
)
from viscontact.simulation.transient.step_solution import StepSolution


class FrictionalContact(Uncoupled):
    """Solves the tractions of the steps of a run and keeps their memory."""

    def __init__(self, run: RunSetup, friction: Friction, load: TangentialLoad) -> None:
        self._run, self._load = run, load
        self._coefficient = friction.coefficient
        self._domain = _domain_of(run)
        self._history = ShearHistory(run)
        self._state = SlipState.at_first(run.open_gap)
        #: Change of the traction [Pa] in the last step, and its duration [s].
        self._trend = np.zeros(self._state.traction.shape), 0.0
        self._time = 0.0  # at the end of the last step [s]
        self._lost = 0.0  # in the bodies under the tractions [J]
        self._widest = 0.0  # ring that has slipped, in cells

    @property
    def warnings_at_end(self) -> dict[str, str]:
        """Warnings of the whole run, by kind."""
        return ring_warnings(self._widest)

    def trial(
        self, step: TimeStep, solution: StepSolution, joint: JointSlip | None = None
    ) -> SlipTrial:
        """Solve the tractions at the end of a step, after that of the last one accepted."""
        before, grid, contact = self._state, self._run.grid, solution.contact
        self._domain.move_axis(self._run.position_at(step.time))
        region = self._region_of(contact)
        known = self._known(step, contact, region, self._history.respond(step))
        if contact.in_contact.any():
            tolerance = self._run.problem.tolerance
            found = (
                self._solved(known, region, SlipGuess(self._guess(step, contact)), tolerance)
                if joint is None
                else joint.slip
            )
            cut = self._domain.with_images(region)
            after = before.after(
                *(contact, found, self._coefficient, grid.cell_area), cut=cut, moves=self._moves
            )
        else:
            refuse_force_apart(known)
            found = StepSlip.apart(grid.shape, known.constraints)
            # Bodies that are apart come to touch first: their lowest points are as far above the
            # nearest cells as at first.
            lifted = solution.gap.min() - self._run.open_gap.min()
            after = before.apart(solution.gap - lifted, found)
        scalars = slip_scalars(self._run, step.duration, before, after, found)
        if self._moves:
            scalars |= rolling_scalars(self._run, (self._time, step.time), before, after)
        return SlipTrial(
            scalars | slip_fields(after, found),
            grip_of(grid, known, after, scalars["slip_fraction"]),
            *(known.response, after, step.duration),
            loss=self._loss(region, step, after.traction),
        )

    def _loss(self, region: Region, step: TimeStep, traction: Floats) -> tuple[float, float]:
        """Energy lost since the start under tractions [J], and power at the end of a step [W]."""
        run = self._run
        # A body that stands has no such result, and an elastic one loses nothing.
        if not self._moves or run.problem.surface.creep.is_elastic:
            return 0.0, 0.0
        # Coupled, pressure and tractions lose something together, too, which is not computed.
        if not run.has_datum or run.problem.is_coupled:
            return math.nan, math.nan
        track = self._domain.along(region, run.problem.motion.moves)
        heat, power = self._history.loss(traction, self._domain, track, step.time)
        return self._lost + heat, power

    def accept(self, trial: SlipTrial) -> None:
        """Close a step with its tractions."""
        assert trial.after is not None  # it is a trial of this contact
        assert trial.response is not None
        assert trial.grip is not None
        self._history.accept(trial.response, trial.after.traction)
        self._trend = trial.after.traction - self._state.traction, trial.duration
        self._time, self._lost = trial.grip.time, trial.loss[0]
        self._state, self._widest = trial.after, max(self._widest, trial.grip.ring)

    def _region_of(self, contact: NormalContact) -> Region:
        """Region of cells that carry tractions, or have carried some."""
        if self._moves and contact.in_contact.any():  # its track is another region
            return self._domain.region_of(self._state.contact.in_contact | contact.in_contact)
        return self._domain.region_of(self._state.touched | contact.in_contact)

    def _past(self, region: Region, response: ShearStep) -> Floats:
        """Displacement of a region in a step by earlier tractions [m]."""
        track = self._track_of(region)
        return response.past(self._domain, track)[:, *region.within(track)]

    def _earlier(self, region: Region, response: ShearStep) -> Floats | None:
        """Earlier loads of a region as new ones, if others displace it by nothing [Pa]."""
        return response.earlier(region) if self._track_of(region) == region else None

    def _track_of(self, region: Region) -> Region:
        """Region of earlier loads that displace one."""
        problem = self._run.problem
        if not self._moves or problem.surface.creep.is_elastic:
            return region
        # A body that creeps remembers the loads all along the path.
        return self._domain.along(region, problem.motion.moves)

    @property
    def _moves(self) -> bool:
        return not self._run.problem.motion.stands

    def _known(
        self, step: TimeStep, contact: NormalContact, region: Region, response: ShearStep
    ) -> SlipStep:
        """What is known of a step with its normal contact."""
        point = self._load.at(step.time, side=step.side)
        earlier = self._earlier(region, response)
        return SlipStep(
            step.time,
            self._state,
            contact,
            response,
            self._past(region, response) if earlier is None else None,
            earlier,
            shift_constraints(self._run, point, self._state.motion),
            self._coefficient,
        )

    def _solved(
        self, known: SlipStep, region: Region, start: SlipGuess, tolerance: float
    ) -> StepSlip:
        """Tractions of a step in contact."""
        if known.is_at_rest and not start.traction.any():
            return StepSlip.at_rest(known.contact)
        found = solved_on(self._run, self._domain, region, known, start, tolerance)
        slip = step_slip(found, known.constraints, self._domain, region, known.carried)
        return replace(slip, way=self._domain.spread(region, found.way)) if self._moves else slip

    def _guess(self, step: TimeStep, contact: NormalContact | None = None) -> Floats:
        """Traction before the step, with its trend where the load goes on smoothly [Pa]."""
        trend, duration = self._trend
        guess = self._state.traction
        if self._moves:
            return self._run.moved(guess, self._time, step.time)
        if not step.smooth or duration == 0:
            return guess
        if contact is not None and self._is_sheared(step, contact):
            return guess
        return guess + trend * (step.duration / duration)

    def _is_sheared(self, step: TimeStep, contact: NormalContact) -> bool:
        """True if a force along the surface changes more than the pressure does, by friction."""
        # The tractions are then predicted from the force, and better so than from their trend.
        forces = self._load.at(step.time, side=step.side).forces
        before = self._state.forces
        changes = [forces[axis] - before[axis] for axis in (0, 1) if forces[axis] is not None]
        pressed = np.abs(contact.pressure - self._state.contact.pressure).sum()
        carried = self._coefficient * float(pressed) * self._run.grid.cell_area
        return math.hypot(*changes) > carried

    def map_fields(self, run: RunSetup, enlargement: GridEnlargement) -> None:
        """Continue the same run on a larger grid."""
        self._run, self._domain = run, _domain_of(run)
        self._state = self._state.on(enlargement)
        small, large = enlargement.small.grid, enlargement.large.grid

        def grown(fields: Floats) -> Floats:
            found = np.zeros((*fields.shape[:-2], *large.shape))
            for index in np.ndindex(fields.shape[:-2]):
                found[index] = small.embed(fields[index], large)
            return found

        self._trend = grown(self._trend[0]), self._trend[1]
        self._history.map_fields(grown)

    def restart_data(self) -> RestartData:
        """Return the state after a step as plain data."""
        return {
            "history": self._history.restart_data(),
            "state": vars(self._state) | {"contact": vars(self._state.contact)},
            "trend": list(self._trend),
            "time": self._time,
            "lost": self._lost,
            "widest": self._widest,
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue the same run from restart data."""
        self._history.restore(restart_data["history"])
        state = restart_data["state"]
        self._state = SlipState(**state | {"contact": NormalContact(**state["contact"])})
        trend, duration = restart_data["trend"]
        self._trend = trend, duration
        self._time, self._lost = restart_data["time"], restart_data["lost"]
        self._widest = restart_data["widest"]


def _domain_of(run: RunSetup) -> ShearDomain:
    # A moving contact leaves a track, which is another region.
    shapes = 1 if run.problem.motion.stands else 2
    transforms = transforms_by(run.transforms, run.threads)
    layers = run.problem.shear.layers
    return ShearDomain(run.grid, transforms, symmetry_of(run), layers, shapes=shapes)
