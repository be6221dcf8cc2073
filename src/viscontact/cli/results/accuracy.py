"""What a run says of its own accuracy."""

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

#: How the memory of a series law begins to describe itself; there is nothing to doubt about it.
_EXACT = "recursion, exact"


def accuracy_lines(time_error: ArrayLike, memory: str, inversion_error: float) -> Iterator[str]:
    """Yield what is to be known of errors in time, as far as there is any.

    Parameters
    ----------
    time_error : array_like
        Estimated relative error of the pressure owed to the steps, at each instant [-].
    memory : str
        How the past was remembered, with its error if it has one.
    inversion_error : float
        Estimated relative error of a numerical conversion of the law [-].

    Yields
    ------
    str
        A line each.
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
    """Yield what the mark ``>`` in front of numbers means, where there are any.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    names : iterable of str
        The scalars that are printed.

    Yields
    ------
    str
        One line, or none.
    """
    found = {name: largest_error(ds, name) for name in names}
    marked = [name for name, each in found.items() if each and np.isposinf(each.half_width)]
    if marked:
        listed = " and ".join(name.replace("_", " ") for name in marked)
        verb = MESH_DEPENDENT if len(marked) == 1 else MESH_DEPENDENT.replace("depends", "depend")
        yield f"> {listed} {verb}: {WHY_MESH_DEPENDENT}"


def unknown_lines(ds: xr.Dataset, names: Sequence[str]) -> Iterator[str]:
    """Yield whose errors are not known everywhere.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    names : sequence of str
        The scalars that are printed.

    Yields
    ------
    str
        One line, or none.
    """
    count = ds.sizes["time"]
    found = {name: largest_error(ds, name) for name in names}
    places = {name: each.unknown for name, each in found.items() if each and each.unknown}
    if not knows_errors(ds, names) and places:
        done = ds.attrs.get("complete", 1)
        yield "errors: not known" + (
            "" if done else " yet; they are estimated once the run is over"
        )
    elif places:
        told = (f"{name.replace('_', ' ')} at {n} of {count}" for name, n in places.items())
        yield f"error not known: {', '.join(told)} instants"


def knows_errors(ds: xr.Dataset, names: Iterable[str]) -> bool:
    """Tell whether the error of any of these scalars is known at any instant.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    names : iterable of str
        The scalars.
    """
    found = (largest_error(ds, name) for name in names)
    return any(each is not None and not np.isnan(each.half_width) for each in found)


def has_errors(ds: xr.Dataset) -> bool:
    """Tell whether a result states errors of its scalars."""
    return any(error_name(str(name)) in ds for name in ds.data_vars)
