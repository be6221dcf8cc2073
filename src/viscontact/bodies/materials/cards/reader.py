"""Reader of cards of any program, which is recognised by the content of the file."""

from __future__ import annotations

import re
from os import PathLike
from pathlib import Path
from typing import Protocol

from viscontact.bodies.materials.cards.abaqus_reader import read_abaqus
from viscontact.bodies.materials.cards.ansys_reader import read_ansys
from viscontact.bodies.materials.cards.card import Card
from viscontact.bodies.materials.cards.dyna_reader import read_ls_dyna
from viscontact.bodies.materials.cards.other_programs import program_of
from viscontact.tables import read_text


class _Reader(Protocol):
    def __call__(
        self,
        path: str | PathLike[str],
        *,
        modulus_unit: str,
        time_unit: str,
        temperature_unit: str | None = None,
        name: str | None = None,
    ) -> tuple[Card, ...]: ...


#: Programs that are read, and the commands that only their files have.
_READERS: dict[str, tuple[re.Pattern[str], _Reader]] = {
    "Abaqus (*ELASTIC, *VISCOELASTIC)": (
        re.compile(r"^[ \t]*\*[ \t]*(?:mate|elas|visco[ \t]*e)[ \ta-z]*(?:,|$)", re.I | re.M),
        read_abaqus,
    ),
    "Ansys (MP,EX and TB,PRONY)": (
        re.compile(r"^[ \t]*(?:tb|mp|tbda\w*|mpda\w*)[ \t]*,", re.I | re.M),
        read_ansys,
    ),
    "LS-DYNA (*MAT_...)": (re.compile(r"^\*(?:mat_|keyword\b)", re.I | re.M), read_ls_dyna),
}


def is_card(text: str) -> bool:
    """Return whether a text is a card, or an input file of another program that is not read.

    Parameters
    ----------
    text : str
        Content of a file.

    Examples
    --------
    >>> is_card("MP,EX,1,6.0"), is_card("time [s], E [MPa]")
    (True, False)
    """
    return bool(_programs(text)) or program_of(text) is not None


def unread_program(text: str, source: str) -> str | None:
    """Return why the text of a file is not read, if it is one of another program."""
    other = None if _programs(text) else program_of(text)
    return None if other is None else other.refusal(source)


def _programs(text: str) -> list[str]:
    """Programs whose commands a text has."""
    return [program for program, (pattern, _) in _READERS.items() if pattern.search(text)]


def read_cards(
    path: str | PathLike[str],
    *,
    modulus_unit: str,
    time_unit: str,
    temperature_unit: str | None = None,
    name: str | None = None,
) -> tuple[Card, ...]:
    """Read the materials of an Abaqus, Ansys or LS-DYNA file.

    Parameters
    ----------
    path : path-like
        The file.
    modulus_unit, time_unit, temperature_unit, name
        As in `read_abaqus`, `read_ansys` and `read_ls_dyna`.

    Returns
    -------
    tuple of Card
        In the file's order.

    Raises
    ------
    ValueError
        If it is none of these, or of several, or what is in it cannot be read.
    """
    text, source = read_text(Path(path)), Path(path).name
    programs = _programs(text)
    other = unread_program(text, source)
    if other is not None:
        raise ValueError(other)
    if len(programs) != 1:
        known = ", ".join(_READERS)
        also = f", but has commands of {' and of '.join(programs)}" if programs else ""
        raise ValueError(f"{source}: is no card of a program that is read: {known}{also}")
    _, read = _READERS[programs[0]]
    return read(
        path,
        modulus_unit=modulus_unit,
        time_unit=time_unit,
        temperature_unit=temperature_unit,
        name=name,
    )


def read_card(
    path: str | PathLike[str],
    *,
    modulus_unit: str,
    time_unit: str,
    temperature_unit: str | None = None,
    name: str | None = None,
) -> Card:
    """Read the one material of a card of any program, or the one that is named.

    Parameters
    ----------
    path : path-like
        The file.
    modulus_unit, time_unit, temperature_unit, name
        As in `read_cards`.

    Returns
    -------
    Card
        The material.

    Raises
    ------
    ValueError
        If there are several and none is named, or it cannot be read.
    """
    cards = read_cards(
        path,
        modulus_unit=modulus_unit,
        time_unit=time_unit,
        temperature_unit=temperature_unit,
        name=name,
    )
    if len(cards) > 1:
        found = ", ".join(repr(card.name) for card in cards)
        raise ValueError(f"{Path(path).name}: has several materials; name one of {found}")
    return cards[0]
