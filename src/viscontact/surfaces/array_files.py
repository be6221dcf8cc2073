"""Maps in NumPy's files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from viscontact.surfaces.surface import Surface
from viscontact.surfaces.units import Units
from viscontact.units import parse_unit


def read_array(path: Path, units: Units, channel: str | None) -> Surface:
    """Read a map from an NPY or NPZ file; its first index runs along x.

    Parameters
    ----------
    path : Path
        The file.
    units : Units
        What is told beside it.
    channel : str or None
        Which array of an NPZ holds the heights; ``"height"``, or the only one, if None.

    Returns
    -------
    Surface
        The map.

    Raises
    ------
    ValueError
        If it cannot be read, holds no such array, or a unit is missing or told twice.
    """
    try:
        # No pickles: a file of data must not run anything.
        with path.open("rb") as file:
            found: Any = np.load(file, allow_pickle=False)
            arrays = {} if isinstance(found, np.ndarray) else {k: found[k] for k in found.files}
    except Exception as error:  # NumPy raises what it happens on in a broken file
        raise ValueError(f"{path.name}: cannot be read as an array of numbers: {error}") from error
    if isinstance(found, np.ndarray):
        if channel is not None:
            raise ValueError(f"channel: {path.name} holds one array without a name; leave it out")
        return Surface(_lines(found) * units.height_scale, units.steps, name=path.name)
    return _from_arrays(path, arrays, units, channel)


def _from_arrays(path: Path, arrays: dict[str, Any], units: Units, channel: str | None) -> Surface:
    heights = _lines(_chosen(path, arrays, channel))
    periodic = bool(arrays.get("periodic", np.False_))
    if "unit" not in arrays:
        units_in = heights * units.height_scale
        return Surface(units_in, units.steps, name=path.name, periodic=periodic)
    units.require_none("height_unit")
    scale = parse_unit(str(arrays["unit"]), "length")
    steps: Any = units.steps if "spacing" not in arrays else None
    if steps is None:
        units.require_none("spacing")
        distances = np.atleast_1d(arrays["spacing"]).astype(float) * scale
        steps = tuple(distances.tolist()) if distances.size > 1 else float(distances[0])
    return Surface(heights * scale, steps, name=path.name, periodic=periodic)


def _chosen(path: Path, arrays: dict[str, Any], channel: str | None) -> Any:
    maps = [name for name, array in arrays.items() if array.ndim == 2]
    if channel is None:
        channel = "height" if "height" in arrays else (maps[0] if len(maps) == 1 else None)
    if channel not in arrays:
        wanted = "an array 'height'" if channel is None else f"the array {channel!r}"
        raise ValueError(
            f"channel: {path.name} is to hold {wanted}; there are {', '.join(arrays) or 'none'}"
        )
    return arrays[channel]


def _lines(array: Any) -> Any:
    """An array of numbers as a map; one with a single index is a line scan."""
    if array.dtype.kind not in "iufb":
        raise ValueError(f"heights must be numbers, got an array of {array.dtype}")
    return array[:, np.newaxis] if array.ndim == 1 else array.astype(np.float64)
