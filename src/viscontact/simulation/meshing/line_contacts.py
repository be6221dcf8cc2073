"""Line contacts of a history, for which an automatic grid is chosen."""

from __future__ import annotations

import math

from viscontact.bodies.cell_borders import refined_to_borders
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.checks.periodicity import refuse_approach
from viscontact.simulation.meshing.contact_extent import largest_compliance
from viscontact.simulation.meshing.line_grid import line_axis, line_estimate, line_grid


def grid_of_line(problem: Problem, end: float | None) -> Grid:
    """Grid of a line contact for its largest load, before and after all creep up to `end` [s]."""
    indenter, planes = problem.cut_indenter, problem.planes
    axis = line_axis(indenter)
    assert axis is not None
    surface = problem.surface
    if not surface.is_supported:
        refuse_approach(problem.contact_load)
    _, point = problem.largest_load
    if not point.level > 0:
        raise ValueError(
            f"load: the {problem.load.control} is never above zero, so no grid can be fitted to a "
            "contact; give a grid"
        )
    # Eccentricity and tilt along the body are refused by name elsewhere.
    latest = math.inf if end is None else end
    moments = {latest: largest_compliance(problem.compliance, end)}
    if problem.compliance.instant > 0:
        moments[0.0] = float(problem.compliance.instant)
    found = [
        line_estimate(indenter, compliance, point, surface.response_at(time))
        for time, compliance in moments.items()
    ]
    grid = line_grid(found, problem.automatic_grid or AutomaticGrid(), axis)
    return refined_to_borders(grid, planes) if planes else grid
