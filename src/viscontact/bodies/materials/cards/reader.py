"""Reader of Abaqus and Ansys cards, distinguished by their content."""

from __future__ import annotations

import re
from os import PathLike
from pathlib import Path

from viscontact.bodies.materials.cards.abaqus_reader import read_abaqus
from viscontact.bodies.materials.cards.ansys_reader import read_ansys
from viscontact.bodies.materials.cards.card import Card
from viscontact.tables import read_text

_ABAQUS = re.compile(r"^[ \t]*\*[ \t]*(?:material|elastic|viscoelastic)\b", re.I | re.M)
_ANSYS = re.compile(r"^[ \t]*(?:tb|mp)[ \t]*,", re.I | re.M)


def is_card(text: str) -> bool:
    """Return whether a text has the commands of an Abaqus or Ansys card.

    Parameters
    ----------
    text : str
        Content of a file.

    Examples
    --------
    >>> is_card("MP,EX,1,6.0"), is_card("time [s], E [MPa]")
    (True, False)
    """
    return any(pattern.search(text) for pattern in (_ABAQUS, _ANSYS))


def read_cards(
    path: str | PathLike[str],
    *,
    modulus_unit: str,
    time_unit: str,
    temperature_unit: str | None = None,
    name: str | None = None,
) -> tuple[Card, ...]:
    """Read the materials of an Abaqus or Ansys file.

    Parameters
    ----------
    path : path-like
        The file.
    modulus_unit, time_unit, temperature_unit, name
        As in `read_abaqus` and `read_ansys`.

    Returns
    -------
    tuple of Card
        In the file's order.

    Raises
    ------
    ValueError
        If it is neither, or both, or what is in it cannot be read.
    """
    text = read_text(Path(path))
    found = [bool(pattern.search(text)) for pattern in (_ABAQUS, _ANSYS)]
    if sum(found) != 1:
        raise ValueError(
            f"{Path(path).name}: is no Abaqus card (*ELASTIC, *VISCOELASTIC) and no Ansys card "
            "(MP,EX and TB,PRONY)" + (", but has commands of both" if all(found) else "")
        )
    read = read_abaqus if found[0] else read_ansys
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
    """Read the one material of an Abaqus or Ansys file, or the one that is named.

    Parameters
    ----------
    path : path-like
        The file.
    modulus_unit, time_unit, temperature_unit, name
        As in `read_abaqus` and `read_ansys`.

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
