"""Checks of friction and of the tangential load."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.tangential import TangentialLoad
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.problem.surface import constant_poisson_ratio
from viscontact.units.formatting import format_quantity

#: Part of what friction carries from which on a run warns, fewest cells across the ring that
#: slips, growth of the contact in one step, and Poisson's ratio from which on pressure hardly moves
#: the surface along itself.
NEARLY_SLIDES, LEAST_RING, LARGE_GROWTH, NEARLY_INCOMPRESSIBLE = 0.99, 2.0, 1.5, 0.45

#: Part of the most cells in contact that a contact has to grow to at once to be warned of.
GROWN = 0.25

#: Part of what friction carries from which on a body counts as sliding away.
SLIDES = 1 - 1e-9

#: Times within an interval at which curved loads are compared, and halvings in the search for the
#: time of sliding.
SAMPLES, HALVINGS = 16, 60


def check_friction(problem: Problem) -> None:
    """Refuse friction that cannot be computed, before the times of the run are needed."""
    if problem.friction is None and problem.shear_load is None:
        return
    if problem.friction is None and problem.tangential is None:
        raise ValueError(
            "friction: a creepage needs friction, got none; give a coefficient, as in friction=0.3 "
            "or, in a case, 'friction: {coefficient: 0.3}', or leave the creepage out"
        )
    if problem.friction is None:
        raise ValueError(
            "friction: a tangential load needs friction, got none; give a coefficient, as in "
            "friction=0.3 or, in a case, 'friction: {coefficient: 0.3}'"
        )
    if not problem.motion.stands:
        _check_rolling(problem)
    if problem.shear_load is None:
        raise ValueError(
            "tangential: friction needs a tangential load, got none; give one, as in "
            "tangential=vc.tangential_step(force_x=1.0) or, in a case, 'tangential: {kind: step, "
            "force_x: 1 N}'"
        )
    refuse_sliding_layers(problem.bodies)
    if problem.tangential is not None:
        check_grip(problem)


def _check_rolling(problem: Problem) -> None:
    """Refuse a moving body whose tractions cannot be computed."""
    motion, load = problem.motion, problem.tangential
    if load is None and motion.creepage is None:
        raise ValueError(
            "motion.creepage: under friction a body that moves needs a creepage, its surface speed "
            "over its travel, less 1, got none; give one, as in creepage=0.003 or, in a case, "
            "'creepage: 0.3 %', give rolling=True and a tangential force, or leave friction out"
        )
    if load is not None and motion.creepage is not None:
        raise ValueError(
            "tangential: the creepage of the motion prescribes the shift of the body, so that "
            "there is no other tangential load; leave one of them out"
        )
    if load is not None and not motion.rolling:
        raise ValueError(
            "motion.rolling: a body that slides under friction slips in all of its contact, with "
            "tractions of friction times the pressure, and no tangential load is left to choose; "
            "give rolling=True if it rolls, or leave friction out"
        )
    if load is not None and load.acts[2]:
        raise ValueError(
            "tangential.torque: torque and rotation of a body that moves are not supported; leave "
            "them out"
        )
    if any(isinstance(body, Layered) for body in problem.bodies):
        refuse_coupled(problem, "in the motion over layers")


def refuse_coupled(problem: Problem, where: str) -> None:
    """Refuse bodies whose pressure and tractions are coupled, where this is not supported."""
    if problem.is_coupled:
        raise ValueError(
            "friction.coupling: pressure and tractions of these bodies are coupled, which is not "
            f"supported {where}; give coupling=False, which neglects it, or bodies for which it "
            "cancels: two of the same material, or of Poisson's ratio 1/2"
        )


def check_grid_of_friction(problem: Problem, grid: Grid) -> None:
    """Refuse a tangential load that a periodic grid has no meaning for."""
    load = problem.tangential
    rows = any(grid.periodic) and not all(grid.periodic) and min(grid.shape) > 1
    if rows and problem.friction is not None and problem.shear.layers:
        raise ValueError(
            "grid.periodic: layers under friction that repeat along one axis only are not "
            "supported but as a line contact; give one cell along the period, a grid that is "
            "periodic along both axes, or one without a period"
        )
    if load is None or not any(grid.periodic):
        return
    points = [load.at(time, side=side) for time in load.kinks for side in ("left", "right")]
    if any(point.forces[2] or point.motions[2] for point in points):
        turning = "rotation" if any(point.motions[2] for point in points) else "torque"
        raise ValueError(
            f"tangential.{turning}: a body without end does not turn; leave torque and rotation "
            "out, or give a grid without a period"
        )
    if not problem.has_datum(grid) and any(
        motion is not None for point in points for motion in point.motions[:2]
    ):
        raise ValueError(
            "tangential.displacement_x: a line contact has no point at rest that a displacement "
            "counts from, but on layers on a rigid base; prescribe forces"
        )


def refuse_sliding_layers(bodies: Sequence[Material | Layered]) -> None:
    """Refuse layers that slide, which no force along the surface holds."""
    for name, body in zip(("material", "indenter_material"), bodies, strict=False):
        if isinstance(body, Layered) and not np.all(body.bonded):
            raise ValueError(
                f"{name}.bonded: a layer that slides on what is beneath carries no force along "
                "the surface, so that a body on it has nothing to hold on to; bond the layers, or "
                "leave friction out"
            )


def coupling_warnings(problem: Problem) -> dict[str, str]:
    """Warn of bodies whose pressure and tractions are coupled, where that is neglected."""
    if problem.friction is None or problem.friction.coupling or not problem.may_be_coupled:
        return {}
    if any(isinstance(body, Layered) for body in problem.bodies):
        return {
            "coupling": "pressure moves the surface of layers along itself at any Poisson's ratio, "
            "and this is neglected (coupling=False); where nearly incompressible layers are thin "
            "against the contact, tractions and shifts are wrong by half"
        }
    ratios = [constant_poisson_ratio(material) for material in problem.materials]
    if all(ratio is not None and ratio >= NEARLY_INCOMPRESSIBLE for ratio in ratios):
        return {}
    return {
        "coupling": "pressure moves the surfaces along themselves, as Poisson's ratio is below "
        "0.5, and this is neglected (coupling=False); tractions and shifts err by some percent"
    }


def rise_warnings(problem: Problem, grid: Grid) -> dict[str, str]:
    """Warn of a line contact under a creepage, whose traction rises by the size of the grid."""
    if problem.motion.creepage is None or problem.has_datum(grid):
        return {}
    return {
        "rise": (
            "motion.creepage: a line contact has no point at rest that shifts count from, so that "
            "the way on which its traction rises from rest depends on the size of the grid; the "
            "steady traction, after some contact widths, does not"
        )
    }


@dataclass(frozen=True)
class Grip:
    """What a frictional contact carries at the end of a step, in numbers of cells."""

    time: float  # [s]
    force: float  # prescribed tangential force [N]
    carried: float  # μ W [N]
    cells: int  # in contact
    slipping: int  # of these
    before: int  # in contact before the step
    on_line: bool = False  # the cells are those of a line contact
    approached: bool = False  # cells have entered over a gap

    @property
    def grows_at_once(self) -> bool:
        """True if the contact grows much in the step, over a gap, and part of it slips."""
        grows = self.cells > LARGE_GROWTH * self.before
        return self.approached and grows and self.slipping > 0

    @property
    def ring(self) -> float:
        """Cells across the ring that slips around a round contact, or at each end of a line."""
        if self.on_line:
            return self.slipping / 2
        radius = math.sqrt(self.cells / math.pi)
        return radius - math.sqrt((self.cells - self.slipping) / math.pi)


def grip_warnings(grip: Grip) -> dict[str, str]:
    """Warn of a force close to sliding, and of a contact that grows at once."""
    at, found = f"at t = {format_quantity(grip.time, 's', 4)}", {}
    if grip.force > NEARLY_SLIDES * grip.carried:
        found["nearly slides"] = (
            f"{at} the tangential force is within 1 % of what friction carries; the shift of the "
            "body depends on details there"
        )
    if grip.force > 0 and grip.cells > LARGE_GROWTH * grip.before > 0:
        found["growth under shear"] = (
            f"in the step to t = {format_quantity(grip.time, 's', 4)} the contact grows by "
            f"{grip.cells / grip.before - 1:.0%} under a tangential force; use more steps there"
        )
    return found


@dataclass(frozen=True)
class Growth:
    """Step in which a contact has grown at once to the most cells, and most cells so far."""

    grown: Grip | None = None
    most: int = 0

    def after(self, grip: Grip) -> Growth:
        """With a further step."""
        more = self.grown is None or grip.cells > self.grown.cells
        grown = grip if grip.grows_at_once and more else self.grown
        return Growth(grown, max(self.most, grip.cells))

    @property
    def warnings(self) -> dict[str, str]:
        """Warning of coupled bodies whose contact grew at once to a good part of its most cells."""
        grown = self.grown
        if grown is None or grown.cells < GROWN * self.most:
            return {}
        return {
            "growth of coupled contacts": (
                f"in the step to t = {format_quantity(grown.time, 's', 4)} the contact of "
                f"dissimilar bodies grows from {grown.before} to {grown.cells} cells, and part of "
                "it slips: a cell slips first and sticks later as the contact grows past it, so "
                "stick area, slip and heat depend on the steps; let the load grow over 16 times "
                "or more"
            )
        }


def ring_warnings(widest: float) -> dict[str, str]:
    """Warn of a ring that slips and is narrow, in cells, where it is widest in a run."""
    if not 0 < widest < LEAST_RING:
        return {}
    return {
        "slip ring": f"the part of the contact that slips is at most {widest:.1f} cells wide; slip "
        "and heat need finer cells"
    }


def check_grip(problem: Problem) -> None:
    """Refuse forces beyond what friction carries, with the time at which the body slides away."""
    load, tangential, friction = problem.contact_load, problem.tangential, problem.friction
    assert tangential is not None  # checked by `check_friction`
    assert friction is not None
    if load.control != "force":
        return
    end = problem.end
    times = np.unique([0.0, *problem.history.stops.tolist(), end])
    for begin, stop in itertools.pairwise(times[times <= end].tolist()):
        for time in np.linspace(begin, stop, SAMPLES + 1).tolist():
            for side in ("left", "right") if time == stop else ("right",):
                if _excess(load, tangential, friction.coefficient, time, side) > 0:
                    _refuse(load, tangential, friction.coefficient, begin, time)
    if _excess(load, tangential, friction.coefficient, end, "right") > 0:
        _refuse(load, tangential, friction.coefficient, end, end)


def _excess(
    load: LoadHistory, tangential: TangentialLoad, coefficient: float, time: float, side: str
) -> float:
    """Tangential force beyond what friction carries at an instant [N]."""
    along_x, along_y, _ = tangential.at(time, side=side).forces
    force = math.hypot(along_x or 0.0, along_y or 0.0)
    carried = coefficient * (load.at(time, side=side).force or 0.0)
    return force - SLIDES * carried if force else 0.0


def _refuse(
    load: LoadHistory, tangential: TangentialLoad, coefficient: float, begin: float, time: float
) -> None:
    """Raise ValueError with the time of sliding, after `begin` and not after `time` [s]."""
    low, high = begin, time
    for _ in range(HALVINGS if high > low else 0):
        middle = (low + high) / 2
        if _excess(load, tangential, coefficient, middle, "right") > 0:
            high = middle
        else:
            low = middle
    along_x, along_y, _ = tangential.at(time).forces
    force = math.hypot(along_x or 0.0, along_y or 0.0)
    carried = coefficient * (load.at(time).force or 0.0)
    raise ValueError(
        f"tangential: the body slides away at t = {format_quantity(high, 's', 4)}: friction "
        f"carries {format_quantity(carried, 'N', 4)} of the {format_quantity(force, 'N', 4)} that "
        f"are reached at t = {format_quantity(time, 's', 4)}; give a smaller force, a larger "
        "normal force or coefficient, or a displacement in place of the force"
    )
