"""Material with its name, source and measured range, for display."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeGuard

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import SeriesLaw, Shift, TabulatedCreep, TabulatedRelaxation
from viscontact.bodies.materials.library import Entry, Points
from viscontact.bodies.materials.material import Material

# Time span for a law without time constants [s].
_ANY_TIMES = (1e-3, 1e6)


@dataclass(frozen=True)
class MaterialDisplay:
    """Material to show or to write, with its library entry or its data from a card."""

    name: str  # shipped name or file
    material: Material
    entry: Entry | None = None
    card_name: str = ""
    shift: Shift | None = None
    notes: tuple[str, ...] = ()  # contents of the file that are not used

    @property
    def measured(self) -> tuple[float, float] | None:
        """First and last measured time, None where unknown [s]."""
        if self.entry is not None:
            return self.entry.measured
        until = self.material.known_until
        if not math.isfinite(until):
            return None
        law = self.material.law
        return (law.times[0] if _is_table(law) else 0.0, until)

    @property
    def points(self) -> tuple[Points, ...]:
        """Measured values of the library's source, or the rows of a table."""
        if self.entry is not None:
            return self.entry.points
        law = self.material.law
        if isinstance(law, TabulatedCreep):
            return (_rows("creep_compliance", law.times, law.compliance),)
        if isinstance(law, TabulatedRelaxation):
            return (_rows("relaxation_modulus", law.times, law.modulus),)
        return ()

    def span(self) -> tuple[float, float]:
        """First and last time above 0 that the law is known for [s]."""
        law = self.material.law
        if _is_table(law):
            return min(time for time in law.times if time > 0), law.times[-1]
        own = _own_times(self.material)
        if self.measured is None:
            return own
        first, last = self.measured
        return first or last * 1e-4, last

    def times(self) -> tuple[float, float]:
        """First and last time of a display [s]: a decade beyond the known times."""
        first, last = self.span()
        # Whole decades give round times in a table.
        low = math.floor(math.log10(first) + 1e-9)
        high = math.ceil(math.log10(last) - 1e-9)
        margin = 1 if self.measured else 0
        return 10.0 ** (low - margin), 10.0 ** (max(high, low + 1) + margin)


def _is_table(law: object) -> TypeGuard[TabulatedCreep | TabulatedRelaxation]:
    return isinstance(law, TabulatedCreep | TabulatedRelaxation)


def _rows(quantity: str, times: Sequence[float], values: Sequence[float]) -> Points:
    # A logarithmic axis has no 0.
    at, measured = np.asarray(times, dtype=np.float64), np.asarray(values, dtype=np.float64)
    return Points(quantity, "the table's rows", at[at > 0], measured[at > 0], 0.0)


def _own_times(material: Material) -> tuple[float, float]:
    """Time span over which a law of exponentials changes [s]."""
    law = material.law
    times = law.creep_series().times if isinstance(law, SeriesLaw) else ()
    return (min(times) / 100, max(times) * 100) if times else _ANY_TIMES
