"""The scalars of a run at work, as its lines tell them: a part at a time, as they are written."""

from __future__ import annotations

import json
import math
from contextlib import suppress
from pathlib import Path
from typing import Any

from viscontact.runs.directory.recorded_run import PROGRESS_NAME

#: What is drawn while a run is at work.
QUANTITIES = ("contact_area", "approach", "peak_pressure")
#: At most so much is read at once [bytes].
_MOST = 1_000_000


def grown(directory: Path, after: int) -> dict[str, Any]:
    """Return what a run has written since somebody last asked.

    Parameters
    ----------
    directory : Path
        The run's.
    after : int
        How far its lines have been read [bytes]; 0 for all of them.

    Returns
    -------
    dict
        Instants [s] and scalars in SI units since then, `None` where they are no number; from
        where on they are, and how far they now have been read. What is read from 0 on replaces
        whatever was read before.
    """
    begun, lines = _lines(directory / PROGRESS_NAME, after)
    told: dict[str, list[float | None]] = {name: [] for name in ("time", *QUANTITIES)}
    for line in lines.splitlines():
        with suppress(ValueError, LookupError, TypeError):
            found = json.loads(line)
            values = {name: _number(found[name]) for name in told}
            for name, value in values.items():
                told[name].append(value)
    return {"begun": begun, "after": begun + len(lines), **told}


def _lines(path: Path, after: int) -> tuple[int, bytes]:
    """Whole lines from a place on; from the beginning where there are others now."""
    with suppress(OSError), path.open("rb") as file:
        size = file.seek(0, 2)
        begun = after if 0 <= after <= size else 0
        file.seek(begun)
        whole, newline, _ = file.read(_MOST).rpartition(b"\n")
        return begun, whole + newline
    return 0, b""


def _number(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else None
