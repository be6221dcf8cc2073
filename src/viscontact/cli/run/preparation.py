"""From a case file to a run that has been checked, or a refusal."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from viscontact.case import CaseError, read_case
from viscontact.cli.terminal.messages import refuse
from viscontact.runs.preparation import PreparedRun, prepared


def prepare(path: Path, settings: Sequence[str], threads: int = 1) -> PreparedRun:
    """Read and check everything that can be checked before the first step."""
    try:
        return prepared(read_case(path, settings), threads)
    except CaseError as error:
        refuse(*error.problems)
