"""Scalars of an active run, read from its progress lines as they are written."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.drawing.content.look import Look
from viscontact.drawing.plotly.growing import growing
from viscontact.drawing.plotly.parts import plain
from viscontact.results.line_digests import read_entries
from viscontact.results.run_axis import SPEED, TIME, RunAxis
from viscontact.results.run_files import PROGRESS_NAME
from viscontact.results.variables import SCALARS, Place, labels_in
from viscontact.runs.directory.progress_log import reached_in
from viscontact.units.formatting import format_quantity

#: Largest part that is read at once [bytes].
_MOST = 1_000_000


def grown(directory: Path, after: int) -> dict[str, Any]:
    """Times [s] or speeds [m/s] and scalars [SI] after a position in the lines [bytes]."""
    # `begun` is the position of the first line returned: 0 means that earlier values are replaced;
    # `after` is the position for the next call. `reached` and `texts` are the place and the scalars
    # of the last line, in words. Values that are not finite are None.
    begun, lines = _lines(directory / PROGRESS_NAME, after)
    labels = labels_in(Place.LIVE)
    places: list[float] = []
    scalars: dict[str, list[float | None]] = {name: [] for name in labels}
    written: set[str] = set()
    last: dict[str, Any] = {}
    for line in lines.splitlines():
        with suppress(ValueError, LookupError, TypeError):
            found = read_entries(line)
            places.append(reached_in(found))
            written.update(found)
            last = found
            for name, values in scalars.items():
                values.append(_finite(found.get(name)))
    if places:  # there is no friction without motion, for example
        labels = labels_in(Place.LIVE, written)
        scalars = {name: scalars[name] for name in labels}
    return {
        **{"begun": begun, "after": begun + len(lines), "labels": labels},
        **{"reached": _place_of(last), "texts": _texts(last, labels)},
        **{"speed" if "speed" in written else "time": places, "scalars": scalars},
    }


class LiveScalars:
    """All scalars of an active run so far; of its lines, only the new ones are read."""

    def __init__(self, directory: Path) -> None:
        self._directory, self._lock = directory, threading.Lock()
        self._forget_lines()

    def _forget_lines(self) -> None:
        self._after, self.places, self.reached = 0, list[float](), ""
        self.scalars: dict[str, list[float | None]] = {}
        self.texts: dict[str, str] = {}

    def drawn(self, axis: RunAxis, ends: tuple[float, float], look: Look) -> dict[str, Any]:
        """Return the number of states, the last one in words, and a figure of each scalar."""
        with self._lock:
            self._read_lines()
            figures = {
                name: growing(name, self.places, np.array(values, dtype=float), axis, ends, look)
                for name, values in self.scalars.items()
            }
            return {
                **{"count": len(self.places), "reached": self.reached, "texts": self.texts},
                "figures": {name: plain(figure) for name, figure in figures.items()},
            }

    def _read_lines(self) -> None:
        found = grown(self._directory, self._after)
        if found["begun"] == 0:
            self._forget_lines()
        self._after = found["after"]
        places = found.get("speed", found.get("time"))
        if not places:
            return
        # A resumed run may have written some lines again.
        kept = self.places.index(places[0]) if places[0] in self.places else len(self.places)
        self.places[kept:] = places
        for name, values in found["scalars"].items():
            self.scalars.setdefault(name, [])[kept:] = values
        self.reached, self.texts = found["reached"], found["texts"]


def _place_of(line: Mapping[str, Any]) -> str:
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
