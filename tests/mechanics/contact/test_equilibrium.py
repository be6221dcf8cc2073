"""The solver by itself: what it promises of its answer, and of bad starts and short budgets."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from verification.independent import deflection, love
from viscontact.mechanics.contact import conjugate_gradients
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactProblem, Guess, solve_contact
from viscontact.mechanics.contact.rigid_balance import Constraints, RigidPlane
from viscontact.mechanics.contact.winkler import project_onto_balance

GRID = vc.Grid((40, 36), (0.5, 0.5))
SPHERE = vc.Paraboloid(1.0, 0.6).gap(GRID.x[:, None], GRID.y[None, :])
COMPLIANCE = 2.5e-7
LOAD = Constraints((1e3, 20.0, -10.0))


def problem(support=LOAD, open_gap=SPHERE):
    return ContactProblem(open_gap, COMPLIANCE, support, 1e-15)


@pytest.fixture(scope="module")
def half_space():
    return ContactDomain(GRID)


@pytest.fixture(scope="module")
def solution(half_space):
    return solve_contact(problem(), half_space, tolerance=1e-10)


def test_the_certificate_is_that_of_the_returned_pressure(half_space):
    for tolerance in (1e-2, 1e-4, 1e-8, 1e-11):
        found = solve_contact(problem(), half_space, tolerance=tolerance)
        assert found.converged
        assert found.residual <= tolerance
        pressure, (approach, tilt_x, tilt_y) = found.found.pressure, found.found.motion
        displacement = COMPLIANCE * deflection(pressure, GRID.cell_size)
        plane = approach + tilt_x * GRID.x[:, None] + tilt_y * GRID.y[None, :]
        gap = SPHERE + displacement - plane
        touching = pressure > 0
        assert (found.in_contact == touching).all()  # not what merely overlaps within the tolerance
        violation = max(np.abs(gap[touching]).max(), -gap.min()) / displacement.max()
        # Rounding of two routes to the gap; measured 1e-15.
        assert violation == close_to(found.residual, abs=1e-13)
        assert np.abs(found.gap - gap).max() < 1e-13 * displacement.max()


def test_cells_in_contact_touch_within_the_radius_of_hertz():
    grid, radius = vc.Grid((64, 64), (0.16, 0.16)), (0.75 * 1e3 * COMPLIANCE) ** (1 / 3)
    gap = vc.Paraboloid(1.0, 1.0).gap(grid.x[:, None], grid.y[None, :])
    centred = Constraints((1e3, 0.0, 0.0))
    found = solve_contact(problem(centred, gap), ContactDomain(grid), tolerance=1e-10)
    closed = 1e-10 * COMPLIANCE * found.found.unit_displacement.max()
    assert (np.abs(found.gap[found.in_contact]) <= closed).all()
    assert (found.gap[~found.in_contact] > closed).all()
    # The rim runs through the cells at 22.9 cells from the centre.
    distance, cell = np.hypot(grid.x[:, None], grid.y[None, :]), grid.cell_size[0]
    assert found.in_contact[distance < radius - cell].all()
    assert not found.in_contact[distance > radius + cell].any()


def test_no_cell_is_in_contact_under_a_body_that_has_turned_away():
    grid = vc.Grid((8, 8), (1.0, 1.0))
    apart = ContactProblem(
        np.ones(grid.shape), 1e-6, Constraints((None,) * 3, (0.5, 0.0, 0.0)), 1e-15
    )
    assert not solve_contact(apart, ContactDomain(grid)).in_contact.any()


def test_the_answer_as_a_start_is_the_answer(half_space, solution):
    found = Guess(solution.values.copy(), solution.motion)
    again = solve_contact(problem(), half_space, found, tolerance=1e-9)
    assert again.iterations == 0
    assert (again.found.pressure == solution.found.pressure).all()


def nonsense(kind):
    rng = np.random.default_rng(4)
    pressure = {
        "nothing": np.zeros(GRID.shape),
        "negative": -np.ones(GRID.shape),
        "noise": rng.standard_normal(GRID.shape) * 1e4,
        "one cell aside": np.eye(40, 36, 20) * 1e5,
        "far too much": np.full(GRID.shape, 1e12),
        "hardly anything": np.full(GRID.shape, 1e-9),
    }[kind]
    return Guess.of(pressure, deflection(pressure, GRID.cell_size), np.zeros(3))


@pytest.mark.parametrize(
    "kind", ["nothing", "negative", "noise", "one cell aside", "far too much", "hardly anything"]
)
def test_any_start_leads_to_the_same_answer(kind, half_space, solution):
    found = solve_contact(problem(), half_space, nonsense(kind), tolerance=1e-10)
    assert found.converged
    peak = solution.found.pressure.max()
    # Both within 1e-10; measured 1e-9 of the peak.
    assert np.abs(found.found.pressure - solution.found.pressure).max() < 1e-8 * peak


def test_a_budget_too_small_is_owned_up_to(half_space):
    found = solve_contact(problem(), half_space, tolerance=1e-10, max_iterations=2)
    assert not found.converged
    assert found.residual > 1e-10


def test_a_tolerance_beyond_rounding_ends_and_says_so(half_space):
    found = solve_contact(problem(), half_space, tolerance=1e-18)
    assert not found.converged
    # What it stopped at is as good as rounding lets it be.
    assert found.residual < 1e-11


def test_prescribed_tilts_are_kept_and_their_moments_not_balanced(half_space):
    support = Constraints((1e3, None, None), (0.0, 0.02, -0.01))
    found = solve_contact(problem(support), half_space, tolerance=1e-8)
    assert found.converged
    assert found.found.motion[1:].tolist() == [0.02, -0.01]


def test_cells_without_a_surface_carry_nothing(half_space):
    hole = SPHERE.copy()
    hole[18:22, 16:20] = np.inf
    found = solve_contact(problem(open_gap=hole), half_space, tolerance=1e-8)
    assert found.converged
    assert not found.found.pressure[np.isinf(hole)].any()
    assert (found.gap[np.isinf(hole)] == np.inf).all()


def test_two_peaks_share_a_force_between_them_by_the_lever():
    # Statics: a force at a third of the way puts two thirds on the nearer peak, however unequal
    # their heights; the body tilts until both touch.
    grid, open_gap = vc.Grid((40, 9), (4.0, 0.9)), np.full((40, 9), np.inf)
    open_gap[4, 4], open_gap[34, 4] = 0.0, 0.1
    near, far = grid.x[4], grid.x[34]
    where = near + (far - near) / 3
    support = Constraints((9.0, 9.0 * where, 0.0))
    case = ContactProblem(open_gap, 1e-6, support, 1e-15)
    found = solve_contact(case, ContactDomain(grid), tolerance=1e-9)
    assert found.converged
    shares = found.found.pressure[[4, 34], 4] * grid.cell_area
    assert shares == close_to([6.0, 3.0], rel=1e-8)
    # Two gaps, two displacements of their own and of each other: closed form.
    own, other = (float(love(d, 0.0, *grid.cell_size)) for d in (0.0, far - near))
    sinks = 1e-6 * (np.array([[own, other], [other, own]]) @ found.found.pressure[[4, 34], 4])
    tilt = (sinks[1] + 0.1 - sinks[0]) / (far - near)
    assert found.found.motion[1] == close_to(tilt, rel=1e-8)


def test_a_load_between_two_rows_of_cells_is_found_by_them():
    # The body tilts until the force acts near one row of 40 cells; what little the next row has
    # to carry is more than a search along single cells would ever find.
    grid = vc.Grid((218, 12), (183.0, 8.2))
    open_gap = vc.Paraboloid(868.0, 2.77).gap(grid.x[:, None], grid.y[None, :])
    force, aside = 2.4e6, 1.06
    assert 0 < aside - grid.y[7] < 0.06 * grid.cell_size[1]
    case = ContactProblem(open_gap, 2e-7, Constraints((force, 0.0, force * aside)), 1e-15)
    found = solve_contact(case, ContactDomain(grid), tolerance=1e-8)
    assert found.converged
    # Measured: 8; a preconditioned search takes 10 to 20, whatever the grid.
    assert found.iterations < 20
    shares = found.found.pressure.sum(axis=0) * grid.cell_area
    # Statics: the lever between the rows that bear, to the balance's tolerance.
    assert np.flatnonzero(shares).tolist() == [7, 8]
    lever = (aside - grid.y[7]) / grid.cell_size[1]
    assert shares[7:9] / force == close_to([1 - lever, lever], rel=1e-7)


def test_a_search_that_can_only_give_up_cell_after_cell_gets_there_too(monkeypatch):
    # As if no balance could be found nearby. Rounding once left the cell that was to go a trifle,
    # or less than nothing, and the search went on without getting anywhere.
    monkeypatch.setattr(
        conjugate_gradients, "project_onto_balance", lambda pressure, *_: np.zeros_like(pressure)
    )
    grid = vc.Grid((218, 12), (183.0, 8.2))
    open_gap = vc.Paraboloid(868.0, 2.77).gap(grid.x[:, None], grid.y[None, :])
    case = ContactProblem(open_gap, 2e-7, Constraints((2.4e6, 0.0, 2.4e6 * 1.06)), 1e-15)
    found = solve_contact(case, ContactDomain(grid), tolerance=1e-8)
    assert found.converged
    assert found.found.pressure.min() >= 0
    # One step for each of some 45 cells and a few more; 79 where some cells take several.
    assert found.iterations < 60


@given(seed=st.integers(0, 10_000))
def test_the_nearest_balanced_pressure_is_the_one_of_least_change(seed):
    """Its conditions (Karush, Kuhn and Tucker): a plane is added, and where not, it would pull."""
    rng = np.random.default_rng(seed)
    shape = (7, 6)
    grid = vc.Grid(shape, (7.0, 3.0))
    plane = RigidPlane(grid.x, grid.y, grid.cell_size)
    cells = rng.random(shape) < 0.8
    bearing = rng.random(shape) * cells  # some pressure with the wanted resultants
    wanted = plane.sums(bearing) * grid.cell_area
    pressure = rng.standard_normal(shape)
    found = project_onto_balance(pressure, cells, Constraints(tuple(wanted)), plane, grid.cell_area)
    assert (found >= 0).all()
    assert not found[~cells].any()
    # Newton's method ends at the energy's rounding, that is at half the digits of the balance.
    assert plane.sums(found) * grid.cell_area == close_to(wanted, abs=1e-6)
    bears = found > 0
    columns = np.stack(
        [np.ones(42), *(axis.ravel() for axis in np.meshgrid(grid.x, grid.y, indexing="ij"))], 1
    )
    added, *_ = np.linalg.lstsq(columns[bears.ravel()], (found - pressure)[bears], rcond=None)
    field = (columns @ added).reshape(shape)
    assert np.abs((found - pressure - field)[bears]).max() < 1e-9
    if np.linalg.matrix_rank(columns[bears.ravel()]) == 3:
        assert ((pressure + field)[cells & ~bears] <= 1e-9).all()


@pytest.mark.parametrize("seed", range(20))
def test_a_body_on_a_stage_that_can_tilt_clear_has_no_contact(seed):
    # All its peaks lie on one side of the axis that it is free to turn about, so that any
    # pressure would have a moment: there is none, and the body has turned away.
    rng = np.random.default_rng(seed)
    grid, open_gap = vc.Grid((40, 30), (4.0, 3.0)), np.full((40, 30), np.inf)
    open_gap[rng.integers(25, 40, 5), rng.integers(18, 30, 5)] = rng.uniform(0.0, 0.5, 5)
    case = ContactProblem(open_gap, 1e-6, Constraints((None, 0.0, 0.0), (0.6, 0.0, 0.0)), 1e-6)
    found = solve_contact(case, ContactDomain(grid), tolerance=1e-6)
    assert found.converged
    assert not found.found.pressure.any()
    assert found.gap.min() > -1e-12
