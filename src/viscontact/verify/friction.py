"""Verification cases of friction between elastic bodies: partial slip, torsion, loops."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import scipy  # its special functions are imported at their first use

from viscontact import reference
from viscontact.bodies.friction import Friction
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter, Paraboloid, Roller
from viscontact.bodies.laws import Elastic
from viscontact.bodies.loads import (
    ForceHistory,
    LoadHistory,
    TangentialHistory,
    Travel,
    step,
    tangential_step,
)
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.state import ContactState
from viscontact.simulation.transient.state_generator import march
from viscontact.verify.case import Case, Comparison, Quantity, single

_MODULUS, _RADIUS, _FORCE, _FRICTION = 2e9, 1e-2, 10.0, 0.3  # [Pa, m, N, -]
_PULL = 1.5  # [N]
_UNCOUPLED = Friction(_FRICTION, coupling=False)


#: Without the displacement along the surface under pressure, and without tractions across the pull.
_ELASTIC = Material(Elastic(_MODULUS / 2), poisson_ratio=0.0)


def _marched(
    body: Indenter, load: LoadHistory, tangential: TangentialHistory, grid: Grid
) -> list[ContactState]:
    """States at the points of a tangential load."""
    times = np.unique(tangential.times)
    options: dict[str, Any] = {"friction": _UNCOUPLED, "tangential": tangential, "tolerance": 1e-8}
    return list(march(body, _ELASTIC, load, grid, times, **options))


def _grid_around(half: tuple[float, float], cells: int) -> Grid:
    """Grid around a contact of half axes [m], with cells on each of them and some beyond."""
    count = 2 * (cells + max(3, cells // 8))
    along, across = (each / cells * count for each in half)
    return Grid((count, count), (along, across))


def _pulled(
    cells: int, tangential: TangentialHistory, load: LoadHistory | None = None
) -> list[ContactState]:
    """States of a sphere that is pressed, then pulled; cells on the contact radius."""
    radius = reference.hertz_sphere(_FORCE, _RADIUS, _MODULUS).contact_radius
    grid = _grid_around((radius, radius), cells)
    return _marched(Paraboloid(_RADIUS, _RADIUS), load or step(_FORCE), tangential, grid)


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


def _ellipse(cells: int) -> tuple[Comparison, ...]:
    """Shift and stick area of an ellipse: both as under the normal force, and one less by Q/μ."""
    radii = 2e-2, 5e-3
    full, less = (
        reference.hertz_elliptical(force, *radii, _MODULUS)
        for force in (_FORCE, _FORCE - _PULL / _FRICTION)
    )
    grid = _grid_around((full.semi_axis_x, full.semi_axis_y), cells)
    pull = TangentialHistory([1.0], force_x=_PULL)
    (state,) = _marched(Paraboloid(*radii), step(_FORCE), pull, grid)
    assert state.tangential_displacement_x is not None
    assert state.stick_area is not None
    area = math.pi * less.semi_axis_x * less.semi_axis_y
    return (
        single(_FRICTION * (full.approach - less.approach), state.tangential_displacement_x),
        single(area, state.stick_area),
    )


def _cylinder(cells: int) -> tuple[Comparison, ...]:
    """Traction in the middle and stick width of a line contact."""
    line, part = 2e3, 0.6  # force per length [N/m], pull over what friction carries
    exact = reference.hertz_line(line, _RADIUS, _MODULUS)
    stick = math.sqrt(1 - part)
    edge, count = exact.half_width / cells, 2 * (cells + max(3, cells // 8))
    length = 1e-3
    grid = Grid((1, count), (length, count * edge), periodic=(True, False))
    pull = TangentialHistory([1.0], force_y=part * _FRICTION * line * length)
    (state,) = _marched(Roller(_RADIUS, 1.0), step(line * length), pull, grid)
    assert state.traction_y is not None
    assert state.stick_area is not None
    middle = float(state.traction_y[0, count // 2])
    return (
        single(_FRICTION * exact.peak_pressure * (1 - stick), middle),
        single(2 * stick * exact.half_width, state.stick_area / length),
    )


def _driven(cells: int) -> tuple[Comparison, ...]:
    """Creepage and stick width of a long roller that drives, rolled until it is steady."""
    line, part = 2e3, 0.64  # force per length [N/m], traction over what friction carries
    exact = reference.hertz_line(line, _RADIUS, _MODULUS)
    left = math.sqrt(1 - part)
    edge, steps, length = 2 * exact.half_width / cells, 3 * cells, 1e-3
    travel, count = steps * edge, 7 * cells
    grid = Grid(
        (1, count), (length, count * edge), periodic=(True, False), centre=(0.0, travel / 2)
    )
    *_, last = march(
        Paraboloid(math.inf, _RADIUS),
        _ELASTIC,
        step(line * length, tilt_x=0.0, tilt_y=0.0),
        grid,
        np.arange(steps + 1.0),
        friction=_UNCOUPLED,
        tangential=tangential_step(force_y=-part * _FRICTION * line * length),
        motion=Travel([0.0, steps], y=[0.0, travel], rolling=True),
    )
    assert last.creepage is not None
    assert last.stick_area is not None
    whole = _FRICTION * exact.half_width / _RADIUS  # from which on all slips
    return (
        single(whole * (1 - left), last.creepage),
        single(2 * left * exact.half_width, last.stick_area / length),
    )


def _torsion(cells: int) -> tuple[Comparison, ...]:
    """Twist under the torque at which a part sticks."""
    # The twist is 3 μ W/(4 π G a²) (K - E)(k'), k'² = 1 - c²/a². What is added turns the part that
    # sticks alone, dM = 16/3 G c³ dβ: M = 4 μ W a/π ∫_c^1 s² E(1 - s²) ds.
    stick, limit = 0.6, _FRICTION * _FORCE
    radius = reference.hertz_sphere(_FORCE, _RADIUS, _MODULUS).contact_radius
    missing = 1 - stick**2
    elliptic = scipy.special.ellipk(missing) - scipy.special.ellipe(missing)
    twist = 3 * limit / (4 * math.pi * _MODULUS / 2 * radius**2) * float(elliptic)
    whole, _ = scipy.integrate.quad(lambda s: s**2 * scipy.special.ellipe(1 - s**2), stick, 1)
    torque = 4 * limit * radius / math.pi * whole
    (state,) = _pulled(cells, TangentialHistory([1.0], torque=torque))
    assert state.rotation is not None
    return (single(twist, state.rotation),)


def _rate(cells: int) -> tuple[Comparison, ...]:
    """Shift after loads that vary together, slowly and fast."""
    found = []
    for times in ([0.0, 1.0, 2.0, 3.0], [0.0, 50.0, 60.0, 300.0]):
        pull = TangentialHistory(times, force_x=[0, 1.5, -1.2, 0.3], force_y=[0, 0.5, 0.5, -0.5])
        load = ForceHistory(times, _FORCE * np.array([1.0, 1.0, 1.1, 1.0]))
        last = _pulled(cells, pull, load)[-1]
        assert last.tangential_displacement_x is not None
        found.append(last.tangential_displacement_x)
    return (single(*found),)


def _energy(steps: int) -> tuple[Comparison, ...]:
    """Work of the force in a cycle, and the heat of friction in it; steps of a quarter."""
    turns = np.arange(8 * steps + 1) / (4 * steps)
    forces = _PULL * (1 - np.abs(np.mod(4 * turns - 1, 4) - 2))  # a triangle from zero
    states = _pulled(12, TangentialHistory(4 * turns, force_x=forces))[4 * steps :]
    shifts = [state.tangential_displacement_x or 0.0 for state in states]
    work = float(np.trapezoid([state.tangential_force_x or 0.0 for state in states], shifts))
    return (single((states[-1].friction_heat or 0.0) - (states[0].friction_heat or 0.0), work),)


CASES: tuple[Case, ...] = (
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
        "ellipse, pressed and pulled",
        "Mindlin 1949, Ciavarella 1998",
        (
            Quantity("shift", "m", fast_bound=1e-3, bound=1e-4, has_order=False),
            Quantity("stick area", "m2", fast_bound=5e-2, bound=2e-2, has_order=False),
        ),
        (12, 24, 48),
        _ellipse,
    ),
    Case(
        "cylinder, pressed and pulled across",
        "Cattaneo 1938",
        (
            Quantity("central traction", "Pa", fast_bound=5e-3, bound=1e-3, has_order=False),
            Quantity("stick width", "m", fast_bound=5e-2, bound=2e-2, has_order=False),
        ),
        (20, 40, 80),
        _cylinder,
    ),
    Case(
        "long roller that drives",
        "Carter 1926",
        (
            Quantity("creepage", "1", fast_bound=1e-2, bound=1e-3),
            Quantity("stick width", "m", fast_bound=1e-1, bound=5e-2, has_order=False),
        ),
        (10, 20, 40),
        _driven,
    ),
    Case(
        "sphere, pressed and twisted",
        "Lubkin 1951",
        (Quantity("rotation", "rad", fast_bound=2e-3, bound=2e-4, has_order=False),),
        (12, 24, 48),
        _torsion,
    ),
    Case(
        "sphere under forces that vary together, slowly and fast",
        "rate independence",
        (Quantity("shift", "m", fast_bound=1e-9, bound=1e-9, has_order=False),),
        (12, 24),
        _rate,
    ),
    Case(
        "sphere, pulled back and forth: work of a cycle",
        "heat of friction",
        (Quantity("work", "J", fast_bound=5e-2, bound=1e-2),),
        (4, 8, 16),
        _energy,
    ),
)
