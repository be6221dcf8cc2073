"""Verification cases of given pressures: displacement and stresses without a contact problem."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from viscontact import reference
from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.laws import CreepSeries, Elastic
from viscontact.bodies.loads import Travel
from viscontact.bodies.materials.layers import Layer, Layered
from viscontact.bodies.materials.material import Material
from viscontact.results.stresses import section_stresses
from viscontact.runs.under_pressure import under_pressure
from viscontact.verify.case import Case, Comparison, Quantity, history, single

_MODULUS = 1e9  # E* [Pa]
_BODY = Material(Elastic.from_uniaxial(_MODULUS * (1 - 0.3**2), 0.3), poisson_ratio=0.3)
_PRESSURE = 1e6  # [Pa]


def _field(exact: ArrayLike, ours: ArrayLike) -> Comparison:
    """Comparison of two fields where they differ most, relative to the largest value."""
    return history(np.ravel(exact), np.ravel(ours))


def _point(cells: int) -> tuple[Comparison, ...]:
    """A force on one cell, seen from a distance."""
    count = 2 * cells + 1
    grid = Grid((count, count), (3e-3, 3e-3))
    pressure = np.zeros(grid.shape)
    pressure[cells, cells] = 1.0 / grid.cell_area
    found = under_pressure(pressure, _BODY, grid, errors=False).displacement.values[0]
    distant = np.hypot(grid.x[:, None], grid.y) > 0.4e-3
    exact = reference.point_load(1.0, _MODULUS, np.hypot(grid.x[:, None], grid.y)[distant])
    return (_field(exact, found[distant]),)


def _rectangle(cells: int) -> tuple[Comparison, ...]:
    """Uniform pressure on a rectangle, on a grid beyond it."""
    a, b = 1e-3, 0.5e-3
    grid = Grid((2 * cells, 2 * cells), (4e-3, 2e-3))
    inside = (np.abs(grid.x)[:, None] < a) & (np.abs(grid.y) < b)
    ds = under_pressure(_PRESSURE * inside, _BODY, grid, errors=False)
    exact = reference.rectangle_displacement(
        _PRESSURE, a, b, _MODULUS, grid.x[:, None], grid.y[None, :]
    )
    y = float(grid.y[cells])
    depths = np.array([0.1e-3, 0.5e-3, 2e-3])
    inside_body = section_stresses(ds, depths, y=y).stress_zz.values[0]
    stress = reference.rectangle_stress(_PRESSURE, a, b, grid.x, y, depths[:, None])
    return _field(exact, ds.displacement.values[0]), _field(stress, inside_body)


def _hertz(cells: int) -> tuple[Comparison, ...]:
    """Hertz's pressure as a formula: the parabola that it presses."""
    a = 1e-3

    def pressure(x: Floats, y: Floats) -> Floats:
        return np.asarray(_PRESSURE * np.sqrt(np.maximum(1 - (x**2 + y**2) / a**2, 0.0)))

    count = 2 * cells + 1
    grid = Grid((count, count), (2.2 * a, 2.2 * a))
    ds = under_pressure(pressure, _BODY, grid, errors=False)
    r = np.hypot(grid.x[:, None], grid.y)
    exact = math.pi * _PRESSURE / (4 * a * _MODULUS) * (2 * a * a - r**2)
    inner = r < 0.8 * a
    return (_field(exact[inner], ds.displacement.values[0][inner]),)


def _circle(cells: int, power: int) -> tuple[Comparison, ...]:
    """Pressure (1 - r²/a²)^power on a circle: at its centre, and the stress below that."""
    a, count = 1e-3, 2 * cells + 1

    def pressure(x: Floats, y: Floats) -> Floats:
        inside = 1 - (x**2 + y**2) / a**2
        return np.asarray(_PRESSURE * np.where(inside > 0, inside**power, 0.0))

    grid = Grid((count, count), (2.2 * a, 2.2 * a))
    ds = under_pressure(pressure, _BODY, grid, errors=False)
    centre = (2.0, 4 / 3)[power] * _PRESSURE * a / _MODULUS
    depths = np.array([0.3e-3, 1e-3, 3e-3])
    below = section_stresses(ds, depths, y=0.0).stress_zz.values[0, :, cells]
    z, far = depths, np.sqrt(a**2 + depths**2)
    shares = 1 - (z / far) ** 3
    if power:
        shares = (1 + (z / a) ** 2) * shares - 3 * (z / a) ** 2 * (1 - z / far)
    found = float(ds.displacement[0, cells, cells])
    return single(centre, found), _field(-_PRESSURE * shares, below)


def _strip(cells: int) -> tuple[Comparison, ...]:
    """Stresses under a long strip."""
    b = 0.5e-3
    grid = Grid((1, 2 * cells), (1e-3, 2e-3), periodic=(True, False))
    pressure = _PRESSURE * (np.abs(grid.y) < b)[None, :]
    depths = np.array([0.1e-3, 0.5e-3, 2e-3])
    ds = under_pressure(pressure, _BODY, grid, errors=False)
    found = section_stresses(ds, depths, x=0.0)
    across, vertical = reference.strip_stresses(_PRESSURE, b, grid.y, depths[:, None])
    return (
        _field(vertical, found.stress_zz.values[0]),
        _field(across, found.stress_yy.values[0]),
    )


def _layer(cells: int) -> tuple[Comparison, ...]:
    """A long strip on a layer that slides on a rigid base."""
    b, thickness = 0.5e-3, 1e-3
    grid = Grid((1, 4 * cells), (1e-3, 4e-3), periodic=(True, False))
    pressure = _PRESSURE * (np.abs(grid.y) < b)[None, :]
    body = Layered([Layer(thickness, _BODY)], base="rigid", bonded=False)
    found = under_pressure(pressure, body, grid, errors=False).displacement.values[0, 0]
    exact = [reference.strip_on_layer(_PRESSURE, b, thickness, _MODULUS, y) for y in grid.y]
    return (_field(exact, found),)


def _wave(cells: int) -> tuple[Comparison, ...]:
    """A wave of pressure in motion: size and lag of the displacement are those of J*(k V)."""
    instant, delayed, time, length, speed = 5e-10, 4.5e-9, 1.0, 1e-3, 5e-5
    wave, way = 2 * math.pi / length, 20 * length
    body = Material(CreepSeries(instant, [delayed], [time]), poisson_ratio=0.0)
    grid = Grid((1, cells), (length / 4, length), periodic=True)

    def pressure(x: Floats, y: Floats) -> Floats:
        return np.asarray(_PRESSURE * (1 + np.cos(wave * y)) + 0.0 * x)

    motion = Travel([0.0, way / speed], y=[0.0, way])
    last = under_pressure(pressure, body, grid, [way / speed], motion=motion, errors=False)
    found = complex(2 * np.mean(last.displacement.values[0, 0] * np.exp(1j * wave * grid.y)))
    compliance = instant + delayed / (1 + 1j * wave * speed * time)
    exact = 2 * _PRESSURE / wave * compliance
    return single(abs(exact), abs(found)), single(np.angle(exact), float(np.angle(found)))


CASES: tuple[Case, ...] = (
    Case(
        "point load",
        "Boussinesq 1885",
        (Quantity("displacement", "m", 2e-3, 2e-4),),
        (16, 32, 64),
        _point,
    ),
    Case(
        "uniform pressure on a rectangle",
        "Love 1929",
        (
            Quantity("displacement", "m", 1e-10, 1e-10),
            Quantity("vertical stress", "Pa", 1e-9, 1e-9),
        ),
        (8, 16),
        _rectangle,
    ),
    Case(
        "Hertz's pressure",
        "Hertz 1882",
        (Quantity("displacement", "m", 2e-3, 2e-4),),
        (16, 32, 64),
        _hertz,
    ),
    Case(
        "uniform pressure on a circle",
        "Love 1929",
        (
            Quantity("displacement at the centre", "m", 5e-3, 5e-3, has_order=False),
            Quantity("stress below it", "Pa", 1e-2, 1e-2, has_order=False),
        ),
        (16, 32, 64),
        partial(_circle, power=0),
    ),
    Case(
        "parabolic pressure on a circle",
        "Love 1929",
        (
            Quantity("displacement at the centre", "m", 2e-3, 2e-4),
            Quantity("stress below it", "Pa", 2e-3, 2e-4),
        ),
        (16, 32, 64),
        partial(_circle, power=1),
    ),
    Case(
        "uniform pressure on a strip",
        "Johnson 1985",
        (
            Quantity("vertical stress", "Pa", 1e-6, 1e-6),
            Quantity("stress across", "Pa", 1e-6, 1e-6),
        ),
        (16, 32),
        _strip,
    ),
    Case(
        "uniform pressure on a strip of a layer",
        "Sneddon 1951",
        (Quantity("displacement", "m", 1e-6, 1e-6),),
        (8, 16),
        _layer,
    ),
    Case(
        "moving wave of pressure",
        "Boltzmann 1874",
        (Quantity("amplitude", "m", 5e-3, 1e-3), Quantity("lag", "rad", 2e-3, 2e-4)),
        (16, 32, 64),
        _wave,
    ),
)
