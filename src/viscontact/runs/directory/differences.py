"""Differences between two descriptions of a run."""

from __future__ import annotations

from typing import Any, NamedTuple

#: Longer values are cut.
_LONGEST = 60


class _Nothing:
    def __str__(self) -> str:
        return "not there"


#: A value that is missing.
NOTHING = _Nothing()


class Difference(NamedTuple):
    """A place where two descriptions differ."""

    where: str  # path of keys
    before: Any  # `NOTHING` where there is no value
    now: Any  # likewise

    def __str__(self) -> str:
        return f"{self.where}: was {_value_text(self.before)}, is now {_value_text(self.now)}"


def differences(before: Any, now: Any, where: str = "") -> tuple[Difference, ...]:
    """Compare dicts, lists, texts and numbers below a path of keys."""
    if isinstance(before, dict) and isinstance(now, dict):
        keys = [*before, *(key for key in now if key not in before)]
        inner = [(f"{where}.{key}".removeprefix("."), key) for key in keys]
        pairs = [(place, before.get(key, NOTHING), now.get(key, NOTHING)) for place, key in inner]
    elif isinstance(before, list) and isinstance(now, list) and len(before) == len(now):
        pairs = [
            (f"{where}[{number}]", one, other)
            for number, (one, other) in enumerate(zip(before, now, strict=True), 1)
        ]
    elif _is_same(before, now):
        return ()
    else:
        return (Difference(where, before, now),)
    return tuple(found for place, one, other in pairs for found in differences(one, other, place))


def _is_same(one: Any, other: Any) -> bool:
    # Two NaN count as equal.
    return bool(one == other or (one != one and other != other))


def _value_text(value: Any) -> str:
    text = f"{len(value)} entries" if isinstance(value, list) else str(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."
