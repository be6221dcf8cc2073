"""Layered bodies: covers and coatings on a core, or on a rigid base."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field, replace
from typing import Literal

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Elastic, Law
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.material import Material
from viscontact.units.display import Displayable
from viscontact.units.numbers import check_fields, finite, store

#: Coefficient of linear thermal expansion that no solid has [1/K].
LARGEST_EXPANSION = 0.01


@dataclass(frozen=True)
class Layer(Displayable):
    """A layer of a `Layered` body.

    Parameters
    ----------
    thickness : float
        Thickness > 0 [m].
    material : Material
        Its material, without a `thickness` of its own.
    expansion : float, optional
        Coefficient of linear thermal expansion [1/K]. Under the temperature of a run it makes the
        layer thicker, and so the gap smaller; without it the thickness is constant.
    expansion_from : float, optional
        Absolute temperature at which the layer has its thickness [K]; it goes with ``expansion``.

    Raises
    ------
    ValueError
        If the thickness is not positive, the material is none or states a thickness, only one of
        the last two is given, or the coefficient is larger than that of any solid.

    Notes
    -----
    A layer that is held laterally becomes thicker by (1 + ν)/(1 - ν) α h (T - T_0), a layer that
    slides by α h (T - T_0); see "Thermal expansion" in the theory of layers. The base has no
    expansion: it is taken to stay as it is, also laterally.

    Examples
    --------
    >>> from viscontact.bodies.laws import Elastic
    >>> rubber = Material(Elastic(1e6), poisson_ratio=0.49)
    >>> Layer(5e-3, rubber).thickness
    0.005
    >>> Layer(5e-3, rubber, expansion=1.8e-4, expansion_from=296.15).expansion
    0.00018
    """

    thickness: float = field(metadata={"unit": "m"})
    material: Material
    expansion: float | None = field(default=None, metadata={"unit": "1/K"})
    expansion_from: float | None = field(default=None, metadata={"unit": "K"})

    def __post_init__(self) -> None:
        check_fields(self, "thickness", "expansion_from")
        check_fields(self, "expansion", check=finite)
        _check_material("layer", self.material)
        if (self.expansion is None) != (self.expansion_from is None):
            given, missing = ("expansion", "expansion_from")
            if self.expansion is None:
                given, missing = missing, given
            raise ValueError(
                f"Layer: {given} is given without {missing}; give both, as "
                "Layer(thickness, material, expansion=1.8e-4, expansion_from=296.15), or neither"
            )
        if abs(self.expansion or 0.0) > LARGEST_EXPANSION:
            raise ValueError(
                f"Layer: expansion must be a coefficient of linear expansion in 1/K, at most "
                f"{LARGEST_EXPANSION:g}, got {self.expansion:g}; rubber has about 2e-4, steel 1e-5"
            )

    @property
    def expands(self) -> bool:
        """True if its thickness depends on the temperature."""
        return bool(self.expansion)


@dataclass(frozen=True)
class Layered(Displayable):
    """A body of layers on a half-space, or on a rigid base.

    It takes the place of a `Material` where a body is given.

    Parameters
    ----------
    layers : sequence of Layer
        The layers from the surface down.
    base : Material or "rigid"
        Material of the half-space beneath, or a rigid base.
    bonded : bool or sequence of bool, optional
        Each layer is bonded to what is beneath it; False: it slides there without friction. One
        value for all interfaces, or one for each from the surface down.

    Raises
    ------
    ValueError
        If there is no layer, the base is neither a material nor "rigid", or the number of
        interfaces is not that of the layers.

    Notes
    -----
    With a constant Poisson's ratio a single layer on a rigid base creeps as the material does: its
    contact is that of an elastic layer under the hereditary integral of its own contact compliance.
    Layers that creep differently do not separate like this: their response to waves of pressure is
    a short sum of such products, whose error is the result's attribute ``splitting_error``.

    Examples
    --------
    A rubber cover of 5 mm on a steel core:

    >>> from viscontact.bodies.laws import Elastic, Zener
    >>> rubber = Material(Zener(1e6, 1e6, 1e6), poisson_ratio=0.499)
    >>> steel = Material(Elastic(80e9), poisson_ratio=0.3)
    >>> cover = Layered([Layer(5e-3, rubber)], base=steel)
    >>> cover.bonded
    (True,)
    """

    layers: Sequence[Layer]
    base: Material | Literal["rigid"]
    bonded: bool | Sequence[bool] = True

    def __post_init__(self) -> None:
        layers = tuple(self.layers) if isinstance(self.layers, tuple | list) else ()
        if not layers or not all(isinstance(layer, Layer) for layer in layers):
            raise ValueError(
                f"Layered: layers must be a list of one Layer or more, got {self.layers!r}"
            )
        if self.base != "rigid":
            _check_material("base", self.base)
        given = self.bonded
        bonded = tuple(given) if isinstance(given, tuple | list) else (given,) * len(layers)
        if len(bonded) != len(layers) or not all(isinstance(each, bool) for each in bonded):
            raise ValueError(
                f"Layered: bonded must be true or false, or one of them for each of the "
                f"{len(layers)} layers, got {given!r}"
            )
        store(self, layers=layers, bonded=bonded)

    @property
    def materials(self) -> tuple[Material, ...]:
        """Materials of the layers, from the surface down, and of the base."""
        base = () if isinstance(self.base, str) else (self.base,)
        return (*(layer.material for layer in self.layers), *base)

    @property
    def thickness(self) -> float:
        """Thickness of all layers together [m]."""
        return sum(layer.thickness for layer in self.layers)


def named_parts(body: Material | Layered) -> dict[str, Material]:
    """Materials of a body by the part they belong to, the uppermost first; "" for all of it.

    >>> from viscontact.bodies.laws import Elastic
    >>> rubber = Material(Elastic(1e6), poisson_ratio=0.5)
    >>> list(named_parts(Layered([Layer(5e-3, rubber)], base=rubber))), list(named_parts(rubber))
    (['layer 1', 'base'], [''])
    """
    if isinstance(body, Material):
        return {"": body}
    names = [f"layer {number}" for number in range(1, len(body.layers) + 1)]
    return dict(zip([*names, "base"], body.materials, strict=False))


def without_ends(body: Material | Layered | Body) -> Material | Layered:
    """Body that goes on where one ends."""
    return body.material if isinstance(body, Body) else body


def materials_of(body: Material | Layered) -> tuple[Material, ...]:
    """Materials of a body, of layers from the surface down."""
    return (body,) if isinstance(body, Material) else body.materials


def at_temperature(body: Material | Layered, temperature: float) -> Material | Layered:
    """Body at a constant temperature [K]; materials without a shift remain as they are."""
    if isinstance(body, Material):
        return _shifted(body, temperature)
    layers = [replace(each, material=_shifted(each.material, temperature)) for each in body.layers]
    base = body.base if isinstance(body.base, str) else _shifted(body.base, temperature)
    return replace(body, layers=layers, base=base)


def _shifted(material: Material, temperature: float) -> Material:
    return material if material.shift is None else material.at(temperature)


def creeping_laws(body: Material | Layered) -> dict[str, Law]:
    """Laws of the parts of a body that creep, by their names; of all parts if none creeps."""
    laws = {name: material.law for name, material in named_parts(body).items()}
    return {name: law for name, law in laws.items() if not isinstance(law, Elastic)} or laws


def _check_material(part: str, material: object) -> None:
    """Refuse what is no material, or one with a thickness of its own."""
    if not isinstance(material, Material):
        rigid = ' or "rigid"' if part == "base" else ""
        raise ValueError(f"Layered: the {part} must be a Material{rigid}, got {material!r}")
    if material.yield_stress is not None or material.fatigue_limit is not None:
        raise ValueError(
            f"Layered: the material of the {part} states a yield stress or a fatigue limit, with "
            "which stresses inside layers are not compared; leave it out, and look at "
            "section_stresses"
        )
    if material.thickness is not None:
        raise ValueError(
            f"Layered: the material of the {part} states a thickness of its own; give that of the "
            "layer only, and Material(...) without thickness="
        )
