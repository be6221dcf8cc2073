"""Statements about an adhesive contact: Tabor number, zone, tail, and data of laws."""

import math
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads.clock import TIME
from viscontact.mechanics.problem.problem import DataTimes
from viscontact.mechanics.problem.problem_from_arguments import contact_problem
from viscontact.mechanics.state import Outcome
from viscontact.reference import tabor_number
from viscontact.runs.expected_warnings import predicted_warnings
from viscontact.runs.over_time import OverTime
from viscontact.simulation.checks.adhesive_limits import (
    effective_radius,
    front_warnings,
    tabor_numbers,
)
from viscontact.simulation.transient.setup import prepare_run
from viscontact.simulation.transient.zone_passage import ZonePassage

RADIUS, WORK = 1e-3, 0.05
GEL = vc.Material(vc.Elastic(0.25e6), poisson_ratio=0.5)  # contact compliance 1/MPa
CREEPING = vc.Material(vc.Zener(2.5e6, 2.5e6 / 9, 2.5e6 / 9), poisson_ratio=0.5)  # relaxes to GEL
LENGTH = np.cbrt(3 * np.pi / 4 * WORK * RADIUS**2 * 1e-6)


def setup_of(reach, material=GEL, size=6.0, **given):
    arguments = {
        "indenter": vc.Paraboloid(RADIUS, RADIUS),
        "material": material,
        "load": vc.ApproachHistory([0.0, 100.0], [-1e-5, 1e-6]),
        "grid": vc.Grid((64, 64), (size * LENGTH, size * LENGTH)),
        "times": [0.0, 100.0],
        "adhesion": vc.Adhesion(WORK, range=reach),
    }
    return prepare_run(contact_problem(**arguments | given))


def rows(setup):
    return dict(OverTime(setup, errors=False).course())


RANGE = np.cbrt(RADIUS * (WORK * 1e-6) ** 2)  # a Tabor number of 1


@pytest.mark.parametrize(
    ("tabor", "limit"), [(0.05, "DMT's limit applies"), (0.5, "between DMT's limit")]
)
def test_check_names_the_tabor_number_and_the_limit_that_applies(tabor, limit):
    found = rows(setup_of(RANGE / tabor, size=40.0))
    assert found["Tabor number"].startswith(f"{tabor:.2g}"[:4])
    assert limit in found["Tabor number"]
    pull = math.pi * WORK * RADIUS * 1e6
    assert found["pull-off force"] == f"{1.5 * pull:.3g} µN (JKR) to {2 * pull:.3g} µN (DMT)"


def test_short_range_is_named_as_the_limit_of_johnson_kendall_and_roberts():
    assert "JKR's limit applies" in rows(setup_of(RANGE / 5, size=1.0))["Tabor number"]


def test_tabor_numbers_of_a_creeping_sphere_are_those_of_both_its_compliances():
    setup = setup_of(RANGE, CREEPING)
    at_once, at_end = tabor_numbers(setup.law, setup.problem)
    for number, compliance in ((at_once, 1e-7), (at_end, 1e-6)):
        assert number == close_to(tabor_number(RADIUS, compliance, WORK, RANGE), rel=1e-6)
    assert "at once" in rows(setup)["Tabor number"]


def test_radius_is_the_geometric_mean_and_none_of_a_body_that_is_not_round():
    assert effective_radius(vc.Paraboloid(1.0, 4.0)) == close_to(2.0, rel=1e-12)
    assert effective_radius(vc.Cone(0.3)) is None


def test_check_names_the_cells_across_the_cohesive_zone():
    # π w/(8 J σ0²) (Maugis 1992).
    width = math.pi / 8 * RANGE**2 / (1e-6 * WORK)
    found = rows(setup_of(RANGE))["cohesive zone"]
    assert found == f"{width * 1e6:.3g} µm wide, {width / (6 * LENGTH / 64):.2g} cells"


def test_check_warns_of_an_attraction_that_reaches_the_edge_of_the_grid():
    near, far = setup_of(RANGE, size=4.0), setup_of(RANGE, size=12.0)
    assert "enlarge the grid" in predicted_warnings(near, None, 1e-6)["tail"]
    assert "tail" not in predicted_warnings(far, None, 1e-6)
    # The traction at the edge of the grid under a sphere that touches the flat surface.
    edge = (2 * LENGTH * 63 / 64) ** 2 / (2 * RADIUS)
    assert f"is {math.exp(-edge / RANGE):.2g} of" in predicted_warnings(near, None, 1e-6)["tail"]


def test_check_does_not_warn_of_long_given_steps_as_the_run_takes_short_ones():
    load = vc.ForceHistory([0.0, 100.0], [0.0, 1e-3])
    setup = setup_of(RANGE, CREEPING, load=load)
    assert not {"touch", "release", "step"} & set(predicted_warnings(setup, None, 1e-6))


def test_time_of_the_passage_is_that_of_a_ring_of_the_width_of_the_zone():
    # A contact of radius 1 that is lost in 5 s passes a zone of a tenth of it in half a second.
    passage, touching = ZonePassage(), SimpleNamespace(outcome=Outcome.CONVERGED)
    touching.contact_area, touching.tensile_area, touching.time = math.pi, 0.2 * math.pi, 1.0
    assert passage.after(touching) == math.inf
    apart = SimpleNamespace(outcome=Outcome.NO_CONTACT, time=6.0)
    assert passage.after(apart) == close_to(0.5, rel=1e-12)
    assert passage.after(apart) == math.inf
    measured = DataTimes(0.6, math.inf, TIME, "material")
    assert "in about 500 ms, before 600 ms" in front_warnings(0.5, [measured])["front"]
    assert front_warnings(0.7, [measured]) == front_warnings(math.inf, [measured]) == {}


@pytest.mark.slow
@pytest.mark.parametrize(("first", "warns"), [(1e-3, False), (5.0, True)])
def test_edge_that_passes_the_zone_before_the_data_begin_is_warned_of(first, warns):
    times = np.geomspace(first, 1e4, 30)
    creep = 2e-6 * (0.3 + 0.7 * times / (times + 30.0))
    law = vc.TabulatedCreep(times, creep)
    material = vc.Material(law, poisson_ratio=0.5)
    depth = LENGTH**2 / RADIUS
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        vc.simulate(
            *(vc.Paraboloid(RADIUS, RADIUS), material),
            vc.ApproachHistory([0.0, 10.0, 20.0], [0.0, depth, -4 * depth]),
            *(vc.Grid((24, 24), (6 * LENGTH, 6 * LENGTH)), [0.0, 10.0, 20.0]),
            adhesion=vc.Adhesion(WORK, range=RANGE),
            errors=False,
        )
    found = [str(each.message) for each in caught if "width of the cohesive zone" in str(each)]
    assert len(found) == warns


def test_steady_motion_refuses_adhesion_by_name():
    with pytest.raises(ValueError, match=r"adhesion: it is not supported in steady motion; leave"):
        vc.steady(
            *(vc.Paraboloid(RADIUS, RADIUS), CREEPING, vc.step(1e-3), 1e-3),
            adhesion=vc.Adhesion(WORK, range=RANGE),
        )
