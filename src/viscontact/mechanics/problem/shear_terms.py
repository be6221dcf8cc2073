"""Surface of the bodies under shear: creep functions and the parts of the response they multiply.

A traction q displaces the surfaces of both bodies along themselves together by

    u = Σ ∫ J_m(t - t') d(T_m q)(t'),    T_m = direct K + poisson (κ part),

with the contact compliance J of each body, the same as under pressure, and κ = ν/(1 - ν). Where ν
varies in time, with an elastic bulk modulus, the creep function of the second part is that of
ν/(2G), which is Φ - J with Φ of 1/(2G): two terms. Terms whose creep functions are proportional are
one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from viscontact.bodies.loads.clock import Clock
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.surface import (
    constant_poisson_ratio,
    on_clock,
    proportion,
    together,
)


@dataclass(frozen=True, eq=False)
class ShearTerm:
    """A creep function J(t) [1/Pa] times a sum of the parts of the response to shear."""

    compliance: ContactCompliance
    direct: float  # weight of the part of 1/r [-]
    poisson: float  # weight of the part by κ [-]


def shear_terms(
    bodies: Sequence[Material | Layered], clocks: Sequence[Clock]
) -> tuple[ShearTerm, ...]:
    """Terms of the bodies that deform; ValueError for layers."""
    terms: list[ShearTerm] = []
    for body, clock in zip(bodies, clocks, strict=True):
        for term in _terms_of(_half_space(body), clock):
            terms = _with_term(terms, term)
    return tuple(terms)


def _terms_of(material: Material, clock: Clock) -> list[ShearTerm]:
    """Terms of one body."""
    compliance = on_clock(material.contact_compliance(), clock)
    nu = constant_poisson_ratio(material)
    if nu is not None:
        return [ShearTerm(compliance, 1.0, nu / (1 - nu))]
    # Φ is the contact compliance at a Poisson's ratio of 0.
    shear = replace(material, poisson_ratio=0.0, bulk_modulus=None).contact_compliance()
    return [ShearTerm(compliance, 1.0, -1.0), ShearTerm(on_clock(shear, clock), 0.0, 1.0)]


def is_uncoupled(bodies: Sequence[Material | Layered]) -> bool:
    """True if pressure does not move the surfaces against each other along themselves."""
    # (1 - 2ν) J/(2 (1 - ν)) of one body less that of the other, if it deforms.
    materials = [_half_space(body) for body in bodies]
    if all(constant_poisson_ratio(material) == 0.5 for material in materials):
        return True
    return len(materials) == 2 and materials[0] == materials[1]


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
            )
            return [*terms[:index], joined, *terms[index + 1 :]]
    return [*terms, new]
