"""Profiles of rollers against drawings, closed forms and integrals of pressure."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

import viscontact as vc
from closeness import close_to
from viscontact.results.descriptions import describe, rebuild

R, L = 5e-3, 6e-3  # m
#: Every kind of profile on the same roller.
ROLLERS = {
    "cylindrical": vc.Roller(R, L, profile="cylindrical"),
    "full": vc.Roller(R, L, profile="full", crown_radius=2.0),
    "partial": vc.Roller(R, 4e-3, profile="partial", crown_radius=0.5, end_length=L),
    "two-radii": vc.Roller(
        *(R, 4e-3),
        profile=vc.TwoRadiiCrown(
            crown_radius=1.0, crown_length=1.5e-3, end_radius=0.05, end_length=L
        ),
    ),
    "chamfer": vc.Roller(R, L, profile="chamfer", angle=0.5, length=1e-4, corner_radius=1e-4),
    "logarithmic": vc.Roller(
        R, L, profile="logarithmic", amplitude=2e-6, crown_ratio=0.7, end_drop=5e-6
    ),
    "lundberg": vc.Roller(R, L, profile="lundberg", force=1e4, effective_modulus=115e9),
    "johns-gohar": vc.Roller(R, L, profile="johns-gohar", force=1e4, effective_modulus=115e9),
    "fujiwara-kawase": vc.Roller(
        *(R, L),
        profile="fujiwara-kawase",
        **{"force": 1e4, "effective_modulus": 115e9, "load_factor": 1.5},
        **{"crown_ratio": 0.6, "end_drop": 20e-6},
    ),
    "iso-16281": vc.Roller(R, L, profile="iso-16281"),
    "table": vc.Roller(R, L, profile=[(0, 0), (3e-3, 0), (5e-3, 2e-6), (6e-3, 9e-6)]),
}
EVERY = pytest.mark.parametrize("name", ROLLERS)


@EVERY
def test_profile_touches_in_the_middle_falls_outwards_and_ends_where_it_says(name: str) -> None:
    roller = ROLLERS[name]
    x = np.linspace(0, L, 501)[:-1]
    drop = roller.drop(x)
    assert drop[0] == 0.0
    # Between points of a table a cubic is monotone to its roundings.
    assert (np.diff(drop) >= -1e-21).all()
    assert np.array_equal(roller.drop(-x), drop)
    assert roller.end == close_to(L, rel=1e-12)
    assert roller.gap([-1.0001 * L, 1.0001 * L], 0.0).tolist() == [math.inf] * 2
    if name not in ("lundberg", "iso-16281"):  # which fall without end
        assert float(roller.drop(L)) < 1e-4


@EVERY
def test_gap_off_the_axis_is_that_of_a_circle_of_the_radius_that_is_left(name: str) -> None:
    roller = ROLLERS[name]
    x, y = 5.5e-3, np.linspace(-4e-3, 4e-3, 9)
    left = R - float(roller.drop(x))
    # R - sqrt(R(x)² - y²), rounded to some 1e-16 of R.
    assert roller.gap(x, y) == close_to(R - np.sqrt(left**2 - y**2), abs=1e-17)


@EVERY
def test_profile_comes_back_from_its_description(name: str) -> None:
    assert rebuild(describe(ROLLERS[name])) == ROLLERS[name]


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # distinguished below
@EVERY
def test_contact_that_reaches_the_end_of_a_profile_is_warned_of(name: str) -> None:
    """Pressed in by 0.3 mm all do; by 0.2 um only those that are straight to the last cell."""
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    warned = []
    for approach in (2e-7, 3e-4):
        grid = vc.Grid((49, 25), (13e-3, 4 * math.sqrt(2 * R * approach)))
        state = next(iter(vc.march(ROLLERS[name], rubber, vc.step(approach=approach), grid, [0.0])))
        warned.append(any("the end of the indenter's profile" in each for each in state.warnings))
    assert warned == [name in ("cylindrical", "chamfer"), True]


# -- straight lines and circles ----------------------------------------------------------------


def test_partial_crown_by_name_is_eq_13() -> None:
    assert vc.Roller(R, L, 75e-3, "partial") == vc.Roller(R, L, 75e-3)
    assert vc.Roller(R, L, profile=vc.PartialCrown(75e-3)).gap(8e-3, 1e-3) == vc.Roller(
        R, L, 75e-3
    ).gap(8e-3, 1e-3)
    assert vc.Roller(R, L, profile="cylindrical") == vc.Roller(R, L)


def test_points_of_a_full_crown_lie_on_its_circle() -> None:
    x = np.linspace(-5, 5, 11)
    drop = vc.FullCrown(crown_radius=13.0).drop(x, half_length=5.0)
    assert np.hypot(x, 13.0 - drop) == close_to(13.0, rel=1e-15)
    assert drop[-1] == 1.0


def test_two_radii_crown_lies_on_two_circles_with_a_common_tangent() -> None:
    profile = vc.TwoRadiiCrown(crown_radius=13.0, crown_length=5.0, end_radius=6.5)
    # Centres from the drawing: the first below the end of the straight part, the second on the
    # radius that ends where the arcs meet, at drop 1, where the slope is 5/12.
    first, meet = np.array([1.0, 13.0]), np.array([6.0, 1.0])
    second = meet + (first - meet) * 6.5 / 13.0
    on_first, on_second = np.linspace(1, 6, 7), np.linspace(6, 9.9, 7)
    for centre, radius, x in ((first, 13.0, on_first), (second, 6.5, on_second)):
        distance = np.hypot(x - centre[0], profile.drop(x, half_length=1.0) - centre[1])
        assert distance == close_to(radius, rel=1e-14)
    step = 1e-6
    slopes = np.diff(profile.drop([6.0 - step, 6.0, 6.0 + step], half_length=1.0)) / step
    # Curvature times step is left: 1e-6/6.5 and the roundings of 1/1e-6.
    assert slopes == close_to(5 / 12, abs=1e-6)
    assert profile.end(half_length=1.0) == close_to(second[0] + 6.5)


def test_rounded_chamfer_is_tangent_to_both_lines() -> None:
    angle, radius, corner = math.radians(30), 2.0, 9.0
    profile = vc.Chamfer(angle=angle, length=3.0, corner_radius=radius)
    start = corner - radius * math.tan(angle / 2)
    on_arc = np.linspace(start, start + radius * math.sin(angle), 9)
    drop = profile.drop(on_arc, half_length=12.0)
    assert np.hypot(on_arc - start, radius - drop) == close_to(radius, rel=1e-14)
    on_chamfer = np.linspace(on_arc[-1], 12.0, 5)
    line = (on_chamfer - corner) * math.tan(angle)
    assert profile.drop(on_chamfer, half_length=12.0) == close_to(line, abs=1e-14)
    assert drop[-1] == close_to(line[0], rel=1e-13)
    sharp = vc.Chamfer(angle=angle, length=3.0)
    assert sharp.drop([9.0, 10.0], half_length=12.0) == close_to([0.0, math.tan(angle)])


def test_largest_corner_radius_of_a_chamfer_is_the_one_that_its_refusal_names() -> None:
    """Its arc ends with the roller: the tangent R tan(α/2) along the flank spans the length."""
    largest = 1e-3 / (math.cos(1.0) * math.tan(0.5))  # 3.388 mm
    vc.Chamfer(angle=1.0, length=1e-3, corner_radius=0.9999 * largest)
    with pytest.raises(ValueError, match=r"make it smaller than 3\.39 mm"):
        vc.Chamfer(angle=1.0, length=1e-3, corner_radius=1.0001 * largest)


# -- logarithmic -------------------------------------------------------------------------------


def dent_of_even_line_load(x: float, half_width: float) -> float:
    """How much less an even line load w = π E* dents at x than in the middle, over |x| < 1.

    Boussinesq's displacement p/(π E* r), integrated along x in closed form and across over
    Hertz's half ellipse numerically.
    """

    def integrand(phi: float) -> float:
        y = half_width * abs(math.sin(phi)) + 1e-300
        along = [math.asinh((1 - s) / y) + math.asinh((1 + s) / y) for s in (0.0, x)]
        return 2 / math.pi * math.cos(phi) ** 2 * (along[0] - along[1])

    return 2 * quad(integrand, 0, math.pi / 2, epsabs=1e-12)[0]


@pytest.mark.parametrize("x", [0.2, 0.5, 0.8, 0.9])
def test_lundberg_profile_is_the_displacement_by_an_even_line_load(x: float) -> None:
    amplitude = 1 / math.pi  # under w = E*, of the half length 1: Q = 2 E*
    profile = vc.LogarithmicProfile.lundberg(1.0, force=2.0, effective_modulus=1.0)
    assert profile.amplitude == close_to(amplitude)
    exact = amplitude * dent_of_even_line_load(x, half_width=0.01)
    # The contact's width enters as (b/(1 - x))²/8: 1.3e-3 of A at 0.9.
    assert float(profile.drop(x, 1.0)) == close_to(exact, abs=1.5e-3 * amplitude)


@pytest.mark.parametrize("half_width", [0.01, 0.05])
def test_end_drop_of_johns_and_gohar_is_the_displacement_by_an_even_hertzian_pressure(
    half_width: float,
) -> None:
    # b² = 4 A R on a half length of 1.
    modulus, radius = 1.0, 1.0
    amplitude = half_width**2 / (4 * radius)
    force = 2 * math.pi * amplitude
    crown = vc.LogarithmicProfile.johns_gohar(radius, 1.0, force, modulus)
    exact = amplitude * dent_of_even_line_load(1.0, half_width)
    # 0.3033 is printed with four digits, and (b/L)²/4 is left out.
    assert crown.end_drop == close_to(exact, rel=3e-4)
    assert float(crown.drop(1.0, 1.0)) == close_to(crown.end_drop, rel=1e-12)


def test_fujiwara_and_kawase_with_unit_factors_are_johns_and_gohar() -> None:
    design = {"half_length": L, "force": 1e4, "effective_modulus": 115e9}
    theirs = vc.LogarithmicProfile.johns_gohar(R, **design)
    ours = vc.LogarithmicProfile.fujiwara_kawase(
        **design, load_factor=1.0, crown_ratio=1.0, end_drop=theirs.end_drop
    )
    assert ours == theirs


def test_fujiwara_and_kawase_crown_drops_by_z_m_behind_a_straight_part() -> None:
    roller = ROLLERS["fujiwara-kawase"]
    assert roller.drop([0.0, 0.399 * L]).tolist() == [0.0, 0.0]
    assert float(roller.drop(0.41 * L)) > 0
    assert float(roller.drop(L)) == close_to(20e-6, rel=1e-12)
    lundberg = ROLLERS["lundberg"].line.amplitude
    assert roller.line.amplitude == close_to(1.5 * lundberg, rel=1e-12, abs=0)


def test_iso_16281_profile_has_the_standards_numbers() -> None:
    """Worked by hand for D_we = 10 mm: L_we = 12 mm at x = 3 mm, L_we = 40 mm at x = 13.75 mm."""
    short, long = (vc.LogarithmicProfile.iso_16281(5e-3, half) for half in (6e-3, 20e-3))
    assert float(short.drop(3e-3, 6e-3)) == close_to(3.5e-6 * math.log(4 / 3), rel=1e-13)
    assert float(long.drop(7.5e-3, 20e-3)) == 0.0
    assert float(long.drop(13.75e-3, 20e-3)) == close_to(5e-6 * math.log(4 / 3), rel=1e-13)
    # At 2.5 diameters both formulas crown the whole length; their amplitudes differ.
    edge = vc.LogarithmicProfile.iso_16281(5e-3, 12.5e-3)
    assert (edge.amplitude, edge.crown_ratio) == (close_to(3.5e-6), 1.0)


@pytest.mark.parametrize("u", [1e-12, 1e-6, 0.3, 0.5, 0.7, 1 - 1e-9, 1 - 2**-50])
@pytest.mark.parametrize("end_drop", [None, 2e-6])
def test_logarithm_does_not_cancel(u: float, end_drop: float | None) -> None:
    profile = vc.LogarithmicProfile(1e-6, end_drop=end_drop)
    with mpmath.workdps(60):
        last = mpmath.exp(-mpmath.mpf(end_drop) / mpmath.mpf(1e-6)) if end_drop else 0
        exact = float(mpmath.mpf(1e-6) * -mpmath.log(1 - (1 - last) * mpmath.mpf(u) ** 2))
    assert float(profile.drop(u, 1.0)) == close_to(exact, rel=1e-14, abs=0)


@pytest.mark.filterwarnings("ignore:the contact reaches the end:viscontact.AccuracyWarning")
def test_johns_gohar_roller_presses_evenly_under_its_design_load() -> None:
    """Along the roller p stays at p0 = sqrt(w E*/(π R)), Johnson (1985) eq. 4.45; the sharp one's
    does not. Measured: 1.1 % from p0 over 90 % of the length, where the other is 5.5 %; in the
    last cell 17 % and 125 %.
    """
    modulus, force = 2e9, 200.0
    material = vc.Material(vc.Elastic(0.35 * modulus), poisson_ratio=0.3)
    half_width = math.sqrt(2 * force * R / (math.pi * L * modulus))
    grid = vc.Grid((121, 31), (2.1 * L, 2.8 * half_width))
    p0 = math.sqrt(force / (2 * L) * modulus / (math.pi * R))
    on_axis = {}
    for profile in ("johns-gohar", "cylindrical"):
        design = {"force": force, "effective_modulus": modulus}
        roller = vc.Roller(R, L, profile=profile, **design if "gohar" in profile else {})
        state = next(iter(vc.march(roller, material, vc.step(force), grid, [0.0])))
        on_axis[profile] = state.pressure[:, 15] / p0
    inner = np.abs(grid.x) < 0.9 * L
    assert on_axis["johns-gohar"][inner] == close_to(1.0, abs=0.02)
    assert np.abs(on_axis["cylindrical"][inner] - 1).max() > 0.05
    assert on_axis["johns-gohar"].max() < 1.3
    assert on_axis["cylindrical"].max() > 2.0


# -- tables ------------------------------------------------------------------------------------


def test_table_goes_through_its_points_and_stays_between_them() -> None:
    rng = np.random.default_rng(2)
    x = np.cumsum(rng.uniform(0.1, 1, 20))
    x, z = x - x[0], np.concatenate([[0.0], rng.uniform(0, 1, 19)])
    for interpolation in ("smooth", "linear"):
        line = vc.TabulatedProfile(x, z, interpolation)
        assert line.drop(x, half_length=x[-1]) == close_to(z, abs=1e-15)
        fine = np.linspace(0, 1, 21)[:, None] * np.diff(x) + x[:-1]
        low, high = np.minimum(z[:-1], z[1:]), np.maximum(z[:-1], z[1:])
        drop = line.drop(fine, half_length=x[-1])
        assert (drop >= low - 1e-12).all()
        assert (drop <= high + 1e-12).all()


def test_smooth_table_has_a_continuous_slope_but_at_a_point_given_twice() -> None:
    x, z = [0, 1, 2, 2, 3, 4], [0, 0.4, 1, 1, 1.5, 3]
    line, h = vc.TabulatedProfile(x, z), 1e-7

    def bend(at: float) -> float:
        before, here, after = line.drop([at - h, at, at + h], half_length=4.0)
        return float(after - 2 * here + before) / h

    assert [abs(bend(at)) < 1e-5 for at in (0.0, 1.0, 2.0, 3.0)] == [True, True, False, True]


def test_table_is_measured_from_its_highest_point_on_the_roller() -> None:
    line = vc.TabulatedProfile([-2, -1, 0, 2], [3.0, 1.0, 2.0, 0.0], "linear")
    assert line.drop([-1.0, 1.0], half_length=1.0).tolist() == [0.0, 0.0]
    assert line.drop([-1.0, 1.0, 2.0], half_length=2.0).tolist() == [1.0, 1.0, 0.0]
    # Where the roller ends between two points, its highest one may be there.
    assert line.drop([-1.0, 1.5], half_length=1.5).tolist() == [0.5, 0.0]


def test_table_with_unequal_ends_ends_at_the_farther_one() -> None:
    line = vc.TabulatedProfile([-2, 0, 5], [1.0, 0.0, 1.0], "linear")
    assert [line.end(half_length) for half_length in (1.0, 4.0, 9.0)] == [1.0, 4.0, 5.0]
    assert np.isfinite(line.drop([-2.0, 4.0], 4.0)).all()


@given(st.floats(-1.2, 1.2))
def test_half_a_table_is_mirrored(x: float) -> None:
    half = vc.TabulatedProfile([0, 0.5, 0.8, 1], [0, 0.1, 0.5, 1])
    assert half.drop(x, 1.0) == half.drop(-x, 1.0)
    whole = vc.TabulatedProfile([-1, -0.8, -0.5, 0, 0.5, 0.8, 1], [1, 0.5, 0.1, 0, 0.1, 0.5, 1])
    # On either side of a point its cubics differ by a rounding.
    assert half.drop(x, 1.0) == close_to(whole.drop(x, 1.0), abs=1e-15)


def test_parabolic_section_is_hertzs_and_has_no_outline() -> None:
    roller = vc.Roller(2.0, 5.0, 13.0, cross_section="parabola")
    assert roller.gap([0.0, 10.0], [3.0, 4.0]).tolist() == [9 / 4, 1.0 + 16 / 4]
    assert roller.end == 18.0  # where the arc of the crown ends, below the roller's axis
    assert vc.Roller(2.0, 5.0, 13.0).end == close_to(5 + math.sqrt(13**2 - 11**2))


# -- refusals ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"profile": "log"}, "profile 'log' is unknown. The names are 'cylindrical', "),
        ({"profile": "lunberg"}, "did you mean 'lundberg'"),
        ({"profile": "logarithmic"}, "'logarithmic' needs amplitude"),
        ({"profile": "full"}, "'full' needs crown_radius"),
        ({"profile": "partial"}, "'partial' needs crown_radius"),
        ({"profile": "lundberg", "force": 1.0}, "'lundberg' needs effective_modulus"),
        ({"profile": "logarithmic", "aplitude": 1.0}, "has no aplitude; its arguments are ampl"),
        ({"profile": "logarithmic", "amplitude": -1.0}, "amplitude must be a positive"),
        ({"profile": "logarithmic", "amplitude": 1.0, "crown_ratio": 2}, "crown_ratio must be ab"),
        ({"profile": "logarithmic", "amplitude": 1.0, "end_drop": 0.0}, "end_drop must be a pos"),
        ({"profile": "chamfer", "angle": 30, "length": 1e-4}, "angle must lie .* for degrees use"),
        ({"profile": "chamfer", "angle": 0.5, "length": 7e-3}, "leaves no straight part"),
        (
            {"profile": "chamfer", "angle": 0.5, "length": 1e-4, "corner_radius": 1.0},
            "leaves nothing of a chamfer",
        ),
        ({"profile": "partial", "crown_radius": 1.0, "end_length": 1e-3}, "end_length must be at"),
        ({"profile": "iso-16281", "crown_radius": 1.0}, "crown_radius means nothing with"),
        ({"profile": vc.FullCrown(1.0), "crown_radius": 1.0}, "exclude each other"),
        ({"profile": [1.0, 2.0]}, "rows of .x, drop. in m, got"),
        ({"profile": [(0, 0), (1e-3, 0)]}, "ends at 1 mm from the middle, before the half"),
        ({"profile": [(1e-3, 0), (1e-2, 0)]}, "must begin with 0 .half"),
        ({"profile": [(0, 0), (2e-3, 1e-6), (1e-3, 0)]}, "positions must increase, got 2 mm fo"),
        ({"profile": [(0, 0), (3e-3, 0), (3e-3, 1), (6e-3, 1)]}, "drop jumps at 3 mm"),
        ({"profile": [(0, 0), (6e-3, math.nan)]}, "finite lengths in m, got nan at point 2"),
        ({"profile": [(0, 0)]}, "at least two positions"),
        (
            {"profile": "johns-gohar", "force": 1e9, "effective_modulus": 1e9},
            "a contact wider than the roller",
        ),
        ({"cross_section": "square"}, "cross_section must be 'circle' or 'parabola', got 'square'"),
    ],
)
def test_nonsense_is_refused(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        vc.Roller(R, L, **arguments)


def test_arguments_of_a_profile_need_its_name() -> None:
    with pytest.raises(TypeError, match="arguments of a profile go with its name"):
        vc.Roller(R, L, amplitude=1e-6)


@pytest.mark.parametrize(
    ("bad", "shown"),
    [
        *((0.0, "0 "), (-1.0, "-1 "), (math.nan, "nan"), (math.inf, "inf")),
        *((True, "True"), ("5 mm", "'5 mm'"), (None, "None")),
    ],
)
@pytest.mark.parametrize(
    "make",
    [
        lambda bad: vc.FullCrown(bad),
        lambda bad: vc.PartialCrown(bad),
        lambda bad: vc.TwoRadiiCrown(bad, 1.0, 1.0),
        lambda bad: vc.TwoRadiiCrown(2.0, bad, 1.0),
        lambda bad: vc.TwoRadiiCrown(2.0, 1.0, bad),
        lambda bad: vc.Chamfer(0.5, bad),
        lambda bad: vc.Chamfer(bad, 1.0),
        lambda bad: vc.LogarithmicProfile(bad),
        lambda bad: vc.LogarithmicProfile.lundberg(1.0, bad, 1.0),
        lambda bad: vc.LogarithmicProfile.lundberg(1.0, 1.0, bad),
        lambda bad: vc.LogarithmicProfile.iso_16281(bad, 1.0),
    ],
)
def test_bad_length_is_refused_with_its_value(make: object, bad: object, shown: str) -> None:
    with pytest.raises(ValueError, match="must") as refusal:
        make(bad)
    assert f"got {shown}" in str(refusal.value)
