"""Verification cases of layers on a rigid base: a ball before and after creep."""

from __future__ import annotations

from viscontact import reference
from viscontact.bodies.laws import Zener
from viscontact.bodies.loads import step
from viscontact.bodies.materials.layers import Layer, Layered
from viscontact.bodies.materials.material import Material
from viscontact.reference import LayerContact
from viscontact.verify.case import Case, Comparison, Quantity, single
from viscontact.verify.indentation import RADIUS, grid_around, press

#: Radius of the contact after all creep, over two thicknesses of the layer [m].
_CONTACT, _THICKNESS = 1e-3, 0.5e-3
_LAW = Zener(2e6, 1e6, 1e6)
_RELAXED = 2e6 / 3  # shear modulus after all creep [Pa]
_SETTLED = 100.0  # retardation times are 1 s


def _exact(poisson_ratio: float) -> LayerContact:
    """The elastic contact after all creep (Lee & Radok 1960: the contact only grows)."""
    return reference.layer_sphere(
        _CONTACT, RADIUS, _THICKNESS, shear_modulus=_RELAXED, poisson_ratio=poisson_ratio
    )


def _ball(poisson_ratio: float, cells: int) -> tuple[Comparison, ...]:
    exact = _exact(poisson_ratio)
    body = Layered([Layer(_THICKNESS, Material(_LAW, poisson_ratio))], base="rigid")
    grid = grid_around((_CONTACT, _CONTACT), cells + 0.3)
    times = [0.0, 0.01, 0.1, 1.0, 10.0, _SETTLED]
    run = press(body, step(exact.force), times, grid)
    return (
        single(exact.approach, run.states[-1].approach),
        single(exact.contact_radius, run.radius[-1]),
    )


def _compressible(cells: int) -> tuple[Comparison, ...]:
    return _ball(0.3, cells)


def _incompressible(cells: int) -> tuple[Comparison, ...]:
    return _ball(0.5, cells)


CASES: tuple[Case, ...] = tuple(
    Case(
        f"sphere on a creeping layer, ν = {ratio}",
        "Fredholm equation, Lee & Radok 1960",
        (Quantity("approach", "m", 1e-3, 2e-4), Quantity("contact radius", "m", 5e-3, 2e-3)),
        (10, 20, 40, 80),
        run,
    )
    for ratio, run in ((0.3, _compressible), (0.5, _incompressible))
)
