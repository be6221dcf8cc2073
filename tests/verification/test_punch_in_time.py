"""A flat punch on a creeping half-space: its contact stays, so that space and time separate.

What a unit force does to an elastic half-space, on the same mesh, is a single number; the rest is
the law's own, to the solver's tolerance and the error of the time steps. Truth: the complex
compliance (Ferry 1980, Viscoelastic Properties of Polymers, ch. 1) and Boltzmann's superposition,
written out in `reference`; what the mesh does to that number is tested in `test_punch_and_cone`.
"""

import math

import numpy as np
import pytest
from scipy.special import gamma

import viscontact as vc
from closeness import close_to
from verification.creeping_bodies import BODIES, TIME, G
from verification.indenting import deviation
from verification.pressing import order, over_time
from viscontact import reference

PUNCH, GRID = vc.FlatPunch(5e-3), vc.Grid((20, 20), (11e-3, 11e-3))
MEAN, SWING = 10.0, 4.0  # N

pytestmark = pytest.mark.filterwarnings(
    "ignore:the contact reaches the end of the indenter's profile:viscontact.AccuracyWarning"
)


def marched(material, load, times, tolerance=1e-9):
    return list(vc.march(PUNCH, material, load, GRID, times, tolerance=tolerance))


def elastic(**load):
    """What a force of 1 N does to a body of J = 1e-9/Pa, times 1e9."""
    body = vc.Material(vc.Elastic(2.5e8), poisson_ratio=0.5)
    (state,) = marched(body, vc.step(1.0, **load), [0.0], tolerance=1e-11)
    return state


@pytest.fixture(scope="module")
def softness():
    """Approach by force and compliance, 1/(2 a) on a fine mesh [1/m]."""
    found = elastic().approach * 1e9
    assert found == close_to(1 / (2 * 5e-3), rel=0.03)
    return found


def complex_compliance(name, frequency):
    """J*, written by hand."""
    s = 1j * frequency
    if name == "relaxation_series":
        fast, slow = 5 * s, 80 * s
        return 0.31 / (2e8 + 3e8 * fast / (1 + fast) + 2e8 * slow / (1 + slow))
    if name == "zener":
        return (1 + 1 / (1 + s * TIME)) / (8 * G)
    if name == "fractional_maxwell":
        return (1 + (s * TIME) ** -0.5) / (4 * G)
    if name == "fractional_zener":
        root = (s * TIME) ** 0.5
        return 1 / (4 * G * (1 + 2 * root / (1 + root)))
    assert name == "power_law"
    return 0.62 * (5e-10 + 8e-10 * gamma(1.5) * (20 * s) ** -0.5)


def harmonic_part(times, values, frequency):
    """Complex amplitude of the last cycle, and its mean; the last instant is the first again."""
    turned = np.exp(-1j * frequency * times)
    return 2 * np.trapezoid(values * turned, times) / np.ptp(times)


@pytest.mark.parametrize(
    ("name", "period", "control"),
    [
        ("relaxation_series", 300.0, "force"),
        pytest.param("relaxation_series", 300.0, "approach", marks=pytest.mark.slow),
        *(
            pytest.param("zener", period, control, marks=pytest.mark.slow)
            for period in (200.0, 50.0, 2000.0)
            for control in ("force", "approach")
        ),
    ],
)
def test_steady_swing_is_the_complex_compliance(softness, name, period, control):
    """Amplitude, phase and loss per cycle, 192 steps in the last cycle, when all else has faded.

    Each cycle before has 32 steps.

    Measured, worst: amplitude 5e-5, phase 5e-5 rad, loss 6e-4, of which (2 pi/192)²/6 = 2e-4 is
    the polygon within the ellipse.
    """
    frequency, compliance = 2 * math.pi / period, complex_compliance(name, 2 * math.pi / period)
    cycles = 2 + math.ceil(12 * TIME / period)
    steady = reference.punch_harmonic(1 / (2 * softness), compliance, force_amplitude=SWING)
    load = (
        vc.harmonic(MEAN, SWING, period, cycles)
        if control == "force"
        else vc.harmonic(
            # So deep that it never lifts off, although a fluid relaxes.
            approach=50 * steady.approach_amplitude,
            amplitude=steady.approach_amplitude,
            period=period,
            cycles=cycles,
        )
    )
    coarse = np.arange(32 * (cycles - 1)) * period / 32
    fine = period * (cycles - 1 + np.arange(193) / 192)
    states = marched(BODIES[name].material, load, np.concatenate([coarse, fine]))
    last = states[-193:]
    force, approach = (
        harmonic_part(fine, over_time(last, of), frequency) for of in ("force", "approach")
    )
    if control == "force":
        assert abs(force) == close_to(SWING, rel=1e-6)
    assert abs(approach / force) == close_to(abs(compliance) * softness, rel=1e-3 / 4)
    lag = np.angle(force / approach)
    assert lag == close_to(steady.phase_lag, abs=1e-3 / 4)
    loss = math.pi * abs(force) ** 2 * -compliance.imag * softness
    assert states[-1].loss_per_cycle == close_to(loss, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "cycles"),
    [
        ("fractional_maxwell", 5),
        ("fractional_zener", 6),
        ("power_law", 10),
    ],
)
def test_swing_of_laws_with_a_wide_spectrum(softness, name, cycles):
    """What creeps under the mean is taken off; what is left settles as a power of time.

    Measured after so many cycles: 3e-4 to 9e-4, which is that.
    """
    period, body = 30.0, BODIES[name]
    frequency, compliance = 2 * math.pi / period, complex_compliance(name, 2 * math.pi / period)
    times = np.linspace(0, cycles * period, 128 * cycles + 1)
    states = marched(body.material, vc.harmonic(MEAN, SWING, period, cycles), times, 1e-7)
    last = times[-129:]
    swung = over_time(states, "approach")[-129:] - MEAN * softness * body.creep(last)
    approach = harmonic_part(last, swung, frequency)
    force = harmonic_part(last, over_time(states, "force")[-129:], frequency)
    assert abs(approach / force / (compliance * softness) - 1) < 1e-3


@pytest.mark.parametrize(
    "steps", [[128, 192], pytest.param([128, 256, 512], marks=pytest.mark.slow)]
)
def test_swing_from_rest_with_its_transient(softness, steps):
    """The whole history (Boltzmann). Measured: order 2.0, down to 4e-6 at 512 steps a cycle."""
    period, body, errors = 150.0, BODIES["zener"], []
    for n in steps:
        times = np.linspace(0, 2 * period, 2 * n + 1)
        exact = reference.punch_harmonic_start(
            times,
            MEAN,
            SWING,
            2 * math.pi / period,
            1 / (2 * softness),
            1 / (8 * G),
            [1 / (8 * G)],
            [TIME],
        )
        states = marched(body.material, vc.harmonic(MEAN, SWING, period, 2), times)
        errors.append(deviation(over_time(states, "approach"), exact))
    assert errors[0] < 1e-4
    assert order(1 / np.array(steps), errors) == close_to(2.0, abs=0.15)


#: A series, a power of time and a table.
BY_DEFAULT = {"burgers", "power_law", "tabulated_creep"}
STAIRS = np.array([0.0, 7.0, 20.0, 31.0, 80.0])  # s
LEVELS = np.array([10.0, 25.0, 4.0, 12.0, 1.0])  # N


def staircase(**aside):
    times = np.concatenate([[0.0], np.repeat(STAIRS[1:], 2)])
    return vc.ForceHistory(times, np.repeat(LEVELS, 2)[:-1], **aside)


@pytest.mark.parametrize(
    "name",
    [
        name if name in BY_DEFAULT else pytest.param(name, marks=pytest.mark.slow)
        for name in BODIES
        if name != "solid_ball_on_a_fluid"
    ],
)
@pytest.mark.parametrize(
    "instants",
    [
        pytest.param([120.0], id="one", marks=pytest.mark.slow),
        pytest.param([3.0, 7.0, 20.0, 26.0, 80.0, 200.0], id="six"),
    ],
)
def test_staircase_of_forces_is_superposed(softness, name, instants):
    """Boltzmann: w = sum of dF_i J(t - t_i)/(2 a), in a few steps as in one.

    Measured: 2e-10, the solver's tolerance being 1e-9; of a table between its rows, 3e-5.
    """
    body = BODIES[name]
    exact = reference.punch_staircase(
        instants, STAIRS, LEVELS, 1 / (2 * softness), body.material.contact_compliance()
    )
    states = marched(body.material, staircase(), instants)
    assert over_time(states, "approach") == close_to(exact, rel=1e-8)
    by_hand = reference.punch_staircase(instants, STAIRS, LEVELS, 1 / (2 * softness), body.creep)
    between = 1e-4 if name.startswith("tabulated") else 1e-6 if name.endswith("bulk") else 1e-9
    assert exact == close_to(by_hand, abs=between * by_hand.max())


def test_staircase_of_eccentric_forces_tilts_by_superposition():
    """Within the kern all of the punch stays in contact, and tilts creep as the approach does."""
    aside = {"eccentricity_x": 0.8e-3, "eccentricity_y": -0.5e-3}
    unit = elastic(**aside)
    instants = np.array([3.0, 7.0, 20.0, 26.0, 80.0, 200.0])
    body = BODIES["burgers"]
    states = marched(body.material, staircase(**aside), instants)
    exact = reference.punch_staircase(instants, STAIRS, LEVELS, 0.5, body.creep) * 1e9
    for name in ("approach", "tilt_x", "tilt_y"):
        found = over_time(states, name)
        assert found == close_to(exact * getattr(unit, name), rel=1e-7)


@pytest.mark.slow
def test_stairs_of_approach_relax():
    """The inverse: F = sum of dw_i M(t - t_i) 2 a. Measured at 100 steps a stair: 1.5e-5."""
    body = BODIES["relaxation_series"]
    (state,) = marched(
        vc.Material(vc.Elastic(2.5e8), 0.5), vc.step(approach=1e-6), [0.0], tolerance=1e-11
    )
    stiffness = state.force / 1e9 / 1e-6  # 2 a
    stairs, levels = np.array([0.0, 10.0, 40.0]), np.array([1e-6, 3e-6, 2e-6])
    load = vc.ApproachHistory([0, 10, 10, 40, 40], levels[[0, 0, 1, 1, 2]])
    steps, errors = np.array([25, 50, 100]), []
    for n in steps:
        times = np.unique(
            np.concatenate([stair + 60 * np.linspace(0, 1, n + 1) ** 2 for stair in stairs])
        )
        states = marched(body.material, load, times)
        jumps = np.diff(levels, prepend=0.0)
        lags = times[:, None] - stairs
        relaxed = body.relaxation(np.maximum(lags, 0.0).ravel()).reshape(lags.shape)
        exact = np.where(lags >= 0, relaxed, 0.0) @ jumps * stiffness
        errors.append(deviation(over_time(states, "force"), exact))
    assert errors[-1] < 5e-5
    assert order(1 / steps, errors) == close_to(2.0, abs=0.3)
