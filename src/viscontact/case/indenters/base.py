"""Common keys of shape sections: rotation, position, files."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property

from pydantic import Field, model_validator

from viscontact.bodies import indenters
from viscontact.case.data_file import FileSection
from viscontact.case.quantities import Angle, Offset

#: Remedy in messages of the constructors that does not apply to case files.
_OF_PYTHON = "; for degrees use math.radians(...)"


class Shape(FileSection):
    """Shape with a rotation and an offset."""

    rotation: Angle = Field(
        default=0.0, description="about the vertical, from +x towards +y", examples=["30 deg"]
    )
    offset_x: Offset = Field(default=0.0, description="position of its origin along x")
    offset_y: Offset = Field(default=0.0, description="position of its origin along y")

    @abstractmethod
    def build(self) -> indenters.Indenter:
        """Return the indenter in its own coordinates."""

    @cached_property
    def built(self) -> indenters.Indenter:
        """The indenter in its own coordinates, built once: its file is read once."""
        return self.build()

    def placed(self) -> indenters.Indenter:
        """Return the indenter, rotated and then moved."""
        shape = self.built
        if self.rotation:
            shape = shape.rotated(self.rotation)
        if self.offset_x or self.offset_y:
            shape = shape.shifted(self.offset_x, self.offset_y)
        return shape

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on the contents of the files and their processing."""
        return ()

    @model_validator(mode="after")
    def _accepted(self) -> Shape:
        # Errors of the constructor are reported among the problems of the file.
        try:
            _ = self.built
        except ValueError as error:
            raise ValueError(str(error).removesuffix(_OF_PYTHON)) from error
        return self
