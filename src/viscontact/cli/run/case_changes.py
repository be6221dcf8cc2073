"""Differences between the case of a stored run and the case now, in the keys of the file."""

from __future__ import annotations

from collections.abc import Iterable
from math import isclose
from pathlib import Path
from typing import Any

from viscontact.case import Case, CaseError
from viscontact.case.document import read_document
from viscontact.case.yaml_source import parse
from viscontact.runs.directory.differences import Difference, differences
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.parsing import parse_quantity

#: Largest number of lines.
_MOST = 12
# Keys without influence on the numbers.
_IRRELEVANT = ("title",)


def case_changes(kept: Path, case: Case, computed: Iterable[Difference]) -> list[str]:
    """Return a line for each change of the case.

    The computed differences, in SI units, are used where the files are equal, as when a table that
    they name has changed.
    """
    try:
        written = differences(read_document(kept).data, parse(case.text)[0])
    except CaseError:
        written = ()
    changes = [each for each in written if not _means_the_same(each)] or list(computed)
    lines = [f"  {each}" for each in changes[:_MOST]]
    return lines + ([f"  and {len(changes) - _MOST} more"] if len(changes) > _MOST else [])


def _means_the_same(change: Difference) -> bool:
    if change.where in _IRRELEVANT:
        return True
    return any(
        isclose(one, other, rel_tol=1e-12)
        for dimension in DIMENSIONS
        if (one := _quantity(change.before, dimension)) is not None
        and (other := _quantity(change.now, dimension)) is not None
    )


def _quantity(value: Any, dimension: str) -> float | None:
    try:
        return parse_quantity(value, dimension) if isinstance(value, str) else None
    except ValueError:
        return None
