"""The benchmark's published algorithm is a yardstick only if it solves the same problem."""

import sys
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
published = pytest.importorskip("published")

MATERIAL = vc.Material(vc.Zener(1e6, 2e6, 1e7), 0.4)
ROLLER, GRID = vc.Roller(1.0, 2.0, 15.0), vc.Grid((40, 30), (6.0, 0.36))
FORCE, ECCENTRICITY, END = 2e4, 0.4, 10.0


def last_published(steps):
    balance = published.Balance(GRID.x, GRID.y, GRID.cell_area, FORCE, (ECCENTRICITY, 0.0))
    gap = np.array(ROLLER.gap(GRID.x[:, None], GRID.y[None, :]))
    convolve = published.PlainConvolution(GRID.shape, GRID.cell_size)
    law, times = MATERIAL.contact_compliance(), vc.uniform_times(END, steps)
    *_, pressure = published.march(gap, law, balance, convolve, times, 1e-10)
    return pressure


@pytest.mark.slow
def test_the_published_rule_tends_to_the_packages_pressure_with_the_step():
    load = vc.step(FORCE, eccentricity_x=ECCENTRICITY)
    times = vc.uniform_times(END, 200)
    *_, state = vc.march(ROLLER, MATERIAL, load, GRID, times, tolerance=1e-9)
    errors = [
        np.linalg.norm(last_published(steps) - state.pressure) / np.linalg.norm(state.pressure)
        for steps in (10, 20, 40)
    ]
    # Of first order in the step, as a rule with constant pressure is.
    assert errors[2] < 0.01
    assert errors[0] / errors[1] == close_to(2.0, rel=0.15)
    assert errors[1] / errors[2] == close_to(2.0, rel=0.15)
