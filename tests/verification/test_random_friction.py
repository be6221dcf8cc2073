"""Random bodies, laws and histories under friction: every step is certified by its duality gap."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from campaigns import tried

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

#: Corners of the loads [s], and the choices of the normal force there [N].
CORNERS, LEVELS = np.arange(6.0), [0.02, 0.05, 0.1, 0.0]


def body(random: np.random.Generator) -> vc.Indenter:
    if random.random() < 0.25:
        axis = np.linspace(-2e-3, 2e-3, 30)
        rough = vc.HeightMap(axis, axis, 3e-6 * random.standard_normal((30, 30)))
        return rough + vc.Sphere(0.02)
    shapes = [vc.Sphere(0.01), vc.Paraboloid(0.01, 0.02), vc.FlatPunch(3e-4), vc.Cone(1.4)]
    return shapes[random.integers(4)]


def material(random: np.random.Generator) -> vc.Material:
    laws = [
        vc.Elastic(1e6),
        vc.Zener(1e6, random.uniform(2e5, 2e6), 1e6),
        vc.Maxwell(1e6, 2e6),
        vc.PowerLaw(2e-7, 0.3, 1.0, instant=3e-7),
    ]
    return vc.Material(laws[random.integers(4)], random.choice([0.5, random.uniform(0, 0.5)]))


def layers(random: np.random.Generator) -> vc.Layered:
    """One layer or two that creep differently, thinner or thicker than the contact is wide."""
    thickness, kind = 10 ** random.uniform(-4.3, -2.8), random.integers(3)
    base = "rigid" if kind == 0 else material(random)
    own = [vc.Layer(thickness, material(random))]
    if kind == 2:
        own.append(vc.Layer(thickness * random.uniform(0.5, 3.0), material(random)))
    return vc.Layered(own, base=base)


def tangential(random: np.random.Generator, most: np.ndarray) -> vc.TangentialHistory:
    """Forces up to a limit at each corner along any direction or x, or motions."""
    forces = most * random.uniform(-0.95, 0.95, most.size)
    forces[0] = 0.0
    kind = random.integers(3)
    if kind == 0:
        return vc.TangentialHistory(CORNERS, force_x=forces)
    if kind == 1:
        angle = random.uniform(0, 2 * np.pi)
        along, across = forces * np.cos(angle), forces * np.sin(angle)
        return vc.TangentialHistory(CORNERS, force_x=along, force_y=across)
    ways = random.normal(size=(3, CORNERS.size)) * 1e-5 * random.choice([0.1, 1.0, 10.0])
    turned = None if random.random() < 0.5 else 1e3 * ways[2]
    return vc.TangentialHistory(
        CORNERS, displacement_x=ways[0], displacement_y=ways[1], rotation=turned
    )


def largest_gap(seed: int, *, coupling: bool = False, layered: bool = False) -> float:
    """Largest duality gap of a random run, whose normal force goes to zero and back."""
    random = np.random.default_rng(seed)
    levels = np.append(0.05, random.choice(LEVELS, 5, p=[0.3, 0.3, 0.3, 0.1]))
    coefficient = float(random.choice([0.05, 0.3, 0.9]))
    # Below what friction carries at the corners, and so between them.
    least = np.minimum(levels, np.minimum(np.roll(levels, 1), np.roll(levels, -1)))
    cells = int(random.integers(28, 48))
    states = list(
        vc.march(
            body(random),
            layers(random) if layered else material(random),
            vc.ForceHistory(CORNERS, levels, tilt_x=0.0, tilt_y=0.0),
            vc.Grid((cells, cells), (4e-3, 4e-3)),
            np.linspace(0, 5, 16),
            indenter_material=material(random) if coupling and random.random() < 0.5 else None,
            friction=vc.Friction(coefficient, coupling=coupling),
            tangential=tangential(random, coefficient * least),
        )
    )
    heats = np.array([state.friction_heat for state in states])
    assert (np.diff(heats) >= 0).all()
    for state in states:
        size = np.hypot(state.traction_x, state.traction_y)
        assert (size <= coefficient * state.pressure * (1 + 1e-9)).all()
    return max(state.duality_gap for state in states)


@pytest.mark.parametrize("seed", range(4))
def test_random_histories_are_certified(seed):
    assert largest_gap(seed) < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("first", range(100, tried(200, 400), 50))
def test_many_random_histories_are_certified(first):
    assert max(largest_gap(seed) for seed in range(first, first + 50)) < 1e-6


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow), 2])
def test_random_histories_of_coupled_bodies_are_certified(seed):
    """The gap of the bipotential, of pressure and tractions together."""
    assert largest_gap(seed, coupling=True) < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("first", range(600, tried(625, 700), 25))
def test_many_random_histories_of_coupled_bodies_are_certified(first):
    assert max(largest_gap(seed, coupling=True) for seed in range(first, first + 25)) < 1e-6


@pytest.mark.parametrize("seed", [3, 6, 13])
@pytest.mark.parametrize("coupling", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_random_histories_on_layers_are_certified(seed, coupling):
    assert largest_gap(seed, coupling=coupling, layered=True) < 1e-6


@pytest.mark.slow
def test_many_random_histories_on_layers_are_certified():
    seeds = (4, 5, 8, 10, 11, 12, 14, 15, 16, 17)  # whose layers separate in few terms
    assert max(largest_gap(seed, layered=True) for seed in seeds) < 1e-6
