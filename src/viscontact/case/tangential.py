"""Section `tangential` of a case file: a load along the surface."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from viscontact.bodies import loads
from viscontact.bodies.loads import TangentialLoad
from viscontact.bodies.loads.tangential import UNITS
from viscontact.case.data_file import DataFile
from viscontact.case.quantities import (
    Angle,
    CycleCount,
    Duration,
    Instant,
    Offset,
    Section,
    WithUnit,
)
from viscontact.case.section_choice import ChosenBy
from viscontact.case.tangential_table import read_tangential

_SignedForce = Annotated[float, WithUnit("force")]
_Torque = Annotated[float, WithUnit("torque")]


class TangentialSection(Section):
    """A load along the surface, of the body on the half-space."""

    @abstractmethod
    def build(self) -> TangentialLoad:
        """Return the load."""

    @property
    def table(self) -> Path | None:
        """File of the load, if there is one."""
        return None

    @cached_property
    def built(self) -> TangentialLoad:
        """The load, built once."""
        return self.build()

    @model_validator(mode="after")
    def _accepted(self) -> TangentialSection:
        _ = self.built
        return self


class Values(TangentialSection):
    """Forces and a torque, or motions in their place."""

    force_x: _SignedForce | None = Field(
        default=None, description="force along x", examples=["1.5 N"]
    )
    force_y: _SignedForce | None = Field(
        default=None, description="force along y", examples=["1.5 N"]
    )
    torque: _Torque | None = Field(
        default=None, description="torque about the body's axis", examples=["2 N mm"]
    )
    displacement_x: Offset | None = Field(
        default=None,
        description="shift of the body along x, in place of the force",
        examples=["10 um"],
    )
    displacement_y: Offset | None = Field(
        default=None,
        description="shift of the body along y, in place of the force",
        examples=["10 um"],
    )
    rotation: Angle | None = Field(
        default=None, description="rotation of the body, in place of the torque"
    )

    @property
    def _given(self) -> dict[str, Any]:
        """Values that are given, by name; ValueError without any."""
        given = {name: getattr(self, name) for name in UNITS}
        found = {name: value for name, value in given.items() if value is not None}
        if not found:
            raise ValueError(f"give one or more of {', '.join(UNITS)}")
        return found


class TangentialStep(Values):
    """A load along the surface that comes at time 0, then is held."""

    kind: Literal["step"]

    def build(self) -> TangentialLoad:
        """Return the step."""
        return loads.tangential_step(**self._given)


class TangentialRamp(Values):
    """A load along the surface that increases linearly, then is held."""

    kind: Literal["ramp"]
    duration: Duration = Field(description="duration of the rise; then the load is held")

    def build(self) -> TangentialLoad:
        """Return the ramp."""
        return loads.tangential_ramp(duration=self.duration, **self._given)


class TangentialHarmonic(Values):
    """A harmonic load along the surface, amplitude sin(2 pi t/period + phase)."""

    kind: Literal["harmonic"]
    period: Duration = Field(description="time of a cycle", examples=["1 s"])
    cycles: CycleCount = Field(description="number of cycles; then the load is held")
    phase: Angle = Field(default=0.0, description="at time 0")

    def build(self) -> TangentialLoad:
        """Return the harmonic load."""
        return loads.tangential_harmonic(
            period=self.period, cycles=self.cycles, phase=self.phase, **self._given
        )


class TangentialHistory(TangentialSection):
    """A load along the surface by points, linear between its instants, or from a table."""

    kind: Literal["history"]
    times: list[Instant] | None = Field(
        default=None,
        description="instants of the points; one given twice is a jump",
        examples=[["0 s", "1 s", "3 s"]],
    )
    force_x: list[_SignedForce] | None = Field(
        default=None, description="forces along x", examples=[["0 N", "1.5 N", "-1.5 N"]]
    )
    force_y: list[_SignedForce] | None = Field(default=None, description="forces along y")
    torque: list[_Torque] | None = Field(default=None, description="torques")
    displacement_x: list[Offset] | None = Field(
        default=None, description="shifts along x, in place of the force"
    )
    displacement_y: list[Offset] | None = Field(
        default=None, description="shifts along y, in place of the force"
    )
    rotation: list[Angle] | None = Field(
        default=None, description="rotations, in place of the torque"
    )
    file: DataFile | None = Field(
        default=None,
        description="table with a header such as: time [s], force_x [N], or displacement_x [um]",
        examples=["shaken.csv"],
    )
    columns: str | None = Field(
        default=None,
        description="names of all columns of a table without a header, or in place of its own",
        examples=["time [s], force_x [N]"],
    )

    @property
    def table(self) -> Path | None:
        """File of the history, if there is one."""
        return None if self.file is None else Path(self.file)

    def build(self) -> TangentialLoad:
        """Return the history, from its points or its file."""
        points = {name: getattr(self, name) for name in UNITS if getattr(self, name) is not None}
        if self.file is not None:
            return self._from_file(Path(self.file), ["times"] * (self.times is not None), points)
        if self.columns is not None:
            raise ValueError("columns: goes with file; leave it out")
        if not points or self.times is None:
            raise ValueError(
                f"give times and one or more of {', '.join(UNITS)}, each with a value for each "
                "time, as 'force_x: [0 N, 2 N]', or a file"
            )
        return loads.TangentialHistory(self.times, **points)

    def _from_file(
        self, path: Path, given: list[str], points: dict[str, list[float]]
    ) -> TangentialLoad:
        for name in (*given, *points):
            raise ValueError(f"{name}: goes without file; give points or a file, not both")
        try:
            columns = read_tangential(path, self.columns)
            return loads.TangentialHistory(columns.pop("time"), **columns)
        except ValueError as error:
            at = "" if str(error).startswith("columns: ") else "file: "
            raise ValueError(f"{at}{error}") from error


AnyTangential = Annotated[
    TangentialStep | TangentialRamp | TangentialHarmonic | TangentialHistory, ChosenBy("kind")
]
