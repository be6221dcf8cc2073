"""Checks and warnings of a moving contact."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.grid import Grid
from viscontact.loads.motion import Motion
from viscontact.materials.compliance import SeriesCompliance
from viscontact.problem.problem import Problem
from viscontact.units.formatting import format_quantity

#: Way of a step over half the contact's extent along the motion up to which the error of the
#: resistance is about 1 %: it is 0.6 of its square where the material is far from relaxed.
LONGEST_WAY = 1 / 8

#: Part of the loss that retardation times shorter than a step may cause.
UNRESOLVED_LOSS = 0.1


def check_motion(problem: Problem) -> None:
    """Refuse what a moving contact cannot be computed with, before its times are needed."""
    motion = problem.motion
    if motion is None:
        return
    _check_mate(problem, motion)


def _check_mate(problem: Problem, motion: Motion) -> None:
    mate = problem.indenter_material
    if mate is None:
        return
    compliance = mate.contact_compliance()
    if compliance.settled_after == 0 and isinstance(compliance, SeriesCompliance):
        return  # elastic
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


def check_path(problem: Problem, grid: Grid) -> None:
    """Refuse a path along which the body's axis leaves the grid."""
    if problem.motion is None:
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
    if problem.motion is None or (isinstance(problem.grid, Grid) and problem.grid.periodic):
        return {}
    free = [
        f"tilt_{name}"
        for name, moves in zip("xy", problem.motion.moves, strict=True)
        if moves and getattr(problem.load, f"tilt_{name}") is None
    ]
    if not free:
        return {}
    given = " and ".join(f"{name} = 0" for name in free)
    return {
        "axle": (
            f"load: {' and '.join(free)} is free of moment along the motion, so that the body "
            f"tilts until its resultant acts on its axis; for a body on an axle give {given}"
        )
    }


def edge_warnings(at_end: bool) -> dict[str, str]:
    """Warn of a contact that has reached an end of the body along the motion."""
    if not at_end:
        return {}
    return {
        "edge": (
            "motion: the contact reaches an end of the body along the motion, where the pressure "
            "is singular; the force on this edge is not computed: resistance, friction "
            "coefficient and motion work are NaN from there on; dissipation and heat are known"
        )
    }


def way_warnings(way: float, half_extent: float) -> dict[str, str]:
    """Warn of a step whose way [m] is long against half the contact's extent along it [m].

    Examples
    --------
    >>> list(way_warnings(1e-4, 1e-3)), list(way_warnings(1e-3, 1e-3))
    ([], ['way'])
    """
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


def loss_shares(compliance: SeriesCompliance, rate: float) -> NDArray[np.float64]:
    """Shares of the retardation times in the loss compliance at an angular frequency [1/s].

    They add up to one with that of the fluidity.
    """
    amplitudes, times = np.asarray(compliance.amplitudes), np.asarray(compliance.times)
    loss = amplitudes * rate * times / (1 + (rate * times) ** 2)
    total = float(loss.sum()) + (compliance.fluidity / rate if rate > 0 else 0.0)
    return loss / total if total > 0 else loss


def unresolved_loss(compliance: SeriesCompliance, rate: float, duration: float) -> float:
    """Part of the loss at an angular frequency [1/s] by retardation times shorter than a step [s].

    Examples
    --------
    >>> unresolved_loss(SeriesCompliance(1.0, [1.0], [2.0]), rate=0.1, duration=3.0)
    1.0
    """
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
