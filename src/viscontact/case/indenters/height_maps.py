"""Section of a measured surface as the indenter."""

from __future__ import annotations

import re
from functools import cached_property
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from viscontact.bodies import indenters, surfaces
from viscontact.bodies.surfaces.plausibility import described, levelling_note
from viscontact.bodies.surfaces.pressing import require_complete, require_map
from viscontact.case.data_file import DataFile
from viscontact.case.indenters.base import Shape
from viscontact.case.quantities import Length, NotNegativeLength, Section
from viscontact.units.formatting import format_quantity


def _as_pair(given: Any) -> Any:
    return given if isinstance(given, list) else [given, given]


class _OneOrPair:
    """Schema annotation that allows one length for both directions."""

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        pair = handler(schema)
        return {"anyOf": [pair["prefixItems"][0], pair]}


LengthPair = Annotated[
    tuple[Length, Length], Field(strict=False), BeforeValidator(_as_pair), _OneOrPair()
]
Range = Annotated[
    tuple[NotNegativeLength, Length],
    Field(strict=False, examples=[["20 um", "120 um"]]),
]


class Crop(Section):
    """The part of a map to use, by distances from its first corner."""

    x: Range | None = Field(default=None, description="first and last position; all when left out")
    y: Range | None = Field(default=None, description="first and last position; all when left out")


def _period_note(surface: surfaces.Surface) -> tuple[str, ...]:
    """Treatment of the borders of a periodic map."""
    if not surface.periodic:
        return ()
    nx, ny = surface.shape
    lx, ly = (format_quantity(length, "m", 9) for length in surface.size)
    return (
        f"{surface.name} is periodic: with 'shape: [{nx}, {ny}]', 'size: [{lx}, {ly}]' and "
        "'periodic: true' under grid it is pressed without borders",
    )


class HeightMap(Shape):
    """A measured surface, turned over: its peaks touch first."""

    shape: Literal["height-map"]
    file: DataFile = Field(
        description="NPY, NPZ or a table; with viscontact[surfaces] also X3P, SUR, GWY, OPD, AL3D, "
        "netCDF and others",
        examples=["ground.x3p"],
    )
    spacing: LengthPair | None = Field(
        default=None, description="distance of the points, where the file does not state it"
    )
    height_unit: str | None = Field(
        default=None,
        description="unit of the heights, where the file does not state it",
        examples=["um"],
    )
    height_factor: float = Field(
        default=1.0, description="factor on the heights, to correct a unit"
    )
    channel: str | None = Field(
        default=None, description="one of several channels; the file's default when left out"
    )
    width: Length | None = Field(
        default=None,
        description="for a line scan: the width over which it is extended, as parallel ridges",
    )
    flip: bool = Field(
        default=False, description="invert a map that was stored upside down, or that of a replica"
    )
    crop: Crop = Field(default=Crop(), description="the part to use")
    missing: Literal["refuse", "hole", "lowest", "smooth"] = Field(
        default="refuse",
        description="value at points without a measurement: a hole that never touches, the lowest "
        "height, or a smooth surface through the neighbours",
    )
    level: Literal["none", "mean", "plane", "quadratic"] = Field(
        default="plane", description="plane: remove the tilt; quadratic: remove the form as well"
    )
    resample: LengthPair | None = Field(
        default=None, description="spacing of the mesh to which the map is resampled"
    )
    filter: Literal["mean", "gaussian", "spline"] | None = Field(
        default=None,
        description="how it is brought there: means over cells (when left out), the Gaussian of "
        "ISO 16610, or, to a finer mesh, cubic splines",
    )
    cutoff: Length | None = Field(
        default=None,
        description="with gaussian: the wavelength of which half the height passes; 4 cells if not",
    )

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on the map: its statistics, the removed form, and implausible values."""
        surface = self.surface
        read = (f"{self._read_map.name}: {note}" for note in self._read_map.notes)
        notes = (*read, levelling_note(self._measured_map, self.level), described(surface))
        return (*filter(None, notes), *surfaces.surface_doubts(surface), *_period_note(surface))

    def build(self) -> indenters.HeightMap:
        """Return the map, read, repaired and levelled."""
        return surfaces.indenter_of(self.surface, holes=self.missing == "hole")

    @cached_property
    def surface(self) -> surfaces.Surface:
        """The surface as used, after resampling."""
        if self.missing == "refuse":
            require_complete(self._measured_map)
        found = surfaces.levelled(self._measured_map, self.level)
        if self.missing in ("lowest", "smooth"):
            found = surfaces.filled(found, self.missing)
        if self.resample is None:
            if self.filter is not None or self.cutoff is not None:
                raise ValueError(
                    "resample is missing: it is the mesh to which the filter resamples the map"
                )
            return found
        if self.cutoff is not None and self.filter != "gaussian":
            raise ValueError("cutoff: goes with filter: gaussian")
        return surfaces.resampled(found, self.resample, self.filter or "mean", cutoff=self.cutoff)

    @cached_property
    def _measured_map(self) -> surfaces.Surface:
        """The cropped map as measured."""
        found = self._read_map
        require_map(found)
        found = surfaces.flipped(found) if self.flip else found
        return surfaces.cropped(found, self.crop.x, self.crop.y)

    @cached_property
    def _read_map(self) -> surfaces.Surface:
        """The map as it is read."""
        try:
            return surfaces.read_surface(
                self.file,
                spacing=self.spacing,
                height_unit=self.height_unit,
                height_factor=self.height_factor,
                channel=self.channel,
                width=self.width,
            )
        except ValueError as error:
            raise ValueError(self._at_key(str(error))) from error

    def _at_key(self, why: str) -> str:
        """Prefix an error with the key of the file, unless it names another one."""
        named = re.match(r"(\w+)(: | is missing)", why)
        return why if named and named[1] in type(self).model_fields else f"file: {why}"
