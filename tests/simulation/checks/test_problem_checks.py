"""What a run is refused for before its first step, and what it is let through with."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.optimize import linprog

import viscontact as vc
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.checks.load_support import LoadSupport
from viscontact.simulation.transient.setup import prepare_run

BALL = vc.Sphere(1e-3)
GRID = vc.Grid((32, 32), (0.4e-3, 0.4e-3))
POWER = vc.Material(vc.PowerLaw(1e-6, exponent=0.3, reference_time=1.0), 0.5)
ZENER = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5)


@pytest.mark.parametrize(
    "load",
    [
        vc.ApproachHistory([0, 1], [0, 1e-6], tilt_x=0.02),
        vc.harmonic(approach=0.0, amplitude=1e-6, period=1.0, cycles=1, tilt_x=0.02),
    ],
)
def test_a_tilt_that_presses_from_the_start_asks_for_an_instant_compliance(load):
    # x²/2R = tilt x: the tilted ball reaches tilt² R/2 = 0.2 um into the surface at approach 0.
    with pytest.raises(ValueError, match=r"tilted by 20 mrad along x .* begin with a smaller"):
        prepare_run(Problem(BALL, POWER, load, GRID, [0.0, 1.0]))
    prepare_run(Problem(BALL, ZENER, load, GRID, [0.0, 1.0]))


def test_a_tilted_stage_may_start_clear_of_a_law_without_instant_compliance():
    # Lifted by more than tilt² R/2 = 0.2 um the tilted ball does not touch.
    load = vc.ApproachHistory([0, 1], [-0.3e-6, 1e-6], tilt_x=0.02)
    prepare_run(Problem(BALL, POWER, load, GRID, [0.0, 1.0]))


def test_a_swing_from_zero_to_zero_is_refused_where_its_crest_lies_outside_the_body():
    swing = vc.harmonic(
        mean=5e-4, amplitude=5e-4, period=1.0, cycles=1, phase=-math.pi / 2, eccentricity_x=5e-3
    )
    assert swing.level_at([0.0, 1.0]).tolist() == [0.0, 0.0]
    with pytest.raises(ValueError, match="eccentricity"):
        prepare_run(Problem(BALL, ZENER, swing, GRID, [0.0, 1.0]))


def test_a_run_that_chooses_its_steps_counts_on_remembering_many():
    # Five hundred steps and the first jump, each with a pressure and a deflection.
    run = prepare_run(Problem(BALL, POWER, vc.ramp(1e-3, 1.0), GRID, vc.adaptive_times(10.0, 1e-3)))
    assert run.hereditary.fields_kept == 501


@given(
    solid=arrays(bool, st.tuples(st.integers(4, 9), st.integers(4, 9))),
    place=st.tuples(st.integers(0, 32), st.integers(0, 32)),
)
def test_a_force_is_let_through_just_where_some_pressure_balances_it(solid, place):
    # Pressures p >= 0 on these cells with the sums of p, p x and p y that are wanted, in cells: a
    # linear program. Quarters of a cell lie on the hull's rim, or well off it.
    assume(solid.any())
    cells = np.array(np.nonzero(solid))
    wanted = np.array(place) / 4
    sums = np.vstack([np.ones(cells.shape[1]), cells])
    balanced = linprog(np.zeros(cells.shape[1]), A_eq=sums, b_eq=[1.0, *wanted]).status == 0
    grid = vc.Grid(solid.shape, (3.0 * solid.shape[0], 0.2 * solid.shape[1]))
    x, y = grid.x[0] + 3.0 * wanted[0], grid.y[0] + 0.2 * wanted[1]
    try:
        LoadSupport(solid, grid).refuse_outside((float(x), float(y)), 0.0)
    except ValueError:
        assert not balanced
    else:
        assert balanced


def test_a_centred_force_outside_the_body_is_refused():
    corner = np.tri(8, k=-1, dtype=bool)[:, ::-1]  # one side of a diagonal
    reach = LoadSupport(corner, vc.Grid((8, 8), (1.0, 1.0)))
    with pytest.raises(ValueError, match="outside the hull of what can touch"):
        reach.refuse_outside((0.0, 0.0), 0.0)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_a_radius_that_looks_like_one_in_millimetres_warns() -> None:
    rubber, load = vc.Material(vc.Elastic(1e6), 0.5), vc.step(1.0)
    for body in (vc.Sphere(10), vc.Roller(20.0, 0.01)):
        with pytest.warns(
            UserWarning, match=r"lengths are in metres in Python; write 0\.0[12] for"
        ):
            vc.simulate(body, rubber, load, vc.Grid((32, 32), (0.2, 0.2)), [0.0], errors=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        grid = vc.Grid((16, 16), (0.05, 0.05))
        vc.simulate(vc.Sphere(1.0), rubber, load, grid, [0.0], errors=False)
