"""Rules of a time-temperature shift with unknown parameters, for fits."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import WLF, Arrhenius, Shift, TabulatedShift
from viscontact.bodies.laws.time_temperature import GAS_CONSTANT, LARGEST_FACTOR

#: Names of the rules.
RULES = ("arrhenius", "wlf", "table")

#: Range of 1/C_2 of a WLF rule [1/K]: below, it is an exponential; above, times the distance from
#: the coldest temperature to the pole.
LEAST_BEND, MOST_BEND = 1e-5, 0.95

#: Largest change of ln a_T over a record.
MOST_SHIFT = math.log(LARGEST_FACTOR) * (1 - 1e-9)

#: Least activation energy, and slope of log10 a_T at the reference [J/mol, 1/K].
LEAST_ENERGY, LEAST_SLOPE = 1e2, 1e-6

#: Least fall of ln a_T between two rows of a table.
LEAST_FALL = 1e-6

#: Activation energies that are searched [J/mol].
ENERGIES = np.geomspace(1e4, 1e6, 25)


Interval = tuple[float, float]


class ShiftRule(ABC):
    """A rule whose unknowns are any numbers within bounds."""

    name: str
    reference: float

    @abstractmethod
    def start(self, energy: float) -> Floats:
        """Unknowns that are nearest to an activation energy [J/mol]."""

    @abstractmethod
    def shift(self, free: Floats) -> Shift:
        """The rule with its unknowns."""

    @abstractmethod
    def parameters(self, free: Floats) -> dict[str, float]:
        """Parameters in SI units."""

    @abstractmethod
    def intervals(self, free: Floats, reach: Floats, correlation: Floats) -> Mapping[str, Interval]:
        """Intervals of the parameters, from the reach and correlation of the unknowns."""

    @property
    @abstractmethod
    def bounds(self) -> tuple[Floats, Floats]:
        """Lower and upper bounds of the unknowns."""


@dataclass(frozen=True)
class ArrheniusRule(ShiftRule):
    """Arrhenius rule; its unknown is ln E_a."""

    reference: float  # [K]
    span: Interval  # temperatures of the record [K]
    name = "arrhenius"

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Lower and upper bounds of the unknown."""
        most = (
            MOST_SHIFT * GAS_CONSTANT / _reach(self.span, self.reference, lambda kelvin: 1 / kelvin)
        )
        return np.log([LEAST_ENERGY]), np.log([most])

    def start(self, energy: float) -> Floats:
        """Unknowns that are nearest to an activation energy [J/mol]."""
        return np.array([np.log(energy)])

    def shift(self, free: Floats) -> Arrhenius:
        """The rule with its unknown."""
        return Arrhenius(self.reference, float(np.exp(free[0])))

    def parameters(self, free: Floats) -> dict[str, float]:
        """Activation energy [J/mol]."""
        return {"activation_energy": float(np.exp(free[0]))}

    def intervals(self, free: Floats, reach: Floats, correlation: Floats) -> Mapping[str, Interval]:
        """Interval of the activation energy [J/mol]."""
        del correlation
        low, high = np.exp(free[0] - reach[0]), _exp(free[0] + reach[0])
        return {"activation_energy": (float(low), float(high))}


@dataclass(frozen=True)
class WlfRule(ShiftRule):
    """WLF rule; its unknowns are ln(C_1/C_2), the slope, and 1/C_2, the bend."""

    reference: float  # [K]
    span: Interval  # temperatures at which it has to hold [K]
    name = "wlf"

    def start(self, energy: float) -> Floats:
        """Unknowns that are nearest to an activation energy [J/mol]."""
        # With C_2 = T_r it is the Arrhenius rule itself.
        bend = min(1 / self.reference, float(self.bounds[1][1]) / 2)
        slope = energy / (GAS_CONSTANT * self.reference**2 * np.log(10.0))
        return np.array([np.log(slope), bend])

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Lower and upper bounds of the unknowns."""
        below = self.reference - self.span[0]
        bend = MOST_BEND / below if below > 0 else 1.0
        # With the most bend the coldest temperature is 1/(1 - MOST_BEND) times as far.
        reach = _reach(self.span, self.reference, lambda kelvin: kelvin) / (1 - MOST_BEND)
        slope = MOST_SHIFT / (np.log(10.0) * reach)
        return np.array([np.log(LEAST_SLOPE), LEAST_BEND]), np.array(
            [np.log(slope), min(bend, 1.0)]
        )

    def shift(self, free: Floats) -> WLF:
        """The rule with its unknowns."""
        return WLF(self.reference, float(np.exp(free[0]) / free[1]), float(1 / free[1]))

    def parameters(self, free: Floats) -> dict[str, float]:
        """Constants C_1 of the decimal logarithm [-] and C_2 [K]."""
        return {"c1": float(np.exp(free[0]) / free[1]), "c2": float(1 / free[1])}

    def intervals(self, free: Floats, reach: Floats, correlation: Floats) -> Mapping[str, Interval]:
        """Intervals of both constants."""
        least = free[1] - reach[1]
        c2 = (float(1 / (free[1] + reach[1])), float(1 / least) if least > 0 else np.inf)
        # ln C_1 = ln(slope) - ln(bend)
        bend = reach[1] / free[1]
        spread = reach[0] ** 2 + bend**2 - 2 * correlation[0, 1] * reach[0] * bend
        factor = float(_exp(np.sqrt(np.maximum(spread, 0.0))))
        c1 = float(np.exp(free[0]) / free[1])
        return {"c1": (c1 / factor, c1 * factor if least > 0 else np.inf), "c2": c2}


@dataclass(frozen=True, eq=False)
class TableRule(ShiftRule):
    """Factors at given temperatures; its unknowns are the logarithms of the falls of ln a_T."""

    reference: float  # [K]
    temperatures: Floats  # increasing [K]
    name = "table"

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Lower and upper bounds of the unknowns."""
        count = self.temperatures.size - 1
        return np.full(count, np.log(LEAST_FALL)), np.full(count, np.log(MOST_SHIFT / count))

    def start(self, energy: float) -> Floats:
        """Unknowns that are nearest to an activation energy [J/mol]."""
        return np.asarray(np.log(-np.diff(energy / GAS_CONSTANT / self.temperatures)))

    def shift(self, free: Floats) -> TabulatedShift:
        """The rule with its unknowns."""
        return TabulatedShift(self.temperatures.tolist(), np.exp(self._logs(free)).tolist())

    def parameters(self, free: Floats) -> dict[str, float]:
        """The factors, by their temperature."""
        return dict(zip(self._names, np.exp(self._logs(free)).tolist(), strict=True))

    def intervals(self, free: Floats, reach: Floats, correlation: Floats) -> Mapping[str, Interval]:
        """Intervals of the factors."""
        falls = np.exp(free) * reach
        unit = np.eye(free.size)
        steps = np.concatenate([np.zeros((1, free.size)), -np.tril(np.ones_like(unit))])
        at_reference = [np.interp(self.reference, self.temperatures, each) for each in steps.T]
        turned = (steps - np.array(at_reference)) * falls
        spread = np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", turned, correlation, turned), 0.0))
        logs = self._logs(free)
        low, high = np.exp(logs - spread).tolist(), _exp(logs + spread).tolist()
        return dict(zip(self._names, zip(low, high, strict=True), strict=True))

    @property
    def _names(self) -> list[str]:
        return [f"a_T at {each:.6g} K" for each in self.temperatures]

    def _logs(self, free: Floats) -> Floats:
        logs = np.append(0.0, -np.cumsum(np.exp(free)))
        return np.asarray(logs - np.interp(self.reference, self.temperatures, logs))


def _exp(logs: Floats) -> Floats:
    """Exponential, inf of an interval without an end."""
    with np.errstate(over="ignore"):
        return np.asarray(np.exp(logs))


def _reach(span: Interval, reference: float, scale: Callable[[float], float]) -> float:
    """Largest distance of two of the temperatures of a record and its reference, on a scale."""
    places = [scale(each) for each in (*span, reference)]
    return max(places) - min(places)


def table_of(levels: Floats, span: Interval, reference: float) -> TableRule:
    """Table whose rows are the levels of a record, and its ends beyond them [K]."""
    ends = min(span[0], reference), max(span[1], reference)
    inner = levels[(levels > ends[0] + 1.0) & (levels < ends[1] - 1.0)]
    return TableRule(reference, np.concatenate([[ends[0]], inner, [ends[1]]]))
