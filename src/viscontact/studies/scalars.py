"""Scalars of the runs of a study: at an instant or at their worst, each with its error."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable, Sequence
from typing import Literal

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.case import Case
from viscontact.results.run_axis import RUN_AXES, SPEED, TIME, RunAxis
from viscontact.results.stated_errors import stated_error
from viscontact.results.sweep_axes import over_of
from viscontact.results.variables import (
    OF_LEAKAGE,
    OF_LEAKAGE_Y,
    SCALARS,
    error_name,
    scalars_with_error,
)

#: Place of a scalar: that of its worst value, the last one, or a time [s] or a speed [m/s].
At = Literal["worst", "end"] | float


@dataclass(frozen=True)
class Value:
    """Value of a scalar of a run, with its error, in SI units."""

    value: float  # NaN if the run has none
    error: float  # half width of the error bar: inf if mesh-dependent, NaN if unknown

    @property
    def depends_on_mesh(self) -> bool:
        """True if smaller cells give other values, without a limit."""
        return math.isinf(self.error)


def magnitude(results: xr.Dataset, scalar: str, at: At, *, largest: bool = True) -> Value:
    """Largest or least magnitude of a scalar in a run, or at an instant; ValueError without."""
    (value,), (error,) = magnitudes(results, scalar, at, largest=largest)
    return Value(float(value), float(error))


def magnitudes(
    results: xr.Dataset, scalar: str, at: At, *, largest: bool = True
) -> tuple[Floats, Floats]:
    """Magnitudes of a scalar in one run or in the runs of a sweep, and their errors."""
    # An instant must be one of the first run; other runs have the one that is nearest.
    if scalar not in results:
        raise ValueError(f"{scalar}: the result does not have it")
    sizes = np.atleast_2d(np.abs(np.asarray(results[scalar].values, dtype=np.float64)))
    stated = stated_error(results, scalar)
    errors = np.full(sizes.shape, np.nan) if stated is None else np.atleast_2d(stated)
    if at == "worst":
        known = np.isfinite(sizes)
        ranks = np.where(known, sizes, -1.0) if largest else np.where(known, -sizes, -np.inf)
        rows: Integers = ranks.argmax(axis=1)
    else:
        rows = _rows_at(results, at, sizes.shape)
    values, bars = (
        np.take_along_axis(each, rows[:, None], axis=1)[:, 0] for each in (sizes, errors)
    )
    if at == "worst" and largest:
        # A value without a limit at any instant is the worst, whatever its number is here.
        bars = np.where(np.isposinf(errors).any(axis=1), np.inf, bars)
    return values, np.where(np.isnan(values), np.nan, bars)


def _rows_at(results: xr.Dataset, at: At, shape: tuple[int, ...]) -> Integers:
    """Row of an instant [s], of a speed [m/s], or of the end in each run."""
    axis = RUN_AXES[over_of(results)]
    places = np.broadcast_to(axis.values(results), shape)
    known = np.isfinite(places)  # runs with fewer rows than others are filled up
    if at == "end":
        return np.asarray(shape[1] - 1 - known[:, ::-1].argmax(axis=1))
    wanted = float(at)
    rows = np.where(known, np.abs(places - wanted), np.inf).argmin(axis=1)
    found = float(places[0, rows[0]])
    if not math.isclose(found, wanted, rel_tol=1e-9, abs_tol=1e-15):
        near = axis.quantity(found)
        raise ValueError(
            f"at: {axis.quantity(wanted)} is no {axis.row} of the run; the nearest one is {near}"
        )
    return np.asarray(rows)


def value_columns(
    scalar: str, dims: str | tuple[str, ...], values: Sequence[object], suffix: str = ""
) -> dict[str, xr.Variable]:
    """Values of a scalar and their errors as variables of a table; nested values have more dims."""
    both = np.vectorize(lambda each: (each.value, each.error), otypes=[float, float])(
        np.array(values, dtype=object)
    )
    name, units = f"{scalar}{suffix}", SCALARS[scalar].units
    about = SCALARS[scalar].long_name, f"estimated error of: {SCALARS[scalar].long_name}"
    return {
        each: xr.Variable(dims, column, {"units": units, "long_name": text})
        for each, column, text in zip((name, error_name(name)), both, about, strict=True)
    }


def known_scalar(argument: str, name: str) -> str:
    """Name of a scalar with an error bar; ValueError for another one, with the argument."""
    names = [*scalars_with_error(), *OF_LEAKAGE, *OF_LEAKAGE_Y]
    if name in names:
        return name
    close = difflib.get_close_matches(name, names, 1)
    hint = f"did you mean {close[0]}?" if close else f"one of {', '.join(names)}"
    raise ValueError(f"{argument}: {name!r} is no scalar of a result; {hint}")


def require_fluid(case: Case, scalars: Iterable[str]) -> None:
    """Raise ValueError for a scalar of the leakage that the case does not state."""
    needed = [name for name in scalars if name in (*OF_LEAKAGE, *OF_LEAKAGE_Y)]
    if not needed:
        return
    settings = case.leakage
    if not settings:
        raise ValueError(
            f"{needed[0]}: needs a section 'leakage' in the case, with the viscosity of the fluid "
            "and the direction of its flow ('along: x', 'y' or 'both')"
        )
    across = [name for name in needed if name in OF_LEAKAGE_Y]
    if across and settings.get("along") != "both":
        raise ValueError(
            f"{across[0]}: needs 'along: both' in the section 'leakage'; of a flow along one axis "
            f"it is {across[0].removesuffix('_y')}"
        )
    driven = [name for name in needed if name.startswith("leak_rate")]
    if driven and "pressure_difference" not in settings:
        raise ValueError(f"{driven[0]}: needs a pressure_difference in the section 'leakage'")


def places_of(case: Case) -> tuple[RunAxis, Floats]:
    """Instants [s] of a case, those that adaptive steps are known to have, or its speeds [m/s]."""
    if isinstance(case.motion, SteadyMotion):
        return SPEED, np.array(case.motion.speeds)
    return TIME, case.instants if case.adaptive is None else np.array([0.0, case.adaptive.end])


def require_instant(case: Case, at: At) -> None:
    """Raise ValueError unless a place is "worst", "end", or an instant [s] or speed of the case."""
    axis, places = places_of(case)
    if isinstance(at, str):
        if at not in ("worst", "end"):
            raise ValueError(f"at: must be 'worst', 'end' or a {axis.name}, got {at!r}")
        return
    near = float(places[np.abs(places - at).argmin()])
    # Adaptive steps end at instants that are not known before.
    if case.adaptive is None and not np.isclose(near, at, rtol=1e-9, atol=0):
        wanted, found = axis.quantity(at), axis.quantity(near)
        raise ValueError(f"at: {wanted} is no {axis.row} of the case; the nearest one is {found}")
