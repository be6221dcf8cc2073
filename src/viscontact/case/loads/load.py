"""Load section of a case file."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from viscontact import loads
from viscontact.case.data_file import DataFile
from viscontact.case.errors import dotted
from viscontact.case.loads.levels import APPROACH_EXAMPLE, ForceOrApproach, Level, Tilt
from viscontact.case.loads.load_table import read_load_table
from viscontact.case.loads.sentence_history import SentenceError, course_of
from viscontact.case.loads.sentences import Sentences
from viscontact.case.quantities import (
    Angle,
    CycleCount,
    Duration,
    Force,
    Instant,
    Offset,
    Pressure,
    Section,
)
from viscontact.loads import ApproachHistory, ForceHistory, LoadHistory
from viscontact.loads.history import Control
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.formatting import format_quantity

#: Example of a mean pressure; that of a modulus would be too large.
PRESSURE_EXAMPLE = "2 MPa"

_FREE = "prescribed slope along {}, in place of the moment balance; free: no moment"


class Load(Section):
    """A force or an approach over time, its eccentricity, and prescribed tilts."""

    eccentricity_x: Offset = Field(default=0.0, description="position of the force along x")
    eccentricity_y: Offset = Field(default=0.0, description="position of the force along y")
    tilt_x: Tilt = Field(default=None, description=_FREE.format("x"))
    tilt_y: Tilt = Field(default=None, description=_FREE.format("y"))

    @abstractmethod
    def build(self, area: float = 1.0) -> LoadHistory:
        """Return the history; a mean pressure acts on the given area [m²]."""

    @cached_property
    def built(self) -> LoadHistory:
        """The history, built once: its file is read once. A mean pressure acts on 1 m²."""
        return self.build()

    @property
    def table(self) -> Path | None:
        """File of the history, if there is one."""
        return None

    @property
    def is_by_pressure(self) -> bool:
        """True if a mean pressure is prescribed, which needs an area."""
        return getattr(self, "mean_pressure", None) is not None

    @property
    def _tail(self) -> dict[str, Any]:
        """Arguments that the file gives; the constructor has defaults for the others."""
        given = [name for name in Load.model_fields if name in self.model_fields_set]
        return {name: getattr(self, name) for name in given}

    @model_validator(mode="after")
    def _accepted(self) -> Load:
        # Errors of the constructor are reported among the problems of the file.
        _ = self.built
        return self


class Controlled(Load):
    """History whose level is a force or an approach."""

    force: Force | None = Field(default=None, description="prescribed force")
    approach: Offset | None = Field(
        default=None,
        description="prescribed approach, in place of the force",
        examples=[APPROACH_EXAMPLE],
    )
    mean_pressure: Pressure | None = Field(
        default=None,
        description="on a periodic grid, in place of the force: force over the grid's area",
        examples=[PRESSURE_EXAMPLE],
    )

    def _height(self, area: float) -> dict[Control, float]:
        if self.mean_pressure is None:
            return _one_of(self.approach, "force", self.force)
        for name in ("force", "approach"):
            if getattr(self, name) is not None:
                raise ValueError(f"mean_pressure and {name} exclude each other; give one of them")
        return {"force": self.mean_pressure * area}


class Step(Controlled):
    """A force or an approach applied at once, then held."""

    kind: Literal["step"]

    def build(self, area: float = 1.0) -> LoadHistory:
        """Return the step."""
        return loads.step(**self._height(area), **self._tail)


class Ramp(Controlled):
    """A force or an approach that increases linearly, then is held."""

    kind: Literal["ramp"]
    duration: Duration = Field(description="duration of the rise; then the level is held")

    def build(self, area: float = 1.0) -> LoadHistory:
        """Return the ramp."""
        return loads.ramp(**self._height(area), duration=self.duration, **self._tail)


class Triangle(Controlled):
    """A force or an approach that increases linearly to its peak, then decreases to zero."""

    kind: Literal["triangle"]
    rise: Duration = Field(description="duration of the rise")
    fall: Duration | None = Field(
        default=None, description="duration of the fall; that of the rise when left out"
    )

    def build(self, area: float = 1.0) -> LoadHistory:
        """Return the triangle."""
        return loads.triangle(**self._height(area), rise=self.rise, fall=self.fall, **self._tail)


class Harmonic(Load):
    """A harmonic force or approach, mean + amplitude sin(2 pi t/period + phase)."""

    kind: Literal["harmonic"]
    mean: Force | None = Field(default=None, description="mean force")
    approach: Offset | None = Field(
        default=None,
        description="mean approach, in place of the mean force",
        examples=[APPROACH_EXAMPLE],
    )
    amplitude: ForceOrApproach = Field(description="of the force, or of the approach")
    period: Duration = Field(description="time of a cycle")
    cycles: CycleCount = Field(description="number of cycles; then the level is held")
    phase: Angle = Field(default=0.0, description="at time 0")

    def build(self, area: float = 1.0) -> LoadHistory:
        """Return the harmonic load."""
        middle = _one_of(self.approach, "mean", self.mean)
        control: Control = "approach" if "approach" in middle else "force"
        if self.amplitude.control != control:
            wanted, example = {
                "force": ("a force, as the mean", DIMENSIONS["force"].example),
                "approach": ("a length, as the approach", APPROACH_EXAMPLE),
            }[control]
            raise ValueError(f"amplitude must be {wanted} is; write e.g. 'amplitude: {example}'")
        return loads.harmonic(
            **middle,
            amplitude=self.amplitude.value,
            period=self.period,
            cycles=self.cycles,
            phase=self.phase,
            **self._tail,
        )


class History(Load):
    """A force or an approach by points, from a table, or in sentences."""

    kind: Literal["history"]
    points: list[Annotated[tuple[Instant, ForceOrApproach], Field(strict=False)]] | None = Field(
        default=None,
        description="[time, force] or [time, approach] each, linear between them; a time given "
        "twice is a jump",
        examples=[[["0 s", "0 N"], ["1 s", "10 kN"]]],
    )
    mean_pressure: list[Annotated[tuple[Instant, Pressure], Field(strict=False)]] | None = Field(
        default=None,
        description="on a periodic grid: [time, pressure] each, in place of points",
        examples=[[["0 s", "0 MPa"], ["1 s", PRESSURE_EXAMPLE]]],
    )
    file: DataFile | None = Field(
        default=None,
        description="CSV with a header such as: time [s], force [kN], eccentricity_x [mm]; or "
        "approach [um] in place of the force",
        examples=["load.csv"],
    )
    sentences: Sentences | None = None

    @property
    def table(self) -> Path | None:
        """File of the history, if there is one."""
        return None if self.file is None else Path(self.file)

    def build(self, area: float = 1.0) -> LoadHistory:
        """Return the history, from its points, its file or its sentences."""
        given = [self.points, self.mean_pressure, self.file, self.sentences]
        if given.count(None) != len(given) - 1:
            raise ValueError(
                "give points (e.g. '[[0 s, 0 N], [1 s, 10 kN]]'), mean_pressure, file or sentences "
                "(e.g. 'ramp to 10 kN in 1 s'), and only one of them"
            )
        if self.file is not None:
            return self._from_file(Path(self.file))
        if self.mean_pressure is not None:
            return self._from_pressures(area)
        if self.sentences is not None:
            return self._from_sentences()
        return self._from_points()

    def _from_points(self) -> LoadHistory:
        if not self.points:
            raise ValueError("points is empty; write e.g. '[[0 s, 0 N], [1 s, 10 kN]]'")
        times, levels = zip(*self.points, strict=True)
        control = _common_control(levels)
        for place, level in enumerate(levels, start=1):
            if control == "force" and level.value < 0:
                raise ValueError(
                    f"points[{place}]: a force must be zero or more, got "
                    f"{format_quantity(level.value, 'N', 6)}: a negative force pulls, and adhesion "
                    "is not modelled"
                )
        return _history(control, times, [level.value for level in levels], self._tail)

    def _from_pressures(self, area: float) -> LoadHistory:
        if not self.mean_pressure:
            raise ValueError("mean_pressure is empty; write e.g. '[[0 s, 0 MPa], [1 s, 2 MPa]]'")
        times, pressures = zip(*self.mean_pressure, strict=True)
        return _history("force", times, [each * area for each in pressures], self._tail)

    def _from_sentences(self) -> LoadHistory:
        sentences = [sentence for entry in self.sentences or () for sentence in entry]
        try:
            course = course_of(sentences)
        except SentenceError as error:
            # A text has no entries, so the message names the key of the section.
            key = ("sentences", error.entry - 1)
            raise ValueError(f"{dotted(key)}: {error}") from error
        except ValueError as error:
            raise ValueError(f"sentences: {error}") from error
        return _history(*course, self._tail)

    def _from_file(self, path: Path) -> LoadHistory:
        columns = read_load_table(path)
        twice = sorted(columns.keys() & self.model_fields_set)
        if twice:
            raise ValueError(f"{twice[0]} is given in the case and in {path.name}; give it once")
        control: Control = "approach" if "approach" in columns else "force"
        times, levels = columns.pop("times"), columns.pop(control)
        return _history(control, times, levels, {**self._tail, **columns})


def _one_of(approach: float | None, name: str, value: float | None) -> dict[Any, float]:
    """Argument that is given, the level by its name or the approach; both are refused."""
    if approach is not None and value is not None:
        raise ValueError(f"{name} and approach exclude each other; give one of them")
    if approach is not None:
        return {"approach": approach}
    if value is not None:
        return {name: value}
    force = DIMENSIONS["force"].example
    raise ValueError(
        f"{name} is missing; write e.g. '{name}: {force}', or 'approach: {APPROACH_EXAMPLE}'"
    )


def _common_control(levels: Sequence[Level]) -> Control:
    for place, level in enumerate(levels, start=1):
        if level.control != levels[0].control:
            words = {"force": "a force", "approach": "a length"}
            raise ValueError(
                f"points[{place}]: it is {words[level.control]}, {words[levels[0].control]} "
                "in the first point; either the force or the approach is prescribed, throughout"
            )
    return levels[0].control


def _history(
    control: Control, times: Sequence[float], levels: Sequence[float], tail: dict[str, Any]
) -> LoadHistory:
    if control == "force":
        return ForceHistory(times, levels, **tail)
    tilts = {name: tail[name] for name in ("tilt_x", "tilt_y") if name in tail}
    for name in tail.keys() - tilts.keys():
        if any(tail[name] if isinstance(tail[name], list) else [tail[name]]):
            raise ValueError(
                f"{name} goes with a force; with an approach no force is prescribed that could "
                "act there, so leave it out, or prescribe the tilt"
            )
    return ApproachHistory(times, levels, **tilts)


AnyLoad = Annotated[
    Step | Ramp | Triangle | Harmonic | History,
    Field(discriminator="kind"),
]
