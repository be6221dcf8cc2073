"""Case of a study with other values of some keys."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.case import Case, CaseError, read_case
from viscontact.units.formatting import format_quantity


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
    """Raise ValueError if a key is given twice, in one argument or in several.

    >>> refuse_repeated(change=["load.force"], settings=["load.force"])
    Traceback (most recent call last):
    ValueError: load.force: is given twice, in change or settings; give it once
    """
    *others, last = groups
    keys = [key for group in groups.values() for key in group]
    for key in keys:
        if keys.count(key) > 1:
            where = f"{', '.join(others)} or {last}"
            raise ValueError(f"{key}: is given twice, in {where}; give it once")


def require_instant(instants: Floats, time: float) -> None:
    """Raise ValueError if a time [s] is none of the instants."""
    near = float(instants[np.abs(instants - time).argmin()])
    if not np.isclose(near, time, rtol=1e-9, atol=0):
        wanted, found = (format_quantity(each, "s") for each in (time, near))
        raise ValueError(f"at: {wanted} is no instant of the case; the nearest one is {found}")


def require_place(at: Any) -> None:
    """Raise ValueError unless an instant is "worst", "end" or a time."""
    if isinstance(at, str) and at not in ("worst", "end"):
        raise ValueError(f"at: must be 'worst', 'end' or a time [s], got {at!r}")
