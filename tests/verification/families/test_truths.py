"""Truths of the random families: laws, transforms of gaps, ellipses, and the error of the rods."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from returned import some
from verification.families import rod_solution
from verification.families.creep_curves import LAWS, mean_compliance
from verification.families.ellipses import Ellipse
from verification.families.exact_run import NotDrawnError
from verification.families.layer_solution import (
    ball,
    bonded_on,
    bonded_on_rigid,
    cylinder,
    sliding_on_rigid,
)
from verification.families.punches import eccentric_punch
from verification.families.round_bodies import round_body, solution
from verification.families.round_profiles import BODIES, RoundProfile
from verification.families.tilted_balls import tilted_ball
from verification.families.waves import line_waves
from viscontact import reference
from viscontact.reference import westergaard


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
def test_closed_forms_of_the_compliance_are_those_of_the_laws(law) -> None:
    """To rounding, and to 2e-5 where the law is a table of 30 rows a decade."""
    creep = law(np.random.default_rng(4))
    compliance = creep.material.contact_compliance()
    if creep.more:
        compliance = compliance + creep.more["indenter_material"].contact_compliance()
    t = creep.time * np.geomspace(1e-4, 20, 30)
    close = 2e-5 if creep.name.startswith("table") else 1e-12
    np.testing.assert_allclose(creep.compliance(t), compliance(t), rtol=close)
    for start in (0 * t, t):
        own = mean_compliance(creep, start, 1.3 * t)
        np.testing.assert_allclose(own, compliance.mean_creep(start, 1.3 * t), rtol=close)


@pytest.mark.parametrize("body", dict.fromkeys(BODIES), ids=lambda body: body.__name__)
def test_transform_of_a_gap_follows_from_its_slope(body) -> None:
    """g(s) = s times the integral of f'(r)/sqrt(s² - r²) over r < s, f from the indenter."""
    a = 1e-3
    drawn_body = body(np.random.default_rng(2), a)

    def slope(r):
        step = 1e-7 * a
        ahead, behind = (drawn_body.indenter.gap(np.abs(r + d), 0.0) for d in (step, -step))
        return (ahead - behind) / (2 * step)

    s = np.linspace(0.1, 1.5, 12) * a
    found = RoundProfile.of_slope(slope, 2 * a).depth(s)
    np.testing.assert_allclose(drawn_body.profile.depth(s), found, rtol=2e-4)


def test_ellipse_as_a_ball_of_its_stiffness_follows_hertz() -> None:
    """A force of 2 N on a body of J = 1e-9/Pa, radii 30 mm and 4 mm."""
    creep = LAWS[0](np.random.default_rng(0))
    ellipse = Ellipse.of(0.03, 0.004)
    found = solution(ellipse.body, creep, vc.step(2.0), np.zeros(1)).scalars()
    own = ellipse.scalars(found, angle=0.0)
    modulus = 1 / float(creep.compliance(np.zeros(1))[0])
    hertz = reference.hertz_elliptical(2.0, 0.03, 0.004, modulus)
    assert own["approach"][0] == close_to(hertz.approach, rel=1e-6)
    assert own["contact_length"][0] == close_to(2 * hertz.semi_axis_x, rel=1e-6)
    assert own["contact_width"][0] == close_to(2 * hertz.semi_axis_y, rel=1e-6)
    assert own["peak_pressure"][0] == close_to(hertz.peak_pressure, rel=1e-5)
    assert own["work"][0] == close_to(0.4 * 2.0 * hertz.approach, rel=1e-5)


@pytest.mark.parametrize("count", [1, pytest.param(3, marks=pytest.mark.slow)])
def test_rods_err_by_far_less_than_the_bars(monkeypatch, count) -> None:
    """Twice the rods and steps change random histories by less than 3e-4 of the largest."""
    rng, runs = np.random.default_rng(8), []
    while len(runs) < count:
        try:
            run = round_body(rng)
        except NotDrawnError:
            continue
        if "pure" not in run.name:
            runs.append((run, run.exact(np.asarray(run.times))))
    for name in ("STEPS", "FEWEST", "ELEMENTS"):
        monkeypatch.setattr(rod_solution, name, 2 * getattr(rod_solution, name))
    for run, values in some(runs):
        for name, finer in some(run.exact(np.asarray(run.times)).items()):
            known = np.isfinite(finer)
            largest = np.abs(finer[known]).max(initial=0.0)
            difference = np.abs(values[name][known] - finer[known])
            assert (difference <= 3e-4 * largest).all(), (run.name, name)


def test_values_of_straight_waves_are_westergaards() -> None:
    """On an elastic body; the work by quadrature of force over approach."""
    rng = np.random.default_rng(5)
    run = line_waves(rng)
    while "step, elastic" not in run.name:
        run = line_waves(rng)
    wave, grid = run.indenter, run.grid
    length = wave.wavelength_x or wave.wavelength_y
    modulus = 1 / float(run.material.contact_compliance()(0.0))
    forces = float(run.load.force[0]) * np.linspace(1e-6, 1, 4001) ** 2
    found = [westergaard(f / grid.area, wave.amplitude, length, modulus) for f in forces]
    values, approach = run.exact(np.zeros(1)), np.array([one.approach for one in found])
    assert values["approach"][0] == close_to(approach[-1], rel=1e-9)
    assert values["peak_pressure"][0] == close_to(found[-1].peak_pressure, rel=1e-6)
    part = 2 * found[-1].half_width / length
    assert values["contact_area"][0] == close_to(part * grid.area, rel=1e-9)
    work = np.sum((forces[1:] + forces[:-1]) / 2 * np.diff(approach))
    assert values["work"][0] == close_to(work, rel=1e-4)


def test_values_of_an_eccentric_punch_are_sneddons() -> None:
    run = eccentric_punch(np.random.default_rng(23))
    assert "elastic" in run.name
    assert run.load.control == "force"
    values = run.exact(np.asarray(run.times))
    modulus = 1 / float(run.material.contact_compliance()(0.0))
    at = int(np.flatnonzero(values["contact_area"] > 0)[-1])
    force, place = float(run.load.force_at(run.times[at])), run.load.eccentricity_x
    punch = reference.flat_punch(force, run.indenter.radius, modulus, abs(place))
    assert values["approach"][at] == close_to(punch.approach, rel=1e-9)
    assert abs(values["tilt_x"][at]) == close_to(punch.tilt_x, rel=1e-9)


def test_tilted_paraboloid_is_an_upright_one_beside_the_origin() -> None:
    """r²/(2R) - θ x = ((x - R θ)² + y²)/(2R) - R θ²/2."""
    rng = np.random.default_rng(1)
    run = tilted_ball(rng)
    while run.load.control == "force":
        run = tilted_ball(rng)
    ball, x, y = run.indenter, run.grid.x[:, None], run.grid.y[None, :]
    tilt_x, tilt_y = run.load.tilt_x, run.load.tilt_y
    pressed = run.load.approach.max() + tilt_x * x + tilt_y * y - ball.gap(x, y)
    values = run.exact(np.asarray(run.times))
    place = [np.nanmax(values[f"eccentricity_{axis}"]) for axis in "xy"]
    deepest = run.load.approach.max() + ball.radius_x * (tilt_x**2 + tilt_y**2) / 2
    np.testing.assert_allclose(pressed, deepest - ball.gap(x - place[0], y - place[1]), rtol=1e-9)


def test_contacts_on_thick_layers_are_hertzs() -> None:
    """Force and peak of a ball (Johnson 1985, eq. 4.22 and 4.24), force of a cylinder (4.43)."""
    for deviation in (bonded_on_rigid(0.3), bonded_on_rigid(0.5), sliding_on_rigid()):
        off = []
        for a in (0.02, 0.01):
            round_one, line = ball(a, 1.0, deviation), cylinder(a, 1.0, deviation)
            assert round_one.force == close_to(4 / 3 * a**3, rel=2e-5)
            assert round_one.peak == close_to(2 * a / np.pi, rel=2e-5)
            off.append([round_one.approach / a**2 - 1, line.force / (np.pi * a**2 / 4) - 1])
        # The approach is off by a/h, the rest by its powers.
        assert np.divide(*off) == close_to([2.0, 4.0], rel=0.02)


def test_contacts_on_thin_layers_approach_their_limits() -> None:
    """A foundation of springs, and a layer that is squeezed out (Johnson 1985, section 5.8)."""
    modulus, off = 0.7**2 / 0.4, []  # (1 - ν)²/(1 - 2ν), times the compliance
    for a in (16.0, 32.0):
        hard, soft = bonded_on_rigid(0.5), bonded_on_rigid(0.3)
        springs, line = ball(a, 1.0, soft), cylinder(a, 1.0, soft)
        squeezed, sheet = ball(a, 1.0, hard), cylinder(a, 1.0, hard)
        off.append(
            [
                springs.force / (np.pi / 4 * modulus * a**4) - 1,
                springs.approach / (a**2 / 2) - 1,
                springs.peak / (modulus * a**2 / 2) - 1,
                line.force / (2 / 3 * modulus * a**3) - 1,
                line.approach / (a**2 / 2) - 1,
                squeezed.force / (np.pi / 128 * a**6) - 1,
                squeezed.approach / (a**2 / 4) - 1,
                squeezed.peak / (3 / 128 * a**4) - 1,
                sheet.force / (a**5 / 30) - 1,
                sheet.approach / (a**2 / 6) - 1,
                sheet.peak / (a**4 / 32) - 1,
            ]
        )
    assert np.array(off[1][:5]) == close_to([0.0153, 0.0078, 0.0075, 0.0115, 0.0077], rel=0.02)
    # As h/a, where incompressible layers are slower to it.
    ratios = np.divide(*off)
    assert ratios[:5] == close_to(np.full(5, 2.0), rel=0.03)
    assert (ratios[5:] > 1.85).all()
    assert (ratios[5:] < 2.35).all()


def test_a_layer_on_a_base_is_between_a_half_space_and_one_on_a_rigid_base() -> None:
    w = np.geomspace(1e-2, 10.0, 20)
    np.testing.assert_allclose(bonded_on(1e-12, 0.3, 0.2)(w), bonded_on_rigid(0.3)(w), atol=1e-9)
    np.testing.assert_allclose(bonded_on(1.0, 0.3, 0.3)(w), 0.0, atol=1e-12)
