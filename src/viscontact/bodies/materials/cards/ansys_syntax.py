"""Syntax of Ansys APDL files: commands with fields, one per line."""

from __future__ import annotations

import re
from dataclasses import dataclass

from viscontact.bodies.materials.cards.numbers import card_number

_ASSIGNMENT = re.compile(r"(?P<name>[A-Za-z]\w{0,31})\s*=\s*(?P<value>[^,=]+)")


@dataclass(frozen=True)
class Command:
    """One command in capitals with its fields, parameters substituted; `where` is file and line."""

    where: str
    name: str
    fields: tuple[str, ...]

    def word(self, place: int) -> str:
        """Return a field, counted from 0, in capitals; empty if it is missing."""
        return self.fields[place].upper() if place < len(self.fields) else ""

    def number(self, place: int, default: float | None = None) -> float:
        """Return a field as a number; ValueError if it is not one, or empty without a default."""
        text = self.word(place)
        if not text and default is not None:
            return default
        return card_number(self.where, text)


def read_commands(source: str, text: str) -> list[Command]:
    """Split the text of an APDL file into commands; `source` is its name, for messages.

    Mechanical APDL Command Reference: an exclamation mark begins a comment, a dollar sign another
    command on the same line, fields are separated by commas, and case is ignored. Scalar
    parameters that are set to a number (``E0=1000``) are substituted where a field is their name;
    expressions are not evaluated.
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
                commands.append(Command(f"{source}:{number}", fields[0].upper(), known))
    return commands
