"""Time-temperature superposition: recovered shift factors, fitted rules, refusals."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from viscontact.identification import (
    Isotherm,
    build_master_curve,
    fit_arrhenius,
    fit_master_curve,
    fit_wlf,
)
from viscontact.laws import WLF, Arrhenius, CreepSeries, RelaxationSeries, TabulatedShift
from viscontact.tables import read_table

TEMPERATURES = np.arange(360.0, 431.0, 5.0)
T = np.geomspace(1.0, 1000.0, 19)
RULE = WLF(380.0, 12.0, 70.0)
# A glass transition 6 decades wide, in a row of terms two a decade: smooth, without steps.
_TAUS = np.geomspace(1e-12, 1e12, 49)
_BELL = np.exp(-0.5 * (np.log10(_TAUS) / 3) ** 2)
LAW = RelaxationSeries(0.01e9, list(1e9 * _BELL / _BELL.sum()), list(_TAUS))


def relaxation_sets(scatter=0.0, seed=0, temperatures=TEMPERATURES, rule=RULE):
    """Sets of the law, each value measured with a relative scatter; the law is Phi(t/a_T)."""
    rng = np.random.default_rng(seed)
    return [
        Isotherm(
            t,
            T,
            {
                "modulus": LAW.relaxation(T / rule.factor(t))
                * (1 + scatter * rng.standard_normal(T.size))
            },
        )
        for t in temperatures
    ]


def decades(factors):
    return np.log10(factors)


def test_shift_factors_are_found_again_up_to_the_corners_between_measured_points():
    """Splines with six knots a decade miss a smooth curve by some 1e-4."""
    curve = build_master_curve(relaxation_sets(), 380.0, vertical="none")
    np.testing.assert_allclose(
        decades(curve.factors), decades(RULE.factor(TEMPERATURES)), atol=0.02
    )
    assert (curve.mismatches < 2e-3).all()


def test_finding_shift_factors_converges_with_the_density_of_the_points():
    """Second order or better: the splines, as dense as the points, are all that is wrong."""
    errors = []
    for count in (7, 13, 25, 49):
        times = np.geomspace(1.0, 1000.0, count)
        sets = [
            Isotherm(t, times, {"modulus": LAW.relaxation(times / RULE.factor(t))})
            for t in (375.0, 380.0, 385.0)
        ]
        found = build_master_curve(sets, 380.0, vertical="none").factors
        wanted = RULE.factor(np.array([375.0, 380.0, 385.0]))
        errors.append(np.abs(decades(found) - decades(wanted)).max())
    assert errors[-1] < errors[0] / 20
    assert errors[-1] < 2e-4


@pytest.mark.parametrize("seed", range(4))
def test_shift_factors_survive_one_per_cent_of_scatter(seed):
    """A step errs by about scatter/slope/sqrt(rows) = 0.01 decades, fourteen of them by 0.05."""
    curve = build_master_curve(relaxation_sets(0.01, seed), 380.0, vertical="none")
    missed = decades(curve.factors) - decades(RULE.factor(TEMPERATURES))
    assert np.abs(missed).max() < 0.12
    wlf = curve.fit_wlf()
    assert wlf.residual < 0.05
    assert wlf.residual < curve.fit_arrhenius().residual / 3  # the rule it is
    assert wlf.shift.c1 == close_to(12.0, rel=0.1)
    assert wlf.shift.c2 == close_to(70.0, rel=0.1)
    fit = fit_master_curve(curve, data="shear")
    assert fit.residual < 0.013
    at = np.geomspace(1e-3, 1e6, 40)
    np.testing.assert_allclose(fit.law.relaxation(at), LAW.relaxation(at), rtol=0.05)


def test_a_run_at_another_temperature_has_the_slowed_law():
    curve = build_master_curve(relaxation_sets()[:7], 380.0, vertical="none")
    law = fit_master_curve(curve, data="shear").law.slowed(curve.shift.factor(370.0))
    np.testing.assert_allclose(law.relaxation(T), LAW.relaxation(T / RULE.factor(370.0)), rtol=0.02)


def test_oscillations_shift_as_relaxations_do():
    frequencies = 1.0 / T
    some, sets = TEMPERATURES[2:7], []
    for t in some:
        modulus = LAW.complex_modulus(frequencies * RULE.factor(t))
        sets.append(Isotherm(t, frequencies, {"storage": modulus.real, "loss": modulus.imag}))
    curve = build_master_curve(sets, 380.0)
    np.testing.assert_allclose(decades(curve.factors), decades(RULE.factor(some)), atol=0.02)
    assert (np.diff(curve.points) >= 0).all()
    fit = fit_master_curve(curve, data="shear")
    at = np.geomspace(1e-1, 1e4, 40)
    np.testing.assert_allclose(fit.law.relaxation(at), LAW.relaxation(at), rtol=0.02)


@pytest.mark.parametrize("seed", range(3))
def test_losses_that_scatter_wildly_do_not_move_a_well_measured_storage(seed):
    """Real losses of a glass are a hundredth of the modulus and differ from set to set by much."""
    frequencies, some, rng = 1.0 / T, TEMPERATURES[:4], np.random.default_rng(seed)
    sets = []
    for t in some:
        modulus = LAW.complex_modulus(frequencies * RULE.factor(t))
        loss = 0.02 * modulus.real * np.exp(rng.standard_normal(T.size))
        sets.append(Isotherm(t, frequencies, {"storage": modulus.real, "loss": loss}))
    found = build_master_curve(sets, some[0]).factors
    wanted = RULE.factor(some) / RULE.factor(some[0])
    np.testing.assert_allclose(decades(found), decades(wanted), atol=0.1)


def test_creep_sets_shift_too():
    law = CreepSeries(1e-9, [1e-9, 3e-9, 9e-9, 2e-8], [0.1, 3.0, 100.0, 3e3])
    rule = Arrhenius(300.0, 150e3)
    sets = [Isotherm(t, T, {"compliance": law(T / rule.factor(t))}) for t in (290.0, 300.0, 310.0)]
    curve = build_master_curve(sets, 300.0)
    assert curve.fit_arrhenius().shift.activation_energy == close_to(150e3, rel=0.01)
    assert fit_master_curve(curve, data="deviatoric").residual < 5e-3


def test_the_order_of_sets_and_of_their_rows_does_not_matter():
    sets = relaxation_sets(0.01)
    turned = [
        Isotherm(s.temperature, s.points[::-1], {"modulus": s.measured["modulus"][::-1]})
        for s in sets[::-1]
    ]
    one, other = (build_master_curve(each, 380.0, vertical="none") for each in (sets, turned))
    np.testing.assert_allclose(one.factors, other.factors, rtol=1e-12)
    np.testing.assert_allclose(one.points, other.points, rtol=1e-12)
    np.testing.assert_allclose(one.measured["modulus"], other.measured["modulus"], rtol=1e-12)


def test_the_instant_of_the_step_counts_for_the_law_but_not_for_the_shift():
    sets, with_instant = relaxation_sets()[:4], []
    for s in sets:
        modulus = np.append(s.measured["modulus"], LAW.relaxation(0.0))
        with_instant.append(Isotherm(s.temperature, np.append(s.points, 0.0), {"modulus": modulus}))
    one, other = (build_master_curve(each, 370.0, vertical="none") for each in (sets, with_instant))
    np.testing.assert_allclose(other.factors, one.factors, rtol=1e-12)
    assert other.points[0] == 0.0
    at_once = fit_master_curve(other, data="shear").law.relaxation(0.0)
    assert at_once == close_to(LAW.relaxation(0.0), rel=0.01)


def test_another_reference_moves_the_whole_curve():
    sets = relaxation_sets(0.005)
    one, other = (build_master_curve(sets, t, vertical="none") for t in (380.0, 402.5))
    ratio = one.factors / other.factors
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-12)
    # Between two sets ln a_T is straight: half-way between 400 and 405 K.
    middle = np.sqrt(one.factors[8] * one.factors[9])
    assert ratio[0] == close_to(middle)


def test_given_shifts_are_referred_to_the_reference_temperature():
    """a_T from T_r' is a_T from T_r over that of T_r' itself: Ferry (1980), section 11.A."""
    curve = build_master_curve(relaxation_sets()[:3], 365.0, RULE)
    expected = RULE.factor(TEMPERATURES[:3]) / RULE.factor(365.0)
    np.testing.assert_allclose(curve.factors, expected, rtol=1e-14)
    assert curve.mismatches is None
    # What the law says at 365 K, all three sets lie on.
    on_law = LAW.relaxation(curve.points / RULE.factor(365.0))
    np.testing.assert_allclose(curve.measured["modulus"], on_law, rtol=1e-9)


def test_wlf_and_arrhenius_are_recovered_exactly_with_their_residuals():
    exact = fit_wlf(TEMPERATURES, RULE.factor(TEMPERATURES), 380.0)
    assert (exact.shift.c1, exact.shift.c2) == close_to((12.0, 70.0), rel=1e-6)
    assert exact.residual < 1e-9
    table = TabulatedShift([370.0, 380.0, 390.0], [100.0, 1.0, 0.1])
    rule = fit_arrhenius(table.temperatures, table.factors, 380.0)
    missed = decades(rule.shift.factor([370.0, 380.0, 390.0])) - [2.0, 0.0, -1.0]
    assert rule.residual == close_to(np.sqrt(np.mean(missed**2)))
    assert rule.largest_residual == close_to(np.abs(missed).max())


def test_a_wlf_rule_is_found_from_any_reference():
    """Its constants change with the reference, its factors' ratios do not."""
    for reference in (365.0, 400.0, 430.0):
        factors = RULE.factor(TEMPERATURES) / RULE.factor(reference)
        found = fit_wlf(TEMPERATURES, factors, reference).shift
        assert found.c2 == close_to(70.0 + reference - 380.0, rel=1e-5)


FALLING = [3.0, 2.0, 1.0]


def isotherm(temperature, values=FALLING, name="modulus", points=(1.0, 2.0, 3.0)):
    return Isotherm(temperature, points, {name: values})


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: isotherm(-20.0), r"temperature, row 0: .*above 0 K, got -20\.0"),
        (lambda: isotherm(300.0, [3.0, -2.0, 1.0]), r"at 300 K: modulus, row 1: .*got -2\.0"),
        (lambda: isotherm(300.0, points=(1.0, -1.0, 2.0)), "at 300 K: times, row 1"),
        (lambda: isotherm(300.0, [3.0, 2.0], points=(0.0, 1.0)), "two rows above 0 s"),
        (lambda: isotherm(300.0, points=(1.0, 1.0, 2.0)), "two rows have the same time"),
        (lambda: isotherm(300.0, [3.0, 2.0]), "got 3 points, 2 modulus"),
        (lambda: isotherm(300.0, name="storage"), "both storage and loss, got storage"),
        (lambda: build_master_curve([isotherm(300.0)], 300.0), "at least 2 sets, got 1"),
        (
            lambda: build_master_curve([isotherm(300.0), isotherm(300.0)], 300.0),
            "two sets have the temperature 300 K",
        ),
        (
            lambda: build_master_curve(
                [isotherm(300.0), isotherm(310.0, [1.0, 2.0, 3.0], "compliance")], 300.0
            ),
            "one kind of test, got compliance and modulus",
        ),
        (
            lambda: build_master_curve([isotherm(300.0), isotherm(310.0, FALLING[::-1])], 300.0),
            "set at 310 K: modulus rises",
        ),
        (
            lambda: build_master_curve([isotherm(300.0), isotherm(310.0, [0.9, 0.8, 0.7])], 300.0),
            "300 K and 310 K: they have no value in common: .*0.7 and 0.9; give shift=",
        ),
        (
            lambda: build_master_curve(relaxation_sets()[:3], 365.0, vertical="rubbery"),
            "vertical must be one of none, rubber, found, got 'rubbery'",
        ),
        (
            lambda: build_master_curve(relaxation_sets()[:3], 365.0, RULE, vertical="found"),
            "vertical goes with shift factors that are found",
        ),
        (
            lambda: build_master_curve(relaxation_sets()[:3], 300.0),
            "within those of the sets, 360 to 370 K, got 300 K",
        ),
        (
            lambda: build_master_curve(
                [
                    isotherm(t, s.measured["modulus"], points=s.points)
                    for t, s in zip((370.0, 360.0), relaxation_sets()[:2], strict=True)
                ],
                365.0,
            ),
            "the warmer one is slower, by 1.5 decades",
        ),
        (lambda: fit_wlf([300.0, 310.0], [1.0, 0.1], 300.0), "at least 3 rows, got 2"),
        (lambda: fit_wlf([300.0, 310.0, 310.0], [1.0, 0.1, 0.1], 300.0), "3 different temp"),
        (lambda: fit_arrhenius([300.0, 310.0], [1.0, 9.0], 300.0), "factors rise"),
    ],
)
def test_bad_sets_are_refused_with_temperature_row_and_column(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_a_table_of_several_temperatures_gives_its_master_curve(tmp_path):
    path = tmp_path / "dma.csv"
    law, rule = RelaxationSeries(1e6, [1e9], [10.0]), WLF(293.15, 12.0, 70.0)
    frequencies = np.geomspace(0.1, 100.0, 16)
    rows = ["temperature [degC],frequency [Hz],storage modulus [MPa],loss modulus [MPa]"]
    for celsius in (15.0, 22.0, 28.0):
        modulus = law.slowed(rule.factor(celsius + 273.15)).complex_modulus(2 * np.pi * frequencies)
        rows += [
            f"{celsius},{f:.9g},{m.real / 1e6:.12g},{m.imag / 1e6:.12g}"
            for f, m in zip(frequencies, modulus, strict=True)
        ]
    path.write_text("\n".join(rows), encoding="utf-8")
    curve = build_master_curve(read_table(path))
    assert curve.reference_temperature == close_to(295.15)  # the set nearest 20 degC
    exact = rule.factor(curve.temperatures) / rule.factor(295.15)
    np.testing.assert_allclose(curve.factors, exact, rtol=0.05)
    # A reference that is a set's temperature but for rounding is that of the set.
    near = build_master_curve(read_table(path), 295.15 + 1e-13)
    assert near.reference_temperature == curve.isotherms[1].temperature
    assert build_master_curve(read_table(path), 288.15 - 1e-13).factors[0] == 1
    with pytest.raises(ValueError, match=r"build_master_curve\(table\) returns, got Table"):
        fit_master_curve(read_table(path), data="shear")
