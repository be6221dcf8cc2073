"""Scalars of a run at work, read from its progress lines as they are written."""

from __future__ import annotations

import json
import math
from contextlib import suppress
from pathlib import Path
from typing import Any

from viscontact.results.variables import Place, labels_in
from viscontact.run_files import PROGRESS_NAME

#: At most so much is read at once [bytes].
_MOST = 1_000_000


def grown(directory: Path, after: int) -> dict[str, Any]:
    """Return what a run has written since it was last read.

    Parameters
    ----------
    directory : Path
        The run's.
    after : int
        How far its lines have been read [bytes]; 0 for all of them.

    Returns
    -------
    dict
        Labels of the scalars, and instants [s] and scalars in SI units since then, `None` where
        they are not a number; from where on they are, and how far they have now been read. What
        is read from 0 on replaces whatever was read before.
    """
    begun, lines = _lines(directory / PROGRESS_NAME, after)
    labels = labels_in(Place.LIVE)
    times: list[float | None] = []
    scalars: dict[str, list[float | None]] = {name: [] for name in labels}
    for line in lines.splitlines():
        with suppress(ValueError, LookupError, TypeError):
            found = json.loads(line)
            time, *values = (_finite(found[name]) for name in ("time", *scalars))
            times.append(time)
            for name, value in zip(scalars, values, strict=True):
                scalars[name].append(value)
    return {
        **{"begun": begun, "after": begun + len(lines), "labels": labels},
        **{"time": times, "scalars": scalars},
    }


def _lines(path: Path, after: int) -> tuple[int, bytes]:
    """Whole lines from a place on; from the beginning where there are others now."""
    with suppress(OSError), path.open("rb") as file:
        size = file.seek(0, 2)
        begun = after if 0 <= after <= size else 0
        file.seek(begun)
        whole, newline, _ = file.read(_MOST).rpartition(b"\n")
        return begun, whole + newline
    return 0, b""


def _finite(value: Any) -> float | None:
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else None
