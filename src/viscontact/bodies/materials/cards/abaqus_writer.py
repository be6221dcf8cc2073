"""Writer of Abaqus material cards."""

from __future__ import annotations

import re
from typing import Literal

from viscontact.bodies.laws import (
    WLF,
    Arrhenius,
    Shift,
    TabulatedCreep,
    TabulatedRelaxation,
)
from viscontact.bodies.laws.time_temperature import GAS_CONSTANT
from viscontact.bodies.materials.cards.card import Card, CardUnits, card_units, in_unit
from viscontact.bodies.materials.cards.numbers import card_digits
from viscontact.bodies.materials.cards.prony_terms import Moduli, constants, relative
from viscontact.bodies.materials.material import Material


def write_abaqus(
    card: Card,
    *,
    modulus_unit: str,
    time_unit: str,
    temperature_unit: str | None = None,
    moduli: Literal["instantaneous", "long term"] = "instantaneous",
) -> str:
    """Write a material as an Abaqus card.

    Parameters
    ----------
    card : Card
        The material. Its law must be a Prony series of some kind, or a table.
    modulus_unit, time_unit : str
        Of the model that the card is for, e.g. ``"MPa"`` and ``"s"``.
    temperature_unit : str, optional
        Needed if the card has a shift.
    moduli : {"instantaneous", "long term"}, optional
        Which elastic constants to write. The long-term ones of a law that relaxes almost
        wholly cost digits, and a fluid has none.

    Returns
    -------
    str
        ``*MATERIAL``, ``*ELASTIC``, ``*VISCOELASTIC`` (``TIME=PRONY``, or test data of a
        table) and ``*TRS``; above them ``*PHYSICAL CONSTANTS`` for an Arrhenius shift.

    Raises
    ------
    ValueError
        If the law or the shift cannot be written, with what to do.

    Notes
    -----
    A constant Poisson's ratio is written as k_i = g_i, an elastic bulk modulus as k_i = 0. Fields
    hold 20 characters, so that numbers keep 13 digits or more.

    Examples
    --------
    >>> from viscontact.bodies.laws import RelaxationSeries
    >>> rubber = Card("R", Material(RelaxationSeries(1e6, [1e6], [10.0]), 0.5))
    >>> print(write_abaqus(rubber, modulus_unit="MPa", time_unit="s"))
    ** moduli in MPa, times in s
    *MATERIAL, NAME=R
    *ELASTIC, MODULI=INSTANTANEOUS
    6.0, 0.5
    *VISCOELASTIC, TIME=PRONY
    0.5, 0.0, 10.0
    <BLANKLINE>
    """
    if moduli not in ("instantaneous", "long term"):
        raise ValueError(f"moduli: must be 'instantaneous' or 'long term', got {moduli!r}")
    units = card_units(modulus_unit, time_unit, temperature_unit)
    instantaneous = moduli == "instantaneous"
    law = card.material.law
    if isinstance(law, TabulatedCreep | TabulatedRelaxation):
        body = _test_data(card.material, law, units, instantaneous)
    else:
        body = _prony(card.material, units, instantaneous)
    lines = [f"** {_ascii(units.words)}", f"*MATERIAL, NAME={_label(card.name)}", *body]
    if card.shift is not None:
        lines += _shift(card.shift, units)
    if isinstance(card.shift, Arrhenius):
        lines.insert(1, _physical_constants(units))
    return "\n".join(lines) + "\n"


def _prony(material: Material, units: CardUnits, instantaneous: bool) -> list[str]:
    found = relative(material, instantaneous=instantaneous)
    shear, bulk = found.shear, found.bulk.weights or (0.0,) * len(found.shear.weights)
    if not shear.weights:
        return _elastic(found.moduli, units, word="")
    rows = zip(shear.weights, bulk, (t / units.time for t in shear.times), strict=True)
    return [
        *_elastic(found.moduli, units),
        "*VISCOELASTIC, TIME=PRONY",
        *(_line(*row) for row in rows),
    ]


def _elastic(moduli: Moduli, units: CardUnits, word: str | None = None) -> list[str]:
    if word is None:
        word = ", MODULI=" + ("INSTANTANEOUS" if moduli.instantaneous else "LONG TERM")
    return [f"*ELASTIC{word}", _line(moduli.youngs_modulus / units.modulus, moduli.poisson_ratio)]


def _test_data(
    material: Material,
    law: TabulatedCreep | TabulatedRelaxation,
    units: CardUnits,
    instantaneous: bool,
) -> list[str]:
    creep = isinstance(law, TabulatedCreep)
    values = law.compliance if isinstance(law, TabulatedCreep) else law.modulus
    if not instantaneous:
        raise ValueError("a table has no long-term modulus; write instantaneous ones")
    if not law(0.0) > 0:
        raise ValueError(
            "a card needs the instantaneous modulus, and this table has none; give it a row at "
            "0 s, or before='first'"
        )
    at_once = law.relaxation(0.0)
    start = 1 / (2 * at_once) if creep else at_once
    rows = [(v / start, t / units.time) for t, v in zip(law.times, values, strict=True) if t > 0]
    alike = material.poisson_ratio is not None and material.poisson_ratio != 0.5
    test = "COMBINED" if alike else "SHEAR"
    ends = f", SHRINF={card_digits(rows[-1][0])}" if law.beyond == "last" else ""
    return [
        *_elastic(constants(material, at_once, instantaneous=True), units),
        f"*VISCOELASTIC, TIME={'CREEP' if creep else 'RELAXATION'} TEST DATA",
        f"*{test} TEST DATA{ends}",
        *(_line(*([value] * (2 if alike else 1)), time) for value, time in rows),
    ]


def _shift(shift: Shift, units: CardUnits) -> list[str]:
    if not isinstance(shift, WLF | Arrhenius):
        raise ValueError(
            f"Abaqus cards take a WLF or Arrhenius shift, got {type(shift).__name__}; fit one with "
            "viscontact.identification.fit_wlf, or write the law slowed to one temperature"
        )
    scale = units.kelvins("the card's shift")
    reference = in_unit(shift.reference_temperature, scale)
    if isinstance(shift, Arrhenius):
        return ["*TRS, DEFINITION=ARRHENIUS", _line(reference, shift.activation_energy)]
    return ["*TRS, DEFINITION=WLF", _line(reference, shift.c1, shift.c2 / scale.factor)]


def _physical_constants(units: CardUnits) -> str:
    """Absolute zero and gas constant [J/mol] in the card's degrees, for a shift in J/mol."""
    scale = units.kelvins("the card's shift")
    return (
        f"*PHYSICAL CONSTANTS, ABSOLUTE ZERO={card_digits(in_unit(0.0, scale))}, "
        f"UNIVERSAL GAS={card_digits(GAS_CONSTANT * scale.factor)}"
    )


def _line(*numbers: float) -> str:
    return ", ".join(card_digits(number) for number in numbers)


def _label(name: str) -> str:
    """Return a name valid in Abaqus: 1 to 80 characters, in quotation marks where necessary."""
    if not 1 <= len(name) <= 80 or not re.fullmatch(r"[ -~]+", name) or '"' in name:
        raise ValueError(
            f"a material's name in Abaqus has 1 to 80 plain characters, no quotation marks, got "
            f"{name!r}"
        )
    return name if re.fullmatch(r"[A-Za-z][\w-]*", name) else f'"{name}"'


def _ascii(words: str) -> str:
    # Abaqus accepts only these characters in an input file.
    plain = words.replace("°", "deg").replace("µ", "u").replace("μ", "u")
    return plain.encode("ascii", "replace").decode()
