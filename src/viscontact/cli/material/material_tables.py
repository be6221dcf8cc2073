"""Printing and drawing of materials by `material`."""

from __future__ import annotations

import math
from pathlib import Path
from textwrap import TextWrapper, fill, indent

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.table import Table

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws import WLF, Arrhenius, Elastic, Shift
from viscontact.bodies.materials import library
from viscontact.bodies.materials.library import Entry
from viscontact.bodies.materials.material import Material
from viscontact.cli.material.named_material import MaterialDisplay
from viscontact.cli.results.figure_files import plot_package, save
from viscontact.cli.terminal.console import TextConsole
from viscontact.cli.terminal.messages import put, refuse
from viscontact.units.formatting import format_number, format_quantity, readable_unit
from viscontact.units.temperatures import in_celsius

_WIDTH = 78
_DEPTH = 1e-6
# Suffixes of what --to writes.
_WRITTEN = {".inp": "abaqus", ".mac": "ansys", ".cdb": "ansys", ".csv": "csv"}


def list_library(output: Path | None = None) -> None:
    """Print the shipped library."""
    if output is not None:
        refuse(f"{output}: a figure shows one material; name it, e.g. pmma-paper")
    entries = [library.entry(name) for name in library.names()]
    rows = [
        (
            each.name,
            each.family,
            each.temperature.partition(" (")[0].partition(",")[0],
            each.test.partition(" ")[0],
            _range(each, 2),
        )
        for each in entries
    ]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for each, row in zip(entries, rows, strict=True):
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        put("  ".join(cells).rstrip())
        put(f"    {each.title} ({each.cite})")
    put("viscontact material NAME shows all data of one; -o FIG.png draws it with its source")


def show_material(
    shown: MaterialDisplay, output: Path | None, width: str | float | None = None
) -> None:
    """Print a material, and draw it where a file is named."""
    if output is not None and (form := _WRITTEN.get(output.suffix.lower())):
        refuse(f"{output}: -o alone is a figure (.png, .pdf or .svg); add --to {form}")
    if shown.entry is not None:
        _print_entry(shown.entry)
    else:
        put(f"{shown.name}: {_volume(shown.material)}")
        _print_about(shown)
    TextConsole().print(_values(shown))
    if output is not None:
        _draw(shown, output, width)


def _print_about(shown: MaterialDisplay) -> None:
    """Print the further contents of a file."""
    if shown.card_name:
        put(f"  material      {shown.card_name}")
    shift, ageing = shown.shift or shown.material.shift, shown.material.ageing
    if shift is not None:
        put(f"  temperature   {_shift(shift)}")
    if ageing is not None:
        age = format_quantity(ageing.age, "s", 3)
        put(f"  ageing        age {age} at first, exponent {ageing.exponent:g}")
    measured = shown.measured
    if measured is not None:
        put(f"  range         {' to '.join(format_quantity(t, 's') for t in measured)}")
    for note in shown.notes:
        put(f"  note          {note}")


def _range(entry: Entry, digits: int) -> str:
    """First and last time on which the constants rest."""
    if entry.measured is None:
        return "any time"
    return " to ".join(format_quantity(instant, "s", digits) for instant in entry.measured)


def _shift(shift: Shift) -> str:
    if isinstance(shift, WLF):
        rule = f"WLF, C1 = {shift.c1:.6g} and C2 = {shift.c2:.6g} K"
    elif isinstance(shift, Arrhenius):
        rule = f"Arrhenius, {shift.activation_energy / 1e3:.6g} kJ/mol"
    else:
        rule = "a table of factors"
    reference = getattr(shift, "reference_temperature", None)
    at = "" if reference is None else f"{in_celsius(reference):.6g} °C; "
    return f"{at}times shift by {rule}"


def _print_entry(entry: Entry) -> None:
    put(f"{entry.name}: {entry.title}")
    about = {
        "family": entry.family,
        "source": entry.source,
        "temperature": entry.temperature,
        "test": entry.test,
        "range": _range(entry, 4),
        "limits": ", ".join(
            f"{key.replace('_', ' ')} {' to '.join(value) if isinstance(value, list) else value}"
            for key, value in entry.limits.items()
        )
        or "none are stated",
        "constants": entry.constants,
        "volume": entry.volume,
        "checked": entry.checked,
        "licence": entry.licence,
    }
    for heading, text in about.items():
        how = TextWrapper(_WIDTH, f"  {heading:13}", " " * 15, break_on_hyphens=False)
        put(how.fill(text))
    put("material:")
    for key, value in entry.material.items():
        text = f"[{', '.join(map(str, value))}]" if isinstance(value, list) else str(value)
        put(indent(fill(f"{key}: {text}", _WIDTH, subsequent_indent="  "), "  "))


def _volume(material: Material) -> str:
    if material.poisson_ratio is not None:
        return f"{type(material.law).__name__}, Poisson's ratio {material.poisson_ratio:g}"
    assert material.bulk_modulus is not None  # exactly one is given
    return (
        f"{type(material.law).__name__}, bulk modulus "
        f"{format_quantity(material.bulk_modulus, 'Pa')}"
    )


def _values(shown: MaterialDisplay) -> Table:
    """Compliance, modulus and contact compliance at each decade."""
    first, last = shown.times()
    low, high = round(math.log10(first)), round(math.log10(last))
    times = np.logspace(low, high, high - low + 1, dtype=np.float64)
    law = shown.material.law
    # Phi = 1/(2 G(t)) holds for an elastic law only.
    columns = {"creep Φ = 1/(2G)" if isinstance(law, Elastic) else "creep Φ": (law(times), "1/Pa")}
    if float(law(0.0)) > 0:
        columns["relaxation G"] = (law.relaxation(times), "Pa")
    columns["contact J"] = (shown.material.contact_compliance()(times), "1/Pa")
    table = Table(box=SIMPLE_HEAD, padding=(0, 2, 0, 0))
    table.add_column("time", justify="right")
    cells = []
    for heading, (values, unit) in columns.items():
        symbol, numbers = _in_unit(values, unit)
        table.add_column(f"{heading} [{symbol}]", justify="right")
        cells.append(numbers)
    beyond = [not _is_measured(time, shown.measured) for time in times]
    if any(beyond):
        table.add_column("")
    for row, time in enumerate(times):
        note = ["not measured" if beyond[row] else ""] if any(beyond) else []
        table.add_row(format_quantity(time, "s"), *(column[row] for column in cells), *note)
    return table


def _in_unit(values: Floats, unit: str) -> tuple[str, list[str]]:
    # Unit of the geometric mean, without the vanishing modulus of a fluid at long times.
    good = values[values > _DEPTH * values.max()]
    middle = float(np.exp(np.mean(np.log(good))))
    if unit == "1/Pa":
        modulus = readable_unit("Pa", 1.0 / middle)
        return f"1/{modulus.symbol}", [format_number(float(v) * modulus.factor) for v in values]
    chosen = readable_unit(unit, middle)
    return chosen.symbol, [format_number(float(v) / chosen.factor) for v in values]


def _is_measured(time: float, measured: tuple[float, float] | None) -> bool:
    return measured is None or measured[0] * 0.999 <= time <= measured[1] * 1.001


def _draw(shown: MaterialDisplay, output: Path, width: str | float | None) -> None:
    plot = plot_package()
    entry = shown.entry

    def figure(material: Material) -> object:
        return plot.material_curves(
            material.law,
            shown.times(),
            measured=shown.measured,
            points=shown.points,
            title=entry.title if entry else shown.name,
            width=width,
        )

    save(plot, output, figure, shown.material)
