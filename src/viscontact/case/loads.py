"""The `load` of a case file."""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationInfo, field_validator, model_validator

from viscontact import load
from viscontact.case.load_table import read_load_table
from viscontact.case.quantities import Angle, Duration, Force, Instant, Offset, Section
from viscontact.load import ForceHistory, LoadHistory


class Load(Section):
    """A force over time, where it acts, and prescribed tilts."""

    eccentricity_x: Offset = Field(default=0.0, description="where the force acts along x")
    eccentricity_y: Offset = Field(default=0.0, description="where the force acts along y")
    tilt_x: Angle | None = Field(
        default=None, description="prescribed slope along x, in place of the moment balance"
    )
    tilt_y: Angle | None = Field(
        default=None, description="prescribed slope along y, in place of the moment balance"
    )

    @abstractmethod
    def noun(self) -> LoadHistory:
        """Return the history that is described."""

    @property
    def table(self) -> Path | None:
        """The file that the history is read from, if there is one."""
        return None

    @property
    def _tail(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in Load.model_fields}

    @model_validator(mode="after")
    def _accepted(self) -> Load:
        # What the noun refuses belongs among the problems of the file.
        self.noun()
        return self


class Step(Load):
    """A force put on at once, then held."""

    kind: Literal["step"]
    force: Force

    def noun(self) -> LoadHistory:
        """Return the step."""
        return load.step(self.force, **self._tail)


class Ramp(Load):
    """A force that grows evenly, then is held."""

    kind: Literal["ramp"]
    force: Force
    duration: Duration

    def noun(self) -> LoadHistory:
        """Return the ramp."""
        return load.ramp(self.force, self.duration, **self._tail)


class Triangle(Load):
    """A force that grows evenly, then falls back to zero."""

    kind: Literal["triangle"]
    force: Force = Field(description="at the peak")
    rise: Duration
    fall: Duration | None = Field(default=None, description="as long as rise when left out")

    def noun(self) -> LoadHistory:
        """Return the triangle."""
        return load.triangle(self.force, self.rise, self.fall, **self._tail)


class History(Load):
    """A force by points, linear between them; a time given twice is a jump."""

    kind: Literal["history"]
    points: list[Annotated[tuple[Instant, Force], Field(strict=False)]] | None = Field(
        default=None, description="[time, force] each", examples=[[["0 s", "0 N"]]]
    )
    file: str | None = Field(
        default=None,
        description="CSV with a header such as: time [s], force [kN], eccentricity_x [mm]",
        examples=["load.csv"],
    )

    @field_validator("file")
    @classmethod
    def _beside_the_case(cls, name: str | None, info: ValidationInfo) -> str | None:
        return name if name is None else str(Path((info.context or {}).get("folder", "."), name))

    @property
    def table(self) -> Path | None:
        """The file that the history is read from, if there is one."""
        return None if self.file is None else Path(self.file)

    def noun(self) -> LoadHistory:
        """Return the history, from its points or from its file."""
        if (self.points is None) == (self.file is None):
            raise ValueError("give points (e.g. '[[0 s, 0 N], [1 s, 10 kN]]') or file, not both")
        if self.file is not None:
            return self._from_file(Path(self.file))
        if not self.points:
            raise ValueError("points is empty; write e.g. '[[0 s, 0 N], [1 s, 10 kN]]'")
        times, force = zip(*self.points, strict=True)
        return ForceHistory(times, force, **self._tail)

    def _from_file(self, path: Path) -> LoadHistory:
        columns = read_load_table(path)
        twice = sorted(columns.keys() & self.model_fields_set)
        if twice:
            raise ValueError(f"{twice[0]} stands in the case and in {path.name}; give it once")
        return ForceHistory(**{**self._tail, **columns})


AnyLoad = Annotated[Step | Ramp | Triangle | History, Field(discriminator="kind")]
