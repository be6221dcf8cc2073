"""Automatic grid of bodies that adhere, round where they touch.

1. Largest contact: of Johnson, Kendall & Roberts (1971), at the largest compliance, under the
   largest force or approach of the history. It holds more than that of any other law.
2. Size: the attraction at the edge is negligible, where the gap of the undeformed bodies is the
   reach of the law beyond the approach and the height to which the surface is pulled.
3. Cells: across the cohesive zone, pi w/(8 J sigma0²), and across the contact without a load, whose
   radius of the limit of long ranges (Derjaguin, Muller & Toporov 1975) is the least of all laws.
   Without a range, across the contact alone: the zone follows from the cells.
"""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.cohesive_laws import CohesiveLaw
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.bodies.indenters import Indenter, PlacedIndenter
from viscontact.bodies.loads import LoadHistory
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.checks.adhesion import NOTABLE_TAIL, cells_across_zone, law_on
from viscontact.simulation.checks.adhesive_limits import effective_radius
from viscontact.simulation.meshing.contact_extent import MAX_CELLS, largest_compliance
from viscontact.simulation.meshing.refinement import good_shape
from viscontact.units.formatting import format_quantity

#: Cells across the cohesive zone at a tolerance of 1 %, of smooth laws and of one that ends
#: abruptly, the least of each, and cells across the contact without a load; as the inverse root of
#: the tolerance.
ZONE_CELLS, ZONE_CELLS_ABRUPT, CONTACT_CELLS = 2.0, 6.0, 24.0
LEAST_ZONE_CELLS, LEAST_ZONE_CELLS_ABRUPT, LEAST_CONTACT_CELLS = 1.5, 4.0, 20.0

#: Cells across the contact without a load where the range follows from them: a Tabor number of 3.
CELLS_WITHOUT_RANGE = 165.0

#: Attraction at the edge of the grid over the strength [-], and size over twice the contact's reach
#: at least.
TAIL, MARGIN = 0.5 * NOTABLE_TAIL, 1.3

#: Radii of contacts without a load, over (pi w R²/K)^(1/3), K = 4/(3 J): of short and long ranges.
JKR_RADIUS, DMT_RADIUS = 6 ** (1 / 3), 2 ** (1 / 3)

#: Iterations for a radius, which gain a factor of four each.
ITERATIONS = 30

#: Instants at which a load is examined beside its kinks; gap beyond which no body is searched [R].
SAMPLES, FARTHEST = 129, 1e3


@dataclass(frozen=True)
class LargestLoads:
    """Largest loads of a history up to an end."""

    force: float | None  # [N]; None where none is given, like the approach
    approach: float | None  # [m]
    tilt: float  # larger one of both axes [rad]

    @classmethod
    def of(cls, load: LoadHistory, end: float) -> LargestLoads:
        """Largest loads at the kinks of a history, and between them, up to an end [s]."""
        kinks = load.kinks[load.kinks <= end]
        times = np.union1d(np.linspace(0.0, end, SAMPLES), kinks).tolist()
        points = [load.at(time, side=side) for time in times for side in ("left", "right")]
        return cls(
            max((each.force for each in points if each.force is not None), default=None),
            max((each.approach for each in points if each.approach is not None), default=None),
            max(max(abs(each.tilt_x or 0.0), abs(each.tilt_y or 0.0)) for each in points),
        )


def adhesive_grid(problem: Problem, end: float | None) -> Grid:
    """Choose the grid of a problem with adhesion, up to `end` [s]; ValueError if there is none."""
    request = problem.automatic_grid or AutomaticGrid()
    indenter, adhesion = problem.indenter, problem.adhesion
    assert adhesion is not None  # the caller has seen one
    radius = effective_radius(indenter)
    if radius is None:
        raise ValueError(
            "grid: with adhesion a grid is chosen for bodies that are round where they touch, such "
            "as spheres and paraboloids; give a grid whose cells resolve the cohesive zone, as in "
            "grid=vc.Grid(shape, size)"
        )
    compliance = largest_compliance(problem.compliance, end)
    sphere = _Sphere(radius, adhesion.work, compliance)
    cell = _cell(problem, sphere, request)
    law = law_on(problem, Grid((4, 4), (4 * cell, 4 * cell)))
    last = float(problem.contact_load.kinks[-1]) if end is None else end
    loads = LargestLoads.of(problem.contact_load, last)
    stage = problem.load.stage_stiffness
    # A stage that is pulled lets its body come nearer than the stage.
    nearer = 0.0 if stage is None else 2 * math.pi * adhesion.work * radius / stage
    contact = deepest = 0.0
    if loads.approach is not None:
        deepest = max(loads.approach + nearer, 0.0)
        contact = sphere.radius_at(deepest)
    if loads.force is not None:
        contact = max(contact, sphere.radius_under(max(loads.force, 0.0)))
        deepest = max(deepest, contact**2 / radius)
    centre = (indenter.x, indenter.y) if isinstance(indenter, PlacedIndenter) else (0.0, 0.0)
    reach = _reach(law, TAIL) + deepest
    half = [
        max(_edge(indenter, axis, centre, reach, sphere, loads.tilt), MARGIN * each)
        for axis, each in enumerate(_half_axes(indenter, contact))
    ]
    counts = 2 * np.array(half) / cell
    _refuse_many_cells(counts, cell, cells_across_zone(law, problem, _square(cell)))
    shape = good_shape(counts, math.inf)
    return Grid(shape, (shape[0] * cell, shape[1] * cell), centre=centre)


@dataclass(frozen=True)
class _Sphere:
    """Sphere in the limit of short ranges (Johnson, Kendall & Roberts 1971)."""

    radius: float  # [m]
    work: float  # [J/m²]
    compliance: float  # [1/Pa]

    @property
    def length(self) -> float:
        """Unit of radii (pi w R²/K)^(1/3), K = 4/(3 J) [m]."""
        modulus = 4 / (3 * self.compliance)
        return float(np.cbrt(math.pi * self.work * self.radius**2 / modulus))

    def radius_under(self, force: float) -> float:
        """Radius of the contact under a force that presses [m]."""
        pull = 3 * math.pi * self.work * self.radius
        borne = force + pull + math.sqrt(2 * pull * force + pull**2)
        return float(np.cbrt(0.75 * self.radius * self.compliance * borne))

    def radius_at(self, approach: float) -> float:
        """Radius of the contact at an approach; at a negative one, without a load [m]."""
        scale = self.length
        depth = max(approach, 0.0) * self.radius / scale**2
        found = JKR_RADIUS + math.sqrt(depth)
        for _ in range(ITERATIONS):  # the root of a² - 2/3 sqrt(6 a) = depth
            found = math.sqrt(depth + 2 / 3 * math.sqrt(6 * found))
        return max(found, JKR_RADIUS) * scale


def _cell(problem: Problem, sphere: _Sphere, request: AutomaticGrid) -> float:
    """Edge of the cells [m]."""
    adhesion = problem.adhesion
    assert adhesion is not None  # as in the caller
    finer = math.sqrt(0.01 / request.tolerance)
    largest = min(request.largest_cell or (math.inf, math.inf))
    if adhesion.range is None and adhesion.strength is None:
        return min(2 * JKR_RADIUS * sphere.length / CELLS_WITHOUT_RANGE, largest)
    law = adhesion.cohesive_law
    per_zone, least = ZONE_CELLS * finer, LEAST_ZONE_CELLS
    if law.is_abrupt:
        per_zone, least = ZONE_CELLS_ABRUPT * finer, LEAST_ZONE_CELLS_ABRUPT
    zone = cells_across_zone(law, problem, _square(1.0))
    across = max(CONTACT_CELLS * finer, LEAST_CONTACT_CELLS)
    contact = 2 * DMT_RADIUS * sphere.length
    return min(zone / max(per_zone, least), contact / across, largest)


def _square(cell: float) -> Grid:
    return Grid((4, 4), (4 * cell, 4 * cell))


def _reach(law: CohesiveLaw, tail: float) -> float:
    """Gap at which the traction has fallen to a part of the strength [m]."""
    gaps = np.geomspace(law.range, 2 * law.reach, 2000)
    fallen = law.traction(gaps, np.zeros(gaps.shape)) <= tail * law.strength
    return float(gaps[int(np.argmax(fallen))])


def _half_axes(indenter: Indenter, radius: float) -> tuple[float, float]:
    """Half axes of an oval contact of the area of a round one [m], as of Hertz's about."""
    along, across = indenter.curvatures
    longer = float(np.cbrt(across / along))
    return radius * longer, radius / longer


def _edge(
    indenter: Indenter,
    axis: int,
    centre: tuple[float, float],
    reach: float,
    sphere: _Sphere,
    tilt: float,
) -> float:
    """Distance along an axis at which the gap exceeds the reach of the attraction [m]."""
    distances = sphere.length * np.geomspace(0.1, FARTHEST, 400)

    def gap(side: float) -> Floats:
        places = [np.full(distances.size, middle) for middle in centre]
        places[axis] = places[axis] + side * distances
        return indenter.gap(places[0], places[1])

    # Beyond a contact the surface is pulled up by F J/(pi r) by a force F, 2 pi w R at most.
    pulled = 2 * sphere.work * sphere.radius * sphere.compliance / distances
    needed = reach + pulled + tilt * distances
    enough = (gap(-1.0) >= needed) & (gap(1.0) >= needed)
    if not enough.any():
        raise ValueError(
            "grid: the gap nowhere exceeds the reach of the attraction, so no grid holds it; give "
            "a grid"
        )
    return float(distances[int(np.argmax(enough))])


def _refuse_many_cells(counts: Floats, cell: float, zone: float) -> None:
    """Refuse a grid of too many cells."""
    if float(counts.prod()) <= MAX_CELLS:
        return
    size, number = format_quantity(cell, "m", 3), float(counts.prod())
    raise ValueError(
        f"grid: {zone:.2g} cells of {size} across the cohesive zone make {number:.2g} cells of the "
        "grid, more than an automatic one has; use a longer range, leave the range of an elastic "
        "body out (the limit of short ranges, JKR), or give a grid"
    )
