"""Isotherm: the measurement of one test at one temperature."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.series_fits.columns import positive_column, require_rows
from viscontact.identification.overlap import TemperatureCurve
from viscontact.units.display import Displayable

#: Columns of each kind of test, and whether the first one rises with time.
KINDS_OF_TEST = ((("compliance",), True), (("modulus",), False), (("storage", "loss"), False))


@dataclass(frozen=True, eq=False)
class Isotherm(Displayable):
    """Measurement of one test at one temperature.

    Parameters
    ----------
    temperature : float
        Absolute temperature > 0 [K]: 20 °C is 293.15 K.
    points : array_like, shape (n,)
        Times >= 0 [s], or with `storage` and `loss` angular frequencies > 0 [rad/s]. In any
        order; two or more above 0.
    measured : mapping of str to array_like
        The columns by name, all > 0: ``compliance`` [1/Pa], or ``modulus`` [Pa], or ``storage``
        and ``loss`` [Pa].

    Raises
    ------
    ValueError
        If a number is not positive, naming its row; if the columns are others.

    Examples
    --------
    >>> warm = Isotherm(303.15, [1.0, 10.0], {"compliance": [1.1e-9, 1.3e-9]})
    >>> warm.points.tolist(), warm.oscillates
    ([1.0, 10.0], False)
    """

    temperature: float
    points: Floats
    measured: Mapping[str, Floats]

    def __post_init__(self) -> None:
        [temperature] = positive_column("Isotherm", "temperature", [self.temperature], "K")
        owner = f"Isotherm at {temperature:.6g} K"
        names = tuple(self.measured)
        if set(names) not in [set(columns) for columns, _ in KINDS_OF_TEST]:
            raise ValueError(
                f"{owner}: measured must have the column compliance, or modulus, or both storage "
                f"and loss, got {', '.join(names) or 'none'}"
            )
        name, unit_of_points = ("angular_frequency", "rad/s") if self.oscillates else ("times", "s")
        points = positive_column(owner, name, self.points, unit_of_points, zero=not self.oscillates)
        unit = "1/Pa" if "compliance" in self.measured else "Pa"
        measured = {
            name: positive_column(owner, name, values, unit)
            for name, values in self.measured.items()
        }
        require_rows(owner, 2, points=points, **measured)
        if np.count_nonzero(points) < 2:
            raise ValueError(f"{owner}: needs at least two rows above 0 {unit_of_points}")
        if np.unique(points).size < points.size:
            raise ValueError(f"{owner}: two rows have the same time or frequency; give one of them")
        object.__setattr__(self, "temperature", float(temperature))
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "measured", measured)

    @property
    def oscillates(self) -> bool:
        """True if the points are angular frequencies."""
        return "storage" in self.measured

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the measured columns, storage before loss."""
        return next(columns for columns, _ in KINDS_OF_TEST if set(columns) == set(self.measured))

    def curve(self) -> TemperatureCurve:
        """Return the set over ln(time), or over -ln(angular frequency), without time 0."""
        later = np.flatnonzero(self.points)
        log_times = np.log(self.points[later]) * (-1 if self.oscillates else 1)
        order = np.argsort(log_times)
        columns = np.array([self.measured[name][later][order] for name in self.columns])
        return TemperatureCurve(log_times[order], np.log(columns))
