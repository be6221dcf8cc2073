"""Reading of force curves by afmformats, in a process of its own."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.record import Record

# The position that a sensor has measured comes before the one that was set at the piezo.
_POSITIONS = ("height (measured)", "height (piezo)")


def load_library() -> None:
    """Import afmformats, which takes half a second, and which few files need."""
    with suppress(ImportError):
        import afmformats  # noqa: F401


def read_curve(file: Path, number: int | None, spring_constant: float | None) -> Record:
    """Time, position and force of a curve, and the spring constant with which it was recorded."""
    curve = _choose_curve(file.name, _load_curves(file, spring_constant), number)
    return _columns_of(file.name, curve, spring_constant)


def count_curves(file: Path) -> Record:
    """Number of curves in a file."""
    return Record(len(_load_curves(file, 1.0)))


def read_all(file: Path, spring_constant: float | None) -> Record:
    """All curves of a file, or why one cannot be read, with their places."""
    values, arrays = [], {}
    for number, curve in enumerate(_load_curves(file, spring_constant)):
        stated: dict[str, Any] = {"place": _place(curve), "failure": ""}
        try:
            found = _columns_of(file.name, curve, spring_constant)
        except ValueError as error:
            stated["failure"] = str(error)
        else:
            stated.update(found.values)
            arrays.update({f"{number} {name}": each for name, each in found.arrays.items()})
        values.append(stated)
    return Record(values, arrays)


def _place(curve: Any) -> list[float] | None:
    """Place of a curve in its map [m], None where the file does not state it."""
    place = [_coordinate(curve, axis) for axis in "xy"]
    return place if np.isfinite(place).all() else None


def _coordinate(curve: Any, axis: str) -> float:
    """Coordinate of a curve, stated or that of its index in the grid; NaN without either [m]."""
    keys = ("position", "grid index", "grid shape", "grid size", "grid center")
    at, index, count, size, middle = (
        float(curve.metadata.get(f"{key} {axis}", np.nan)) for key in keys
    )
    return at if np.isfinite(at) else middle + ((index + 0.5) / count - 0.5) * size


def _columns_of(name: str, curve: Any, spring_constant: float | None) -> Record:
    """Time, position and force of a curve, and the spring constant with which it was recorded."""
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
