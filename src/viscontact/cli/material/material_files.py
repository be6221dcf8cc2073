"""Material from a name or a file: shipped, case file, measured table or card."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials import library as materials
from viscontact.bodies.materials.cards import is_card, unread_program
from viscontact.case import CaseError, read_material, read_section, shipped_material
from viscontact.cli.material.fit_options import read_stress
from viscontact.cli.material.named_material import MaterialDisplay
from viscontact.cli.material.table_choice import as_option, say_chosen
from viscontact.cli.terminal.messages import refuse, say
from viscontact.tables import Table, is_spreadsheet, read_table, read_text
from viscontact.units.parsing import parse_quantity

_CASE_SUFFIXES = (".yaml", ".yml", ".toml")
_CARD_SUFFIXES = (".inp", ".mac", ".cdb", ".ans", ".apdl", ".mpl", ".k", ".key", ".dyn")
_CASE_KEYS = re.compile(r"^(?:material|law)[ \t]*:", re.M)
_QUANTITIES = ("creep_compliance", "relaxation_modulus")
# Keys of a case file that are options here.
_KEYS = re.compile(r"\b(poisson_ratio|bulk_modulus|modulus_unit|time_unit|temperature_unit)\b")


@dataclass(frozen=True)
class MaterialOptions:
    """Options that say how a material file is to be read, as typed."""

    data: str | None = None
    poisson_ratio: float | None = None
    bulk_modulus: str | None = None
    set: float | None = None
    stress: str | None = None
    columns: str | None = None
    modulus_unit: str | None = None
    time_unit: str | None = None
    temperature_unit: str | None = None
    name: str | None = None
    temperature: str | None = None

    def given(self, *keys: str) -> dict[str, Any]:
        """Return the given ones of these options, by their keys."""
        values = {key: getattr(self, key) for key in keys}
        return {key: value for key, value in values.items() if value is not None}


def find_material(which: str, typed: MaterialOptions, *, writes: bool = False) -> MaterialDisplay:
    """Return a material by its shipped name or from a file; refuse options without effect."""
    idle = ["data", "set", "stress", "columns", "name", "poisson_ratio", "bulk_modulus"]
    units = [] if writes else ["modulus_unit", "time_unit", "temperature_unit"]
    if which in materials.names():
        _refuse_unused(which, "a shipped material", typed, [*idle, *units])
        return MaterialDisplay(which, shipped_material(which), materials.entry(which))
    path = Path(which)
    _refuse_unknown(which, path)
    kind = _kind(path)
    if kind == "table":
        _refuse_unused(which, "a table", typed, ["name", *units])
        return _from_table(path, typed)
    if kind == "card":
        _refuse_unused(which, "a card", typed, ["data", "set", "stress", "columns"])
        return _from_card(path, typed)
    _refuse_unused(which, "a case file", typed, [*idle, *units])
    try:
        return MaterialDisplay(which, read_material(path))
    except CaseError as error:
        refuse(*error.problems)


def at_temperature(shown: MaterialDisplay, given: str | None) -> MaterialDisplay:
    """Return a material at a temperature, as typed; unchanged without one."""
    if given is None:
        return shown
    try:
        wanted = parse_quantity(given, "temperature")
    except ValueError as error:
        refuse(f"--temperature: {error}")
    if shown.material.shift is None:
        refuse(
            f"--temperature: {shown.name} has no shift, which says how its times change with "
            "temperature; give it one in a case file, e.g. 'shift: {kind: wlf, "
            "reference_temperature: 25 degC, c1: 17.44, c2: 51.6 K}'"
        )
    try:
        material = shown.material.at(wanted)
    except ValueError as error:
        refuse(f"--temperature: {str(error).removeprefix('temperature: ')}")
    return replace(shown, material=material, shift=material.shift)


def _refuse_unknown(which: str, path: Path) -> None:
    if path.exists() or path.suffix:
        return
    refuse(materials.unknown_name(which, "shipped material and no file"))


def _refuse_unused(which: str, what: str, typed: MaterialOptions, keys: list[str]) -> None:
    for key in typed.given(*keys):
        refuse(f"{which}: is {what}, to which {_option(key)} does not apply; leave it out")


def _kind(path: Path) -> str:
    """Return "case", "card" or "table", from the suffix or the content."""
    suffix = path.suffix.lower()
    if suffix in _CASE_SUFFIXES or path.is_dir():
        return "case"
    if is_spreadsheet(path):
        return "table"
    try:
        text = read_text(path)
    except ValueError as error:
        refuse(str(error))
    unread = unread_program(text, path.name)
    if unread is not None:
        refuse(unread)
    if is_card(text):
        return "card"
    if _CASE_KEYS.search(text):
        return "case"
    return "card" if suffix in _CARD_SUFFIXES else "table"


def _from_table(path: Path, typed: MaterialOptions) -> MaterialDisplay:
    try:
        table = read_table(
            path, typed.columns, stress=read_stress(typed.stress), wanted=_QUANTITIES
        )
        quantity = _quantity(table)
    except ValueError as error:
        refuse(as_option(str(error)))
    say_chosen(path, table)
    data = typed.data or table.data
    if data is None:
        refuse(
            f"{path.name}: the headings do not say what kind of test it is; add --data shear, "
            "--data uniaxial or --data deviatoric"
        )
    volume = typed.given("poisson_ratio", "bulk_modulus", "set", "stress", "columns")
    section = {"law": "table", "file": str(path), "quantity": quantity, "data": data, **volume}
    return MaterialDisplay(str(path), _read_section(path, section).build())


def _quantity(table: Table) -> str:
    """Return the name of the column with the law; ValueError without one over time."""
    found = [quantity for quantity in _QUANTITIES if quantity in table]
    if not found or "time" not in table:
        hint = ""
        if "angular_frequency" in table or "force" in table:
            hint = f"; `viscontact fit {table.source}` finds the law of such data"
        raise ValueError(
            f"{table.source.name}: needs a creep compliance or a relaxation modulus over time; "
            f"{table.contents}{hint}"
        )
    if len(found) > 1:
        say(f"{table.source.name}: the law is its {found[0]}; its {found[1]} is not used")
    return found[0]


def _from_card(path: Path, typed: MaterialOptions) -> MaterialDisplay:
    if typed.modulus_unit is None or typed.time_unit is None:
        refuse(
            f"{path.name}: cards do not state their units; add e.g. --modulus-unit MPa "
            "--time-unit s"
        )
    keys = ("modulus_unit", "time_unit", "temperature_unit", "name")
    section = {
        "law": "card",
        "file": str(path),
        **typed.given(*keys, "poisson_ratio", "bulk_modulus"),
    }
    found = _read_section(path, section)
    card = found.card
    return MaterialDisplay(
        str(path), found.build(), card_name=card.name, shift=card.shift, notes=found.notes
    )


def _read_section(path: Path, section: dict[str, Any]) -> Any:
    """Read a material section; errors name the options of the command line."""
    try:
        return read_section(section, path)
    except CaseError as error:
        refuse(*(_in_options(path, line) for line in error.problems))


def _in_options(path: Path, line: str) -> str:
    why = line.removeprefix(f"{path}: ").removeprefix("material: ")
    key = re.match(r"material\.(?:\w+\.)*(\w+): ", why)
    if key is not None:
        why = why[key.end() :]
        why = why if key[1] == "file" else f"{_option(key[1])}: {why}"
    why = _KEYS.sub(lambda match: _option(match[1]), why)
    why = why.replace("say which with set:", "say which with --set:")
    why = why.replace(", and give file: law.yaml in place of law: table", "")
    why = why.replace("; name one of ", "; choose one with --name: ").replace("name=", "--name")
    why = as_option(why)
    if "smooth out the noise" in why:
        why += f"; `viscontact fit {path}` does"
    return why if path.name in why else f"{path.name}: {why}"


def _option(key: str) -> str:
    return f"--{key.replace('_', '-')}"
