"""Response of creeping layers to waves of pressure, Laplace transformed in time.

By the correspondence principle the surface under a wave of pressure p~(q, s) is displaced by
(2/q) C(q, s) p~, where C is the compliance of the elastic stack of the shear moduli
G~(s) = 1/(2 s L[Phi]) (Lee 1955, Q. Appl. Math. 13, 183). At each wave number C is a creep
compliance of its own: decreasing in real s, with simple negative poles.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from viscontact.backend.arrays import Numbers
from viscontact.bodies.laws import SeriesLaw
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.layered_shear import ShearRatios, stack_ratios


class CreepingStack:
    """Compliance C(q, s) of a body of layers whose laws are Prony series."""

    def __init__(self, body: Layered) -> None:
        self._body = body
        self._creep = [_creep(material) for material in body.materials]

    @property
    def rates(self) -> tuple[float, float]:
        """Bounds of the rates of creep of all wave numbers [1/s]."""
        # Outside the rates of the materials, all moduli G~(s) are positive at negative s, and the
        # elastic stack has no pole. Layers on a fluid sink into it ever more slowly, the longer the
        # wave.
        bounds = [_rates_of(creep) for creep in self._creep if not creep.is_elastic]
        if not bounds:
            return 1.0, 1.0
        return min(slow for slow, _ in bounds), max(fast for _, fast in bounds)

    @property
    def flows(self) -> bool:
        """True if one of the materials is a fluid."""
        return any(creep.fluidity > 0 for creep in self._creep)

    def compliance(self, wave_number: Numbers, s: Numbers) -> Numbers:
        """C at wave numbers [1/m] and Laplace variables [1/s], shape (s, q) [1/Pa]."""
        found = [self.elastic(each) for each in s]
        return np.array([top * stack.ratio(wave_number) for stack, top in found])

    def shear(self, wave_number: Numbers, s: Numbers) -> ShearRatios:
        """Compliances under waves of traction, of shape (s, q) [1/Pa]."""
        found = [self.elastic(each) for each in s]
        ratios = [stack_ratios(stack, wave_number) for stack, _ in found]
        tops = np.array([top for _, top in found])[:, None]
        return ShearRatios(*(tops * np.array(each) for each in zip(*ratios, strict=True)))

    def elastic(self, s: Any) -> tuple[ElasticStack, Any]:
        """Elastic stack at one s, and the contact compliance of its uppermost layer [1/Pa]."""
        shears = [1 / (2 * transformed(creep, np.asarray(s))[()]) for creep in self._creep]
        constants = [
            (shear, _poisson_ratio(material, shear))
            for shear, material in zip(shears, self._body.materials, strict=True)
        ]
        (shear, poisson_ratio), *_ = constants
        return stack_of(self._body, constants), (1 - poisson_ratio) / (2 * shear)


def stack_of(body: Layered, constants: Sequence[tuple[Any, Any]]) -> ElasticStack:
    """Stack of elastic layers: shear modulus [any unit] and Poisson's ratio of each material."""
    assert not isinstance(body.bonded, bool)  # made a tuple
    layers = tuple(
        ElasticLayer(layer.thickness, *each, bonded=bonded)
        for layer, each, bonded in zip(body.layers, constants, body.bonded, strict=False)
    )
    base = None if isinstance(body.base, str) else ElasticBase(*constants[-1])
    return ElasticStack(layers, base)


def transformed(compliance: SeriesCompliance, s: Numbers) -> Numbers:
    """Laplace transform s L[J] of a Prony series, J_0 + Σ J_i/(1 + s τ_i) + φ/s [1/Pa]."""
    delayed = compliance.amplitudes / (1 + np.multiply.outer(s, compliance.times))
    return np.asarray(compliance.instant + delayed.sum(axis=-1) + compliance.fluidity / s)


def _creep(material: Material) -> SeriesCompliance:
    assert isinstance(material.law, SeriesLaw)  # others are refused
    return SeriesCompliance(*material.law.creep_series().terms)


def _rates_of(creep: SeriesCompliance) -> tuple[float, float]:
    """Bounds of the rates of creep and relaxation of one law that creeps [1/s]."""
    rates = (1 / creep.times).tolist()
    slow, fast = min(rates, default=math.inf), max(rates, default=0.0)
    begun = float((creep.amplitudes / creep.times).sum()) + creep.fluidity
    if creep.instant > 0:  # a body relaxes faster than it creeps
        fast += begun / creep.instant
    late = creep.instant + float(creep.amplitudes.sum())
    if creep.fluidity > 0 and late > 0:
        slow = min(slow, creep.fluidity / late)
    return min(slow, fast), fast


def _poisson_ratio(material: Material, shear: Any) -> Any:
    """Poisson's ratio of the elastic body that a material is where its shear modulus is G~ [Pa]."""
    if material.poisson_ratio is not None:
        return material.poisson_ratio
    bulk = material.bulk_modulus
    assert bulk is not None  # exactly one is given
    return (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))
