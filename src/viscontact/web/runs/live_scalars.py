"""Scalars of an active run, read from its progress lines as they are written."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from viscontact.results.run_axis import SPEED, TIME
from viscontact.results.variables import SCALARS, Place, labels_in
from viscontact.run_files import PROGRESS_NAME
from viscontact.runs.directory.progress_log import reached_in
from viscontact.units.formatting import format_quantity

#: Largest part that is read at once [bytes].
_MOST = 1_000_000


def grown(directory: Path, after: int) -> dict[str, Any]:
    """Return times [s] or speeds [m/s] and scalars [SI] after a position in the lines [bytes].

    Values that are not finite are None. `begun` is the position of the first line returned: 0 means
    that earlier values are replaced; `after` is the position for the next call. `reached` and
    `texts` are the place and the scalars of the last line, in words; empty without a line.
    """
    begun, lines = _lines(directory / PROGRESS_NAME, after)
    labels = labels_in(Place.LIVE)
    places: list[float] = []
    scalars: dict[str, list[float | None]] = {name: [] for name in labels}
    written: set[str] = set()
    last: dict[str, Any] = {}
    for line in lines.splitlines():
        with suppress(ValueError, LookupError, TypeError):
            found = json.loads(line)
            places.append(reached_in(found))
            written.update(found)
            last = found
            for name, values in scalars.items():
                values.append(_finite(found.get(name)))
    for name in scalars.keys() - written if places else ():  # such as friction without motion
        del labels[name], scalars[name]
    return {
        **{"begun": begun, "after": begun + len(lines), "labels": labels},
        **{"reached": _place(last), "texts": _texts(last, labels)},
        **{"speed" if "speed" in written else "time": places, "scalars": scalars},
    }


def _place(line: Mapping[str, Any]) -> str:
    if not line:
        return ""
    return (SPEED if "speed" in line else TIME).place(reached_in(line), 6)


def _texts(line: Mapping[str, Any], names: Iterable[str]) -> dict[str, str]:
    values = {name: _finite(line.get(name)) for name in names}
    return {
        name: format_quantity(value, SCALARS[name].units, 4)
        for name, value in values.items()
        if value is not None
    }


def _lines(path: Path, after: int) -> tuple[int, bytes]:
    """Complete lines from a position; from the beginning where the file has been replaced."""
    with suppress(OSError), path.open("rb") as file:
        size = file.seek(0, 2)
        begun = after if 0 < after <= size else 0
        # In another file, shorter or with longer lines, no line begins at that position.
        file.seek(max(begun - 1, 0))
        if begun and file.read(1) != b"\n":
            begun = 0
        file.seek(begun)
        whole, newline, _ = file.read(_MOST).rpartition(b"\n")
        return begun, whole + newline
    return 0, b""


def _finite(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else None
