"""Warnings about covers: large strains in the layers, and cells that are long against them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import chain, repeat

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.units.formatting import format_quantity

#: Limits of small-strain theory in a cover: approach over thickness, and shear strain.
DEEP_COVER, SHEARED_COVER = 0.1, 0.3

#: Poisson's ratio above which a layer counts as nearly incompressible.
INCOMPRESSIBLE = 0.45

#: A base stiffer than the layers by this factor takes no part in the approach.
STIFF_BASE = 10.0

#: Fewest cells per thickness of a nearly incompressible layer under a wider contact. With 4 the
#: area of contact on a layer of ν = 0.5 is exact to 1e-3, with 2 to 6e-3, with 1 to 4e-2.
CELLS_PER_LAYER = 4.0


@dataclass(frozen=True)
class Cover:
    """Layers of a body as the warnings need them."""

    depth: float  # of the layers that take up the approach; inf if the base does, too [m]
    squeezed: bool  # they are nearly incompressible and bonded to what is beneath
    incompressible: float  # thickness of the thinnest nearly incompressible layer, else inf [m]


def covers_of(
    bodies: Iterable[Material | Layered], time: float, clocks: Iterable[Clock] = ()
) -> tuple[Cover, ...]:
    """Covers of the bodies that have layers, with the moduli that they creep to [s]."""
    return tuple(
        _cover_of(body, float(clock.reduced(np.array(time))))
        for body, clock in zip(bodies, chain(clocks, repeat(TIME)), strict=False)
        if isinstance(body, Layered)
    )


def cover_warnings(
    covers: Iterable[Cover],
    half_width: float,
    approach: float,
    cell_size: tuple[float, ...],
    verb: str = "is",
) -> dict[str, str]:
    """Warn of covers under a contact of a half width, with an approach (NaN if unknown) [m]."""
    warnings: dict[str, str] = {}
    for cover in covers:
        depth, strain = format_quantity(cover.depth, "m", 3), approach / cover.depth
        if strain > DEEP_COVER:
            warnings["cover"] = (
                f"the approach {verb} {strain:.2g} of the thickness of the layers, {depth}; "
                f"small-strain theory is meant for less than {DEEP_COVER:g}"
            )
        # The shear strain at the bond of a thin incompressible layer is γ = h p'/G: with the
        # pressure of thin layers (Jaffar 1989) its largest value is 0.58 w a/h² under a sphere,
        # 1.15 w a/h² under a cylinder.
        shear = strain * half_width / cover.depth
        if cover.squeezed and half_width > cover.depth and shear > SHEARED_COVER:
            warnings["squeeze"] = (
                "the layers are nearly incompressible and squeezed out to the side by a contact "
                f"whose half width is {half_width / cover.depth:.2g} times their thickness: their "
                f"shear strain {verb} about {shear:.2g}; small-strain theory is meant for less "
                f"than {SHEARED_COVER:g}"
            )
        thickness = cover.incompressible
        count = thickness / min(cell_size)  # along rollers cells may be long
        if half_width > thickness and count < CELLS_PER_LAYER:
            warnings["layer_cells"] = (
                f"there {_cells(count)} per thickness of a nearly incompressible layer, "
                f"{format_quantity(thickness, 'm', 3)}; with fewer than {CELLS_PER_LAYER:g} the "
                "contact area is off by about 1 %, with a single one by some per cent: use "
                "smaller cells"
            )
    return warnings


def _cells(count: float) -> str:
    """Verb and number of cells, as in 'is 1 cell'."""
    number = f"{count:.2g}"
    return "is 1 cell" if number == "1" else f"are {number} cells"


def _cover_of(body: Layered, time: float) -> Cover:
    assert isinstance(body.bonded, tuple)  # one for each interface
    stiffness = [_shear_modulus(layer.material, time) for layer in body.layers]
    base = math.inf if isinstance(body.base, str) else _shear_modulus(body.base, time)
    is_stiff = base > STIFF_BASE * max(stiffness)
    incompressible = [_poisson_ratio(each.material, time) > INCOMPRESSIBLE for each in body.layers]
    thicknesses = [
        layer.thickness for layer, is_it in zip(body.layers, incompressible, strict=True) if is_it
    ]
    return Cover(
        body.thickness if is_stiff else math.inf,
        all(incompressible) and all(body.bonded),
        min(thicknesses, default=math.inf),
    )


def _shear_modulus(material: Material, time: float) -> float:
    """Shear modulus to which a material has crept at a time [Pa]."""
    creep = float(material.law(time))
    return 0.5 / creep if creep > 0 else math.inf


def _poisson_ratio(material: Material, time: float) -> float:
    if material.poisson_ratio is not None:
        return material.poisson_ratio
    assert material.bulk_modulus is not None  # exactly one is given
    ratio = _shear_modulus(material, time) / material.bulk_modulus
    return (3 - 2 * ratio) / (6 + 2 * ratio) if math.isfinite(ratio) else -1.0
