"""Verification case of friction on layers: a punch that sticks and is twisted."""

from __future__ import annotations

import math

from viscontact import reference
from viscontact.bodies.friction import Friction
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import FlatPunch
from viscontact.bodies.laws import Elastic
from viscontact.bodies.loads import TangentialHistory, step
from viscontact.bodies.materials.layers import Layer, Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.state import ContactState
from viscontact.simulation.transient.state_generator import march
from viscontact.verify.case import Case, Comparison, Quantity, single

_RADIUS, _THICKNESS, _MODULUS = 1e-3, 0.5e-3, 1e6  # [m, m, Pa]
_STICKS = Friction(10.0, coupling=False)
_APPROACH, _TWIST = 1e-6, 1e-5  # [m, rad]


def _twisted_on(body: Material | Layered, cells: int) -> ContactState:
    """State of a punch that is twisted, of so many cells on its radius."""
    count = 2 * (cells + 2)
    size = 2 * _RADIUS * (cells + 2) / cells
    *_, last = march(
        FlatPunch(_RADIUS),
        body,
        step(approach=_APPROACH),
        Grid((count, count), (size, size)),
        [0.0, 1.0],
        friction=_STICKS,
        tangential=TangentialHistory([1.0], rotation=_TWIST),
    )
    return last


def _twisted(cells: int) -> tuple[Comparison, ...]:
    """Torque on a layer over that on a half-space of the same cells: the punch's edge cancels."""
    rubber = Material(Elastic(_MODULUS), poisson_ratio=0.5)
    layer = Layered([Layer(_THICKNESS, rubber)], base="rigid")
    on_layer, on_rubber = (_twisted_on(body, cells) for body in (layer, rubber))
    assert on_layer.torque is not None
    assert on_rubber.torque is not None
    assert on_layer.stick_area is not None
    # The punch is as large as its cells.
    radius = math.sqrt(on_layer.stick_area / math.pi)
    exact = reference.layer_torsion(radius, _THICKNESS, shear_modulus=_MODULUS)
    half_space = 16 / 3 * _MODULUS * radius**3
    return (single(exact / half_space, on_layer.torque / on_rubber.torque),)


CASES: tuple[Case, ...] = (
    Case(
        "punch twisted on a layer",
        "Fredholm equation, Reissner & Sagoci 1944",
        (Quantity("torque over that of a half-space", "1", 5e-3, 1e-3),),
        (10, 20, 40, 80),
        _twisted,
    ),
)
