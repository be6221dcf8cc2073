"""Height maps from files of profilers and microscopes, read by SurfaceTopography."""

from __future__ import annotations

import warnings
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.packed_files import read_packed
from viscontact.backend.record import Record
from viscontact.bodies.surfaces.bare_numbers import surface_of_places
from viscontact.bodies.surfaces.markers import without_markers
from viscontact.bodies.surfaces.point_tables import on_mesh
from viscontact.bodies.surfaces.surface import Surface
from viscontact.bodies.surfaces.units import Spacing, Units
from viscontact.units.parsing import parse_unit

# Files that hold other ones.
_PACKED = {
    b"PK\x03\x04": "it is a packed folder; unpack it, and name one of its files",
    b"\x1f\x8b": "it is packed; unpack it (gunzip)",
}


def read_instrument(path: Path, units: Units, channel: str | None) -> Surface:
    """Read a map, or a line scan, in a format that SurfaceTopography knows."""
    remedy = "thin the map out, or cut it, and export it as NPY or as a text"
    found = read_packed(path, _read, units, channel, prepare=_load_library, remedy=remedy)
    if "unknown" in found.values:
        raise UnknownFormatError(found.values["unknown"])
    if "positions" in found.arrays:
        return _line_scan(found, units)
    return _surface(path.name, found)


def _load_library() -> None:
    """Import SurfaceTopography, which takes two seconds, and which few files need."""
    with suppress(ImportError):
        import SurfaceTopography  # noqa: F401


def _read(path: Path, units: Units, channel: str | None) -> Record:
    """Heights and their unit, spacing or positions, or the reason why the format is `unknown`."""
    try:
        from SurfaceTopography import open_topography
        from SurfaceTopography.Exceptions import CannotDetectFileFormat, UnknownFileFormat
    except ImportError:
        why = (
            f"{path.name}: reading {path.suffix or 'such'} files needs SurfaceTopography; type: "
            "pip install 'viscontact[surfaces]' (NPY, NPZ and CSV are read without it)"
        )
        return Record({"unknown": why})
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about details of the formats
            with open_topography(str(path)) as file:
                return _content(path.name, file, units, channel)
    except (MemoryError, _RefusedError):
        raise
    except (CannotDetectFileFormat, UnknownFileFormat):
        why = f"{path.name}: cannot be read as a surface: {_unknown(path)}"
        return Record({"unknown": why})
    except Exception as error:  # 42 formats: a broken file may raise anything
        why = str(error).splitlines()[0] if str(error).strip() else type(error).__name__
        raise ValueError(
            f"{path.name}: cannot be read as a surface: it is broken, or of a kind that "
            f"SurfaceTopography does not read ({why}); export it as X3P, or as a text"
        ) from error


def _content(name: str, file: Any, units: Units, channel: str | None) -> Record:
    found = _channel(name, file, channel)
    if found.is_uniform is False:
        line = file.topography(channel_index=found.index)
        arrays = {"positions": line.positions(), "heights": _without_mask(line.heights())}
        return Record({"unit": _unit_of_heights(found, name)}, arrays)
    scale, spacing = _lengths(found, units)
    # SurfaceTopography needs a size; the caller's spacing replaces it below.
    sizes = {} if found.physical_sizes else {"physical_sizes": found.nb_grid_pts}
    topography = file.topography(channel_index=found.index, **sizes)
    if spacing is None:
        lengths = zip(topography.physical_sizes, topography.nb_grid_pts, strict=True)
        along = [float(size) * scale / n for size, n in lengths]
        spacing = along[0], along[-1]
    stated = {"scale": scale, "spacing": spacing, "periodic": bool(topography.is_periodic)}
    return Record(stated, {"heights": _without_mask(topography.heights())})


class UnknownFormatError(ValueError):
    """The content is in no format that SurfaceTopography knows, or this is not installed."""


class _RefusedError(ValueError):
    """Refusal that concerns the arguments, not the file."""


def _unknown(path: Path) -> str:
    """Reason why no reader takes a file."""
    with path.open("rb") as file:
        start = file.read(4)
    packed = next((words for mark, words in _PACKED.items() if start.startswith(mark)), None)
    return packed or "its content is in no format that is known, or broken"


def _channel(name: str, file: Any, channel: str | None) -> Any:
    if channel is None:
        return file.default_channel
    found = [each for each in file.channels if each.name == channel]
    if not found:
        names = ", ".join(repr(each.name) for each in file.channels)
        raise _RefusedError(f"channel: {name} has no channel {channel!r}; there are {names}")
    return found[0]


def _lengths(found: Any, units: Units) -> tuple[float, Spacing | None]:
    """Scale of the heights in metres, and the spacing [m] where the file does not state it."""
    try:
        unit = _unit_of_heights(found, units.name)
        if unit is None:  # then sizes in the file have no unit either
            return units.height_scale, units.steps
        units.require_none("height_unit")
        scale = parse_unit(unit, "length")
        if found.physical_sizes is None:
            return scale, units.steps
        units.require_none("spacing")
    except ValueError as error:
        raise _RefusedError(str(error)) from error
    return scale, None


def _unit_of_heights(found: Any, name: str) -> str | None:
    if isinstance(found.unit, tuple):
        raise _RefusedError(
            f"channel: {found.name!r} of {name} holds no heights, but values in "
            f"{found.unit[1] or 'no unit'}; choose another"
        )
    return None if found.unit is None else str(found.unit)


def _without_mask(heights: Any) -> Floats:
    """Heights with NaN where they are masked, in the memory of the given ones if possible."""
    if not isinstance(heights, np.ma.MaskedArray):
        return np.asarray(heights, dtype=np.float64)
    return np.asarray(np.ma.filled(heights.astype(np.float64, copy=False), np.nan))


def _line_scan(found: Record, units: Units) -> Surface:
    """Line scan of points whose positions are written, if they are even but for their rounding."""
    x, heights = (found.arrays[name] for name in ("positions", "heights"))
    if found.values["unit"] is None:
        return surface_of_places(units.name, (x, np.zeros_like(x)), heights, units)
    units.require_none()
    scale = parse_unit(found.values["unit"], "length")
    heights, notes = without_markers(heights)
    places = scale * x, np.zeros_like(x)
    return on_mesh(units.name, places, scale * heights, notes=notes)


def _surface(name: str, found: Record) -> Surface:
    values = np.array(found.arrays["heights"])
    values[np.isinf(values)] = np.nan
    values, notes = without_markers(values)
    values *= found.values["scale"]
    if values.ndim == 1:
        values = values[:, np.newaxis]
    along_x, along_y = np.broadcast_to(found.values["spacing"], 2).tolist()
    periodic = found.values["periodic"]
    return Surface(values, (along_x, along_y), name=name, periodic=periodic, notes=notes)
