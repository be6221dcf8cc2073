"""Law and shift from one test whose temperature varied, such as by the stepped isothermal method.

A thermorheologically simple material creeps over the reduced time ∫ dt/a_T (Morland & Lee 1960,
Trans. Soc. Rheol. 4, 233). The records are made by adaptive quadrature of 1/a_T.
"""

from __future__ import annotations

import functools

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

import viscontact as vc
from campaigns import fewest_held, tried
from closeness import close_to
from viscontact.case import read_material
from viscontact.identification import material_section

FIRST, RISE, DWELL, STEPS = 293.15, 7.0, 3 * 3600.0, 5
CREEP = vc.CreepSeries(3e-10, [1e-10, 2e-10, 4e-10], [1e3, 5e4, 2e6])
RELAXATION = vc.RelaxationSeries(2e8, [4e8, 4e8, 3e8], [1e3, 5e4, 2e6])
ARRHENIUS, WLF = vc.Arrhenius(FIRST, 200e3), vc.WLF(FIRST, 8.86, 101.6)


def temperature_at(times):
    """Steps of 7 K with ramps of 12 minutes, three rows of 225."""
    begins = DWELL * np.arange(1, STEPS)
    points = np.stack([begins, begins + 720.0], axis=1).ravel()
    levels = FIRST + RISE * np.repeat(np.arange(STEPS), 2)[1:-1]
    return np.interp(times, points, levels)


def stepped(respond, shift, rows=225, noise=0.0, seed=0):
    """Times [s], temperatures [K] and values of a test."""
    # Simpson's rule between kinks at multiples of the step.
    fine = np.linspace(0.0, STEPS * DWELL, 54000 + 1)
    reduced = cumulative_simpson(1 / shift.factor(temperature_at(fine)), x=fine, initial=0.0)
    every = 54000 // rows
    times, values = fine[every::every], respond(reduced[every::every])
    scatter = 1 + noise * np.random.default_rng(seed).standard_normal(times.size)
    return times, temperature_at(times), values * scatter


@functools.cache
def exact_fit(name, shift):
    """Fit of creep without noise, of which the tests look at different parts."""
    times, temperature, creep = stepped(CREEP, shift)
    return vc.fit_creep(
        times, creep, data="deviatoric", temperature=temperature, shift=name, tolerance=0.0
    )


@pytest.mark.parametrize(("name", "shift"), [("arrhenius", ARRHENIUS), ("wlf", WLF)])
def test_exact_creep_gives_law_and_shift(name, shift):
    fit = exact_fit(name, shift)
    found = fit.found_shift
    for key, value in found.parameters.items():
        assert value == close_to(getattr(shift, key), rel=1e-6)
    np.testing.assert_allclose(fit.law.times, CREEP.times, rtol=1e-6)
    np.testing.assert_allclose(fit.law.amplitudes, CREEP.amplitudes, rtol=1e-6)
    np.testing.assert_allclose(found.temperatures, FIRST + RISE * np.arange(STEPS), rtol=1e-9)
    np.testing.assert_allclose(found.decades, np.log10(shift.factor(found.temperatures)), atol=1e-6)


def test_exact_relaxation_gives_law_and_shift_and_the_criterion_its_rule():
    times, temperature, modulus = stepped(RELAXATION.relaxation, WLF)
    fit = vc.fit_relaxation(times, modulus, data="shear", temperature=temperature, tolerance=0.0)
    assert isinstance(fit.found_shift.shift, vc.WLF)
    assert fit.found_shift.criteria["arrhenius"] > 100.0
    assert fit.found_shift.parameters["c2"] == close_to(101.6, rel=1e-5)
    np.testing.assert_allclose(fit.law.moduli, RELAXATION.moduli, rtol=1e-5)


@pytest.mark.slow
def test_table_has_a_factor_for_each_temperature_that_is_held():
    times, temperature, creep = stepped(CREEP, WLF)
    fit = vc.fit_creep(times, creep, data="deviatoric", temperature=temperature, shift="table")
    shift = fit.found_shift.shift
    levels = FIRST + RISE * np.arange(STEPS)
    np.testing.assert_allclose(shift.temperatures, levels, rtol=1e-9)
    # Between them ln a_T is linear in a table, which the ramps feel.
    np.testing.assert_allclose(np.log10(shift.factors), np.log10(WLF.factor(levels)), atol=0.02)


def coverage(name, shift, seeds):
    """Parts of the seeds whose intervals contain the parameters, and the hottest factor."""
    within = []
    for seed in seeds:
        times, temperature, creep = stepped(CREEP, shift, rows=225, noise=0.01, seed=seed)
        found = vc.fit_creep(
            *(times, creep),
            data="deviatoric",
            temperature=temperature,
            shift=name,
            reference_temperature=FIRST,
            thermal_strain=False,
        ).found_shift
        off = abs(found.decades[-1] - np.log10(shift.factor(float(found.temperatures[-1]))))
        inside = [
            low <= getattr(shift, key) <= high for key, (low, high) in found.intervals.items()
        ]
        within.append([*inside, off <= found.errors[-1]])
    return np.mean(within, axis=0)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_intervals_contain_the_shift_of_noisy_tests():
    assert coverage("arrhenius", ARRHENIUS, range(2)).min() == 1.0


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize(("name", "shift"), [("arrhenius", ARRHENIUS), ("wlf", WLF)])
def test_intervals_contain_the_shift_of_most_noisy_tests(name, shift):
    count = tried(16, 40)
    assert coverage(name, shift, range(count)).min() * count >= fewest_held(count)


def test_thermal_expansion_is_found_where_it_is_sought():
    times, temperature, creep = stepped(CREEP, ARRHENIUS, noise=0.003)
    found = vc.fit_creep(
        *(times, creep + 2e-11 * (temperature - FIRST)),
        data="deviatoric",
        temperature=temperature,
        shift="arrhenius",
        thermal_strain=True,
    ).found_shift
    assert found.warnings == ()
    assert abs(found.expansion - 2e-11) <= found.expansion_error < 2e-12


@pytest.mark.slow
def test_thermal_expansion_is_found_with_the_law():
    times, temperature, creep = stepped(CREEP, ARRHENIUS, noise=0.003)
    expanding = creep + 2e-11 * (temperature - FIRST)
    options = {"data": "deviatoric", "temperature": temperature, "shift": "arrhenius"}
    with pytest.warns(vc.AccuracyWarning, match="follows the temperature at once"):
        fit = vc.fit_creep(times, expanding, **options)
    found = fit.found_shift
    assert abs(found.expansion - 2e-11) <= found.expansion_error < 2e-12
    low, high = found.intervals["activation_energy"]
    assert low <= 200e3 <= high
    same = vc.fit_creep(times, expanding, **options, thermal_strain=True)
    assert same.found_shift.warnings == ()
    assert same.found_shift.expansion == found.expansion
    # Without expansion none is found.
    plain = vc.fit_creep(times, creep, **options)
    assert plain.found_shift.expansion is None


def test_known_shift_is_taken_as_it_is():
    times, temperature, creep = stepped(CREEP, WLF)
    history = vc.TemperatureHistory(times, temperature)
    for shift in (WLF, vc.TabulatedShift([290.0, 325.0], [2.0, 1e-4])):
        fit = vc.fit_creep(times, creep, data="deviatoric", temperature=history, shift=shift)
        assert fit.found_shift.parameters == {}
    exact = vc.fit_creep(
        times, creep, data="deviatoric", temperature=history, shift=WLF, tolerance=0.0
    )
    np.testing.assert_allclose(exact.law.times, CREEP.times, rtol=1e-5)


def test_rows_may_be_in_any_order_and_the_law_at_any_reference():
    times, temperature, creep = stepped(CREEP, ARRHENIUS)
    order = np.random.default_rng(1).permutation(times.size)
    fit = vc.fit_creep(
        *(times[order], creep[order]),
        data="deviatoric",
        temperature=temperature[order],
        shift="arrhenius",
        reference_temperature=FIRST + 20.0,
        tolerance=0.0,
    )
    factor = ARRHENIUS.factor(FIRST + 20.0)
    np.testing.assert_allclose(fit.law.times, factor * np.array(CREEP.times), rtol=1e-6)
    assert fit.residual < 1e-9


def test_section_of_a_case_has_the_shift(tmp_path):
    path = tmp_path / "law.yaml"
    path.write_text(
        material_section(exact_fit("wlf", WLF)) + "\n  poisson_ratio: 0.4\n", encoding="utf-8"
    )
    material = read_material(path)
    assert material.shift.c1 == close_to(8.86, rel=1e-5)
    warm = material.at(FIRST + 14.0)
    reduced = 1e4 / WLF.factor(FIRST + 14.0)
    assert warm.law(1e4) == close_to(CREEP(reduced), rel=1e-4)


TIMES = np.linspace(100.0, 5e4, 60)
LEVELS = temperature_at(TIMES)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"temperature": np.linspace(290.0, 320.0, 60)}, "changes along one ramp"),
        ({"temperature": np.full(60, 293.15)}, "varies by 0 K only"),
        ({"temperature": LEVELS[:-1]}, "one value in each row, got 60 times, 59 temperature"),
        ({"temperature": LEVELS - 273.15}, "must be absolute, got at most 48 K"),
        ({"temperature": LEVELS, "shift": "power"}, "shift must be one of arrhenius, wlf, table"),
        ({"temperature": LEVELS, "reference_temperature": -3.0}, "reference_temperature must be"),
        ({"shift": "wlf"}, "shift goes with temperature"),
        ({"thermal_strain": True}, "thermal_strain goes with temperature"),
    ],
)
def test_what_does_not_fit_a_varying_temperature_is_refused(options, message):
    with pytest.raises(ValueError, match=message):
        vc.fit_creep(TIMES, CREEP(TIMES), data="deviatoric", **options)


def test_two_rows_at_one_time_are_refused():
    times = np.append(TIMES[:-1], TIMES[4])
    with pytest.raises(ValueError, match=r"row 59: two rows .* have the same time"):
        vc.fit_creep(times, CREEP(times), data="deviatoric", temperature=LEVELS)


def test_one_small_step_is_warned_of():
    times, _, _ = stepped(CREEP, ARRHENIUS, rows=90)
    history = vc.TemperatureHistory([0.0, 5.2e4, 5.2e4], [FIRST, FIRST, FIRST + 3.0])
    noisy = CREEP(times) * (1 + 0.02 * np.random.default_rng(0).standard_normal(times.size))
    with pytest.warns(vc.AccuracyWarning, match="can hardly be told apart"):
        vc.fit_creep(times, noisy, data="deviatoric", temperature=history, shift="arrhenius")


def test_shift_at_the_end_of_the_search_is_warned_of():
    shift, warmer = vc.Arrhenius(FIRST, 1.05e6), FIRST + 4.0
    history = vc.TemperatureHistory([0.0, 1e4, 1e4], [FIRST, FIRST, warmer])
    times = np.linspace(200.0, 2e4, 60)
    reduced = times + np.maximum(times - 1e4, 0.0) * (1 / shift.factor(warmer) - 1)
    options = {"data": "deviatoric", "shift": "arrhenius", "thermal_strain": False}
    with pytest.warns(vc.AccuracyWarning, match="energy of 1050 kJ/mol, where the search ends"):
        vc.fit_creep(times, CREEP(reduced), temperature=history, **options)


@pytest.mark.parametrize("rule", ["arrhenius", "wlf", "table"])
def test_record_that_has_relaxed_before_the_first_step_is_warned_of(rule):
    times = np.linspace(10.0, 3000.0, 60)
    history = vc.TemperatureHistory(
        [0.0, 1000.0, 1000.0, 2000.0, 2000.0], FIRST + np.array([0, 0, 7, 7, 14])
    )
    fast = vc.RelaxationSeries(1e9, [2e9], [5.0])
    noisy = fast.relaxation(times) * (1 + 0.01 * np.random.default_rng(2).standard_normal(60))
    with pytest.warns(vc.AccuracyWarning, match="can hardly be told apart"):
        vc.fit_relaxation(times, noisy, data="shear", temperature=history, shift=rule)
