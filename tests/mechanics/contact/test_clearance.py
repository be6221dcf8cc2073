"""First touch of a body that is free to tilt: linear programs, closed forms, and the solver."""

import numpy as np
import pytest
from scipy.optimize import linprog

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.contact.clearance import just_clear, touching_motion
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactProblem, solve_contact
from viscontact.mechanics.contact.rigid_balance import Constraints, RigidPlane

#: The pivot is the centre of a cell.
GRID = vc.Grid((31, 25), (1.8e-3, 1.5e-3))
PLANE = RigidPlane(GRID.x, GRID.y, GRID.cell_size)
RADIUS, ASIDE = 0.01, (3e-4, -2e-4)

BOTH, ALONG_X, ALONG_Y, NONE = (
    np.array([False, x, y]) for x, y in ((True, True), (True, False), (False, True), (False, False))
)


def beside(x: float, y: float, grid: vc.Grid = GRID) -> np.ndarray:
    """Gap of a ball with its lowest point beside the pivot [m]."""
    return vc.Paraboloid(RADIUS, RADIUS).shifted(x, y).gap(grid.x[:, None], grid.y[None, :])


def by_linprog(gap: np.ndarray, free: np.ndarray) -> float:
    """Largest approach of a plane below the gap, by an independent program [m]."""
    x, y = np.broadcast_arrays(GRID.x[:, None], GRID.y[None, :])
    solid = np.isfinite(gap)
    columns = np.column_stack([np.ones(solid.sum()), free[1] * x[solid], free[2] * y[solid]])
    found = linprog([-1, 0, 0], columns, gap[solid], bounds=[(None, None)] * 3)
    assert found.status == 0
    return -found.fun


@pytest.mark.parametrize("free", [BOTH, ALONG_X, ALONG_Y, NONE], ids=["xy", "x", "y", "none"])
@pytest.mark.parametrize("seed", range(8))
def test_first_touch_is_the_optimum_of_a_linear_program(free, seed):
    rng = np.random.default_rng(seed)
    gap = rng.uniform(0.0, 1.0, GRID.shape)
    gap[rng.random(GRID.shape) < 0.7] = np.inf
    found = touching_motion(gap, PLANE, free)
    assert found[0] == close_to(by_linprog(gap, free), rel=1e-9)
    assert (found[~free][1:] == 0).all()
    assert (gap - PLANE.field(found)).min() > -1e-12


def test_ball_beside_the_pivot_touches_at_the_height_of_its_envelope_there():
    # (x - e)²/2R = x²/2R - x e/R + e²/2R: tilted by -e/R, the lowest point is the pivot.
    depths = np.square(ASIDE) / (2 * RADIUS)
    found = touching_motion(beside(*ASIDE), PLANE, BOTH)
    assert found[0] == close_to(depths.sum(), rel=1e-12)
    # Along y it cannot tilt, and touches beside the pivot, at the nearest cell's height.
    along_x = touching_motion(beside(*ASIDE), PLANE, ALONG_X)
    assert along_x[0] == close_to(depths[0], abs=(GRID.cell_size[1] / 2) ** 2 / (2 * RADIUS))


def test_body_on_one_side_of_the_pivot_can_be_clear_at_any_approach():
    gap = np.full(GRID.shape, np.inf)
    gap[20:] = 1.0
    found = touching_motion(gap, PLANE, BOTH)
    assert found[0] > 1e3
    assert (gap - PLANE.field(found)).min() > -1e-9


def test_the_way_to_a_clear_motion_ends_where_the_last_overlap_does():
    # The tangent to (x - e)²/2R from the pivot at d has the slope (sqrt(e² - 2Rd) - e)/R.
    row = vc.Grid((4001, 4), (1.8e-3, 1e-6))
    line = RigidPlane(row.x, row.y, row.cell_size)
    aside, depth = 3e-4, 2e-6
    gap = beside(aside, 0.0, row)
    level, clear = np.array([depth, 0, 0]), np.array([depth, -aside / RADIUS, 0])
    found = just_clear(gap, line, level, clear)
    slope = (np.sqrt(aside**2 - 2 * RADIUS * depth) - aside) / RADIUS
    assert found[1] == close_to(slope, rel=1e-5)
    assert found[0] == depth
    assert found[2] == 0
    assert (gap - line.field(found)).min() > -1e-18
    assert (just_clear(gap, line, clear, level) == clear).all()


@pytest.mark.parametrize("free", [BOTH, ALONG_X], ids=["xy", "x"])
@pytest.mark.parametrize("cells", [(31, 25), (48, 40)], ids=["on a cell", "between cells"])
def test_contact_begins_at_first_touch_and_not_before(cells, free):
    """Relative depths from far before first touch, through rounding, to far beyond it."""
    grid = vc.Grid(cells, GRID.size)
    domain, gap = ContactDomain(grid), beside(*ASIDE, grid)
    first = touching_motion(gap, domain.whole.plane, free)[0]
    moments = (None, 0.0, 0.0 if free[2] else None)
    for depth in (-0.9, -0.5, -0.1, -1e-3, -1e-9, 0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 1.0):
        approach = (1 + depth) * first
        constraints = Constraints(moments, (approach, 0.0, 0.0))
        problem = ContactProblem(gap, 1e-6, constraints, 1e-12 * grid.cell_size[0])
        found = solve_contact(problem, domain)
        assert found.converged
        if depth < 0:
            assert found.gap.min() >= -1e-12 * approach
        if abs(depth) > 1e-11:
            assert found.found.pressure.any() == (depth > 0)
