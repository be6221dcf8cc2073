"""Case of a study with other values of some keys."""

from __future__ import annotations

import difflib
import hashlib
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.case import Case, CaseError, read_case
from viscontact.results.run_axis import SPEED, TIME, RunAxis
from viscontact.results.variables import scalars_with_error
from viscontact.runs.preparation import analysis_of
from viscontact.runs.solving import solve
from viscontact.simulation.transient.found_events import carried_out

#: Place of a scalar: that of its worst value, the last one, or a time [s] or a speed [m/s].
At = Literal["worst", "end"] | float


def known_scalar(argument: str, name: str) -> str:
    """Name of a scalar with an error bar; ValueError for another one, with the argument."""
    names = scalars_with_error(moving=True)
    if name in names:
        return name
    close = difflib.get_close_matches(name, names, 1)
    hint = f"did you mean {close[0]}?" if close else f"one of {', '.join(names)}"
    raise ValueError(f"{argument}: {name!r} is no scalar of a result; {hint}")


def case_path(case: str | PathLike[str]) -> Path:
    """Path of the case file of a study; ValueError for objects in its place."""
    if isinstance(case, str | PathLike):
        return Path(case)
    raise ValueError(
        "case: must be the path of a case file, whose keys the study changes, got "
        f"{type(case).__name__}; simulate_many takes runs of Python objects"
    )


def result_of(case: Case) -> xr.Dataset:
    """Result of a case, over time or over speed."""
    return solve(analysis_of(carried_out(case), errors=case.errors))


def texts(settings: Mapping[str, Any] | None) -> dict[str, str]:
    """Values by key as text, as ``--set`` takes them."""
    return {key: str(value) for key, value in (settings or {}).items()}


def case_with(path: Path, settings: Mapping[str, str]) -> Case:
    """Read a case with settings; CaseError without the name of an option."""
    try:
        return read_case(path, [f"{key}={value}" for key, value in settings.items()])
    except CaseError as error:
        raise CaseError(*map(without_option, error.problems)) from None


def without_option(problem: str) -> str:
    """Problem of a case without the option of the command line that it names."""
    return problem.removeprefix("--set ")


def fingerprint(case: Case) -> str:
    """Digest of a case and of the files that it names."""
    return hashlib.sha256(b"".join(sorted(case.digests.values()))).hexdigest()


def refuse_repeated(**groups: Sequence[str]) -> None:
    """Raise ValueError if a key is given twice, in one argument or in several."""
    *others, last = groups
    where = f", in {', '.join(others)} or {last}" if others else ""
    keys = [key for group in groups.values() for key in group]
    for key in keys:
        if keys.count(key) > 1:
            raise ValueError(f"{key}: is given twice{where}; give it once")


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
