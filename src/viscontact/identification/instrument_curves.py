"""Force curves from files of atomic force microscopes, read by afmformats."""

from __future__ import annotations

import logging
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.packed_files import read_packed
from viscontact.backend.record import Record
from viscontact.identification.force_curve import ForceCurve, tabulated_curve
from viscontact.tables import read_table

#: Suffixes of the files that afmformats reads, without those of tables.
INSTRUMENT_FILES = (".jpk-force", ".jpk-force-map", ".jpk-qi-data", ".jpk-qi-series", ".h5", ".ibw")

#: Suffixes of tables.
TABLES = (".csv", ".txt", ".tsv", ".dat", ".xlsx", ".xls", ".ods")

# Texts with metadata in comments, as afmformats writes them: other tables have this suffix, too.
_EXPORTED, _METADATA, _FIRST_BYTES = ".tab", b"BEGIN METADATA", 10_000

_NUMBERED = re.compile(r"(?P<file>.+)#(?P<number>\d+)")
# The position that a sensor has measured comes before the one that was set at the piezo.
_POSITIONS = ("height (measured)", "height (piezo)")


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
    found = read_packed(
        *(file, _read, chosen, spring_constant),
        prepare=_load_library,
        remedy="save single curves, or export time, position and deflection as CSV",
    )
    stated = found.values["spring constant"]
    columns = found.arrays
    try:
        return ForceCurve(
            columns["time"],
            columns["position"],
            columns["force"] / stated,
            stated if spring_constant is None else spring_constant,
        )
    except ValueError as error:
        raise ValueError(f"{file.name}: {error}") from error


def _load_library() -> None:
    """Import afmformats, which takes half a second, and which few files need."""
    with suppress(ImportError):
        import afmformats  # noqa: F401


def _read(file: Path, number: int | None, spring_constant: float | None) -> Record:
    """Time, position and force of a curve, and the spring constant with which it was recorded."""
    name = file.name
    curve = _choose_curve(name, _load_curves(file, spring_constant), number)
    columns = {column: _column(name, curve, column) for column in ("time", "force")}
    position = next((each for each in _POSITIONS if each in curve.columns), None)
    if position is None:
        raise ValueError(f"{name}: states no position; there are {', '.join(curve.columns)}")
    stated = curve.metadata.get("spring constant", np.nan)
    if not stated > 0:
        if spring_constant is None:
            raise ValueError(
                f"{name}: states no spring constant; give it (--spring-constant, spring_constant=)"
            )
        stated = spring_constant
    columns["position"] = _column(name, curve, position)
    return Record({"spring constant": float(stated)}, columns)


def _load_curves(file: Path, spring_constant: float | None) -> list[Any]:
    """Curves of a file in the order of their numbers, as afmformats gives them."""
    try:
        import afmformats
        from afmformats.errors import MissingMetaDataError
    except ImportError as error:
        raise ValueError(
            f"{file.name}: reading force curves of instruments needs afmformats; type: "
            "pip install 'viscontact[afm]', or export time, position and deflection as CSV"
        ) from error
    with _refused_by_name(file.name):
        try:
            curves = afmformats.load_data(file)
        except MissingMetaDataError as error:
            if spring_constant is None or set(error.meta_keys) != {"spring constant"}:
                raise
            curves = afmformats.load_data(file, {"spring constant": spring_constant})
        # HDF5 sorts its curves as 0, 1, 10, 11, ..., 2.
        return sorted(curves, key=lambda curve: int(curve.enum))


@contextmanager
def _refused_by_name(name: str) -> Iterator[None]:
    """Raise ValueError for whatever afmformats raises at a file, which it would print as well."""
    from afmformats.errors import AFMFileFormatError, MissingMetaDataError

    log = logging.getLogger("afmformats")
    level = log.level
    log.setLevel(logging.CRITICAL + 1)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about details of the formats
            yield
    except MissingMetaDataError as error:
        keys = ", ".join(error.meta_keys)
        remedy = "give it (--spring-constant, spring_constant=)"
        if keys != "spring constant":
            remedy = "calibrate and save it again"
        raise ValueError(f"{name}: does not state: {keys}; {remedy}") from error
    # Errors of afmformats are no Exceptions, and a broken file may raise anything else, such as
    # "list index out of range".
    except (Exception, AFMFileFormatError) as error:
        raise ValueError(
            f"{name}: cannot be read as force curves; the file is damaged, or of another format: "
            "save it again, or export time, position and deflection as CSV"
        ) from error
    finally:
        log.setLevel(level)


def _choose_curve(name: str, curves: list[Any], number: int | None) -> Any:
    if not curves:
        raise ValueError(f"{name}: has no force curve")
    if number is None and len(curves) > 1:
        raise ValueError(
            f"{name}: has {len(curves)} curves; name one by its number, {name}#0 to "
            f"{name}#{len(curves) - 1}"
        )
    if not 0 <= (number or 0) < len(curves):
        raise ValueError(f"{name}: has no curve {number}; the last one is {len(curves) - 1}")
    return curves[number or 0]


def _column(name: str, curve: Any, column: str) -> Floats:
    if column not in curve.columns:
        raise ValueError(
            f"{name}: states no {column}; there are {', '.join(curve.columns)}; export time, "
            "position and deflection as CSV"
        )
    with _refused_by_name(name):
        return np.asarray(curve[column], dtype=np.float64)
