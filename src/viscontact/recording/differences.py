"""What differs between two descriptions of a run, in words."""

from __future__ import annotations

from typing import Any

#: Longer values are cut.
_LONGEST = 60


def differences(before: Any, now: Any, where: str = "") -> tuple[str, ...]:
    """Compare two pieces of plain data.

    Parameters
    ----------
    before, now : object
        Dicts, lists, texts and numbers.
    where : str
        Where they stand, for the lines.

    Returns
    -------
    tuple of str
        A line for each place where they differ; empty if they are the same.

    Examples
    --------
    >>> differences({"load": {"force": [0.0, 4.0]}}, {"load": {"force": [0.0, 5.0]}})
    ('load.force[2]: was 4.0, is now 5.0',)
    """
    if isinstance(before, dict) and isinstance(now, dict):
        keys = [*before, *(key for key in now if key not in before)]
        inner = [(f"{where}.{key}".removeprefix("."), key) for key in keys]
        pairs = [(place, before.get(key, _NOTHING), now.get(key, _NOTHING)) for place, key in inner]
    elif isinstance(before, list) and isinstance(now, list) and len(before) == len(now):
        pairs = [
            (f"{where}[{number}]", one, other)
            for number, (one, other) in enumerate(zip(before, now, strict=True), 1)
        ]
    elif _is_same(before, now):
        return ()
    else:
        return (f"{where}: was {_shown(before)}, is now {_shown(now)}",)
    return tuple(line for place, one, other in pairs for line in differences(one, other, place))


class _Nothing:
    def __repr__(self) -> str:
        return "not there"


_NOTHING = _Nothing()


def _is_same(one: Any, other: Any) -> bool:
    # NaN differs from itself, but not for us
    return bool(one == other or (one != one and other != other))


def _shown(value: Any) -> str:
    text = f"{len(value)} entries" if isinstance(value, list) else repr(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."
