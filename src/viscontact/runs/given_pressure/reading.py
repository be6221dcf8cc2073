"""Pressure and grid of what a user gives: a map, maps over time, a formula, a result, a file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.results.netcdf import open_results
from viscontact.results.recorded_case import recorded_grid
from viscontact.runs.given_pressure.files import TABLES, read_pressure
from viscontact.runs.given_pressure.formula import pressure_formula
from viscontact.runs.given_pressure.pressure import GivenPressure
from viscontact.runs.given_pressure.pressure_map import PressureMap
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array

#: Relative difference of coordinates that counts as none.
SAME = 1e-6


def given_pressure(
    given: object, grid: Grid | None, times: object = None
) -> tuple[GivenPressure, Grid]:
    """Pressure and its grid, of a map, maps over time, a formula, a result or its file.

    The times are those of plain maps over time.
    """
    if callable(given) and not isinstance(given, xr.DataArray | xr.Dataset):
        return pressure_formula(given), _required(grid)
    if isinstance(given, str | Path) and Path(given).suffix.lower() in TABLES:
        return _labelled(read_pressure(Path(given)), grid)
    if isinstance(given, str | Path):
        with open_results(given) as results:
            return given_pressure(results.load(), grid, times)
    if isinstance(given, xr.Dataset):
        if "pressure" not in given:
            raise ValueError(
                "pressure: the result has no stored pressure; run again with fields stored "
                "('output: fields: all' in the case file, fields='all' in Python)"
            )
        grid = recorded_grid(given) if grid is None else grid
        given = given["pressure"]
    if isinstance(given, xr.DataArray) and {"x", "y"} & set(given.dims):
        return _labelled(given, grid)
    maps, grid = real_array("pressure", given, "Pa"), _required(grid)
    if maps.ndim != 3:
        return PressureMap(_checked(maps, grid)), grid
    instants = np.zeros(1) if times is None else real_array("times", times, "s", 1)
    if instants.size != len(maps):
        raise ValueError(
            f"pressure: {len(maps)} maps over time need as many times, got {instants.size}; for "
            "other instants of the result give an xarray.DataArray with the coordinate time"
        )
    return PressureMap(_checked(maps, grid), _instants(instants)), grid


def _required(grid: Grid | None) -> Grid:
    if grid is None:
        raise ValueError(
            "grid: needed, as the pressure does not say where its cells are; give "
            "vc.Grid(shape, size), or the pressure as an xarray.DataArray with the coordinates x "
            "and y"
        )
    if not isinstance(grid, Grid):
        raise ValueError(f"grid must be a vc.Grid, got {grid!r}")
    return grid


def _labelled(given: xr.DataArray, grid: Grid | None) -> tuple[PressureMap, Grid]:
    """Maps with coordinates, in any order of their axes."""
    over = [name for name in given.dims if name not in ("x", "y")]
    if over and over[0] in ("speed", "field_speed"):
        raise ValueError(
            "pressure: maps over speed do not follow each other in time; choose one of them, as "
            "ds.pressure.isel(speed=0)"
        )
    if not {"x", "y"} <= set(given.dims) or len(over) > 1 or not {"x", "y"} <= set(given.coords):
        raise ValueError(
            "pressure must have the dimensions and coordinates x and y, and perhaps time, got "
            f"{tuple(map(str, given.dims))}"
        )
    given = given.transpose(*over, "x", "y")
    along = [real_array(f"pressure: {name}", given[name], "m") for name in "xy"]
    grid = _required(_grid_of(*along) if grid is None else grid)
    maps = _checked(real_array("pressure", given, "Pa"), grid)
    for name, has, wanted, cell in zip("xy", along, (grid.x, grid.y), grid.cell_size, strict=True):
        if np.abs(has - wanted).max() > SAME * cell + SAME * np.abs(wanted).max():
            raise ValueError(
                f"pressure: its {name} goes from {format_quantity(has[0], 'm')} to "
                f"{format_quantity(has[-1], 'm')}, and that of the grid from "
                f"{format_quantity(wanted[0], 'm')} to {format_quantity(wanted[-1], 'm')}; leave "
                "out the grid, or interpolate the pressure to its cells: "
                "pressure.interp(x=grid.x, y=grid.y)"
            )
    times = _instants(given[over[0]]) if over else None
    return PressureMap(maps, times, (along[0], along[1])), grid


def _instants(given: object) -> Floats:
    times = real_array("pressure: time", given, "s")
    if times[0] != 0 or not (np.diff(times) > 0).all():
        raise ValueError(
            "pressure: the times of its maps must increase from 0, when the pressure comes, got "
            f"{times[:3].tolist()} ...; count the time from the first map"
        )
    return times


def _grid_of(x: Floats, y: Floats) -> Grid:
    """Grid of the centres of equal cells."""
    for name, each in (("x", x), ("y", y)):
        steps = np.diff(each)
        if each.size < 2 or not (np.abs(steps - steps.mean()) < SAME * abs(steps.mean())).all():
            raise ValueError(
                f"pressure: its {name} must be two or more equally spaced centres of cells; give a "
                "grid, and interpolate the pressure to it"
            )
    size = tuple(abs(float(each[-1] - each[0])) * each.size / (each.size - 1) for each in (x, y))
    centre = (float(x[0] + x[-1]) / 2, float(y[0] + y[-1]) / 2)
    return Grid((x.size, y.size), (size[0], size[1]), centre=centre)


def _checked(maps: Floats, grid: Grid) -> Floats:
    """Maps on the cells of a grid, shape (maps, nx, ny)."""
    if maps.ndim not in (2, 3) or maps.shape[-2:] != grid.shape:
        raise ValueError(
            f"pressure: a map of shape {maps.shape} does not fit the grid of {grid.shape} cells; "
            "it is [x, y], or [time, x, y]: give a grid of its shape, transpose it, or interpolate "
            "it to the cells"
        )
    if not np.isfinite(maps).all():
        raise ValueError(
            "pressure: the map has holes (NaN or infinite); fill them, with 0 where nothing presses"
        )
    return maps if maps.ndim == 3 else maps[None]
