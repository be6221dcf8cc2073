"""What a run says of its own accuracy."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from viscontact.stated_errors import (
    MESH_DEPENDENT,
    WHY_MESH_DEPENDENT,
    stated_error,
)
from viscontact.variables import error_name

#: How the memory of a series law begins to describe itself; there is nothing to doubt about it.
_EXACT = "recursion, exact"


@dataclass(frozen=True)
class LargestError:
    """The largest error bar of a scalar over a run.

    Attributes
    ----------
    half_width : float
        In the unit of the scalar; inf where the value depends on the mesh, NaN where nothing is
        known.
    part : float
        Of the scalar's largest magnitude [-].
    unknown : int
        At how many instants there is a value, but its error is not known.
    """

    half_width: float
    part: float
    unknown: int


def largest_error(ds: xr.Dataset, name: str) -> LargestError | None:
    """Return the largest error bar of a scalar.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    name : str
        The scalar.

    Returns
    -------
    LargestError or None
        None if the result states no errors of it, or holds no value.

    Examples
    --------
    >>> run = xr.Dataset({"force": ("time", [2.0, 4.0]), "force_error": ("time", [0.1, np.nan])})
    >>> largest_error(run, "force")
    LargestError(half_width=0.1, part=0.025, unknown=1)
    """
    error, values = stated_error(ds, name), _values(ds, name)
    given = ~np.isnan(values)
    if error is None or not given.any():
        return None
    known = error[given & ~np.isnan(error)]
    if not known.size:
        return LargestError(np.nan, np.nan, int(given.sum()))
    half_width, largest = float(known.max()), float(np.abs(values[given]).max())
    part = half_width / largest if largest > 0 else (np.inf if half_width > 0 else 0.0)
    return LargestError(half_width, part, int(given.sum()) - known.size)


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
        yield f"error owed to the time steps: {largest:.1e} of the pressure at most (estimated)"
    if memory and not memory.startswith(_EXACT):
        yield f"memory: {memory}"
    if inversion_error > 0:
        yield f"the law was converted numerically, within {inversion_error:.1e} (estimated)"


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


def unknown_lines(ds: xr.Dataset, names: Iterable[str]) -> Iterator[str]:
    """Yield whose errors are not known everywhere.

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
    count = ds.sizes["time"]
    found = {name: largest_error(ds, name) for name in names}
    places = {name: each.unknown for name, each in found.items() if each and each.unknown}
    if places:
        told = (f"{name.replace('_', ' ')} at {n} of {count}" for name, n in places.items())
        yield f"error not known: {', '.join(told)} instants"


def has_errors(ds: xr.Dataset) -> bool:
    """Tell whether a result states errors of its scalars."""
    return any(error_name(str(name)) in ds for name in ds.data_vars)


def _values(ds: xr.Dataset, name: str) -> NDArray[np.float64]:
    return np.asarray(ds[name].values, dtype=np.float64)
