"""What is wrong with a case file, every problem on a line of its own."""

from __future__ import annotations

from collections.abc import Iterable

#: Where a value stands: keys, and positions in lists from 0.
KeyPath = tuple[str | int, ...]


class CaseError(ValueError):
    """A case that cannot be run as it stands.

    Parameters
    ----------
    *problems : str
        What is wrong, a line each: where, which key, why, and what to do.

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
        super().__init__("\n".join(problems))
        self.problems = problems


class SourceError(Exception):
    """Text that is not YAML or TOML, and the line where that shows."""

    def __init__(self, why: str, line: int | None = None) -> None:
        super().__init__(why)
        self.line = line


def dotted(path: Iterable[str | int]) -> str:
    """Write a key path as a person does, positions in lists in brackets from 1.

    Parameters
    ----------
    path : iterable of str and int
        Keys, and positions in lists from 0.

    Returns
    -------
    str
        The path in words.

    Examples
    --------
    >>> dotted(("material", "times", 0))
    'material.times[1]'
    """
    words = "".join(f"[{key + 1}]" if isinstance(key, int) else f".{key}" for key in path)
    return words.removeprefix(".")
