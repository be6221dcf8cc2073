"""Verification cases of given pressures: displacement and stresses without a contact problem."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from viscontact import reference
from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.laws import CreepSeries, Elastic
from viscontact.bodies.loads import Travel
from viscontact.bodies.materials.layers import Layer, Layered
from viscontact.bodies.materials.material import Material
from viscontact.results.stresses import section_stresses
from viscontact.runs.given_pressure.near_field import NearField
from viscontact.runs.given_pressure.resolved import resolved
from viscontact.runs.under_pressure import under_pressure
from viscontact.verify.case import Case, Comparison, Quantity, history, single

_MODULUS = 1e9  # E* [Pa]
_BODY = Material(Elastic.from_uniaxial(_MODULUS * (1 - 0.3**2), 0.3), poisson_ratio=0.3)
_PRESSURE = 1e6  # [Pa]


def _field(exact: ArrayLike, ours: ArrayLike) -> Comparison:
    """Comparison of two fields where they differ most, relative to the largest value."""
    return history(np.ravel(exact), np.ravel(ours))


def _extrapolated(value: Callable[[int], Floats], cells: int) -> Floats:
    """Value at the limit of small cells, from cells and from three times as many along a length."""
    coarse, fine = value(cells), value(3 * cells)
    return np.asarray(fine + (fine - coarse) / 8)


def _point(cells: int) -> tuple[Comparison, ...]:
    """A force on one cell, seen from a distance, and extrapolated to one on a point."""
    count = 2 * cells + 1
    grid = Grid((count, count), (3e-3, 3e-3))
    distance = np.hypot(grid.x[:, None], grid.y)
    distant = distance > 0.4e-3

    def displacement(cells: int) -> Floats:
        finer, times = replace(grid, shape=(cells, cells)), cells // count
        pressure = np.zeros(finer.shape)
        pressure[cells // 2, cells // 2] = 1.0 / finer.cell_area
        found = under_pressure(pressure, _BODY, finer, errors=False).displacement.values[0]
        return np.asarray(found[times // 2 :: times, times // 2 :: times][distant])

    exact = reference.point_load(1.0, _MODULUS, distance[distant])
    return (_field(exact, _extrapolated(displacement, count)),)


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


@dataclass(frozen=True)
class _Round:
    """A pressure on a circle of unit radius, over its peak, and the stress on its axis."""

    shape: Callable[[Floats], Floats]  # of 1 - r², positive inside
    stress: Callable[[Floats, Floats], Floats]  # of the depth z and of (1 + z²)^(1/2)
    centre: float  # displacement, over p a/E*
    displacement: Callable[..., ArrayLike] | None = None  # of p, a, E* and r


_UNIFORM = _Round(
    np.ones_like, lambda z, far: 1 - (z / far) ** 3, 2.0, reference.circle_displacement
)
_HERTZ = _Round(np.sqrt, lambda _, far: 1 / far**2, math.pi / 2, reference.hertz_displacement)
_PARABOLA = _Round(
    np.array, lambda z, far: far**2 * (1 - (z / far) ** 3) - 3 * z**2 * (1 - z / far), 4 / 3
)
_CONE = _Round(lambda inside: 1 - np.sqrt(1 - inside), lambda z, far: 1 - z / far, 1.0)


def _circle(cells: int, load: _Round) -> tuple[Comparison, ...]:
    """Pressure on a circle as a formula: displacement of the surface, stress on the axis."""
    a, count = 1e-3, 2 * cells + 1
    depths = np.array([0.3e-3, 1e-3, 3e-3])

    def pressure(x: Floats, y: Floats) -> Floats:
        inside = 1 - (x**2 + y**2) / a**2
        return np.asarray(_PRESSURE * np.where(inside > 0, load.shape(np.maximum(inside, 0.0)), 0))

    def stress(cells: int) -> Floats:
        finer = Grid((cells, cells), (2.6 * a, 2.6 * a))
        means = resolved(
            pressure, NearField(finer)
        ).means  # without the displacement of the formula
        ds = under_pressure(means, _BODY, finer, errors=False)
        return np.asarray(section_stresses(ds, depths, y=0.0).stress_zz.values[0, :, cells // 2])

    grid = Grid((count, count), (2.6 * a, 2.6 * a))
    found = under_pressure(pressure, _BODY, grid, errors=False).displacement.values[0]
    on_axis = -_PRESSURE * load.stress(depths / a, np.sqrt(1 + (depths / a) ** 2))
    below = _field(on_axis, _extrapolated(stress, count))
    if load.displacement is None:
        exact = load.centre * _PRESSURE * a / _MODULUS
        return single(exact, float(found[cells, cells])), below
    r = np.hypot(grid.x[:, None], grid.y)
    return _field(load.displacement(_PRESSURE, a, _MODULUS, r), found), below


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
    wave, way = 2 * math.pi / length, 2 * length  # 40 times the time of the law
    body = Material(CreepSeries(instant, [delayed], [time]), poisson_ratio=0.0)
    motion = Travel([0.0, way / speed], y=[0.0, way])

    def pressure(x: Floats, y: Floats) -> Floats:
        return np.asarray(_PRESSURE * (1 + np.cos(wave * y)) + 0.0 * x)

    def amplitude(cells: int) -> Floats:
        grid = Grid((1, cells), (length / 4, length), periodic=True)
        last = under_pressure(pressure, body, grid, [way / speed], motion=motion, errors=False)
        found = last.displacement.values[0, 0]
        return np.asarray(2 * np.mean(found * np.exp(1j * wave * grid.y)))

    found = complex(_extrapolated(amplitude, cells))
    exact = 2 * _PRESSURE / wave * (instant + delayed / (1 + 1j * wave * speed * time))
    return single(abs(exact), abs(found)), single(np.angle(exact), float(np.angle(found)))


CASES: tuple[Case, ...] = (
    Case(
        "point load",
        "Boussinesq 1885",
        (Quantity("displacement", "m", 1e-5, 1e-6),),
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
    *(
        Case(
            name,
            author,
            (
                Quantity("displacement", "m", 1e-6, 1e-6, has_order=False),
                Quantity("stress on the axis", "Pa", 1e-4, 1e-6, has_order=False),
            ),
            (8, 16, 32),
            partial(_circle, load=load),
        )
        for name, author, load in (
            ("uniform pressure on a circle", "Love 1929", _UNIFORM),
            ("Hertz's pressure", "Hertz 1882", _HERTZ),
        )
    ),
    *(
        Case(
            name,
            "Love 1929",
            (
                Quantity("displacement at the centre", "m", 1e-6, 1e-6, has_order=False),
                Quantity("stress on the axis", "Pa", 1e-4, 1e-6, has_order=False),
            ),
            (8, 16, 32),
            partial(_circle, load=load),
        )
        for name, load in (
            ("parabolic pressure on a circle", _PARABOLA),
            ("conical pressure on a circle", _CONE),
        )
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
        (Quantity("amplitude", "m", 2e-5, 1e-6), Quantity("lag", "rad", 2e-5, 1e-6)),
        (8, 16, 32),
        _wave,
    ),
)
