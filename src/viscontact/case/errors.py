"""Errors of a case file, one line for each problem."""

from __future__ import annotations

from collections.abc import Iterable

from viscontact.units.visible import visible

#: Path of a value: keys, and positions in lists from 0.
KeyPath = tuple[str | int, ...]


class CaseError(ValueError):
    """Case that is not valid.

    Parameters
    ----------
    *problems : str
        Problems, a line each: place, key, reason and remedy. Control characters of the file are
        shown as escapes, because a traceback prints the message as it is.

    Attributes
    ----------
    problems : tuple of str
        The same.

    Examples
    --------
    >>> str(CaseError("case.yaml: no such file"))
    'case.yaml: no such file'
    """

    def __init__(self, *problems: str) -> None:
        self.problems = tuple(map(visible, problems))
        super().__init__("\n".join(self.problems))


class SourceError(Exception):
    """Text that is not valid YAML or TOML, with the line of the error."""

    def __init__(self, why: str, line: int | None = None) -> None:
        super().__init__(why)
        self.line = line


def dotted(path: Iterable[str | int]) -> str:
    """Format a key path, with positions in lists in brackets from 1."""
    words = "".join(f"[{key + 1}]" if isinstance(key, int) else f".{key}" for key in path)
    return words.removeprefix(".")
