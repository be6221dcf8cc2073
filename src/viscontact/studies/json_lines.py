"""Files with a line of JSON for each run."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

from viscontact.results.damage import note_unchecked
from viscontact.results.line_digests import is_as_written

Item = TypeVar("Item")

#: Longest line that is read at once [characters].
_LONGEST_LINE = 10_000_000


def read_lines(
    path: Path,
    read: Callable[[Any, int], Item],
    kind: str,
    remedy: str,
    *,
    appended: bool = False,
) -> Iterator[Item]:
    """Read the lines, numbered from 1, in constant memory; ValueError names one that is damaged.

    All lines have digests or, in files of earlier versions, none. Where lines are `appended` to a
    first one, a last one without an end is one that a killed process has begun.
    """
    with path.open(encoding="utf-8", newline="") as lines:
        number, checked = 0, False
        try:
            while line := lines.readline(_LONGEST_LINE):
                if appended and number and not line.endswith("\n") and not lines.read(1):
                    return
                number += 1
                value, has_digest = _value(line, remedy), _has_digest(line, remedy)
                if number == 1 and not (checked := has_digest):
                    note_unchecked(path)
                if has_digest is not checked:
                    raise ValueError(f"is damaged: it or others have no digest; {remedy}")
                yield read(value, number)
        except UnicodeDecodeError:
            raise ValueError(f"{path}: is not UTF-8 text, as {kind} is") from None
        except ValueError as error:
            raise ValueError(f"{path}:{number}: {error}") from None


def _has_digest(line: str, remedy: str) -> bool:
    try:
        return is_as_written(line.encode())
    except ValueError as error:
        raise ValueError(f"{error}; {remedy}") from None


def _value(line: str, remedy: str) -> Any:
    try:
        return json.loads(line)
    except RecursionError:
        raise ValueError("is nested too deeply for a line of runs") from None
    except ValueError:
        raise ValueError(f"is not a line of JSON: {line.strip()[:40]!r}; {remedy}") from None
