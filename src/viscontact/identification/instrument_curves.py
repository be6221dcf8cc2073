"""Force curves from files of atomic force microscopes, read by afmformats."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from viscontact.backend.arrays import Floats
from viscontact.backend.packed_files import read_packed
from viscontact.backend.record import Record
from viscontact.identification.force_curve import ForceCurve, tabulated_curve
from viscontact.identification.instrument_reader import load_library, read_curve
from viscontact.tables import read_table

#: Suffixes of the files that afmformats reads, without those of tables.
INSTRUMENT_FILES = (".jpk-force", ".jpk-force-map", ".jpk-qi-data", ".jpk-qi-series", ".h5", ".ibw")

#: Suffixes of tables.
TABLES = (".csv", ".txt", ".tsv", ".dat", ".xlsx", ".xls", ".ods")

# Texts with metadata in comments, as afmformats writes them: other tables have this suffix, too.
_EXPORTED, _METADATA, _FIRST_BYTES = ".tab", b"BEGIN METADATA", 10_000

_NUMBERED = re.compile(r"(?P<file>.+)#(?P<number>\d+)")


def split_number(path: Path) -> tuple[Path, int | None]:
    """File and number of a curve, such as ``map.jpk-force-map#12``; None without a number."""
    found = _NUMBERED.fullmatch(path.name)
    if found is None or path.exists():
        return path, None
    return path.with_name(found["file"]), int(found["number"])


def is_instrument_file(path: Path) -> bool:
    """True for a file of an instrument, with or without the number of a curve."""
    file = split_number(path)[0]
    return file.suffix.lower() in INSTRUMENT_FILES or _is_exported_curve(file)


def _is_exported_curve(file: Path) -> bool:
    """True for a text as afmformats exports it: names in a comment, in SI units, and metadata."""
    if file.suffix.lower() != _EXPORTED or not file.is_file():
        return False
    with file.open("rb") as opened:
        return _METADATA in opened.read(_FIRST_BYTES)


def read_force_curve(
    path: str | PathLike[str], number: int | None = None, *, spring_constant: float | None = None
) -> ForceCurve:
    """Read a force curve from a file of an atomic force microscope, or from a table.

    The formats are those of afmformats: JPK (Bruker) curves and maps, and its own HDF5; and tables
    of time, position, and deflection or force, for which the spring constant is given. The
    position is that of the sensor, or of the piezo where there is none; the deflection is the force
    in the file over the spring constant in the file.

    Parameters
    ----------
    path : path-like
        The file, and for a curve of a map its number, from 0, behind ``#``: "map.jpk-force-map#12".
    number : int, optional
        The number, from 0, instead of that in `path`.
    spring_constant : float, optional
        Spring constant [N/m] from a later calibration, in place of the one in the file, or where
        the file has none. The deflection does not change, the force does.

    Returns
    -------
    ForceCurve
        For `find_contact`.

    Raises
    ------
    ValueError
        If afmformats is missing or cannot read the file, if the file has several curves and no
        number is given, or lacks times, a position, the force or the spring constant.
    OSError
        If there is no such file.

    Examples
    --------
    >>> curve = read_force_curve("cell.jpk-force")  # doctest: +SKIP
    >>> contact = find_contact(curve, Sphere(5e-6))  # doctest: +SKIP
    """
    file, behind = split_number(Path(path))
    if not file.is_file():
        raise FileNotFoundError(f"{file}: there is no such file")
    chosen = behind if number is None else number
    if file.suffix.lower() in TABLES and not is_instrument_file(file):
        if chosen is not None:
            raise ValueError(f"{file.name}: a table has one curve, got the number {chosen}")
        if spring_constant is None:
            raise ValueError(f"{file.name}: a table needs spring_constant=, in N/m")
        return tabulated_curve(read_table(file), spring_constant)
    found = read_apart(file, read_curve, chosen, spring_constant)
    return recorded_curve(file, found.values["spring constant"], found.arrays, spring_constant)


def read_apart(file: Path, read: Callable[..., Record], *arguments: Any) -> Record:
    """Return what is read from a file by afmformats, in another process."""
    if not file.is_file():
        raise FileNotFoundError(f"{file}: there is no such file")
    return read_packed(
        *(file, read, *arguments),
        prepare=load_library,
        remedy="save single curves, or export time, position and deflection as CSV",
    )


def recorded_curve(
    file: Path, stated: float, columns: Mapping[str, Floats], spring_constant: float | None
) -> ForceCurve:
    """Return the curve of columns that were recorded with a stated spring constant [N/m]."""
    try:
        return ForceCurve(
            columns["time"],
            columns["position"],
            columns["force"] / stated,
            stated if spring_constant is None else spring_constant,
        )
    except ValueError as error:
        raise ValueError(f"{file.name}: {error}") from error
