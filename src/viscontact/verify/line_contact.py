"""Verification cases of line contacts, on grids that are periodic along one axis."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import quad

from viscontact import reference
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Paraboloid, Swept
from viscontact.bodies.laws import Zener
from viscontact.bodies.loads import step
from viscontact.bodies.materials.material import Material
from viscontact.simulation.transient.state_generator import march
from viscontact.verify.case import Case, Comparison, Quantity, history, single, with_mean_error
from viscontact.verify.elastic import BODY, MODULUS

_RADIUS = 5e-3  # of the cylinder [m]
_WIDTH = _RADIUS / 100  # half width of its contact at first [m]
_LINE_LOAD = math.pi * MODULUS * _WIDTH**2 / (4 * _RADIUS)  # [N/m]
_PERIOD = 1e-3  # the cylinder's length that the force acts on [m]
_CYLINDER = Paraboloid(math.inf, _RADIUS)

_CREEPING = Zener(0.35 * MODULUS, 0.35 * MODULUS, 3.5 * MODULUS)  # retardation time 10 s
_POISSON = 0.3
_END = 30.0  # [s]

_STRIP, _ASIDE = 5e-3, 1e-3  # half width of a flat strip, and eccentricity of its load [m]


def _grid(half_width: float, cells: float, margin: float = 1.3) -> Grid:
    """Strip of one cell along, with a number of cells over the half width of the contact."""
    across = 2 * math.ceil(margin * cells) + 2
    return Grid((1, across), (_PERIOD, across * half_width / cells), periodic=(True, False))


def _cylinder(cells: int) -> tuple[Comparison, ...]:
    """Mean errors of several meshes, since that of the rim varies with its place in a cell."""
    exact, found = reference.hertz_line(_LINE_LOAD, _RADIUS, MODULUS), []
    for part in (0.0, 0.2, 0.4, 0.6, 0.8):
        grid = _grid(_WIDTH, cells + part)
        load = step(_LINE_LOAD * _PERIOD)
        state = next(march(_CYLINDER, BODY, load, grid, [0.0], tolerance=1e-9))
        middle = grid.shape[1] // 2
        found.append(
            (
                single(exact.half_width, state.contact_width / 2),
                single(float(exact.pressure(grid.y[middle])), float(state.pressure[0, middle])),
            )
        )
    widths, pressures = zip(*found, strict=True)
    return with_mean_error(widths), with_mean_error(pressures)


def _creeping(steps: int) -> tuple[Comparison, ...]:
    """Half width, and pressure in the middle at the end."""
    # By the correspondence principle b² = 4 R q J(t)/π and p = ∫ M(t - t') db/(2 R) in the middle.
    body = Material(_CREEPING, poisson_ratio=_POISSON)
    compliance = body.contact_compliance()

    def half_width(time: float) -> float:
        return math.sqrt(4 * _RADIUS * _LINE_LOAD * float(compliance(time)) / math.pi)

    def modulus(time: float) -> float:
        return 2 * float(_CREEPING.relaxation(time)) / (1 - _POISSON)

    def integrand(time: float) -> float:
        rate = (half_width(time + 1e-4) - half_width(time - 1e-4)) / 2e-4 if time > 1e-4 else 0.0
        return modulus(_END - time) * rate

    times = np.append(0.0, np.geomspace(_END / 100, _END, steps))
    grid = _grid(half_width(_END), 4.0 * steps + 0.3)
    load = step(_LINE_LOAD * _PERIOD)
    states = list(march(_CYLINDER, body, load, grid, times, tolerance=1e-8))
    middle = (modulus(_END) * half_width(0.0) + quad(integrand, 0.0, _END)[0]) / (2 * _RADIUS)
    return (
        history([half_width(t) for t in times], [state.contact_width / 2 for state in states]),
        single(middle, states[-1].pressure[0, grid.shape[1] // 2]),
    )


def _strip(cells: int) -> tuple[Comparison, ...]:
    """Tilt of a flat strip: 4 q e/(π E* c²), by p = (q/π) (1 + 2 e y/c²)/sqrt(c² - y²)."""
    load, found = step(_LINE_LOAD * _PERIOD, eccentricity_y=_ASIDE), []
    flat = Swept(y=[0.0, _STRIP], drops=[0.0, 0.0], interpolation="linear")
    exact = 4 * _LINE_LOAD * _ASIDE / (math.pi * MODULUS * _STRIP**2)
    for part in (0.1, 0.3, 0.5, 0.7, 0.9):
        grid = _grid(_STRIP, cells + part, margin=1.1)
        found.append(single(exact, next(march(flat, BODY, load, grid, [0.0])).tilt_y))
    return (with_mean_error(found),)


CASES: tuple[Case, ...] = (
    Case(
        "cylinder, periodic along it",
        "Hertz 1882, Johnson 1985",
        (
            Quantity("half width", "m", 2e-4, 1e-5),
            Quantity("central pressure", "Pa", 4e-4, 2e-5),
        ),
        (10, 20, 40, 80),
        _cylinder,
    ),
    Case(
        "cylinder under a sudden force, Zener",
        "Lee & Radok 1960, Johnson 1985",
        (
            Quantity("half width", "m", 1e-4, 1e-5),
            Quantity("central pressure", "Pa", 2e-3, 4e-4),
        ),
        (8, 16, 32),
        _creeping,
    ),
    Case(
        "flat strip, eccentric, periodic along it",
        "Johnson 1985",
        (Quantity("tilt", "rad", 5e-2, 1e-2),),
        (10, 20, 40, 80),
        _strip,
    ),
)
