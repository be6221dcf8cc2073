"""Blocks of rows and threads do not change a contact, beyond the rounding of sums."""

import numpy as np
import pytest

import viscontact as vc
from viscontact.contact.domain import ContactDomain
from viscontact.contact.equilibrium import ContactProblem, ContactSolution, solve_contact
from viscontact.contact.rigid_balance import Constraints
from viscontact.fourier import fastest_transforms, transforms_by
from viscontact.halfspace import line_blocks

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
    monkeypatch.setattr(line_blocks, "BLOCK_BYTES", 5000)  # about ten rows
    for threads in (1, 2, 3):
        found = solved(threads)
        assert found.converged
        assert found.iterations == whole.iterations
        peak = whole.values[0].max()
        assert np.abs(found.values[0] - whole.values[0]).max() < 1e-8 * peak
        again = solved(threads)
        assert again.values.tobytes() == found.values.tobytes()


def test_a_run_on_two_threads_gives_the_same_bits_each_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(line_blocks, "BLOCK_BYTES", 5000)
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
