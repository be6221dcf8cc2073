"""Checks of the points of load histories."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.units.numbers import finite_array, unit_of

#: Arguments of histories other than force and approach.
TILTS = ("tilt_x", "tilt_y")
TAIL = ("eccentricity_x", "eccentricity_y", *TILTS)


def side_of_jump(side: str) -> Literal["left", "right"]:
    """Return `side` if it is "left" or "right", or raise ValueError."""
    if side == "left":
        return "left"
    if side == "right":
        return "right"
    raise ValueError(f'side must be "left" (before a jump) or "right" (after it), got {side!r}')


def instants(times: ArrayLike) -> Floats:
    """Times of a history's points, read-only, not decreasing, >= 0, at most twice, (n,) [s]."""
    given = finite_array("times", times, "s")
    if given.ndim != 1 or given.size == 0:
        raise ValueError(
            f"times must be a list of at least one instant in s, got shape {given.shape}"
        )
    if given[0] < 0:
        raise ValueError(f"times must start at 0 s or later, got {given[0]} s")
    steps = np.diff(given)
    for i in np.flatnonzero(steps < 0)[:1]:
        raise ValueError(f"times must not decrease, got {given[i]} s followed by {given[i + 1]} s")
    for i in np.flatnonzero((steps[:-1] == 0) & (steps[1:] == 0))[:1]:
        raise ValueError(
            f"times must not hold an instant more than twice, got {given[i]} s three times; "
            "a jump has two points, the value before and the value after"
        )
    return given


def values(owner: type, name: str, given: ArrayLike | None, count: int) -> float | Floats:
    """Return field `name` of a history: finite, a scalar or shape (count,), read-only."""
    array = finite_array(name, given, unit_of(owner, name) or "1")
    if array.shape not in ((), (count,)):
        raise ValueError(
            f"{name} must be a scalar or have one value for each of the {count} times, "
            f"got shape {array.shape}"
        )
    return float(array) if array.ndim == 0 else array


def refuse_both(
    axis: str,
    eccentricity: float | Floats | None,
    tilt: float | Floats | None,
) -> None:
    """Raise ValueError if an axis has both a prescribed tilt and an eccentricity."""
    if tilt is not None and np.any(eccentricity):
        raise ValueError(
            f"tilt_{axis} and eccentricity_{axis} contradict each other: a prescribed tilt "
            f"replaces the moment equation along {axis}; got eccentricity_{axis}="
            f"{eccentricity!r} m with tilt_{axis}={tilt!r} rad, leave one of them out"
        )


def tail(owner: type, count: int, **given: ArrayLike | None) -> dict[str, float | Floats | None]:
    """Return eccentricities [m] and tilts [rad] of a history, as `values`; a tilt may be None."""
    checked = {
        name: values(owner, name, value, count) if value is not None or name not in TILTS else None
        for name, value in given.items()
    }
    for axis in "xy":
        refuse_both(axis, checked.get(f"eccentricity_{axis}", 0.0), checked[f"tilt_{axis}"])
    return checked
