"""Sizes that a netCDF file states, which may be any in a damaged or foreign file."""

from __future__ import annotations

from math import prod
from pathlib import Path
from typing import Any

import netCDF4

from viscontact.backend.reading_limits import ReadingLimits, reading_limits


class StatedSizeError(ValueError):
    """A variable is larger than any in a file of this size."""


def require_stated_sizes(file: Path) -> None:
    """StatedSizeError if a part of a variable that is read at once needs too much memory."""
    limits = reading_limits(file)
    with netCDF4.Dataset(str(file)) as opened:
        for name, variable in opened.variables.items():
            stated = _read_at_once(variable)
            if stated > limits.memory:
                raise StatedSizeError(_refusal(name, stated, limits))


def _read_at_once(variable: netCDF4.Variable[Any]) -> int:
    """Size of a whole variable, or of one instant of a field, and at least that of a chunk [B]."""
    points = prod(variable.shape[-2:])
    chunks = variable.chunking()
    if isinstance(chunks, list):
        points = max(points, prod(chunks))
    return points * getattr(variable.dtype, "itemsize", 8)


def _refusal(name: str, stated: int, limits: ReadingLimits) -> str:
    return (
        f"its variable {name} has {stated / 1e9:.3g} GB according to its header, in a file of "
        f"{limits.size / 1e6:.3g} MB; it is damaged, or no result: compute it anew"
    )
