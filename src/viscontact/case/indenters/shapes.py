"""Indenter section of a case file: round shapes, rollers, and sums of shapes."""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from viscontact.bodies import indenters
from viscontact.case.indenters import more_shapes
from viscontact.case.indenters.base import Shape
from viscontact.case.indenters.height_maps import HeightMap
from viscontact.case.indenters.profiles import AnyProfile
from viscontact.case.quantities import Length, LengthOrInfinite, OpenAngle
from viscontact.case.section_choice import ChosenBy

#: Radius of the body on the other side.
CounterRadius = Length | None
OF_COUNTER_BODY = (
    "radius of a second roll, parallel to the first, in place of a plane: the gap between them is "
    "that of one roll of the radius 1/(1/radius + 1/counter_radius)"
)


def joint_radius(radius: float, counter_radius: float | None) -> float:
    """Radius of the roll on a plane with the gap of two parallel rolls [m].

    >>> joint_radius(0.06, 0.06)
    0.03
    """
    return radius if counter_radius is None else 1 / (1 / radius + 1 / counter_radius)


class Sphere(Shape):
    """A sphere, with its true circular section."""

    shape: Literal["sphere"]
    radius: Length = Field(description="of the sphere")

    def build(self) -> indenters.Sphere:
        """Return the sphere."""
        return indenters.Sphere(self.radius)


class Paraboloid(Shape):
    """An elliptic paraboloid, the shape of Hertz's theory."""

    shape: Literal["paraboloid"]
    radius_x: LengthOrInfinite = Field(
        description="radius of curvature along x; infinite for a cylinder along x, on a grid that "
        "is periodic there"
    )
    radius_y: LengthOrInfinite = Field(
        description="radius of curvature along y; infinite for a cylinder along y"
    )

    def build(self) -> indenters.Paraboloid:
        """Return the paraboloid."""
        return indenters.Paraboloid(self.radius_x, self.radius_y)


class Cylinder(Shape):
    """A cylinder without end along x, alone on a plane or against a second one: a line contact."""

    shape: Literal["cylinder"]
    radius: Length = Field(description="of the cylinder")
    counter_radius: CounterRadius = Field(default=None, description=OF_COUNTER_BODY)

    @property
    def turns_with_another(self) -> bool:
        """True if its radius is not that of the body that turns."""
        return self.counter_radius is not None

    def build(self) -> indenters.Paraboloid:
        """Return the parabolic cylinder of the gap between both bodies."""
        return indenters.Paraboloid(math.inf, joint_radius(self.radius, self.counter_radius))


class Cone(Shape):
    """A cone, apex down."""

    shape: Literal["cone"]
    half_angle: OpenAngle = Field(description="from the axis to the flank", examples=["70 deg"])

    def build(self) -> indenters.Cone:
        """Return the cone."""
        return indenters.Cone(self.half_angle)


class FlatPunch(Shape):
    """A punch with a flat end: round (radius) or rectangular (half_length and half_width)."""

    shape: Literal["flat-punch"]
    radius: Length | None = Field(default=None, description="radius of a round punch")
    half_length: Length | None = Field(default=None, description="half the edge along x")
    half_width: Length | None = Field(default=None, description="half the edge along y")

    def build(self) -> indenters.FlatPunch:
        """Return the punch."""
        return indenters.FlatPunch(
            self.radius, half_length=self.half_length, half_width=self.half_width
        )


class Roller(Shape):
    """A roller lying along x, with a profile along it."""

    shape: Literal["roller"]
    radius: Length = Field(description="largest radius of the roller")
    counter_radius: CounterRadius = Field(default=None, description=OF_COUNTER_BODY)
    half_length: Length = Field(
        description="half the length: of the straight part where a circular crown continues it, "
        "of the whole otherwise"
    )
    crown_radius: Length | None = Field(
        default=None, description="radius of the crown that continues the straight part"
    )
    profile: AnyProfile | None = Field(
        default=None, description="generating line, if not the straight one with a crown"
    )
    cross_section: Literal["circle", "parabola"] = Field(
        default="circle",
        description="cross-section: the true circle, or the parabola of Hertz's theory",
    )

    @property
    def files(self) -> Mapping[tuple[str, ...], Path]:
        """Files of the profile, by their keys."""
        found = {} if self.profile is None else self.profile.files
        return {("profile", *key): path for key, path in found.items()}

    @property
    def turns_with_another(self) -> bool:
        """True if its radius is not that of the body that turns."""
        return self.counter_radius is not None

    def build(self) -> indenters.Roller:
        """Return the roller."""
        radius = joint_radius(self.radius, self.counter_radius)
        others: dict[str, Any] = {"cross_section": self.cross_section}
        if self.crown_radius is not None:
            others["crown_radius"] = self.crown_radius
        if self.profile is None:
            return indenters.Roller(radius, self.half_length, **others)
        return self.profile.roller(radius, self.half_length, others)


AnyShape = Annotated[
    Sphere
    | Paraboloid
    | Cylinder
    | more_shapes.Ellipsoid
    | Cone
    | FlatPunch
    | Roller
    | more_shapes.Wedge
    | more_shapes.Pyramid
    | more_shapes.Vickers
    | more_shapes.Berkovich
    | more_shapes.CubeCorner
    | more_shapes.Torus
    | more_shapes.Revolved
    | more_shapes.Swept
    | more_shapes.Waviness
    | more_shapes.Dimples
    | HeightMap,
    ChosenBy("shape"),
]


class _OneOrMany:
    """Schema annotation that allows a single shape in place of a list."""

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        many = handler(schema)
        return {"anyOf": [many["items"], many]}


def _as_list(given: Any) -> Any:
    return given if isinstance(given, list) else [given]


Shapes = Annotated[
    list[AnyShape],
    Field(min_length=1, description="the pressed body; a list of shapes is their sum"),
    BeforeValidator(_as_list),
    _OneOrMany(),
]


def combined(shapes: Sequence[Shape]) -> indenters.Indenter:
    """Return the indenter that a list of shapes describes: their sum."""
    first, *others = [shape.placed() for shape in shapes]
    return functools.reduce(operator.add, others, first)
