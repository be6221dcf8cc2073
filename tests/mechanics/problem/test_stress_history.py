"""Stresses in layers that creep differently, against numerical inversion of their transforms."""

import mpmath
import numpy as np
import pytest
import scipy

import viscontact as vc
from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.layered_shear_stress import LayeredShearStress
from viscontact.mechanics.halfspace.layered_stress import LayeredStress
from viscontact.mechanics.halfspace.stack_waves import antiplane_waves, stack_waves
from viscontact.mechanics.halfspace.stress import stress_on_plane
from viscontact.mechanics.problem.series_body import ANY_TIMES, span_of
from viscontact.mechanics.problem.stress_history import stress_history

#: A wave of 3 rad per thickness of the first layer, on cells of one of its periods.
WAVE = 3.0
GRID = Grid((16, 1), (2 * np.pi / WAVE, 1.0), periodic=True)
PRESSURE = np.cos(WAVE * GRID.x)[:, None]

#: G(0) = 3 MPa relaxes to 1 MPa in about 1 s.
CREEPING = vc.Zener(3e6, 1.5e6, 4.5e6)


def shear(s):
    """G~(s) = s L[G] of CREEPING: 1/G~ = 1/(3 MPa) + 1/(1.5 MPa + s 4.5 MPa s)."""
    return 1 / (1 / 3e6 + 1 / (1.5e6 + 4.5e6 * s))


def cover(base_modulus):
    """A creeping cover on an elastic base, and its elastic stack at s."""
    top, base = vc.Material(CREEPING, 0.45), vc.Material(vc.Elastic(base_modulus), 0.3)
    body = vc.Layered([vc.Layer(1.0, top)], base=base)
    return body, lambda s: ElasticStack(
        (ElasticLayer(1.0, shear(s), 0.45),), ElasticBase(base_modulus, 0.3)
    )


def coating():
    """An elastic coating on a creeping base, two of whose layers slide."""
    hard, soft = vc.Material(vc.Elastic(2e8), 0.25), vc.Material(CREEPING, 0.4)
    body = vc.Layered([vc.Layer(0.2, hard), vc.Layer(0.8, hard)], base=soft, bonded=[False, True])
    return body, lambda s: ElasticStack(
        (ElasticLayer(0.2, 2e8, 0.25, bonded=False), ElasticLayer(0.8, 2e8, 0.25)),
        ElasticBase(shear(s), 0.4),
    )


def bulky():
    """A half-space of one material with an elastic bulk modulus, as two parts."""
    bulk = 5e6
    material = vc.Material(CREEPING, bulk_modulus=bulk)

    def stack(s):
        g = shear(s)
        nu = (3 * bulk - 2 * g) / (2 * (3 * bulk + g))
        return ElasticStack((ElasticLayer(1.0, g, nu),), ElasticBase(g, nu))

    return vc.Layered([vc.Layer(1.0, material)], base=material), stack


def inverted(stack_at, depth, time, ramp=None):
    """X, Y, S, T at a time after a step of pressure, or a ramp from t = 0, by Talbot's rule."""

    def transform(part):
        def of(s):
            waves = stack_waves(stack_at(complex(s)), np.array([WAVE])).stresses(depth)
            found = (waves.along, waves.across, waves.normal, waves.shear)[part][0]
            return mpmath.mpmathify(complex(found)) / (s if ramp is None else s**2 * ramp)

        return of

    with mpmath.workdps(15):
        return [
            float(mpmath.invertlaplace(transform(part), time, method="talbot", degree=14))
            for part in range(4)
        ]


def ours(body, depth, instants, pressures, span=ANY_TIMES):
    """Amplitudes X, Y, S, T at the last instant of a history of PRESSURE times factors."""
    history = stress_history(body, span)
    fields = np.multiply.outer(np.asarray(pressures), PRESSURE)
    parts = history.loads(np.asarray(instants), fields, np.zeros(0))[:, -1]
    stress = sum(
        stress_on_plane(field, GRID, depth, LayeredStress(stack)).components
        for field, stack in zip(parts, history.stacks, strict=True)
    )[:, :, 0]
    crest, slope = np.cos(WAVE * GRID.x) / 8, np.sin(WAVE * GRID.x) / 8
    return [stress[0] @ crest, stress[1] @ crest, stress[2] @ crest, stress[4] @ slope]


@pytest.mark.parametrize("case", [cover(5e6), cover(1e8), coating(), bulky()])
def test_stresses_after_a_step_follow_the_inverted_transform(case):
    body, stack_at = case
    error = stress_history(body).error
    assert error < 1e-3
    for depth in (0.4, 1.0, 1.3):
        wanted = np.array([inverted(stack_at, depth, time) for time in (0.3, 1.5, 6.0)])
        instants = ([0.0, 0.3], [0.0, 0.1, 1.5], [0.0, 6.0])
        found = np.array([ours(body, depth, each, np.ones(len(each))) for each in instants])
        assert found == close_to(wanted, abs=error * max(1.0, np.abs(wanted).max()))


def sheared_inverted(stack_at, depth, time):
    """X, Y, S, T of sheared waves, Z and V at a time after a step of traction (Talbot)."""

    def transform(part):
        def of(s):
            stack = stack_at(complex(s))
            own = stack_waves(stack, np.array([WAVE]), sheared=True).stresses(depth)
            turned, sideways = antiplane_waves(stack, np.array([WAVE])).stresses(depth)
            found = (own.along, own.across, own.normal, own.shear, turned, sideways)[part][0]
            return mpmath.mpmathify(complex(found)) / s

        return of

    with mpmath.workdps(15):
        return [
            float(mpmath.invertlaplace(transform(part), time, method="talbot", degree=14))
            for part in range(6)
        ]


@pytest.mark.parametrize("case", [cover(5e6), coating(), bulky()])
def test_stresses_after_a_step_of_traction_follow_the_inverted_transform(case):
    body, stack_at = case
    history = stress_history(body, sheared=True)
    assert history.error < 1e-3
    crest, slope = np.cos(WAVE * GRID.x) / 8, np.sin(WAVE * GRID.x) / 8
    for depth in (0.4, 1.0, 1.3):
        for time in (0.3, 6.0):
            exact = sheared_inverted(stack_at, depth, time)
            # Along the wave, which lies along x; then across it.
            for axis, wanted in ((0, exact[:4]), (1, exact[4:])):
                fields = np.multiply.outer(np.ones(2), PRESSURE)
                parts = history.loads(np.array([0.0, time]), fields, np.zeros(0))[:, -1]
                xx, yy, zz, yz, xz, xy = sum(
                    stress_on_plane(field, GRID, depth, LayeredShearStress(stack, axis)).components
                    for field, stack in zip(parts, history.stacks, strict=True)
                )[:, :, 0]
                # i exp(i k x) is -sin(k x) of a traction of cos(k x).
                along = [-xx @ slope, -yy @ slope, -zz @ slope, xz @ crest]
                found = along if axis == 0 else [-xy @ slope, yz @ crest]
                assert found == close_to(wanted, abs=history.error * max(1.0, *np.abs(wanted)))


def test_stresses_change_over_time_under_a_pressure_that_does_not():
    body, stack_at = cover(5e6)
    early, late = (ours(body, 1.0, [0.0, time], [1.0, 1.0]) for time in (1e-6, 50.0))
    assert abs(early[0] - late[0]) > 0.1
    # The ends are those of the elastic stacks before and after all creep.
    for found, s in ((early, 1e9), (late, 1e-9)):
        waves = stack_waves(stack_at(s), np.array([WAVE])).stresses(1.0)
        assert found[0] == close_to(waves.along[0], abs=1e-5)


def test_a_ramp_of_pressure_is_integrated_exactly_by_steps_of_any_size():
    body, stack_at = cover(5e6)
    wanted = inverted(stack_at, 1.0, 2.0, ramp=2.0)
    for instants in ([0.0, 2.0], [0.0, 0.2, 0.5, 2.0]):
        found = ours(body, 1.0, instants, np.asarray(instants) / 2.0)
        assert found == close_to(wanted, abs=stress_history(body).error)


def test_a_load_that_jumps_later_jumps_then():
    body, _ = cover(5e6)
    history = stress_history(body)
    instants, factors = np.array([0.0, 1.0, 3.0]), np.array([0.0, 0.0, 1.0])
    fields = np.multiply.outer(factors, PRESSURE)
    jumped = history.loads(instants, fields, np.array([2.0]))[:, -1]
    fields = np.multiply.outer(np.array([1.0, 1.0]), PRESSURE)
    stepped = history.loads(np.array([0.0, 1.0]), fields, np.zeros(0))[:, -1]
    assert jumped == close_to(stepped, rel=1e-9)


def test_stresses_of_a_power_law_follow_the_inverted_transform():
    law = vc.PowerLaw(1e-6, 0.3, 1.0, instant=1e-7)
    core = vc.Material(vc.Elastic(1e6), 0.3)
    body = vc.Layered([vc.Layer(1.0, vc.Material(law, 0.4))], base=core)
    span = span_of([0.0, 6.0])

    def stack_at(s):
        creep = 1e-7 + 1e-6 * scipy.special.gamma(1.3) * s**-0.3
        return ElasticStack((ElasticLayer(1.0, 0.5 / creep, 0.4),), ElasticBase(1e6, 0.3))

    error = stress_history(body, span).error
    assert error < 5e-3
    for depth in (0.4, 1.3):
        wanted = np.array([inverted(stack_at, depth, time) for time in (0.3, 6.0)])
        instants = ([0.0, 0.3], [0.0, 6.0])
        found = np.array([ours(body, depth, each, np.ones(2), span) for each in instants])
        assert found == close_to(wanted, abs=error * max(1.0, np.abs(wanted).max()))
