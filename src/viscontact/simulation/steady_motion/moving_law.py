"""Contact compliance of two bodies in steady motion, as a sum of exponentials.

The material of the half-space flows through the contact, and so does that of a body that rolls: it
returns after each turn. The material of a body that slides travels with it: its compliance is the
relaxed one. Of layers each term of the surface has a law.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.clock import TIME
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.halfspace.layered_shear import LayeredShear
from viscontact.mechanics.halfspace.moving_load import MovingCompliance, joined
from viscontact.mechanics.halfspace.moving_shear import MovingShear
from viscontact.mechanics.halfspace.moving_surface import MovingSurface
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse
from viscontact.mechanics.problem.shear_terms import shear_terms
from viscontact.mechanics.problem.surface import ROUNDING, SurfaceTerm, ended_term, terms_of
from viscontact.mechanics.time_integration.prony_approximation import as_exponentials
from viscontact.simulation.steady_motion.problem import SteadyProblem

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
    """J(t) of the bodies for all speeds of a run, of one of the terms of their surface."""

    response: SurfaceResponse  # of the term
    instant: float  # with the relaxed compliance of a body that slides [1/Pa]
    amplitudes: Floats  # [1/Pa]
    times: Floats  # retardation times [s]
    #: Way after which the same material returns [m]: the circumference for that of a roller.
    periods: Floats
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

    def with_another(self, other: MovingLaw) -> MovingLaw:
        """Law of this body with that of another one of the same response."""
        return replace(
            self,
            instant=self.instant + other.instant,
            amplitudes=np.append(self.amplitudes, other.amplitudes),
            times=np.append(self.times, other.times),
            periods=np.append(self.periods, other.periods),
            error=max(self.error, other.error),
        )


@dataclass(frozen=True, eq=False)
class MovingLaws:
    """Laws of all terms of the bodies' surface."""

    terms: tuple[MovingLaw, ...]

    @property
    def error(self) -> float:
        """Largest relative error of a J [-]."""
        return max(law.error for law in self.terms)

    @property
    def sinks(self) -> bool:
        """True for a fluid under which nothing stops the flow: the approach grows for ever."""
        flowing = [law for law in self.terms if law.fluidity > 0]
        return any(abs(law.response.long_waves) > ROUNDING for law in flowing)

    @property
    def shortest_period(self) -> float:
        """Shortest way after which material returns [m]; inf if none does."""
        return min(float(law.periods.min(initial=np.inf)) for law in self.terms)

    def at(self, speed: float, extent: float) -> MovingSurface:
        """Surface at a speed [m/s], for contacts that are small against an extent [m]."""
        return MovingSurface(tuple((law.response, law.at(speed, extent)) for law in self.terms))


def moving_laws(problem: SteadyProblem, extents: tuple[float, float]) -> MovingLaws:
    """Laws of the bodies, for lengths of the contact at the fastest and slowest speed [m]."""
    first, last = _times(problem, extents)
    own, *mates = zip(problem.contact.bodies, problem.contact.ends, strict=True)
    found = [_law(term, *_series(term.compliance, first, last)) for term in _terms(*own)]
    for term in (term for mate in mates for term in _terms(*mate)):
        new = _law_of_mate(problem, term, first, last)
        alike = [index for index, law in enumerate(found) if law.response == new.response]
        if alike:
            found[alike[0]] = found[alike[0]].with_another(new)
        else:
            found.append(new)
    return MovingLaws(tuple(found))


def _times(problem: SteadyProblem, extents: tuple[float, float]) -> tuple[float, float]:
    """Shortest and longest times of series, for lengths of the contact [s]."""
    speeds = problem.speeds
    first = SHORTEST * extents[0] / float(speeds.max())
    grid = problem.contact.grid
    if isinstance(grid, Grid) and not grid.has_datum:
        return first, LONGEST_OF_LINES * max(grid.size) / float(speeds.min())
    return first, LONGEST * extents[1] / float(speeds.min())


def _law_of_mate(problem: SteadyProblem, term: SurfaceTerm, first: float, last: float) -> MovingLaw:
    """Law of a term of the indenter, which rolls or slides."""
    compliance = term.compliance
    if problem.motion.rolling and not compliance.is_elastic:
        _relaxed(compliance, last, "rolls")
        curvature = problem.contact.indenter.curvatures[problem.axis]
        series, error, _ = _series(compliance, first, last)
        return _law(term, series, error, 0.0, 2 * np.pi / curvature)
    nothing = np.empty(0)
    relaxed = SeriesCompliance(_relaxed(compliance, last, "slides"), nothing, nothing)
    return _law(term, relaxed, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class ShearLaw:
    """Law of a term of the response to shear, with the weights of its parts [-]."""

    law: MovingLaw
    direct: float  # of the part of 1/r
    poisson: float  # of the part by κ
    coupling: float  # of the part of the pressure; of the indenter it is subtracted
    layers: LayeredShear | None = None  # whose short waves these are


def shear_laws(problem: SteadyProblem, extents: tuple[float, float]) -> tuple[ShearLaw, ...]:
    """Laws of the bodies under shear, as `moving_laws`."""
    first, last = _times(problem, extents)
    found = []
    for place, body in enumerate(problem.contact.bodies):
        for term in shear_terms([body], [TIME]).terms:
            creep = term.compliance if flowing(body) else _without_flow(term.compliance)
            of_pressure = SurfaceTerm(creep, HALF_SPACE)
            law = (
                _law(of_pressure, *_series(of_pressure.compliance, first, last))
                if place == 0
                else _law_of_mate(problem, of_pressure, first, last)
            )
            coupling = term.coupling if place == 0 else -term.coupling
            found.append(ShearLaw(law, term.direct, term.poisson, coupling, term.layers))
    return tuple(found)


def moving_coupling(laws: Sequence[ShearLaw], speed: float, extent: float) -> MovingCompliance:
    """Compliance Σ c J by which pressure and tractions are coupled at a speed [m/s]."""
    # Old creep shifts a line contact as a whole, which makes no difference.
    found = joined([law.law.at(speed, extent).scaled(law.coupling) for law in laws])
    return replace(found, drift=0.0)


def moving_shear(laws: Sequence[ShearLaw], speed: float, extent: float) -> MovingShear:
    """Response to shear at a speed [m/s], for contacts that are small against an extent [m]."""
    moving = [law.law.at(speed, extent) for law in laws]
    pairs = list(zip(laws, moving, strict=True))
    return MovingShear(
        joined([_of_long_waves(law, each.scaled(law.direct)) for law, each in pairs]),
        joined([each.scaled(law.poisson) for law, each in pairs]),
        tuple((law.layers, each) for law, each in pairs if law.layers is not None),
    )


def _of_long_waves(law: ShearLaw, direct: MovingCompliance) -> MovingCompliance:
    """Compliance of the part of 1/r with the slope by old creep of long waves."""
    if law.layers is None or not direct.drift:
        return direct
    share = float(law.layers.long_waves.along / law.layers.short_waves.along)
    return replace(direct, drift=share * direct.drift)


def _terms(body: Material | Layered, ended: Body | None) -> list[SurfaceTerm]:
    """Terms of a body. Those of a layered solid do not flow, however its response is separated."""
    if ended is not None:
        return [ended_term(ended, body)]
    if flowing(body):
        return terms_of(body)
    return [replace(term, compliance=_without_flow(term.compliance)) for term in terms_of(body)]


def flowing(body: Material | Layered) -> bool:
    """True if the terms of a body may flow: if one of its materials does, or is no series."""
    parts = (body,) if isinstance(body, Material) else body.materials
    creep = [part.contact_compliance() for part in parts]
    return any(not isinstance(each, SeriesCompliance) or each.fluidity > 0 for each in creep)


def _without_flow(compliance: ContactCompliance) -> ContactCompliance:
    if isinstance(compliance, SeriesCompliance) and compliance.fluidity:
        return SeriesCompliance(compliance.instant, compliance.amplitudes, compliance.times)
    return compliance


def _law(
    term: SurfaceTerm,
    series: SeriesCompliance,
    error: float,
    late_creep: float,
    period: float = np.inf,
) -> MovingLaw:
    """Law of a term from the series of its creep function; material may return."""
    return MovingLaw(
        term.response,
        series.instant,
        np.asarray(series.amplitudes),
        np.asarray(series.times),
        np.full(np.shape(series.times), period),
        series.fluidity,
        error,
        late_creep,
    )


def flows(compliance: ContactCompliance, late: float) -> bool:
    """True for a fluid, which creeps in proportion to time at a late one [s]."""
    if isinstance(compliance, SeriesCompliance):
        return compliance.fluidity > 0
    at = compliance(np.array([late, 10 * late]))
    return bool(np.log10(at[1] / at[0]) > FLOW_EXPONENT)


def _series(
    compliance: ContactCompliance, first: float, last: float
) -> tuple[SeriesCompliance, float, float]:
    """Series between two times [s], its relative error, and the creep beyond, ∫ J'(t) dt/t."""
    if isinstance(compliance, SeriesCompliance):
        return compliance, 0.0, 0.0
    series, error = as_exponentials(compliance, first, last)
    # Only a fluid's series has a fluidity.
    if flows(compliance, last):
        return series, error, 0.0
    slow = SLOW * last
    amplitudes = np.append(series.amplitudes, series.fluidity * slow)
    solid = SeriesCompliance(series.instant, amplitudes, np.append(series.times, slow))
    return solid, error, _late_creep(compliance, series, last)


def _late_creep(compliance: ContactCompliance, series: SeriesCompliance, last: float) -> float:
    """∫ J'(t) dt/t beyond the last time of a series, less that of the series [1/(Pa s)]."""
    # J is continued as a power of time, J(last) + B ((t/last)^β - 1), through two later values, the
    # flow of the series as a slow retardation.
    at = compliance(last * np.array([1.0, 10.0, 100.0]))
    first, second = np.diff(at).tolist()
    if first <= SATURATED * at[0]:
        return 0.0
    exponent = float(np.log10(max(second, TINY * first) / first))
    whole = first * exponent / (np.expm1(exponent * np.log(10)) * (1 - exponent) * last)
    own = float((series.amplitudes / series.times) @ scipy.special.exp1(last / series.times))
    return float(whole - own - series.fluidity * (np.log(SLOW) - np.euler_gamma))


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
