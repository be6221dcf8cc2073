"""Properties of an axis, as a pair along x and y."""

from __future__ import annotations

import numpy as np


class AxisFlags(tuple[bool, bool]):
    """Property that holds or not along x and y: a bool if both agree, otherwise a pair."""

    # If they differ it has no truth value: a condition on it would mean one axis or the other.

    __slots__ = ()

    def __new__(cls, given: object, name: str = "value") -> AxisFlags:
        """Return the pair of a bool, for both axes, or of two; `name` is for messages."""
        pair = tuple(given) if isinstance(given, tuple | list) else (given, given)
        if len(pair) != 2 or not all(isinstance(each, bool | np.bool_) for each in pair):
            raise ValueError(
                f"{name} must be true or false, got {given!r}; a pair of these gives x and y each "
                "its own"
            )
        return super().__new__(cls, (bool(pair[0]), bool(pair[1])))

    @property
    def plain(self) -> bool | tuple[bool, bool]:
        """The value of both axes if they agree, else the pair."""
        return self[0] if self[0] == self[1] else (self[0], self[1])

    def __bool__(self) -> bool:
        if self[0] != self[1]:
            raise ValueError(
                f"{self.plain} is neither true nor false: x and y differ; use any(...), all(...), "
                "or the value of one axis"
            )
        return self[0]

    def __eq__(self, other: object) -> bool:
        return self.plain == other or tuple(self) == other

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(self.plain)

    def __repr__(self) -> str:
        return repr(self.plain)


#: Along no axis.
NEITHER = AxisFlags(False)
