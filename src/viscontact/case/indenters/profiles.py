"""Profile sections of a roller: its generating line."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from viscontact import tables
from viscontact.bodies import indenters
from viscontact.case.data_file import DataFile, FileSection
from viscontact.case.quantities import (
    Force,
    Length,
    Modulus,
    Offset,
    OpenAngle,
)
from viscontact.case.section_choice import ChosenBy, alternatives

Ratio = Annotated[float, Field(gt=0, le=1)]
Factor = Annotated[float, Field(gt=0, le=1e6)]
Interpolation = Literal["smooth", "linear"]


class Line(FileSection):
    """A generating line, by its kind."""

    kind: str

    @property
    def arguments(self) -> dict[str, Any]:
        """Arguments of `viscontact.Roller` for this profile, without its name."""
        given = {name: getattr(self, name) for name in type(self).model_fields}
        return {
            name: value for name, value in given.items() if name != "kind" and value is not None
        }

    def roller(
        self, radius: float, half_length: float, others: Mapping[str, Any]
    ) -> indenters.Roller:
        """Return a roller with this profile."""
        try:
            arguments = {**others, **self.arguments}
            return indenters.Roller(radius, half_length, profile=self.kind, **arguments)
        except ValueError as error:
            raise ValueError(self._at_key(str(error))) from error

    def _at_key(self, why: str) -> str:
        """Prefix an error with the key that it names."""
        named = re.match(r"[A-Z]\w+: (\w+) ", why)
        if named and named[1] in type(self).model_fields:
            return f"profile.{named[1]}: {why[named.end() :]}"
        return f"profile: {why}" if named else why


class Cylindrical(Line):
    """Straight, with sharp ends."""

    kind: Literal["cylindrical"]


class Full(Line):
    """One circular arc over the whole length."""

    kind: Literal["full"]
    crown_radius: Length | None = Field(
        default=None, description="radius of the arc; may also be given with the roller"
    )


class Partial(Line):
    """Straight, continued at either end by a circular arc tangent to it."""

    kind: Literal["partial"]
    crown_radius: Length | None = Field(default=None, description="radius of the arcs")
    end_length: Length | None = Field(
        default=None, description="where the roller ends, from its middle; with the arc if left out"
    )


class TwoRadii(Line):
    """Straight, continued at either end by two circular arcs."""

    kind: Literal["two-radii"]
    crown_radius: Length | None = Field(default=None, description="radius of the first arcs")
    crown_length: Length = Field(description="length of the first arcs along the roller")
    end_radius: Length = Field(description="radius of the second arcs")
    end_length: Length | None = Field(
        default=None, description="where the roller ends, from its middle; with the arc if left out"
    )


class Chamfer(Line):
    """Straight with chamfered ends, the corners sharp or rounded."""

    kind: Literal["chamfer"]
    angle: OpenAngle = Field(description="between the chamfer and the straight part")
    length: Length = Field(description="of the chamfer along the roller")
    corner_radius: Length | None = Field(default=None, description="sharp corners when left out")


class Logarithmic(Line):
    """A logarithmic crown, by its parameters."""

    kind: Literal["logarithmic"]
    amplitude: Length = Field(description="factor of the logarithm", examples=["0.5 um"])
    crown_ratio: Ratio = Field(default=1.0, description="part of the half length that it takes")
    end_drop: Length | None = Field(
        default=None, description="drop at the end; unlimited when left out", examples=["20 um"]
    )


class _Designed(Line):
    """A logarithmic crown for a load."""

    force: Force = Field(description="design load")
    effective_modulus: Modulus = Field(
        description="of the design: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2"
    )


class Lundberg(_Designed):
    """The logarithmic crown with uniform pressure under the design load."""

    kind: Literal["lundberg"]


class JohnsGohar(_Designed):
    """Lundberg's crown with a finite drop at the end."""

    kind: Literal["johns-gohar"]


class FujiwaraKawase(_Designed):
    """The crown of Fujiwara and Kawase, with their three parameters."""

    kind: Literal["fujiwara-kawase"]
    load_factor: Factor = Field(description="K1: multiplies the design load")
    crown_ratio: Ratio = Field(description="K2: part of the half length that the crown takes")
    end_drop: Length = Field(description="zm: drop at the end", examples=["20 um"])


class Iso16281(Line):
    """The reference profile of cylindrical rollers in ISO/TS 16281."""

    kind: Literal["iso-16281"]


class TabulatedLine(Line):
    """A line through points, from a file or written out."""

    kind: Literal["table"]
    file: DataFile | None = Field(
        default=None,
        description="table with a header such as: x [mm], drop [um]; or height instead of drop",
        examples=["profile.csv"],
    )
    points: list[Annotated[tuple[Offset, Offset], Field(strict=False)]] | None = Field(
        default=None,
        description="pairs of position from the middle and drop; half of a symmetric line suffices",
        examples=[[["0 mm", "0 um"], ["4 mm", "0 um"], ["5 mm", "8 um"]]],
    )
    interpolation: Interpolation = Field(
        default="smooth", description="between the points: cubics without overshoot, or straight"
    )

    @property
    def arguments(self) -> dict[str, Any]:
        """Positions and drops, from the points or the file."""
        if (self.points is None) == (self.file is None):
            raise ValueError(
                "profile: give file (e.g. 'profile.csv') or points (e.g. '[[0 mm, 0 um], "
                "[5 mm, 8 um]]'), and only one of them"
            )
        x, drops = self._columns()
        return {"x": x, "drops": drops, "interpolation": self.interpolation}

    def _columns(self) -> tuple[list[float], list[float]]:
        if self.file is None:
            points = self.points or []
            return [x for x, _ in points], [drop for _, drop in points]
        try:
            return tables.read_line(self.file, "x")
        except ValueError as error:
            raise ValueError(f"profile.file: {error}") from error

    def _at_key(self, why: str) -> str:
        named = why.removeprefix("TabulatedProfile: ")
        where = "points" if self.points is not None else "file"
        return why if named == why else f"profile.{where}: {named}"


_Profiles = Annotated[
    Cylindrical
    | Full
    | Partial
    | TwoRadii
    | Chamfer
    | Logarithmic
    | Lundberg
    | JohnsGohar
    | FujiwaraKawase
    | Iso16281
    | TabulatedLine,
    ChosenBy("kind"),
]


def _of_name(given: Any) -> Any:
    return {"kind": given} if isinstance(given, str) else given


class _OrName:
    """Schema annotation that allows a name in place of the section."""

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return {"anyOf": [{"enum": list(alternatives(_Profiles))}, handler(schema)]}


AnyProfile = Annotated[_Profiles, BeforeValidator(_of_name), _OrName()]
