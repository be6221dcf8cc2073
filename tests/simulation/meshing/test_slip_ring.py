"""Automatic grids have cells for the ring that slips under friction."""

import numpy as np
import pytest

import viscontact as vc
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.meshing.mesh_choice import choose_mesh

FORCE, COEFFICIENT = 10.0, 0.3
CARRIED = COEFFICIENT * FORCE


def cells(tangential=None, tolerance=0.01) -> int:
    """Cells along x of the grid of a sphere on rubber, pulled from 1 s on."""
    problem = Problem(
        vc.Sphere(0.01),
        vc.Material(vc.Elastic(4e6), 0.5),
        vc.step(FORCE),
        vc.AutomaticGrid(tolerance),
        np.array([0.0, 1.0, 2.0]),
        friction=None if tangential is None else vc.Friction(COEFFICIENT),
        tangential=tangential,
    )
    return choose_mesh(problem, 2.0).grid.shape[0]


def pulled(part: float) -> vc.TangentialHistory:
    return vc.TangentialHistory([0, 1, 2], force_x=[0.0, 0.0, part * CARRIED])


def test_the_ring_of_cattaneo_and_mindlin_has_four_cells():
    part, radius = 0.4, (0.75 * FORCE * 0.01 / 16e6) ** (1 / 3)  # 3 F R/(4 E*)
    ds = vc.simulate(
        vc.Sphere(0.01),
        vc.Material(vc.Elastic(4e6), 0.5),
        vc.step(FORCE),
        None,
        [0.0, 1.0, 2.0],
        friction=COEFFICIENT,
        tangential=pulled(part),
        errors=False,
        fields="none",
    )
    ring = radius * (1 - (1 - part) ** (1 / 3))
    assert ring > 3.9 * float(ds.x[1] - ds.x[0])


@pytest.mark.parametrize(
    "tangential",
    [
        vc.tangential_ramp(displacement_x=1e-5, duration=2.0),
        vc.tangential_ramp(torque=3e-4, duration=2.0),
        vc.tangential_harmonic(force_y=CARRIED / 2, period=2.0, cycles=1),
    ],
    ids=["shifted", "turned", "harmonic"],
)
def test_loads_of_any_kind_make_cells_finer(tangential):
    assert cells() < cells(tangential) <= 2.1 * cells()


def test_what_slips_altogether_or_not_at_all_needs_no_finer_cells():
    assert cells(vc.tangential_ramp(displacement_x=1e-2, duration=2.0)) == cells()
    assert cells(vc.tangential_step(force_x=0.0)) == cells()


def test_cells_follow_the_tolerance():
    assert cells(pulled(0.5), 0.005) > cells(pulled(0.5), 0.02)
