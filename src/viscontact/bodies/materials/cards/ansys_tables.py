"""Data of an Ansys model by material number.

What cannot be read is a refusal of its material, so that others of the file can be read.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import field

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.cards import time_dependence
from viscontact.bodies.materials.cards.ansys_syntax import Command

#: Data tables that are read, by the letters that count.
_LABELS = ("PRON", "SHIF", "ELAS")
_MOST_VALUES = 1000
_PROPERTIES = ("EX", "PRXY", "NUXY")
# The first field of MPDATA and MPTEMP as CDWRITE and MPWRITE write them; a count and the label
# follow.
_CODED = "R5.0"
# Commands that read other files.
_ELSEWHERE = ("/INP", "*USE", "CDRE", "MPRE")


@dataclass
class DataTable:
    """One ``TB`` table: its command and its values by place, from 1."""

    command: Command
    values: dict[int, float] = field(default_factory=dict)
    temperatures: int = 0

    @property
    def option(self) -> str:
        """TBOPT by the letters that count, such as ``SHEA`` or ``WLF``."""
        return self.command.label(4)

    def row(self, count: int) -> list[float]:
        """Return the first values, 0 where none is given; ValueError if there are more."""
        if any(value for place, value in self.values.items() if place > count):
            raise ValueError(
                f"{self.command.where}: TB,{self.command.word(0)} has more than {count} values"
            )
        return [self.values.get(place, 0.0) for place in range(1, count + 1)]

    def put(self, command: Command) -> None:
        """Add the values of a TBDATA."""
        if self.temperatures > 1:
            raise ValueError(
                f"{command.where}: values at several temperatures are not read; keep one TBTEMP"
            )
        # Without a place they follow the last value.
        place = command.number(0, default=max(self.values, default=0) + 1)
        if place not in range(1, _MOST_VALUES + 1):
            raise ValueError(
                f"{command.where}: TBDATA begins at a place from 1 to {_MOST_VALUES}, got {place:g}"
            )
        for number in range(1, len(command.fields)):
            if command.word(number):
                self.values[int(place) + number - 1] = command.number(number)


@dataclass
class Numbered:
    """Data of one material number."""

    where: str
    properties: dict[str, tuple[str, float]] = field(default_factory=dict)
    tables: dict[str, DataTable] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    refusals: list[str] = field(default_factory=list)


def collect(commands: list[Command]) -> dict[str, Numbered]:
    """Sort commands by material number in order of mention; ValueError for no such number."""
    model = _Model()
    for command in commands:
        act = model.acts.get(command.name)
        if act is not None:
            act(command)
    for material in model.found.values():
        material.notes.extend(model.other_files)
    return model.found


class _Model:
    """The materials while the commands are carried out, one after the other."""

    def __init__(self) -> None:
        self.found: dict[str, Numbered] = {}
        self._material: Numbered | None = None  # of the table that is filled
        self._table: DataTable | None = None
        self.acts: dict[str, Callable[[Command], None]] = {
            "MP": self._property,
            "MPDA": self._property_data,
            "MPDE": self._delete_properties,
            "TB": self._open_table,
            "TBCO": self._copy_tables,
            "TBDA": self._values,
            "TBDE": self._delete_tables,
            "TBFI": self._field,
            "TBMO": self._unread_points,
            "TBPT": self._unread_points,
            "TBTE": self._temperature,
            **dict.fromkeys(_ELSEWHERE, self._other_file),
        }
        self.other_files: list[str] = []

    def _of(self, command: Command, place: int) -> Numbered:
        return self.found.setdefault(command.material(place), Numbered(command.where))

    def _property(self, command: Command) -> None:
        if command.word(0) == _CODED:  # MP,R5.0,DENS,1,...: as MPDATA, without a count
            command = Command(command.where, command.name, command.fields[1:])
        material = self._of(command, 1)
        label = _property_label(command, 0)
        if not _is_read(material, command, f"MP,{label}", label):
            return
        with _refusals_of(material):
            if any(command.number(place, default=0.0) for place in range(3, len(command.fields))):
                raise ValueError(
                    f"{command.where}: MP,{label} depends on temperature, which is not read; keep "
                    "C0"
                )
            material.properties[label] = (command.where, command.number(2))

    def _property_data(self, command: Command) -> None:
        # MPDATA,Lab,MAT,STLOC,C1,... or, written by a program, MPDATA,R5.0,count,Lab,MAT,STLOC,...
        first = 2 if command.word(0) == _CODED else 0
        material = self._of(command, first + 1)
        label = _property_label(command, first)
        if not _is_read(material, command, f"MPDATA,{label}", label):
            return
        with _refusals_of(material):
            places = range(first + 3, len(command.fields))
            values = {command.number(place) for place in places if command.word(place)}
            before = material.properties.get(label)
            if command.number(first + 2, default=1.0) != 1 and before is not None:
                values.add(before[1])  # values at further temperatures
            if len(values) != 1:
                why = "depends on temperature, which is not read" if values else "has no value"
                raise ValueError(
                    f"{command.where}: MPDATA,{label} {why}; give a constant with MP,{label}"
                )
            material.properties[label] = (command.where, values.pop())

    def _delete_properties(self, command: Command) -> None:
        for material in self._deleted_from(command):
            for label in list(material.properties):
                if command.word(0) in ("ALL", label):
                    del material.properties[label]

    def _delete_tables(self, command: Command) -> None:
        for material in self._deleted_from(command):
            for key in list(material.tables):
                if command.label(0) in ("ALL", key.split()[0]):
                    del material.tables[key]

    def _deleted_from(self, command: Command) -> list[Numbered]:
        """Materials of a deletion that are already mentioned."""
        if command.word(1) == "ALL":
            return list(self.found.values())
        number = command.material(1)
        return [self.found[number]] if number in self.found else []

    def _open_table(self, command: Command) -> None:
        material, label = self._of(command, 1), command.label(0)
        self._material, self._table = material, DataTable(command)
        options = time_dependence.ANSYS_OPTIONS.get(label, ())
        written = f"TB,{command.word(0)}" + (
            f",,,,{command.word(4)}" if options or label == "PRON" else ""
        )
        if label in time_dependence.ANSYS_TABLES:
            what = time_dependence.ANSYS_TABLES[label]
            material.refusals.append(time_dependence.refusal(command.where, written, what))
        elif command.label(4) in options or (
            label not in _LABELS and time_dependence.states_time(command.word(0))
        ):
            material.refusals.append(time_dependence.refusal(command.where, written))
        elif label not in _LABELS or (label, command.label(4)) == ("PRON", "INTE"):
            material.notes.append(f"{command.where}: {written} is not used")
        else:
            key = f"{label} {command.label(4)}" if label == "PRON" else label
            if key in material.tables:
                material.refusals.append(f"{command.where}: {written} occurs twice")
            material.tables[key] = self._table

    def _copy_tables(self, command: Command) -> None:
        material = self._of(command, 2)
        material.refusals.append(
            f"{command.where}: TBCOPY is not read; write the tables of the material out"
        )

    def _other_file(self, command: Command) -> None:
        self.other_files.append(
            f"{command.where}: the file that {command.name} names is not read with this one"
        )

    def _values(self, command: Command) -> None:
        if self._table is not None and self._material is not None and self._is_used:
            with _refusals_of(self._material):
                self._table.put(command)

    def _temperature(self, _command: Command) -> None:
        if self._table is not None:
            self._table.temperatures += 1

    def _field(self, command: Command) -> None:
        """Take a temperature; any other field variable is refused."""
        if command.label(0) == "TEMP":
            self._temperature(command)
        elif self._material is not None and self._is_used:
            self._material.refusals.append(
                f"{command.where}: TBFIELD,{command.word(0)} is not read: constants that depend on "
                "it; keep those of one value, without TBFIELD"
            )

    def _unread_points(self, command: Command) -> None:
        if self._material is not None and self._is_used:
            self._material.refusals.append(
                f"{command.where}: points (TBPT) are not read in a table of constants; give TBDATA"
            )

    @property
    def _is_used(self) -> bool:
        """True if the table that is filled is read."""
        return self._material is not None and any(
            table is self._table for table in self._material.tables.values()
        )


@contextmanager
def _refusals_of(material: Numbered) -> Iterator[None]:
    """Context in which a ValueError becomes a refusal of a material."""
    try:
        yield
    except ValueError as error:
        material.refusals.append(str(error))


def _property_label(command: Command, place: int) -> str:
    label = command.word(place)
    # Those that are read or refused have up to four letters.
    known = (*_PROPERTIES, *time_dependence.ANSYS_PROPERTIES)
    return label[:4] if label[:4] in known else label


def _is_read(material: Numbered, command: Command, written: str, label: str) -> bool:
    """Return whether a property is read; otherwise it is noted, or refused."""
    if label in time_dependence.ANSYS_PROPERTIES:
        what = time_dependence.ANSYS_PROPERTIES[label]
        material.refusals.append(time_dependence.refusal(command.where, written, what))
    elif label not in _PROPERTIES:
        material.notes.append(f"{command.where}: {written} is not used")
    return label in _PROPERTIES
