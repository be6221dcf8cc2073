"""Error bars hold where coarser runs share steps, history or edges with the run."""

import math

import numpy as np
import pytest

import viscontact as vc
from verification.families.rollers import roller_problem, stored_values
from viscontact import reference

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

BALL = vc.Paraboloid(0.01, 0.01)


def test_bars_of_a_load_table_as_dense_as_the_steps_hold_the_time_error() -> None:
    """Rods (Lee & Radok 1960, Ting 1966), with the jerky approach of a table of 12 rows."""
    times = np.linspace(0.0, 2.0, 13)
    approach = 1e-5 * np.sin(np.pi * times / 2) ** 2
    approach[-1] = 0.0
    law = vc.PowerLaw(2e-9, 0.5, 1.0)
    material = vc.Material(law, poisson_ratio=0.5)
    load = vc.ApproachHistory(times, approach)
    found = vc.simulate(BALL, material, load, vc.Grid((48, 48), (0.9e-3, 0.9e-3)), times)
    exact = reference.press_axisymmetric(
        reference.SphereProfile(0.01),
        times,
        approach=approach,
        creep_compliance=material.contact_compliance(),
        elements=400,
        substeps=40,
    )
    wanted = np.interp(times[1:9], exact.times, exact.force)
    error = np.abs(found.force.values[1:9] - wanted)
    assert error.max() > 0.3  # the steps are too long: 0.36 N of 6.4 N
    assert (error < found.force_error.values[1:9]).all()
    assert (found.force_error.values[1:9] < 1.5).all()


@pytest.mark.parametrize(
    "cells",
    [47, pytest.param(64, marks=pytest.mark.slow), pytest.param(90, marks=pytest.mark.slow)],
)
def test_bars_of_a_punchs_dent_keep_the_error_of_its_edge(cells: int) -> None:
    """Boltzmann: the dent of a round flat punch is F * J / (2a), also after the force is gone."""
    radius, size = 1e-3, 2.4e-3
    material = vc.Material(vc.RelaxationSeries(125e6, [375e6], [1.0]), poisson_ratio=0.5)
    load = vc.ForceHistory([0.0, 1.0, 2.0, 3.0], [0.0, 100.0, 100.0, 0.0])
    times = np.linspace(0.0, 8.0, 41)
    grid = vc.Grid((cells, cells), (size, size))
    found = vc.simulate(vc.FlatPunch(radius), material, load, grid, times).sel(time=slice(4, 8))
    compliance = material.contact_compliance()
    exact = np.zeros(found.time.size)
    for begin, rate in ((0.0, 100.0), (2.0, -100.0)):
        middles = begin + (np.arange(4000) + 0.5) / 4000
        exact += rate * compliance(found.time.values[:, None] - middles).mean(axis=1)
    exact /= 2 * radius
    error = np.abs(found.approach.values - exact)
    assert (error < found.approach_error.values).all()
    assert (found.approach_error.values < 0.05 * exact).all()


def test_bars_of_a_sharp_ended_roller_are_not_far_above_its_error() -> None:
    """The end lies at the same part of a cell on the coarser grids; against four times the cells.

    With the end anywhere within a cell, the bars were 5 % (approach) and 20 % (eccentricity).
    """
    roller, steel = vc.Roller(5e-3, 5e-3), vc.Material(vc.Elastic(7e8), poisson_ratio=0.3)
    load, size = vc.step(500.0, tilt_x=2e-4, tilt_y=0.0), (1.3253e-2, 1.2572e-3)
    coarse, fine = (
        vc.simulate(roller, steel, load, vc.Grid((80 * k, 40 * k), size), [0.0], errors=k == 1)
        for k in (1, 4)
    )
    for name, limit in (("approach", 0.03), ("eccentricity_x", 0.15)):
        value, bar = float(coarse[name][0]), float(coarse[f"{name}_error"][0])
        assert abs(value - float(fine[name][0])) < bar < limit * value


@pytest.mark.parametrize("along", [28.3, pytest.param(33.1, marks=pytest.mark.slow)])
@pytest.mark.parametrize("index", [10, 4, 6, 21], ids=lambda each: roller_problem(each).name)
def test_bars_hold_the_outline_of_contacts_near_the_ends_of_a_roller(
    index: int, along: float
) -> None:
    """Against a ladder of grids.

    The contact ends half a cell before a logarithmic end, where all grids see it in the last cell,
    and becomes wider towards a sharp one: the width on the finest grid was 10 % larger.
    """
    problem, ladder = roller_problem(index), stored_values()[str(index)]
    cells = (2 * problem.half_length / along, 2 * problem.half_width / 14)
    shape = math.ceil(1.25 * along), math.ceil(1.9 * 14)
    grid = vc.Grid(shape, (shape[0] * cells[0], shape[1] * cells[1]))
    found = vc.simulate(problem.indenter, problem.material, problem.load, grid, [0.0])
    names = ("contact_area", "contact_length", "mean_pressure")
    for name in (*names, "contact_width") if "sharp" in problem.name else names:
        exact, bar = ladder[name][0][0], float(found[f"{name}_error"][0])
        assert abs(float(found[name][0]) - exact) <= bar + 1e-9 * exact
        assert bar < 0.25 * exact
