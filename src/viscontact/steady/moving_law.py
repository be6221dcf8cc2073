"""Contact compliance of two bodies in steady motion, as a sum of exponentials.

The material of the half-space flows through the contact, and so does that of a body that rolls: it
returns after each turn. The material of a body that slides travels with it: its compliance is the
relaxed one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray

from viscontact.grid import Grid
from viscontact.halfspace.moving_load import MovingCompliance
from viscontact.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.materials.material import Material
from viscontact.steady.problem import SteadyProblem
from viscontact.time_integration.prony_approximation import as_exponentials

#: Times of the exponentials that approximate a law, over the time in which half the contact is
#: passed: the least one, of a part of a cell, and the largest one.
SHORTEST, LONGEST = 2e-5, 1e8

#: The largest one of line contacts, over the time in which the longer side of the grid is passed.
#: Later creep turns the surface by an angle, which is added: the series has the least error so.
LONGEST_OF_LINES = 1e5

#: Slow retardation that represents flow: its length over the size of the grid. Friction deviates by
#: about its reciprocal.
FLOW_LENGTH = 1e8

#: A slope of ln J over ln t above this is flow; growth of a law of less than this is none.
FLOW_EXPONENT, LITTLE_GROWTH = 0.99, 0.01

#: Retardation time that represents the flow of a series for a solid, over its last time.
SLOW = 100.0

#: Growth of J in a decade, over J, and over the decade before, that is rounding.
SATURATED, TINY = 1e-12, 1e-9


@dataclass(frozen=True, eq=False)
class MovingLaw:
    """J(t) of the bodies, for all speeds of a run."""

    instant: float  # with the relaxed compliance of a body that slides [1/Pa]
    amplitudes: NDArray[np.float64]  # [1/Pa]
    times: NDArray[np.float64]  # retardation times [s]
    #: Way after which the same material returns [m]: the circumference for that of a roller.
    periods: NDArray[np.float64]
    fluidity: float  # of the half-space [1/(Pa s)]
    error: float  # relative error of J
    #: Creep of the half-space beyond the series, ∫ J'(t) dt/t [1/(Pa s)].
    late_creep: float = 0.0

    def at(self, speed: float, extent: float) -> MovingCompliance:
        """Compliance at a speed [m/s], for contacts that are small against an extent [m]."""
        amplitudes, lengths, periods = self.amplitudes, speed * self.times, self.periods
        if self.fluidity:
            flow = FLOW_LENGTH * extent
            amplitudes = np.append(amplitudes, self.fluidity * flow / speed)
            lengths, periods = np.append(lengths, flow), np.append(periods, np.inf)
        return MovingCompliance(self.instant, amplitudes, lengths, periods, self.late_creep / speed)


def moving_law(problem: SteadyProblem, extents: tuple[float, float]) -> MovingLaw:
    """Law of the bodies of a problem.

    `extents` are the contact's lengths along the motion at the fastest and slowest speed [m].
    """
    speeds = problem.speeds
    first = SHORTEST * extents[0] / float(speeds.max())
    grid = problem.contact.grid
    if isinstance(grid, Grid) and not grid.has_datum:
        last = LONGEST_OF_LINES * max(grid.size) / float(speeds.min())
    else:
        last = LONGEST * extents[1] / float(speeds.min())
    material, mate = problem.contact.material, problem.contact.indenter_material
    assert isinstance(material, Material)  # layers are refused
    assert isinstance(mate, Material | None)
    series, error, late_creep = _series(material.contact_compliance(), first, last)
    law = MovingLaw(
        series.instant,
        series.amplitudes,
        series.times,
        np.full(series.times.shape, np.inf),
        series.fluidity,
        error,
        late_creep,
    )
    if mate is None:
        return law
    compliance = mate.contact_compliance()
    if problem.rolling and not compliance.is_elastic:
        curvature = problem.contact.indenter.curvatures[problem.axis]
        return _with_roller(law, compliance, 2 * np.pi / curvature, first, last)
    relaxed = _relaxed(compliance, last, "slides")
    return replace(law, instant=law.instant + relaxed)


def flows(compliance: ContactCompliance, late: float) -> bool:
    """True for a fluid, which creeps in proportion to time at a late one [s]."""
    if isinstance(compliance, SeriesCompliance):
        return compliance.fluidity > 0
    at = compliance(np.array([late, 10 * late]))
    return bool(np.log10(at[1] / at[0]) > FLOW_EXPONENT)


def _series(
    compliance: ContactCompliance, first: float, last: float
) -> tuple[SeriesCompliance, float, float]:
    """Series between two times [s], its relative error, and the creep beyond, ∫ J'(t) dt/t.

    Only a fluid's series has a fluidity.
    """
    if isinstance(compliance, SeriesCompliance):
        return compliance, 0.0, 0.0
    series, error = as_exponentials(compliance, first, last)
    if flows(compliance, last):
        return series, error, 0.0
    slow = SLOW * last
    amplitudes = np.append(series.amplitudes, series.fluidity * slow)
    solid = SeriesCompliance(series.instant, amplitudes, np.append(series.times, slow))
    return solid, error, _late_creep(compliance, series, last)


def _late_creep(compliance: ContactCompliance, series: SeriesCompliance, last: float) -> float:
    """∫ J'(t) dt/t beyond the last time of a series, less that of the series [1/(Pa s)].

    J is continued as a power of time, J(last) + B ((t/last)^β - 1), through two later values, the
    flow of the series as a slow retardation, which is slower than flow before the last time, too.
    """
    at = compliance(last * np.array([1.0, 10.0, 100.0]))
    first, second = np.diff(at).tolist()
    if first <= SATURATED * at[0]:
        return 0.0
    exponent = float(np.log10(max(second, TINY * first) / first))
    whole = first * exponent / (np.expm1(exponent * np.log(10)) * (1 - exponent) * last)
    own = float((series.amplitudes / series.times) @ scipy.special.exp1(last / series.times))
    return float(whole - own - series.fluidity * (np.log(SLOW) - np.euler_gamma))


def _with_roller(
    law: MovingLaw, compliance: ContactCompliance, period: float, first: float, last: float
) -> MovingLaw:
    """Law with the material of a roller, which returns after a period [m]."""
    _relaxed(compliance, last, "rolls")
    series, error, _ = _series(compliance, first, last)
    return replace(
        law,
        instant=law.instant + series.instant,
        amplitudes=np.append(law.amplitudes, series.amplitudes),
        times=np.append(law.times, series.times),
        periods=np.append(law.periods, np.full(series.times.shape, period)),
        error=max(law.error, error),
    )


def _relaxed(compliance: ContactCompliance, late: float, moves: str) -> float:
    """Compliance of an indenter after a long time [1/Pa]; refuses one that creeps for ever."""
    if isinstance(compliance, SeriesCompliance):
        endless = compliance.fluidity > 0
        relaxed = compliance.instant + float(compliance.amplitudes.sum())
    else:
        before, relaxed = compliance(np.array([late, 100 * late])).tolist()
        endless = relaxed > (1 + LITTLE_GROWTH) * before
    if endless:
        raise ValueError(
            f"indenter_material: the material of a body that {moves} carries the load for ever, "
            "and this one creeps without limit, so that there is no steady state; use a solid, "
            "such as a Zener law"
        )
    return relaxed
