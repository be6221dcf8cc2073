"""Reader of Abaqus material cards."""

from __future__ import annotations

import math
from dataclasses import field
from os import PathLike
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import WLF, Arrhenius, Shift
from viscontact.bodies.laws.time_temperature import GAS_CONSTANT
from viscontact.bodies.materials.cards import time_dependence
from viscontact.bodies.materials.cards.abaqus_keywords import (
    BEYOND,
    NOTED,
    READ,
    TEST_DATA,
    meanings,
)
from viscontact.bodies.materials.cards.abaqus_syntax import Block, DataLine, read_blocks
from viscontact.bodies.materials.cards.abaqus_viscoelastic import over_frequency, relaxation_of
from viscontact.bodies.materials.cards.card import Card, CardUnits, card_units
from viscontact.bodies.materials.cards.prony_terms import Moduli
from viscontact.bodies.materials.cards.record import NoRelaxation, Record, Relaxation
from viscontact.tables import read_text

# Activation energies of polymers and glasses [J/mol].
_USUAL_ENERGIES = (1e3, 2e6)


@dataclass
class _Section:
    """Blocks of one material, while they are collected."""

    name: str
    where: str
    blocks: dict[str, Block] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    refusals: list[str] = field(default_factory=list)


def read_abaqus(
    path: str | PathLike[str],
    *,
    modulus_unit: str,
    time_unit: str,
    temperature_unit: str | None = None,
    name: str | None = None,
) -> tuple[Card, ...]:
    r"""Read the materials of an Abaqus input file.

    Parameters
    ----------
    path : path-like
        The file; a whole model, or a card alone.
    modulus_unit, time_unit : str
        Units of its numbers, e.g. ``"MPa"`` and ``"s"``: Abaqus has no units.
    temperature_unit : str, optional
        Needed if it has ``*TRS``, e.g. ``"degC"``.
    name : str, optional
        Read this material only.

    Returns
    -------
    tuple of Card
        In the file's order.

    Raises
    ------
    ValueError
        If there is no such material, or it holds what cannot be read: with file and line.

    Notes
    -----
    ``*ELASTIC`` (E, ν; isotropic, one temperature), which is of the long term unless
    ``MODULI=INSTANTANEOUS``; ``*VISCOELASTIC`` with ``TIME=`` or ``FREQUENCY=PRONY`` (lines of
    g_i, k_i, τ_i); ``CREEP TEST DATA`` or ``RELAXATION TEST DATA``, which are used as measured;
    ``FREQUENCY=TABULAR`` or ``TIME=FREQUENCY DATA``, to which a series is fitted;
    ``FREQUENCY=FORMULA`` where it is a law in time, a spring beside a spring-pot; ``*TRS`` with
    ``DEFINITION=WLF`` or ``ARRHENIUS``, whose energy is in J/mol unless ``*PHYSICAL CONSTANTS``
    states the ``UNIVERSAL GAS`` constant. A material with another keyword that states a dependence
    on time or rate, such as ``*CREEP``, is refused; other keywords are noted. Keywords and
    parameters may be abbreviated. Abaqus 2016 Keywords Reference Guide under these names, Analysis
    User's Guide, section 22.7.1, "Time domain viscoelasticity":
    g_R(t) = 1 - sum g_i (1 - exp(-t/τ_i)), G(t) = G_0 g_R(t), and k_i likewise for the bulk
    modulus: k_i = 0 is an elastic bulk modulus, k_i = g_i a constant Poisson's ratio; section
    22.7.2, "Frequency domain viscoelasticity": lines of ω Re g* = G''/G_inf,
    ω Im g* = 1 - G'/G_inf, the same of the bulk modulus, and f in cycles per time.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp(), "rubber.inp")
    >>> lines = ["*Material, name=R", "*Elastic", "3., 0.5", "*Viscoelastic, time=PRONY"]
    >>> _ = file.write_text("\n".join([*lines, "0.5, 0., 10.", ""]))
    >>> [card] = read_abaqus(file, modulus_unit="MPa", time_unit="s")
    >>> card.name, card.material.law
    ('R', RelaxationSeries(equilibrium=1000000.0, moduli=(1000000.0,), times=(10.0,)))
    """
    path = Path(path)
    units = card_units(modulus_unit, time_unit, temperature_unit)
    blocks = read_blocks(path.name, read_text(path))
    sections = _sections(blocks)
    if name is not None:
        chosen = [s for s in sections if s.name.upper() == name.upper()]
        if not chosen:
            found = ", ".join(repr(s.name) for s in sections)
            raise ValueError(f"{path.name}: has no material {name!r}; there are {found or 'none'}")
        sections = chosen
    if not sections:
        raise ValueError(
            f"{path.name}: has no *ELASTIC and no *VISCOELASTIC; is it an Abaqus input file?"
        )
    constants = [block for block in blocks if block.keyword == "PHYSICAL CONSTANTS"]
    return tuple(_record(section, units, constants).card for section in sections)


def _sections(blocks: list[Block]) -> list[_Section]:
    sections: list[_Section] = []
    current: _Section | None = None
    # In a model, contacts, gaskets and steps have some of the same keywords.
    alone = not any(block.keyword == "MATERIAL" for block in blocks)
    for block in blocks:
        if block.keyword == "MATERIAL":
            current = _Section(block.given("NAME") or "", block.where)
            sections.append(current)
        elif block.keyword in BEYOND:
            current = None
        elif current is not None:
            _collect(current, block)
        elif block.keyword in READ or (alone and block.keyword in time_dependence.ABAQUS):
            # A card without *MATERIAL.
            current = _Section("", block.where)
            sections.append(current)
            _collect(current, block)
    return sections


def _collect(section: _Section, block: Block) -> None:
    """Sort a block of a material: read, refused or noted."""
    keyword = block.keyword
    why = _why_refused(block)
    if why is not None:
        section.refusals.append(why)
    elif keyword not in READ:
        if keyword != "PHYSICAL CONSTANTS":
            section.notes.append(f"{block.where}: *{keyword} is not used")
    elif keyword in section.blocks:
        section.refusals.append(
            f"{block.where}: *{keyword} occurs twice in material {section.name!r}"
        )
    else:
        section.blocks[keyword] = block


def _why_refused(block: Block) -> str | None:
    """Return why a material with this block is refused; None if it is not."""
    keyword = block.keyword
    if keyword in time_dependence.ABAQUS:
        what = time_dependence.ABAQUS[keyword]
        return time_dependence.refusal(block.where, f"*{keyword}", what)
    for parameter in time_dependence.ABAQUS_PARAMETERS.get(keyword, ()):
        if block.given(parameter) is not None:
            return time_dependence.refusal(
                block.where, f"*{keyword}, {parameter}", "rate-dependent plasticity"
            )
    if keyword == "INCLUDE":
        return (
            f"{block.where}: *INCLUDE is not followed, and may hold more of the material; put its "
            "lines in its place"
        )
    if keyword in NOTED or keyword in READ:
        return None
    meant = [w for w in meanings(keyword) if w in READ or w in time_dependence.ABAQUS]
    if keyword and meant:
        either = " or ".join(meant[:4])
        return f"{block.where}: *{keyword} may stand for {either}; write the keyword out"
    if time_dependence.states_time(keyword):
        return time_dependence.refusal(block.where, f"*{keyword}")
    return None


def _record(section: _Section, units: CardUnits, constants: list[Block]) -> Record:
    if section.refusals:
        raise ValueError(section.refusals[0])
    if "ELASTIC" not in section.blocks:
        raise ValueError(
            f"{section.where}: material {section.name!r} has no *ELASTIC; give E and nu (of a "
            "hyperelastic material its initial ones), or read another material with name="
        )
    moduli = _moduli(section.blocks["ELASTIC"], units)
    relaxation = _relaxation(section, moduli, units)
    shift = None
    if "TRS" in section.blocks:
        shift = _shift(section.blocks["TRS"], units, constants, section.notes)
    return Record(section.name, moduli, relaxation, shift, tuple(section.notes))


def _moduli(block: Block, units: CardUnits) -> Moduli:
    block.choice("TYPE", ("ISOTROPIC",), "ISOTROPIC")
    kind = block.choice("MODULI", ("LONG TERM", "INSTANTANEOUS"), "LONG TERM")
    if len(block.data) != 1:
        raise ValueError(
            f"{block.where}: *ELASTIC must have one line of E and nu, got {len(block.data)}; keep "
            "that of one temperature"
        )
    modulus, ratio, _ = block.data[0].numbers(2, 3)
    return Moduli(block.data[0].where, modulus * units.modulus, ratio, kind == "INSTANTANEOUS")


def _relaxation(section: _Section, moduli: Moduli, units: CardUnits) -> Relaxation:
    block = section.blocks.get("VISCOELASTIC")
    tests = [section.blocks[word] for word in TEST_DATA if word in section.blocks]
    if block is None:
        for lone in (*tests, *(section.blocks[w] for w in ("TRS",) if w in section.blocks)):
            raise ValueError(
                f"{lone.where}: *{lone.keyword} needs *VISCOELASTIC, TIME=... in its material"
            )
        return NoRelaxation()
    if over_frequency(block) and moduli.instantaneous:
        raise ValueError(
            f"{block.where}: *VISCOELASTIC, FREQUENCY needs long-term moduli, and *ELASTIC has "
            "MODULI=INSTANTANEOUS; remove that, or give TIME= in place of FREQUENCY="
        )
    return relaxation_of(block, tests, units, section.notes)


def _shift(block: Block, units: CardUnits, constants: list[Block], notes: list[str]) -> Shift:
    kind = block.choice("DEFINITION", ("WLF", "ARRHENIUS", "USER", "TNM"), "WLF")
    if kind not in ("WLF", "ARRHENIUS"):
        raise ValueError(
            f"{block.where}: *TRS, DEFINITION={block.given('DEFINITION')} is not read; give "
            "DEFINITION=WLF or ARRHENIUS"
        )
    wanted = "theta_0, C1, C2" if kind == "WLF" else "theta_0, E_0"
    if len(block.data) != 1:
        raise ValueError(f"{block.where}: *TRS must have one line of {wanted}")
    scale = units.kelvins(block.where)
    line = block.data[0]
    if kind == "WLF":
        reference, c1, c2 = line.numbers(3, 3)
        return WLF(scale.factor * reference + scale.offset, c1, scale.factor * c2)
    reference, energy = line.numbers(2, 2)
    _require_same_zero(constants, units, block.where)
    return Arrhenius(
        scale.factor * reference + scale.offset,
        _joules(line.where, energy, constants, scale.factor, notes),
    )


def _constant(constants: list[Block], name: str) -> float | None:
    for block in constants:
        given = block.given(name)
        if given is not None:
            [value] = DataLine(f"{block.where}: {name}", (given,)).numbers(1, 1)
            return value
    return None


def _joules(
    where: str, energy: float, constants: list[Block], degree: float, notes: list[str]
) -> float:
    """Return an activation energy [J/mol], by the gas constant of the file if it has one."""
    gas = _constant(constants, "UNIVERSAL GAS CONSTANT")
    if gas is not None:
        if not gas > 0:
            raise ValueError(f"{where}: UNIVERSAL GAS of *PHYSICAL CONSTANTS must be positive")
        return GAS_CONSTANT * degree * energy / gas
    least, most = _USUAL_ENERGIES
    if not least <= energy <= most:
        raise ValueError(
            f"{where}: {energy:g} is no activation energy in J/mol; state its unit by the gas "
            "constant in it, *PHYSICAL CONSTANTS, UNIVERSAL GAS=... (8314.46 for mJ/mol and K)"
        )
    notes.append(
        f"{where}: the activation energy is in J/mol, as there is no *PHYSICAL CONSTANTS with "
        "UNIVERSAL GAS"
    )
    return energy


def _require_same_zero(constants: list[Block], units: CardUnits, where: str) -> None:
    """ValueError if the file's absolute zero is not that of the unit of temperature."""
    zero, scale = _constant(constants, "ABSOLUTE ZERO"), units.kelvins(where)
    if zero is not None and not math.isclose(scale.factor * zero + scale.offset, 0.0, abs_tol=1.0):
        raise ValueError(
            f"{where}: ABSOLUTE ZERO={zero:g} of *PHYSICAL CONSTANTS does not go with "
            "temperature_unit; give 'degC' for -273.15, 'K' for 0, 'degF' for -459.67"
        )
