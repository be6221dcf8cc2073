"""Surface of the bodies in contact: creep functions and the frequency responses that they multiply.

Under a wave of pressure of wave number q the surfaces of both bodies are displaced together by

    u(q, t) = Σ (2/q) L_m(q) ∫ J_m(t - t') dp(q, t').

A half-space is one such term, with L = 1. So is a body of layers whose materials creep alike at
constant Poisson's ratios (by Lee's correspondence principle: L depends on the ratios of the moduli
only), such as a single layer on a rigid base. Other layers take a few terms (`separation`). Terms
of proportional creep functions are added.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import repeat

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.compliance import (
    ClockedCompliance,
    ContactCompliance,
    LawCompliance,
    SeriesCompliance,
)
from viscontact.bodies.materials.layers import Layered, materials_of, without_ends
from viscontact.bodies.materials.material import Material
from viscontact.mechanics import problem
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.ended_response import EndedLayers, EndedResponse
from viscontact.mechanics.halfspace.surface_response import (
    HALF_SPACE,
    SummedResponse,
    SurfaceResponse,
)
from viscontact.mechanics.problem.series_body import ANY_TIMES, Span, is_series

#: Relative difference of two creep functions that count as proportional.
PROPORTIONAL = 1e-12

#: Time at which a creep function without an end is taken as late [s].
LATE = 1e9

#: Part of the largest growth of a creep function from which on a term counts as creeping most.
NEARLY_MOST = 0.5

#: Rounding of the response to short waves of a term that they do not see [-].
ROUNDING = 1e-6


@dataclass(frozen=True, eq=False)
class SurfaceTerm:
    """A creep function J(t) [1/Pa] times a frequency response L(q) [-]."""

    compliance: ContactCompliance
    response: SurfaceResponse

    @property
    def is_local(self) -> bool:
        """True if short waves see the term, beyond rounding."""
        return abs(self.response.short_waves) > ROUNDING


@dataclass(frozen=True, eq=False)
class SurfaceTerms:
    """Terms of the surfaces of both bodies together."""

    terms: tuple[SurfaceTerm, ...]  # the first is one that short waves see
    splitting_error: float = 0.0  # bound of the relative error of the sum [-]; 0 if exact
    tops: tuple[ContactCompliance, ...] = ()  # contact compliances at the surfaces of the bodies

    @cached_property
    def compliance(self) -> ContactCompliance:
        """J(t) of short waves, which do not feel the layers [1/Pa]."""
        local = [term for term in self.terms if term.is_local]
        if any(term.response.short_waves < 0 for term in local):
            # Terms that cancel are no creep functions of their own, but their sum is.
            return together(list(self.tops))
        return together([term.compliance.scaled(term.response.short_waves) for term in local])

    @cached_property
    def creep(self) -> ContactCompliance:
        """Sum of the creep functions of all terms, for times and rates of creep [1/Pa]."""
        return together([term.compliance for term in self.terms])

    @cached_property
    def most_creeping(self) -> int:
        """Index of the term that creeps most over its instant compliance, the first of several."""
        growth = [_growth(term.compliance) for term in self.terms]
        return next(k for k, own in enumerate(growth) if own >= NEARLY_MOST * max(growth))

    @cached_property
    def clocks(self) -> tuple[Clock, ...]:
        """Different clocks of the terms, besides the time."""
        clocks = dict.fromkeys(term.compliance.clock for term in self.terms)
        return tuple(clock for clock in clocks if clock is not TIME)

    @property
    def is_supported(self) -> bool:
        """True on a rigid base, which a mean pressure does not displace without limit."""
        return all(np.isfinite(term.response.mean_displacement) for term in self.terms)

    def response_at(self, time: float) -> SurfaceResponse:
        """Response of the elastic body that the surface is at a time after a jump [s]."""
        if len(self.terms) == 1:
            return self.terms[0].response
        creep = [_creep_until(term.compliance, time) for term in self.terms]
        parts = tuple(term.response for term in self.terms)
        local = sum(j * part.short_waves for j, part in zip(creep, parts, strict=True))
        return SummedResponse(parts, tuple(j / local for j in creep))


def surface_of(
    bodies: Sequence[Material | Layered],
    spans: Sequence[Span] = (),
    clocks: Sequence[Clock] = (),
    ends: Sequence[Body | None] = (),
) -> SurfaceTerms:
    """Terms of the bodies that deform, with the clock and the ends of each.

    `spans` are those of the reduced times of interest [s], one for each body.
    """
    terms: list[SurfaceTerm] = []
    error = 0.0
    for body, span, clock, ended in zip(
        bodies,
        spans or repeat(ANY_TIMES),
        clocks or repeat(TIME),
        ends or repeat(None),
        strict=False,
    ):
        for new in terms_of(body, span) if ended is None else [ended_term(ended, body)]:
            clocked = SurfaceTerm(on_clock(new.compliance, clock), new.response)
            terms = _with_term(terms, clocked)
        if isinstance(body, Layered) and as_elastic(body) is None:
            error = max(error, problem.separation.separate(body, span).error)
    tops = tuple(
        on_clock(materials_of(body)[0].contact_compliance(), clock)
        for body, clock in zip(bodies, clocks or repeat(TIME), strict=False)
    )
    return SurfaceTerms(tuple(terms), error, tops)


def clock_of(body: Material | Layered, temperature: TemperatureHistory | None) -> Clock:
    """Clock of all creep of a body; ValueError for layers with different ones."""
    if isinstance(body, Material):
        return body.clock(temperature)
    clocks = dict.fromkeys(part.clock(temperature) for part in body.materials if creeps(part))
    if len(clocks) > 1:
        raise ValueError(
            "temperature: the materials of a body of layers that creep must have the same shift "
            "and ageing, as their responses to waves of pressure mix; give them one shift, or let "
            "only one of them creep"
        )
    return next(iter(clocks), TIME)


def on_clock(compliance: ContactCompliance, clock: Clock) -> ContactCompliance:
    """Creep function over the reduced time of a clock; as it is if elastic."""
    if clock is TIME or compliance.is_elastic:
        return compliance
    return ClockedCompliance(compliance, clock)


def together(functions: list[ContactCompliance]) -> ContactCompliance:
    """Sum of creep functions; with different clocks, that on the one that is ahead at last."""
    clocks = {each.clock for each in functions if not each.is_elastic}
    laws = [each.over_reduced_time for each in functions]
    total = sum(laws[1:], start=laws[0])
    clock = max(clocks, key=lambda each: float(each.reduced(np.array(LATE))), default=TIME)
    return total if clock is TIME else ClockedCompliance(total, clock)


def _with_term(terms: list[SurfaceTerm], new: SurfaceTerm) -> list[SurfaceTerm]:
    """Terms with another one, added to one of its response or of a proportional creep function."""
    for index, known in enumerate(terms):
        if known.response == new.response and _same_clock(known, new):
            added = SurfaceTerm(together([known.compliance, new.compliance]), known.response)
            return [*terms[:index], added, *terms[index + 1 :]]
        factor = proportion(new.compliance, known.compliance)
        if factor is not None:
            shares = 1 / (1 + factor), factor / (1 + factor)
            both = SummedResponse((known.response, new.response), shares)
            joined = SurfaceTerm(together([known.compliance, new.compliance]), both)
            return [*terms[:index], joined, *terms[index + 1 :]]
    return [*terms, new]


def _same_clock(one: SurfaceTerm, other: SurfaceTerm) -> bool:
    """True for two of one clock, or with an elastic one."""
    both = one.compliance, other.compliance
    return both[0].clock == both[1].clock or any(each.is_elastic for each in both)


def terms_of(body: Material | Layered, span: Span = ANY_TIMES) -> list[SurfaceTerm]:
    """Terms of one body; `span` is that of the times of interest [s].

    >>> from viscontact.bodies.laws import Elastic
    >>> steel = Material(Elastic(80e9), poisson_ratio=0.3)
    >>> [term.response is HALF_SPACE for term in terms_of(steel)]
    [True]
    """
    if isinstance(body, Material):
        return [SurfaceTerm(body.contact_compliance(), HALF_SPACE)]
    creeps_alike = as_elastic(body)
    if creeps_alike is not None:
        return [SurfaceTerm(body.layers[0].material.contact_compliance(), creeps_alike)]
    found = problem.separation.separate(body, span)
    return [SurfaceTerm(*pair) for pair in zip(found.compliances, found.responses, strict=True)]


def ended_term(body: Body, material: Material | Layered) -> SurfaceTerm:
    """Term of a body that ends, with its material at the temperature of the run."""
    top = materials_of(material)[0]
    return SurfaceTerm(top.contact_compliance(), ended_response(body, material))


def ended_response(body: Body, material: Material | Layered) -> EndedResponse:
    """Response of a body that ends, with its material at the temperature of the run."""
    ratio = materials_of(material)[0].poisson_ratio
    assert ratio is not None  # refused otherwise
    before, after = (kind == "free" for kind in body.ends)
    shared = (ratio, body.planes, (before, after))
    if isinstance(material, Material):
        return EndedResponse(*shared)
    stack = as_elastic(material)
    if stack is None:
        raise ValueError(
            "ends: the layers of a body that ends must creep alike, at constant Poisson's ratios, "
            "as what an end adds is not known otherwise; give one material, or leave the ends out"
        )
    return EndedLayers(*shared, stack)


def as_elastic(body: Layered) -> ElasticStack | None:
    """Elastic stack of the ratios of the moduli, None if they or Poisson's ratios vary in time."""
    top, *others = (contact_creep(material) for material in body.materials)
    ratios = [1.0]
    for other in others:
        factor = None if top is None or other is None else proportion(other, top)
        if factor is None:
            return None
        ratios.append(factor)
    if top is None:
        return None
    constants = [
        (1 / ratio * (1 - nu), nu)
        for ratio, nu in zip(ratios, map(constant_poisson_ratio, body.materials), strict=True)
        if nu is not None
    ]
    return problem.separation.stack_of(body, constants)


def follows_span(body: Material | Layered) -> bool:
    """True for layers whose terms depend on the times of interest, as a law is approximated.

    >>> from viscontact.bodies.laws import Elastic, PowerLaw
    >>> from viscontact.bodies.materials.layers import Layer
    >>> rubber = Material(PowerLaw(1e-6, 0.3, 1.0), poisson_ratio=0.5)
    >>> steel = Material(Elastic(80e9), poisson_ratio=0.3)
    >>> [follows_span(Layered([Layer(1e-3, rubber)], base)) for base in ("rigid", steel)]
    [False, True]
    """
    if isinstance(body, Material) or as_elastic(body) is not None:
        return False
    return not all(is_series(material.law) for material in body.materials)


def creeps(body: Material | Layered | Body) -> bool:
    """True for a body of which a part creeps or flows.

    >>> from viscontact.bodies.laws import Maxwell
    >>> creeps(Material(Maxwell(1e6, 1e6), poisson_ratio=0.5))
    True
    """
    return not all(
        part.contact_compliance().is_elastic for part in materials_of(without_ends(body))
    )


def contact_creep(material: Material) -> ContactCompliance | None:
    """Contact compliance of a material whose Poisson's ratio is constant, else None."""
    return None if constant_poisson_ratio(material) is None else material.contact_compliance()


def constant_poisson_ratio(material: Material) -> float | None:
    """Poisson's ratio; None if it varies in time."""
    if material.poisson_ratio is not None:
        return material.poisson_ratio
    if not material.contact_compliance().is_elastic:
        return None
    assert material.bulk_modulus is not None  # exactly one is given
    shear, bulk = 0.5 / float(material.law(0.0)), material.bulk_modulus
    return (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))


def _growth(compliance: ContactCompliance) -> float:
    """Creep function after all creep, or a long time, over the instantaneous one [-]."""
    if compliance.is_elastic:
        return 1.0
    late = min(compliance.settled_after, LATE)
    return float(compliance(late)) / compliance.instant if compliance.instant > 0 else np.inf


def _creep_until(compliance: ContactCompliance, time: float) -> float:
    """J at a time, at the end of all creep if that is earlier [1/Pa]."""
    settled = compliance.settled_after
    return float(compliance(min(time, settled) if settled > 0 else 0.0))


def proportion(one: ContactCompliance, other: ContactCompliance) -> float | None:
    """Constant factor by which a creep function is larger than another, None if there is none.

    >>> proportion(SeriesCompliance(3.0, [6.0], [1.0]), SeriesCompliance(1.0, [2.0], [1.0]))
    3.0
    """
    if one.clock != other.clock:
        return None
    one, other = one.over_reduced_time, other.over_reduced_time
    if isinstance(one, LawCompliance) and isinstance(other, LawCompliance):
        return one.factor / other.factor if one.law == other.law else None
    if not (isinstance(one, SeriesCompliance) and isinstance(other, SeriesCompliance)):
        return None
    if one.times.size != other.times.size or (one.times != other.times).any():
        return None
    first, second = (
        np.array([each.instant, each.fluidity, *each.amplitudes]) for each in (one, other)
    )
    factor = float(first.sum() / second.sum())
    return factor if np.allclose(first, factor * second, rtol=PROPORTIONAL, atol=0.0) else None
