"""Verification cases of friction on creeping bodies."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import scipy  # its quadrature is imported at its first use

from viscontact.bodies.friction import Friction
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Paraboloid
from viscontact.bodies.laws import CreepSeries
from viscontact.bodies.loads import LoadHistory, TangentialHistory, step, tangential_step
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.state import ContactState
from viscontact.simulation.transient.state_generator import march
from viscontact.verify.case import Case, Comparison, Quantity, single

_RADIUS, _FORCE, _FRICTION = 1e-2, 10.0, 0.3  # [m, N, -]
#: Contact compliance at once and at last [1/Pa], and retardation time [s].
_INSTANT, _LATE, _RETARDATION = 5e-10, 5e-9, 10.0


def _compliance(time: float) -> float:
    """Contact compliance J(t) [1/Pa]."""
    return _INSTANT + (_LATE - _INSTANT) * (1 - math.exp(-time / _RETARDATION))


def _radius(compliance: float) -> float:
    """Contact radius under the force at a compliance [m]."""
    return float((0.75 * _FORCE * _RADIUS * compliance) ** (1 / 3))


def _states(
    load: LoadHistory, tangential: TangentialHistory, cells: int, times: Any, ratio: float = 0.0
) -> list[ContactState]:
    """States of a sphere on a body of these compliances; cells on the radius after 10 s."""
    parts = _INSTANT / (1 - ratio), (_LATE - _INSTANT) / (1 - ratio)
    material = Material(CreepSeries(parts[0], [parts[1]], [_RETARDATION]), poisson_ratio=ratio)
    edge, count = _radius(_compliance(10.0)) / cells, 2 * (cells + max(3, cells // 8))
    grid, body = Grid((count, count), (count * edge, count * edge)), Paraboloid(_RADIUS, _RADIUS)
    friction = Friction(_FRICTION, coupling=ratio == 0.5)
    options: dict[str, Any] = {"friction": friction, "tangential": tangential, "tolerance": 1e-8}
    return list(march(body, material, load, grid, times, **options))


def _oblique(cells: int) -> tuple[Comparison, ...]:
    """Normal and tangential force together, under which nothing slips."""
    part, ratio = 0.15, 0.5
    pull = tangential_step(force_x=part * _FORCE)
    last = _states(step(_FORCE), pull, cells, np.linspace(0.0, 10.0, 7), ratio)[-1]
    assert last.tangential_displacement_x is not None
    exact = part * (2 - ratio) / (2 * (1 - ratio)) * last.approach
    return (single(exact, last.tangential_displacement_x),)


def _jump(cells: int) -> tuple[Comparison, ...]:
    """Force that jumps after the contact has grown: the slip of the instant compliance."""
    # The pressure of Lee and Radok is a sum of those of flat punches of all radii s,
    # h(s) ds/sqrt(s² - r²), h = 2 M(t - t(s)) s/(π R), with the time t(s) at which the contact had
    # the radius s. By Ciavarella (1998) the tractions are μ of those with s > c.
    time, force, instant = 10.0, 1.5, _radius(_INSTANT)
    edge = _radius(_compliance(time))

    def density(s: float) -> float:
        grown = 4 * s**3 / (3 * _FORCE * _RADIUS)
        begun = 0.0
        if grown > _INSTANT:
            begun = -_RETARDATION * math.log(1 - (grown - _INSTANT) / (_LATE - _INSTANT))
        decay = math.exp(-(time - begun) * _LATE / (_RETARDATION * _INSTANT))
        return 2 * (1 / _LATE + (1 / _INSTANT - 1 / _LATE) * decay) * s / (math.pi * _RADIUS)

    def carried(c: float) -> float:
        points = [instant] if c < instant else None
        ring = scipy.integrate.quad(lambda s: s * density(s), c, edge, points=points)[0]
        return float(_FRICTION * 2 * math.pi * ring)

    stick = scipy.optimize.brentq(lambda c: carried(c) - force, 0.0, edge)
    shift = _FRICTION * math.pi * _INSTANT * scipy.integrate.quad(density, stick, edge)[0]
    times = np.append(0.0, np.geomspace(0.02, time, 60))
    pull = TangentialHistory([time], force_x=force)
    last = _states(step(_FORCE), pull, cells, times)[-1]
    assert last.tangential_displacement_x is not None
    return (single(shift, last.tangential_displacement_x),)


def _clamped(steps: int) -> tuple[Comparison, ...]:
    """Held approach and shift: the tangential force relaxes as the contact modulus."""
    approach, end = _radius(_INSTANT) ** 2 / _RADIUS, 2.0
    first, *_, last = _states(
        step(approach=approach),
        tangential_step(displacement_x=0.2 * approach),
        16,
        np.linspace(0.0, end, steps + 1),
    )
    assert first.tangential_force_x is not None
    assert last.tangential_force_x is not None
    ratio = _INSTANT / _LATE
    relaxed = ratio + (1 - ratio) * math.exp(-end / (_RETARDATION * ratio))
    return (single(relaxed * first.tangential_force_x, last.tangential_force_x),)


CASES: tuple[Case, ...] = (
    Case(
        "sphere on a Zener body, pressed obliquely",
        "Mindlin & Deresiewicz 1953, by correspondence",
        (Quantity("shift over approach", "m", fast_bound=1e-3, bound=1e-4, has_order=False),),
        (8, 16, 32),
        _oblique,
    ),
    Case(
        "sphere on a Zener body, pulled by a jump after growth",
        "Lee & Radok 1960, Ciavarella 1998",
        (Quantity("shift", "m", fast_bound=5e-3, bound=1e-3, has_order=False),),
        (12, 24, 48),
        _jump,
    ),
    Case(
        "sphere on a Zener body, clamped",
        "correspondence principle",
        (Quantity("tangential force", "N", fast_bound=1e-2, bound=1e-3, has_order=False),),
        (25, 50, 100),
        _clamped,
    ),
)
