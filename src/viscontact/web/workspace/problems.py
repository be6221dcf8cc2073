"""Problems of a request as structured data, from the messages of the command line."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import CaseError

#: Key in a message: words joined by dots, with positions in lists in brackets.
_KEY = re.compile(r"([A-Za-z_][\w-]*(?:\[\d+\])*(?:\.[A-Za-z_][\w-]*(?:\[\d+\])*)*): ")


@dataclass(frozen=True)
class InputProblem:
    """Problem with its message, its key in the case and its line."""

    message: str
    path: str = ""
    line: int | None = None


class RequestError(Exception):
    """Refused request, with its problems as the body of the answer."""

    def __init__(
        self, status: int, *problems: InputProblem | str, retry_after: int | None = None
    ) -> None:
        super().__init__(*problems)
        self.status, self.retry_after = status, retry_after  # time after which to try again [s]
        found = (InputProblem(each) if isinstance(each, str) else each for each in problems)
        self.body: dict[str, Any] = {"problems": [asdict(each) for each in found]}

    def __reduce__(self) -> tuple[Any, ...]:
        """Send it from a process to another one with its status."""
        return partial(RequestError, retry_after=self.retry_after), (self.status, *self.args)


def case_problems(error: CaseError, path: Path) -> RequestError:
    """Return the problems of a case as a refused request."""
    return RequestError(422, *(problem_of(line, path) for line in error.problems))


def problem_of(line: str, path: Path) -> InputProblem:
    """Split a message of the command line into message, key and line."""
    number: int | None = None
    if found := re.match(rf"{re.escape(str(path))}:(\d*):? ", line):
        line, number = line[found.end() :], int(found[1]) if found[1] else None
    key = _KEY.match(line)
    where = key[1] if key and _is_key(key[1], number) else ""
    line = line[key.end() :] if key and where else line
    message = without_folder(line, path.parent)
    if message.startswith("no such file"):
        message += "; upload it, or open it together with the case"
    return InputProblem(message, where, number)


def without_folder(text: str, folder: Path) -> str:
    """Return a message without the path of the folder, which is of no use in a browser."""
    return re.sub(rf"{re.escape(str(folder))}[/\\]", "", text)


def lines_of(problems: Iterable[InputProblem]) -> list[str]:
    """Return problems as lines of text."""
    return [f"{each.path}: {each.message}" if each.path else each.message for each in problems]


def _is_key(text: str, line: int | None) -> bool:
    """True if the text is a key, and not a file name."""
    return line is not None or not re.search(r"\.(csv|npz|npy|ya?ml|xlsx|xlsm|xls|ods)$", text)
