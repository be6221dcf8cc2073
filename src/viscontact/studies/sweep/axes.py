"""Dimensions and coordinates of a sweep: its varied keys, or the number of the run."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.sweep.manifest import SweepRun
from viscontact.units.parsing import parse_any_quantity, parse_quantity

#: Dimension of runs that form no grid, and coordinate of a grid.
RUN = "run"
#: Dimension or coordinate of several case files.
CASE = "case"

#: Number and unit as they are typed.
_TYPED = re.compile(r"\s*[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?P<unit>[^\d±]*)")
#: Ends of keys of temperature differences, whose degrees have no offset.
_DIFFERENCES = ("c2", "temperature.amplitude")


@dataclass(frozen=True)
class SweepAxes:
    """Dimensions of the runs of a sweep, whose order is that of the manifest, last key fastest."""

    dims: tuple[str, ...]
    shape: tuple[int, ...]
    coords: dict[str, xr.Variable]
    keys: tuple[str, ...]  # coordinates that hold varied keys or cases


def sweep_axes(runs: Sequence[SweepRun]) -> SweepAxes:
    """Return the dimensions of a sweep: varied keys and cases of a grid, else ``run``."""
    columns = {key: [run.settings.get(key, "") for run in runs] for key in _varied_keys(runs)}
    cases = [run.case for run in runs]
    if len(set(cases)) > 1:
        columns = {CASE: cases, **columns}
    grid = _grid_axes(columns) if all(run.design == "grid" for run in runs) else {}
    dims, shape = tuple(grid) or (RUN,), tuple(map(len, grid.values())) or (len(runs),)
    about = {"long_name": "number of the run"}
    coords = {RUN: xr.Variable(dims, np.arange(len(runs)).reshape(shape), about)}
    names = np.array([run.name for run in runs], dtype=np.str_).reshape(shape)
    coords["name"] = xr.Variable(dims, names, {"long_name": "name of the run"})
    if grid:
        coords |= {key: coordinate(key, key, texts) for key, texts in grid.items()}
    else:
        coords |= {key: coordinate(key, RUN, texts) for key, texts in columns.items()}
    return SweepAxes(dims, shape, coords, tuple(columns))


def _varied_keys(runs: Sequence[SweepRun]) -> list[str]:
    """All varied keys, in the order of their first appearance."""
    return list(dict.fromkeys(key for run in runs for key in run.varied))


def _grid_axes(columns: dict[str, list[str]]) -> dict[str, list[str]]:
    """Values along each key if the runs are all combinations in order; else empty."""
    axes = {key: list(dict.fromkeys(texts)) for key, texts in columns.items()}
    counts = [len(values) for values in axes.values()]
    rows = len(next(iter(columns.values()), []))
    if not counts or math.prod(counts) != rows:
        return {}
    places = np.unravel_index(np.arange(rows), counts)
    for (key, texts), at in zip(columns.items(), places, strict=True):
        values = axes[key]
        if any(values[place] != text for place, text in zip(at.tolist(), texts, strict=True)):
            return {}
    return axes


def coordinate(key: str, dim: str, texts: Sequence[str]) -> xr.Variable:
    """Coordinate of a key: numbers in SI with their unit, or text if a value is no quantity."""
    attributes: dict[str, Any] = {"long_name": key}
    with suppress(ValueError):
        numbers, units = _numbers(key, texts)
        typed = {"typed_unit": symbol} if (symbol := _typed_unit(texts)) else {}
        return xr.Variable(dim, numbers, {"units": units, **attributes, **typed})
    return xr.Variable(dim, np.array(texts, dtype=np.str_), attributes)


def _typed_unit(texts: Sequence[str]) -> str:
    """Unit that all quantities are typed in, as ``mm``; empty where they differ or have none."""
    found = {match["unit"].strip() for text in texts if text and (match := _TYPED.fullmatch(text))}
    return found.pop() if len(found) == 1 else ""


def _numbers(key: str, texts: Sequence[str]) -> tuple[Floats, str]:
    """SI values and unit of quantities of one dimension, NaN where none; ValueError for others."""
    found = [_parse_value(key, text) if text else None for text in texts]
    units = {each[1] for each in found if each is not None}
    if len(units) != 1:
        raise ValueError("the values are not of one dimension")
    return np.array([math.nan if each is None else each[0] for each in found]), units.pop()


def _parse_value(key: str, text: str) -> tuple[float, str]:
    if (
        f".{key}".endswith(tuple(f".{end}" for end in _DIFFERENCES))
        and not text.replace(".", "").isdecimal()
    ):
        return parse_quantity(text, "temperature difference"), "K"
    return parse_any_quantity(text)
