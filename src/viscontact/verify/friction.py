"""Verification cases of friction: partial slip of a sphere, and an oblique load that creeps."""

from __future__ import annotations

import math

import numpy as np

from viscontact import reference
from viscontact.bodies.friction import Friction
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Paraboloid
from viscontact.bodies.laws import CreepSeries, Elastic
from viscontact.bodies.loads import TangentialHistory, step, tangential_step
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.state import ContactState
from viscontact.simulation.transient.state_generator import march
from viscontact.verify.case import Case, Comparison, Quantity, single

_MODULUS, _RADIUS, _FORCE, _FRICTION = 2e9, 1e-2, 10.0, 0.3  # [Pa, m, N, -]
_PULL = 1.5  # [N]
#: Without the displacement along the surface under pressure, and without tractions across the pull.
_UNCOUPLED = Friction(_FRICTION, coupling=False)


def _pulled(cells: int, tangential: TangentialHistory) -> list[ContactState]:
    """States of an elastic sphere that is pressed, then pulled; cells on the contact radius."""
    exact = reference.hertz_sphere(_FORCE, _RADIUS, _MODULUS)
    edge, count = exact.contact_radius / cells, 2 * (cells + max(3, cells // 8))
    grid = Grid((count, count), (count * edge, count * edge))
    material = Material(Elastic(_MODULUS / 2), poisson_ratio=0.0)
    return list(
        march(
            Paraboloid(_RADIUS, _RADIUS),
            material,
            step(_FORCE),
            grid,
            np.unique(tangential.times),
            friction=_UNCOUPLED,
            tangential=tangential,
            tolerance=1e-8,
        )
    )


def _sphere(cells: int) -> tuple[Comparison, ...]:
    """Shift and stick radius under a force."""
    exact = reference.cattaneo_mindlin(_FORCE, _RADIUS, _MODULUS, _PULL, _FRICTION)
    (state,) = _pulled(cells, TangentialHistory([1.0], force_x=_PULL))
    assert state.tangential_displacement_x is not None
    assert state.stick_area is not None
    stick = math.sqrt(state.stick_area / math.pi)
    return (
        single(exact.displacement, state.tangential_displacement_x),
        single(exact.stick_radius, stick),
    )


def _loop(cells: int) -> tuple[Comparison, ...]:
    """Heat of the second cycle of a force, in one step a quarter."""
    exact = reference.cattaneo_mindlin(_FORCE, _RADIUS, _MODULUS, _PULL, _FRICTION)
    forces = _PULL * np.array([0, 1, 0, -1, 0, 1, 0, -1])
    states = _pulled(cells, TangentialHistory(np.arange(8.0), force_x=forces))
    heats = [state.friction_heat or 0.0 for state in states]
    return (single(exact.heat_of_cycle, heats[7] - heats[3]),)


def _oblique(cells: int) -> tuple[Comparison, ...]:
    """Normal and tangential force together on a creeping sphere, of which nothing slips."""
    part, ratio = 0.15, 0.5
    instant, delayed = 5e-10 / (1 - ratio), 4.5e-9 / (1 - ratio)
    material = Material(CreepSeries(instant, [delayed], [10.0]), poisson_ratio=ratio)
    grown = instant + delayed * (1 - math.exp(-1.0))
    radius = (0.75 * _FORCE * _RADIUS * (1 - ratio) * grown) ** (1 / 3)
    edge, count = radius / cells, 2 * (cells + max(3, cells // 8))
    grid = Grid((count, count), (count * edge, count * edge))
    *_, last = march(
        Paraboloid(_RADIUS, _RADIUS),
        material,
        step(_FORCE),
        grid,
        np.linspace(0.0, 10.0, 7),
        friction=_FRICTION,
        tangential=tangential_step(force_x=part * _FORCE),
        tolerance=1e-8,
    )
    assert last.tangential_displacement_x is not None
    exact = part * (2 - ratio) / (2 * (1 - ratio)) * last.approach
    return (single(exact, last.tangential_displacement_x),)


CASES = (
    Case(
        "sphere, pressed and pulled",
        "Cattaneo 1938, Mindlin 1949",
        (
            Quantity("shift", "m", fast_bound=1e-3, bound=1e-4, has_order=False),
            Quantity("stick radius", "m", fast_bound=3e-2, bound=1e-2, has_order=False),
        ),
        (12, 24, 48),
        _sphere,
    ),
    Case(
        "sphere, pulled back and forth",
        "Mindlin & Deresiewicz 1953",
        (Quantity("heat of a cycle", "J", fast_bound=1e-2, bound=2e-3, has_order=False),),
        (12, 24, 48),
        _loop,
    ),
    Case(
        "sphere on a Zener body, pressed obliquely",
        "Mindlin & Deresiewicz 1953, by correspondence",
        (Quantity("shift over approach", "m", fast_bound=1e-3, bound=1e-4, has_order=False),),
        (8, 16, 32),
        _oblique,
    ),
)
