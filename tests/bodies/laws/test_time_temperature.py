"""Shift factors: published values, changes of the reference, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.laws import WLF, Arrhenius, TabulatedShift

warm = st.floats(260.0, 450.0)


def test_wlf_reaches_the_viscosity_of_a_glass_at_its_transition():
    """Williams, Landel & Ferry (1955): with their universal constants, referred to T_g, the
    shift over 100 K above it is C1 100/(C2 + 100) = 11.50 decades."""
    assert np.log10(WLF(373.15, 17.44, 51.6).factor(473.15)) == close_to(-11.504, abs=5e-4)


@given(warm, warm)
def test_wlf_referred_to_another_temperature_is_the_same_rule(other, asked):
    """Ferry (1980), eq. 11-22, 11-23: c1' = c1 c2/(c2 + d), c2' = c2 + d, d = T_r' - T_r."""
    first = WLF(350.0, 8.86, 101.6)
    moved = other - 350.0
    second = WLF(other, 8.86 * 101.6 / (101.6 + moved), 101.6 + moved)
    ratio = first.factor(asked) / first.factor(other)
    assert second.factor(asked) == close_to(ratio, rel=1e-9)


def test_arrhenius_halves_near_ten_kelvin_at_fifty_kilojoules():
    """The chemists' rule of thumb: 50 kJ/mol near 298 K doubles a rate in 10 K (Atkins)."""
    assert Arrhenius(298.15, 50e3).factor(308.15) == close_to(0.5, rel=0.1)


@given(warm, warm)
def test_a_rule_with_another_reference_has_the_ratio_of_its_factors(other, asked):
    """a(T; T') = a(T)/a(T') for every rule, and likewise b."""
    table = TabulatedShift([250.0, 350.0, 460.0], [50.0, 1.0, 1e-6], [0.9, 1.0, 1.2])
    for shift in (WLF(350.0, 8.86, 101.6), Arrhenius(350.0, 1e5), table):
        moved = shift.referred_to(other)
        assert type(moved) is type(shift)
        assert moved.factor(other) == close_to(1.0, rel=1e-12)
        ratio = shift.factor(asked) / shift.factor(other)
        assert moved.factor(asked) == close_to(ratio, rel=1e-9)
        raised = shift.vertical_factor(asked) / shift.vertical_factor(other)
        assert moved.vertical_factor(asked) == close_to(raised, rel=1e-12)


@given(warm, warm)
def test_arrhenius_depends_on_the_two_temperatures_only(one, other):
    there, back = Arrhenius(one, 9e4).factor(other), Arrhenius(other, 9e4).factor(one)
    assert there * back == close_to(1.0)


@given(warm)
def test_far_above_c2_wlf_becomes_the_arrhenius_like_limit(asked):
    """For C2 -> inf at fixed C1/C2, log10 a_T = -(C1/C2)(T - T_r): a straight line."""
    log = np.log10(WLF(350.0, 1e7, 1e8).factor(asked))
    assert log == close_to(-0.1 * (asked - 350.0), abs=1e-4)


def test_every_rule_is_one_at_its_reference_and_falls_with_temperature():
    temperatures = np.linspace(330.0, 420.0, 91)
    for shift in (
        WLF(350.0, 8.86, 101.6),
        Arrhenius(350.0, 1e5),
        TabulatedShift([330.0, 350.0, 420.0], [50.0, 1.0, 1e-6]),
    ):
        assert shift.factor(350.0) == close_to(1.0)
        assert type(shift.factor(350.0)) is float
        assert (np.diff(shift.factor(temperatures)) < 0).all()
        assert shift.factor(temperatures.reshape(7, 13)).shape == (7, 13)


def test_a_table_gives_its_own_factors_exactly_and_their_geometric_mean_between():
    shift = TabulatedShift([280.0, 300.0, 310.0], [100.0, 4.0, 1.0])
    np.testing.assert_allclose(shift.factor([280.0, 300.0, 310.0]), [100.0, 4.0, 1.0], rtol=1e-14)
    assert shift.factor(305.0) == close_to(2.0)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: WLF(0.0, 17.0, 50.0), r"WLF: reference_temperature .*got 0 K"),
        (lambda: WLF(300.0, -17.0, 50.0), r"WLF: c1 .*got -17"),
        (lambda: WLF(300.0, 17.0, np.nan), r"WLF: c2"),
        (lambda: Arrhenius(300.0, 0.0), r"Arrhenius: activation_energy .*J/mol"),
        (lambda: WLF(300.0, 17.0, 50.0).factor(250.0), r"above T_r - C_2 = 250 K.*got 250 K"),
        (lambda: WLF(300.0, 17.0, 50.0).factor(-20.0), r"above 0 K, got -20 K.*293\.15"),
        (lambda: WLF(300.0, 17.0, 50.0).factor([300.0, np.nan]), "got nan K"),
        (lambda: WLF(300.0, 17.0, 50.0).factor(250.001), r"shift factor is beyond 1e\+100"),
        (lambda: TabulatedShift([300.0], [1.0]), "at least 2, got 1 temp"),
        (lambda: TabulatedShift([300.0, 310.0], [1.0]), "got 2 temperatures and 1 factors"),
        (lambda: TabulatedShift([310.0, 300.0], [1.0, 0.1]), r"temperatures\[1\].*got 300\.0"),
        (lambda: TabulatedShift([300.0, 310.0], [1.0, 2.0]), r"factors\[1\].*got 2\.0"),
        (lambda: TabulatedShift([300.0, 310.0], [1.0, -2.0]), r"factors\[1\].*got -2"),
        (
            lambda: TabulatedShift([300.0, 310.0], [1.0, 0.1]).factor(311.0),
            "between 300 and 310 K, got 311 K",
        ),
    ],
)
def test_what_makes_no_sense_is_refused_with_name_and_value(make, message):
    with pytest.raises(ValueError, match=message):
        make()
