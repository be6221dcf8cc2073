"""Warnings about the temperature of a run, in its result and predicted before it."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials.measured_range import MeasuredRange
from viscontact.cli import main
from viscontact.mechanics.problem.problem_from_arguments import contact_problem
from viscontact.runs.forecast import forecast
from viscontact.simulation.checks.temperature import (
    creeping_depth,
    expanding_depth,
    glass_transition,
    heat_ways,
    lag_warnings,
)
from viscontact.simulation.transient.setup import prepare_run

WLF = vc.WLF(293.15, 8.86, 101.6)
LAW = vc.Zener(1e6, 2e7, 1e10)  # it creeps little, so that no step is long
DAY = vc.TemperatureHistory([0.0, 36000.0], [293.15, 313.15])


def said(material: vc.Material, temperature: Any = DAY, **others: Any) -> str:
    """Warnings of a run, which the check before it predicts as well."""
    run = {"grid": vc.Grid((24, 24), (3e-3, 3e-3)), "times": [0.0, 600.0, 36000.0], **others}
    run = {"load": vc.step(0.1), **run, "temperature": temperature}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = vc.simulate(vc.Sphere(0.01), material, errors=False, **run)
    problem = contact_problem(indenter=vc.Sphere(0.01), material=material, **run)
    predicted = forecast(prepare_run(problem)).warnings
    found = str(result.attrs["warnings"])
    assert len(predicted) == len([line for line in found.splitlines() if line]), predicted
    return found


def test_no_warning_of_an_even_temperature_on_a_shift_that_covers_it() -> None:
    assert said(vc.Material(LAW, 0.4, shift=WLF)) == ""


def test_data_end_at_a_reduced_time() -> None:
    # Warm, the material creeps faster, and its data end earlier.
    material = vc.Material(LAW, 0.4, shift=WLF, measured_until=3e4)
    assert "beyond 8.333 h of reduced time, which it reaches after" in said(material)
    cold = vc.TemperatureHistory([0.0, 36000.0], [293.15, 283.15])
    assert said(material, cold) == ""
    aged = vc.Material(LAW, 0.4, ageing=vc.Ageing(3600.0, 1.0), measured_until=3e4)
    assert said(aged, None) == ""
    assert "beyond 8.333 h, where" in said(vc.Material(LAW, 0.4, measured_until=3e4), None)


def test_data_begin_at_a_reduced_time() -> None:
    tested = MeasuredRange(first=300.0)
    material = vc.Material(LAW, 0.4, shift=WLF, measured_range=tested)
    times, load = np.linspace(0.0, 900.0, 19), vc.ramp(0.1, 900.0)
    # In 900 s at 43 °C more than 2000 s of reduced time pass, at 0 °C less than 100.
    hot = vc.TemperatureHistory([0.0, 1e5], [316.15, 316.25])
    assert said(material, hot, times=times, load=load) == ""
    cold = vc.TemperatureHistory([0.0, 1e5], [273.15, 273.25])
    found = said(material, cold, times=times, load=load)
    assert "of the load has come within less than 300 s of reduced time" in found


def test_temperature_outside_the_tests() -> None:
    tested = MeasuredRange(temperatures=(293.15, 303.15))
    found = said(vc.Material(LAW, 0.4, shift=WLF, measured_range=tested))
    assert "the law is used at 20 to 40 °C, but was measured at 20 to 30 °C" in found


def test_degrees_celsius_given_as_kelvin() -> None:
    cold = vc.Material(LAW, 0.4, shift=vc.Arrhenius(293.15, 80e3))
    found = said(cold, vc.TemperatureHistory([0.0, 36000.0], [60.0, 80.0]))
    assert "a temperature of 80 K is given, that is -193.1 °C; add 273.15 if" in found
    with pytest.raises(ValueError, match=r"shift factor is beyond 1e\+100.*20 °C is 293.15 K"):
        said(cold, vc.TemperatureHistory([0.0, 36000.0], [20.0, 40.0]))
    layer = vc.Layer(2e-3, cold, expansion=1.8e-4, expansion_from=20.0)
    body = vc.Layered([layer], base="rigid")
    assert "a temperature of 20 K is given" in said(body, 293.15)


def test_temperature_below_the_glass_transition() -> None:
    # Polybutadienes with their glass transitions: J. E. Mark (ed.), Physical Properties of Polymers
    # Handbook, table 26.1. The estimate is low, so that the warning is of what is well below.
    for reference, c1, c2, transition in (
        *((298.0, 3.44, 196.6, 161.0), (298.0, 3.64, 186.5, 172.0)),
        *((263.0, 5.97, 123.2, 205.0), (298.0, 6.23, 72.5, 261.0)),
    ):
        estimate = glass_transition(vc.WLF(reference, c1, c2))
        assert transition - 25.0 < estimate < transition
    referred = WLF.referred_to(glass_transition(WLF))
    assert referred.c1 == close_to(17.44)
    cold = vc.TemperatureHistory([0.0, 36000.0], [293.15, 233.15])
    found = said(vc.Material(LAW, 0.4, shift=WLF), cold)
    assert "the temperature falls to -40 °C, below about -30 °C" in found
    assert "glass transition" in said(vc.Material(LAW, 0.4, shift=WLF), 233.15)
    arrhenius = vc.Material(LAW, 0.4, shift=vc.Arrhenius(293.15, 80e3))
    assert said(arrhenius, cold) == ""


def test_own_temperature_of_a_material_below_its_glass_transition() -> None:
    """As under the same temperature of the run; not at the one that the law was given at."""
    material = vc.Material(LAW, 0.4, shift=WLF)
    under_run = said(material, 233.15)
    assert "the material is used at -40 °C, below about -30 °C" in under_run
    assert said(material.at(233.15), None) == under_run
    assert said(material.at(253.15).at(233.15), None) == under_run
    assert said(material.at(253.15), None) == ""
    assert said(material.at(233.15).at(293.15), None) == ""
    # Given below the estimate, for which its tests vouch there.
    referred = WLF.referred_to(233.15)
    cold = vc.Material(LAW, 0.4, shift=vc.WLF(233.15, referred.c1, referred.c2))
    assert said(cold, None) == said(cold.at(233.15), None) == ""
    assert said(cold.at(293.15).at(233.15), None) == ""
    tested = MeasuredRange(temperatures=(233.15, 293.15))
    known = vc.Material(LAW, 0.4, shift=WLF, measured_range=tested)
    assert said(known.at(233.15), None) == ""
    arrhenius = vc.Material(LAW, 0.4, shift=vc.Arrhenius(293.15, 80e3))
    assert said(arrhenius.at(233.15), None) == ""


def test_key_temperature_of_a_material_in_a_case_is_warned_of(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "cold.yaml"
    case.write_text(
        """
indenter: {shape: sphere, radius: 10 mm}
material:
  law: zener
  poisson_ratio: 0.4
  shear_modulus: 1 MPa
  delayed_modulus: 20 MPa
  viscosity: 10 GPa s
  shift: {kind: wlf, reference_temperature: 20 degC, c1: 8.86, c2: 101.6 K}
  temperature: -40 degC
load: {kind: step, force: 0.1 N}
time: {end: 600 s, steps: 3}
grid: {shape: [24, 24], size: [3 mm, 3 mm]}
""",
        encoding="utf-8",
    )
    assert main(["check", str(case)]) == 0
    words = " ".join(capsys.readouterr().out.split())
    assert "the material is used at -40 °C, below about -30 °C" in words


def test_temperature_outside_the_shift_is_refused_at_its_argument() -> None:
    for wrong in (150.0, vc.TemperatureHistory([0.0, 1.0], [150.0, 290.0])):
        with pytest.raises(ValueError, match=r"^temperature: WLF: must be used above"):
            said(vc.Material(LAW, 0.4, shift=WLF), wrong)


def test_vertical_shift_that_varies_is_left_out() -> None:
    shift = vc.TabulatedShift([283.15, 323.15], [10.0, 0.1], [0.95, 1.05])
    found = said(vc.Material(LAW, 0.4, shift=shift))
    assert "vary by factors from 0.974 to 1.02" in found
    assert said(vc.Material(LAW, 0.4, shift=shift), 313.15) == ""


def test_law_without_shift_is_used_as_it_is() -> None:
    assert "has no shift, and its law is used as it is at 40 °C" in said(
        vc.Material(LAW, 0.4), 313.15
    )
    assert said(vc.Material(vc.Elastic(1e6), 0.4), 313.15) == ""


def test_temperature_changes_faster_than_heat_diffuses() -> None:
    quick = vc.TemperatureHistory([0.0, 6.0, 36000.0], [293.15, 313.15, 313.15])
    found = said(vc.Material(LAW, 0.4, shift=WLF), quick)
    assert "changes faster than heat diffuses over the contact" in found
    # Over 10 mm heat takes 1000 s: at 1 K in 100 s it lags by 10 K.
    slow = vc.TemperatureHistory([0.0, 1e4], [293.15, 393.15])
    [text] = lag_warnings(slow, 0.01, "there:", 1e4).values()
    assert "than heat diffuses there: this takes about 1000 s" in text
    assert "by about 10 K" in text
    assert lag_warnings(slow, 0.001, "there:", 1e4) == {}
    # A jump after the end of the run changes nothing.
    later = vc.TemperatureHistory([0.0, 50.0, 50.0], [293.15, 293.15, 393.15])
    assert lag_warnings(later, 0.01, "there:", 40.0) == {}


RUBBER, STEEL = vc.Material(LAW, 0.4, shift=WLF), vc.Material(vc.Elastic(80e9), 0.3)
COVER, PLATE = vc.Layer(2e-3, RUBBER), vc.Layer(3e-3, STEEL)
GROWING = vc.Layer(3e-3, STEEL, expansion=1e-5, expansion_from=293.15)


def test_heat_has_to_reach_what_creeps_or_expands() -> None:
    for layers, base, creeping, expanding in (
        *(([COVER], "rigid", 2e-3, 0.0), ([COVER, PLATE], STEEL, 2e-3, 0.0)),
        *(([COVER], RUBBER, np.inf, 0.0), ([PLATE, COVER], STEEL, 5e-3, 0.0)),
        *(([COVER, GROWING], "rigid", 2e-3, 5e-3), ([PLATE], STEEL, 0.0, 0.0)),
    ):
        body = vc.Layered(layers, base=base)
        assert creeping_depth(body) == close_to(creeping)
        assert expanding_depth(body) == close_to(expanding)
    assert (creeping_depth(RUBBER), expanding_depth(RUBBER)) == (np.inf, 0.0)
    assert (creeping_depth(STEEL), expanding_depth(STEEL)) == (0.0, 0.0)


def test_heat_diffuses_over_the_contact_or_through_a_thinner_body() -> None:
    """A slab of thickness h is even after about h²/α (Carslaw and Jaeger 1959, chapter 3)."""
    for half_width, length, name in (
        *((1e-3, 1e-3, "over the contact"), (5e-3, 2e-3, "through the body: over its 2 mm")),
    ):
        way, *expanding = heat_ways([vc.Layered([COVER], base="rigid"), STEEL], half_width)
        assert way[0] == close_to(length)
        assert name in way[1]
        assert [each[0] for each in expanding] == [0.0, 0.0]


def test_heat_diffuses_through_a_layer_that_expands_however_narrow_the_contact() -> None:
    """Its thickness grows by the mean temperature over it, which it reaches after about h²/α."""
    body = vc.Layered([COVER, GROWING], base="rigid")
    for half_width in (1e-3, 2e-2):
        assert max(heat_ways([body], half_width))[0] == close_to(5e-3)
    # Under a ramp the mean over a slab that is heated at its surface alone lags by h²/(3 α) times
    # the rate, and by less if its core is heated as well: the estimate is on the safe side.
    slow = vc.TemperatureHistory([0.0, 1e4], [293.15, 393.15])
    thick = vc.Layer(8e-3, RUBBER, expansion=1.8e-4, expansion_from=293.15)
    found = said(vc.Layered([thick], base="rigid"), slow)
    assert "through the layers that expand: over their 8 mm this takes about 640 s" in found
    assert "by about 6.4 K" in found
    plain = vc.Layered([vc.Layer(8e-3, RUBBER)], base="rigid")
    assert "than heat diffuses" not in said(plain, slow)


def test_a_cover_thinner_than_the_contact_warms_faster() -> None:
    run = {"grid": vc.Grid((48, 48), (2e-3, 2e-3))}
    quick = vc.TemperatureHistory([0.0, 6.0, 36000.0], [293.15, 313.15, 313.15])
    assert "than heat diffuses over the contact" in said(RUBBER, quick, **run)
    cover = vc.Layered([vc.Layer(2e-4, RUBBER)], base="rigid")
    assert "than heat diffuses" not in said(cover, quick, **run)


def test_warnings_name_the_body() -> None:
    shift = vc.TabulatedShift([283.15, 323.15], [10.0, 0.1], [0.95, 1.05])
    other = vc.Material(LAW, 0.4, shift=shift)
    found = said(vc.Material(LAW, 0.4, shift=WLF), indenter_material=other)
    assert "the moduli of the indenter material" in found


@pytest.mark.parametrize("ageing", [None, vc.Ageing(3600.0, 0.8)])
def test_steady_motion_takes_a_constant_temperature(ageing: vc.Ageing | None) -> None:
    material = vc.Material(vc.Zener(1e6, 1e6, 1e4), 0.5, shift=WLF, ageing=ageing)
    ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    run = {"grid": vc.Grid((32, 32), (6e-3, 6e-3)), "errors": False, "fields": "none"}
    if ageing is not None:
        with pytest.raises(ValueError, match="ageing: a material that ages has no steady state"):
            vc.steady(ball, material, load, [0.1], **run, temperature=303.15)
        return
    warm = vc.steady(ball, material, load, [0.1], **run, temperature=303.15)
    own = vc.steady(ball, material.at(303.15), load, [0.1], **run)
    np.testing.assert_array_equal(warm.friction_coefficient, own.friction_coefficient)
    with pytest.raises(ValueError, match="it varies, and a steady motion has one temperature"):
        vc.steady(ball, material, load, [0.1], **run, temperature=DAY)
