"""Material cards of finite-element programs (Abaqus, Ansys, LS-DYNA): readers and writers."""

from viscontact.bodies.materials.cards.abaqus_reader import read_abaqus
from viscontact.bodies.materials.cards.abaqus_writer import write_abaqus
from viscontact.bodies.materials.cards.ansys_reader import read_ansys
from viscontact.bodies.materials.cards.ansys_writer import write_ansys
from viscontact.bodies.materials.cards.card import Card
from viscontact.bodies.materials.cards.dyna_reader import read_ls_dyna
from viscontact.bodies.materials.cards.reader import (
    is_card,
    read_card,
    read_cards,
    unread_program,
)

__all__ = [
    "Card",
    "is_card",
    "read_abaqus",
    "read_ansys",
    "read_card",
    "read_cards",
    "read_ls_dyna",
    "unread_program",
    "write_abaqus",
    "write_ansys",
]
