from .abaqus_reader import read_abaqus
from .abaqus_writer import write_abaqus
from .ansys_reader import read_ansys
from .ansys_writer import write_ansys
from .card import Card
from .dyna_reader import read_ls_dyna
from .reader import (
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
