"""Material cards of finite-element programs: Abaqus and Ansys, read and written."""

from viscontact.cards.abaqus_reader import read_abaqus
from viscontact.cards.abaqus_writer import write_abaqus
from viscontact.cards.ansys_reader import read_ansys
from viscontact.cards.ansys_writer import write_ansys
from viscontact.cards.card import Card
from viscontact.cards.either import is_card, read_card, read_cards

__all__ = [
    "Card",
    "is_card",
    "read_abaqus",
    "read_ansys",
    "read_card",
    "read_cards",
    "write_abaqus",
    "write_ansys",
]
