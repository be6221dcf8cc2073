"""Waves of the rough map of a contact, by its gap and displacement."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.persson import rough_waves
from viscontact.results.recorded_case import recorded_grid
from viscontact.results.recorded_theory import recorded_surface

#: Equal waves that have the spectrum of a map, from which on it counts as rough.
_MANY = 20.0


@dataclass(frozen=True)
class MapWaves:
    """Numbers of waves and cells of a rough map."""

    cells: float  # on the shortest wave that counts
    count: float  # waves of the mean length on a period


def map_waves(ds: xr.Dataset) -> MapWaves | None:
    """Waves of a map on a period; None on other grids, and for a body of a few waves."""
    if "displacement" not in ds:
        return None
    try:
        waves = rough_waves(recorded_surface(ds, "leakage"), 0)
    except ValueError:  # no period, a body that ends, or a flat one
        return None
    grid = recorded_grid(ds)
    squares = waves.slope / waves.wave_number**2
    if squares.sum() ** 2 < _MANY * np.square(squares).sum():
        return None
    mean = float((waves.wave_number * squares).sum() / squares.sum())
    return MapWaves(waves.cells, mean * min(grid.size) / (2 * np.pi))
