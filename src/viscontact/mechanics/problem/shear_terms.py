"""Surface of the bodies under shear: creep functions and the parts of the response they multiply.

A traction q displaces the surfaces of both bodies along themselves together by

    u = Σ ∫ J_m(t - t') d(T_m q)(t'),    T_m = direct K + poisson (κ part),

with the contact compliance J of each body, the same as under pressure, and κ = ν/(1 - ν). Where ν
varies in time, with an elastic bulk modulus, the creep function of the second part is that of
ν/(2G), which is Φ - J with Φ of 1/(2G): two terms. Terms whose creep functions are proportional are
one.

Pressure moves the surface along itself, too, by the same creep functions times c J with
c = (direct - poisson)/2: (1 - 2ν)/(2 (1 - ν)) at a constant ν. Of two bodies these parts subtract
(`coupling`), as they move both surfaces towards the load.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from itertools import repeat

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.halfspace.layered_shear import LayeredShear
from viscontact.mechanics.problem.series_body import ANY_TIMES, Span
from viscontact.mechanics.problem.shear_separation import separate_shear
from viscontact.mechanics.problem.surface import (
    as_elastic,
    constant_poisson_ratio,
    on_clock,
    proportion,
    together,
)

#: Weight of the part of the pressure that is rounding [-].
NO_COUPLING = 1e-12


@dataclass(frozen=True, eq=False)
class ShearTerm:
    """A creep function J(t) [1/Pa] times a sum of the parts of the response to shear."""

    compliance: ContactCompliance
    direct: float  # weight of the part of 1/r [-]
    poisson: float  # weight of the part by κ [-]
    coupling: float  # weight of the part of the pressure; < 0 of the indenter [-]
    layers: LayeredShear | None = None  # whose short waves the weights are


@dataclass(frozen=True, eq=False)
class ShearTerms:
    """Terms of the surfaces of both bodies under shear."""

    terms: tuple[ShearTerm, ...]
    splitting_error: float = 0.0  # bound of the relative error of the sum [-]; 0 if exact

    @property
    def layers(self) -> tuple[LayeredShear, ...]:
        """Responses of layers, in the order of their terms."""
        return tuple(term.layers for term in self.terms if term.layers is not None)

    @cached_property
    def weights(self) -> tuple[tuple[float, float, tuple[float, ...]], ...]:
        """Weights of the parts of the response in each term: both of a half-space, and layers."""
        return tuple(
            (
                term.direct,
                term.poisson,
                tuple(float(term.layers is layers) for layers in self.layers),
            )
            for term in self.terms
        )

    @property
    def coupled(self) -> tuple[LayeredShear | None, ...]:
        """Responses by which pressure and tractions are coupled; None for half-spaces."""
        half_spaces = any(term.layers is None for term in self.terms)
        return (None, *self.layers) if half_spaces else self.layers

    def coupled_sums(self, fields: Sequence[Floats]) -> tuple[Floats, ...]:
        """What these responses act on, of the hereditary integrals of all terms."""
        pairs = list(zip(self.terms, fields, strict=True))
        own = tuple(field for term, field in pairs if term.layers is not None)
        others = [term.coupling * field for term, field in pairs if term.layers is None]
        return (np.asarray(sum(others)), *own) if others else own


def shear_terms(
    bodies: Sequence[Material | Layered], clocks: Sequence[Clock], spans: Sequence[Span] = ()
) -> ShearTerms:
    """Terms of the bodies that deform, whose layers are bonded.

    `spans` are those of the reduced times of interest [s], one for each body.
    """
    terms: list[ShearTerm] = []
    error = 0.0
    for body, clock, span, sign in zip(
        bodies, clocks, spans or repeat(ANY_TIMES), (1, -1), strict=False
    ):
        if isinstance(body, Layered):
            of_layers, own = _terms_of_layers(body, clock, span, sign)
            terms, error = [*terms, *of_layers], max(error, own)
            continue
        for term in _terms_of(body, clock, sign):
            terms = _with_term(terms, term)
    return ShearTerms(tuple(terms), error)


def _terms_of_layers(
    body: Layered, clock: Clock, span: Span, sign: int
) -> tuple[list[ShearTerm], float]:
    """Terms of layers, and the error of their sum."""
    stack = as_elastic(body)
    if stack is None:
        found = separate_shear(body, span)
        pairs = zip(found.compliances, found.responses, strict=True)
        return [_term_of(*pair, clock, sign) for pair in pairs], found.error
    compliance = body.layers[0].material.contact_compliance()
    return [_term_of(compliance, LayeredShear((stack,), (1.0,)), clock, sign)], 0.0


def _term_of(
    compliance: ContactCompliance, response: LayeredShear, clock: Clock, sign: int
) -> ShearTerm:
    response = replace(response, side=sign)
    short = response.short_waves
    return ShearTerm(
        on_clock(compliance, clock),
        *(float(short.along), float(short.across - short.along), float(short.coupling)),
        response,
    )


def _terms_of(material: Material, clock: Clock, sign: int) -> list[ShearTerm]:
    """Terms of one body: of the half-space (1) or of the indenter (-1)."""
    compliance = on_clock(material.contact_compliance(), clock)
    nu = constant_poisson_ratio(material)
    if nu is not None:
        kappa = nu / (1 - nu)
        return [ShearTerm(compliance, 1.0, kappa, sign * (1 - kappa) / 2)]
    # Φ is the contact compliance at a Poisson's ratio of 0.
    shear = replace(material, poisson_ratio=0.0, bulk_modulus=None).contact_compliance()
    return [
        ShearTerm(compliance, 1.0, -1.0, sign),
        ShearTerm(on_clock(shear, clock), 0.0, 1.0, -sign / 2),
    ]


def is_uncoupled(bodies: Sequence[Material | Layered]) -> bool:
    """True if pressure does not move the surfaces against each other along themselves."""
    # (1 - 2ν) J/(2 (1 - ν)) of one body less that of the other, if it deforms.
    if len(bodies) == 2 and bodies[0] == bodies[1]:
        return True
    if any(isinstance(body, Layered) for body in bodies):  # coupled at any Poisson's ratio
        return False
    found = shear_terms(bodies, [TIME] * 2)
    return all(abs(term.coupling) < NO_COUPLING for term in found.terms)


def _with_term(terms: list[ShearTerm], new: ShearTerm) -> list[ShearTerm]:
    """Terms with another one, added to one with a proportional creep function."""
    for index, known in enumerate(terms):
        if known.layers is not None:
            continue
        factor = proportion(new.compliance, known.compliance)
        if factor is not None:
            shares = 1 / (1 + factor), factor / (1 + factor)
            joined = ShearTerm(
                together([known.compliance, new.compliance]),
                shares[0] * known.direct + shares[1] * new.direct,
                shares[0] * known.poisson + shares[1] * new.poisson,
                shares[0] * known.coupling + shares[1] * new.coupling,
            )
            return [*terms[:index], joined, *terms[index + 1 :]]
    return [*terms, new]
