"""Temperature of the bodies over time."""

from __future__ import annotations

import math
from dataclasses import field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import history_points
from viscontact.units.display import Displayable
from viscontact.units.numbers import finite_array, real_array, store


@dataclass(frozen=True, eq=False, init=False)
class TemperatureHistory(Displayable):
    """A temperature that is uniform in the bodies and varies in time, linear between its points.

    Parameters
    ----------
    times : array_like
        Instants of the points, not decreasing, none before 0; one given twice is a jump, shape
        (n,) [s].
    temperature : float or array_like
        Absolute temperature at the points, above 0 [K]. It is held before the first point and
        after the last one.

    Raises
    ------
    ValueError
        If the arrays do not fit together, the times decrease or come three times or before 0, or a
        temperature is not above 0 K.

    Examples
    --------
    Heated by 20 K in an hour:

    >>> heated = TemperatureHistory([0.0, 3600.0], [293.15, 313.15])
    >>> heated.at([900.0, 1e4]).tolist()
    [298.15, 313.15]
    """

    times: Floats = field(metadata={"unit": "s", "name": "at times"})
    temperature: Floats = field(metadata={"unit": "K"})

    def __init__(self, times: ArrayLike, temperature: ArrayLike) -> None:
        instants = history_points.instants(times)
        values = finite_array("temperature", temperature, "K")
        if values.shape not in ((), instants.shape):
            raise ValueError(
                f"temperature must be a number or have one value for each of the {instants.size} "
                f"times, got shape {values.shape}"
            )
        for wrong in values[values <= 0][:1]:
            raise ValueError(
                f"temperature must be above 0 K, got {wrong:.6g} K; temperatures are absolute: "
                "20 °C is 293.15 K"
            )
        store(self, times=instants, temperature=np.broadcast_to(values, instants.shape))

    def at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the temperature at some times.

        Parameters
        ----------
        times : array_like
            The times [s].
        side : {"right", "left"}
            Which value to take at a jump: the one just after it or the one just before.

        Returns
        -------
        ndarray
            Absolute temperatures, of the shape of `times` [K].
        """
        wanted = real_array("times", times, "s")
        reached = np.searchsorted(self.times, wanted, side=history_points.side_of_jump(side))
        before, after = np.maximum(reached - 1, 0), np.minimum(reached, self.times.size - 1)
        span = self.times[after] - self.times[before]
        passed = wanted - self.times[before]
        part = np.divide(passed, span, out=np.zeros(np.shape(wanted)), where=span > 0)
        low, high = self.temperature[before], self.temperature[after]
        return np.asarray(low + part * (high - low))

    @property
    def is_constant(self) -> bool:
        """True if the temperature never varies."""
        return bool((self.temperature == self.temperature[0]).all())

    @property
    def jumps(self) -> Floats:
        """Instants at which the temperature jumps [s]."""
        same = np.diff(self.times) == 0
        return np.asarray(self.times[1:][same & (np.diff(self.temperature) != 0)])

    @cached_property
    def kinks(self) -> Floats:
        """Instants of its points, jumps among them; smooth in between [s]."""
        return np.unique(self.times)

    @property
    def range(self) -> tuple[float, float]:
        """Lowest and highest temperature [K]."""
        return float(self.temperature.min()), float(self.temperature.max())

    @cached_property
    def steepest(self) -> float:
        """Largest rate of change [K/s]; inf at a jump."""
        if self.jumps.size:
            return math.inf
        spans, changes = np.diff(self.times), np.abs(np.diff(self.temperature))
        return float((changes[spans > 0] / spans[spans > 0]).max(initial=0.0))

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        assert isinstance(other, TemperatureHistory)
        both = (self.times, other.times), (self.temperature, other.temperature)
        return all(np.array_equal(*pair) for pair in both)

    def __hash__(self) -> int:
        return hash((self.times.size, float(self.times[-1]), float(self.temperature[-1])))


def require_constant(temperature: TemperatureHistory) -> None:
    """Refuse a temperature that varies, which a steady motion cannot have."""
    if not temperature.is_constant:
        raise ValueError(
            "temperature: it varies, and a steady motion has one temperature at all speeds; give a "
            "constant one, or a motion over time (travel, reciprocating)"
        )


def as_temperature(given: object) -> TemperatureHistory | None:
    """A temperature history, a number [K] as a constant one, or None; ValueError for others."""
    if given is None or isinstance(given, TemperatureHistory):
        return given
    try:
        return TemperatureHistory([0.0], real_array("temperature", given, "K"))
    except ValueError as error:
        raise ValueError(
            f"temperature must be an absolute temperature in K or a TemperatureHistory: {error}"
        ) from None
