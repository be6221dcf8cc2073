"""Cells across contacts that are turned against the grid."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.accuracy.rim_cells import cells_of_breadth, in_several_strips
from viscontact.simulation.transient.setup import prepare_run


@pytest.mark.parametrize("angle", [0.0, 0.5, math.pi / 4])
def test_breadth_of_a_turned_ellipse_is_its_shorter_axis(angle: float) -> None:
    """Extents of a turned ellipse: 2 sqrt(a² cos² + b² sin²), 2 sqrt(a² sin² + b² cos²)."""
    long, short, cell = 40.0, 5.0, 0.02
    elastic = vc.Material(vc.Elastic(1e6), 0.5)
    grid = vc.Grid((50, 50), (50 * cell, 50 * cell))
    run = prepare_run(Problem(vc.Paraboloid(1.0, 1.0), elastic, vc.step(1.0), grid, [0.0]))
    turned = np.array([math.cos(angle), math.sin(angle)])
    extents = [math.hypot(*(np.array([long, short]) * part)) for part in (turned, turned[::-1])]
    history = {
        "contact_length": np.array([cell * extents[0]]),
        "contact_width": np.array([cell * extents[1]]),
        "contact_area": np.array([math.pi / 4 * long * short * cell**2]),
        "cells_across": np.array([min(extents)]),
    }
    assert cells_of_breadth(run, history)[0] == close_to(short, rel=1e-6)


def test_several_strips_have_gaps_and_reach_through_one_period() -> None:
    """Waves along x on periods of 4 by 1: apart, spots, one strip, two, and the whole surface."""
    elastic, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((16, 4), (4.0, 1.0), periodic=True)
    waves = vc.Waviness(1e-3, wavelength_x=2.0)
    run = prepare_run(Problem(waves, elastic, vc.step(1.0), grid, [0.0]))
    history = {
        "contact_length": np.array([0.0, 0.5, 1.0, 3.0, 4.0]),
        "contact_width": np.array([0.0, 0.75, 1.0, 1.0, 1.0]),
        "contact_area": np.array([0.0, 0.3, 1.0, 2.0, 4.0]),
    }
    assert in_several_strips(run, history).tolist() == [False, False, False, True, False]


@pytest.mark.filterwarnings("ignore:the grid is periodic along x only")
def test_extents_along_lines_of_a_line_contact_are_exact() -> None:
    rubber = vc.Material(vc.Elastic(1e6), 0.5)
    grid = vc.Grid((4, 64), (10e-3, 4e-3), periodic=(True, False))
    body = vc.Paraboloid(math.inf, 20e-3)
    ds = vc.simulate(body, rubber, vc.step(1.0), grid, [0.0, 1.0])
    assert ds["contact_length"].values == close_to([10e-3] * 2, rel=1e-12)
    assert (ds["contact_length_error"] == 0).all()
    assert (ds["contact_width_error"] > 0).all()
