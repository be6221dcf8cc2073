"""Material written as a card of another program or as a table."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws import TabulatedCreep, TabulatedRelaxation
from viscontact.bodies.materials.cards import Card, write_abaqus, write_ansys
from viscontact.bodies.materials.material import Material
from viscontact.case.data_file import is_same_file
from viscontact.cli.material.fit_report import write_section
from viscontact.cli.material.material_files import MaterialOptions
from viscontact.cli.material.named_material import MaterialDisplay
from viscontact.cli.terminal.messages import put, refuse, say
from viscontact.units.parsing import parse_unit

FORMS = ("abaqus", "ansys", "csv")
_ROWS_PER_DECADE = 20
# Relative modulus [-] below which a fluid's modulus counts as vanished.
_LEAST_MODULUS = 1e-9
_FIGURES = (".png", ".pdf", ".svg")


def write_material(
    named: MaterialDisplay, form: str, typed: MaterialOptions, output: Path | None
) -> None:
    """Write a material to a file, or print it."""
    if output is not None and output.suffix.lower() in _FIGURES:
        refuse(f"{output}: with --to, -o is the file to write; leave --to out for a figure")
    if output is not None and is_same_file(output, Path(named.name)):
        refuse(f"{output}: is the input file; give another one")
    for note in named.notes:
        say(f"note: {note}")
    moduli, times = typed.modulus_unit or "MPa", typed.time_unit or "s"
    _require_units(moduli, times)
    try:
        if form == "csv":
            text = _table(named, moduli, times)
        else:
            text = _card(named, form, moduli, times, typed.temperature_unit)
    except ValueError as error:
        refuse(f"{named.name}: {_with_remedy(str(error), named.name)}")
    if output is None:
        put(text, end="")
    else:
        write_section(output, text)


def _require_units(moduli: str, times: str) -> None:
    for option, unit, kind in (
        ("--modulus-unit", moduli, "pressure"),
        ("--time-unit", times, "time"),
    ):
        try:
            parse_unit(unit, kind)
        except ValueError as error:
            refuse(f"{option}: {error}")


def _card(named: MaterialDisplay, form: str, moduli: str, times: str, degrees: str | None) -> str:
    name = named.card_name or _safe_name(named)
    card = Card(name, named.material, named.shift)
    if form == "abaqus":
        return write_abaqus(card, modulus_unit=moduli, time_unit=times, temperature_unit=degrees)
    number = int(name) if name.isascii() and name.isdigit() and int(name) > 0 else 1
    return write_ansys(
        card, modulus_unit=moduli, time_unit=times, temperature_unit=degrees, number=number
    )


def _safe_name(named: MaterialDisplay) -> str:
    """Return a name that any program accepts."""
    name = named.name if named.entry is not None else Path(named.name).stem
    return re.sub(r"[^\w-]", "_", name, flags=re.ASCII)[:80]


def _with_remedy(why: str, name: str) -> str:
    if "takes a Prony series" not in why:
        return why.replace("temperature_unit=", "--temperature-unit ").replace(
            "temperature_unit", "--temperature-unit"
        )
    return (
        f"{why.partition('; ')[0]}; fit one first: viscontact material {name} --to csv -o law.csv, "
        "then viscontact fit law.csv"
    )


def _table(named: MaterialDisplay, moduli: str, times: str) -> str:
    """Return creep compliance and relaxation modulus in shear over log time."""
    if named.shift is not None:
        say("note: the table holds the law at its reference temperature, without its shift")
    material = named.material
    second, pascal = parse_unit(times, "time"), parse_unit(moduli, "pressure")
    columns = _columns(named)
    units = {"time": times, "J": _reciprocal(moduli), "G": moduli}
    factors = {"time": 1 / second, "J": pascal, "G": 1 / pascal}
    heads = [f"{name} [{units[name]}]" for name in columns]
    rows = zip(*(factors[name] * values for name, values in columns.items()), strict=True)
    lines = [
        f"# {_safe_name(named)}: creep compliance J = 2 Phi and relaxation modulus G in shear",
        f"# law: table; quantity: creep_compliance; data: shear; {_volume(material)}",
    ]
    return "\n".join([*lines, ",".join(heads), *(_line(*row) for row in rows)]) + "\n"


def _columns(named: MaterialDisplay) -> dict[str, Floats]:
    law = named.material.law
    instants = _instants(named)
    # Numerical interconversion may oscillate in its last digits; a table must be monotonic.
    columns = {"time": instants, "J": 2 * np.maximum.accumulate(law(instants))}
    if float(law(0.0)) > 0:
        columns["G"] = np.minimum.accumulate(law.relaxation(instants))
        kept = columns["G"] > _LEAST_MODULUS * columns["G"][0]
        columns = {name: values[kept] for name, values in columns.items()}
    return columns


def _instants(named: MaterialDisplay) -> Floats:
    """Times of the rows [s]: a table's own, or logarithmic ones with 0 in front."""
    law = named.material.law
    if isinstance(law, TabulatedCreep | TabulatedRelaxation):
        return np.asarray(law.times, dtype=np.float64)
    first, last = named.span()
    count = max(2, math.ceil(_ROWS_PER_DECADE * math.log10(last / first)) + 1)
    instants = np.geomspace(first, last, count, dtype=np.float64)
    # Without an instantaneous compliance, a row at 0 would make the law linear up to the next row.
    return np.concatenate(([0.0], instants)) if float(law(0.0)) > 0 else instants


def _reciprocal(unit: str) -> str:
    """Return the unit of a compliance, e.g. 1/MPa."""
    for written in (f"1/{unit}", f"1/({unit})"):
        try:
            if math.isclose(parse_unit(written, "compliance") * parse_unit(unit, "pressure"), 1):
                return written
        except ValueError:
            continue
    raise ValueError(f"--modulus-unit: a compliance cannot be written in 1/({unit}); use e.g. MPa")


def _volume(material: Material) -> str:
    if material.poisson_ratio is not None:
        return f"poisson_ratio: {material.poisson_ratio:g}"
    return f"bulk_modulus: {material.bulk_modulus:g} Pa"


def _line(*numbers: float) -> str:
    return ",".join(f"{number:.12g}" for number in numbers)
