"""Syntax and numbers of material cards."""

from __future__ import annotations

from viscontact.bodies.materials.cards.abaqus_syntax import read_blocks
from viscontact.bodies.materials.cards.ansys_syntax import read_commands
from viscontact.bodies.materials.cards.card import card_units, in_unit
from viscontact.bodies.materials.cards.numbers import card_digits, card_number
from viscontact.bodies.materials.cards.prony_terms import Moduli, Terms, relaxing_material
from viscontact.laws import RelaxationSeries
from viscontact.units.parsing import UnitScale


def test_keyword_of_abaqus_has_parameters_and_data_without_comments():
    [block] = read_blocks("p.inp", "*Elastic, moduli=INSTANTANEOUS\n** why\n 3e3, .5\n")
    assert (block.keyword, block.parameters) == ("ELASTIC", {"MODULI": "INSTANTANEOUS"})
    assert block.data[0].fields == ("3e3", ".5")


def test_parameters_of_ansys_are_substituted():
    [command] = read_commands("p.mac", "E0=3e3 ! modulus\nmp,ex,1,e0 $")
    assert (command.name, command.fields) == ("MP", ("ex", "1", "3e3"))


def test_units_of_a_card_are_factors_to_si():
    assert card_units("MPa", "ms", None).time == 0.001
    assert in_unit(298.15, UnitScale(1.0, 273.15)) == 25.0


def test_numbers_of_cards_keep_their_digits():
    assert card_number("card:1", "1.5D-3") == 0.0015
    assert card_digits(0.1) == "0.1"
    assert card_digits(1.2345678901234567e-05) == "1.23456789012346e-05"


def test_terms_of_a_card_are_parts_of_the_instantaneous_modulus():
    moduli = Moduli("card", 3e6, 0.5, instantaneous=True)
    law = relaxing_material(moduli, Terms((0.25,), (10.0,)), Terms()).law
    assert law == RelaxationSeries(750000.0, (250000.0,), (10.0,))
