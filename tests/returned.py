"""Loops over what is returned: over nothing they would assert nothing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeVar

Value = TypeVar("Value")


def some(values: Iterable[Value]) -> Iterator[Value]:
    """Values one by one, of which there must be at least one.

    They are not collected before: a run advances from one to the next.
    """
    found = False
    for value in values:
        found = True
        yield value
    assert found, "nothing to loop over"
