"""Cycles of friction with their heat, full sliding, largest slip and wear of a run."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.friction import Friction
from viscontact.bodies.loads import TangentialLoad
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.run_axis import run_axis
from viscontact.results.stated_errors import errors_of
from viscontact.results.variables import scalars_in


def is_gripping(results: xr.Dataset) -> bool:
    """True for a run under friction over time."""
    return bool(scalars_in(results, ["slip_fraction"]))


def require_grip(results: xr.Dataset, figure: str) -> None:
    """Check that a run over time has friction; ValueError otherwise."""
    require_tractions(results, figure)
    if not run_axis(results).is_history:
        raise ValueError(
            f"{figure}: shows slip over time, and this result is of steady motion, over speed and "
            "creepage; draw traction-creepage, stick-map or traction-profile"
        )


def require_tractions(results: xr.Dataset, figure: str) -> None:
    """Check that a result, over time or in steady motion, has friction; ValueError otherwise."""
    if "slip_fraction" not in results:
        wanted = "a tangential load" if run_axis(results).is_history else "creepages of the motion"
        raise ValueError(
            f"{figure}: needs a run under friction, got one without; give friction and {wanted}"
        )


def recorded_friction(results: xr.Dataset, figure: str) -> Friction:
    """Friction of a run."""
    found = recorded_object(results, "friction", figure)
    assert isinstance(found, Friction)
    return found


@dataclass(frozen=True)
class FrettingCycle:
    """Cycle of a tangential load, with the heat of friction in it."""

    begin: float  # [s]
    end: float  # [s]
    heat: float  # [J]
    error: float  # half width of its error bar [J]; NaN if unknown


def fretting_cycles(results: xr.Dataset, figure: str) -> tuple[FrettingCycle, ...]:
    """Cycles of the tangential load that a run has passed, in order."""
    load = recorded_object(results, "tangential", figure)
    if not isinstance(load, TangentialLoad):  # a body that rolls with a creepage has none
        return ()
    times = results["time"].values
    heat, errors = results["friction_heat"].values, errors_of(results, "friction_heat")
    passed = [each for each in load.whole_cycles if each[1] <= times[-1] * (1 + 1e-9)]
    # The error of a sum grows along the run: that at the end of a cycle holds for the cycle.
    return tuple(
        FrettingCycle(
            begin,
            end,
            float(np.interp(end, times, heat) - np.interp(begin, times, heat)),
            float(np.interp(end, times, errors)),
        )
        for begin, end in passed
    )


def acting_directions(results: xr.Dataset) -> list[tuple[str, str]]:
    """Names of force and shift along each direction in which the body is loaded and moves."""
    pairs = [(f"tangential_force_{axis}", f"tangential_displacement_{axis}") for axis in "xy"]
    return [
        (force, shift)
        for force, shift in (*pairs, ("torque", "rotation"))
        if np.nan_to_num(results[force].values).any() and np.isfinite(results[shift].values).all()
    ]


def sliding_begins(results: xr.Dataset) -> float | None:
    """First instant at which the whole contact slips [s]; None if it never does."""
    slides = np.flatnonzero(results["slip_fraction"].values >= 1)
    return float(results["time"].values[slides[0]]) if slides.size else None


@dataclass(frozen=True, eq=False)
class SlipOverTime:
    """Slip since the contact of each cell, at the instants of stored fields."""

    times: Floats  # [s]
    largest: Floats  # [m]
    mean: Floats  # over the cells in contact [m]


def slip_over_time(results: xr.Dataset) -> SlipOverTime | None:
    """Largest and mean slip at the stored instants; None if no fields are stored."""
    if "slip_x" not in results:
        return None
    over = str(results["slip_x"].dims[0])
    largest, mean = [], []
    for index in range(results.sizes[over]):  # one by one: not all need fit in memory
        fields = results[["slip_x", "slip_y", "slip_state"]].isel({over: index})
        size = np.hypot(fields["slip_x"].values, fields["slip_y"].values)
        touching = fields["slip_state"].values > 0
        largest.append(float(size.max(initial=0.0)))
        mean.append(float(size[touching].mean()) if touching.any() else 0.0)
    times = np.asarray(results[over].values, dtype=np.float64)
    return SlipOverTime(times, np.array(largest), np.array(mean))


@dataclass(frozen=True)
class Wear:
    """Wear of both bodies together by Archard's law, if their shape did not change by it."""

    volume: float  # [m³]
    depth: float | None  # largest [m]; None if no fields are stored


def archard_wear(results: xr.Dataset, figure: str) -> Wear | None:
    """Wear at the end of a run, k/μ times the work of friction; None without a wear rate."""
    friction = recorded_friction(results, figure)
    if friction.wear is None:
        return None
    rate = friction.wear / friction.coefficient  # k ∫ p ds per area is k/μ of the work
    depth = None
    if "friction_work" in results:
        work = results["friction_work"]
        depth = rate * float(work.isel({work.dims[0]: -1}).max())
    return Wear(rate * float(results["friction_heat"].values[-1]), depth)
