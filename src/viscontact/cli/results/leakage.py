"""Leakage of a run, printed, drawn or written as a table."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from rich.box import SIMPLE_HEAD
from rich.table import Table

from viscontact.backend.arrays import Floats
from viscontact.cli.results.stored import checked_result, early_end
from viscontact.cli.terminal.console import TextConsole
from viscontact.cli.terminal.messages import put, refuse, say
from viscontact.results.leakage.leakage import leakage
from viscontact.results.leakage.of_case import leakage_settings
from viscontact.results.run_axis import run_axis
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.formatting import format_quantity, time_labels
from viscontact.units.parsing import parse_quantity

#: Dimensions of the options, by the argument in Python.
_DIMENSIONS = {
    "viscosity": "viscosity",
    "pressure_difference": "pressure",
    "length": "length",
    "width": "length",
    "gas": "pressure",
}

#: Quantities of fluids, in place of those of solids.
_EXAMPLES = {"viscosity": "1 mPa s", "pressure": "1 bar"}


def print_leakage(directory: Path, texts: Mapping[str, str | None], output: Path | None) -> None:
    """Print the leakage of a run, with the settings of its case, and write the named file."""
    given: dict[str, Any] = {
        name: _quantity(name, text) if name in _DIMENSIONS else text
        for name, text in texts.items()
        if text is not None
    }
    with checked_result(directory) as ds:
        if ended := early_end(ds):
            say(ended)
        try:
            settings = leakage_settings(ds) | given
            if "viscosity" not in settings:
                refuse("--viscosity is needed, as '1 mPa s': the case has no section 'leakage'")
            found = leakage(ds, **settings)
        except ValueError as error:
            refuse(_as_typed(str(error)))
    _print(found)
    if output is not None:
        _write(found, output)


def _quantity(name: str, text: str) -> float:
    try:
        return parse_quantity(text, _DIMENSIONS[name])
    except ValueError as error:
        dimension = _DIMENSIONS[name]
        example = _EXAMPLES.get(dimension, DIMENSIONS[dimension].example)
        refuse(f"{_option(name)}: {str(error).replace(DIMENSIONS[dimension].example, example)}")


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _as_typed(message: str) -> str:
    """Message about an argument, with the option in its place."""
    match = re.match(r"\w+(?=: | must)", message)
    name = match.group() if match else ""
    is_option = name in _DIMENSIONS or name in ("along", "ends")
    return f"{_option(name)}{message.removeprefix(name)}" if is_option else message


def _print(found: xr.Dataset) -> None:
    axis, many = run_axis(found), "direction" in found.dims
    unit, factor = _rate_unit(found["leak_rate"].values)
    rate = [f"leak rate [{unit}]", "±"] if factor else []
    headings = [
        axis.name,
        *(["along"] if many else []),
        "contact",
        "critical gap",
        "±",
        "effective gap",
    ]
    table = Table(*headings, *rate, box=SIMPLE_HEAD, show_edge=False)
    directions = found["direction"].values.tolist() if many else [""]
    for index, place in enumerate(time_labels(axis.values(found).tolist(), axis.unit)):
        for direction in directions:
            row = found.isel({axis.name: index})
            row = row.sel(direction=direction) if many else row
            cells = [*([direction] if many else []), *_cells(row, factor)]
            table.add_row(place, *cells)
    console = TextConsole()
    console.print(table, crop=False)
    if not factor:
        put("Give --pressure-difference for the leak rate.")
    for change in str(found.attrs["changes"]).splitlines():
        put(f"the contact {change}")
    for note in str(found.attrs["warnings"]).splitlines():
        console.warn(note, soft_wrap=True)


def _cells(row: xr.Dataset, factor: float) -> list[str]:
    fraction = f"{100 * float(row.area_fraction):.3g} %"
    if not float(row.percolates):
        return [fraction, "closed", "", "0", *(["0", ""] if factor else [])]
    critical, effective = (
        format_quantity(float(row[name]), "m", 3) for name in ("critical_gap", "effective_gap")
    )
    narrowest = _spread(float(row.critical_gap), float(row.critical_gap_error))
    gaps = [critical, narrowest, effective]
    if not factor:
        return [fraction, *gaps]
    rate, error = float(row.leak_rate), float(row.leak_rate_error)
    return [fraction, *gaps, f"{rate / factor:.3g}", _spread(rate, error)]


def _spread(value: float, error: float) -> str:
    """Error over a value; a factor near closing, where only the order is known."""
    return f"{100 * error / value:.2g} %" if error < value else f"× {1 + error / value:.2g}"


def _rate_unit(rates: Floats) -> tuple[str, float]:
    """Unit of all leak rates and its factor [m³/s], by the largest; 0 if none is known."""
    known = rates[np.isfinite(rates)]
    if not known.size:
        return "", 0.0
    units = (("l/s", 1e-3), ("ml/s", 1e-6), ("mm³/s", 1e-9), ("mm³/h", 1e-9 / 3600))
    return next((each for each in units if known.max() >= each[1]), ("µm³/s", 1e-18))


def _write(found: xr.Dataset, output: Path) -> None:
    try:
        if output.suffix == ".csv":
            found.to_dataframe().to_csv(output)
        else:
            from viscontact.drawing.matplotlib import leak_rate, save_figure

            save_figure(leak_rate(found), output)
        put(output)
    except ModuleNotFoundError as error:
        refuse(str(error))
    except (ValueError, OSError) as error:
        refuse(f"{output}: {error}")
