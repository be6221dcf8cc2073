"""Runs of a design that are continued to a week and a year of creep."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.bodies.loads import ApproachHistory, ForceHistory
from viscontact.case import Case
from viscontact.runs.single import simulate

#: Durations of creep that a design states [s].
DAY, WEEK, YEAR = 86400.0, 7 * 86400.0, 365.25 * 86400.0
#: Steps in each decade of time, behind the end of a case.
STEPS_PER_DECADE = 6
#: Steps of a case with adaptive ones, and the first one, in parts of its end.
STEPS, FIRST = 30, 1e-3
#: Least relative growth of the compliance in a year that is creep.
CREEP = 1e-6


def creeps_on(case: Case) -> bool:
    """True if the load of a case is held at its end, and the bodies creep within a year."""
    load = case.load
    if not isinstance(load, ForceHistory | ApproachHistory) or not case.motion.stands:
        return False
    end = case.end if case.adaptive is None else case.adaptive.end
    held = bool(load.kinks[-1] <= end and load.level_at([end])[0] > 0)
    return held and bool(case.compliance(YEAR) > (1 + CREEP) * case.compliance.instant)


def year_of_instants(case: Case) -> Floats:
    """Instants of a case, and others up to a year, a day and a week among them [s]."""
    adaptive = case.adaptive
    own = case.instants if adaptive is None else np.geomspace(FIRST, 1, STEPS) * adaptive.end
    end, parts = float(own[-1]), [own]
    for until in (DAY, WEEK, YEAR):
        if end < until:
            steps = max(2, int(np.ceil(STEPS_PER_DECADE * np.log10(until / end))))
            parts.append(np.geomspace(end, until, steps + 1)[1:])
            end = until
    return np.union1d(np.concatenate(parts), [DAY, WEEK, YEAR])


def year_of_creep(case: Case, arguments: Mapping[str, Any]) -> xr.Dataset | str:
    """Result of a run to a year, by the arguments of `simulate`; the reason if it fails."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)  # they are kept with the result
        try:
            return simulate(**{**arguments, "times": year_of_instants(case), "fields": "none"})
        except (ValueError, ConvergenceError, DomainError) as error:
            return str(error).splitlines()[0]
