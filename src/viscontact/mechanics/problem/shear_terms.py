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
from dataclasses import dataclass, replace

from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.surface import (
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


def shear_terms(
    bodies: Sequence[Material | Layered], clocks: Sequence[Clock]
) -> tuple[ShearTerm, ...]:
    """Terms of the bodies that deform; ValueError for layers."""
    terms: list[ShearTerm] = []
    for body, clock, sign in zip(bodies, clocks, (1, -1), strict=False):
        for term in _terms_of(_half_space(body), clock, sign):
            terms = _with_term(terms, term)
    return tuple(terms)


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
    materials = [_half_space(body) for body in bodies]
    if len(materials) == 2 and materials[0] == materials[1]:
        return True
    return all(abs(term.coupling) < NO_COUPLING for term in shear_terms(bodies, [TIME] * 2))


def _half_space(body: Material | Layered) -> Material:
    if isinstance(body, Layered):
        raise ValueError("friction: bodies of layers are not supported under friction")
    return body


def _with_term(terms: list[ShearTerm], new: ShearTerm) -> list[ShearTerm]:
    """Terms with another one, added to one with a proportional creep function."""
    for index, known in enumerate(terms):
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
