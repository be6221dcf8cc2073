"""Height maps from NumPy files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from viscontact.backend.packed_files import read_packed
from viscontact.backend.record import Record
from viscontact.bodies.surfaces.markers import without_markers
from viscontact.bodies.surfaces.surface import Surface
from viscontact.bodies.surfaces.units import Units
from viscontact.units.parsing import parse_unit


def read_array(path: Path, units: Units, channel: str | None) -> Surface:
    """Read a map from an NPY or NPZ file, heights [x, y]; `channel` names an array of an NPZ."""
    remedy = "thin the map out, or cut it, and save it as NPY, which is not packed"
    found = read_packed(path, _load, channel, remedy=remedy)
    values, notes = without_markers(found.arrays["heights"])
    stated: dict[str, Any] = {
        "name": path.name,
        "periodic": found.values["periodic"],
        "notes": notes,
    }
    unit = found.values["unit"]
    if unit is None:
        return Surface(values * units.height_scale, units.steps, **stated)
    units.require_none("height_unit")
    try:
        scale = parse_unit(unit, "length")
    except ValueError as error:
        raise ValueError(f"{path.name}: unit: {error}") from error
    spacing = found.values["spacing"]
    if spacing is None:
        return Surface(values * scale, units.steps, **stated)
    units.require_none("spacing")
    along_x, along_y = (step * scale for step in spacing)
    return Surface(values * scale, (along_x, along_y), **stated)


def _load(path: Path, channel: str | None) -> Record:
    """Heights as they are in the file, with its unit, spacing (two numbers) and `periodic`."""
    try:
        # No pickles: a data file must not execute code.
        with path.open("rb") as file:
            found: Any = np.load(file, allow_pickle=False)
            arrays = {} if isinstance(found, np.ndarray) else {k: found[k] for k in found.files}
    except MemoryError:
        raise
    except Exception as error:  # NumPy raises various errors for a broken file
        raise ValueError(f"{path.name}: cannot be read as an array of numbers: {error}") from error
    if isinstance(found, np.ndarray):
        if channel is not None:
            raise ValueError(f"channel: {path.name} holds one array without a name; leave it out")
        unstated = {"periodic": False, "unit": None, "spacing": None}
        return Record(unstated, {"heights": _lines(path.name, found)})
    heights = _lines(path.name, _choose_array(path, arrays, channel))
    stated: dict[str, Any] = {
        "periodic": bool(np.all(arrays.get("periodic", False))),
        "unit": str(arrays["unit"]) if "unit" in arrays else None,
        "spacing": _steps(path.name, arrays["spacing"]) if _states_spacing(arrays) else None,
    }
    return Record(stated, {"heights": heights})


def _states_spacing(arrays: dict[str, Any]) -> bool:
    """True if there is a spacing with its unit."""
    return "spacing" in arrays and "unit" in arrays


def _steps(name: str, spacing: Any) -> list[float]:
    if spacing.dtype.kind not in "iuf" or spacing.size not in (1, 2):
        raise ValueError(f"{name}: spacing must be one number or two, got {spacing.tolist()!r:.60}")
    steps: list[float] = np.broadcast_to(np.ravel(spacing), 2).astype(np.float64).tolist()
    return steps


def _choose_array(path: Path, arrays: dict[str, Any], channel: str | None) -> Any:
    maps = [name for name, array in arrays.items() if array.ndim == 2]
    if channel is None:
        channel = "height" if "height" in arrays else (maps[0] if len(maps) == 1 else None)
    if channel not in arrays:
        wanted = "an array 'height'" if channel is None else f"the array {channel!r}"
        raise ValueError(
            f"channel: {path.name} must hold {wanted}; it has {', '.join(arrays) or 'none'}"
        )
    return arrays[channel]


def _lines(name: str, array: Any) -> Any:
    """Numeric array as a map; a one-dimensional one is a line scan."""
    if array.dtype.kind not in "iufb":
        raise ValueError(f"{name}: heights must be numbers, got an array of {array.dtype}")
    lines = array[:, np.newaxis] if array.ndim == 1 else array
    return lines.astype(np.float64, copy=False)
