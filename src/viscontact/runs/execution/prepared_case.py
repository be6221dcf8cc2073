"""Case that has been read, with everything checked that can be before the first step."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from viscontact.case import CaseError, read_case
from viscontact.runs.command_error import refuse
from viscontact.runs.preparation import PreparedRun, prepared


def prepare(
    path: Path,
    settings: Sequence[str],
    threads: int = 1,
    memory: float | None = None,
    *,
    roughly: bool = False,
) -> PreparedRun:
    """Read a case and check what can be checked before the first step; memory in bytes."""
    try:
        return prepared(read_case(path, settings), threads, memory, roughly=roughly)
    except CaseError as error:
        refuse(*error.problems)
