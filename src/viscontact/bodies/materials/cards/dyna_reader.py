"""Reader of LS-DYNA material cards."""

from __future__ import annotations

import math
from dataclasses import field
from os import PathLike
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Arrhenius, Shift
from viscontact.bodies.laws.time_temperature import GAS_CONSTANT
from viscontact.bodies.materials.cards import time_dependence
from viscontact.bodies.materials.cards.card import Card, CardUnits, card_units
from viscontact.bodies.materials.cards.dyna_syntax import (
    CardLine,
    KeywordBlock,
    read_keywords,
    read_parameters,
)
from viscontact.bodies.materials.cards.prony_terms import Moduli, Terms
from viscontact.bodies.materials.cards.record import NoRelaxation, PronySeries, Record, Relaxation
from viscontact.tables import read_text
from viscontact.units.formatting import format_quantity

# Names of keywords without *MAT_, and their numbers.
_READ = {"ELASTIC": 1, "VISCOELASTIC": 6, "GENERAL_VISCOELASTIC": 76}
_MOST_TERMS = 18
# Relative difference of equal numbers written in fields of 10 characters.
_ROUNDING = 1e-3


@dataclass
class _Entry:
    """One *MAT_... with what others add to it."""

    number: int | None  # of the model; None if it is not read
    block: KeywordBlock
    title: str
    identity: str
    notes: list[str] = field(default_factory=list)
    refusals: list[str] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Title, or number of the material."""
        return self.title or self.identity


def read_ls_dyna(
    path: str | PathLike[str],
    *,
    modulus_unit: str,
    time_unit: str,
    temperature_unit: str | None = None,
    name: str | None = None,
) -> tuple[Card, ...]:
    r"""Read the materials of an LS-DYNA keyword file.

    Parameters
    ----------
    path : path-like
        The file; a whole model, or a card alone.
    modulus_unit, time_unit : str
        Units of its numbers, e.g. ``"MPa"`` and ``"s"``.
    temperature_unit : str, optional
        ``"K"``, needed for a temperature shift.
    name : str, optional
        Read the material of this number or title only.

    Returns
    -------
    tuple of Card
        In the file's order, named by their titles or numbers.

    Raises
    ------
    ValueError
        If there is no such material, or it holds what cannot be read: with file and line.

    Notes
    -----
    ``*MAT_ELASTIC`` (001); ``*MAT_VISCOELASTIC`` (006), G(t) = G_I + (G_0 - G_I) exp(-βt) with
    an elastic bulk modulus; ``*MAT_GENERAL_VISCOELASTIC`` (076), G(t) = sum G_i exp(-β_i t), with
    the bulk modulus BULK or, if it relaxes like the shear modulus, terms K_i; its Arrhenius shift
    exp(-A (1/T - 1/T_ref)) of the rates. Any other material, load curves in place of constants
    and the WLF shift of 076 are refused. Fields are fixed (10 characters, or 20 in the long
    format) or have commas between them; ``_TITLE`` and ``*PARAMETER`` are read. LS-DYNA Keyword
    User's Manual, volume II, under these names.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp(), "rubber.k")
    >>> _ = file.write_text("*MAT_VISCOELASTIC\n7, 1e-9, 2000., 2., 1., 0.1\n")
    >>> [card] = read_ls_dyna(file, modulus_unit="MPa", time_unit="s")
    >>> card.name, card.material.law
    ('7', RelaxationSeries(equilibrium=1000000.0, moduli=(1000000.0,), times=(10.0,)))
    """
    path = Path(path)
    units = card_units(modulus_unit, time_unit, temperature_unit)
    blocks = read_keywords(path.name, read_text(path))
    parameters = read_parameters(blocks)
    entries = _entries(blocks, parameters)
    if name is not None:
        chosen = [e for e in entries if name.upper() in (e.title.upper(), e.identity.upper())]
        if not chosen:
            found = ", ".join(repr(e.name) for e in entries) or "none"
            raise ValueError(f"{path.name}: has no material {name!r}; there are {found}")
        entries = chosen
    if not entries:
        raise ValueError(f"{path.name}: has no *MAT_...; is it an LS-DYNA file with materials?")
    return tuple(_record(entry, parameters, units).card for entry in entries)


def _entries(blocks: list[KeywordBlock], parameters: dict[str, str]) -> list[_Entry]:
    """Materials in the file's order, each with what *MAT_ADD_... keywords add."""
    found: list[_Entry] = []
    added: list[tuple[str, KeywordBlock, str]] = []
    elsewhere = []
    for block in blocks:
        kind, _, rest = block.keyword.partition("_")
        if kind == "INCLUDE":
            elsewhere.append(
                f"{block.where}: the file that *INCLUDE names is not read with this one"
            )
        if kind != "MAT" or rest.startswith("THERMAL"):
            continue
        title = block.title() if rest.endswith("_TITLE") else ""
        model, identity = rest.removesuffix("_TITLE"), _identity(block, parameters)
        if model.startswith("ADD_"):
            added.append((identity, block, model))
        else:
            found.append(_Entry(_model_number(model), block, title, identity))
    for entry in found:
        entry.notes += elsewhere
        for _, block, model in (each for each in added if each[0] == entry.identity):
            _add(entry, block, model)
    return found


def _identity(block: KeywordBlock, parameters: dict[str, str]) -> str:
    lines = block.lines(parameters)
    text = lines[0].text(0) if lines else ""
    return text.removesuffix(".0") if text.replace(".", "").isdigit() else text


def _model_number(model: str) -> int | None:
    if model.isascii() and model.isdigit():
        return int(model) if int(model) in _READ.values() else None
    return _READ.get(model)


def _add(entry: _Entry, block: KeywordBlock, model: str) -> None:
    written = f"*MAT_{model}"
    if any(word in model for word in time_dependence.LS_DYNA_ADDED):
        entry.refusals.append(time_dependence.refusal(block.where, written))
    else:
        entry.notes.append(f"{block.where}: {written} is not used")


def _record(entry: _Entry, parameters: dict[str, str], units: CardUnits) -> Record:
    where = entry.block.where
    if entry.number is None:
        raise ValueError(
            f"{where}: *{entry.block.keyword} is not read; read are *MAT_ELASTIC (001), "
            "*MAT_VISCOELASTIC (006) and *MAT_GENERAL_VISCOELASTIC (076). Write the law as one of "
            "these, or read another material with name="
        )
    if entry.refusals:
        raise ValueError(entry.refusals[0])
    lines = entry.block.lines(parameters)
    if not lines:
        raise ValueError(f"{where}: *{entry.block.keyword} has no data")
    if entry.number == 76:
        return _general_viscoelastic(entry, lines, units)
    moduli, relaxation = (_elastic if entry.number == 1 else _viscoelastic)(lines, units)
    if len(lines) > 1:
        raise ValueError(f"{lines[1].where}: *{entry.block.keyword} has one line, got {len(lines)}")
    return Record(entry.name, moduli, relaxation, notes=tuple(entry.notes))


def _elastic(lines: list[CardLine], units: CardUnits) -> tuple[Moduli, Relaxation]:
    line = lines[0]
    modulus = line.number(2) * units.modulus
    return Moduli(line.where, modulus, line.number(3), instantaneous=True), NoRelaxation()


def _viscoelastic(lines: list[CardLine], units: CardUnits) -> tuple[Moduli, Relaxation]:
    line = lines[0]
    bulk, at_once, left, rate = (line.number(place) for place in range(2, 6))
    for key, value in (("BULK", bulk), ("G0", at_once), ("GI", left), ("BETA", rate)):
        if value < 0:
            raise ValueError(
                f"{line.where}: a negative {key} names a load curve over temperature, which is not "
                "read; give constants of one temperature"
            )
    if left > at_once:
        raise ValueError(
            f"{line.where}: GI must lie between 0 and G0, got G0 = {at_once:g} and GI = {left:g}"
        )
    moduli = Moduli.of_shear_and_bulk(line.where, at_once * units.modulus, bulk * units.modulus)
    if left == at_once:
        return moduli, NoRelaxation()
    if not rate > 0:
        raise ValueError(f"{line.where}: BETA must be positive, got {rate:g}")
    shear = Terms((1 - left / at_once,), (units.time / rate,), left / at_once)
    return moduli, PronySeries(shear, Terms())


def _general_viscoelastic(entry: _Entry, lines: list[CardLine], units: CardUnits) -> Record:
    first, curves, rows = lines[0], lines[1:2], lines[2:]
    for place, key in ((0, "LCID"), (4, "LCIDK")):
        if curves and curves[0].number(place) != 0:
            raise ValueError(
                f"{curves[0].where}: {key}: constants from a load curve are not read; give GI and "
                "BETAI, or put the curve into a table and use law: table"
            )
    if first.number(4) != 0:
        raise ValueError(f"{first.where}: EF must be 0: with it the layer is elastic")
    if first.number(3) != 0:
        entry.notes.append(f"{first.where}: PCF is not used: tensile pressures are kept")
    if not 1 <= len(rows) <= _MOST_TERMS:
        raise ValueError(
            f"{first.where}: *{entry.block.keyword} must have a line for load curves, blank "
            f"without, and 1 to {_MOST_TERMS} lines of GI, BETAI, KI, BETAKI, got {len(rows)}"
        )
    at_once, shear = _series(rows, (0, 1), "GI", units)
    bulk_at_once, bulk = _series(rows, (2, 3), "KI", units)
    bulk_modulus = _bulk(first, bulk_at_once, units)
    moduli = Moduli.of_shear_and_bulk(first.where, at_once, bulk_modulus)
    bulk = shear if _alike(shear, bulk) else bulk
    return Record(
        entry.name, moduli, PronySeries(shear, bulk), _shift(first, units), tuple(entry.notes)
    )


def _series(
    rows: list[CardLine], places: tuple[int, int], name: str, units: CardUnits
) -> tuple[float, Terms]:
    """Return the modulus at once [Pa] and the relative terms of one column of moduli and rates."""
    pairs = [(row, row.number(places[0]), row.number(places[1])) for row in rows]
    for row, modulus, rate in pairs:
        if modulus < 0 or rate < 0:
            raise ValueError(
                f"{row.where}: {name} and its decay constant must not be negative, got "
                f"{modulus:g} and {rate:g}"
            )
    at_once = math.fsum(modulus for _, modulus, _ in pairs)
    if at_once == 0:
        return 0.0, Terms()
    relaxing = [(modulus, rate) for _, modulus, rate in pairs if modulus > 0 and rate > 0]
    left = math.fsum(modulus for _, modulus, rate in pairs if rate == 0) / at_once
    terms = Terms(
        tuple(modulus / at_once for modulus, _ in relaxing),
        tuple(units.time / rate for _, rate in relaxing),
        left,
    )
    return at_once * units.modulus, terms


def _bulk(first: CardLine, at_once: float, units: CardUnits) -> float:
    """Return the bulk modulus [Pa]: BULK, or the sum of KI if there are any."""
    given = first.number(2) * units.modulus
    if at_once == 0:
        return given
    if given != 0 and not math.isclose(given, at_once, rel_tol=_ROUNDING):
        raise ValueError(
            f"{first.where}: BULK and the sum of KI are two bulk moduli, "
            f"{format_quantity(given, 'Pa', 4)} and {format_quantity(at_once, 'Pa', 4)}; "
            "give one, the other 0"
        )
    return at_once


def _alike(shear: Terms, bulk: Terms) -> bool:
    """Return whether both moduli relax alike, to the digits of a card."""
    pairs = zip((*shear.weights, *shear.times), (*bulk.weights, *bulk.times), strict=False)
    return len(shear.weights) == len(bulk.weights) and all(
        math.isclose(s, k, rel_tol=_ROUNDING) for s, k in pairs
    )


def _shift(first: CardLine, units: CardUnits) -> Shift | None:
    reference, a, b = (first.number(place) for place in range(5, 8))
    if a == 0 and b == 0:
        return None
    if b != 0:
        raise ValueError(
            f"{first.where}: the WLF shift of *MAT_GENERAL_VISCOELASTIC is not read: the sign of A "
            "does not say for certain which temperatures are faster; set A and B to 0, and give a "
            f"shift in the case, kind: wlf with c1 = {abs(a) / math.log(10):.4g} and c2 = {b:g}, "
            "which is faster where it is warmer"
        )
    scale = units.kelvins(first.where)
    if scale.offset != 0.0:
        raise ValueError(
            f"{first.where}: the Arrhenius shift is in absolute temperatures; give "
            "temperature_unit='K', with TREF in K"
        )
    return Arrhenius(scale.factor * reference, GAS_CONSTANT * scale.factor * a)
