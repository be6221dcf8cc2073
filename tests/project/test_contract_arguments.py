"""What users rely on of what they describe: bodies, creep laws, loads, grids and times."""

from __future__ import annotations

import inspect
import math
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from project.promised_run import BALL, RUBBER

# A handful of steps is enough here; that they are few is warned about, and tested elsewhere.
pytestmark = [
    pytest.mark.filterwarnings("ignore:the load grows from nothing:viscontact.AccuracyWarning"),
    pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning"),
]


LAWS = (
    *("Elastic", "Maxwell", "Zener", "Burgers", "CreepSeries", "RelaxationSeries"),
    *("PowerLaw", "FractionalMaxwell", "FractionalZener"),
    *("TabulatedCreep", "TabulatedRelaxation"),
)


# --- indenters ----------------------------------------------------------------------------------

SHAPES = {
    "sphere": (BALL, (0.011, 0.0)),
    "round punch": (vc.FlatPunch(0.01), (0.008, 0.008)),
    "rectangular punch": (vc.FlatPunch(half_length=0.01, half_width=0.02), (0.0, 0.021)),
    "roller, beside it": (vc.Roller(0.005, 0.01), (0.0, 0.006)),
    "roller, behind its sharp end": (vc.Roller(0.005, 0.01), (0.0101, 0.0)),
    "roller, beyond its crown's section": (vc.Roller(0.005, 0.01, 0.02), (0.029, 0.0)),
    "map": (vc.HeightMap([-1, 0, 1], [-1, 0, 1], [[0, 0, 0], [0, 5, 0], [0, 0, 0]]), (1.1, 0.0)),
    "paraboloid": (vc.Paraboloid(0.01, 0.02), None),
    "cone": (vc.Cone(1.2), None),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_gap_is_zero_at_the_deepest_point_and_infinite_outside_the_outline(shape: str) -> None:
    indenter, outside = SHAPES[shape]
    assert indenter.gap(0.0, 0.0) == 0.0
    x = np.linspace(-0.03, 0.03, 21)
    assert (indenter.gap(x[:, None], x[None, :]) >= 0).all()
    if outside is None:
        assert np.isfinite(indenter.gap(1.0, 1.0))
    else:
        assert indenter.gap(*outside) == np.inf


def test_crown_continues_beyond_the_straight_part_as_eq_13_says() -> None:
    R, L, R_c, x, y = 5e-3, 10e-3, 75e-3, 14e-3, 1e-3
    section = R - R_c + math.sqrt(R_c**2 - (x - L) ** 2)
    expected = R - math.sqrt(section**2 - y**2)
    assert float(vc.Roller(R, L, R_c).gap(-x, y)) == close_to(expected, rel=1e-11)


def test_map_shows_its_peaks_first_and_sums_are_not_zeroed_again() -> None:
    height = np.array([[0.0, 1.0], [2.0, 4.0]])
    surface = vc.HeightMap([0, 1], [0, 1], height)
    corners = surface.gap(np.array([[0.0], [1.0]]), np.array([[0.0, 1.0]]))
    np.testing.assert_array_equal(corners, height.max() - height)
    # the map's peak is at (1, 1), the cone's tip at the origin: nowhere is the sum zero
    total = surface + vc.Cone(math.pi / 4)
    assert float(total.gap(1.0, 1.0)) == close_to(math.sqrt(2))
    assert float(total.gap(0.0, 0.0)) == 4.0


# --- laws and materials -------------------------------------------------------------------------


def test_law_is_the_deviatoric_compliance_and_its_modulus_the_shear_modulus() -> None:
    G, eta, G_2, eta_2, t = 1e9, 5e9, 2e9, 3e9, 2.0
    kelvin = (1 - math.exp(-t * G_2 / eta_2)) / (2 * G_2)
    expected = {
        vc.Elastic(G): 1 / (2 * G),
        vc.Maxwell(G, eta): 1 / (2 * G) + t / (2 * eta),
        vc.Zener(G, G_2, eta_2): 1 / (2 * G) + kelvin,
        vc.Burgers(G, eta, G_2, eta_2): 1 / (2 * G) + t / (2 * eta) + kelvin,
        vc.CreepSeries(3e-10, [2e-10], [4.0], 1e-11): 3e-10
        + 2e-10 * (1 - math.exp(-0.5))
        + 1e-11 * t,
    }
    for law, phi in expected.items():
        assert law(t) == close_to(phi, rel=1e-12)
        assert law.relaxation(0.0) == close_to(1 / (2 * law(0.0)), rel=1e-12)
    series = vc.RelaxationSeries(1e9, [2e9], [4.0])
    assert series.relaxation(t) == close_to(1e9 + 2e9 * math.exp(-0.5), rel=1e-12)


@pytest.mark.parametrize("of", ["__call__", "relaxation"])
def test_law_takes_numbers_lists_and_arrays_of_any_shape(of: str) -> None:
    evaluate = getattr(vc.Zener(1e9, 2e9, 3e9), of)
    assert isinstance(evaluate(1), float)
    assert evaluate([0.0, 1.0]).shape == (2,)
    assert evaluate(np.ones((2, 3))).shape == (2, 3)
    with pytest.raises(ValueError, match=r"-1\.0 s"):
        evaluate(-1.0)


def test_rheometers_compliance_is_half_and_tensile_one_is_one_plus_nu() -> None:
    terms: tuple[Any, ...] = (1e-9, [2e-9], [3.0], 1e-12)
    phi = vc.CreepSeries(*terms)(5.0)
    assert vc.CreepSeries.from_shear(*terms)(5.0) == close_to(phi / 2)
    tensile = vc.CreepSeries.from_uniaxial
    assert tensile(*terms, poisson_ratio=0.3)(5.0) == close_to(1.3 * phi)
    K = 4e9
    assert tensile(*terms, bulk_modulus=K)(5.0) == close_to(1.5 * (phi - 1 / (9 * K)))
    E = vc.Elastic.from_uniaxial(youngs_modulus=3e9, poisson_ratio=0.5)
    assert E.relaxation(0.0) == close_to(1e9)  # G = E / (2 (1 + nu))


@pytest.mark.parametrize("name", LAWS)
def test_every_law_is_made_from_shear_and_from_uniaxial_data(name: str) -> None:
    law = getattr(vc, name)
    arguments = list(inspect.signature(law).parameters)
    shear = list(inspect.signature(law.from_shear).parameters)
    uniaxial = list(inspect.signature(law.from_uniaxial).parameters)
    assert shear == arguments
    assert uniaxial[-2:] == ["poisson_ratio", "bulk_modulus"]
    assert uniaxial[:-2] == [{"shear_modulus": "youngs_modulus"}.get(a, a) for a in arguments]


@pytest.mark.parametrize("value", [True, "1e9", None, [1e9], 1j, math.nan, math.inf, -1.0, 10**400])
def test_law_and_material_refuse_what_is_no_positive_number(value: Any) -> None:
    for make in (
        lambda: vc.Elastic(value),
        lambda: vc.CreepSeries(1e-9, [value], [1.0]),
        lambda: vc.RelaxationSeries(1e9, [1e9], [value]),
        lambda: vc.Material(vc.Elastic(1e9), bulk_modulus=value),
    ):
        with pytest.raises(ValueError, match=r"modulus|amplitudes|times"):
            make()


def test_material_takes_one_of_poissons_ratio_and_bulk_modulus() -> None:
    law = vc.Elastic(3e9)
    by_ratio = vc.Material(law, 0.25).contact_compliance()(0.0)
    assert by_ratio == close_to(0.75 / 6e9)
    assert vc.Material(law, bulk_modulus=5e9).contact_compliance()(0.0) == close_to(by_ratio)
    for wrong in ({}, {"poisson_ratio": 0.3, "bulk_modulus": 1e9}):
        with pytest.raises(ValueError, match="exactly one"):
            vc.Material(law, **wrong)


# --- load histories, grids, times ---------------------------------------------------------------


def test_history_is_zero_before_linear_between_jumping_at_and_held_after_its_points() -> None:
    load = vc.ForceHistory([1, 2, 2, 3], [10, 20, 5, 8], eccentricity_x=[0, 1e-3, 1e-3, 1e-3])
    assert load.force_at([0.5, 1.0, 1.5, 2.0, 2.5, 9.0]).tolist() == [0, 10, 15, 5, 6.5, 8]
    assert load.at(2.0, side="left").force == 20
    assert load.at(1.5).eccentricity_x == 5e-4
    assert load.at(1.5).tilt_x is None
    assert vc.ForceHistory([0, 1], 3.0, tilt_y=[0, 2e-3]).at(0.5).tilt_y == 1e-3


def test_force_below_1e_minus_12_of_the_largest_counts_as_zero() -> None:
    load = vc.ForceHistory([0, 1, 2], [1.0, 0.9e-12, 1.1e-12])
    assert load.force_at([1.0, 2.0]).tolist() == [0.0, 1.1e-12]


def test_shapes_of_histories() -> None:
    assert vc.step(4.0).force_at([0.0, 9.0]).tolist() == [4, 4]
    assert vc.ramp(4.0, 2.0).force_at([1.0, 2.0, 9.0]).tolist() == [2, 4, 4]
    assert vc.triangle(4.0, 2.0).force_at([1.0, 2.0, 3.0, 4.0, 9.0]).tolist() == [2, 4, 2, 0, 0]
    assert vc.triangle(4.0, 2.0, 4.0).force_at(4.0) == 2.0
    tail = {"eccentricity_x": 1e-3, "tilt_y": 2e-3}
    for load in (vc.step(1.0, **tail), vc.ramp(1.0, 1.0, **tail), vc.triangle(1.0, 1.0, **tail)):
        assert (load.at(0.0).eccentricity_x, load.at(0.0).tilt_y) == (1e-3, 2e-3)


def test_grid_has_cell_centres_centred_on_the_origin() -> None:
    grid = vc.Grid((4, 5), (8.0, 5.0))
    assert grid.x.tolist() == [-3, -1, 1, 3]  # an even number: no cell at 0
    assert grid.y.tolist() == [-2, -1, 0, 1, 2]


def test_instants_begin_at_0_and_end_at_the_end() -> None:
    assert vc.uniform_times(10.0, 4).tolist() == [0, 2.5, 5, 7.5, 10]
    np.testing.assert_allclose(vc.log_times(1.0, 1000.0, 4), [0, 1, 10, 100, 1000], rtol=1e-14)


@pytest.mark.parametrize("value", [True, "1", None, [1.0], 1j, math.nan, math.inf, -1.0, 10**400])
def test_lengths_forces_and_times_refuse_what_is_no_positive_number(value: Any) -> None:
    for make in (
        lambda: vc.Sphere(value),
        lambda: vc.Cone(value),
        lambda: vc.ramp(1.0, value),
        lambda: vc.uniform_times(value, 2),
        lambda: vc.uniform_times(1.0, value),
    ):
        with pytest.raises(ValueError, match=r"must|missing"):
            make()


@pytest.mark.parametrize("value", [True, "1", None, [1.0], 1j, math.nan, math.inf, 10**400])
def test_forces_refuse_what_is_no_number(value: Any) -> None:
    with pytest.raises(ValueError, match=r"must|missing"):
        vc.step(value)


def test_auto_grid_holds_the_contact_and_follows_its_tolerance() -> None:
    coarse, fine = (vc.auto_grid(BALL, RUBBER, vc.step(0.1), tolerance=t) for t in (0.04, 0.01))
    # Hertz with Phi(inf) = 1/G: a^3 = 3 R W Phi / 8 (eq. 16 of Spinu & Cerlinca 2018)
    radius = (3 * 0.01 * 0.1 * 1e-6 / 8) ** (1 / 3)
    assert min(fine.size) > 2 * radius
    assert fine.shape[0] > coarse.shape[0]
