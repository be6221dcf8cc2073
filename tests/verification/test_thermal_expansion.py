"""Layers that expand under a temperature: their growth adds to the approach.

A plate that is held laterally, free across, and heated has the strain (1 + ν)/(1 - ν) α ΔT across
it (Timoshenko & Goodier 1951, Theory of Elasticity: Hooke's law with the strain α ΔT).
"""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.problem.expansion import expansion_ratios, thickening_of
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.meshing.mesh_choice import choose_mesh

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

BALL, GRID = vc.Sphere(0.02), vc.Grid((24, 24), (5e-3, 5e-3))
SHIFT = vc.WLF(293.15, 8.86, 101.6)
CREEPING = vc.Material(vc.Zener(1e6, 3e5, 1e6), 0.45, shift=SHIFT)
ISOTHERMAL = vc.Material(vc.Zener(1e6, 3e5, 1e6), 0.45)
ALPHA, COLD, THICKNESS = 1.8e-4, 296.15, 2e-3
HEATED = {"expansion": ALPHA, "expansion_from": COLD}
DAY = vc.TemperatureHistory([0.0, 2.0, 4.0], [COLD, COLD + 20, COLD + 7])
RATIO = 1.45 / 0.55
TIMES = np.linspace(0.0, 6.0, 7)


def on_rigid(material, bonded=True, **heated):
    return vc.Layered([vc.Layer(THICKNESS, material, **heated)], base="rigid", bonded=bonded)


def run(material, load, temperature=None, **others):
    options = {"errors": False, "tolerance": 1e-11, "fields": "none"} | others
    return vc.simulate(BALL, material, load, GRID, TIMES, temperature=temperature, **options)


@pytest.mark.parametrize("bonded", [True, False])
def test_clamped_layer_that_is_heated_is_pressed_as_by_a_growing_approach(bonded):
    hot = run(on_rigid(CREEPING, bonded, **HEATED), vc.step(approach=2e-5), DAY)
    growth = ALPHA * THICKNESS * (DAY.temperature - COLD) * (RATIO if bonded else 1.0)
    grown = vc.ApproachHistory(DAY.times, 2e-5 + growth)
    expected = run(on_rigid(CREEPING, bonded), grown, DAY)
    for name in ("force", "contact_area", "peak_pressure", "work"):
        np.testing.assert_allclose(hot[name], expected[name], rtol=1e-10)
    np.testing.assert_allclose(hot.approach, 2e-5, rtol=1e-12)
    np.testing.assert_allclose(hot.thickening, np.interp(TIMES, DAY.times, growth), atol=1e-18)
    rigid = run(on_rigid(CREEPING, bonded), vc.step(approach=2e-5), DAY)
    assert float(hot.force[2]) > 1.2 * float(rigid.force[2])  # tight when hot


def test_elastic_layer_needs_no_clock_and_a_constant_temperature_is_an_offset():
    rubber = vc.Material(vc.Elastic(1e6), 0.45)
    growth = RATIO * ALPHA * THICKNESS * 15
    hot = run(on_rigid(rubber, **HEATED), vc.step(approach=2e-5), COLD + 15)
    expected = run(on_rigid(rubber), vc.step(approach=2e-5 + growth))
    np.testing.assert_allclose(hot.force, expected.force, rtol=1e-10)
    varying = run(on_rigid(rubber, **HEATED), vc.step(approach=2e-5), DAY)
    assert varying.force[-1] < varying.force[2] > varying.force[0]


def test_force_only_lifts_the_body():
    hot = run(on_rigid(CREEPING, **HEATED), vc.ramp(1.0, 3.0), DAY)
    cold = run(on_rigid(CREEPING), vc.ramp(1.0, 3.0), DAY)
    np.testing.assert_allclose(hot.peak_pressure, cold.peak_pressure, rtol=1e-9)
    np.testing.assert_allclose(hot.approach, cold.approach - hot.thickening, rtol=1e-9)


def test_growth_of_both_bodies_and_of_all_layers_adds():
    sleeve, cover = vc.Material(vc.Elastic(5e6), 0.3), vc.Material(vc.Elastic(1e6), 0.45)
    roll = vc.Layered(
        [
            vc.Layer(1e-3, cover, **HEATED),
            vc.Layer(3e-3, sleeve, expansion=5e-5, expansion_from=280.0),
            vc.Layer(1e-3, cover),
        ],
        base="rigid",
    )
    growth = thickening_of((roll, on_rigid(cover, bonded=False, **HEATED)), DAY)
    expected = ALPHA * 20 * (1e-3 * RATIO + THICKNESS) + 1.3 / 0.7 * 5e-5 * 3e-3 * (COLD + 20 - 280)
    assert float(growth.at(2.0)) == close_to(expected, rel=1e-12)


def test_laterally_held_growth_follows_hookes_law_with_an_elastic_bulk():
    # K and G of ν before and after relaxation.
    bulk = 2e9
    law = vc.Zener(1e9, 1e9, 1e9)  # G from 1 GPa to 0.5 GPa
    found = expansion_ratios(vc.Material(law, bulk_modulus=bulk))
    for ratio, shear in zip(found, (1e9, 0.5e9), strict=True):
        nu = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))
        assert ratio == close_to((1 + nu) / (1 - nu), rel=1e-9)
    body = on_rigid(vc.Material(law, bulk_modulus=bulk, shift=SHIFT), **HEATED)
    with pytest.warns(vc.AccuracyWarning, match="after all relaxation, up to 25% more"):
        run(body, vc.step(approach=2e-5), DAY, tolerance=1e-6)


def test_contact_that_begins_as_it_becomes_hot_is_met_by_a_step():
    # Apart by 5 um at first; touching where the growth is 5 um.
    hot = run(on_rigid(CREEPING, **HEATED), vc.step(approach=-5e-6), DAY)
    assert hot.force[0] == 0 < hot.force[2]
    problem = Problem(
        BALL, on_rigid(CREEPING, **HEATED), vc.step(approach=-5e-6), temperature=DAY, times=TIMES
    )
    rate = RATIO * ALPHA * THICKNESS * 10.0
    np.testing.assert_allclose(problem.contact_load.touches, [5e-6 / rate], rtol=1e-9)
    assert problem.contact_load.touches[0] in [step.time for step in problem.planned_steps]


def test_automatic_grid_holds_the_contact_when_it_is_hot():
    # The approach determines the size also of an elastic contact, which is quicker to plan.
    rubber, load = vc.Material(vc.Elastic(1e6), 0.45), vc.step(approach=1e-6)
    given = Problem(BALL, on_rigid(rubber, **HEATED), load, temperature=DAY, times=TIMES)
    growth = RATIO * ALPHA * THICKNESS * 20
    grown = vc.step(approach=1e-6 + growth)
    same = Problem(BALL, on_rigid(rubber), grown, temperature=DAY, times=TIMES)
    sizes = [choose_mesh(each, 6.0).grid.size for each in (given, same)]
    np.testing.assert_allclose(*sizes, rtol=1e-9)


def test_program_holds_the_approach_that_it_has_come_to_while_the_layer_grows():
    body = on_rigid(CREEPING, **HEATED)
    options = {"temperature": DAY, "errors": False, "tolerance": 1e-9}
    program = vc.LoadProgram("move at 20 um/s until force reaches 0.05 N; hold height for 2 s")
    found = vc.simulate(BALL, body, program, GRID, vc.uniform_times(8.0, 16), **options)
    met = found.attrs["event_times"][0]
    held = vc.ApproachHistory([0.0, met, met + 2.0], [0.0, 20e-6 * met, 20e-6 * met])
    expected = vc.simulate(BALL, body, held, GRID, found.time.values, **options)
    np.testing.assert_allclose(found.force, expected.force, rtol=1e-6)
    np.testing.assert_allclose(found.approach[2:], 20e-6 * met, rtol=1e-6)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"expansion": ALPHA}, "expansion is given without expansion_from"),
        ({"expansion_from": COLD}, "expansion_from is given without expansion"),
        ({"expansion": 180.0, "expansion_from": COLD}, "at most 0.01, got 180"),
        ({"expansion": ALPHA, "expansion_from": -3.0}, "expansion_from must be"),
        ({"expansion": "soft", "expansion_from": COLD}, "expansion must be"),
    ],
)
def test_expansion_of_a_layer_is_checked(keys, message):
    with pytest.raises(ValueError, match=message):
        vc.Layer(THICKNESS, ISOTHERMAL, **keys)


def test_expansion_without_a_temperature_is_refused():
    with pytest.raises(ValueError, match="temperature: a layer has a thermal expansion"):
        run(on_rigid(ISOTHERMAL, **HEATED), vc.step(approach=2e-5))


def test_layers_that_slide_together_expand_alike():
    pair = [vc.Layer(1e-3, ISOTHERMAL, **HEATED), vc.Layer(1e-3, ISOTHERMAL)]
    body = vc.Layered(pair, base="rigid", bonded=(True, False))
    with pytest.raises(ValueError, match="must expand alike"):
        thickening_of((body,), DAY)


def test_law_without_instant_compliance_cannot_follow_layers_that_are_hot_at_once():
    fluid = vc.Material(vc.PowerLaw(5e-7, 0.3, 1.0), 0.45, shift=SHIFT)
    load = vc.ApproachHistory([0.0, 5.0], [0.0, 1e-5])
    warm = vc.TemperatureHistory([0.0, 5.0], [COLD + 10, COLD + 20])
    with pytest.raises(ValueError, match="temperature: layers that have expanded press at once"):
        run(on_rigid(fluid, **HEATED), load, warm)
