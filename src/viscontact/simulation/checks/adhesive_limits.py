"""Limits of adhesive contact: Tabor numbers, ranges, and data of the law."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.adhesion import regime
from viscontact.bodies.cohesive_laws import CohesiveLaw
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.mechanics.problem.problem import DataTimes, Problem
from viscontact.simulation.checks.adhesion import (
    ENOUGH_ABRUPT,
    ENOUGH_CELLS,
    NOTABLE_TAIL,
    cells_across_zone,
    has_no_range,
    longest_edge,
    tail_warning,
)
from viscontact.units.formatting import format_number, format_quantity

#: Pull-off forces of an elastic sphere in the limits, over pi w R [-].
JKR_PULL, DMT_PULL = 1.5, 2.0

#: Excess of the pull-off force over that of JKR at some Tabor numbers, by laws: of Dugdale's by
#: Maugis 1992, of others computed on grids of three cells or more across the cohesive zone [-].
JKR_EXCESS_AT = (0.5, 1.0, 2.0, 3.0, 5.0)
JKR_EXCESS = {
    "exponential": (0.184, 0.110, 0.050, 0.028, 0.012),
    "lennard-jones": (0.190, 0.112, 0.054, 0.031, 0.013),
    "dugdale": (0.130, 0.0569, 0.0187, 0.0089, 0.0034),
}


def effective_radius(indenter: Indenter) -> float | None:
    """Radius of a round body, of an oval one the geometric mean [m]; None of any other."""
    along, across = getattr(indenter, "curvatures", (0.0, 0.0))
    if not (along > 0 and across > 0):
        return None
    return 1 / math.sqrt(float(along) * float(across))


def tabor_numbers(law: CohesiveLaw, problem: Problem) -> tuple[float, float] | None:
    """Tabor numbers (R w² J²/range³)^(1/3) at once and at the end; None of a body not round."""
    radius = effective_radius(problem.indenter)
    if radius is None:
        return None
    instant, relaxed = float(problem.compliance.instant), float(problem.compliance(problem.end))
    at_once, at_end = (
        float(np.cbrt(radius * (law.work * compliance) ** 2)) / law.range
        for compliance in (instant, relaxed)
    )
    return at_once, at_end


def adhesion_rows(law: CohesiveLaw, problem: Problem, grid: Grid) -> Iterator[tuple[str, str]]:
    """Yield rows of a check: Tabor number with the limit that applies, pull-off, cohesive zone."""
    numbers = tabor_numbers(law, problem)
    if numbers is not None:
        at_once, at_end = numbers
        creeps = at_end > at_once * (1 + 1e-9)
        earlier = f", {format_number(at_once, 2)} at once" if creeps else ""
        yield "Tabor number", f"{format_number(at_end, 2)}{earlier}: {regime(at_end)}"
        radius = effective_radius(problem.indenter)
        assert radius is not None  # there is a Tabor number
        least, most = (
            format_quantity(factor * math.pi * law.work * radius, "N", 3)
            for factor in (JKR_PULL, DMT_PULL)
        )
        slow = " when withdrawn slowly" if creeps else ""
        yield "pull-off force", f"{least} (JKR) to {most} (DMT){slow}"
    width = cells_across_zone(law, problem, grid)
    size = format_quantity(width * longest_edge(grid), "m", 3)
    yield "cohesive zone", f"{size} wide, {format_number(width, 2)} cells"


def zone_warnings(law: CohesiveLaw, problem: Problem, grid: Grid) -> dict[str, str]:
    """Warn of a cohesive zone of few cells, and of a range that the cells have chosen."""
    if has_no_range(problem.adhesion):
        length, excess = format_quantity(law.range, "m", 3), _excess(law, problem)
        return {
            "zone": (
                f"the range of the attraction, {length}, is the shortest that the cells resolve: "
                f"the bodies hold more than in the limit of short ranges (JKR){excess}; compare "
                "with smaller cells"
            )
        }
    across = cells_across_zone(law, problem, grid)
    enough = ENOUGH_ABRUPT if law.is_abrupt else ENOUGH_CELLS
    if across >= enough * (1 - 1e-9):
        return {}
    return {
        "zone": (
            f"{across:.2g} cells lie across the cohesive zone; with fewer than {enough:g} the "
            "largest pull is off by more than a percent; use smaller cells"
        )
    }


def _excess(law: CohesiveLaw, problem: Problem) -> str:
    """How much more an elastic sphere of the range holds than one of a short range, in words."""
    numbers, adhesion = tabor_numbers(law, problem), problem.adhesion
    assert adhesion is not None  # the caller has seen one
    if numbers is None or numbers[1] < JKR_EXCESS_AT[0]:
        return ""
    known = np.log(JKR_EXCESS_AT), np.log(JKR_EXCESS[adhesion.law])
    excess = math.exp(float(np.interp(math.log(numbers[1]), *known)))
    tabor = format_number(numbers[1], 2)
    return f", a sphere of the Tabor number {tabor} by {100 * excess:.2g} % at pull-off"


def expected_tail_warnings(law: CohesiveLaw, open_gap: Floats, grid: Grid) -> dict[str, str]:
    """Warn of a grid whose edge the attraction of touching bodies reaches; open gap [m]."""
    touching = open_gap - open_gap.min()
    lines = touching, touching.T
    ends = [each for each, repeats in zip(lines, grid.periodic, strict=True) if not repeats]
    least = np.array([min((float(each[[0, -1]].min()) for each in ends), default=math.inf)])
    tail = float(law.traction(least, np.zeros(1))[0]) / law.strength
    return tail_warning(tail) if tail > NOTABLE_TAIL else {}


def front_warnings(passed: float, measured: Sequence[DataTimes]) -> dict[str, str]:
    """Warn of an edge that passes the cohesive zone before the data of a law begin [s]."""
    data = max(measured, key=lambda each: each.first)
    if not passed < data.first * (1 - 1e-9):
        return {}
    return {
        "front": (
            f"while contact was lost its edge passed the width of the cohesive zone in about "
            f"{format_quantity(passed, 's', 2)}, before {format_quantity(data.first, 's')}, where "
            f"the {data.whose}'s data begin; the pull-off force rests on an extrapolation of its "
            "law"
        )
    }
