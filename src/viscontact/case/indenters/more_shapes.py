"""Sections of further shapes: ellipsoids, facets, rings, textures, bodies by points."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from viscontact import tables
from viscontact.bodies import indenters
from viscontact.case.data_file import DataFile
from viscontact.case.indenters.base import Shape
from viscontact.case.quantities import Angle, Length, Offset, OpenAngle

FaceCount = Annotated[int, Field(ge=3, le=1000)]
Points = list[Annotated[tuple[Offset, Offset], Field(strict=False)]]


class Ellipsoid(Shape):
    """An ellipsoid, pressed along one of its axes."""

    shape: Literal["ellipsoid"]
    semi_axis_x: Length = Field(description="half its extent along x")
    semi_axis_y: Length = Field(description="half its extent along y")
    semi_axis_z: Length = Field(description="half its height")

    def build(self) -> indenters.Ellipsoid:
        """Return the ellipsoid."""
        return indenters.Ellipsoid(self.semi_axis_x, self.semi_axis_y, self.semi_axis_z)


class Wedge(Shape):
    """A wedge, its edge along x."""

    shape: Literal["wedge"]
    half_angle: OpenAngle = Field(
        description="from the plane of symmetry to a flank", examples=["70 deg"]
    )
    half_length: Length | None = Field(
        default=None, description="half the edge; infinite when left out"
    )

    def build(self) -> indenters.Wedge:
        """Return the wedge."""
        return indenters.Wedge(self.half_angle, self.half_length)


class Pyramid(Shape):
    """A pyramid on a regular polygon, apex down, a face towards +x."""

    shape: Literal["pyramid"]
    half_angle: OpenAngle = Field(description="from the axis to a face", examples=["68 deg"])
    faces: FaceCount = Field(description="number of faces", examples=["4"])

    def build(self) -> indenters.Pyramid:
        """Return the pyramid."""
        return indenters.Pyramid(self.half_angle, self.faces)


class Vickers(Shape):
    """A Vickers pyramid: 4 faces, 136 degrees between opposite ones."""

    shape: Literal["vickers"]

    def build(self) -> indenters.Pyramid:
        """Return the pyramid."""
        return indenters.Pyramid.vickers()


class Berkovich(Shape):
    """A modified Berkovich pyramid: 3 faces at 65.27 degrees to the axis."""

    shape: Literal["berkovich"]

    def build(self) -> indenters.Pyramid:
        """Return the pyramid."""
        return indenters.Pyramid.berkovich()


class CubeCorner(Shape):
    """The corner of a cube: 3 faces at right angles."""

    shape: Literal["cube-corner"]

    def build(self) -> indenters.Pyramid:
        """Return the pyramid."""
        return indenters.Pyramid.cube_corner()


class Torus(Shape):
    """A ring with a round section, pressed flat."""

    shape: Literal["torus"]
    ring_radius: Length = Field(description="radius of the ring's middle line")
    tube_radius: Length = Field(description="radius of its section")

    def build(self) -> indenters.Torus:
        """Return the ring."""
        return indenters.Torus(self.ring_radius, self.tube_radius)


class Waviness(Shape):
    """Infinite waves, to be added to a shape in a list."""

    shape: Literal["waviness"]
    amplitude: Length = Field(description="half the height of the waves", examples=["1 um"])
    wavelength_x: Length | None = Field(
        default=None, description="from crest to crest along x", examples=["1 mm"]
    )
    wavelength_y: Length | None = Field(
        default=None, description="from crest to crest along y", examples=["1 mm"]
    )
    phase_x: Angle = Field(default=0.0, description="at the origin; a crest when zero")
    phase_y: Angle = Field(default=0.0, description="at the origin; a crest when zero")

    def build(self) -> indenters.Waviness:
        """Return the waves."""
        return indenters.Waviness(
            self.amplitude, self.wavelength_x, self.wavelength_y, self.phase_x, self.phase_y
        )


class Dimples(Shape):
    """Infinite rows of round dimples, to be added to a shape in a list."""

    shape: Literal["dimples"]
    depth: Length = Field(description="in the middle of a dimple", examples=["2 um"])
    radius: Length = Field(description="of its mouth", examples=["50 um"])
    spacing: Length = Field(description="between neighbours' middles", examples=["0.2 mm"])
    pattern: Literal["square", "hexagonal"] = Field(
        default="square", description="arrangement of the dimples"
    )

    def build(self) -> indenters.Dimples:
        """Return the texture."""
        return indenters.Dimples(self.depth, self.radius, self.spacing, self.pattern)


class _Drawn(Shape):
    """A shape by points of a line, from a file or written out."""

    points: Points | None = Field(
        default=None,
        description="position and drop, in pairs",
        examples=[[["0 mm", "0 um"], ["2 mm", "200 um"], ["4 mm", "800 um"]]],
    )
    interpolation: Literal["smooth", "linear"] = Field(
        default="smooth", description="between the points: cubics without overshoot, or straight"
    )

    def _line(self, file: str | None, along: str) -> tuple[list[float], list[float]]:
        if (self.points is None) == (file is None):
            raise ValueError(
                "give file (e.g. 'section.csv') or points (e.g. '[[0 mm, 0 um], [5 mm, 8 um]]'), "
                "and only one of them"
            )
        if file is None:
            points = self.points or []
            return [position for position, _ in points], [drop for _, drop in points]
        try:
            return tables.read_line(file, along)
        except ValueError as error:
            raise ValueError(f"file: {error}") from error


class Revolved(_Drawn):
    """A body of revolution about the vertical, by points of its half section."""

    shape: Literal["revolved"]
    file: DataFile | None = Field(
        default=None,
        description="table with a header such as: r [mm], drop [um]; or height instead of drop",
        examples=["section.csv"],
    )

    def build(self) -> indenters.Revolved:
        """Return the body."""
        return indenters.Revolved(*self._line(self.file, "r"), self.interpolation)


class Swept(_Drawn):
    """A cross-section by points, extruded along x."""

    shape: Literal["swept"]
    half_length: Length | None = Field(
        default=None, description="half its length; infinite when left out"
    )
    file: DataFile | None = Field(
        default=None,
        description="table with a header such as: y [mm], drop [um]; or height instead of drop",
        examples=["section.csv"],
    )

    def build(self) -> indenters.Swept:
        """Return the body."""
        line = self._line(self.file, "y")
        return indenters.Swept(*line, self.half_length, self.interpolation)
