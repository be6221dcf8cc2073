"""Collection of accuracy warnings: each kind is issued once, extents at the largest contact too."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.formatting import format_quantity

#: Ratio of contact areas from which on what was exceeded at first is stated again.
_GROWN = 1.2


@dataclass
class WarningCollector:
    """Accuracy warnings by kind, each issued once."""

    issued: dict[str, str] = field(default_factory=dict)  # sentences issued so far, by kind

    def new(self, *found: dict[str, str]) -> tuple[str, ...]:
        """Keep the sentences of kinds that have not been issued yet, and return them."""
        fresh = {
            kind: text
            for warnings in found
            for kind, text in warnings.items()
            if kind not in self.issued
        }
        self.issued.update(fresh)
        return tuple(fresh.values())


@dataclass(frozen=True)
class LargestExtents:
    """Warnings of extents of the contact: as they are first exceeded, and at its largest.

    A run states a warning when its limit is exceeded, by which the contact may still grow much.
    """

    first: Mapping[str, str] = field(default_factory=dict)  # first sentences by kind
    areas: Mapping[str, float] = field(default_factory=dict)  # contact area then, by kind [m²]
    found: Mapping[str, str] = field(default_factory=dict)  # sentences of the largest contact
    area: float = 0.0  # of the largest contact [m²]
    time: float = 0.0  # of the largest contact [s]

    def after(self, found: Mapping[str, str], area: float, time: float) -> LargestExtents:
        """Return the warnings after a step with a contact area [m²] at a time [s]."""
        first = {**found, **self.first}
        areas = {**dict.fromkeys(found, area), **self.areas}
        if area > self.area:
            return LargestExtents(first, areas, found, area, time)
        return LargestExtents(first, areas, self.found, self.area, self.time)

    def at_end(self) -> dict[str, str]:
        """Sentences of the largest contact where the first ones were of a much smaller one."""
        when = f"at the largest contact, at t = {format_quantity(self.time, 's')},"
        return {
            f"{kind} at largest": f"{when} {text}"
            for kind, text in self.found.items()
            if self.area > _GROWN * self.areas[kind] and text != self.first[kind]
        }
