"""Scale of a quantity over the surface: range, levels, unit and colours."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.look import PRESSURE, SIGNED, shades
from viscontact.drawing.content.panel import Units
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Steps between levels or ticks, of a decade.
_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
#: Part of the colours that is used: the palest one differs from the white without contact, and the
#: darkest one from the labels of contours.
_PART = 0.1, 0.7


@dataclass(frozen=True, eq=False)
class ColourScale:
    """Range and levels of a quantity, with their unit, and the colours that show it."""

    quantity: str
    unit: ReadableUnit
    limits: tuple[float, float]  # of what is shown [SI]
    levels: Floats  # round numbers in the unit around what is labelled [SI]
    is_open: bool = False  # largest values lie above the last level, since they depend on the mesh
    diverges: bool = False  # from 0, which has the palest colour

    @property
    def label(self) -> str:
        """Quantity with its unit."""
        return self.unit.label(self.quantity)

    def colours(self, count: int) -> list[str]:
        """Colours from the lower to the upper limit."""
        if not self.diverges:
            return shades(PRESSURE, count, *_PART)
        low, high = self.limits
        return shades(SIGNED, count, *(0.5 + each / max(-low, high) / 2 for each in (low, high)))


def pressure_scale(
    low: float,
    high: float,
    ordinary: float | None = None,
    *,
    quantity: str = "Pressure",
    most: int = 10,
    units: Units = readable_unit,
) -> ColourScale:
    """Scale of a pressure or a stress from the least to the largest [Pa], with 0."""
    low, unit = min(low, 0.0), units("Pa", low, high)
    # `ordinary` is the largest pressure that does not depend on the mesh [Pa], if others do: levels
    # up to the peak would concentrate at the edge.
    top = high if ordinary is None else ordinary
    levels = round_levels(low / unit.factor, top / unit.factor, most) * unit.factor
    return ColourScale(quantity, unit, (low, high), levels, ordinary is not None, low < 0)


def round_levels(low: float, high: float, most: int) -> Floats:
    """Round numbers at equal steps from `low` or below to `high` or beyond, `most` + 1 or so."""
    step = round_step((high - low) / most)
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    return np.asarray(step * np.arange(first, last + 1), dtype=np.float64)


def round_step(least: float) -> float:
    """Smallest round number that is not below another one."""
    decade = 10.0 ** math.floor(math.log10(least))
    return next(step * decade for step in _STEPS if step * decade >= least * (1 - 1e-9))
