"""Checks of a contact problem before its first step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter, Roller, Sphere
from viscontact.bodies.loads import Condition, LoadHistory, LoadPoint, MixedHistory
from viscontact.bodies.loads.history_points import TAIL
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.checks.load_support import LoadSupport
from viscontact.units.formatting import format_quantity

#: Instants at which a law is evaluated before it is used, and a fall that is not rounding or the
#: error of a conversion.
CREEP_SAMPLES, NOTABLE_FALL = 200, 0.01
#: Radius from which on a sphere or a roller is larger than machine parts [m].
LARGE_RADIUS = 2.0


def check_times(problem: Problem) -> None:
    """Refuse times that are not in order, and fields at times without a state."""
    problem.kept.among(problem.instants)


def check_magnitudes(problem: Problem) -> None:
    """Refuse magnitudes whose squares and quotients are no numbers; a search might never end."""
    load, end = problem.contact_load, problem.end
    sizes = problem.grid.size if isinstance(problem.grid, Grid) else ()
    level = abs(load.largest_level)
    compliance = problem.compliance(end)
    magnitudes = [(f"load.{load.control}", level), ("material", compliance), ("time", end)]
    for name, value in [*magnitudes, *(("grid.size", size) for size in sizes)]:
        if value and not 1e-30 <= value <= 1e30:
            raise ValueError(f"{name}: {value:.3g} in SI units is beyond what can be computed with")


def unusual_radius(indenter: Indenter) -> str | None:
    """Sentence about the radius of a sphere or a roller that looks like one in mm; None without."""
    radius = getattr(indenter, "radius", None)
    if not isinstance(indenter, Sphere | Roller) or radius is None or radius < LARGE_RADIUS:
        return None
    return (
        f"the radius of the indenter is {format_quantity(radius, 'm')}: lengths are in metres in "
        f"Python; write {radius / 1000:g} for {radius:g} mm"
    )


def check_mixed(problem: Problem) -> None:
    """Refuse a load of mixed control where a grid is chosen, repeats, or the body moves."""
    if not isinstance(problem.load, MixedHistory):
        return
    if not problem.motion.stands:
        raise ValueError(
            "load: a program, or mixed control, is for a body that does not move; leave motion out"
        )
    program = problem.load.program
    if program is not None and problem.friction is None:
        for condition in (*(part.until for part in program.parts), *program.stop):
            if isinstance(condition, Condition) and condition.needs_friction:
                raise ValueError(
                    f"load: the condition '{condition}' needs friction; give a coefficient of "
                    "friction and a load along the surface"
                )
    if isinstance(problem.grid, Grid) and any(problem.grid.periodic):
        raise ValueError(
            "load: a program, or mixed control, is for grids that are not periodic; leave periodic "
            "out, or prescribe force or approach throughout"
        )
    if not isinstance(problem.grid, Grid) and problem.load.program is None:
        raise ValueError(
            "grid: no grid can be fitted to a load of mixed control without its program; write "
            "grid=vc.Grid(shape, size)"
        )


def check_creep(problem: Problem) -> None:
    """Refuse a law whose creep within the run is not a number, negative or decreasing."""
    compliance, times = problem.surface.creep, problem.instants
    # A Prony series is fitted at least to ten times the first step.
    end = max(float(times[-1]), 10 * float(np.diff(times).min(initial=times[-1])))
    # Steps between the requested instants may be arbitrarily short.
    instants = times[:: max(1, len(times) // CREEP_SAMPLES)]
    if end > 0:
        instants = np.union1d(instants, np.geomspace(1e-6 * end, end, CREEP_SAMPLES))
    values = np.asarray(compliance(instants))
    wrong = ~(np.isfinite(values) & (values >= 0))
    wrong[1:] |= values[1:] < (1 - NOTABLE_FALL) * values[:-1]
    if wrong.any():
        raise ValueError(
            f"material: its law gives a contact compliance of {values[wrong][0]:.4g} /Pa at t = "
            f"{format_quantity(instants[wrong][0], 's')}; creep must be a number, not "
            "negative, and never decrease; correct the law"
        )


def check_jumps(problem: Problem) -> None:
    """Refuse a jump of the load within the run that the law cannot follow."""
    jumps = [jump for jump in problem.contact_load.jumps if jump <= problem.end]
    if not jumps or problem.compliance.instant > 0:
        return
    if jumps[0] not in problem.load.jumps:
        raise ValueError(
            "temperature: layers that have expanded press at once at t = "
            f"{format_quantity(jumps[0], 's', 6)} but the law has no instant compliance, so the "
            "surface could not follow; begin with a smaller approach and change the temperature "
            "over time, or give the law an instant compliance"
        )
    raise ValueError(
        f"load: the load jumps at t = {format_quantity(jumps[0], 's', 6)} but the law has no "
        "instant compliance, so the surface could not follow; use a ramp, or give the law an "
        "instant compliance"
    )


def points_under_load(problem: Problem) -> list[tuple[float, LoadPoint]]:
    """Return times [s] and loads that a body on any grid must be able to carry, time 0 first."""
    # A point without load counts where the load grows from it or falls to it; a cycle from zero to
    # zero has its load between. Where the force never moves, the first time is enough.
    load, end = problem.contact_load, problem.end
    peak = [problem.largest_load[0]] if np.isfinite(load.longest_step) else []
    instants = np.unique([*load.kinks[load.kinks < end], *peak, end])
    levels = np.maximum(load.level_at(instants, side="left"), load.level_at(instants))
    before, after = np.append(0.0, levels[:-1]), np.append(levels[1:], 0.0)
    under_load = instants[(before > 0) | (levels > 0) | (after > 0)].tolist()
    if not _wanders(load):
        del under_load[1:]
    sides = [(time, load.at(time, side=side)) for time in under_load for side in ("left", "right")]
    return [(0.0, load.at(0.0)), *sides]


def check_touch(problem: Problem, point: LoadPoint, open_gap: Floats, grid: Grid) -> None:
    """Refuse a clamped tilt that presses at time 0 already on a law that cannot follow."""
    if problem.compliance.instant > 0 or point.approach is None:
        return
    slopes = (point.tilt_x or 0.0) * grid.x[:, None], (point.tilt_y or 0.0) * grid.y[None, :]
    if (open_gap < point.approach + slopes[0] + slopes[1]).any():
        raise ValueError(
            f"load: tilted by {format_quantity(point.tilt_x or 0.0, 'rad', 6)} along x and "
            f"{format_quantity(point.tilt_y or 0.0, 'rad', 6)} along y the stage presses from time "
            "0 on, but the law has no instant compliance, so the surface could not follow; begin "
            "with a smaller approach, or give the law an instant compliance"
        )


def check_balance(points: Sequence[tuple[float, LoadPoint]], open_gap: Floats, grid: Grid) -> None:
    """Refuse a resultant that acts outside the hull of what can touch."""
    solid = np.isfinite(open_gap)
    if not solid.any():
        raise ValueError("grid: no cell lies under the indenter; use a finer or larger grid")
    support = LoadSupport(solid, grid)
    along_x, along_y = grid.periodic  # each period carries its own part of the force
    for time, point in points:
        where = (
            None if along_x or point.tilt_x is not None else point.eccentricity_x,
            None if along_y or point.tilt_y is not None else point.eccentricity_y,
        )
        support.refuse_outside(where, time)


def _wanders(load: LoadHistory) -> bool:
    """True if the position of the force, or the prescription of the tilts, changes."""
    return any(np.ndim(getattr(load, name)) > 0 for name in TAIL if getattr(load, name) is not None)
