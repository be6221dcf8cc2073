"""Section of a load by points, from a table, or in sentences."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from viscontact import tables
from viscontact.bodies.loads import ApproachHistory, ForceHistory, LoadHistory
from viscontact.bodies.loads.history import Control
from viscontact.bodies.loads.history_points import TILTS
from viscontact.bodies.loads.level import refuse_stage
from viscontact.case.data_file import DataFile, at_key
from viscontact.case.errors import dotted
from viscontact.case.loads.base import PRESSURE_EXAMPLE, Load
from viscontact.case.loads.course import SentenceError
from viscontact.case.loads.levels import (
    BY_LENGTH,
    IN_WORDS,
    ForceOrApproach,
    Level,
    Prescribed,
)
from viscontact.case.loads.sentence_history import LoadPoints, course_of
from viscontact.case.loads.sentences import Sentences
from viscontact.case.ordered_times import refuse_decrease
from viscontact.case.quantities import (
    Instant,
    Pressure,
)

_COLUMNS = ("time", "force", "approach", "eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")


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
        description="table with a header such as: time [s], force [kN], eccentricity_x [mm]; or "
        "approach [um] in place of the force",
        examples=["load.csv"],
    )
    columns: str | None = Field(
        default=None,
        description="names of all columns of a table without a header, or in place of its own",
        examples=["time [s], force [N]"],
    )
    sentences: Sentences | None = None

    @property
    def table(self) -> Path | None:
        """File of the history, if there is one."""
        return None if self.file is None else Path(self.file)

    def build(self, extent: float = 1.0) -> LoadHistory:
        """Return the history, from its points, its file or its sentences."""
        given = [self.points, self.mean_pressure, self.file, self.sentences]
        if given.count(None) != len(given) - 1:
            raise ValueError(
                "give points (e.g. '[[0 s, 0 N], [1 s, 10 kN]]'), mean_pressure, file or sentences "
                "(e.g. 'ramp to 10 kN in 1 s'), and only one of them"
            )
        if self.file is not None:
            return self._from_file(Path(self.file))
        if self.columns is not None:
            raise ValueError("columns: goes with file; leave it out")
        if self.mean_pressure is not None:
            return self._from_pressures(extent)
        if self.sentences is not None:
            return self._from_sentences(extent)
        return self._from_points(extent)

    @property
    def is_by_length(self) -> bool:
        """True if line loads are prescribed, which need a length."""
        if self.sentences is not None:
            return self._course(may_pull=True).control == BY_LENGTH
        return any(level.control == BY_LENGTH for _, level in self.points or ())

    def _from_points(self, length: float) -> LoadHistory:
        if not self.points:
            raise ValueError("points is empty; write e.g. '[[0 s, 0 N], [1 s, 10 kN]]'")
        times, levels = zip(*self.points, strict=True)
        values = [level.value for level in levels]
        return _prescribed(_common_control(levels), times, values, length, self._tail)

    def _from_pressures(self, area: float) -> LoadHistory:
        if not self.mean_pressure:
            raise ValueError("mean_pressure is empty; write e.g. '[[0 s, 0 MPa], [1 s, 2 MPa]]'")
        times, pressures = zip(*self.mean_pressure, strict=True)
        return _history("force", times, [each * area for each in pressures], self._tail)

    @property
    def _force_key(self) -> str:
        """Key of the force: the first point that pulls, or the table."""
        for place, (_, level) in enumerate(self.points or (), start=1):
            if level.value < 0:
                return f"points[{place}]"
        return "file"

    def refuse_pull(self) -> None:
        """Raise ValueError, with the key, for a force that pulls, which needs adhesion."""
        if self.sentences is not None:
            self._course(may_pull=False)
        else:
            super().refuse_pull()

    def _from_sentences(self, length: float) -> LoadHistory:
        return _prescribed(*self._course(may_pull=True), length, self._tail)

    def _course(self, *, may_pull: bool) -> LoadPoints:
        sentences = [sentence for entry in self.sentences or () for sentence in entry]
        try:
            return course_of(sentences, may_pull=may_pull)
        except SentenceError as error:
            # A text has no entries, so the message names the key of the section.
            key = ("sentences", error.entry - 1)
            raise ValueError(f"{dotted(key)}: {error}") from error
        except ValueError as error:
            raise ValueError(f"sentences: {error}") from error

    def _from_file(self, path: Path) -> LoadHistory:
        columns = _read_table(path, self.columns)
        twice = sorted(columns.keys() & self.model_fields_set)
        if twice:
            raise ValueError(f"{twice[0]} is given in the case and in {path.name}; give it once")
        control: Control = "approach" if "approach" in columns else "force"
        times, levels = columns.pop("times"), columns.pop(control)
        return _history(control, times, levels, {**self._tail, **columns})


def _common_control(levels: Sequence[Level]) -> Prescribed:
    for place, level in enumerate(levels, start=1):
        if level.control != levels[0].control:
            raise ValueError(
                f"points[{place}]: it is {IN_WORDS[level.control]}, {IN_WORDS[levels[0].control]} "
                "in the first point; either the force or the approach is prescribed, throughout"
            )
    return levels[0].control


def _prescribed(
    control: Prescribed,
    times: Sequence[float],
    levels: Sequence[float],
    length: float,
    tail: dict[str, Any],
) -> LoadHistory:
    """History of levels; line loads act on a length [m]."""
    if control == BY_LENGTH:
        return _history("force", times, [each * length for each in levels], tail)
    return _history(control, times, levels, tail)


def _history(
    control: Control, times: Sequence[float], levels: Sequence[float], tail: dict[str, Any]
) -> LoadHistory:
    if control == "force":
        refuse_stage(tail.get("stage_stiffness"))
        own = {name: given for name, given in tail.items() if name != "stage_stiffness"}
        return ForceHistory(times, levels, **own)
    tilts = {name: tail[name] for name in (*TILTS, "stage_stiffness") if name in tail}
    for name in tail.keys() - tilts.keys():
        if any(tail[name] if isinstance(tail[name], list) else [tail[name]]):
            raise ValueError(
                f"{name} goes with a force; with an approach no force is prescribed that could "
                "act there, so leave it out, or prescribe the tilt"
            )
    return ApproachHistory(times, levels, **tilts)


def _read_table(path: Path, names: str | None) -> dict[str, list[float]]:
    """Read a load history from a CSV file."""
    try:
        table = tables.read_table(path, names, wanted=("force", "approach"))
        _require_columns(table)
        refuse_decrease(table)
    except ValueError as error:
        raise ValueError(at_key(str(error))) from error
    values = {name: column.tolist() for name, column in table.columns.items()}
    values["times"] = values.pop("time")
    return values


def _require_columns(table: tables.Table) -> None:
    name = table.source.name
    # An ignored column could be a load that is not applied.
    others = [table.headings[column] for column in table.columns if column not in _COLUMNS]
    for unknown in (*table.left_out, *others):
        raise ValueError(
            f"{name}: cannot read the column name {unknown!r}; "
            f"names are {', '.join(_COLUMNS)}, each with its unit, as 'force [kN]'"
        )
    if "time" not in table:
        raise ValueError(f"{name}: the column time is missing")
    if "force" in table and "approach" in table:
        raise ValueError(
            f"{name}: the columns force and approach exclude each other; only one of them can be "
            "prescribed"
        )
    if "force" not in table and "approach" not in table:
        raise ValueError(f"{name}: the column force is missing, or approach in its place")
