"""What every shape of a case file offers: the noun, its place, what it is read from."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from pathlib import Path

from pydantic import Field, model_validator

from viscontact import indenters
from viscontact.case.quantities import Angle, Offset, Section

#: Angles have their units in a case file.
_OF_PYTHON = "; for degrees use math.radians(...)"


class Shape(Section):
    """A shape that can be pressed, turned and moved."""

    rotation: Angle = Field(
        default=0.0, description="about the vertical, from +x towards +y", examples=["30 deg"]
    )
    offset_x: Offset = Field(default=0.0, description="where its origin lies along x")
    offset_y: Offset = Field(default=0.0, description="where its origin lies along y")

    @abstractmethod
    def build(self) -> indenters.Indenter:
        """Return the indenter that is described, where it is drawn."""

    def placed(self) -> indenters.Indenter:
        """Return the indenter turned and then moved to its place."""
        noun = self.build()
        if self.rotation:
            noun = noun.rotated(self.rotation)
        if self.offset_x or self.offset_y:
            noun = noun.shifted(self.offset_x, self.offset_y)
        return noun

    @property
    def files(self) -> Mapping[tuple[str, ...], Path]:
        """Files that it is read from, by the keys that name them."""
        return {}

    @property
    def notes(self) -> tuple[str, ...]:
        """What was found in those files, and what was done to it."""
        return ()

    @model_validator(mode="after")
    def _accepted(self) -> Shape:
        # What the noun refuses belongs among the problems of the file.
        try:
            self.build()
        except ValueError as error:
            raise ValueError(str(error).removesuffix(_OF_PYTHON)) from error
        return self
