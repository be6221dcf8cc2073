"""Bodies beside rollers and spheres: against drawings, area functions and closed-form contacts."""

from __future__ import annotations

import math
from typing import Any

import mpmath
import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.pressing import ELASTIC, MODULUS, grid_around, press
from viscontact import reference
from viscontact.bodies.indenters.cross_section import lines_through
from viscontact.indenters import PlacedIndenter
from viscontact.results.descriptions import describe, rebuild

SHAPES: dict[str, vc.Indenter] = {
    "ellipsoid": vc.Ellipsoid(3.0, 2.0, 1.0),
    "wedge": vc.Wedge(1.2),
    "wedge with ends": vc.Wedge(1.2, half_length=1.5),
    "vickers": vc.Pyramid.vickers(),
    "berkovich": vc.Pyramid.berkovich(),
    "torus": vc.Torus(2.0, 0.5),
    "ridges": vc.Waviness(0.1, wavelength_x=0.7, phase_x=0.3),
    "waves": vc.Waviness(0.1, wavelength_x=0.7, wavelength_y=0.9, phase_x=0.3, phase_y=-1.0),
    "dimples": vc.Dimples(0.1, 0.3, 1.0),
    "hexagonal dimples": vc.Dimples(0.1, 0.3, 1.0, "hexagonal"),
    "revolved": vc.Revolved([0, 1, 2], [0.5, 0.5, 1]),
    "hollow": vc.Revolved([1, 1.5, 2], [0.5, 0.4, 1]),
    "swept": vc.Swept([-1, 0.5, 2], [1, 0.4, 2], half_length=1.0),
    "placed": vc.Ellipsoid(3.0, 2.0, 1.0).rotated(0.4).shifted(0.2, -0.3),
    "sum": vc.Ellipsoid(3.0, 2.0, 1.0) + vc.Waviness(0.01, wavelength_y=0.7),
}
EVERY = pytest.mark.parametrize("name", SHAPES)


@EVERY
def test_gap_is_nowhere_negative_and_zero_where_the_body_touches(name: str) -> None:
    line = np.linspace(-2.5, 2.5, 501)
    gap = SHAPES[name].gap(line[:, None], line)
    assert gap.shape == (501, 501)
    assert not np.isnan(gap).any()
    assert gap.min() >= 0.0
    # A point of the mesh is at most 0.007 from the lowest: for the steepest, the wedge, 3e-3.
    assert gap.min() <= 3e-3


@EVERY
def test_shape_comes_back_from_its_description(name: str) -> None:
    assert rebuild(describe(SHAPES[name])) == SHAPES[name]


# -- ellipsoid ---------------------------------------------------------------------------------


def test_points_of_an_ellipsoid_fulfil_its_equation() -> None:
    a, b, c = 3.0, 2.0, 1.5
    rng = np.random.default_rng(0)
    x, y = rng.uniform(-a, a, 500), rng.uniform(-b, b, 500)
    gap = vc.Ellipsoid(a, b, c).gap(x, y)
    inside = np.isfinite(gap)
    assert np.array_equal(inside, (x / a) ** 2 + (y / b) ** 2 <= 1)
    x, y, z = x[inside], y[inside], gap[inside]
    assert (x / a) ** 2 + (y / b) ** 2 + ((z - c) / c) ** 2 == close_to(1, abs=1e-14)


def test_equal_axes_make_an_ellipsoid_a_sphere() -> None:
    x, y = np.array([0.0, 1e-9, 0.3, 0.9]), np.array([0.0, 2e-9, 0.1, 0.2])
    ball, egg = vc.Sphere(1.0), vc.Ellipsoid(1.0, 1.0, 1.0)
    assert egg.gap(x, y) == close_to(ball.gap(x, y), rel=1e-14, abs=0)
    assert egg.curvatures == ball.curvatures


def test_small_contact_of_an_ellipsoid_is_hertzs() -> None:
    """Radii of curvature a²/c and b²/c. Measured: approach -6e-5, peak 1.6e-4, area 3.8e-4."""
    egg = vc.Ellipsoid(0.02, 0.01, 0.01)
    hertz = reference.hertz_elliptical(0.1, 0.04, 0.01, MODULUS)
    axes = (hertz.semi_axis_x, hertz.semi_axis_y)
    state = press(egg, grid_around(axes, (20, 20)), force=0.1)
    assert state.approach == close_to(hertz.approach, rel=2e-4)
    assert state.peak_pressure == close_to(hertz.peak_pressure, rel=5e-4)
    assert state.contact_area == close_to(math.pi * axes[0] * axes[1], rel=2e-3)


# -- wedge and pyramids ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("pyramid", "area"),
    [
        (vc.Pyramid.vickers(), 24.504),  # 4 tan²(68°)
        (vc.Pyramid.berkovich(), 24.494),  # 3 sqrt(3) tan²(65.27°)
        (vc.Pyramid.cube_corner(), 2.5981),  # 3 sqrt(3)/2
        (
            vc.Pyramid(math.atan(1 / math.sqrt(math.pi)), faces=60),
            1.0009,
        ),  # 60 tan(3°)/π of a cone's 1
    ],
)
def test_section_of_a_pyramid_has_the_testers_area(pyramid: vc.Pyramid, area: float) -> None:
    """Counted on the points of a fine mesh: to its rim's share, 2e-3 of them."""
    line = np.linspace(-9, 9, 2001)
    count = np.count_nonzero(pyramid.gap(line[:, None], line) <= 1.0)
    assert count * (line[1] - line[0]) ** 2 == close_to(area, rel=4e-3)


def test_pyramid_looks_along_x_with_a_face_and_has_its_angle_there() -> None:
    pyramid = vc.Pyramid(math.radians(68), faces=4)
    assert float(pyramid.gap(1.0, 0.0)) == close_to(1 / math.tan(math.radians(68)))
    edge = pyramid.gap(1.0, 1.0)
    assert float(edge) == close_to(float(pyramid.gap(1.0, 0.0)))
    # 148.11° between opposite edges of a Vickers pyramid, of its drawing in ISO 6507.
    across = 2 * math.degrees(math.atan(math.sqrt(2) / float(edge)))
    assert across == close_to(148.11, abs=0.005)


def test_pyramid_of_a_thousand_faces_is_the_cone_within() -> None:
    """Its edges are (π/1000)²/2 = 5e-6 farther from the axis than the cone."""
    x, y = np.cos(np.arange(7.0)), np.sin(np.arange(7.0))
    pyramid, cone = vc.Pyramid(1.0, faces=1000).gap(x, y), vc.Cone(1.0).gap(x, y)
    assert pyramid == close_to(cone, rel=5e-6)
    with pytest.raises(ValueError, match="from 3 to 1000"):
        vc.Pyramid(1.0, faces=1001)


@pytest.mark.filterwarnings("ignore:the largest pressure lies at a tip:viscontact.AccuracyWarning")
def test_force_on_a_pyramid_lies_between_those_of_the_cones_within_and_around_it() -> None:
    """What lies closer everywhere is pressed harder; Love's cone F = (2/π) E* tan(α) δ²
    (Johnson 1985, eq. 5.12). And by Galin's scaling the force goes with the square of the depth.
    """
    pyramid, forces = vc.Pyramid(math.radians(80), faces=4), []
    for depth, grid in ((1e-6, vc.Grid((48, 48), (12e-6, 12e-6))),) * 2:
        scale = 1 + len(forces)
        grid = vc.Grid(grid.shape, (scale * 12e-6, scale * 12e-6))
        load = vc.step(approach=scale * depth)
        state = next(iter(vc.march(pyramid, ELASTIC, load, grid, [0.0])))
        forces.append(state.force / scale**2)
    inner = 2 / math.pi * MODULUS * math.tan(math.radians(80)) * 1e-6**2
    assert inner < forces[0] < inner / math.cos(math.pi / 4)
    assert forces[0] == close_to(forces[1], rel=1e-6)


@pytest.mark.filterwarnings("ignore:the contact reaches the end:viscontact.AccuracyWarning")
@pytest.mark.filterwarnings("ignore:the largest pressure lies at a tip:viscontact.AccuracyWarning")
def test_middle_of_a_long_wedge_is_in_plane_strain() -> None:
    """Johnson (1985), section 5.2: p = (E* cot(α)/π) arcosh(a/|y|), of the line load E* a cot(α).

    Measured at a half length of 20 a: 1.6e-3 of the largest pressure that is compared.
    """
    slope, half_width = 0.1, 1e-4
    wedge = vc.Wedge(math.atan(1 / slope), half_length=20 * half_width)
    force = 2 * 20 * half_width * MODULUS * slope * half_width
    grid = vc.Grid((61, 150), (2.05 * 20 * half_width, 5 * half_width))
    state = press(wedge, grid, force=force)
    middle = state.pressure[30]
    line_load = middle.sum() * grid.cell_size[1]
    a = line_load / (MODULUS * slope)
    # In the middle p is infinite, at the rim a cell is in contact in part.
    within = (np.abs(grid.y) > 0.15 * a) & (np.abs(grid.y) < 0.97 * a)
    exact = MODULUS * slope / math.pi * np.arccosh(a / np.abs(grid.y[within]))
    assert middle[within] == close_to(exact, abs=4e-3 * exact.max())
    assert not middle[np.abs(grid.y) > a + grid.cell_size[1]].any()


# -- ring --------------------------------------------------------------------------------------


def test_points_of_a_torus_are_at_its_tubes_radius_from_the_ring() -> None:
    ring, tube = 2.0, 0.5
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-3, 3, (2, 1000))
    gap = vc.Torus(ring, tube).gap(x, y)
    inside = np.isfinite(gap)
    distance = np.hypot(np.hypot(x, y)[inside] - ring, tube - gap[inside])
    assert inside.sum() > 200
    assert distance == close_to(tube, rel=1e-14)


def test_ring_bears_like_a_hertzian_line_bent_to_a_circle() -> None:
    """To the leading order in b/R: b and p0 of the line load F/(2 π R), Johnson (1985) eq. 4.43.

    Measured at b/R = 0.1: peak pressure 1.6e-3, area -1.4e-3.
    """
    ring, tube, half_width = 1e-3, 2e-3, 1e-4
    line_load = math.pi * MODULUS * half_width**2 / (4 * tube)
    line = reference.hertz_line(line_load, tube, MODULUS)
    grid = vc.Grid((176, 176), (2.3 * ring, 2.3 * ring))
    state = press(vc.Torus(ring, tube), grid, force=2 * math.pi * ring * line_load)
    assert line.half_width == close_to(half_width)
    assert state.peak_pressure == close_to(line.peak_pressure, rel=5e-3)
    assert state.contact_area == close_to(2 * math.pi * ring * 2 * half_width, rel=5e-3)


# -- textures ----------------------------------------------------------------------------------


def test_wave_is_a_cosine_to_its_digits() -> None:
    wave = vc.Waviness(0.5, wavelength_x=2.0, wavelength_y=3.0, phase_y=0.25)
    with mpmath.workdps(40):
        for x, y in ((1e-9, -0.25 * 3 / (2 * math.pi)), (0.3, 0.7), (-41.25, 1e3)):
            exact = 0.5 * (
                1
                - mpmath.cos(mpmath.pi * mpmath.mpf(x))
                * mpmath.cos(2 * mpmath.pi * mpmath.mpf(y) / 3 + mpmath.mpf(0.25))
            )
            # Angles of some hundreds lose as much of the last digit.
            assert float(wave.gap(x, y)) == close_to(float(exact), rel=1e-7, abs=1e-12)
    flat = vc.Waviness(1.0, wavelength_x=1.0).gap(1e-9, 5.0)
    assert float(flat) == close_to(2 * (math.pi * 1e-9) ** 2, rel=1e-12, abs=0)


def test_crest_of_a_wave_is_no_measure_of_a_contact_that_spans_many() -> None:
    wavy = vc.Sphere(1.0) + vc.Waviness(0.1, wavelength_x=1e-3)
    assert wavy.curvatures == (1.0, 1.0)
    assert wavy.period == 1e-3
    assert wavy.rotated(1.0).period == 1e-3
    assert vc.Dimples(1.0, 2.0, 5.0).period == 4.0
    assert vc.Sphere(1.0).period == math.inf


def test_waves_repeat_along_the_axes_that_they_cross() -> None:
    waves = vc.Sphere(1.0) + vc.Waviness(0.1, wavelength_x=1e-3)
    assert waves.periods == (1e-3, math.inf)
    assert waves.rotated(math.pi / 2).shifted(x=0.1).periods == (math.inf, 1e-3)
    # Crests at 60 degrees to y: 1/cos and 1/sin of the angle apart along the axes.
    turned = waves.rotated(math.pi / 3)
    assert turned.periods == close_to((2e-3, 2e-3 / math.sqrt(3)), rel=1e-12)
    x, y = np.random.default_rng(1).uniform(-0.1, 0.1, (2, 9))
    texture = vc.Waviness(0.1, wavelength_x=1e-3).rotated(math.pi / 3)
    for shift in ((turned.periods[0], 0.0), (0.0, turned.periods[1])):
        there = texture.gap(x + shift[0], y + shift[1])
        assert there == close_to(texture.gap(x, y), abs=1e-11)
    crossed = vc.Waviness(0.1, wavelength_x=1e-3, wavelength_y=2e-3)
    assert (crossed + waves).periods == (1e-3, 2e-3)
    assert vc.Dimples(1.0, 2.0, 5.0).rotated(0.4).periods == close_to((4.0, 4.0), rel=1e-12)
    assert vc.Sphere(1.0).rotated(0.3).periods == (math.inf, math.inf)


def test_wave_adds_to_a_sphere_without_a_shift() -> None:
    rough = vc.Sphere(1.0) + vc.Waviness(0.01, wavelength_x=0.2)
    assert rough.gap([0.0, 0.1, 0.6], 0.0) == close_to(
        [0.0, 1 - math.sqrt(0.99) + 0.02, 0.2], rel=1e-12
    )


def test_dimple_is_the_cap_of_a_sphere() -> None:
    depth, radius = 1.0, 3.0
    dimple = vc.Dimples(depth, radius, spacing=10.0)
    r = np.linspace(0, radius, 13)
    sphere = (radius**2 + depth**2) / (2 * depth)
    gap = dimple.gap(r, 0.0)
    assert gap[0] == depth
    assert gap[-1] == 0.0
    # The sphere's middle stands above the plane by its radius less the depth.
    assert np.hypot(r, gap + sphere - depth) == close_to(sphere, rel=1e-14)
    assert vc.Dimples(3.0, 3.0, 6.0).gap([0.0, 3.0], 0.0).tolist() == [3.0, 0.0]


@pytest.mark.parametrize(("pattern", "neighbours"), [("square", 4), ("hexagonal", 6)])
def test_dimple_has_its_neighbours_at_the_spacing(pattern: str, neighbours: int) -> None:
    texture = vc.Dimples(0.1, 0.2, 1.0, pattern)
    around = 2 * math.pi * np.arange(neighbours) / neighbours
    middles = texture.gap(np.cos(around), np.sin(around))
    assert middles == close_to(0.1, rel=1e-12)
    line = np.linspace(-5, 5, 1001)[:-1]
    period = 1.0 if pattern == "square" else math.sqrt(3)
    area = np.mean(texture.gap(line[:, None], line * period) > 0)
    per_dimple = 1.0 if pattern == "square" else math.sqrt(3) / 2
    assert area == close_to(math.pi * 0.2**2 / per_dimple, rel=0.01)


# -- drawn by points ---------------------------------------------------------------------------


def test_revolved_line_is_seen_at_every_angle() -> None:
    body = vc.Revolved([0, 1, 2], [0, 0.25, 1.0])
    angle = np.linspace(0, 2 * math.pi, 9)
    for r, drop in ((1.0, 0.25), (2 - 1e-9, 1.0)):
        gap = body.gap(r * np.cos(angle), r * np.sin(angle))
        assert gap == close_to(drop, abs=1e-8)
    assert float(body.gap(2.001, 0.0)) == math.inf


def test_revolved_parabola_is_smooth_on_the_axis_and_a_doubled_point_is_a_tip() -> None:
    r = np.linspace(0, 1, 21)
    dome = vc.Revolved(r, r**2)
    fine = np.linspace(0, 1, 101)
    # A monotone cubic through 20 intervals; on the axis it begins flat, as the parabola does.
    assert dome.gap(fine, 0.0) == close_to(fine**2, abs=6e-4)
    # Of its own a cubic would begin with a slope of 1/2 here.
    assert float(vc.Revolved([0, 1, 2], [0, 1, 3]).gap(1e-4, 0.0)) < 1e-6
    tip = vc.Revolved([0, *r], [0, *r])
    assert tip.gap(fine, 0.0) == close_to(fine, abs=1e-14)


def test_hollow_body_has_no_gap_on_its_axis() -> None:
    tube = vc.Revolved([1.0, 1.5, 2.0], [0.1, 0.0, 0.1])
    assert tube.gap([0.0, 0.99, 1.0, 1.5, 2.01], 0.0).tolist() == [math.inf] * 2 + [
        *(close_to(0.1), 0.0, math.inf)
    ]


def test_swept_section_is_the_same_along_its_length() -> None:
    rail = vc.Swept([-1, 0, 2], [2.5, 0.5, 2.5], half_length=3.0, interpolation="linear")
    assert rail.gap([-3.0, 0.0, 3.0], -0.5).tolist() == [1.0] * 3
    assert rail.gap(0.0, [1.0, 2.5]).tolist() == [1.0, math.inf]
    assert vc.Swept([0, 1], [0, 1]).gap(1e6, 0.0) == 0.0


# -- places ------------------------------------------------------------------------------------


def test_body_turned_by_30_degrees_has_its_long_axis_there() -> None:
    egg, angle = vc.Ellipsoid(3.0, 1.0, 1.0), math.radians(30)
    turned = egg.rotated(angle)
    s = np.linspace(-2.9, 2.9, 7)
    along, across = egg.gap(s, 0.0), egg.gap(0.0, s / 3)
    assert turned.gap(s * math.cos(angle), s * math.sin(angle)) == close_to(along, rel=1e-12)
    assert turned.gap(-s / 3 * math.sin(angle), s / 3 * math.cos(angle)) == close_to(
        across, rel=1e-12
    )
    for body in (egg, turned, vc.Ellipsoid(3.0, 2.0, 1.0)):
        h = 1e-4
        measured = [2 * float(body.gap(*at)) / h**2 for at in ((h, 0.0), (0.0, h))]
        assert body.curvatures == close_to(measured, rel=1e-6)


def test_drawn_sections_of_a_moved_body_pass_through_its_tip() -> None:
    x = np.linspace(-5.0, 5.0, 21)
    sphere = vc.Sphere(4.0).shifted(x=2.0)
    assert lines_through(sphere, x, x, sphere.gap(x[:, None], x)) == (2.0, 0.0)
    sphere = vc.Sphere(4.0).shifted(y=-3.0)
    assert lines_through(sphere, x, x, sphere.gap(x[:, None], x)) == (0.0, -3.0)


def test_quarter_turns_are_exact() -> None:
    plate = vc.FlatPunch(half_length=2.0, half_width=1.0)
    for quarter in range(-3, 6):
        turned = plate.rotated(quarter * math.pi / 2)
        corner = (1.0, 2.0) if quarter % 2 else (2.0, 1.0)
        assert float(turned.gap(*corner)) == 0.0


def test_body_is_turned_about_its_own_origin_and_then_moved() -> None:
    body = vc.Ellipsoid(3.0, 1.0, 1.0)
    moved = body.rotated(math.pi / 2).shifted(5.0, 1.0)
    assert moved.gap([5.0, 5.0], [1.0, 3.0]) == close_to(body.gap([0.0, 2.0], 0.0))
    turned = moved.body
    assert isinstance(turned, PlacedIndenter)
    x, y = moved.place(*turned.place([2.0, 0.0], [0.0, 0.5]))
    assert (x.tolist(), y.tolist()) == ([5.0, 4.5], [3.0, 1.0])


def test_turned_roller_presses_as_the_roller_does() -> None:
    roller = vc.Roller(5e-3, 2e-3, 50e-3)
    grid = vc.Grid((41, 31), (6e-3, 1e-3))
    straight = press(roller, grid, force=50.0)
    turned = press(roller.rotated(math.pi / 2), vc.Grid((31, 41), (1e-3, 6e-3)), force=50.0)
    assert turned.pressure == close_to(straight.pressure.T, rel=1e-4, abs=1e-4 * 1e8)


# -- refusals ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: vc.Ellipsoid(1.0, 0.0, 1.0), "semi_axis_y must be a positive"),
        (lambda: vc.Wedge(60), "half_angle must lie .* got 60 rad; for degrees use math.radians"),
        (lambda: vc.Wedge(1.0, -1.0), "half_length must be a positive"),
        (lambda: vc.Pyramid(1.0, 2), "faces must be a whole number from 3 .* got 2"),
        (lambda: vc.Pyramid(1.0, 3.5), "faces must be a whole number"),
        (lambda: vc.Pyramid(1.0, True), "faces must be a whole number"),
        (lambda: vc.Torus(1.0, math.inf), "tube_radius must be a positive"),
        (lambda: vc.Waviness(1.0), "give wavelength_x, wavelength_y or both"),
        (lambda: vc.Waviness(1.0, 1.0, phase_y=1.0), "phase_y goes with wavelength_y"),
        (lambda: vc.Waviness(1.0, 1.0, phase_x=math.nan), "phase_x must be a finite"),
        (lambda: vc.Dimples(1.0, 0.5, 2.0), "depth must be at most the radius"),
        (lambda: vc.Dimples(0.1, 0.5, 0.9), "spacing must be at least two radii"),
        (lambda: vc.Dimples(0.1, 0.5, 2.0, "hex"), "pattern must be 'square' or 'hexagonal', got"),
        (lambda: vc.Revolved([-1, 1], [0, 1]), "r must not be negative, got -1 m"),
        (lambda: vc.Revolved([0, 1], [0]), "must be a drop at every position, got 1 drops at 2"),
        (lambda: vc.Revolved([], []), "at least two positions"),
        (lambda: vc.Swept([1, 2], [0, 1]), "y must begin with 0"),
        (lambda: vc.Swept([0, 1], [0, 1], interpolation="cubic"), "interpolation must be 'smooth'"),
        (lambda: vc.Swept("ab", [0, 1]), "y must be numbers in m, got 'ab'"),
        (lambda: vc.Swept([[0], [1, 2]], [0, 1]), "y must be numbers in m, got rows of unequal"),
        (lambda: vc.Sphere(1.0).rotated("30 deg"), "angle must be a finite number in rad"),
        (lambda: vc.Sphere(1.0).shifted(math.inf), "x must be a finite"),
    ],
)
def test_nonsense_is_refused(make: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()
