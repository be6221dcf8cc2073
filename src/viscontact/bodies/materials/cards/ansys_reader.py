"""Reader of Ansys material cards."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from viscontact.bodies.laws import WLF, Arrhenius, Shift
from viscontact.bodies.laws.time_temperature import GAS_CONSTANT
from viscontact.bodies.materials.cards.ansys_syntax import read_commands
from viscontact.bodies.materials.cards.ansys_tables import DataTable, Numbered, collect
from viscontact.bodies.materials.cards.card import Card, CardUnits, card_units
from viscontact.bodies.materials.cards.prony_terms import Moduli, Terms, checked_terms
from viscontact.bodies.materials.cards.record import PronySeries, Record
from viscontact.tables import read_text


def read_ansys(
    path: str | PathLike[str],
    *,
    modulus_unit: str,
    time_unit: str,
    temperature_unit: str | None = None,
    name: str | None = None,
) -> tuple[Card, ...]:
    r"""Read the materials of an Ansys APDL file.

    Parameters
    ----------
    path : path-like
        The file; a whole input, or a card alone.
    modulus_unit, time_unit : str
        Units of its numbers, e.g. ``"MPa"`` and ``"s"``.
    temperature_unit : str, optional
        Needed if it has ``TB,SHIFT``, e.g. ``"degC"``; ``"K"`` for ``TN``.
    name : str, optional
        Read this material number only, e.g. ``"1"``; ``"_MATL"`` is that of a library file.

    Returns
    -------
    tuple of Card
        In the order of their first mention, named by their numbers.

    Raises
    ------
    ValueError
        If there is no such material, or it holds what cannot be read: with file and line.

    Notes
    -----
    ``MP,EX`` with ``MP,PRXY`` or ``NUXY`` (or ``MPDATA``, or ``TB,ELASTIC``), which are always of
    the instant; ``TB,PRONY`` with ``SHEAR`` and ``BULK``, pairs of relative modulus α_i and
    relaxation time τ_i in ``TBDATA``: G(t) = G_0 [α_inf + sum α_i exp(-t/τ_i)]; ``TB,SHIFT`` with
    ``WLF`` (T_r, C_1, C_2) or ``TN`` (T_r, H/R). Ansys' shift function A multiplies time, so
    that A = 1/a_T and log10 A = C_1 (T - T_r)/(C_2 + T - T_r), ln A = (H/R)(1/T_r - 1/T):
    Mechanical APDL Material Reference, chapter "Viscoelasticity", sections "Time-Domain
    Viscoelasticity" and "Time-Temperature Superposition". A material with another table that
    states a dependence on time or rate, such as ``TB,CREEP``, is refused; other data are noted.
    Of commands and labels four letters count. Expressions are not computed. Library files that
    ``MPWRITE`` writes are read.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp(), "rubber.mac")
    >>> lines = ["MP,EX,1,6", "MP,PRXY,1,0.5", "TB,PRONY,1,1,1,SHEAR", "TBDATA,1,0.5,10"]
    >>> _ = file.write_text("\n".join(lines))
    >>> [card] = read_ansys(file, modulus_unit="MPa", time_unit="s")
    >>> card.name, card.material.law
    ('1', RelaxationSeries(equilibrium=1000000.0, moduli=(1000000.0,), times=(10.0,)))
    """
    path = Path(path)
    units = card_units(modulus_unit, time_unit, temperature_unit)
    found = collect(read_commands(path.name, read_text(path)))
    if name is not None:
        chosen = {number: data for number, data in found.items() if number == name.upper()}
        if not chosen:
            numbers = ", ".join(found) or "none"
            raise ValueError(f"{path.name}: has no material {name!r}; there are {numbers}")
        found = chosen
    if not found:
        raise ValueError(f"{path.name}: has no MP,EX and no TB,PRONY; is it an Ansys APDL file?")
    return tuple(_record(number, data, units).card for number, data in found.items())


def _record(number: str, data: Numbered, units: CardUnits) -> Record:
    if data.refusals:
        raise ValueError(data.refusals[0])
    moduli = _moduli(number, data, units)
    for key, table in data.tables.items():
        if key.startswith("PRON") and table.option not in ("SHEA", "BULK"):
            raise ValueError(
                f"{table.command.where}: TB,PRONY with the option {table.command.word(4)!r} is not "
                "read; give SHEAR or BULK"
            )
    shear, bulk = (_terms(data.tables.get(f"PRON {kind}"), units) for kind in ("SHEA", "BULK"))
    shift = None
    if "SHIF" in data.tables:
        if shear.is_idle and bulk.is_idle:
            where = data.tables["SHIF"].command.where
            raise ValueError(f"{where}: TB,SHIFT needs TB,PRONY in its material")
        shift = _shift(data.tables["SHIF"], units)
    return Record(number, moduli, PronySeries(shear, bulk), shift, tuple(data.notes))


def _moduli(number: str, data: Numbered, units: CardUnits) -> Moduli:
    if "ELAS" in data.tables:
        table = data.tables["ELAS"]
        if table.option not in ("", "ISOT"):
            raise ValueError(
                f"{table.command.where}: TB,ELASTIC must be ISOT, got {table.command.word(4)}"
            )
        modulus, ratio = table.row(2)
        where = table.command.where
    else:
        where, modulus = data.properties.get("EX", (data.where, 0.0))
        ratios = [data.properties[k][1] for k in ("PRXY", "NUXY") if k in data.properties]
        if "EX" not in data.properties or not ratios:
            missing = "MP,EX" if "EX" not in data.properties else "MP,PRXY"
            raise ValueError(f"{data.where}: material {number} has no {missing}; give both")
        if len(set(ratios)) > 1:
            raise ValueError(f"{where}: PRXY and NUXY of an isotropic material are the same")
        ratio = ratios[0]
    return Moduli(where, modulus * units.modulus, ratio, instantaneous=True)


def _terms(table: DataTable | None, units: CardUnits) -> Terms:
    if table is None:
        return Terms()
    where = f"{table.command.where}: TB,{table.command.word(0)},,,,{table.command.word(4)}"
    last = max(table.values, default=0)
    if last == 0:
        raise ValueError(f"{where}: has no TBDATA with pairs of relative modulus and time")
    pairs = table.command.number(3, default=(last + 1) // 2) or (last + 1) // 2
    if last != 2 * pairs:
        raise ValueError(f"{where}: must have {pairs:g} pairs in TBDATA, got {last} values")
    values = table.row(last)
    return checked_terms(where, values[::2], [time * units.time for time in values[1::2]])


def _shift(table: DataTable, units: CardUnits) -> Shift:
    where = table.command.where
    scale = units.kelvins(where)
    if table.option == "WLF":
        reference, c1, c2 = table.row(3)
        return WLF(scale.factor * reference + scale.offset, c1, scale.factor * c2)
    if table.option == "TN":
        if scale.offset != 0.0:
            raise ValueError(
                f"{where}: TB,SHIFT with TN is in absolute temperatures; give "
                "temperature_unit='K', with the reference temperature in K"
            )
        reference, scaled_energy = table.row(2)
        return Arrhenius(scale.factor * reference, GAS_CONSTANT * scale.factor * scaled_energy)
    raise ValueError(
        f"{where}: TB,SHIFT with {table.command.word(4)!r} is not read; give WLF or TN"
    )
