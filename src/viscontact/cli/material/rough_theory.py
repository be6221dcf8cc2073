"""Contact area and friction of a rough surface by theory, printed and drawn."""

from __future__ import annotations

import re
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NoReturn

import xarray as xr
from rich.box import SIMPLE_HEAD
from rich.table import Table

from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.material import Material
from viscontact.bodies.surfaces import Surface, filled, levelled, read_surface
from viscontact.cli.material.material_files import MaterialOptions, find_material
from viscontact.cli.terminal.console import TextConsole
from viscontact.cli.terminal.messages import put, refuse
from viscontact.results.persson import persson_area, persson_sliding
from viscontact.units.formatting import format_quantity
from viscontact.units.parsing import parse_quantity


@dataclass(frozen=True)
class RoughSliding:
    """What the theory is asked, as typed."""

    surface: Path
    material: str
    pressures: tuple[str, ...]
    time: str | None
    speeds: tuple[str, ...]
    along: str


def print_theory(
    typed: RoughSliding,
    options: Mapping[str, str | None],
    *,
    periodic: bool,
    figure: Path | None,
) -> None:
    """Print area and friction at all pressures and speeds, and draw them over speed."""
    pressures = [_quantity("--pressure", each, "pressure") for each in typed.pressures]
    speeds = [_quantity("--speed", each, "speed") for each in typed.speeds]
    time = None if typed.time is None else _quantity("--time", typed.time, "time")
    if figure is not None and (len(pressures) > 1 or not speeds):
        refuse("-o: the figure is over speed at one pressure; give --speed, and one --pressure")
    surface = _surface(typed.surface, options, periodic)
    material = find_material(typed.material, MaterialOptions()).material
    try:
        with warnings.catch_warnings(record=True) as notes:
            warnings.simplefilter("always", AccuracyWarning)
            found = [_sliding(surface, material, p, speeds, typed.along) for p in pressures]
            rows = (
                [row for p, each in zip(pressures, found, strict=True) for row in _rows(p, each)]
                if speeds
                else [
                    [format_quantity(p, "Pa"), _number(persson_area(surface, material, p, time))]
                    for p in pressures
                ]
            )
    except ValueError as error:
        _refuse(str(error))
    _print(rows, bool(speeds), [str(each.message) for each in notes])
    if figure is not None:
        _draw(found[0], figure)


def _sliding(
    surface: Surface, material: Material, pressure: float, speeds: list[float], along: str
) -> xr.Dataset:
    """Theory over speed; nothing without speeds."""
    if not speeds:
        return xr.Dataset()
    direction: Any = along
    return persson_sliding(surface, material, pressure, speeds, direction)


def _surface(path: Path, options: Mapping[str, str | None], periodic: bool) -> Surface:
    spacing = options["spacing"]
    given: dict[str, Any] = {"height_unit": options["height_unit"]}
    if spacing is not None:
        given["spacing"] = _quantity("--spacing", spacing, "length")
    try:
        found = read_surface(path, **given)
        if not (periodic or found.periodic):
            found = levelled(found)
        if found.missing.any():
            found = filled(found)
    except OSError as error:
        refuse(f"{path}: {error.strerror or error}")
    except ValueError as error:
        refuse(str(error))
    if periodic:
        return Surface(found.heights, found.spacing, name=found.name, periodic=True)
    return found


def _quantity(option: str, text: str, dimension: str) -> float:
    try:
        return parse_quantity(text, dimension)
    except ValueError as error:
        refuse(f"{option}: {error}")


def _refuse(message: str) -> NoReturn:
    """Message about an argument, with the option in its place."""
    match = re.match(r"(pressure|time|speed|along|material)(?=: | must)", message)
    refuse(f"--{message}" if match else message)


def _rows(pressure: float, found: xr.Dataset) -> list[list[str]]:
    return [
        [
            format_quantity(pressure, "Pa"),
            format_quantity(float(at.speed), "m/s"),
            _number(float(at.area_fraction)),
            f"{_number(float(at.friction_coefficient))} to "
            f"{_number(float(at.friction_coefficient_upper))}",
        ]
        for at in (found.isel(speed=index) for index in range(found.sizes["speed"]))
    ]


def _number(value: float) -> str:
    return f"{value:.3g}"


def _print(rows: list[list[str]], over_speed: bool, notes: list[str]) -> None:
    more = ("speed", "real over nominal area", "friction coefficient")
    table = Table(
        "pressure", *(more if over_speed else more[1:2]), box=SIMPLE_HEAD, show_edge=False
    )
    for row in rows:
        table.add_row(*row)
    console = TextConsole()
    console.print(table, crop=False)
    put("Persson's theory: exact at full contact, an estimate below it.")
    for note in dict.fromkeys(notes):
        console.warn(note, soft_wrap=True)


def _draw(found: xr.Dataset, figure: Path) -> None:
    try:
        from viscontact.drawing.matplotlib import rough_theory, save_figure

        save_figure(rough_theory(found), figure)
        put(figure)
    except ModuleNotFoundError as error:
        refuse(str(error))
    except (ValueError, OSError) as error:
        refuse(f"{figure}: {error}")
