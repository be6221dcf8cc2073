"""Verification cases of profiled rollers and singular edges."""

from __future__ import annotations

import math

import numpy as np

from viscontact import reference
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import FlatPunch, Roller
from viscontact.bodies.loads import step
from viscontact.mechanics.state import ContactState
from viscontact.verify.case import Case, Comparison, Quantity, single, with_mean_error
from viscontact.verify.elastic import BODY, MODULUS
from viscontact.verify.indentation import FORCE, press

_RADIUS, _HALF_WIDTH, _HALF_LENGTH = 5e-3, 1e-4, 20e-3  # of the roller and its contact [m]
_SIDE = 10e-3  # of the punch [m]

#: Capacitance of a square plate over its side, in units of 4 pi epsilon_0: Read 1997,
#: J. Comput. Phys. 133, 1-5.
_CAPACITANCE = 0.36679

#: Exponent of the distance from the corner of a square plate: Morrison & Lewis 1976, SIAM J. Appl.
#: Math. 31, 233-250.
_CORNER = 0.7034


def _roller(cells: int) -> tuple[Comparison, ...]:
    """Peak pressure and half width under the middle section's force; mean errors of meshes."""
    # The missing load beyond the roller's ends, (b/L)²/8 of the peak, is 3e-6.
    parts = (0.95, 0.97, 0.99, 1.0, 1.02, 1.05)
    peaks, widths = zip(*(_middle(part * cells) for part in parts), strict=True)
    return with_mean_error(peaks), with_mean_error(widths)


def _middle(cells: float) -> tuple[Comparison, Comparison]:
    b, force = _HALF_WIDTH, math.pi * MODULUS * _HALF_WIDTH**2 / (2 * _RADIUS) * _HALF_LENGTH
    roller = Roller(
        _RADIUS,
        _HALF_LENGTH,
        profile="johns-gohar",
        cross_section="parabola",
        force=force,
        effective_modulus=MODULUS,
    )
    across = 2 * int(1.4 * cells + 1) + 1
    grid = Grid((65, across), (2.2 * _HALF_LENGTH, across * b / cells))
    (state,) = press(BODY, step(force), [0.0], grid, indenter=roller, tolerance=1e-8).states
    pressure = state.pressure[32]
    exact = reference.hertz_line(float(pressure.sum()) * grid.cell_size[1], _RADIUS, MODULUS)
    # Zero of the straight line through p² over y², fitted to the inner half.
    inner = np.abs(grid.y) < exact.half_width / 2
    slope, top = np.polyfit(grid.y[inner] ** 2, pressure[inner] ** 2, 1)
    width = math.sqrt(-top / slope)
    return single(exact.peak_pressure, float(pressure.max())), single(exact.half_width, width)


def _square(cells: int) -> tuple[Comparison, ...]:
    """Exponents with which the largest pressures grow as the cells are halved."""
    coarse, fine = (_on_square(n) for n in (cells, 2 * cells))
    edge, corner = (
        math.log2(_maximum(fine, at_edge) / _maximum(coarse, at_edge)) for at_edge in (True, False)
    )
    approach = FORCE / (math.pi * MODULUS * _CAPACITANCE * _SIDE)
    return single(approach, fine.approach), single(0.5, edge), single(_CORNER, corner)


def _on_square(cells: int) -> ContactState:
    """Contact of the square punch, whose edges are cell edges with two more cells outside."""
    punch, size = (
        FlatPunch(half_length=_SIDE / 2, half_width=_SIDE / 2),
        _SIDE / cells * (cells + 4),
    )
    grid = Grid((cells + 4, cells + 4), (size, size))
    return press(BODY, step(FORCE), [0.0], grid, indenter=punch, tolerance=1e-9).states[0]


def _maximum(state: ContactState, edge: bool) -> float:
    """Largest pressure in the middle of an edge, or overall, at a corner [Pa]."""
    middle = state.pressure.shape[0] // 2
    return float((state.pressure[middle] if edge else state.pressure).max())


CASES: tuple[Case, ...] = (
    Case(
        "middle of a long logarithmic roller",
        "Hertz 1882, Johnson 1985",
        (
            Quantity("peak pressure", "Pa", 1e-3, 1e-4),
            Quantity("half width", "m", 2e-3, 2e-4),
        ),
        (10, 20, 40, 80),
        _roller,
    ),
    Case(
        "flat punch, square",
        "Read 1997, Morrison & Lewis 1976",
        (
            Quantity("approach", "m", 1e-2, 5e-3),
            Quantity("exponent of the peak, edge", "1", 5e-2, 2.5e-2),
            Quantity("exponent of the peak, corner", "1", 3e-2, 1.5e-2),
        ),
        (16, 32, 64),
        _square,
    ),
)
