"""Heat balances of a run in steady motion, printed, drawn and written as a page."""

from __future__ import annotations

import re
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.table import Table

from viscontact.backend.errors import AccuracyWarning
from viscontact.cli.results.stored import checked_result, early_end
from viscontact.cli.terminal.console import TextConsole
from viscontact.cli.terminal.messages import put, refuse, say
from viscontact.results.heating.heat_rows import balance_headings, balance_rows
from viscontact.results.heating.result import RollingTemperature
from viscontact.results.heating.rolling_temperature import rolling_temperature
from viscontact.units.parsing import parse_quantity

#: Dimensions of the options, by the argument in Python.
_DIMENSIONS = {
    "cooling": "heat transfer coefficient",
    "ambient": "temperature",
    "area": "area",
    "thickness": "length",
    "conductivity": "thermal conductivity",
    "core_temperature": "temperature",
    "heat_capacity": "heat capacity",
    "density": "density",
}


def print_heat(
    directory: Path,
    texts: Mapping[str, str | None],
    speeds: Sequence[str],
    *,
    figure: Path | None,
    page: Path | None,
) -> None:
    """Print the heat balances of a run, and write the files that are named."""
    given: dict[str, Any] = {
        name: _quantity(_option(name), text, _DIMENSIONS[name])
        for name, text in texts.items()
        if text is not None
    }
    if speeds:
        given["speed"] = [_quantity("--speed", text, "speed") for text in speeds]
    with checked_result(directory) as ds:
        if ended := early_end(ds):
            say(ended)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", AccuracyWarning)  # they are among the notes
                found = rolling_temperature(ds, **given)
        except ValueError as error:
            refuse(_as_typed(str(error)))
    _print(found)
    _write(found, figure, page)


def _quantity(option: str, text: str, dimension: str) -> float:
    try:
        return parse_quantity(text, dimension)
    except ValueError as error:
        refuse(f"{option}: {error}")


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _as_typed(message: str) -> str:
    """Message about an argument, with the option in its place."""
    match = re.match(r"\w+(?=: | must)", message)
    name = match.group() if match else ""
    if name == "curve":
        return f"DIR{message.removeprefix(name)}"
    is_option = name in _DIMENSIONS or name == "speed"
    return f"{_option(name)}{message.removeprefix(name)}" if is_option else message


def _print(found: RollingTemperature) -> None:
    table = Table(*balance_headings(found.table), box=SIMPLE_HEAD, show_edge=False)
    for row in balance_rows(found.table):
        table.add_row(*row)
    console = TextConsole()
    console.print(table, crop=False)
    put(found)
    for note in found.notes:
        console.warn(note, soft_wrap=True)


def _write(found: RollingTemperature, figure: Path | None, page: Path | None) -> None:
    try:
        if figure is not None:
            from viscontact.drawing.matplotlib import rolling_temperature as draw
            from viscontact.drawing.matplotlib import save_figure

            save_figure(draw(found.table), figure)
            put(figure)
        if page is not None:
            found.report(page)
            put(page)
    except ModuleNotFoundError as error:
        refuse(str(error))
    except (ValueError, OSError) as error:
        refuse(f"{page if figure is None else figure}: {error}")
