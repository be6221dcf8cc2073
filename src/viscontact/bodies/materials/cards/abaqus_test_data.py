"""Normalised creep and relaxation test data in Abaqus cards."""

from __future__ import annotations

import math
import re
from typing import Literal

from viscontact.bodies.laws import TabulatedCreep, TabulatedRelaxation
from viscontact.bodies.materials.cards.abaqus_syntax import Block, DataLine
from viscontact.bodies.materials.cards.card import CardUnits
from viscontact.bodies.materials.cards.prony_terms import Moduli, with_volume
from viscontact.bodies.materials.material import Material

# Relative difference of two equal values written with a card's digits.
_ROUNDING = 1e-9


def tested_material(
    block: Block,
    tests: list[Block],
    creep: bool,
    moduli: Moduli,
    units: CardUnits,
    notes: list[str],
) -> Material:
    """Return the material of a card with test data in shear and volume, as a table law.

    The law is G_0 g_R(t) as modulus [Pa], or j_S(t)/(2 G_0) as creep compliance [1/Pa]; both
    normalised functions start at 1. Abaqus fits a Prony series, here they are not fitted; data not
    used are added to `notes`. ValueError if shear data are missing, or the bulk modulus relaxes
    differently. Abaqus 2016 Keywords Reference Guide, ``*SHEAR TEST DATA``, ``*COMBINED TEST
    DATA``: lines of j_S or g_R and t > 0, with the long-term value in SHRINF.
    """
    by_name = {test.keyword: test for test in tests}
    source = by_name.get("COMBINED TEST DATA", by_name.get("SHEAR TEST DATA"))
    if source is None:
        raise ValueError(f"{block.where}: *SHEAR TEST DATA is missing below *VISCOELASTIC")
    combined = source.keyword == "COMBINED TEST DATA"
    rows = [line.numbers(*((3, 3) if combined else (2, 2))) for line in source.data]
    shear = [(row[0], row[-1]) for row in rows]
    bulk = [(row[1], row[-1]) for row in rows] if combined else _volumetric(by_name)
    infinite = _infinite(source)
    at_once = moduli.at_once(_final_modulus(source, infinite, creep, moduli))
    law = _law(source, shear, creep, at_once, units, infinite, notes)
    return with_volume(law, moduli, relaxes=any(b != 1 for b, _ in bulk), alike=bulk == shear)


def _volumetric(by_name: dict[str, Block]) -> list[tuple[float, float]]:
    block = by_name.get("VOLUMETRIC TEST DATA")
    rows = [] if block is None else [line.numbers(2, 2) for line in block.data]
    return [(value, time) for value, time in rows]


def _infinite(block: Block) -> float | None:
    given = block.parameters.get("SHRINF")
    if given is None:
        return None
    [value] = DataLine(f"{block.where}: SHRINF", (given,)).numbers(1, 1)
    if not value > 0:
        raise ValueError(f"{block.where}: SHRINF must be positive, got {value!r}")
    return value


def _final_modulus(block: Block, infinite: float | None, creep: bool, moduli: Moduli) -> float:
    """Return g_R at infinite time; 1 where it is not needed."""
    if moduli.instantaneous:
        return 1.0
    if infinite is None:
        raise ValueError(
            f"{block.where}: the elastic constants are long-term ones, and the data do not say "
            "what is left in the long term; give SHRINF=, or MODULI=INSTANTANEOUS in *ELASTIC"
        )
    return 1.0 / infinite if creep else infinite


def _law(
    block: Block,
    shear: list[tuple[float, float]],
    creep: bool,
    at_once: float,
    units: CardUnits,
    infinite: float | None,
    notes: list[str],
) -> TabulatedCreep | TabulatedRelaxation:
    # Normalised functions start at 1.
    relative = [1.0, *(value for value, _ in shear)]
    times = [0.0, *(time * units.time for _, time in shear)]
    ends = infinite is not None and math.isclose(infinite, relative[-1], rel_tol=_ROUNDING)
    if infinite is not None and not ends:
        notes.append(f"{block.where}: SHRINF is not used beyond the last of the test data")
    beyond: Literal["last", "slope"] = "last" if ends else "slope"
    try:
        if creep:
            values = [value / (2 * at_once) for value in relative]
            return TabulatedCreep(times, values, beyond=beyond)
        values = [value * at_once for value in relative]
        return TabulatedRelaxation(times, values, beyond=beyond)
    except ValueError as error:
        lines = [f"1 at time 0 ({block.where})", *(line.where for line in block.data)]
        raise ValueError(
            f"{block.where}: "
            + re.sub(r"\brow (\d+)", lambda match: lines[int(match[1])], str(error))
        ) from None
