"""The contact compliance: one function of time from shear and volume, for one body or two."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.bodies.materials.material import Material, uniaxial_compression
from viscontact.laws import (
    WLF,
    Arrhenius,
    BesideSpring,
    Burgers,
    CreepSeries,
    Elastic,
    Maxwell,
    RelaxationSeries,
    TabulatedCreep,
    TabulatedRelaxation,
    TabulatedShift,
    Zener,
)
from viscontact.results.descriptions import describe, rebuild

T = np.array([0.0, 0.01, 0.7, 3.0, 40.0, 1e4])


def elastic_compliance(shear_modulus, bulk_modulus):
    """(1 - nu)/(2G) with nu from G and K."""
    G, K = shear_modulus, bulk_modulus
    nu = (3 * K - 2 * G) / (2 * (3 * K + G))
    return (1 - nu) / (2 * G)


def talbot(transform, t, terms=24):
    """Numerical inverse Laplace transform, fixed Talbot.

    J. Abate, P. P. Valko, Int. J. Numer. Meth. Engng 60 (2004) 979-993.
    """
    r = 2 * terms / (5 * t)
    theta = np.arange(1, terms) * np.pi / terms
    cot = 1 / np.tan(theta)
    s = r * theta * (cot + 1j)
    sigma = theta + (theta * cot - 1) * cot
    inner = np.real(np.exp(t * s) * transform(s) * (1 + 1j * sigma)).sum()
    return r / terms * (0.5 * np.real(np.exp(r * t) * transform(r + 0j)) + inner)


# Laws with their G~(s) = s L[G], written down from the springs and dashpots themselves.
SPRINGS = [
    (Maxwell(3.0, 7.0), lambda s: 1 / (1 / 3.0 + 1 / (7.0 * s))),
    (Zener(3.0, 0.4, 7.0), lambda s: 1 / (1 / 3.0 + 1 / (0.4 + 7.0 * s))),
    (
        Burgers(3.0, 50.0, 0.4, 7.0),
        lambda s: 1 / (1 / 3.0 + 1 / (50.0 * s) + 1 / (0.4 + 7.0 * s)),
    ),
    (
        RelaxationSeries(0.5, [2.0, 3.0], [1.0, 10.0]),
        lambda s: 0.5 + 2.0 * s / (s + 1) + 30.0 * s / (10 * s + 1),
    ),
    (CreepSeries(0.0, [1.25], [17.5]), lambda s: 0.4 + 7.0 * s),  # Kelvin-Voigt
]
each_spring = pytest.mark.parametrize(
    ("law", "carson"), SPRINGS, ids=[type(law).__name__ for law, _ in SPRINGS]
)


@each_spring
@pytest.mark.parametrize("bulk", [0.05, 2.0, 500.0])
@pytest.mark.parametrize("t", [0.01, 1.0, 30.0])
def test_bulk_modulus_compliance_is_the_inverse_transform_of_the_correspondence(
    law, carson, bulk, t
):
    def transform(s):
        G, K = carson(s), bulk
        return (3 * K + 4 * G) / (4 * s * G * (3 * K + G))

    # Talbot with 24 terms has some 1e-9 left in double precision.
    J = Material(law, bulk_modulus=bulk).contact_compliance()
    assert J(t) == close_to(talbot(transform, t), rel=1e-7)


@given(
    st.lists(st.tuples(st.floats(-6, 0), st.floats(-6, 6)), max_size=8),
    st.floats(-3, 0),
    st.floats(-6, 3),
)
def test_bulk_modulus_compliance_starts_and_ends_elastic(exponents, equilibrium, bulk):
    law = RelaxationSeries(
        10.0**equilibrium, [10.0**g for g, _ in exponents], [10.0**tau for _, tau in exponents]
    )
    K = 10.0**bulk
    J = Material(law, bulk_modulus=K).contact_compliance()
    G0, G_inf = law.equilibrium + sum(law.moduli), law.equilibrium
    assert J(0.0) == close_to(elastic_compliance(G0, K), rel=1e-12)
    assert J(np.inf) == close_to(elastic_compliance(G_inf, K), rel=1e-12)
    assert J.relaxation(0.0) == close_to(1 / J(0.0), rel=1e-12)
    assert J.relaxation(np.inf) == close_to(1 / J(np.inf), rel=1e-12)


@each_spring
def test_stiff_bulk_is_incompressible(law, carson):
    stiff = Material(law, bulk_modulus=1e12).contact_compliance()
    rubber = Material(law, poisson_ratio=0.5).contact_compliance()
    # The difference is 3/(4 (3K + G)), and vanishes with K.
    np.testing.assert_allclose(stiff(T), rubber(T), rtol=1e-10, atol=1e-12)


def test_constant_poisson_ratio_scales_phi():
    law = Burgers(3.0, 50.0, 0.4, 7.0)
    J = Material(law, 0.38).contact_compliance()
    np.testing.assert_allclose(J(T), 0.62 * law(T), rtol=1e-14)
    # M is the inverse of (1 - nu)/(2 G~): 2 G(t)/(1 - nu).
    np.testing.assert_allclose(J.relaxation(T), 2 * law.relaxation(T) / 0.62, rtol=1e-12)


def test_literal_and_consistent_readings_of_pmma_differ_by_one_plus_nu():
    """Eq. (15) taken as Phi, and taken as the tensile compliance that the data are."""
    data = (5.545e-10, [6.17e-11, 8.38e-11], [10.0, 1 / 7.47e-3])
    literal = Material(CreepSeries(*data), 0.38).contact_compliance()
    tensile = CreepSeries.from_uniaxial(*data, poisson_ratio=0.38)
    consistent = Material(tensile, 0.38).contact_compliance()
    np.testing.assert_allclose(consistent(T) / literal(T), 1.38, rtol=1e-14)
    # (1 - nu²) D(0): the plane-strain compliance of Hertz.
    assert consistent(0.0) == close_to((1 - 0.38**2) * 5.545e-10, rel=1e-14)


def test_two_elastic_bodies_have_the_contact_modulus_of_hertz():
    """1/E* = (1 - nu_1²)/E_1 + (1 - nu_2²)/E_2: Johnson (1985), eq. 4.22."""
    steel, glass = Elastic.from_uniaxial(210e9, 0.3), Elastic.from_uniaxial(70e9, 0.22)
    both = Material(steel, 0.3).contact_compliance() + Material(glass, 0.22).contact_compliance()
    assert both(0.0) == close_to((1 - 0.3**2) / 210e9 + (1 - 0.22**2) / 70e9, rel=1e-14)


def test_compliances_of_two_creeping_bodies_add():
    one = Material(Zener(3.0, 0.4, 7.0), 0.3).contact_compliance()
    two = Material(Burgers(1.0, 9.0, 0.2, 3.5), 0.5).contact_compliance()
    both = one + two
    np.testing.assert_allclose(both(T), one(T) + two(T), rtol=1e-14)
    assert both.times.tolist() == [17.5]  # 7/0.4 = 3.5/0.2: merged


def test_contact_compliance_is_ready_for_time_stepping():
    J = SeriesCompliance(1.0, [2.0, 0.0, 3.0], [5.0, 4.0, 1.0], 0.5)
    assert J.amplitudes.dtype == J.times.dtype == np.float64
    assert J.times.tolist() == [1.0, 5.0]
    assert J.amplitudes.tolist() == [3.0, 2.0]
    assert (J.instant, J.fluidity) == (1.0, 0.5)
    assert type(J(1.0)) is float
    assert J([[0.0, 1.0]]).shape == (1, 2)
    with pytest.raises(ValueError, match="read-only"):
        J.amplitudes[0] = 1.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        J.instant = 2.0


def test_contact_compliance_without_instant_part_creeps_but_does_not_relax():
    J = Material(CreepSeries(0.0, [2.0], [3.0]), 0.5).contact_compliance()
    assert J(0.0) == 0.0
    with pytest.raises(ValueError, match="instant compliance > 0"):
        J.relaxation(1.0)


def test_materials_are_frozen_hashable_and_rebuilt_from_their_fields():
    for material in (Material(Maxwell(3.0, 7.0), 0.3), Material(Elastic(1.0), bulk_modulus=2.0)):
        fields = {f.name: getattr(material, f.name) for f in dataclasses.fields(material)}
        assert Material(**fields) == material
        assert hash(Material(**fields)) == hash(material)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Material(Elastic(1.0)), "Material: give exactly one"),
        (lambda: Material(Elastic(1.0), 0.3, bulk_modulus=1.0), "Material: give exactly one"),
        (lambda: Material(Elastic(1.0), 0.51), r"poisson_ratio must lie .*got 0\.51"),
        (lambda: Material(Elastic(1.0), -1.0), r"poisson_ratio must lie .*got -1\.0"),
        (lambda: Material(Elastic(1.0), float("nan")), r"poisson_ratio must lie .*got nan"),
        (lambda: Material(Elastic(1.0), "0,3"), "poisson_ratio must be a number"),
        (lambda: Material(Elastic(1.0), bulk_modulus=0.0), r"bulk_modulus must .*got 0 Pa"),
        (lambda: Material(Elastic(1.0), 0.3, thickness=0.0), r"Material: thickness .*got 0 m"),
        (lambda: Material(Elastic(1.0), 0.3, thickness=np.inf), r"Material: thickness .*got inf"),
        (
            lambda: Material(Elastic(1.0), 0.3, thickness="1 cm"),
            r"Material: thickness .*positive finite number in m",
        ),
        (lambda: Material(1e9, 0.3), r"Material: law must be a creep law"),
        (lambda: SeriesCompliance(-1.0, [], []), r"SeriesCompliance: instant"),
        (lambda: SeriesCompliance(1.0, [1.0], []), "equal lengths"),
        (lambda: SeriesCompliance(1.0, [], [])(-1.0), "t: times since the step"),
    ],
)
def test_bad_arguments_are_refused_with_name_and_value(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_bulk_modulus_is_taken_by_keyword_only():
    with pytest.raises(TypeError):
        Material(Elastic(1.0), None, 2.0)


def test_thickness_is_given_by_keyword_and_changes_no_compliance():
    thin = Material(Zener(3.0, 0.4, 7.0), 0.3, thickness=0.01)
    assert thin.thickness == 0.01
    endless = Material(Zener(3.0, 0.4, 7.0), 0.3)
    assert endless.thickness is None
    assert thin.contact_compliance()(T).tolist() == endless.contact_compliance()(T).tolist()


def test_material_travels_with_its_thickness_and_older_descriptions_are_read():
    thin = Material(Maxwell(3.0, 7.0), 0.3, thickness=0.01)
    assert rebuild(json.loads(json.dumps(describe(thin)))) == thin
    # As results before it have it: without the key.
    older = {
        "type": "Material",
        "law": {"type": "Maxwell", "shear_modulus": 3.0, "viscosity": 7.0},
        "poisson_ratio": 0.3,
        "bulk_modulus": None,
        "measured_until": 5.0,
    }
    assert rebuild(older) == Material(Maxwell(3.0, 7.0), 0.3, measured_until=5.0)


def test_table_knows_from_when_on_it_rests_on_data():
    table = TabulatedCreep([0.5, 1.0, 10.0], [1.0, 2.0, 3.0])
    modulus = TabulatedRelaxation([0.1, 1.0, 10.0], [3.0, 2.0, 1.0])
    assert Material(table, 0.3).known_from == 0.5
    assert Material(modulus, 0.3).known_from == 0.1
    assert Material(BesideSpring(modulus, 1.0), 0.3).known_from == 0.1
    assert Material(TabulatedCreep([0.0, 1.0, 10.0], [1.0, 2.0, 3.0]), 0.3).known_from == 0.0
    assert Material(Maxwell(3.0, 7.0), 0.3).known_from == 0.0


SHIFTS = [
    WLF(298.15, 17.44, 51.6),
    Arrhenius(298.15, 80e3),
    TabulatedShift([278.15, 298.15, 348.15], [7.5, 1.0, 1e-3]),
]


@pytest.mark.parametrize("shift", SHIFTS, ids=lambda each: type(each).__name__)
@given(
    law=st.sampled_from([law for law, _ in SPRINGS]),
    temperature=st.floats(278.15, 348.15),
    t=st.floats(0.0, 1e6),
)
def test_material_at_a_temperature_has_the_law_slowed_by_the_factor(shift, law, temperature, t):
    material = Material(law, bulk_modulus=8.0, measured_until=100.0, notes=["a"], shift=shift)
    factor = shift.factor(temperature)
    there = material.at(temperature)
    assert there.law(t) == law.slowed(factor)(t)
    assert there.measured_until == factor * 100.0
    moved = shift.referred_to(temperature)
    assert there == dataclasses.replace(
        material, law=there.law, measured_until=there.measured_until, shift=moved
    )
    # On to a second temperature as from the reference at once.
    once, twice = material.at(310.0).law(t), there.at(310.0).law(t)
    assert twice == close_to(once, rel=1e-9)


@pytest.mark.parametrize("shift", SHIFTS, ids=lambda each: type(each).__name__)
@pytest.mark.parametrize("law", [law for law, _ in SPRINGS])
@given(t=st.floats(0.0, 1e6))
def test_material_at_the_reference_temperature_has_its_own_law(shift, law, t):
    material = Material(law, 0.3, shift=shift)
    assert material.at(298.15).law(t) == law(t)
    assert material.at(298.15) == material


def test_material_without_a_shift_has_no_other_temperature():
    with pytest.raises(ValueError, match=r"shift must be given .* at 313\.15 K, got None; write"):
        Material(Zener(3.0, 0.4, 7.0), 0.3).at(313.15)
    with pytest.raises(ValueError, match=r"must be WLF, Arrhenius or TabulatedShift, got 2\.0"):
        Material(Zener(3.0, 0.4, 7.0), 0.3, shift=2.0)
    with pytest.raises(ValueError, match=r"must be used between 278\.15 and 348\.15 K"):
        Material(Zener(3.0, 0.4, 7.0), 0.3, shift=SHIFTS[2]).at(273.15)


@pytest.mark.parametrize("shift", SHIFTS, ids=lambda each: type(each).__name__)
def test_results_keep_the_shift_of_a_material_that_has_one(shift):
    plain = Material(Zener(3.0, 0.4, 7.0), 0.3)
    assert "shift" not in describe(plain)  # the text of results from before
    described = json.loads(json.dumps(describe(dataclasses.replace(plain, shift=shift))))
    assert described["shift"]["type"] == type(shift).__name__
    assert rebuild(described) == dataclasses.replace(plain, shift=shift)
    assert rebuild(describe(plain)) == plain


@pytest.mark.parametrize("volume", [{"bulk_modulus": 5e9}, {"poisson_ratio": 0.25}])
def test_uniaxial_compression_is_that_of_the_longitudinal_modulus(volume):
    """K + 4G/3 = 9 GPa, of which both are the same elastic body."""
    material = Material(Elastic(3e9), **volume)
    assert uniaxial_compression(material)(0.0) == close_to(1 / 9e9, rel=1e-12)
