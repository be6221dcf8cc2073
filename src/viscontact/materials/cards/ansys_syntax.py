"""The syntax of Ansys APDL: commands of fields, a line each."""

from __future__ import annotations

import re
from dataclasses import dataclass

from viscontact.materials.cards.numbers import card_number

_ASSIGNMENT = re.compile(r"(?P<name>[A-Za-z]\w{0,31})\s*=\s*(?P<value>[^,=]+)")


@dataclass(frozen=True)
class Command:
    """One command.

    Parameters
    ----------
    where : str
        File and line, for messages.
    name : str
        In capitals, as ``TBDATA``.
    fields : tuple of str
        What follows it, parameters put in.
    """

    where: str
    name: str
    fields: tuple[str, ...]

    def word(self, place: int) -> str:
        """Return a field from 0, in capitals; empty if it is not there."""
        return self.fields[place].upper() if place < len(self.fields) else ""

    def number(self, place: int, default: float | None = None) -> float:
        """Return a field as a number; ValueError if it is none, or empty without a default."""
        text = self.word(place)
        if not text and default is not None:
            return default
        return card_number(self.where, text)


def read_commands(source: str, text: str) -> list[Command]:
    r"""Split an APDL file into commands.

    Parameters
    ----------
    source : str
        Name of the file, for messages.
    text : str
        Its text.

    Returns
    -------
    list of Command
        In the file's order.

    Notes
    -----
    Mechanical APDL Command Reference: an exclamation mark begins a comment, a dollar sign
    another command on the same line, fields are separated by commas, and case does not matter.
    Scalar parameters that are set to a number (``E0=1000``) are put in where they stand alone in
    a field; nothing is computed.

    Examples
    --------
    >>> [command] = read_commands("p.mac", "E0=3e3 ! modulus\nmp,ex,1,e0 $")
    >>> command.name, command.fields
    ('MP', ('ex', '1', '3e3'))
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
