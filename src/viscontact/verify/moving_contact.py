"""Verification cases of moving contacts: steady limits, and conservation of energy."""

from __future__ import annotations

import math

import numpy as np

from viscontact import reference
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Paraboloid, Waviness
from viscontact.bodies.laws import CreepSeries
from viscontact.bodies.loads import ForceHistory, Travel, reciprocating, step
from viscontact.bodies.materials.material import Material
from viscontact.simulation.transient.state_generator import march
from viscontact.verify.case import Case, Comparison, Quantity, single

_INSTANT, _DELAYED, _TIME = 5e-10, 4.5e-9, 10.0  # J0, J1 [1/Pa] and retardation time [s]
_BODY = Material(CreepSeries(_INSTANT, [_DELAYED], [_TIME]), poisson_ratio=0.0)
_RADIUS = 1e-2  # [m]
_FORCE, _PERIOD = 10.0, 1e-3  # on a length of a cylinder [N, m]
_SPEED = 1e-4  # [m/s]


def _cylinder(cells: int) -> tuple[Comparison, ...]:
    """A cylinder after a way of eight times that in the retardation time, at whole cells."""
    exact = reference.moving_cylinder(
        _FORCE / _PERIOD, _RADIUS, _INSTANT, _DELAYED, _TIME, speed=_SPEED
    )
    cell = exact.half_width / (cells + 0.3)
    way = math.ceil(8 * _SPEED * _TIME / cell) * cell
    count = round((way + 5 * exact.half_width) / cell)
    grid = Grid((1, count), (_PERIOD, count * cell), periodic=(True, False), centre=(0.0, way / 2))
    motion = Travel([0.0, way / _SPEED], y=[0.0, way])
    load = step(_FORCE, tilt_y=0.0)
    bodies = Paraboloid(math.inf, _RADIUS), _BODY
    *_, last = march(*bodies, load, grid, motion=motion, tolerance=1e-8, fields="none")
    assert last.friction_coefficient is not None
    return (
        single(exact.friction_coefficient, last.friction_coefficient),
        single(exact.half_width, last.contact_width / 2),
    )


def _wave(cells: int) -> tuple[Comparison, ...]:
    """A wave in full contact: pressure lags by the loss angle of M*(k V)."""
    height, length, speed = 1e-7, 1e-3, 5e-5
    frequency = 2 * math.pi / length * speed
    loss = (1 / (_INSTANT + _DELAYED / (1 + 1j * frequency * _TIME))).imag
    exact = reference.moving_wave_resistance(height, length, loss)
    grid = Grid((4, cells), (4 * length / cells, length), periodic=True)
    times = np.arange(4 * cells + 1) * length / cells / speed
    motion = Travel([0.0, times[-1]], y=[0.0, 4 * length])
    bodies = Waviness(height, wavelength_y=length), _BODY
    *_, last = march(*bodies, step(2e6 * grid.area), grid, times, motion=motion, fields="none")
    assert last.resistance_y is not None
    return (single(exact, last.resistance_y / grid.area),)


def _cycle(cells: int) -> tuple[Comparison, ...]:
    """A wave that is pressed on, moved back and forth, and lifted: all work becomes heat."""
    length = 1e-3
    grid = Grid((4, cells), (4 * length / cells, length), periodic=True)
    force = 2e5 * grid.area
    load = ForceHistory([0, 2, 14, 16, 500], [0, force, force, 0, 0])
    loaded = np.linspace(0.0, 16.0, 3 * cells + 1)
    times = np.concatenate([loaded, 16 + np.geomspace(16 / cells, 484.0, cells)])
    motion = reciprocating(2e-4, 16.0, cycles=1)
    bodies = Waviness(1e-6, wavelength_y=length), _BODY
    *_, last = march(*bodies, load, grid, times, motion=motion, fields="none")
    assert last.motion_work is not None
    assert last.heat is not None
    return (single(last.work + last.motion_work, last.heat),)


CASES: tuple[Case, ...] = (
    Case(
        "cylinder from rest to steady motion",
        "Hunter 1961",
        (
            Quantity("friction coefficient", "1", 1e-3, 2e-4),
            Quantity("half width", "m", 1e-3, 1e-3, has_order=False),
        ),
        (10, 20, 40),
        _cylinder,
    ),
    Case(
        "moving wave in full contact",
        "Johnson 1985",
        (Quantity("resistance over area", "Pa", 1e-3, 2.5e-4),),
        (16, 32, 64),
        _wave,
    ),
    Case(
        "reciprocating wave",
        "conservation of energy",
        (Quantity("heat", "J", 1e-2, 2e-3),),
        (16, 32, 64),
        _cycle,
    ),
)
