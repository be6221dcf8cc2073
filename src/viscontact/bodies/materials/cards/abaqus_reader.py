"""Reader of Abaqus material cards."""

from __future__ import annotations

from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path

from viscontact.bodies.laws import WLF, Shift
from viscontact.bodies.materials.cards.abaqus_syntax import Block, read_blocks
from viscontact.bodies.materials.cards.abaqus_test_data import tested_material
from viscontact.bodies.materials.cards.card import Card, CardUnits, card_units
from viscontact.bodies.materials.cards.prony_terms import Moduli, checked_terms, relaxing_material
from viscontact.bodies.materials.material import Material
from viscontact.tables import read_text

_TEST_DATA = ("SHEAR TEST DATA", "VOLUMETRIC TEST DATA", "COMBINED TEST DATA")
_READ = ("ELASTIC", "VISCOELASTIC", "TRS", *_TEST_DATA)
# Keywords that end the materials of a whole model.
_BEYOND = ("STEP", "PART", "ASSEMBLY", "NODE", "ELEMENT", "BOUNDARY", "SURFACE INTERACTION",
           "INITIAL CONDITIONS", "SOLID SECTION", "END PART", "END ASSEMBLY")  # fmt: skip
_TIMES = ("PRONY", "CREEP TEST DATA", "RELAXATION TEST DATA", "FREQUENCY DATA")


@dataclass
class _Section:
    """Blocks of one material, while they are collected."""

    name: str
    where: str
    blocks: dict[str, Block] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


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
    ``MODULI=INSTANTANEOUS``; ``*VISCOELASTIC`` with ``TIME=PRONY`` (lines of g_i, k_i, τ_i),
    ``TIME=CREEP TEST DATA`` or ``TIME=RELAXATION TEST DATA``, which are used as measured; ``*TRS``
    with ``DEFINITION=WLF``. Other keywords are noted. Abaqus 2016 Keywords Reference Guide under
    these names, Analysis User's Guide, section 22.7.1, "Time domain viscoelasticity":
    g_R(t) = 1 - sum g_i (1 - exp(-t/τ_i)), G(t) = G_0 g_R(t), and k_i likewise for the bulk
    modulus: k_i = 0 is an elastic bulk modulus, k_i = g_i a constant Poisson's ratio.

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
    sections = _sections(read_blocks(path.name, read_text(path)))
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
    return tuple(_card(section, units) for section in sections)


def _sections(blocks: list[Block]) -> list[_Section]:
    sections: list[_Section] = []
    current: _Section | None = None
    for block in blocks:
        if block.keyword == "MATERIAL":
            current = _Section(block.parameters.get("NAME", ""), block.where)
            sections.append(current)
        elif block.keyword in _BEYOND:
            current = None
        elif block.keyword in _READ:
            if current is None:  # a card without *MATERIAL
                current = _Section("", block.where)
                sections.append(current)
            _collect(current, block)
        elif current is not None:
            current.notes.append(f"{block.where}: *{block.keyword} is not used")
    return sections


def _collect(section: _Section, block: Block) -> None:
    if block.keyword in section.blocks:
        raise ValueError(
            f"{block.where}: *{block.keyword} occurs twice in material {section.name!r}"
        )
    section.blocks[block.keyword] = block


def _card(section: _Section, units: CardUnits) -> Card:
    if "ELASTIC" not in section.blocks:
        raise ValueError(
            f"{section.where}: material {section.name!r} has no *ELASTIC; give E and nu (of a "
            "hyperelastic material its initial ones), or read another material with name="
        )
    moduli = _moduli(section.blocks["ELASTIC"], units)
    shift = _shift(section.blocks["TRS"], units) if "TRS" in section.blocks else None
    return Card(section.name, _material(section, moduli, units), shift, tuple(section.notes))


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


def _material(section: _Section, moduli: Moduli, units: CardUnits) -> Material:
    block = section.blocks.get("VISCOELASTIC")
    tests = [section.blocks[word] for word in _TEST_DATA if word in section.blocks]
    if block is None:
        if tests:
            raise ValueError(f"{tests[0].where}: test data need *VISCOELASTIC, TIME=... above")
        return relaxing_material(moduli, checked_terms("", [], []), checked_terms("", [], []))
    kind = _kind(block)
    if kind == "PRONY":
        return _prony(block, moduli, units)
    for word in ("ERRTOL", "NMAX"):
        if word in block.parameters:
            section.notes.append(
                f"{block.where}: {word} is not used: test data are taken as measured"
            )
    return tested_material(block, tests, kind == "CREEP TEST DATA", moduli, units, section.notes)


def _kind(block: Block) -> str:
    if "FREQUENCY" in block.parameters or "NONLINEAR" in block.parameters:
        word = "FREQUENCY" if "FREQUENCY" in block.parameters else "NONLINEAR"
        raise ValueError(
            f"{block.where}: *VISCOELASTIC, {word} is not read; give TIME=PRONY or test data"
        )
    block.choice("TYPE", ("ISOTROPIC",), "ISOTROPIC")
    if "TIME" not in block.parameters:
        raise ValueError(f"{block.where}: *VISCOELASTIC must say TIME=PRONY or another kind")
    kind = block.choice("TIME", _TIMES, "")
    if kind == "FREQUENCY DATA":
        raise ValueError(
            f"{block.where}: *VISCOELASTIC, TIME=FREQUENCY DATA is not read (its frequencies are "
            "cycles per time); put storage and loss moduli into a CSV file and fit them"
        )
    return kind


def _prony(block: Block, moduli: Moduli, units: CardUnits) -> Material:
    if not block.data:
        raise ValueError(f"{block.where}: *VISCOELASTIC, TIME=PRONY has no lines of g, k, tau")
    rows = [line.numbers(3, 3) for line in block.data]
    times = [tau * units.time for _, _, tau in rows]
    shear = checked_terms(f"{block.where}: shear terms g", [g for g, _, _ in rows], times)
    bulk = checked_terms(f"{block.where}: bulk terms k", [k for _, k, _ in rows], times)
    return relaxing_material(moduli, shear, bulk)


def _shift(block: Block, units: CardUnits) -> Shift:
    if block.choice("DEFINITION", ("WLF", "ARRHENIUS", "USER", "TNM"), "WLF") != "WLF":
        raise ValueError(
            f"{block.where}: *TRS, DEFINITION={block.parameters['DEFINITION']} is not read; give "
            "DEFINITION=WLF"
        )
    if len(block.data) != 1:
        raise ValueError(f"{block.where}: *TRS must have one line of theta_0, C1, C2")
    scale = units.kelvins(block.where)
    reference, c1, c2 = block.data[0].numbers(3, 3)
    return WLF(scale.factor * reference + scale.offset, c1, scale.factor * c2)
