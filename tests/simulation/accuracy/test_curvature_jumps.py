"""Jumps of a body's curvature at the rim of its contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import ArrayLike

import viscontact as vc
from closeness import close_to
from viscontact.backend.arrays import Floats
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.accuracy.curvature_jumps import curvature_jumps
from viscontact.simulation.transient.setup import RunSetup, prepare_run

CELLS = 41


@dataclass(frozen=True)
class RoundedCone(vc.Indenter):
    """A paraboloid up to a radius, and the cone that is tangent to it beyond."""

    radius: float  # of the paraboloid, in cells as all lengths here

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        rho = np.hypot(x, y)
        return np.where(rho < self.radius, rho**2 / 2, self.radius * (rho - self.radius / 2))


@dataclass(frozen=True)
class PowerBody(vc.Indenter):
    """A body r^n."""

    exponent: float

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        return np.asarray(np.hypot(x, y) ** self.exponent)


def run_of(body: vc.Indenter) -> RunSetup:
    elastic, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((CELLS, CELLS), (CELLS, CELLS))
    return prepare_run(Problem(body, elastic, vc.step(1.0), grid, [0.0]))


def jumps_at(body: vc.Indenter, radii: list[float]) -> list[float]:
    extents = 2 * np.array(radii)
    history = {"contact_length": extents, "contact_width": extents, "time": np.zeros(len(radii))}
    return [float(jump) for jump in curvature_jumps(run_of(body), history)]


def test_curvature_of_a_rounded_cone_jumps_where_the_tip_ends() -> None:
    """The second derivative along a line is 1 on the tip and 0 on the cone: all of it is lost."""
    assert jumps_at(RoundedCone(9.0), [5.0, 9.0]) == [close_to(0.0, abs=1e-9), close_to(1.0)]


@pytest.mark.parametrize("exponent", [2.0, 3.0, 6.0])
def test_curvature_of_a_power_does_not_jump(exponent: float) -> None:
    assert max(jumps_at(PowerBody(exponent), [6.0, 9.0, 15.0])) < 0.2


def test_small_contacts_and_those_at_the_border_have_no_known_jump() -> None:
    assert jumps_at(RoundedCone(9.0), [0.0, 1.0, 20.5]) == [0.0, 0.0, 0.0]
