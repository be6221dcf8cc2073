"""History of a design on the disk: its arguments, and a line of JSON for each trial."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from viscontact.runs.directory.atomic_files import replacing
from viscontact.studies.design.evaluation import identity
from viscontact.studies.design.goals import Value
from viscontact.studies.design.trials import ScenarioResult, Trial

#: History of the trials, in the directory of a design.
HISTORY_NAME = "trials.jsonl"


class History:
    """Trials of a design that are kept in a directory, so that an interrupted one goes on.

    ValueError if the directory holds the trials of a design with other arguments.
    """

    def __init__(self, directory: Path, arguments: dict[str, Any]) -> None:
        self._path = directory / HISTORY_NAME
        directory.mkdir(parents=True, exist_ok=True)
        lines = whole_lines(self._path)
        header = {"design": json.loads(json.dumps(arguments))}
        if lines:
            require_same(directory, read_line(self._path, 1, lines[0]), header)
        trials = [_trial(self._path, n, line) for n, line in enumerate(lines[1:], 2)]
        self.recorded = {identity(each): each for each in trials}
        # A line that a killed process has begun is removed.
        with replacing(self._path) as file:
            file.writelines(f"{line}\n".encode() for line in lines or [json.dumps(header)])

    def keep(self, trial: Trial) -> None:
        """Append a trial."""
        results = [
            {
                "values": {
                    name: [_plain(v.value), _plain(v.error)] for name, v in each.values.items()
                },
                "failure": each.failure,
                "warnings": each.warnings,
            }
            for each in trial.results
        ]
        line = {"settings": dict(trial.settings), "level": trial.level, "results": results}
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")


def require_same(directory: Path, found: Any, wanted: dict[str, Any]) -> None:
    """Raise ValueError unless the first line of a history is that of a design."""
    if found == wanted:
        return
    before = found.get("design", {}) if isinstance(found, dict) else {}
    now = wanted["design"]
    changed = [name for name in now if before.get(name) != now[name]]
    raise ValueError(
        f"{directory}: holds another design, with a different {', '.join(changed) or 'header'}; "
        "choose another directory"
    )


def whole_lines(path: Path) -> list[str]:
    """Complete lines of a file; none without it."""
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return []
    except UnicodeDecodeError:
        raise ValueError(f"{path}: is not UTF-8 text, as a history of trials is") from None
    return text.split("\n")[:-1]


def read_line(path: Path, number: int, line: str) -> Any:
    """Read a line of JSON; ValueError names the file."""
    try:
        return json.loads(line)
    except ValueError:
        raise ValueError(f"{path}:{number}: is not a line of JSON; remove the file") from None


def _trial(path: Path, number: int, line: str) -> Trial:
    found = read_line(path, number, line)
    try:
        results = tuple(
            ScenarioResult(
                {name: Value(_number(v), _number(e)) for name, (v, e) in each["values"].items()},
                each["failure"],
                each["warnings"],
            )
            for each in found["results"]
        )
        return Trial(found["settings"], found["level"], results)
    except (LookupError, TypeError, ValueError, AttributeError):
        raise ValueError(f"{path}:{number}: is not a trial of a design; remove the file") from None


def _plain(number: float) -> float | str | None:
    """Number as JSON has it: NaN and the infinite ones have no form of their own."""
    return None if math.isnan(number) else number if math.isfinite(number) else "inf"


def _number(plain: Any) -> float:
    return math.nan if plain is None else float(plain)
