"""Verification cases of friction between dissimilar bodies, whose pressure and tractions couple."""

from __future__ import annotations

import math
from typing import Any

from viscontact.bodies.friction import Friction
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import FlatPunch
from viscontact.bodies.laws import Elastic, Law, Zener
from viscontact.bodies.loads import step, tangential_step
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.state import ContactState
from viscontact.simulation.transient.state_generator import march
from viscontact.verify.case import Case, Comparison, Quantity, single

#: Shear modulus [Pa], radius of the punch [m], force [N], and a coefficient under which all sticks.
_MODULUS, _RADIUS, _FORCE, _ROUGH = 1e6, 1e-3, 1.0, 9.0


def _pressed(
    punch: FlatPunch, law: Law, ratio: float, grid: Grid, time: float = 0.0, coupling: bool = True
) -> ContactState:
    """State at a time after the force has come."""
    options: dict[str, Any] = {
        "friction": Friction(_ROUGH, coupling=coupling),
        "tangential": tangential_step(force_x=0.0),
        "tolerance": 1e-8,
    }
    return list(march(punch, Material(law, ratio), step(_FORCE), grid, [time], **options))[-1]


def _round_grid(cells: int) -> Grid:
    """Grid with cells on the radius of a round punch."""
    count, edge = 2 * (cells + 2), _RADIUS / cells
    return Grid((count, count), (count * edge, count * edge))


def _stiffness(cells: int) -> tuple[Comparison, ...]:
    """Approach of a punch that slides freely over that of one that sticks."""
    ratio, grid = 0.2, _round_grid(cells)
    sticks, slides = (
        _pressed(FlatPunch(_RADIUS), Elastic(_MODULUS), ratio, grid, coupling=coupling)
        for coupling in (True, False)
    )
    exact = (1 - ratio) * math.log(3 - 4 * ratio) / (1 - 2 * ratio)
    return (single(exact, slides.approach / sticks.approach),)


def _long_punch(cells: int) -> tuple[Comparison, ...]:
    """Pressure in the middle of a long punch that sticks."""
    ratio, length, edge = 0.0, 1e-3, _RADIUS / cells
    count = 2 * (cells + 4)
    grid = Grid((1, count), (length, count * edge), periodic=(True, False))
    punch = FlatPunch(half_length=1.0, half_width=_RADIUS)
    state = _pressed(punch, Elastic(_MODULUS), ratio, grid)
    mean = _FORCE / (math.pi * length * _RADIUS)
    exact = 2 * (1 - ratio) / math.sqrt(3 - 4 * ratio) * mean
    return (single(exact, float(state.pressure[0, count // 2])),)


def _creep(cells: int) -> tuple[Comparison, ...]:
    """Approach of a punch that sticks on a creeping body, over that at once."""
    law, grid, punch = Zener(_MODULUS, 0.5 * _MODULUS, 1e6), _round_grid(cells), FlatPunch(_RADIUS)
    first, last = (_pressed(punch, law, 0.2, grid, time) for time in (0.0, 3.0))
    return (single(float(law(3.0) / law(0.0)), last.approach / first.approach),)


CASES: tuple[Case, ...] = (
    Case(
        "flat punch that sticks",
        "Mossakovski 1954, Spence 1968",
        (Quantity("stiffness over that without friction", "1", fast_bound=5e-3, bound=2e-3),),
        (12, 24, 48),
        _stiffness,
    ),
    Case(
        "long flat punch that sticks",
        "Muskhelishvili 1949, Johnson 1985",
        (Quantity("central pressure", "Pa", fast_bound=3e-2, bound=1e-2),),
        (20, 40, 80),
        _long_punch,
    ),
    Case(
        "flat punch that sticks on a Zener body",
        "correspondence principle",
        (
            Quantity(
                "approach over that at once", "1", fast_bound=1e-6, bound=1e-6, has_order=False
            ),
        ),
        (12, 24),
        _creep,
    ),
)
