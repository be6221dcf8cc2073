"""Sections `friction` and `tangential` of a case file."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from viscontact.bodies import friction, loads
from viscontact.bodies.friction import LARGEST
from viscontact.bodies.loads import TangentialLoad
from viscontact.bodies.loads.tangential import UNITS
from viscontact.case.quantities import (
    POSITIVE,
    Angle,
    CycleCount,
    Duration,
    Instant,
    Offset,
    Section,
    WithUnit,
)
from viscontact.case.section_choice import ChosenBy

_SignedForce = Annotated[float, WithUnit("force")]
_Torque = Annotated[float, WithUnit("torque")]


class FrictionSection(Section):
    """Coulomb friction between the bodies."""

    coefficient: Annotated[float, Field(gt=0, le=LARGEST)] = Field(
        description="coefficient of friction", examples=[0.3]
    )
    coupling: bool = Field(
        default=True,
        description="false: pressure does not move the surface along itself, which is exact for "
        "bodies of the same material and of Poisson's ratio 1/2",
    )

    wear: Annotated[float, WithUnit("wear rate", POSITIVE)] | None = Field(
        default=None,
        description="worn volume over normal force and way of slip (Archard), for the wear that "
        "reports state",
        examples=["1e-7 mm^3/(N m)"],
    )

    @property
    def built(self) -> friction.Friction:
        """The friction."""
        return friction.Friction(self.coefficient, self.coupling, self.wear)


class TangentialSection(Section):
    """A load along the surface, of the body on the half-space."""

    @abstractmethod
    def build(self) -> TangentialLoad:
        """Return the load."""

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
    """A load along the surface by points, linear between its instants."""

    kind: Literal["history"]
    times: list[Instant] = Field(
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

    def build(self) -> TangentialLoad:
        """Return the history, from its points."""
        points: dict[str, Any] = {
            name: getattr(self, name) for name in UNITS if getattr(self, name) is not None
        }
        if not points:
            raise ValueError(
                "give one or more of "
                f"{', '.join(UNITS)}, each with a value for each time, as 'force_x: [0 N, 2 N]'"
            )
        return loads.TangentialHistory(self.times, **points)


AnyTangential = Annotated[
    TangentialStep | TangentialRamp | TangentialHarmonic | TangentialHistory, ChosenBy("kind")
]
