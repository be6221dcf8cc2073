"""Syntax of Ansys APDL files: commands with fields, one per line."""

from __future__ import annotations

import re

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.cards.numbers import card_number

_ASSIGNMENT = re.compile(r"(?P<name>[A-Za-z]\w{0,31})\s*=\s*(?P<value>[^,=]+)")
# Characters of a command and of a label that count.
_SIGNIFICANT = 4
#: Material number of a library file, which Ansys sets when it reads the file.
LIBRARY = "_MATL"


@dataclass(frozen=True)
class Command:
    """One command in capitals with its fields, parameters substituted; `where` is file and line.

    The name has its first four letters, which are those that count.
    """

    where: str
    name: str
    fields: tuple[str, ...]

    def word(self, place: int) -> str:
        """Return a field, counted from 0, in capitals; empty if it is missing."""
        return self.fields[place].upper() if place < len(self.fields) else ""

    def label(self, place: int) -> str:
        """Return the first four letters of a field, which are those that count."""
        return self.word(place)[:_SIGNIFICANT]

    def number(self, place: int, default: float | None = None) -> float:
        """Return a field as a number; ValueError if it is not one, or empty without a default."""
        text = self.word(place)
        if not text and default is not None:
            return default
        return card_number(self.where, text)

    def material(self, place: int) -> str:
        """Return the number of a material, or `LIBRARY`; ValueError for anything else."""
        if self.word(place) == LIBRARY:
            return LIBRARY
        number = self.number(place, default=1.0)
        if number != int(number) or number < 1:
            raise ValueError(f"{self.where}: a material's number is whole and positive")
        return str(int(number))


def read_commands(source: str, text: str) -> list[Command]:
    """Split the text of an APDL file into commands; `source` is its name, for messages.

    Mechanical APDL Command Reference: an exclamation mark begins a comment, a dollar sign another
    command on the same line, fields are separated by commas, case is ignored, and of a command the
    first four letters count. Scalar parameters that are set to a number (``E0=1000``) are
    substituted where a field is their name; expressions are not evaluated.
    """
    parameters: dict[str, str] = {}
    commands: list[Command] = []
    for number, line in enumerate(text.splitlines(), start=1):
        for part in line.partition("!")[0].split("$"):
            content = part.strip()
            assignment = _ASSIGNMENT.fullmatch(content)
            if assignment:
                parameters[assignment["name"].upper()] = assignment["value"].strip()
            elif content:
                fields = [field.strip() for field in content.split(",")]
                known = tuple(parameters.get(field.upper(), field) for field in fields[1:])
                name = fields[0].upper()[:_SIGNIFICANT]
                commands.append(Command(f"{source}:{number}", name, known))
    return commands
