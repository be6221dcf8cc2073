"""Material cards of finite-element programs (Abaqus, Ansys): readers and writers."""

from viscontact.materials.cards.abaqus_reader import read_abaqus
from viscontact.materials.cards.abaqus_writer import write_abaqus
from viscontact.materials.cards.ansys_reader import read_ansys
from viscontact.materials.cards.ansys_writer import write_ansys
from viscontact.materials.cards.card import Card
from viscontact.materials.cards.reader import is_card, read_card, read_cards

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
