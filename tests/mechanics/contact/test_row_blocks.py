"""Blocks of rows and threads do not change a contact, beyond the rounding of sums."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from viscontact.backend import team
from viscontact.backend.transforms import (
    fastest_transforms,
    fill_of_order,
    restore_of_order,
    transforms_by,
)
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactProblem, ContactSolution, solve_contact
from viscontact.mechanics.contact.rigid_balance import Constraints

GRID = vc.Grid((64, 60), (0.5, 0.5))
GAP = vc.Paraboloid(1.0, 0.6).gap(GRID.x[:, None], GRID.y[None, :])
LOAD = Constraints((1e3, 20.0, -10.0))


def solved(threads: int) -> ContactSolution:
    domain = ContactDomain(GRID, transforms=transforms_by(fastest_transforms(), threads))
    problem = ContactProblem(GAP, 2.5e-7, LOAD, 1e-15)
    return solve_contact(problem, domain, tolerance=1e-9)


def test_blocks_of_rows_and_threads_give_the_pressure_of_the_whole(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    whole = solved(1)
    monkeypatch.setattr(team, "BLOCK_BYTES", 5000)  # about ten rows
    for threads in (1, 2, 3):
        found = solved(threads)
        assert found.converged
        assert found.iterations == whole.iterations
        peak = whole.values[0].max()
        assert np.abs(found.values[0] - whole.values[0]).max() < 1e-8 * peak
        again = solved(threads)
        assert again.values.tobytes() == found.values.tobytes()


@pytest.mark.parametrize("number", [np.float32, np.float64])
def test_a_field_that_is_stored_by_its_factor_is_restored(number: type) -> None:
    field, block, again = np.array([3.0, -4.0]), np.zeros(2, number), np.zeros(2)
    fill_of_order(4.0, block, field)
    assert block.tolist() == [0.75, -1.0]
    restore_of_order(4.0, block, again)
    assert again.tolist() == [3.0, -4.0]


@given(lines=st.integers(0, 3000), row_bytes=st.integers(1, 2**23))
def test_blocks_are_even_shares_of_all_lines(lines: int, row_bytes: int) -> None:
    blocks = team.blocks_of(lines, row_bytes)
    sizes = [block.stop - block.start for block in blocks]
    assert [line for block in blocks for line in range(block.start, block.stop)] == [*range(lines)]
    assert all(size == 1 or size * row_bytes <= team.BLOCK_BYTES for size in sizes)
    assert max(sizes, default=0) - min(sizes, default=0) <= 1
    assert sizes[:1] == [max(sizes)] if sizes else not lines
    assert len(blocks) in (0, 1, lines) or len(blocks) % team.EVEN_SHARES == 0


@settings(max_examples=8, deadline=None)
@given(pascal=st.floats(-60, 60), metre=st.floats(-9, 9))
def test_the_search_finds_the_same_contact_in_any_units(pascal: float, metre: float) -> None:
    """Residual and directions are in single precision, of a range of 1e-38 to 1e38."""
    force, length = 10.0**pascal, 10.0**metre
    grid = vc.Grid((32, 30), (0.5 * length, 0.5 * length))
    gap = vc.Paraboloid(length, 0.6 * length).gap(grid.x[:, None], grid.y[None, :])
    load = force * length**2
    problem = ContactProblem(
        gap,
        2.5e-7 / force,
        Constraints((1e3 * load, 20.0 * load * length, -10.0 * load * length)),
        1e-15 * length,
    )
    found = solve_contact(problem, ContactDomain(grid), tolerance=1e-9)
    known = solve_contact(
        ContactProblem(gap / length, 2.5e-7, LOAD, 1e-15),
        ContactDomain(vc.Grid((32, 30), (0.5, 0.5))),
        tolerance=1e-9,
    )
    assert found.converged
    assert found.iterations <= known.iterations + 1
    assert found.values[0] / force == close_to(known.values[0], rel=1e-6, abs=1e-3)


def test_a_run_on_two_threads_gives_the_same_bits_each_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(team, "BLOCK_BYTES", 5000)
    rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    given = vc.Sphere(0.01), rubber, vc.step(0.1, eccentricity_x=1e-5)
    grid, times = vc.Grid((40, 40), (2.4e-3, 2.4e-3)), vc.uniform_times(2.0, 4)
    runs = [
        np.stack([state.pressure for state in vc.march(*given, grid, times, threads=2)])
        for _ in range(2)
    ]
    assert runs[0].tobytes() == runs[1].tobytes()
    alone = np.stack([state.pressure for state in vc.march(*given, grid, times)])
    assert np.abs(runs[0] - alone).max() < 1e-5 * alone.max()


@pytest.mark.parametrize("cells", [8, 16, 60])
def test_a_solution_is_balanced_to_rounding_though_the_search_is_in_single_precision(
    cells: int,
) -> None:
    grid = vc.Grid((cells, cells), (0.5, 0.5))
    gap = vc.Paraboloid(1.0, 0.6).gap(grid.x[:, None], grid.y[None, :])
    domain = ContactDomain(grid)
    found = solve_contact(ContactProblem(gap, 2.5e-7, LOAD, 1e-15), domain, tolerance=1e-6)
    assert found.converged
    sums = domain.whole.plane.sums(found.values[0]) * grid.cell_area
    assert LOAD.imbalance(sums, domain.whole.arm) < 1e-12
