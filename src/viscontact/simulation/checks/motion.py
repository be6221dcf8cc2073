"""Checks and warnings of a moving contact."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.motion import Motion
from viscontact.bodies.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.bodies.materials.layers import materials_of
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.problem.surface import creeps
from viscontact.units.formatting import format_quantity

#: Way of a step over half the contact's extent along the motion up to which the error of the
#: resistance is about 1 %: it is 0.6 of its square where the material is far from relaxed.
LONGEST_WAY = 1 / 8

#: Part of the loss that retardation times shorter than a step may cause.
UNRESOLVED_LOSS = 0.1

#: Longest contact of a roller over its circumference, and part of the deflection in it that may be
#: left after a turn.
CONTACT_OF_TURN, LEFT_AFTER_TURN = 0.1, 0.01


def check_motion(problem: Problem) -> None:
    """Refuse what a moving contact cannot be computed with, before its times are needed."""
    motion, mate = problem.motion, problem.indenter_material
    if not (motion.stands or any(motion.moves)):
        raise ValueError("motion: a steady motion is over speed, not over time; use steady")
    if motion.stands or mate is None or not creeps(mate):
        return
    if motion.rolling is None:
        raise ValueError(
            "motion.rolling: the indenter's material creeps, so that it matters whether it flows "
            "through the contact; give rolling=True for a body that rolls, False for one that "
            "slides"
        )
    if not motion.rolling:
        raise ValueError(
            "motion.rolling: a body that slides keeps its own creep in its own frame, which is "
            "not available for a material that creeps; make its material elastic, or give "
            "rolling=True if it rolls"
        )
    if not _circumference(problem, motion) < math.inf:
        raise ValueError(
            "motion.rolling: the indenter has no radius of curvature along the motion, so it "
            "cannot roll; use a round body, or make its material elastic and give rolling=False"
        )


def _way(motion: Motion) -> float:
    """Distance between the farthest places of a straight path [m]."""
    along_x, along_y = (high - low for low, high in motion.reach)
    return math.hypot(along_x, along_y)


def rolling_radius(problem: Problem, motion: Motion) -> float:
    """Radius of the indenter in the plane of its motion; inf without curvature [m]."""
    ways = [high - low for low, high in motion.reach]
    curvature = sum(
        curved * (way / _way(motion)) ** 2
        for curved, way in zip(problem.indenter.curvatures, ways, strict=True)
    )
    return 1 / curvature if curvature > 0 else math.inf


def _circumference(problem: Problem, motion: Motion) -> float:
    """Circumference of the indenter in the plane of its motion; inf without curvature [m]."""
    return 2 * math.pi * rolling_radius(problem, motion)


def turn_warnings(problem: Problem) -> dict[str, str]:
    """Warn of a roller whose material returns to the contact before it has recovered."""
    motion, mate = problem.motion, problem.indenter_material
    if motion.stands or mate is None or not creeps(mate):
        return {}
    turn = _circumference(problem, motion)
    duration = turn / motion.top_speed
    reduced = problem.clocks[1].passed(max(problem.end, duration), duration)
    parts = materials_of(problem.bodies[1])
    left = max(left_after(part.contact_compliance(), reduced) for part in parts)
    if _way(motion) <= turn or left <= LEFT_AFTER_TURN:
        return {}
    return {
        "turn": (
            f"motion: the body rolls over {format_quantity(_way(motion), 'm', 3)}, more than its "
            f"circumference of {format_quantity(turn, 'm', 3)}, and its material returns to the "
            f"contact with up to {left:.0%} of its deflection left; earlier turns are not "
            "included, and resistance, approach and pressure are those of a body whose material "
            "is new in each turn: use a shorter path, or the steady state, which includes them"
        )
    }


def left_after(compliance: ContactCompliance, turn: float) -> float:
    """Part of the deflection in the contact that is left after a turn [s]: at most, about."""
    passed = CONTACT_OF_TURN * turn
    loaded, before, after = compliance(np.array([passed, turn, turn + passed])).tolist()
    return float((after - before) / loaded) if loaded > 0 else 0.0


def check_path(problem: Problem, grid: Grid) -> None:
    """Refuse a path along which the body's axis leaves the grid."""
    if problem.motion.stands:
        return
    for name, centres, repeats, (low, high) in zip(
        "xy", (grid.x, grid.y), grid.periodic, problem.motion.reach, strict=True
    ):
        if not repeats and (low < centres[0] or high > centres[-1]):
            ends = [format_quantity(end, "m", 6) for end in (low, high, centres[0], centres[-1])]
            raise ValueError(
                f"grid: the body moves from {name} = {ends[0]} to {ends[1]}, beyond the grid, "
                f"which reaches from {ends[2]} to {ends[3]}; enlarge grid.size, or set grid.centre"
            )


def axle_warnings(problem: Problem) -> dict[str, str]:
    """Warn of a tilt along the motion that is free of moment."""
    # A body that repeats itself along an axis is level there.
    level = problem.grid.periodic if isinstance(problem.grid, Grid) else (False, False)
    free = [
        f"tilt_{name}"
        for name, moves, repeats in zip("xy", problem.motion.moves, level, strict=True)
        if moves and not repeats and getattr(problem.load, f"tilt_{name}") is None
    ]
    return free_tilt_warnings(free)


def free_tilt_warnings(free: Sequence[str]) -> dict[str, str]:
    """Warn of tilts along the motion, by name, that are free of moment."""
    if not free:
        return {}
    given = " and ".join(f"{name} = 0" for name in free)
    return {
        "axle": (
            f"load: {' and '.join(free)} is free of moment along the motion, so that the body "
            f"tilts until its resultant acts on its axis; for a body on an axle give {given}"
        )
    }


def row_warnings(problem: Problem) -> dict[str, str]:
    """Warn of a grid that is periodic along the motion only: bodies follow each other."""
    if not isinstance(problem.grid, Grid):
        return {}
    for axis, (repeats, moves) in enumerate(
        zip(problem.grid.periodic, problem.motion.moves, strict=True)
    ):
        if repeats and moves and not problem.grid.has_datum:
            return {
                "row": (
                    f"grid.periodic: the body moves along {'xy'[axis]}, along which the grid is "
                    "periodic: other bodies are ahead of it and behind it at distances of "
                    f"{format_quantity(problem.grid.size[axis], 'm', 3)}, and it meets their "
                    "tracks; for a single body use a grid that is not periodic along the motion"
                )
            }
    return {}


def heat_warnings(
    problem: Problem, grid: Grid, compliances: Sequence[ContactCompliance]
) -> dict[str, str]:
    """Warn of a law, among those in the form that the run uses, whose heat is not known."""
    if problem.motion.stands or not problem.has_datum(grid):
        return {}
    if all(isinstance(each, SeriesCompliance) for each in compliances):
        return {}
    return {
        "heat": (
            "the law is no series of exponentials and is summed over all earlier steps: "
            "dissipation and heat are not known (NaN); a Prony series fitted to it has them"
        )
    }


def edge_warnings(*, along: bool, across: bool) -> dict[str, str]:
    """Warn of a contact that has reached an end of the body, along or across the motion."""
    found = {}
    if across:
        found["edge across"] = (
            "motion: the contact reaches an end of the body across the motion; the force on this "
            "edge depends on its rounding and is not computed: the resistance across the motion is "
            "NaN"
        )
    if not along:
        return found
    return found | {
        "edge": (
            "motion: the contact reaches an end of the body along the motion, where the pressure "
            "is singular; the force on this edge is not computed: resistance and friction "
            "coefficient are NaN there, and motion work from then on; dissipation and heat are "
            "known"
        )
    }


def way_warnings(way: float, half_extent: float) -> dict[str, str]:
    """Warn of a step whose way [m] is long against half the contact's extent along it [m]."""
    if way <= (1 + 1e-6) * LONGEST_WAY * half_extent:
        return {}
    return {
        "way": (
            f"times: the body moves by {format_quantity(way, 'm', 3)} in a step, and the contact's "
            f"half length along the motion is {format_quantity(half_extent, 'm', 3)}; for an error "
            f"of the resistance of 1 % move at most {format_quantity(half_extent / 8, 'm', 3)}: "
            "use more steps"
        )
    }


def loss_shares(compliance: SeriesCompliance, rate: float) -> Floats:
    """Shares of retardation times in the loss at a rate [1/s]; 1 with the fluidity's."""
    amplitudes, times = np.asarray(compliance.amplitudes), np.asarray(compliance.times)
    loss = amplitudes * rate * times / (1 + (rate * times) ** 2)
    total = float(loss.sum()) + (compliance.fluidity / rate if rate > 0 else 0.0)
    return loss / total if total > 0 else loss


def unresolved_loss(compliance: SeriesCompliance, rate: float, duration: float) -> float:
    """Part of the loss at a rate [1/s] by retardation times shorter than a step [s]."""
    return float(loss_shares(compliance, rate)[np.asarray(compliance.times) < duration].sum())


def retardation_warnings(
    compliance: SeriesCompliance, rate: float, duration: float
) -> dict[str, str]:
    """Warn of a step [s] longer than the retardation times that cause the loss at a rate [1/s]."""
    part = unresolved_loss(compliance, rate, duration)
    if part <= UNRESOLVED_LOSS:
        return {}
    shorter = np.asarray(compliance.times)[np.asarray(compliance.times) < duration]
    return {
        "retardation": (
            f"times: a step of {format_quantity(duration, 's', 3)} of the moving body is longer "
            f"than retardation times that cause {part:.0%} of the loss, up to "
            f"{format_quantity(float(shorter[-1]), 's', 3)}; the resistance is then of first order "
            "in the step: use shorter steps"
        )
    }
