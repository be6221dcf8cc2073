"""Gaps of the indenters against exact arithmetic, series expansions and symmetry."""

import dataclasses
import math
from decimal import Decimal, localcontext

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import RegularGridInterpolator

from closeness import close_to
from viscontact.indenters import (
    CombinedIndenter,
    Cone,
    FlatPunch,
    HeightMap,
    Indenter,
    Paraboloid,
    Roller,
    Sphere,
)

CROWNED = Roller(radius=5e-3, half_length=9.565e-3, crown_radius=75e-3)
SYMMETRIC = [
    Sphere(5e-3),
    Paraboloid(5e-3, 20e-3),
    Cone(1.2),
    FlatPunch(3e-3),
    FlatPunch(half_length=6e-3, half_width=2e-3),
    Roller(5e-3, half_length=6e-3),
    CROWNED,
    Sphere(5e-3) + Cone(1.5),
]
EPS = np.finfo(float).eps

lengths = st.floats(-30e-3, 30e-3)


def eq_13_in_120_digits(roller: Roller, x: float, y: float) -> Decimal:
    """Eq. (13) as it is printed, the floats given taken as exact.

    Cancellation costs 40 of the digits at y = 1e-20 m.
    """
    with localcontext(prec=120):
        R, L, R_c = (
            Decimal(roller.radius),
            Decimal(roller.half_length),
            Decimal(roller.crown_radius),
        )
        x, y = abs(Decimal(x)), Decimal(y)
        R_x = R if x <= L else R - R_c + (R_c**2 - (x - L) ** 2).sqrt()
        return R - (R_x**2 - y**2).sqrt()


def slopes(errors: np.ndarray) -> np.ndarray:
    """Orders at which errors fall when the argument is halved each time."""
    return np.log2(errors[:-1] / errors[1:])


# -- laws for every shape ------------------------------------------------------------------


@pytest.mark.parametrize("indenter", SYMMETRIC, ids=repr)
@given(x=lengths, y=lengths)
def test_gap_is_never_negative_and_even_in_x_and_y(indenter, x, y):
    gap = float(indenter.gap(x, y))
    assert gap >= 0
    assert indenter.gap([-x, x, -x], [y, -y, -y]).tolist() == [gap] * 3


@pytest.mark.parametrize("indenter", SYMMETRIC, ids=repr)
def test_gap_is_zero_at_the_deepest_point(indenter):
    assert float(indenter.gap(0.0, 0.0)) == 0.0


@pytest.mark.parametrize("indenter", SYMMETRIC, ids=repr)
def test_gap_broadcasts_and_agrees_with_single_points(indenter):
    x, y = np.linspace(-8e-3, 8e-3, 5), np.linspace(-4e-3, 4e-3, 3)
    gap = indenter.gap(x[:, None], y[None, :])
    assert gap.shape == (5, 3)
    assert gap.dtype == np.float64
    assert gap.tolist() == [[float(indenter.gap(a, b)) for b in y] for a in x]


@given(x=lengths, y=lengths)
@pytest.mark.parametrize("round_one", [Sphere(5e-3), Cone(0.7), FlatPunch(3e-3)], ids=repr)
def test_round_shapes_are_even_under_exchange_of_x_and_y(round_one, x, y):
    assert float(round_one.gap(x, y)) == float(round_one.gap(y, x))


@pytest.mark.parametrize("indenter", SYMMETRIC, ids=repr)
def test_indenters_are_frozen_and_rebuilt_from_their_fields(indenter):
    fields = {field.name: getattr(indenter, field.name) for field in dataclasses.fields(indenter)}
    assert type(indenter)(**fields) == indenter
    with pytest.raises(dataclasses.FrozenInstanceError):
        indenter.radius = 1.0


# -- sphere, paraboloid, cone --------------------------------------------------------------


@given(part=st.floats(1e-14, 1.0), radius=st.floats(1e-6, 1e3))
def test_sphere_keeps_all_digits_from_the_apex_to_the_rim(part, radius):
    # Five roundings lie between the arguments and the gap, of half a unit each, and the
    # square root halves those before it.
    s = min(part * radius, radius)
    with localcontext(prec=120):
        R, r = Decimal(radius), Decimal(s)
        exact = R - (R * R - r * r).sqrt()
        error = abs(Decimal(float(Sphere(radius).gap(s, 0.0))) - exact) / exact
    assert error < 4 * EPS


def test_sphere_departs_from_the_paraboloid_by_the_fourth_order_term():
    """R - sqrt(R² - r²) = r²/(2R) + r⁴/(8R³) + r⁶/(16R⁵) + ...: its binomial series."""
    R, r = 1.0, 0.4 / 2.0 ** np.arange(4)
    departure = Sphere(R).gap(r, 0.0) - Paraboloid(R, R).gap(r, 0.0)
    rest = departure - r**4 / (8 * R**3)
    # The next term adds (r/R)² / 2 at most to a ratio, 0.08 at the coarsest.
    assert slopes(departure) == close_to([4, 4, 4], abs=0.12)
    assert slopes(rest) == close_to([6, 6, 6], abs=0.2)
    assert rest[-1] == close_to(r[-1] ** 6 / (16 * R**5), rel=5e-3)


def test_sphere_ends_at_its_radius():
    assert Sphere(2.0).gap([2.0, np.nextafter(2.0, 3.0)], 0.0).tolist() == [2.0, math.inf]


def test_paraboloid_has_its_radii_along_its_own_axes():
    paraboloid = Paraboloid(radius_x=2.0, radius_y=8.0)
    assert paraboloid.gap([2.0, 0.0], [0.0, 4.0]).tolist() == [1.0, 1.0]
    assert paraboloid.radius_of_curvature == 2.0


def test_sharper_cone_has_the_larger_gap():
    # 30 degrees from axis to flank: tan = 1/sqrt(3); two roundings.
    assert float(Cone(math.radians(30)).gap(0.6, 0.8)) == close_to(math.sqrt(3), rel=1e-15)
    assert float(Cone(0.3).gap(1.0, 0.0)) > float(Cone(1.3).gap(1.0, 0.0))


# -- roller ----------------------------------------------------------------------------------


@given(x=st.floats(0, 20e-3), y=st.floats(1e-20, 4e-3))
def test_roller_follows_eq_13(x, y):
    """Eq. (13) of the founding paper, on exact numbers.

    Either drop costs some four roundings; that of the section also inherits the rounding of
    its radius, eps/2 R at most, by a slope of up to two: below eight units of the gap.
    """
    exact = eq_13_in_120_digits(CROWNED, x, y)
    assert abs(Decimal(float(CROWNED.gap(x, y))) / exact - 1) < 8 * EPS


@pytest.mark.parametrize("y", [1e-11, 1e-7, 1e-5])
def test_roller_does_not_cancel_near_its_generating_line(y):
    # As printed, R - sqrt(R² - y²) is 0 here at y = 1e-11: all digits lost.
    assert float(CROWNED.gap(0.0, y)) == close_to(
        float(eq_13_in_120_digits(CROWNED, 0, y)), rel=4 * EPS
    )
    if y == 1e-11:
        R = CROWNED.radius
        assert R - math.sqrt(R**2 - y**2) == 0.0


def test_roller_is_a_parabola_across_to_second_order():
    R, y = 5e-3, 1e-3 / 2.0 ** np.arange(5)
    error = Roller(R, half_length=1.0).gap(0.0, y) / (y**2 / (2 * R)) - 1
    assert slopes(error) == close_to([2] * 4, abs=0.03)  # (y/R)²/2 = 0.02 at the coarsest
    assert error[-1] == close_to(y[-1] ** 2 / (4 * R**2), rel=1e-3)


@pytest.mark.parametrize("y", [0.0, 2e-3])
def test_crown_continues_the_straight_part_without_step_or_kink(y):
    """At y = 0 the crown drops s²/(2 R_c) beyond the end; off centre by R/R(y) more."""
    L, R, R_c = CROWNED.half_length, CROWNED.radius, CROWNED.crown_radius
    s = 1e-3 / 2.0 ** np.arange(5)
    rise = CROWNED.gap(L + s, y) - CROWNED.gap(L, y)
    slope = rise / s
    # To the leading order; the next is (s/R_c)² and s²/(R R_c), 3e-3 at the coarsest.
    leading = s**2 / (2 * R_c) * R / math.sqrt(R**2 - y**2)
    assert rise == close_to(leading, rel=5e-3)
    assert slopes(slope) == close_to([1] * 4, abs=0.01)  # the slope itself dies out


def test_roller_is_straight_within_its_half_length():
    x = np.linspace(-CROWNED.half_length, CROWNED.half_length, 9)
    assert CROWNED.gap(x, 1e-3).tolist() == [float(CROWNED.gap(0.0, 1e-3))] * 9


def test_roller_without_crown_ends_sharply():
    roller = Roller(radius=5.0, half_length=2.0)
    assert roller.gap([-2.0, 2.0, 2.0 + 1e-9], 3.0).tolist() == [1.0, 1.0, math.inf]


def test_roller_ends_where_its_section_or_its_crown_ends():
    roller = Roller(radius=5.0, half_length=1.0, crown_radius=13.0)  # R(x) = 4 at x = 6
    assert roller.gap(6.0, [0.0, 4.0, 4.001]).tolist() == [1.0, 5.0, math.inf]
    assert float(roller.gap(0.0, 5.001)) == math.inf
    # R(x) = 0 where the crown has dropped by R: s² = 13² - 8², which ends the section.
    end = 1.0 + math.sqrt(13.0**2 - 8.0**2)
    assert float(roller.gap(end - 1e-6, 0.0)) == close_to(5.0, abs=1e-5)
    assert float(roller.gap(end + 1e-6, 0.0)) == math.inf
    # A crown tighter than the roller is thick ends first.
    short = Roller(radius=5.0, half_length=1.0, crown_radius=2.0)
    assert short.gap([3.0, 3.001], 0.0).tolist() == [2.0, math.inf]


# -- flat punch ------------------------------------------------------------------------------


def test_flat_punch_covers_its_edge_and_nothing_beyond():
    x, y = [2.0, 2.001, 0.0, 0.0], [1.0, 0.0, 1.0, 1.001]
    rectangular = FlatPunch(half_length=2.0, half_width=1.0)
    assert rectangular.gap(x, y).tolist() == [0.0, math.inf, 0.0, math.inf]
    assert FlatPunch(5.0).gap([3.0, 3.0], [4.0, 4.001]).tolist() == [0.0, math.inf]


# -- height map ------------------------------------------------------------------------------


def uneven_map(seed: int = 4) -> HeightMap:
    random = np.random.default_rng(seed)
    x, y = np.cumsum(random.uniform(0.1, 1, 12)), np.cumsum(random.uniform(0.1, 1, 9))
    return HeightMap(x, y, random.normal(size=(12, 9)))


def test_height_map_is_bilinear_as_in_scipy():
    surface = uneven_map()
    random = np.random.default_rng(5)
    x = random.uniform(surface.x[0], surface.x[-1], 400)
    y = random.uniform(surface.y[0], surface.y[-1], 400)
    scipys = RegularGridInterpolator((surface.x, surface.y), surface.height)((x, y))
    # Heights of order one: some roundings.
    assert surface.gap(x, y) == close_to(surface.height.max() - scipys, abs=1e-14)


def test_height_map_returns_its_own_points_and_touches_at_the_highest():
    surface = uneven_map()
    gap = surface.gap(surface.x[:, None], surface.y)
    assert np.array_equal(gap, surface.height.max() - surface.height)
    assert gap.min() == 0.0


@given(x=st.floats(-1, 12), y=st.floats(-1, 9))
def test_height_map_has_a_gap_exactly_where_it_was_measured(x, y):
    surface = uneven_map()
    inside = surface.x[0] <= x <= surface.x[-1] and surface.y[0] <= y <= surface.y[-1]
    gap = float(surface.gap(x, y))
    assert gap >= 0
    assert math.isfinite(gap) == inside


def test_height_map_of_a_paraboloid_errs_by_an_eighth_of_step_squared_times_curvature():
    """Linear interpolation errs by h² κ / 8 midway, in either direction: textbook bound, sharp."""
    R_x, R_y, errors = 2.0, 5.0, []
    for cells in (8, 16, 32):
        line = np.linspace(-1, 1, cells + 1)
        height = -Paraboloid(R_x, R_y).gap(line[:, None], line)
        middle = line[:-1] + 1 / cells
        surface = HeightMap(line, line, height)
        error = surface.gap(middle[:, None], middle) - Paraboloid(R_x, R_y).gap(
            middle[:, None], middle
        )
        step = 2 / cells
        assert error == close_to(step**2 / 8 * (1 / R_x + 1 / R_y), rel=1e-10)
        errors.append(error.max())
    assert slopes(np.array(errors)) == close_to([2, 2], abs=1e-9)


def test_height_map_keeps_its_own_read_only_copy():
    height = np.zeros((2, 2))
    surface = HeightMap([0, 1], [0, 1], height)
    height[0, 0] = 7.0
    assert surface.height[0, 0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        surface.height[0, 0] = 7.0


def test_height_maps_compare_by_value():
    assert uneven_map() == uneven_map()
    assert hash(uneven_map()) == hash(uneven_map())
    assert uneven_map() != uneven_map(seed=6)
    assert uneven_map() != Sphere(1.0)


# -- sums ------------------------------------------------------------------------------------


def test_gaps_of_a_sum_add_and_are_not_shifted_to_zero():
    hollow = HeightMap([-2.0, 0.0, 2.0], [-2.0, 2.0], [[1, 1], [0, 0], [1, 1]])
    both = Paraboloid(1.0, 1.0) + hollow
    assert both.gap([0.0, 1.0], 0.0).tolist() == [1.0, 1.0]
    assert float(both.gap(3.0, 0.0)) == math.inf


def test_a_sum_of_sums_is_one_flat_sum():
    a, b, c, d = Sphere(1.0), Cone(1.0), FlatPunch(1.0), Sphere(2.0)
    parts = ((a + b) + (c + d)).parts
    assert parts == (a, b, c, d)
    assert CombinedIndenter((a + b, c)).parts == (a, b, c)


def test_curvatures_of_a_sum_add_axis_by_axis():
    crossed = Paraboloid(1.0, 2.0) + Paraboloid(4.0, 1.0)
    # along x: 1 + 1/4; along y: 1/2 + 1
    assert crossed.curvatures == (1.25, 1.5)
    assert crossed.radius_of_curvature == 1 / 1.5
    assert (Sphere(3.0) + Roller(6.0, 1.0)).radius_of_curvature == close_to(2.0, rel=EPS)


def test_radius_of_curvature_is_infinite_where_it_means_nothing():
    for flat in (Cone(1.0), FlatPunch(1.0), uneven_map()):
        assert flat.radius_of_curvature == math.inf
    assert Sphere(2.0).radius_of_curvature == 2.0
    assert CROWNED.radius_of_curvature == CROWNED.radius


def test_a_users_own_shape_needs_only_a_gap():
    class Wedge(Indenter):
        def gap(self, x, y):
            return np.abs(y) + 0.0 * np.asarray(x)

    assert (Wedge() + Wedge()).gap(1.0, 2.0) == 4.0


def test_adding_a_number_is_refused():
    with pytest.raises(TypeError):
        Sphere(1.0) + 1.0


# -- refusals --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("bad", "shown"),
    [
        *((0.0, "0 "), (-1e-3, "-1 m"), (math.nan, "nan"), (-math.inf, "-inf")),
        *((True, "True"), ("5 mm", "'5 mm'"), (None, "None"), ([1.0], "[1.0]")),
    ],
)
@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda bad: Sphere(bad), "Sphere: radius"),
        (lambda bad: Paraboloid(1.0, bad), "Paraboloid: radius_y"),
        (lambda bad: Roller(bad, 1.0), "Roller: radius"),
        (lambda bad: Roller(1.0, bad), "Roller: half_length"),
        (lambda bad: FlatPunch(half_length=bad, half_width=1.0), "half_length"),
        (lambda bad: Cone(bad), "Cone: half_angle"),
    ],
)
def test_bad_length_is_refused_with_its_name_and_value(make, name, bad, shown):
    with pytest.raises(ValueError, match=name) as refusal:
        make(bad)
    assert shown in str(refusal.value)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: Sphere(math.inf), "Sphere: radius"),
        (lambda: Paraboloid(math.inf, math.inf), "one of radius_x and radius_y must be finite"),
        (lambda: Roller(math.inf, 1.0), "Roller: radius"),
        (lambda: Roller(1.0, math.inf), "Roller: half_length"),
        (lambda: FlatPunch(half_length=math.inf, half_width=1.0), "half_length"),
        (lambda: Cone(math.inf), "Cone: half_angle"),
    ],
)
def test_no_body_is_infinite(make, name):
    """But for a cylinder, with one infinite radius."""
    with pytest.raises(ValueError, match=name):
        make()
    assert Paraboloid(math.inf, 1.0).curvatures == (0.0, 1.0)


@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, math.inf, False, "75 mm"])
def test_bad_crown_radius_is_refused(bad):
    with pytest.raises(ValueError, match="Roller: crown_radius"):
        Roller(1.0, 1.0, crown_radius=bad)


def test_half_angle_in_degrees_is_met_with_the_remedy():
    with pytest.raises(ValueError, match=r"half_angle.*got 60 rad; for degrees use math\.radians"):
        Cone(60)
    with pytest.raises(ValueError, match="half_angle"):
        Cone(math.pi / 2)


@pytest.mark.parametrize(
    "arguments",
    [
        {},
        {"radius": 1.0, "half_length": 1.0},
        {"radius": 1.0, "half_length": 1.0, "half_width": 1.0},
        {"half_length": 1.0},
        {"half_width": 1.0},
    ],
)
def test_flat_punch_is_either_round_or_rectangular(arguments):
    with pytest.raises(ValueError, match=r"either radius=.* or half_length= and half_width="):
        FlatPunch(**arguments)


@pytest.mark.parametrize(
    ("x", "y", "height", "message"),
    [
        ([0, 1], [0, 1], [[0, math.nan], [math.nan, 0]], "height .* 2 of 4 .* say with holes=True"),
        ([0, 1], [0, 1], [[0, math.inf], [0, 0]], "height .* 1 of 4"),
        ([0, math.nan], [0, 1], np.zeros((2, 2)), "x must be finite"),
        ([0, 1], [0, 1, 2], np.zeros((3, 2)), r"height .*\(2, 3\), got \(3, 2\); transpose"),
        ([0, 1], [0, 1, 2], np.zeros(6), r"height .*\(2, 3\), got \(6,\)"),
        ([0, 1], [0, 1], [[0, 1], [2]], "height must be numbers in m, got rows of unequal length"),
        ([0], [0, 1], np.zeros((1, 2)), "x must be one-dimensional with at least 2"),
        ([[0, 1]], [0, 1], np.zeros((2, 2)), "x must be one-dimensional"),
        (
            [0, 1],
            [0, 2, 2],
            np.zeros((2, 3)),
            "y must increase strictly, got 2 m followed by 2 m",
        ),
        ([1, 0], [0, 1], np.zeros((2, 2)), "x must increase strictly"),
        ([0, 1], [0, 1], [["a", "b"], ["c", "d"]], "height must be numbers in m, got 'a'"),
        ([False, True], [0, 1], np.zeros((2, 2)), "x must be numbers in m, got False"),
    ],
)
def test_bad_height_map_is_refused(x, y, height, message):
    with pytest.raises(ValueError, match=f"HeightMap: {message}"):
        HeightMap(x, y, height)


@pytest.mark.parametrize("parts", [(), (Sphere(1.0), 3.0), (Sphere,)])
def test_sum_of_anything_but_indenters_is_refused(parts):
    with pytest.raises(ValueError, match="CombinedIndenter: parts"):
        CombinedIndenter(parts)
