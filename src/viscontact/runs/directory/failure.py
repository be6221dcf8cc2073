"""Failure of a run, kept in its directory until it begins again."""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from viscontact.results.run_files import FAILURE_NAME
from viscontact.runs.directory.atomic_files import replacing


def write_failure(directory: Path, outcome: str, code: int, message: Sequence[str]) -> None:
    """Write how a run has failed, where the disk allows it and the directory above exists."""
    entry = {"outcome": outcome, "code": code, "message": list(message)}
    text = json.dumps(entry, ensure_ascii=False) + "\n"
    with suppress(OSError):
        directory.mkdir(exist_ok=True)
        with replacing(directory / FAILURE_NAME) as file:
            file.write(text.encode("utf-8", "backslashreplace"))


def remove_failure(directory: Path) -> None:
    """Remove the failure of an earlier attempt."""
    with suppress(OSError):
        (directory / FAILURE_NAME).unlink(missing_ok=True)
