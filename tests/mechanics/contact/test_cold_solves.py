"""A solve from nothing: few directions on any grid, as it starts from coarser ones."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import solve_contact
from viscontact.mechanics.contact.problem import ContactProblem
from viscontact.mechanics.contact.rigid_balance import Constraints

#: Contact compliance 1/E* of all of them [1/Pa].
COMPLIANCE = 1.0


def rough(cells: int) -> NDArray[np.float64]:
    """A self-affine surface of Hurst exponent 0.8 on a slight bow, heights over their period."""
    noise = np.random.default_rng(1).standard_normal((cells, cells))
    waves = np.fft.fftfreq(cells, 1 / cells)
    wave = np.hypot(waves[:, None], waves[None, :])
    spectrum = np.where((wave > 0) & (wave < cells / 8), np.maximum(wave, 4.0) ** -1.8, 0.0)
    heights = np.fft.ifft2(np.fft.fft2(noise) * spectrum).real
    bow = 0.02 * np.add.outer(waves**2, waves**2) / cells**2
    gap = np.fft.fftshift(bow) - 0.002 * heights / heights.std()
    return np.asarray(gap - gap.min())


def posed(kind: str, cells: int) -> tuple[ContactProblem, ContactDomain]:
    """A contact problem of each kind, on so many cells along x."""
    shape, size = (cells, cells), (1.0, 1.0)
    force, offset = 0.01, (0.05, 0.03)
    if kind == "roller":
        shape, size, force, offset = (cells, cells // 4), (60e-3, 4e-3), 3.4e-6, (4.78e-3, 0.0)
    grid = vc.Grid(shape, size)
    x, y = grid.x[:, None], grid.y[None, :]
    if kind == "sphere":
        gap, force, offset = vc.Paraboloid(1.0, 1.0).gap(x, y), 4 / 3 * 0.3**3, (0.0, 0.0)
    elif kind == "roller":
        gap = vc.Roller(5e-3, 9.565e-3, 75e-3).gap(x, y)
    elif kind == "punch":
        gap = vc.FlatPunch(0.3).gap(x, y)
    elif kind == "rough":
        gap, force, offset = rough(cells), 0.002, (0.0, 0.0)
    else:
        part_x, part_y = (8 * x) % 1 - 0.5, (8 * y) % 1 - 0.5
        gap, offset = 0.05 * (part_x**2 + part_y**2) + 0.002 * np.hypot(x, y), (0.02, 0.01)
    support = Constraints((force, force * offset[0], force * offset[1]))
    half_space = ContactDomain(grid)
    return ContactProblem(gap, COMPLIANCE, support, 1e-15), half_space


KINDS = ("sphere", "roller", "punch", "rough", "spots")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    "cells",
    [256, pytest.param(512, marks=pytest.mark.slow), pytest.param(1024, marks=pytest.mark.slow)],
)
def test_thirty_directions_are_enough_to_eight_digits(kind: str, cells: int) -> None:
    problem, half_space = posed(kind, cells)
    found = solve_contact(problem, half_space, tolerance=1e-8)
    assert found.converged
    # Measured at most 16, and 22 on the rough surface of 1024²; without coarser grids 27 and 33.
    assert found.iterations <= (20 if cells < 1024 else 30)


@pytest.mark.parametrize(
    ("kind", "cells"),
    [
        ("rough", 128),
        ("spots", 128),
        *(pytest.param(each, 512, marks=pytest.mark.slow) for each in KINDS),
    ],
)
def test_where_a_solve_starts_does_not_change_its_answer(
    kind: str, cells: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem, half_space = posed(kind, cells)
    nested = solve_contact(problem, half_space, tolerance=1e-9)
    monkeypatch.setattr(ContactDomain, "coarser", lambda self: None)
    direct = solve_contact(problem, half_space, tolerance=1e-9)
    assert (direct.found.pressure != nested.found.pressure).any(), "both began alike"
    peak = direct.found.pressure.max()
    assert np.abs(nested.found.pressure - direct.found.pressure).max() < 1e-6 * peak
    assert nested.found.motion == close_to(direct.found.motion, rel=1e-8, abs=1e-9)


@pytest.mark.parametrize("half", [1.4, 1.6, 3.1])
def test_a_body_of_few_cells_is_solved_for_though_coarser_cells_cannot_hold_it(half: float) -> None:
    # Three or six cells across, with the force off their middle: no coarse cell lies under the
    # first, those under the second cannot bear the moment, those under the third can.
    grid = vc.Grid((128, 128), (128.0, 128.0))
    gap = vc.FlatPunch(half_length=half, half_width=half).gap(
        grid.x[:, None] - 0.5, grid.y[None, :] - 0.5
    )
    problem = ContactProblem(gap, COMPLIANCE, Constraints((1.0, 0.6, 0.5)), 1e-15)
    found = solve_contact(problem, ContactDomain(grid), tolerance=1e-9)
    assert found.converged
    assert found.found.pressure.sum() == close_to(1.0)
