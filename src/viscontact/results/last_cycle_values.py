"""Worst values of a run over time: the largest beside the end, and the range of the last cycle."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.formatting import format_scalar
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.run_axis import run_axis
from viscontact.units.formatting import format_quantity

if TYPE_CHECKING:
    from viscontact.results.stored_result import Result

#: Least part by which the largest value exceeds another one to be worth stating [-].
_NOTABLE = 1e-3


#: Relative difference of values that are equal, from the tolerance of runs [-].
_EQUAL = 1e-5


def first_largest(sizes: Floats) -> int:
    """Index of the first of the largest values, which may differ by rounding."""
    return int(np.flatnonzero(sizes >= sizes.max() - _EQUAL * abs(sizes.max()))[0])


def notable_largest(ds: Result, name: str, shown: int) -> int | None:
    """Index of the largest magnitude of a scalar; None if it hardly exceeds the one at `shown`."""
    sizes = np.nan_to_num(np.abs(ds[name].values))
    largest = first_largest(sizes)
    return largest if sizes[largest] > (1 + _NOTABLE) * sizes[shown] else None


@dataclass(frozen=True)
class LoadCycle:
    """Cycle of the load: its times [s], and the indices of the first and last instant in it."""

    begin: float
    end: float
    first: int
    last: int

    def extremes(self, ds: Result, name: str) -> tuple[int, int] | None:
        """Indices of the least and the largest value of a scalar; None if all are NaN."""
        values = ds[name].values[self.first : self.last + 1]
        if np.isnan(values).all():
            return None
        return self.first + int(np.nanargmin(values)), self.first + int(np.nanargmax(values))

    def range_of(self, ds: Result, name: str) -> str:
        """Least and largest value of a scalar, as "2 ± 0.1 MPa to 3 MPa"."""
        found = self.extremes(ds, name)
        if found is None:
            return "not known"
        low, high = (float(ds[name][index]) for index in found)
        texts = [format_scalar(ds, name, index) for index in found]
        return texts[1] if high - low <= _NOTABLE * abs(high) else " to ".join(texts)


def last_cycle(ds: Result, *, least: int = 2) -> LoadCycle | None:
    """Last whole cycle of the load; None if the load has fewer than `least` cycles."""
    if not run_axis(ds).is_history:
        return None
    try:
        load = recorded_object(ds, "load", "summary")
    except (ValueError, AttributeError, json.JSONDecodeError):  # no record, or only its digest
        return None
    times, cycles = ds["time"].values, load.load_cycles if load is not None else ()
    whole = [(begin, end) for (begin, _), (end, _) in cycles if end <= times[-1] * (1 + 1e-9)]
    if len(cycles) < least or not whole:
        return None
    first, last = (int(np.abs(times - moment).argmin()) for moment in whole[-1])
    return LoadCycle(*whole[-1], first, last) if last - first > 1 else None


def worst_places(ds: Result, name: str, shown: int) -> dict[str, Any]:
    """Indices of the extremes in the last `cycle`, and of the notable `largest`; None if none."""
    if not run_axis(ds).is_history:
        return {"cycle": None, "largest": None}
    cycle = last_cycle(ds)
    extremes = cycle.extremes(ds, name) if cycle else None
    sizes = np.abs(ds[name].values)
    known = [shown, *(extremes or ())]
    return {
        "cycle": extremes,
        "largest": notable_largest(ds, name, max(known, key=lambda index: float(sizes[index]))),
    }


def worst_notes(ds: Result, name: str, shown: int) -> list[str]:
    """Notes beside a value at an index: the range of the last cycle, the largest of the run."""
    places, notes = worst_places(ds, name, shown), []
    if places["cycle"] is not None and (cycle := last_cycle(ds)) is not None:
        notes.append(f"last cycle: {cycle.range_of(ds, name)}")
    if (at := places["largest"]) is not None:
        when = format_quantity(float(ds["time"][at]), "s")
        notes.append(f"largest: {format_scalar(ds, name, at)} at t = {when}")
    return notes
