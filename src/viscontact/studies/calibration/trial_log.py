"""Log of the runs of a calibration on the disk, from which an interrupted one goes on."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.runs.directory.atomic_files import replacing

#: Force and approach at the rows of a record [N, m], or the reason of a failed run.
Outcome = tuple[Floats, Floats] | str


class TrialLog:
    """Runs of a calibration, a line of JSON each, by what they were made from.

    ValueError if the file holds something else, or the runs of another calibration.
    """

    def __init__(self, path: Path, arguments: dict[str, Any]) -> None:
        self._path = path
        lines = _whole_lines(path)
        header = {"calibration": json.loads(json.dumps(arguments))}
        if lines and _read(path, 1, lines[0]) != header:
            raise ValueError(
                f"{path}: holds the runs of another fit: case, records or options differ; choose "
                "another file"
            )
        self.outcomes = dict(_outcome(path, n, line) for n, line in enumerate(lines[1:], 2))
        # A line that a killed process has begun is removed.
        with replacing(path) as file:
            file.writelines(f"{line}\n".encode() for line in lines or [json.dumps(header)])

    def keep(self, key: str, outcome: Outcome) -> None:
        """Append a run."""
        plain = outcome if isinstance(outcome, str) else [_plain(each) for each in outcome]
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps([key, plain]) + "\n")


def _whole_lines(path: Path) -> list[str]:
    """Complete lines of a file; none without it."""
    try:
        return path.read_text(encoding="utf-8").split("\n")[:-1]
    except FileNotFoundError:
        return []
    except UnicodeDecodeError:
        raise ValueError(f"{path}: is not UTF-8 text, as a log of runs is") from None


def _read(path: Path, number: int, line: str) -> Any:
    try:
        return json.loads(line)
    except ValueError:
        raise ValueError(f"{path}:{number}: is not a line of JSON; remove the file") from None


def _outcome(path: Path, number: int, line: str) -> tuple[str, Outcome]:
    try:
        key, plain = _read(path, number, line)
        if isinstance(plain, str):
            return str(key), plain
        force, approach = (np.array(each, dtype=np.float64) for each in plain)
    except (TypeError, ValueError):
        raise ValueError(f"{path}:{number}: is not a run of a fit; remove the file") from None
    return str(key), (force, approach)


def _plain(values: Floats) -> list[float | None]:
    """Numbers as JSON has them: NaN is null."""
    return [None if math.isnan(value) else value for value in values.tolist()]
