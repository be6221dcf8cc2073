"""Section `temperature` of a case file: that of the bodies, constant or over time."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, GetCoreSchemaHandler, GetJsonSchemaHandler, model_validator
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from viscontact import tables
from viscontact.bodies import loads
from viscontact.bodies.loads import TemperatureHistory
from viscontact.case.data_file import DataFile, at_key
from viscontact.case.errors import dotted
from viscontact.case.loads.course import SentenceError
from viscontact.case.loads.sentence_history import temperatures_of
from viscontact.case.loads.sentences import TemperatureSentences
from viscontact.case.ordered_times import refuse_decrease
from viscontact.case.quantities import (
    POSITIVE,
    Angle,
    CycleCount,
    Duration,
    Instant,
    Section,
    Temperature,
    TemperatureDifference,
    WithUnit,
)
from viscontact.case.section_choice import ChosenBy

_QUANTITY = WithUnit("temperature", POSITIVE)

#: Kinds of a temperature that is written as a quantity only, and of one without a kind.
CONSTANT, HISTORY = "constant", "history"


class TemperatureSection(Section):
    """A temperature of the bodies over time."""

    @abstractmethod
    def build(self) -> TemperatureHistory:
        """Return the history."""

    @cached_property
    def built(self) -> TemperatureHistory:
        """The history, built once: its file is read once."""
        return self.build()

    @property
    def table(self) -> Path | None:
        """File of the history, if there is one."""
        return None

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on contents of the file that are not used."""
        return ()

    @model_validator(mode="after")
    def _accepted(self) -> TemperatureSection:
        # Errors of the constructor are reported among the problems of the file.
        _ = self.built
        return self


class Constant(TemperatureSection):
    """A temperature that does not vary, also written as the quantity alone: 40 degC."""

    kind: Literal["constant"]
    value: Temperature = Field(description="temperature of all bodies", examples=["40 degC"])

    def build(self) -> TemperatureHistory:
        """Return the history."""
        return TemperatureHistory([0.0], self.value)


class Course(TemperatureSection):
    """A temperature by points, from a table, or in sentences, also written without kind."""

    kind: Literal["history"]
    points: list[Annotated[tuple[Instant, Temperature], Field(strict=False)]] | None = Field(
        default=None,
        description="[time, temperature] each, linear between them; a time given twice is a jump",
        examples=[[["0 s", "23 degC"], ["2 h", "60 degC"]]],
    )
    file: DataFile | None = Field(
        default=None,
        description="table with a header such as: time [h], temperature [degC]",
        examples=["day.csv"],
    )
    columns: str | None = Field(
        default=None,
        description="names of all columns of a table without a header, or in place of its own",
        examples=["time [h], temperature [degC]"],
    )
    sentences: TemperatureSentences | None = None
    start: Temperature | None = Field(
        default=None,
        description="first temperature of the sentences, where none of them gives it",
        examples=["23 degC"],
    )

    @property
    def table(self) -> Path | None:
        """File of the history, if there is one."""
        return None if self.file is None else Path(self.file)

    @property
    def notes(self) -> tuple[str, ...]:
        """Note on columns of the file that are not used."""
        if self.file is None:
            return ()
        table = self._read
        others = [table.headings[each] for each in table.columns if each not in _COLUMNS]
        unused = ", ".join((*table.left_out, *others))
        return (f"{table.source.name}: not used for the temperature: {unused}",) if unused else ()

    def build(self) -> TemperatureHistory:
        """Return the history, from its points, its file or its sentences."""
        given = [self.points, self.file, self.sentences]
        if given.count(None) != len(given) - 1:
            raise ValueError(
                "give points (e.g. '[[0 s, 23 degC], [2 h, 60 degC]]'), file or sentences (e.g. "
                "'start at 23 degC; heat to 60 degC in 2 h'), and only one of them"
            )
        for key, beside in (("columns", "file"), ("start", "sentences")):
            if getattr(self, key) is not None and getattr(self, beside) is None:
                raise ValueError(f"{key}: goes with {beside}; leave it out")
        if self.file is not None:
            return _history("file", *(self._read[name].tolist() for name in _COLUMNS))
        if self.sentences is not None:
            return self._from_sentences()
        if not self.points:
            raise ValueError("points is empty; write e.g. '[[0 s, 23 degC], [2 h, 60 degC]]'")
        return _history("points", *map(list, zip(*self.points, strict=True)))

    @cached_property
    def _read(self) -> tables.Table:
        assert self.file is not None  # given
        try:
            table = tables.read_table(Path(self.file), self.columns, wanted=("temperature",))
            for name in _COLUMNS:
                _ = table[name]
            refuse_decrease(table)
        except ValueError as error:
            raise ValueError(at_key(str(error))) from error
        return table

    def _from_sentences(self) -> TemperatureHistory:
        sentences = [sentence for entry in self.sentences or () for sentence in entry]
        try:
            return TemperatureHistory(*temperatures_of(sentences, self.start))
        except SentenceError as error:
            # A text has no entries, so the message names the key of the section.
            raise ValueError(f"{dotted(('sentences', error.entry - 1))}: {error}") from error
        except ValueError as error:
            raise ValueError(f"sentences: {error}") from error


class HarmonicTemperature(TemperatureSection):
    """A temperature mean + amplitude sin(2 pi t/period + phase), held after the last cycle."""

    kind: Literal["harmonic"]
    mean: Temperature = Field(description="mean temperature", examples=["15 degC"])
    amplitude: TemperatureDifference = Field(
        description="largest difference from the mean", examples=["10 K"]
    )
    period: Duration = Field(description="time of a cycle", examples=["24 h"])
    cycles: CycleCount = Field(description="number of cycles; then the temperature is held")
    phase: Angle = Field(default=0.0, description="at time 0")

    def build(self) -> TemperatureHistory:
        """Return the harmonic temperature."""
        return loads.HarmonicTemperature(
            self.mean, self.amplitude, self.period, self.cycles, self.phase
        )


_COLUMNS = ("time", "temperature")


def _history(key: str, times: list[float], temperatures: list[float]) -> TemperatureHistory:
    try:
        return TemperatureHistory(times, temperatures)
    except ValueError as error:
        raise ValueError(f"{key}: {error}") from error


def spelled_temperature(given: Any) -> Any:
    """Temperature in its longest spelling: a section with its kind."""
    if isinstance(given, dict):
        return given if "kind" in given else {"kind": HISTORY, **given}
    return {"kind": CONSTANT, "value": given} if isinstance(given, str) else given


class _OrQuantity:
    """Annotation that accepts a quantity in place of the section, and a section without kind."""

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        def read(given: Any, section: Callable[[Any], TemperatureSection]) -> TemperatureSection:
            if isinstance(given, TemperatureSection):
                return given
            if isinstance(given, list):
                raise PydanticCustomError(
                    "quantity", "is a list; write e.g. 'points: [[0 s, 23 degC], [2 h, 60 degC]]'"
                )
            if not isinstance(given, dict):
                _QUANTITY.read(given)  # refused at the key of the section
            return section(spelled_temperature(given))

        return core_schema.no_info_wrap_validator_function(read, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Return the JSON schema: a quantity, or a section, of which a history needs no kind."""
        quantity = _QUANTITY.__get_pydantic_json_schema__(schema, handler)
        sections = handler(schema)
        course = next(
            found
            for each in sections["oneOf"]
            if "points" in (found := handler.resolve_ref_schema(each))["properties"]
        )
        plain = {name: each for name, each in course["properties"].items() if name != "kind"}
        short = {
            "type": "object",
            "properties": plain,
            "additionalProperties": False,
            "x-shorthand": True,
        }
        return {"anyOf": [{**quantity, "x-shorthand": True}, short, sections]}


AnyTemperature = Annotated[
    Annotated[Constant | Course | HarmonicTemperature, ChosenBy("kind")], _OrQuantity()
]
