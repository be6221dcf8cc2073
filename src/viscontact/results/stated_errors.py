"""Errors that a result states of its scalars, and scalars that are rounding only."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.run_axis import run_axis
from viscontact.results.shown_scalars import is_shown
from viscontact.results.variables import SCALARS, error_name

if TYPE_CHECKING:
    from viscontact.results.stored_result import Result

#: Relative difference of error bars that are one.
SAME_ERROR = 1e-4

#: In place of its curve over time.
NOT_DRAWN = "not drawn: smaller cells give more"
#: Why the stated error of a value is infinite.
WHY_MESH_DEPENDENT = "the number is the largest mean over a cell, and smaller cells give more"
#: Exactly centred loads leave eccentricities of rounding size [m].
_ROUNDING_ECCENTRICITY = 1e-12
#: Of the approach: a tilt that moves the ends of the contact by less is rounding.
_ROUNDING_TILT = 1e-6
#: Resistance over force of an elastic body, and across the motion.
_ROUNDING_RESISTANCE = 1e-9
#: Approach over extent of a contact whose approach has no datum, in place of it.
_USUAL_STRAIN = 1e-3


def stated_error(results: Result, name: str) -> Floats | None:
    """Half widths of a scalar's error bars over time; None if not stated, NaN unknown, inf mesh."""
    error = error_name(name)
    return np.asarray(results[error].values, dtype=np.float64) if error in results else None


def errors_of(ds: Result, name: str) -> Floats:
    """Errors of a scalar over time, NaN at all instants if the result states none."""
    error = stated_error(ds, name)
    return np.full(ds.sizes[run_axis(ds).name], np.nan) if error is None else error


def mesh_dependent(results: Result, name: str) -> Bools:
    """Instants at which a scalar depends on the mesh, as booleans."""
    error = stated_error(results, name)
    return (
        np.zeros(results.sizes[run_axis(results).name], dtype=np.bool_)
        if error is None
        else np.isposinf(error)
    )


def drawn_values(results: Result, name: str) -> Floats:
    """Values of a scalar for a curve over time: NaN where it depends on the mesh."""
    # All are NaN if only zeros, as without contact, would remain.
    values = np.asarray(results[name].values, dtype=np.float64)
    marked = mesh_dependent(results, name)
    drawn = np.where(marked, np.nan, values)
    return drawn if not marked.any() or np.any(drawn > 0) else np.full(values.shape, np.nan)


def lacks_curve(results: Result, name: str) -> bool:
    """Test for a scalar whose values all depend on the mesh, or are zero without contact."""
    marked = mesh_dependent(results, name)
    return bool(marked.any() and np.isnan(drawn_values(results, name)).all())


@dataclass(frozen=True)
class LargestError:
    """The largest error bar of a scalar over a run."""

    half_width: float  # in the unit of the scalar; inf if mesh-dependent, NaN if unknown
    part: float  # of the scalar's largest magnitude [-]
    unknown: int  # number of instants or speeds with a value of unknown error
    place: float  # first instant [s] or speed [m/s] of this error; NaN if unknown


def largest_error(ds: Result, name: str) -> LargestError | None:
    """Return the largest error bar of a scalar."""
    error, values = stated_error(ds, name), np.asarray(ds[name].values, dtype=np.float64)
    given = ~np.isnan(values)
    if error is None or not given.any():
        return None
    known = given & ~np.isnan(error)
    unknown = int(given.sum() - known.sum())
    if not known.any():
        return LargestError(np.nan, np.nan, unknown, np.nan)
    half_width, largest = float(error[known].max()), float(np.abs(values[given]).max())
    # Of equal ones, as of a load that is held, the first: rounding does not choose among them.
    at = int((known & (error >= (1 - SAME_ERROR) * half_width)).argmax())
    part = half_width / largest if largest > 0 else (np.inf if half_width > 0 else 0.0)
    return LargestError(half_width, part, unknown, float(ds[run_axis(ds).name][at]))


def is_rounding(ds: Result, name: str) -> bool:
    """Test for a scalar that is zero throughout, or of rounding size."""
    # Tilts and eccentricities under a centred load are, and the resistance across the motion.
    if is_centred(ds, name):
        return True
    if name in SCALARS and (period := SCALARS[name].per_length_of):
        return is_rounding(ds, period)
    largest = _maximum(ds[name].values)
    return largest == 0.0 or largest <= _rounding_of_motion(ds, name)


def _rounding_of_motion(ds: Result, name: str) -> float:
    """Largest rounding of a scalar of the motion, in its unit; 0 for other scalars."""
    if name.startswith("resistance"):
        return _ROUNDING_RESISTANCE * _maximum(ds["force"].values)
    if name == "friction_coefficient":
        return _ROUNDING_RESISTANCE
    if name == "motion_work":
        way = max(np.ptp(ds[f"position_{axis}"].values) for axis in "xy")
        return _ROUNDING_RESISTANCE * _maximum(ds["force"].values) * float(way)
    return 0.0


def is_centred(ds: Result, name: str) -> bool:
    """Test for a tilt or an eccentricity of rounding size, as a centred load leaves."""
    if name.startswith("tilt"):
        length = ds["contact_length"].values
        approach = ds["approach"].values if is_shown(ds, "approach") else _USUAL_STRAIN * length
        return is_rounding_tilt(ds[name].values, length, approach)
    return name.startswith("eccentricity") and _maximum(ds[name].values) <= _ROUNDING_ECCENTRICITY


def is_rounding_tilt(tilt: ArrayLike, contact_length: ArrayLike, approach: ArrayLike) -> bool:
    """Test for a tilt [rad] of rounding size, as a centred load leaves; NaN is ignored."""
    # It moves the ends of the longest contact by less than a millionth of the largest approach.
    return _maximum(tilt) * _maximum(contact_length) <= _ROUNDING_TILT * _maximum(approach)


def _maximum(values: ArrayLike) -> float:
    magnitudes = np.abs(np.atleast_1d(np.asarray(values, dtype=np.float64)))
    return float(magnitudes[np.isfinite(magnitudes)].max(initial=0.0))
