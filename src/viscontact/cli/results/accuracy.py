"""Lines about the accuracy of a result."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from viscontact.results.formatting import format_bound
from viscontact.results.run_axis import run_axis
from viscontact.results.stated_errors import (
    WHY_MESH_DEPENDENT,
    largest_error,
)
from viscontact.results.variables import MESH_DEPENDENT, error_name

if TYPE_CHECKING:
    from viscontact.results.stored_result import Result

#: First words of the description of an exact hereditary integral, which needs no line.
_EXACT = "recursion, exact"


def accuracy_lines(ds: Result, names: Sequence[str]) -> Iterator[str]:
    """Yield lines about errors of scalars, the time integration, the layers and the law."""
    yield from _unknown_lines(ds, names)
    yield from _mesh_lines(ds, names)
    memory = str(ds.attrs.get("memory", ""))
    inversion_error = float(ds.attrs.get("inversion_error", 0.0))
    splitting_error = float(ds.attrs.get("splitting_error", 0.0))
    largest = float(np.nanmax(ds["time_error"].values, initial=0.0)) if "time_error" in ds else 0.0
    if largest > 0:
        yield f"error due to the time steps: {format_bound(largest)} of the pressure (estimated)"
    if memory and not memory.startswith(_EXACT):
        yield f"memory: {memory}"
    if splitting_error > 0:
        yield f"error of the layers' creep by its separation: {format_bound(splitting_error)}"
    ends_error = float(ds.attrs.get("ends_error", 0.0))
    if ends_error > 0:
        yield f"error of the operator of free ends: {format_bound(ends_error)} of the displacement"
    if (left := float(ds.attrs.get("end_stress_left", 0.0))) > 0:
        yield f"stress left on free ends: {format_bound(left)} of the peak pressure"
    if inversion_error > 0:
        yield (
            f"the law was converted numerically; error: {format_bound(inversion_error)} (estimated)"
        )


def _mesh_lines(ds: Result, names: Iterable[str]) -> Iterator[str]:
    """Yield the meaning of the mark ``>``, where a scalar has it."""
    found = {name: largest_error(ds, name) for name in names}
    marked = [name for name, each in found.items() if each and np.isposinf(each.half_width)]
    if marked:
        listed = " and ".join(name.replace("_", " ") for name in marked)
        verb = MESH_DEPENDENT if len(marked) == 1 else MESH_DEPENDENT.replace("depends", "depend")
        yield f"> {listed} {verb}: {WHY_MESH_DEPENDENT}"


def _unknown_lines(ds: Result, names: Sequence[str]) -> Iterator[str]:
    """Yield a line about scalars whose errors are unknown at some instants."""
    axis = run_axis(ds)
    count = ds.sizes[axis.name]
    found = {name: largest_error(ds, name) for name in names}
    places = {name: each.unknown for name, each in found.items() if each and each.unknown}
    if not knows_errors(ds, names) and places:
        done = ds.attrs.get("complete", 1)
        yield "errors: not known" + (
            "" if done else " yet; they are estimated once the run is over"
        )
    elif places:
        unknown = (f"{name.replace('_', ' ')} at {n} of {count}" for name, n in places.items())
        yield f"error not known: {', '.join(unknown)} {axis.row}s"


def knows_errors(ds: Result, names: Iterable[str]) -> bool:
    """Return whether the error of any of these scalars is known at any instant."""
    found = (largest_error(ds, name) for name in names)
    return any(each is not None and not np.isnan(each.half_width) for each in found)


def has_errors(ds: Result) -> bool:
    """Return whether a result states errors of its scalars."""
    return any(error_name(str(name)) in ds for name in ds.data_vars)
