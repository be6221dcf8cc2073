"""Files with a line of JSON for each run."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

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

    Where lines are `appended` to a first one, a last one without an end is one that a killed
    process has begun.
    """
    with path.open(encoding="utf-8") as lines:
        number = 0
        try:
            while line := lines.readline(_LONGEST_LINE):
                if appended and number and not line.endswith("\n") and not lines.read(1):
                    return
                number += 1
                yield read(_value(line, remedy), number)
        except UnicodeDecodeError:
            raise ValueError(f"{path}: is not UTF-8 text, as {kind} is") from None
        except ValueError as error:
            raise ValueError(f"{path}:{number}: {error}") from None


def _value(line: str, remedy: str) -> Any:
    try:
        return json.loads(line)
    except RecursionError:
        raise ValueError("is nested too deeply for a line of runs") from None
    except ValueError:
        raise ValueError(f"is not a line of JSON: {line.strip()[:40]!r}; {remedy}") from None
