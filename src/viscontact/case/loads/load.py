"""Load section of a case file."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, WithJsonSchema

from viscontact.bodies import loads
from viscontact.bodies.loads import LoadHistory, LoadProgram
from viscontact.bodies.loads.history import Control
from viscontact.bodies.loads.mixed import as_history
from viscontact.bodies.loads.program_sentences import FORMS, parsed_sentences
from viscontact.case.errors import dotted
from viscontact.case.loads.base import Controlled, Load, force_or_approach
from viscontact.case.loads.history import History
from viscontact.case.loads.levels import (
    APPROACH_EXAMPLE,
    BY_LENGTH,
    ForceOrApproach,
    Prescribed,
)
from viscontact.case.quantities import (
    Angle,
    AnyForce,
    CycleCount,
    Duration,
    LineLoad,
    Offset,
)
from viscontact.case.section_choice import ChosenBy
from viscontact.units.dimensions import DIMENSIONS

_SCHEMA = {
    "description": "what the instrument does in turn, such as " + ", ".join(map(repr, FORMS)),
    "anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}],
    "examples": [f"{FORMS[0]}; {FORMS[1]}"],
}


class Step(Controlled):
    """A force or an approach applied instantly, then held."""

    kind: Literal["step"]

    def build(self, extent: float = 1.0) -> LoadHistory:
        """Return the step."""
        return loads.step(**self._height(extent), **self._tail)


class Ramp(Controlled):
    """A force or an approach that increases linearly, then is held."""

    kind: Literal["ramp"]
    duration: Duration = Field(description="duration of the rise; then the level is held")

    def build(self, extent: float = 1.0) -> LoadHistory:
        """Return the ramp."""
        return loads.ramp(**self._height(extent), duration=self.duration, **self._tail)


class Triangle(Controlled):
    """A force or an approach that increases linearly to its peak, then decreases to zero."""

    kind: Literal["triangle"]
    rise: Duration = Field(description="duration of the rise")
    fall: Duration | None = Field(
        default=None, description="duration of the fall; that of the rise when left out"
    )

    def build(self, extent: float = 1.0) -> LoadHistory:
        """Return the triangle."""
        return loads.triangle(**self._height(extent), rise=self.rise, fall=self.fall, **self._tail)


class Harmonic(Load):
    """A harmonic force or approach, mean + amplitude sin(2 pi t/period + phase)."""

    kind: Literal["harmonic"]
    mean: AnyForce | None = Field(default=None, description="mean force")
    approach: Offset | None = Field(
        default=None,
        description="mean approach, in place of the mean force",
        examples=[APPROACH_EXAMPLE],
    )
    line_load: LineLoad | None = Field(
        default=None,
        description="of a line contact, in place of the mean force: mean force per unit length",
    )
    amplitude: ForceOrApproach = Field(
        description="of the force, of the approach, or of the force per unit length"
    )
    period: Duration = Field(description="time of a cycle", examples=["1 s"])
    cycles: CycleCount = Field(description="number of cycles; then the level is held")
    phase: Angle = Field(default=0.0, description="at time 0")

    @property
    def _force_key(self) -> str:
        """Key of the force that pulls: what the amplitude takes off the mean."""
        return "mean"

    def build(self, extent: float = 1.0) -> LoadHistory:
        """Return the harmonic load."""
        middle, control = self._middle(extent)
        if self.amplitude.control != control:
            wanted, example = {
                "force": ("a force, as the mean", DIMENSIONS["force"].example),
                "approach": ("a length, as the approach", APPROACH_EXAMPLE),
                BY_LENGTH: ("a force per length, as the line_load", DIMENSIONS[BY_LENGTH].example),
            }[control]
            raise ValueError(f"amplitude must be {wanted} is; write e.g. 'amplitude: {example}'")
        return loads.harmonic(
            **middle,
            amplitude=self.amplitude.value * (extent if control == BY_LENGTH else 1.0),
            period=self.period,
            cycles=self.cycles,
            phase=self.phase,
            **self._tail,
        )

    def _middle(self, extent: float) -> tuple[dict[Control, float], Prescribed]:
        """Mean level by its argument, and what it prescribes; a line load acts on a length [m]."""
        if self.line_load is None:
            middle = force_or_approach(self.approach, "mean", self.mean)
            return middle, "approach" if "approach" in middle else "force"
        for name in ("mean", "approach"):
            if getattr(self, name) is not None:
                raise ValueError(f"line_load and {name} exclude each other; give one of them")
        return {"mean": self.line_load * extent}, BY_LENGTH  # type: ignore[dict-item]


class Program(Load):
    """Segments that prescribe the force or the approach, each up to a duration or a condition."""

    kind: Literal["program"]
    sentences: Annotated[str | list[str], WithJsonSchema(_SCHEMA)]

    def build(self, extent: float = 1.0) -> LoadHistory:
        """Return the history of the program, which awaits its events."""
        tail: dict[str, Any] = self._tail
        return as_history(LoadProgram(self._readable_sentences(), **tail))

    def _readable_sentences(self) -> list[str]:
        """Sentences that can be read; the key of one that cannot is named."""
        given = [self.sentences] if isinstance(self.sentences, str) else self.sentences
        for place, text in enumerate(given):
            try:
                parsed_sentences(text)
            except ValueError as error:
                is_list = isinstance(self.sentences, list)
                key = ("sentences", place) if is_list else ("sentences",)
                why = str(error).removeprefix("load program: ")
                raise ValueError(f"{dotted(key)}: {why}") from error
        return given


AnyLoad = Annotated[
    Step | Ramp | Triangle | Harmonic | History | Program,
    ChosenBy("kind"),
]
