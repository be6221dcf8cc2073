"""Files of profilers and microscopes, read by SurfaceTopography."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.surfaces.surface import Surface
from viscontact.surfaces.units import Units
from viscontact.units import parse_unit


def read_instrument(path: Path, units: Units, channel: str | None) -> Surface:
    """Read a map from a file of an instrument.

    Parameters
    ----------
    path : Path
        The file, in any format that SurfaceTopography knows.
    units : Units
        What is told beside it.
    channel : str or None
        Name of the channel; the file's default one if None.

    Returns
    -------
    Surface
        The map, or a line scan with a single point along y.

    Raises
    ------
    ValueError
        If SurfaceTopography is not there or cannot read it, there is no such channel, or a unit
        is missing or told twice.
    """
    try:
        # It takes two seconds to import, and only who has such a file needs it.
        from SurfaceTopography import open_topography
        from SurfaceTopography.Exceptions import CannotDetectFileFormat, UnknownFileFormat
    except ImportError as error:
        raise ValueError(
            f"{path.name}: reading {path.suffix or 'such'} files needs SurfaceTopography; type: "
            "pip install 'viscontact[surfaces]' (NPY, NPZ and CSV are read without it)"
        ) from error
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the formats' peculiarities
            with open_topography(str(path)) as file:
                found = _channel(path.name, file, channel)
                scale, told = _lengths(found, units)
                topography = file.topography(channel_index=found.index, **told)
                heights: Any = topography.heights()
    except (MemoryError, _RefusedError):
        raise
    except (CannotDetectFileFormat, UnknownFileFormat) as error:
        raise ValueError(
            f"{path.name}: cannot be read as a surface: its content is in no format that is known, "
            "or broken"
        ) from error
    except Exception as error:  # a reader of 42 formats raises whatever a broken file makes it
        why = str(error).splitlines()[0] if str(error).strip() else type(error).__name__
        raise ValueError(f"{path.name}: cannot be read as a surface: {why}") from error
    if not topography.is_uniform:
        raise ValueError(
            f"{path.name}: its points are unevenly spaced; bring them to an even mesh first"
        )
    return _surface(path.name, topography, heights, scale)


class _RefusedError(ValueError):
    """What is wrong is not the file."""


def _channel(name: str, file: Any, channel: str | None) -> Any:
    if channel is None:
        return file.default_channel
    found = [each for each in file.channels if each.name == channel]
    if not found:
        names = ", ".join(repr(each.name) for each in file.channels)
        raise _RefusedError(f"channel: {name} has no channel {channel!r}; there are {names}")
    return found[0]


def _lengths(found: Any, units: Units) -> tuple[float, dict[str, Any]]:
    """Metres in the unit of the channel, and what its reader is to be told."""
    try:
        if isinstance(found.unit, tuple):
            raise ValueError(
                f"channel: {found.name!r} of {units.name} holds no heights, but values in "
                f"{found.unit[1] or 'no unit'}; choose another"
            )
        told: dict[str, Any] = {}
        if found.unit is not None:
            units.require_none("height_unit")
            scale = parse_unit(str(found.unit), "length")
        else:
            scale = units.height_scale
            told["unit"] = units.height_unit
        if found.physical_sizes is not None:
            units.require_none("spacing")
        else:
            given = units.steps
            steps = given if isinstance(given, tuple) else (given,) * len(found.nb_grid_pts)
            told["physical_sizes"] = tuple(
                n * step / scale for n, step in zip(found.nb_grid_pts, steps, strict=False)
            )
    except ValueError as error:
        raise _RefusedError(str(error)) from error
    return scale, told


def _surface(name: str, topography: Any, heights: Any, scale: float) -> Surface:
    values = np.ma.filled(np.ma.asarray(heights).astype(np.float64), np.nan) * scale
    values[np.isinf(values)] = np.nan
    spacing = [
        float(size) * scale / n
        for size, n in zip(topography.physical_sizes, topography.nb_grid_pts, strict=True)
    ]
    if values.ndim == 1:
        values, spacing = values[:, np.newaxis], spacing * 2
    steps = (spacing[0], spacing[1])
    return Surface(values, steps, name=name, periodic=bool(topography.is_periodic))
