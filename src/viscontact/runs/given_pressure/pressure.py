"""Pressure as it is given: a map, maps over time, a formula, or a result."""

from __future__ import annotations

import inspect
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.results.netcdf import open_results
from viscontact.results.recorded_case import recorded_grid
from viscontact.runs.given_pressure.boxes import PointValues
from viscontact.runs.given_pressure.files import TABLES, read_pressure
from viscontact.runs.given_pressure.near_field import NearField
from viscontact.runs.given_pressure.resolved import BY_POINTS, FINE, resolved
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array

#: Relative difference of coordinates that counts as none, and of a force that is not lost.
SAME, LOST = 1e-6, 1e-9


class GivenPressure(ABC):
    """Pressure over a grid in time, in the frame of what carries it."""

    #: Instants of maps over time [s]; None for a pressure that is held, or a formula.
    times: Floats | None = None
    #: Coordinates x and y of the cells as given [m]; None for those of the grid.
    axes: tuple[Floats, Floats] | None = None

    @property
    def varies(self) -> bool:
        """True for a pressure that is not linear in time between its instants."""
        return False

    @abstractmethod
    def at(
        self, time: float, position: tuple[float, float], grid: Grid, *, edges: bool = True
    ) -> Floats:
        """Mean pressure in each cell at a time [s], with its frame at a position [m]; (nx, ny).

        Without edges those of a formula are not looked for.
        """


@dataclass(frozen=True, eq=False)
class PressureMap(GivenPressure):
    """Pressure uniform in each cell, held or linear in time between maps."""

    maps: Floats  # shape (maps, nx, ny) [Pa]
    times: Floats | None = None  # of the maps [s]
    axes: tuple[Floats, Floats] | None = None  # of the cells, along x and y [m]

    def at(
        self, time: float, position: tuple[float, float], grid: Grid, *, edges: bool = True
    ) -> Floats:
        """Mean pressure in each cell; a map that moves is shared out to those that it covers."""
        field = self._held(time)
        for axis, way in enumerate(position):
            if way:
                field = _moved(field, way / grid.cell_size[axis], axis, grid.periodic[axis])
        self._require_kept(field, time, position)
        return field

    def _held(self, time: float) -> Floats:
        if self.times is None:
            return np.asarray(self.maps[0])
        place = float(np.interp(time, self.times, np.arange(self.times.size)))
        below = min(int(place), self.times.size - 2) if self.times.size > 1 else 0
        share = place - below
        if not share:
            return np.asarray(self.maps[below])
        return np.asarray((1 - share) * self.maps[below] + share * self.maps[below + 1])

    def _require_kept(self, field: Floats, time: float, position: tuple[float, float]) -> None:
        whole = self._held(time)
        if np.abs(whole).sum() - np.abs(field).sum() > LOST * np.abs(whole).sum():
            at = " and ".join(format_quantity(each, "m", 4) for each in position)
            raise ValueError(
                f"grid: the pressure leaves it at t = {format_quantity(time, 's', 4)}, moved by "
                f"{at} along x and y; give a grid that holds the whole path, or a periodic one"
            )


@dataclass(frozen=True, eq=False)
class PressureFormula(GivenPressure):
    """Pressure as a function of x, y and perhaps time."""

    function: Callable[..., Any]
    timed: bool  # with a third argument, the time

    @property
    def varies(self) -> bool:
        """True if the time is an argument."""
        return self.timed

    def at(
        self, time: float, position: tuple[float, float], grid: Grid, *, edges: bool = True
    ) -> Floats:
        """Mean pressure in each cell."""
        values = self.values_at(time, position, grid)
        return resolved(values, NearField(grid), FINE if edges else BY_POINTS).means

    def values_at(self, time: float, position: tuple[float, float], grid: Grid) -> PointValues:
        """Pressure at points at a time [s], with its frame at a position [m]."""

        def value(x: Floats, y: Floats) -> Floats:
            along, across = (
                _wrapped(each - way, axis, grid)
                for axis, (each, way) in enumerate(zip((x, y), position, strict=True))
            )
            return self._value(along, across, time)

        return value

    def _value(self, x: Floats, y: Floats, time: float) -> Floats:
        wanted = np.broadcast_shapes(x.shape, y.shape)
        try:
            given = self.function(x, y, time) if self.timed else self.function(x, y)
            value = real_array("pressure(x, y)", given, "Pa")
            whole = np.broadcast_to(value, wanted)
        except (ValueError, TypeError, IndexError) as error:
            raise ValueError(
                f"pressure(x, y) must give a value for each point of arrays x and y of any shape, "
                f"as here {x.shape} and {y.shape}: {error}; compute with NumPy's functions, value "
                "by value"
            ) from None
        if not np.isfinite(whole).all():
            raise ValueError(
                f"pressure(x, y) must be finite, got {whole[~np.isfinite(whole)][0]} at "
                f"t = {format_quantity(time, 's')}; a formula with an edge needs np.where or "
                "np.maximum"
            )
        return whole


def given_pressure(
    given: object, grid: Grid | None, times: object = None
) -> tuple[GivenPressure, Grid]:
    """Pressure and its grid, of a map, maps over time, a formula, a result or its file.

    The times are those of plain maps over time.
    """
    if callable(given) and not isinstance(given, xr.DataArray | xr.Dataset):
        return _formula(given), _required(grid)
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


def _formula(function: Callable[..., Any]) -> PressureFormula:
    try:
        arguments = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):  # built in: of two arguments
        return PressureFormula(function, timed=False)
    needed = [
        each
        for each in arguments
        if each.default is each.empty
        and each.kind in (each.POSITIONAL_ONLY, each.POSITIONAL_OR_KEYWORD)
    ]
    if len(needed) not in (2, 3):
        raise ValueError(
            "pressure: a function must take (x, y), or (x, y, t) for one that varies in time, got "
            f"one of {len(needed)} arguments"
        )
    return PressureFormula(function, timed=len(needed) == 3)


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


def _moved(field: Floats, cells: float, axis: int, periodic: bool) -> Floats:
    """Field moved by a number of cells; what leaves a grid without period is lost."""
    whole = int(np.floor(cells))
    share = cells - whole
    return (1 - share) * _rolled(field, whole, axis, periodic) + share * _rolled(
        field, whole + 1, axis, periodic
    )


def _rolled(field: Floats, cells: int, axis: int, periodic: bool) -> Floats:
    rolled = np.roll(field, cells, axis)
    if periodic or not cells:
        return rolled
    lines = np.moveaxis(rolled, axis, 0)
    count = min(abs(cells), lines.shape[0])
    lines[slice(count) if cells > 0 else slice(lines.shape[0] - count, None)] = 0.0
    return rolled


def _wrapped(positions: Floats, axis: int, grid: Grid) -> Floats:
    """Positions, along a period those in the grid [m]."""
    if not grid.periodic[axis]:
        return positions
    period, low = grid.size[axis], grid.centre[axis] - grid.size[axis] / 2
    return np.asarray(low + (positions - low) % period)
