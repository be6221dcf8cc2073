"""Material section of a body of layers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal, get_args

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from viscontact.bodies.materials import library
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.layers import Layer as BuiltLayer
from viscontact.bodies.materials.layers import Layered
from viscontact.case.materials.base import INCOMPLETE_END, Ends, Medium
from viscontact.case.materials.material import AnyMaterial, Laws, OrName, from_library
from viscontact.case.quantities import Expansion, Length, Offset, Section, Temperature
from viscontact.case.section_choice import ChosenBy

#: Word for a base that does not yield.
RIGID: Literal["rigid"] = "rigid"


def _without_ends(material: Medium | Literal["rigid"]) -> Medium | Literal["rigid"]:
    if not isinstance(material, str) and material.ends is not None:
        raise ValueError("ends: layers that end are not available; leave ends and length out")
    return material


def _without_limits(material: Medium | Literal["rigid"]) -> Medium | Literal["rigid"]:
    for name in ("yield_stress", "fatigue_limit"):
        if not isinstance(material, str) and getattr(material, name) is not None:
            raise ValueError(
                f"{name}: stresses inside layers are not compared with it; leave it out, and look "
                "at the figure stress-section"
            )
    return material


def _deep(base: Medium | Literal["rigid"]) -> Medium | Literal["rigid"]:
    if not isinstance(base, str) and base.thickness is not None:
        raise ValueError(
            "thickness: the base is as deep as a half-space; leave it out, or make it a layer on a "
            "base of its own"
        )
    return base


def _without_thickness(material: Medium) -> Medium:
    if material.thickness is not None:
        raise ValueError("thickness: belongs to the layer; leave it out of its material")
    return material


class _OrRigid:
    """Annotation that accepts the word `rigid` in place of a material."""

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        def read(given: Any, material: Any) -> Any:
            if isinstance(given, str) and given not in (RIGID, *library.names()):
                why = f"{library.unknown_name(given)}; or write '{RIGID}'"
                raise PydanticCustomError("library", "{why}", {"why": why})
            return RIGID if given == RIGID else material(given)

        return core_schema.no_info_wrap_validator_function(read, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return {"anyOf": [{"enum": [RIGID]}, handler(schema)]}


class Layer(Section):
    """A layer: its thickness and its material."""

    thickness: Length = Field(description="of the layer")
    material: Annotated[
        AnyMaterial,
        AfterValidator(_without_thickness),
        AfterValidator(_without_ends),
        AfterValidator(_without_limits),
    ] = Field(
        description="material of the layer; its keys may be written beside thickness as well",
        examples=["epdm-70-25c"],
    )
    expansion: Expansion | None = Field(
        default=None,
        description="coefficient of linear thermal expansion: the temperature of the run makes the "
        "layer thicker, and the gap smaller",
    )
    expansion_from: Temperature | None = Field(
        default=None, description="temperature at which the layer has its thickness"
    )

    @property
    def built(self) -> BuiltLayer:
        """The layer."""
        heat = {"expansion": self.expansion, "expansion_from": self.expansion_from}
        return BuiltLayer(self.thickness, self.material.built, **heat)

    @model_validator(mode="after")
    def _accepted(self) -> Layer:
        if (self.expansion is None) != (self.expansion_from is None):
            given = "expansion_from" if self.expansion is None else "expansion"
            raise ValueError(
                f"{given}: expansion and expansion_from belong together; write e.g. 'expansion: "
                "1.8e-4 / K' and 'expansion_from: 23 degC', or leave both out"
            )
        return self


#: Keys of materials that may be written beside the thickness of a layer.
_BESIDE = {key for law in get_args(Laws) for key in law.model_fields} - {"thickness"}

#: Keys of a layer itself.
_OWN = set(Layer.model_fields) - {"material"}


def _nested(given: Any) -> Any:
    """Put keys of a material that are written beside those of a layer under `material`."""
    if not isinstance(given, dict) or not _BESIDE & set(given):
        return given
    own = {key: value for key, value in given.items() if key in _OWN}
    return {**own, "material": {key: given[key] for key in given if key not in own}}


class _OrBeside:
    """Schema annotation that allows the keys of the material beside the thickness."""

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        layer = handler(schema)
        laws = handler.resolve_ref_schema(layer)["properties"]["material"]["anyOf"][-1]
        beside = {"required": ["thickness", "law"], **laws, "x-shorthand": True}
        return {"anyOf": [layer, beside]}


def _one_or_each(given: Any) -> Any:
    each = given if isinstance(given, list) else [given]
    if not all(isinstance(value, bool) for value in each):
        raise ValueError(f"must be true or false, or a list of one for each layer, got {given!r}")
    return given


class Layers(Section):
    """Layers on a base: a cover on a core, a coating, a film."""

    # A tag that is no key: both occur in the location of an error.
    law: Literal["layered"] = "layered"
    layers: list[Annotated[Layer, BeforeValidator(_nested), _OrBeside()]] = Field(
        min_length=1, description="from the surface down; where they are given, law may be left out"
    )
    base: Annotated[
        AnyMaterial,
        _OrRigid(),
        AfterValidator(_deep),
        AfterValidator(_without_ends),
        AfterValidator(_without_limits),
    ] = Field(
        description="material beneath the layers, infinitely deep, or rigid", examples=[RIGID]
    )
    bonded: Annotated[bool | list[bool], BeforeValidator(_one_or_each)] = Field(
        default=True,
        description="whether each layer is bonded to what is beneath it, or slides there without "
        "friction; one for all, or one for each",
    )

    length: Length | None = Field(
        default=None, description="of the body along x, where it ends; goes with ends"
    )
    centre: Offset | None = Field(
        default=None, description="position x of the middle of a body that ends; 0 when left out"
    )
    ends: Ends | None = Field(
        default=None,
        description="planes across x at which layers on a rigid base end: free of stress, or held "
        "by a wall without friction; one kind for both, or a pair, that at -x first",
        examples=["free"],
    )

    @property
    def body(self) -> Layered | Body:
        """The body."""
        if self.ends is None or self.length is None:
            return self.built
        return Body(self.built, self.length, centre=self.centre or 0.0, ends=self.ends)

    @cached_property
    def built(self) -> Layered:
        """The layers on their base."""
        return Layered(
            [each.built for each in self.layers],
            RIGID if isinstance(self.base, str) else self.base.built,
            self.bonded,
        )

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on the laws, after the layer that they belong to."""
        return tuple(
            f"{'.'.join(map(str, at))}: {note}" if at else note
            for at, part in self._parts()
            for note in part.notes
        )

    @property
    def files(self) -> Mapping[tuple[str | int, ...], Path]:
        """Files of the layers and of the base, by their keys."""
        return {(*at, *key): path for at, part in self._parts() for key, path in part.files.items()}

    @property
    def media(self) -> dict[str, Medium]:
        """Sections of the materials by their keys, with the layers counted from 1."""
        media = {f"layers[{place}]": layer.material for place, layer in enumerate(self.layers, 1)}
        return media if isinstance(self.base, str) else {**media, "base": self.base}

    def _parts(self) -> Iterator[tuple[tuple[str | int, ...], Medium]]:
        for place, layer in enumerate(self.layers):
            yield ("layers", place, "material"), layer.material
        if not isinstance(self.base, str):
            yield ("base",), self.base

    @model_validator(mode="after")
    def _accepted(self) -> Layers:
        if isinstance(self.bonded, list) and len(self.bonded) != len(self.layers):
            raise ValueError(
                "bonded: must be true or false, or one of them for each of the "
                f"{len(self.layers)} layers, got {len(self.bonded)}"
            )
        if (self.ends is None) != (self.length is None):
            raise ValueError(f"{'length' if self.length is None else 'ends'}: {INCOMPLETE_END}")
        if self.centre is not None and self.ends is None:
            raise ValueError("centre: is that of a body that ends; give 'length' and 'ends', too")
        _ = self.body
        return self


def _with_law(given: Any) -> Any:
    if isinstance(given, dict) and "layers" in given and "law" not in given:
        return {**given, "law": "layered"}
    return from_library(given)


def spelled_out(given: Any) -> Any:
    """Return a material section in its longest spelling: with its law, and with nested layers."""
    # Names of the library that stand alone, and what is not valid, are returned unchanged.
    if not isinstance(given, dict):
        return given
    try:
        section = _with_law(given)
    except ValueError:
        return given
    if isinstance(section.get("layers"), list):
        nested = [_nested(layer) for layer in section["layers"]]
        layers = [
            {**layer, "material": spelled_out(layer.get("material"))}
            if isinstance(layer, dict)
            else layer
            for layer in nested
        ]
        section = {**section, "layers": layers}
    if "base" in section:
        section = {**section, "base": spelled_out(section["base"])}
    return section


#: A material, or a body of layers.
AnyBody = Annotated[Annotated[Laws | Layers, ChosenBy("law")], BeforeValidator(_with_law), OrName()]
