"""Problem of a contact in steady motion: bodies, load, speeds and direction, with their checks."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.indenters.periodic_body import PeriodicBody
from viscontact.bodies.loads import LoadPoint
from viscontact.bodies.loads.steady_motion import SteadyMotion, constant_load
from viscontact.bodies.loads.temperature import require_constant
from viscontact.bodies.materials.layers import Layered
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.problem.surface import creeps
from viscontact.simulation.checks.friction import (
    check_grid_of_friction,
    refuse_coupled,
    refuse_sliding_layers,
)


@dataclass(frozen=True, eq=False)
class SteadyProblem:
    """Contact problem of a body in steady motion, checked."""

    contact: Problem  # under the constant load `point`
    motion: SteadyMotion
    point: LoadPoint

    @property
    def speeds(self) -> Floats:
        """The speeds towards + [m/s]."""
        return np.array(self.motion.speeds)

    @property
    def axis(self) -> int:
        """Axis of the motion; 0: x, 1: y."""
        return "xy".index(self.motion.along)

    def body_on(self, grid: Grid) -> Indenter:
        """The body, on a grid that repeats itself with its next periods; cut off at ends."""
        body = self.contact.indenter
        return PeriodicBody(body, grid) if any(grid.periodic) else self.contact.cut_indenter

    @property
    def kept(self) -> Floats:
        """Speeds whose fields are kept [m/s]."""
        return self.contact.kept.among(self.speeds, "speed")

    @property
    def tilts_freely(self) -> bool:
        """True if the slope along the motion is free of moment."""
        given = self.contact.grid
        if isinstance(given, Grid) and given.periodic[self.axis]:
            return False
        return (self.point.tilt_x, self.point.tilt_y)[self.axis] is None

    @property
    def has_several_pressures(self) -> bool:
        """True for coupled bodies at more than one creepage, each of which has its pressure."""
        return len(self.motion.creepages) > 1 and self.contact.is_coupled


def refuse_several_pressures(problem: SteadyProblem) -> SteadyProblem:
    """The problem; refuse several pressures at each speed, where a result holds one."""
    if problem.has_several_pressures:
        raise ValueError(
            "creepage: pressure and tractions of these bodies are coupled, so that each creepage "
            "has a pressure of its own, and a run directory holds one at each speed; got "
            f"{len(problem.motion.creepages)} creepages; give one, and the others in runs of their "
            "own (viscontact run CASE --vary motion.creepage=1%,2%), or compute them in Python "
            "(viscontact.steady), or give coupling=False, which neglects it"
        )
    return problem


def steady_problem(contact: Problem, motion: SteadyMotion) -> SteadyProblem:
    """Check a problem of steady motion and complete it."""
    if contact.adhesion is not None:
        raise ValueError(
            "adhesion: it is not supported in steady motion; leave it out, or press and withdraw "
            "the body without a motion (simulate)"
        )
    problem = SteadyProblem(contact, motion, constant_load(contact.contact_load))
    if contact.temperature is not None:
        require_constant(contact.temperature)
    if any(material.ageing for material in contact.materials):
        raise ValueError(
            "ageing: a material that ages has no steady state, as its creep slows down; leave "
            "ageing out, or give a motion over time (travel, reciprocating)"
        )
    axis, rolling = problem.axis, motion.rolling
    periodic = contact.grid.periodic if isinstance(contact.grid, Grid) else (False, False)
    if periodic[axis] and not periodic[1 - axis]:
        raise ValueError(
            f"grid.periodic: the body moves along {motion.along}, and a grid that is periodic "
            "along it only would hold other bodies ahead of it and behind it; use a grid that is "
            "periodic across the motion, along both axes under a body that repeats, or not at all"
        )
    if periodic[axis] and rolling:
        raise ValueError(
            "rolling: a body on a grid that is periodic along its motion has no end, and cannot "
            "roll; give rolling=False"
        )
    _check_bodies(contact, axis, rolling)
    _check_friction(contact, motion, periodic[axis])
    contact.kept.among(problem.speeds, "speed")
    return problem


def _check_friction(contact: Problem, motion: SteadyMotion, periodic: bool) -> None:
    """Refuse tractions that cannot be computed, and friction or creepages without the other."""
    if contact.friction is None and not motion.creepages:
        return
    if contact.friction is None:
        raise ValueError(
            "friction: a creepage needs friction, got none; give a coefficient, as in friction=0.3 "
            "or, in a case, 'friction: {coefficient: 0.3}', or leave the creepage out"
        )
    if not motion.creepages:
        raise ValueError(
            "creepage: under friction a body in steady motion needs its surface speed over its "
            "travel, less 1, got none; give one or a list, as in creepage=[0.001, 0.01] or, in a "
            "case, 'creepage: [0.1 %, 1 %]', or leave friction out"
        )
    refuse_sliding_layers(contact.bodies)
    if isinstance(contact.grid, Grid):
        check_grid_of_friction(contact, contact.grid)
    if periodic:
        raise ValueError(
            "creepage: a body on a grid that is periodic along its motion has no end, and cannot "
            "roll; leave friction and creepage out"
        )
    if contact.is_coupled:
        _check_coupled(contact, motion)


def _check_coupled(contact: Problem, motion: SteadyMotion) -> None:
    """Refuse coupled bodies that have layers, or are askew."""
    if any(isinstance(body, Layered) for body in contact.bodies):
        refuse_coupled(contact, "in steady motion over layers")
    if motion.lateral_creepage:
        refuse_coupled(contact, "under a lateral creepage in steady motion (only over time)")
    if motion.spin:
        refuse_coupled(contact, "under spin")


def _check_bodies(contact: Problem, axis: int, rolling: bool | None) -> None:
    """Refuse a viscoelastic indenter that is not known to roll or slide, or that cannot roll."""
    mate = contact.indenter_material
    if mate is None or not creeps(mate):
        return
    if rolling is None:
        raise ValueError(
            "rolling: the indenter's material is viscoelastic, so that rolling and sliding "
            "differ; give rolling=True if it rolls (its material flows through the contact), "
            "rolling=False if it slides"
        )
    if rolling and not contact.indenter.curvatures[axis] > 0:
        raise ValueError(
            f"rolling: the indenter has no radius of curvature along {'xy'[axis]}, so it cannot "
            "roll; give rolling=False, or a round body"
        )
