"""Height maps from NumPy files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from viscontact.bodies.surfaces.markers import without_markers
from viscontact.bodies.surfaces.surface import Surface
from viscontact.bodies.surfaces.units import Units
from viscontact.units.parsing import parse_unit


def read_array(path: Path, units: Units, channel: str | None) -> Surface:
    """Read a map from an NPY or NPZ file, heights [x, y]; `channel` names an array of an NPZ."""
    try:
        # No pickles: a data file must not execute code.
        with path.open("rb") as file:
            found: Any = np.load(file, allow_pickle=False)
            arrays = {} if isinstance(found, np.ndarray) else {k: found[k] for k in found.files}
    except Exception as error:  # NumPy raises various errors for a broken file
        raise ValueError(f"{path.name}: cannot be read as an array of numbers: {error}") from error
    if isinstance(found, np.ndarray):
        if channel is not None:
            raise ValueError(f"channel: {path.name} holds one array without a name; leave it out")
        values, notes = without_markers(_lines(path.name, found))
        return Surface(values * units.height_scale, units.steps, name=path.name, notes=notes)
    return _from_arrays(path, arrays, units, channel)


def _from_arrays(path: Path, arrays: dict[str, Any], units: Units, channel: str | None) -> Surface:
    heights, notes = without_markers(_lines(path.name, _choose_array(path, arrays, channel)))
    stated: dict[str, Any] = {
        "name": path.name,
        "periodic": bool(np.all(arrays.get("periodic", False))),
        "notes": notes,
    }
    if "unit" not in arrays:
        return Surface(heights * units.height_scale, units.steps, **stated)
    units.require_none("height_unit")
    try:
        scale = parse_unit(str(arrays["unit"]), "length")
    except ValueError as error:
        raise ValueError(f"{path.name}: unit: {error}") from error
    if "spacing" not in arrays:
        return Surface(heights * scale, units.steps, **stated)
    units.require_none("spacing")
    steps = _steps(path.name, arrays["spacing"], scale)
    return Surface(heights * scale, steps, **stated)


def _steps(name: str, spacing: Any, scale: float) -> tuple[float, float]:
    if spacing.dtype.kind not in "iuf" or spacing.size not in (1, 2):
        raise ValueError(f"{name}: spacing must be one number or two, got {spacing.tolist()!r:.60}")
    along_x, along_y = np.broadcast_to(np.ravel(spacing), 2).astype(np.float64) * scale
    return float(along_x), float(along_y)


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
    return array[:, np.newaxis] if array.ndim == 1 else array.astype(np.float64)
