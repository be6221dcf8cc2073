"""Material cards of finite-element programs (Abaqus, Ansys): readers and writers."""

from viscontact.bodies.materials.cards.abaqus_reader import read_abaqus
from viscontact.bodies.materials.cards.abaqus_writer import write_abaqus
from viscontact.bodies.materials.cards.ansys_reader import read_ansys
from viscontact.bodies.materials.cards.ansys_writer import write_ansys
from viscontact.bodies.materials.cards.card import Card
from viscontact.bodies.materials.cards.reader import is_card, read_card, read_cards

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
