"""Vertical shift: stiffer laws, tables with two factors, materials at another temperature."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.laws import (
    Burgers,
    CreepSeries,
    Elastic,
    FractionalMaxwell,
    FractionalZener,
    Maxwell,
    PowerLaw,
    RelaxationSeries,
    TabulatedCreep,
    TabulatedRelaxation,
    TabulatedShift,
    Zener,
)

LAWS = [
    Burgers(1e9, 1e12, 2e9, 1e10),
    CreepSeries(1e-9, [2e-9], [5.0], 1e-12),
    Elastic(1e6),
    FractionalMaxwell(1e9, 3.0, 0.4),
    FractionalZener(1e9, 1e7, 2.0, 0.3),
    Maxwell(1e9, 1e10),
    PowerLaw(1e-9, 0.2, 1.0, 1e-10),
    RelaxationSeries(1e6, [2e6, 3e6], [0.1, 4.0]),
    TabulatedCreep([0.1, 1.0, 10.0], [1e-9, 2e-9, 3e-9]),
    TabulatedRelaxation([0.1, 1.0, 10.0], [3e9, 2e9, 1e9]),
    Zener(1e9, 2e9, 1e9),
]
T = np.array([0.2, 1.0, 7.0])


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_a_stiffened_law_creeps_less_by_the_factor_at_all_times(law):
    """G and 1/Phi are proportional to the factor; the times are the same."""
    stiff = law.stiffened(2.5)
    assert type(stiff) is type(law)
    np.testing.assert_allclose(stiff(T), law(T) / 2.5, rtol=1e-12)
    np.testing.assert_allclose(stiff.relaxation(T), 2.5 * law.relaxation(T), rtol=1e-6)


def test_a_material_at_another_temperature_has_both_factors():
    shift = TabulatedShift([283.15, 293.15, 313.15], [10.0, 1.0, 0.01], [0.9, 1.0, 1.21])
    material = vc.Material(Maxwell(1e9, 1e10), 0.4, shift=shift, measured_until=100.0)
    warm = material.at(303.15)
    # Half-way in temperature: a_T = sqrt(0.01), b_T = sqrt(1.21).
    np.testing.assert_allclose(warm.law(T), Maxwell(1e9, 1e10)(T / 0.1) / 1.1, rtol=1e-12)
    assert warm.measured_until == close_to(10.0, rel=1e-12)
    assert shift.vertical_factor(283.15) == close_to(0.9, rel=1e-12)
    assert vc.WLF(293.15, 8.86, 101.6).vertical_factor([290.0, 300.0]).tolist() == [1.0, 1.0]


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: TabulatedShift([280.0, 290.0], [2.0, 1.0], [1.0]), "one factor for each of the 2"),
        (lambda: TabulatedShift([280.0, 290.0], [2.0, 1.0], [1.0, -1.0]), r"vertical\[1\]"),
        (lambda: TabulatedShift([280.0, 290.0], [2.0, 1.0]).vertical_factor(300.0), "between 280"),
        (lambda: Elastic(1e6).stiffened(0.0), "stiffened: factor"),
    ],
)
def test_wrong_vertical_factors_are_refused(wrong, said):
    with pytest.raises(ValueError, match=said):
        wrong()
