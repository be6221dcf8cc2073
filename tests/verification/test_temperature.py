"""Contacts under a temperature that varies in time, and of a material that ages.

A thermorheologically simple body follows the solutions of its law over the reduced time (Morland &
Lee 1960, Trans. Soc. Rheol. 4, 233).
"""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact import reference
from viscontact.bodies.loads.clock import ReducedTime
from viscontact.mechanics.time_integration.fixed_steps import plan_steps, step_ends

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

BALL, GRID = vc.Sphere(0.01), vc.Grid((40, 40), (4e-3, 4e-3))
WLF, ARRHENIUS = vc.WLF(293.15, 8.86, 101.6), vc.Arrhenius(293.15, 80e3)
TABLE = vc.TabulatedShift([273.15, 293.15, 313.15], [300.0, 1.0, 0.02])
DAY = vc.TemperatureHistory([0.0, 3.0, 10.0, 12.0], [293.15, 313.15, 283.15, 303.15])
LAWS = {
    "zener": vc.Zener(1e6, 3e5, 1e6),
    "burgers": vc.Burgers(1e6, 1e8, 3e5, 1e6),
    "power": vc.PowerLaw(5e-7, 0.3, 1.0, instant=2e-7),
    "fractional": vc.FractionalZener(1e6, 3e5, 2.0, 0.5),
    "table": vc.TabulatedCreep([0.0, 0.1, 1.0, 10.0, 1e3], [5e-7, 7e-7, 1e-6, 2e-6, 3e-6]),
}


def run(material, load, times, temperature=None, **others):
    options = {"errors": False, "tolerance": 1e-11, "fields": "none"} | others
    return vc.simulate(BALL, material, load, GRID, times, temperature=temperature, **options)


@pytest.mark.parametrize("shift", [WLF, ARRHENIUS, TABLE], ids=["wlf", "arrhenius", "table"])
@pytest.mark.parametrize("law", LAWS)
def test_force_that_is_held_acts_as_on_the_law_over_the_reduced_time(law, shift):
    material = vc.Material(LAWS[law], 0.5, shift=shift)
    found = run(material, vc.step(0.1), [0.0, 1.0, 3.0, 8.0, 11.0, 20.0], DAY)
    reduced = ReducedTime(DAY, shift).reduced(found.time.values)
    np.testing.assert_allclose(found.reduced_time, reduced, rtol=1e-12)
    # Under a held force S = J F, at any steps (Lee & Radok 1960).
    plain = vc.Material(vc.Elastic(1e6), 0.5)
    expected = [
        run(plain, vc.step(0.1 * material.law(t) / plain.law(0.0)), [0.0]).approach[0]
        for t in reduced
    ]
    np.testing.assert_allclose(found.approach, expected, rtol=1e-8)


@pytest.mark.parametrize("law", ["zener", "power"])
def test_march_is_that_of_the_law_in_steps_of_the_reduced_time(law):
    material = vc.Material(LAWS[law], 0.5, shift=WLF)
    clock, times = ReducedTime(DAY, WLF), np.linspace(0.0, 2.0, 9)
    found = run(material, vc.step(0.1), times, DAY)
    steps = np.unique(step_ends(plan_steps(times, vc.step(0.1), clocks=(clock,))))
    on_clock = run(vc.Material(LAWS[law], 0.5), vc.step(0.1), clock.reduced(steps))
    on_clock = on_clock.isel(time=np.searchsorted(steps, times))
    for name in ("approach", "peak_pressure", "contact_area"):
        np.testing.assert_allclose(found[name].values, on_clock[name].values, rtol=1e-9)


def test_temperature_that_is_constant_so_far_gives_the_slowed_law():
    material, warm = vc.Material(LAWS["zener"], 0.5, shift=WLF), 303.15
    load, times = vc.ramp(0.1, 5.0), vc.uniform_times(20.0, 20)
    later = vc.TemperatureHistory([0.0, 100.0, 200.0], [warm, warm, warm + 10])
    slowed = run(material.at(warm), load, times)
    for temperature in (later, warm):
        found = run(material, load, times, temperature)
        for name in ("approach", "peak_pressure", "contact_area", "work"):
            np.testing.assert_allclose(found[name][1:], slowed[name][1:], rtol=1e-12)


def test_error_of_the_steps_falls_with_their_square_while_it_cools():
    material = vc.Material(vc.Zener(1e6, 2e5, 4e6), 0.5, shift=WLF)
    cooling = vc.TemperatureHistory([0.0, 10.0], [303.15, 293.15])
    # An approach that grows with the root of S: ∫ J(ξ(t) - ξ(t')) dF, by fine quadrature.
    clock, fine = ReducedTime(cooling, WLF), np.linspace(0.0, 10.0, 20001)
    middles = (fine[1:] + fine[:-1]) / 2
    ages = float(clock.reduced(np.array(10.0))) - clock.reduced(middles)
    compliance = float(np.mean(material.law(ages)))
    plain = vc.Material(vc.Elastic(1e6), 0.5)
    exact = float(run(plain, vc.step(0.1 * compliance / plain.law(0.0)), [0.0]).approach[0])
    errors = [
        float(run(material, vc.ramp(0.1, 10.0), vc.uniform_times(10.0, n), cooling).approach[-1])
        / exact
        - 1
        for n in (10, 20, 40)
    ]
    assert 3.5 < errors[0] / errors[1] < 4.5
    assert 3.5 < errors[1] / errors[2] < 4.5
    assert abs(errors[2]) < 3e-4


def test_fast_swings_act_as_their_mean_rate():
    material, period = vc.Material(LAWS["zener"], 0.5, shift=ARRHENIUS), 0.05
    points = np.arange(0.0, 1.0 + period / 4, period / 2)
    swings = vc.TemperatureHistory(points, 293.15 + 8.0 * (-1.0) ** np.arange(points.size))
    fast = run(material, vc.ramp(0.1, 1.0), np.arange(0.0, 1.0, period / 8), swings)
    clock = ReducedTime(swings, ARRHENIUS)
    rate = float(clock.reduced(np.array(1.0))) / 1.0
    mean = run(vc.Material(material.law.slowed(1 / rate), 0.5), vc.ramp(0.1, 1.0), fast.time.values)
    whole = slice(8, None, 8)  # at the ends of periods
    np.testing.assert_allclose(fast.approach[whole], mean.approach[whole], rtol=1e-3)


def test_two_bodies_have_clocks_of_their_own():
    below = vc.Material(LAWS["zener"], 0.5, shift=WLF)
    above = vc.Material(vc.Zener(2e6, 5e5, 4e6), 0.4, shift=ARRHENIUS)
    times = vc.uniform_times(20.0, 10)
    found = run(below, vc.step(0.1), times, DAY, indenter_material=above)
    total = below.contact_compliance()(found.reduced_time.values)
    total = total + above.contact_compliance()(found.reduced_time_indenter.values)
    plain = vc.Material(vc.Elastic(1e6), 0.5)
    own = plain.contact_compliance()(0.0)
    expected = [run(plain, vc.step(0.1 * each / own), [0.0]).approach[0] for each in total]
    np.testing.assert_allclose(found.approach, expected, rtol=1e-8)
    # A clamped stage: the force at once is that of both instant compliances.
    held = run(below, vc.step(approach=1e-4), times, DAY, indenter_material=above)
    instant = total[0]
    hertz = reference.hertz_sphere(1.0, 0.01, 1 / instant)
    assert held.force[0] == close_to((1e-4 / hertz.approach) ** 1.5, rel=5e-3)


def test_elastic_indenter_has_no_clock():
    below, steel = vc.Material(LAWS["zener"], 0.5, shift=WLF), vc.Material(vc.Elastic(1e7), 0.3)
    found = run(below, vc.step(0.1), [0.0, 5.0], DAY, indenter_material=steel)
    assert "reduced_time_indenter" not in found
    total = below.contact_compliance()(found.reduced_time.values[-1])
    total += steel.contact_compliance()(0.0)
    hertz = reference.hertz_sphere(0.1, 0.01, 1 / total)
    assert found.approach[-1] == close_to(hertz.approach, rel=5e-3)


def test_materials_of_one_clock_are_one_term():
    both = vc.Material(LAWS["zener"], 0.5, shift=WLF)
    found = run(both, vc.ramp(0.1, 2.0), [0.0, 2.0, 5.0], DAY, indenter_material=both)
    half = vc.Material(vc.Zener(5e5, 1.5e5, 5e5), 0.5, shift=WLF)
    softer = run(half, vc.ramp(0.1, 2.0), [0.0, 2.0, 5.0], DAY)
    np.testing.assert_allclose(found.approach, softer.approach, rtol=1e-12)


def test_ageing_slows_creep_as_struiks_effective_time():
    # Struik 1978: λ = t_e/(1 - µ) ((1 + t/t_e)^(1 - µ) - 1).
    material = vc.Material(LAWS["power"], 0.4, ageing=vc.Ageing(3600.0, 0.8))
    times = np.array([0.0, 1e3, 1e5, 3.156e7])
    found = run(material, vc.step(0.1), times)
    effective = 3600.0 / 0.2 * ((1 + times / 3600.0) ** 0.2 - 1)
    np.testing.assert_allclose(found.reduced_time, effective, rtol=1e-10)
    young = run(vc.Material(LAWS["power"], 0.4), vc.step(0.1), effective)
    np.testing.assert_allclose(found.approach, young.approach, rtol=1e-9)


def test_force_on_a_clamped_stage_relaxes_over_the_reduced_time():
    # A punch under an approach: F(t) = 2 a δ M(ξ(t)) (Sneddon 1965, with the principle above).
    punch, grid = vc.FlatPunch(1e-3), vc.Grid((48, 48), (3e-3, 3e-3))
    material = vc.Material(LAWS["zener"], 0.5, shift=WLF)
    times = np.concatenate([np.linspace(0.0, 3.0, 121), np.linspace(3.2, 20.0, 43)])
    options = {"errors": False, "fields": "none", "temperature": DAY}
    found = vc.simulate(punch, material, vc.step(approach=1e-5), grid, times, **options)
    modulus = material.contact_compliance().relaxation(found.reduced_time.values)
    np.testing.assert_allclose(found.force / found.force[0], modulus / modulus[0], rtol=2e-3)


@pytest.mark.parametrize("law", ["zener", "power"])
def test_moving_contact_at_a_constant_temperature_is_that_of_the_slowed_law(law):
    warm, material = 303.15, vc.Material(LAWS[law], 0.5, shift=WLF)
    later = vc.TemperatureHistory([0.0, 10.0, 20.0], [warm, warm, warm + 10])
    travel, load = vc.Travel([0.0, 1.0], x=[0.0, 1e-3]), vc.step(0.05, tilt_x=0.0, tilt_y=0.0)
    times = np.linspace(0.0, 1.0, 11)
    pair = [
        run(given, load, times, temperature, motion=travel)
        for given, temperature in ((material, later), (material.at(warm), None))
    ]
    for name in ("approach", "resistance_x", "motion_work", "dissipation", "heat"):
        np.testing.assert_allclose(pair[0][name], pair[1][name], rtol=1e-9, atol=1e-25)


def test_layers_of_one_clock_follow_it_and_those_of_two_are_refused():
    rubber = vc.Material(LAWS["zener"], 0.45, shift=WLF)
    steel = vc.Material(vc.Elastic(8e10), 0.3)
    cover = vc.Layered([vc.Layer(2e-3, rubber)], base=steel)
    times = [0.0, 3.0, 12.0]
    found = run(cover, vc.step(0.1), times, DAY)
    reduced = ReducedTime(DAY, WLF).reduced(np.array(times))
    plain = vc.Layered([vc.Layer(2e-3, vc.Material(LAWS["zener"], 0.45))], base=steel)
    np.testing.assert_allclose(
        found.approach, run(plain, vc.step(0.1), reduced).approach, rtol=2e-3
    )
    other = vc.Material(vc.Zener(2e6, 1e6, 1e6), 0.45, shift=ARRHENIUS)
    both = vc.Layered([vc.Layer(2e-3, rubber), vc.Layer(1e-3, other)], base=steel)
    with pytest.raises(ValueError, match="must have the same shift"):
        run(both, vc.step(0.1), times, DAY)


def test_material_without_a_shift_is_refused_where_the_temperature_varies():
    with pytest.raises(ValueError, match="must have a shift"):
        run(vc.Material(LAWS["zener"], 0.5), vc.step(0.1), [0.0], DAY)


def test_temperature_outside_the_shift_is_refused():
    material = vc.Material(LAWS["zener"], 0.5, shift=TABLE)
    hot = vc.TemperatureHistory([0.0, 1.0], [293.15, 333.15])
    with pytest.raises(ValueError, match="temperature: TabulatedShift: must be used between"):
        run(material, vc.step(0.1), [0.0], hot)


def test_error_bars_see_the_clock():
    # The errors of ten long steps under a ramp while it cools, against those of many.
    material = vc.Material(vc.Zener(1e6, 2e5, 2e5), 0.5, shift=WLF)
    cooling = vc.TemperatureHistory([0.0, 10.0], [303.15, 293.15])
    coarse, fine = (
        run(material, vc.ramp(0.1, 10.0), vc.uniform_times(10.0, n), cooling, errors=n == 10)
        for n in (10, 160)
    )
    error = abs(float(coarse.approach[-1] - fine.approach[-1]))
    assert error < float(coarse.approach_error[-1]) < 30 * error
