"""Fit of one curve of many, in numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping

from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True)
class FittedCurve:
    """Fit of one curve of many, in numbers, or the reason why there is none.

    A value that the curve does not determine is NaN; its interval is open.
    """

    name: str
    values: Mapping[str, float]  # parameters, SI
    intervals: Mapping[str, tuple[float, float]]
    units: Mapping[str, str]
    residual: float = math.nan  # root mean square over the largest value [-]
    indentation: float = math.nan  # largest approach [m]
    force: float = math.nan  # largest force [N]
    warning: str = ""
    failure: str = ""
    place: tuple[float, float] | None = None  # x and y in a map [m]
