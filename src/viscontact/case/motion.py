"""Section `motion` of a case file."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Discriminator, Field, Tag, model_validator

from viscontact import tables
from viscontact.bodies import loads
from viscontact.bodies.loads.motion import Motion
from viscontact.bodies.loads.steady_motion import SteadyMotion, checked_creepages
from viscontact.case.data_file import DataFile
from viscontact.case.quantities import (
    Creepage,
    CycleCount,
    Duration,
    Instant,
    Length,
    Offset,
    Section,
    Speed,
    SpeedCount,
    Spin,
)
from viscontact.case.section_choice import ChosenBy

#: Columns of a table of the path.
_AXES = ("x", "y")
_COLUMNS = ("time", *_AXES)


def _axis(cell: str) -> str | None:
    """Axis of the positions below a heading."""
    name = cell.split("[")[0].strip()
    return name if name in _AXES else None


#: Creepage across the travel, of all kinds of motion.
LateralCreepage = Annotated[
    Creepage | None,
    Field(
        description="beside a creepage, which may be 0: speed of the body's surface across its "
        "travel, over that; positive to the right of it, which is +x for a travel towards +y",
        examples=["0.1 %"],
    ),
]


class MotionSection(Section):
    """A motion of the body over the surface."""

    rolling: bool | None = Field(
        default=None,
        description="whether the material of both bodies flows through the contact; if not, the "
        "body slides; required if the indenter's material is not elastic",
    )

    @abstractmethod
    def build(self) -> Motion:
        """Return the motion."""

    @cached_property
    def built(self) -> Motion:
        """The motion, built once: its file is read once."""
        return self.build()

    @property
    def files(self) -> dict[tuple[str, ...], Path]:
        """Files of the motion, by their keys."""
        return {}

    @model_validator(mode="after")
    def _accepted(self) -> MotionSection:
        _ = self.built
        return self


class MotionOverTime(MotionSection):
    """A motion whose positions over time are given."""

    creepage: Creepage | None = Field(
        default=None,
        description="under friction: surface speed of the body that rolls over its travel, less 1; "
        "positive if it drives",
        examples=["0.3 %"],
    )
    lateral_creepage: LateralCreepage = None

    @property
    def _creepages(self) -> dict[str, Any]:
        return {"creepage": self.creepage, "lateral_creepage": self.lateral_creepage}


class Travel(MotionOverTime):
    """A path of the body through points at given times; at rest before and after."""

    kind: Literal["travel"]
    points: list[Annotated[tuple[Instant, Offset], Field(strict=False)]] | None = Field(
        default=None,
        description="[time, position] each, of the body's axis, with constant velocity between "
        "them",
        examples=[[["0 s", "0 mm"], ["2 s", "40 mm"]]],
    )
    along: Literal["x", "y"] = Field(default="y", description="axis of the positions")
    file: DataFile | None = Field(
        default=None,
        description="table in place of points, with a header such as: time [s], x [mm], y [mm]",
        examples=["path.csv"],
    )

    def build(self) -> Motion:
        """Return the path, from its points or its file."""
        if (self.points is None) == (self.file is None):
            raise ValueError(
                "give points (e.g. '[[0 s, 0 mm], [2 s, 40 mm]]') or file, and only one of them"
            )
        if self.file is not None:
            if "along" in self.model_fields_set:
                raise ValueError("along goes with points; a file has columns x and y")
            return self._from_file(Path(self.file))
        if not self.points:
            raise ValueError("points is empty; write e.g. '[[0 s, 0 mm], [2 s, 40 mm]]'")
        times, positions = zip(*self.points, strict=True)
        return self._through(times, {self.along: positions})

    @property
    def files(self) -> dict[tuple[str, ...], Path]:
        """File of the path, if it has one."""
        return {} if self.file is None else {("file",): Path(self.file)}

    def _from_file(self, path: Path) -> Motion:
        try:
            heading = tables.read_source(path, lambda cell: _axis(cell) is not None).found.rows[0]
            table = tables.read_table(path, {c: axis for c in heading.cells if (axis := _axis(c))})
        except ValueError as error:
            raise ValueError(f"file: {error}") from error
        others = [table.headings[column] for column in table.columns if column not in _COLUMNS]
        for unknown in (*table.left_out, *others):
            raise ValueError(
                f"file: {path.name}: cannot read the column name {unknown!r}; names are "
                f"{', '.join(_COLUMNS)}, each with its unit, as 'y [mm]'"
            )
        if "time" not in table or not ("x" in table or "y" in table):
            raise ValueError(f"file: {path.name}: needs the column time, and x or y or both")
        places: dict[str, Any] = {name: table[name] for name in _AXES if name in table}
        return self._through(table["time"], places)

    def _through(self, times: Any, places: dict[str, Any]) -> Motion:
        return loads.Travel(times, **places, rolling=self.rolling, **self._creepages)


class Reciprocating(MotionOverTime):
    """A motion back and forth, amplitude sin(2 pi t/period), from time 0."""

    kind: Literal["reciprocating"]
    amplitude: Length = Field(description="largest distance from the middle")
    period: Duration = Field(description="time of a cycle", examples=["1 s"])
    cycles: CycleCount = Field(description="number of cycles; then the body is at rest")
    along: Literal["x", "y"] = Field(default="y", description="axis of the motion")

    def build(self) -> Motion:
        """Return the motion."""
        return loads.reciprocating(
            *(self.amplitude, self.period, self.cycles, self.along),
            rolling=self.rolling,
            **self._creepages,
        )


class SpeedRange(Section):
    """Speeds from one to another."""

    first: Speed = Field(alias="from", description="first speed")
    to: Speed = Field(description="last speed")
    count: SpeedCount = Field(description="number of speeds, with both ends")
    spacing: Literal["log", "uniform"] = Field(
        default="log", description="log: equal ratios of neighbours; uniform: equal differences"
    )

    @property
    def speeds(self) -> tuple[float, ...]:
        """The speeds [m/s]."""
        space = np.geomspace if self.spacing == "log" else np.linspace
        return tuple(space(self.first, self.to, self.count).tolist())


def _form_of_several(given: Any) -> str:
    if isinstance(given, list | tuple):
        return "list"
    return "range" if isinstance(given, dict | Section) else "one"


class CreepageRange(Section):
    """Creepages from one to another."""

    first: Creepage = Field(alias="from", description="first creepage")
    to: Creepage = Field(description="last creepage")
    count: SpeedCount = Field(description="number of creepages, with both ends")
    spacing: Literal["log", "uniform"] = Field(
        default="uniform",
        description="log: equal ratios of neighbours; uniform: equal differences",
    )

    @model_validator(mode="after")
    def _has_ratios(self) -> CreepageRange:
        if self.spacing == "log" and not self.first * self.to > 0:
            raise ValueError("spacing: log needs two creepages of one sign, neither of them 0")
        return self

    @property
    def creepages(self) -> tuple[float, ...]:
        """The creepages [-]."""
        space = np.geomspace if self.spacing == "log" else np.linspace
        return tuple(space(self.first, self.to, self.count).tolist())


class Steady(MotionSection):
    """A motion at constant speed, after so long a way that nothing changes any more."""

    kind: Literal["steady"]
    speed: Annotated[
        Annotated[Speed, Tag("one")]
        | Annotated[list[Speed], Field(min_length=1), Tag("list")]
        | Annotated[SpeedRange, Tag("range")],
        Discriminator(_form_of_several),
    ] = Field(
        description="speed towards +x or +y, or several, each of which is computed",
        examples=[
            "0.5 m/s",
            ["0.1 m/s", "1 m/s"],
            {"from": "1 mm/s", "to": "1 m/s", "count": 7, "spacing": "log"},
        ],
    )
    along: Literal["x", "y"] = Field(
        default="y", description="axis of the motion; a roller rolls along y"
    )
    creepage: (
        Annotated[
            Annotated[Creepage, Tag("one")]
            | Annotated[list[Creepage], Field(min_length=1), Tag("list")]
            | Annotated[CreepageRange, Tag("range")],
            Discriminator(_form_of_several),
        ]
        | None
    ) = Field(
        default=None,
        description="under friction: surface speed of the body that rolls over its travel, less 1, "
        "or several, each of which is computed; positive if it drives",
        examples=["0.3 %", ["0.1 %", "1 %"], {"from": "0.1 %", "to": "2 %", "count": 10}],
    )
    lateral_creepage: LateralCreepage = None
    spin: Spin | None = Field(
        default=None,
        description="beside a creepage, which may be 0: rotation of the body's surface over its "
        "travel, from x to y, as the sine of a wheel's camber over its radius",
        examples=["0.5 rad/m"],
    )

    def build(self) -> SteadyMotion:
        """Return the motion."""
        given = self.speed
        if isinstance(given, SpeedRange):
            speeds = given.speeds
        else:
            speeds = tuple(given) if isinstance(given, list) else (given,)
        askew = self.lateral_creepage, self.spin
        return SteadyMotion(speeds, self.along, self.rolling, self._creepages, *askew)

    @property
    def _creepages(self) -> tuple[float, ...]:
        given = self.creepage
        if isinstance(given, CreepageRange):
            return given.creepages
        if given is None:
            return ()
        return checked_creepages(given, rolling=self.rolling)


AnyMotion = Annotated[Travel | Reciprocating | Steady, ChosenBy("kind")]
