"""Data of an Ansys model by material number."""

from __future__ import annotations

from dataclasses import dataclass, field

from viscontact.bodies.materials.cards.ansys_syntax import Command

#: Data tables that are read.
_LABELS = ("PRONY", "SHIFT", "ELASTIC")
_MOST_VALUES = 1000
_PROPERTIES = ("EX", "PRXY", "NUXY")


@dataclass
class DataTable:
    """One ``TB`` table: its command and its values by place, from 1."""

    command: Command
    values: dict[int, float] = field(default_factory=dict)
    temperatures: int = 0

    @property
    def option(self) -> str:
        """TBOPT, such as ``SHEAR`` or ``WLF``."""
        return self.command.word(4)

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


def collect(commands: list[Command]) -> dict[int, Numbered]:
    """Sort commands by material number in order of mention; ValueError for what is not read."""
    found: dict[int, Numbered] = {}
    table: DataTable | None = None
    for command in commands:
        if command.name == "MP":
            _property(found, command)
        elif command.name == "TB":
            table = _table(found, command)
        elif command.name == "TBTEMP" and table is not None:
            table.temperatures += 1
        elif command.name == "TBDATA":
            if table is not None:
                table.put(command)
        elif command.name in ("MPDATA", "MPTEMP", "TBPT", "TBFIELD"):
            table = None
            if command.name == "MPDATA" and command.word(0) in _PROPERTIES:
                raise ValueError(
                    f"{command.where}: MPDATA is not read; give constants with MP,{command.word(0)}"
                )
    return found


def _tables_of(found: dict[int, Numbered], command: Command) -> Numbered:
    number = command.number(1, default=1.0)
    if number != int(number) or number < 1:
        raise ValueError(f"{command.where}: a material's number is whole and positive")
    return found.setdefault(int(number), Numbered(command.where))


def _property(found: dict[int, Numbered], command: Command) -> None:
    label, material = command.word(0), _tables_of(found, command)
    if label not in _PROPERTIES:
        material.notes.append(f"{command.where}: MP,{label} is not used")
        return
    if any(command.number(place, default=0.0) for place in range(3, len(command.fields))):
        raise ValueError(
            f"{command.where}: MP,{label} depends on temperature, which is not read; keep C0"
        )
    material.properties[label] = (command.where, command.number(2))


def _table(found: dict[int, Numbered], command: Command) -> DataTable | None:
    label, material = command.word(0), _tables_of(found, command)
    if label not in _LABELS:
        material.notes.append(f"{command.where}: TB,{label} is not used")
        return DataTable(command)  # filled, and forgotten
    key = f"{label} {command.word(4)}" if label == "PRONY" else label
    if key in material.tables:
        raise ValueError(f"{command.where}: TB,{key.replace(' ', ',,,,')} occurs twice")
    material.tables[key] = DataTable(command)
    return material.tables[key]
