"""Journal of the runs of a profile design, in their order, so that an interrupted one goes on."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from viscontact.runs.directory.atomic_files import replacing
from viscontact.studies.design.history import HISTORY_NAME, read_line, require_same, whole_lines


class Journal:
    """Results of runs, which a design with the same arguments makes in the same order.

    Without a directory nothing is kept. ValueError if it holds another design.
    """

    def __init__(self, directory: Path | None, arguments: Mapping[str, Any]) -> None:
        self._path = None if directory is None else directory / HISTORY_NAME
        self._recorded: deque[Any] = deque()
        if directory is None or self._path is None:
            return
        directory.mkdir(parents=True, exist_ok=True)
        lines = whole_lines(self._path)
        header = {"design": json.loads(json.dumps(dict(arguments)))}
        if lines:
            require_same(directory, read_line(self._path, 1, lines[0]), header)
        for number, line in enumerate(lines[1:], 2):
            self._recorded.append(read_line(self._path, number, line))
        # A line that a killed process has begun is removed.
        with replacing(self._path) as file:
            file.writelines(f"{line}\n".encode() for line in lines or [json.dumps(header)])

    def recorded(self) -> Any:
        """Next recorded result; None after the last one."""
        return self._recorded.popleft() if self._recorded else None

    def keep(self, result: Any) -> None:
        """Append a result, as JSON."""
        if self._path is not None:
            with self._path.open("a", encoding="utf-8") as file:
                file.write(json.dumps(result) + "\n")
