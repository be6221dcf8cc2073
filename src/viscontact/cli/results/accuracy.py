"""Lines on the accuracy of a run below its tables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.results.formatting import format_bound
from viscontact.results.stated_errors import (
    MESH_DEPENDENT,
    WHY_MESH_DEPENDENT,
    largest_error,
)
from viscontact.results.variables import error_name

#: Begin of the description of the memory of a series law, which is exact.
_EXACT = "recursion, exact"


def accuracy_lines(time_error: ArrayLike, memory: str, inversion_error: float) -> Iterator[str]:
    """Yield lines on the errors of the time steps, the memory and the law.

    Parameters
    ----------
    time_error : array_like
        Estimated relative error of the pressure owed to the steps, at each instant [-].
    inversion_error : float
        Estimated relative error of a numerical conversion of the law [-].
    """
    largest = float(np.nanmax(np.asarray(time_error, dtype=float), initial=0.0))
    if largest > 0:
        yield f"error owed to the time steps: {format_bound(largest)} of the pressure (estimated)"
    if memory and not memory.startswith(_EXACT):
        yield f"memory: {memory}"
    if inversion_error > 0:
        yield (
            f"the law was converted numerically; error: {format_bound(inversion_error)} (estimated)"
        )


def mesh_lines(ds: xr.Dataset, names: Iterable[str]) -> Iterator[str]:
    """Yield the meaning of the mark ``>`` in front of numbers, where there are any."""
    found = {name: largest_error(ds, name) for name in names}
    marked = [name for name, each in found.items() if each and np.isposinf(each.half_width)]
    if marked:
        listed = " and ".join(name.replace("_", " ") for name in marked)
        verb = MESH_DEPENDENT if len(marked) == 1 else MESH_DEPENDENT.replace("depends", "depend")
        yield f"> {listed} {verb}: {WHY_MESH_DEPENDENT}"


def unknown_lines(ds: xr.Dataset, names: Sequence[str]) -> Iterator[str]:
    """Yield the scalars whose errors are not known everywhere."""
    count = ds.sizes["time"]
    found = {name: largest_error(ds, name) for name in names}
    places = {name: each.unknown for name, each in found.items() if each and each.unknown}
    if not knows_errors(ds, names) and places:
        done = ds.attrs.get("complete", 1)
        yield "errors: not known" + (
            "" if done else " yet; they are estimated once the run is over"
        )
    elif places:
        counts = (f"{name.replace('_', ' ')} at {n} of {count}" for name, n in places.items())
        yield f"error not known: {', '.join(counts)} instants"


def knows_errors(ds: xr.Dataset, names: Iterable[str]) -> bool:
    """Whether the error of any of these scalars is known at any instant."""
    found = (largest_error(ds, name) for name in names)
    return any(each is not None and not np.isnan(each.half_width) for each in found)


def has_errors(ds: xr.Dataset) -> bool:
    """Whether a result states errors of its scalars."""
    return any(error_name(str(name)) in ds for name in ds.data_vars)
