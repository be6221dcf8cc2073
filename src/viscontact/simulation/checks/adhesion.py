"""Checks of adhesion, and the attraction on a grid."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.adhesion import Adhesion
from viscontact.bodies.cohesive_laws import CohesiveLaw
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads import LoadHistory
from viscontact.mechanics.problem.problem import Problem
from viscontact.units.formatting import format_quantity

#: Cells across the cohesive zone: fewest of a computation, fewest of an accurate one with a smooth
#: law and with one that ends abruptly, and those of a range that the grid chooses.
LEAST_CELLS, ENOUGH_CELLS, ENOUGH_ABRUPT, CHOSEN_CELLS = 0.5, 1.5, 4.0, 1.5

#: Attraction at the edge of a grid from which on a run warns, over the strength [-].
NOTABLE_TAIL = 1e-4


def check_adhesion(problem: Problem) -> None:
    """Refuse adhesion that cannot be computed, and without it forces that pull."""
    refused = _refusals(problem) if problem.adhesion else _refusals_without(problem.load)
    for why in refused:
        raise ValueError(why)


def _refusals_without(load: LoadHistory) -> Iterator[str]:
    """What a load needs adhesion for."""
    if load.least_force < 0:
        force = format_quantity(load.least_force, "N", 6)
        yield (
            f"load: the force must be zero or more without adhesion, got {force}; a negative force "
            "pulls: give adhesion=vc.Adhesion(work, range=...)"
        )
    if load.stage_stiffness is not None:
        yield (
            "load.stage_stiffness: a stage on a spring is computed for bodies that adhere; give "
            "adhesion, or prescribe force or approach"
        )


def _refusals(problem: Problem) -> Iterator[str]:
    """What is not computed with adhesion."""
    load = problem.load
    if not problem.motion.stands:
        yield (
            "adhesion: a body that moves over the surface is not supported with adhesion; leave "
            "the motion or adhesion out"
        )
    if problem.friction is not None:
        yield "adhesion: friction is not supported with adhesion; leave one of them out"
    if load.control == "force" and problem.compliance.instant == 0:
        yield (
            "adhesion: under a given force the bodies jump into contact at time 0, but the law has "
            "no instant compliance; prescribe the approach, or give the law an instant compliance"
        )
    if has_no_range(problem.adhesion) and not problem.surface.creep.is_elastic:
        yield (
            "adhesion.range: must be given for bodies that creep, as it sets the speeds at which "
            "they hold more; give range or strength"
        )


def law_on(problem: Problem, grid: Grid) -> CohesiveLaw:
    """Attraction of a problem on a grid; ValueError if its cells are too large for the range."""
    adhesion = problem.adhesion
    assert adhesion is not None  # the caller has seen one
    spacing = longest_edge(grid)
    if has_no_range(adhesion):
        strength = math.sqrt(_zone(1.0, adhesion.work, problem) / (CHOSEN_CELLS * spacing))
        adhesion = Adhesion(adhesion.work, strength=strength, law=adhesion.law)
    law = adhesion.cohesive_law
    across = cells_across_zone(law, problem, grid)
    if across < LEAST_CELLS:
        cell = format_quantity(spacing, "m", 3)
        widest = format_quantity(spacing * across / ENOUGH_CELLS, "m", 2)
        raise ValueError(
            f"grid: {across:.2g} cells of {cell} lie across the cohesive zone and {LEAST_CELLS:g} "
            f"are the least ({ENOUGH_CELLS:g} or more recommended); use cells of up to {widest}, "
            "or a longer range, or leave the range out for the limit of short ranges (JKR)"
        )
    return law


def resolved_on(problem: Problem, grid: Grid) -> Problem:
    """The problem with adhesion of so long a range that the cells of a rough grid resolve it."""
    adhesion = problem.adhesion
    if adhesion is None or has_no_range(adhesion):
        return problem
    law = adhesion.cohesive_law
    missing = ENOUGH_CELLS / cells_across_zone(law, problem, grid)
    if missing <= 1:
        return problem
    longer = law.range * math.sqrt(missing)  # the zone is as wide as the square of the range
    return replace(problem, adhesion=Adhesion(adhesion.work, range=longer, law=adhesion.law))


def cells_across_zone(law: CohesiveLaw, problem: Problem, grid: Grid) -> float:
    """Cells across the cohesive zone of the relaxed body, π w/(8 J σ0²)."""
    return _zone(law.strength, law.work, problem) / longest_edge(grid)


def longest_edge(grid: Grid) -> float:
    """Longest edge of a cell [m], but for that of the only cell along a line contact."""
    edges = zip(grid.shape, grid.cell_size, strict=True)
    return max((edge for count, edge in edges if count > 1), default=max(grid.cell_size))


def tail_warnings(law: CohesiveLaw, pressure: Floats, grid: Grid) -> dict[str, str]:
    """Warn of an attraction that reaches beyond the grid [Pa]."""
    lines = pressure, pressure.T
    ends = [each for each, repeats in zip(lines, grid.periodic, strict=True) if not repeats]
    largest = max((float(np.abs(each[[0, -1]]).max()) for each in ends), default=0.0)
    largest /= law.strength
    return {} if largest <= NOTABLE_TAIL else tail_warning(largest)


def tail_warning(tail: float) -> dict[str, str]:
    """Warning of an attraction at the edge of the grid, over the strength [-]."""
    return {
        "tail": (
            f"the attraction at the edge of the grid is {tail:.2g} of the strength: what lies "
            "beyond is missing in the force; enlarge the grid"
        )
    }


def has_no_range(adhesion: Adhesion | None) -> bool:
    """True if the cells are to choose the range."""
    return adhesion is not None and adhesion.range is None and adhesion.strength is None


def _zone(strength: float, work: float, problem: Problem) -> float:
    """Width of the cohesive zone of a straight edge [m] (Maugis 1992, half Dugdale's)."""
    compliance = problem.compliance(problem.end)
    return math.pi * work / (8 * float(compliance) * strength**2)
