"""Error of an automatic grid under the loads of a run, as check reports it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from viscontact.simulation.transient.setup import RunSetup
from viscontact.units.formatting import format_number, format_quantity

#: Loads from this fraction of the largest one on count as the largest.
LARGEST_LOAD_FRACTION = 0.999

#: Errors of the grid below this are not distinguished.
LEAST_ERROR = 1e-4


def grid_error_rows(run: RunSetup) -> list[tuple[str, str]]:
    """Estimated errors of an automatic grid, and the times for which they hold."""
    if run.mesh is None or not run.mesh.errors:
        return []
    errors = [
        f"{name.replace('_', ' ')} {_percent(error)}" for name, error in run.mesh.errors.items()
    ]
    # Broken here: a terminal would break between a number and its unit.
    when = ";\n".join(_when_largest(run))
    return [("grid error", f"{', '.join(errors)},\n{when}")]


def _percent(error: float) -> str:
    """A relative error; an estimate as large as the value itself is none."""
    if error < LEAST_ERROR:
        return f"<{100 * LEAST_ERROR:g} %"
    return f"{format_number(100 * error, 1)} %" if error < 1 else "unknown"


def _when_largest(run: RunSetup) -> Iterator[str]:
    """Times of the largest load, for which the cells were chosen, and a remark on other times."""
    problem, load = run.problem, run.problem.contact_load
    crest, point = problem.largest_load
    kinks = load.kinks[load.kinks <= problem.end]
    instants = np.union1d(problem.instants, [*kinks, crest])
    # On the left of a jump, for example, the load is largest at a single instant.
    is_largest = load.level_at(instants) >= LARGEST_LOAD_FRACTION * point.level
    is_largest |= instants == crest
    first, last = (format_quantity(float(instants[is_largest][k]), "s", 3) for k in (0, -1))
    when = f" (t = {first} to {last})" if first != last else f" (t = {first})"
    comes = np.diff(is_largest.astype(int), prepend=0) > 0
    if math.isfinite(load.longest_step) or np.count_nonzero(comes) > 1:
        when = f" (first at t = {first})"
    yield f"at the largest load{'' if is_largest.all() else when}"
    if not is_largest[instants > 0].all():
        yield "more at smaller loads, whose contact has fewer cells"
