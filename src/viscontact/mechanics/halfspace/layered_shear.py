"""Frequency response of layers to waves of traction along their surface.

Per contact compliance J of the uppermost layer's half-space, a traction of wave number q along its
wave vector displaces the surface along itself by (2/q) A(q), one across it by (2/q) B(q), and the
first displaces it into the body by (2/q) D(q), a quarter of a wave ahead. A half-space has A = 1,
B = 1/(1 - ν) and D = (1 - 2ν)/(2 (1 - ν)). In the notation of `elastic_stack`, A and D follow from
the vector of no normal traction. Waves across their wave vector are those of antiplane strain:
displacement times μ q over traction is

    c = (c_below + tanh ζ)/(1 + c_below tanh ζ),   ζ = q h,

at the upper side of a layer, 1 on a half-space, 0 on a rigid base, and without limit on an
interface that slides; B = c/(1 - ν).

References
----------
K. L. Johnson, Contact Mechanics, Cambridge (1985), section 3.6: the half-space; W. T. Thomson,
J. Appl. Phys. 21 (1950) 89: transfer of waves through layers.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from viscontact.backend.arrays import Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.surface_response import SurfaceResponse


class ShearRatios(NamedTuple):
    """Displacements over that of a half-space under pressure [-]."""

    along: Any  # A, a number or an array
    across: Any  # B
    coupling: Any  # D


def stack_ratios(stack: ElasticStack, wave_number: Numbers) -> ShearRatios:
    """A, B and D of a stack at wave numbers [1/m], not zero, real or complex.

    >>> from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer
    >>> body = ElasticStack((ElasticLayer(1.0, 1.0, 0.25),), ElasticBase(1.0, 0.25))
    >>> [round(float(each[0]), 4) for each in stack_ratios(body, np.array([2.0]))]
    [1.0, 1.3333, 0.3333]
    """
    q = np.asarray(wave_number)
    free = 1 - stack.layers[0].poisson_ratio
    vectors = stack.surface_waves(q)
    (u1, u2), (w1, w2), (t1, t2), (s1, s2) = (
        (vectors[..., row, 0], vectors[..., row, 1]) for row in range(4)
    )
    shear = (t1 * s2 - t2 * s1) * free
    along, coupling = -(u1 * s2 - u2 * s1) / shear, (w1 * s2 - w2 * s1) / shear
    return ShearRatios(along, antiplane_compliance(stack, q) / free, coupling)


def antiplane_compliance(stack: ElasticStack, wave_number: Numbers) -> Numbers:
    """Displacement across the wave vector times μ q of the top, over the traction [-]."""
    q = np.asarray(wave_number)
    found, modulus = np.zeros_like(q), 1.0
    if stack.base is not None:
        found, modulus = np.ones_like(q), stack.base.shear_modulus
    for layer in reversed(stack.layers):
        decayed = np.exp(-2 * q * layer.thickness)
        sinh, cosh = -np.expm1(-2 * q * layer.thickness), 1 + decayed
        if layer.bonded:
            found = found * (layer.shear_modulus / modulus)
            found = (found * cosh + sinh) / (cosh + found * sinh)
        else:
            found = cosh / sinh
        modulus = layer.shear_modulus
    return np.asarray(found)


def short_waves_of(poisson_ratio: float) -> ShearRatios:
    """A, B and D of a half-space.

    >>> short_waves_of(0.0)
    ShearRatios(along=1.0, across=1.0, coupling=0.5)
    """
    free = 1 - poisson_ratio
    return ShearRatios(1.0, 1 / free, (1 - 2 * poisson_ratio) / (2 * free))


@dataclass(frozen=True)
class LayeredShear:
    """Weighted sum of the responses of stacks of the same layers, whose constants may differ."""

    stacks: tuple[ElasticStack, ...]
    weights: tuple[float, ...]
    side: int = 1  # -1 for the indenter, whose pressure moves its surface the other way

    @property
    def length(self) -> float:
        """Thickness of the thinnest layer [m]."""
        return self.stacks[0].length

    @cached_property
    def short_waves(self) -> ShearRatios:
        """Limits for short waves [-]."""
        return self._sum([short_waves_of(each.layers[0].poisson_ratio) for each in self.stacks])

    @cached_property
    def long_waves(self) -> ShearRatios:
        """Limits for long waves [-]; 0 on a rigid base, infinite along layers that slide."""
        return self._sum([_long_waves(each) for each in self.stacks])

    @cached_property
    def mean_displacement(self) -> float:
        """Displacement under a uniform traction, per unit of it and of J [m]; inf without limit."""
        means = [_mean_displacement(each) for each in self.stacks]
        if not np.isfinite(means).all():
            return math.inf
        return math.fsum(w * mean for w, mean in zip(self.weights, means, strict=True))

    def ratios(self, wave_number: Numbers) -> ShearRatios:
        """A, B and D at wave numbers [1/m]."""
        return self._sum([stack_ratios(each, wave_number) for each in self.stacks])

    def _sum(self, parts: list[ShearRatios]) -> ShearRatios:
        along, across, coupling = (
            sum(w * each for w, each in zip(self.weights, of_kind, strict=True) if w)
            for of_kind in zip(*parts, strict=True)
        )
        return ShearRatios(along, across, self.side * coupling)


def _long_waves(stack: ElasticStack) -> ShearRatios:
    if not all(layer.bonded for layer in stack.layers):
        return ShearRatios(math.inf, math.inf, math.nan)
    if stack.base is None:
        return ShearRatios(0.0, 0.0, 0.0)
    base = short_waves_of(stack.base.poisson_ratio)
    return ShearRatios(*(stack.long_waves * each for each in base))


def _mean_displacement(stack: ElasticStack) -> float:
    if stack.base is not None or not all(layer.bonded for layer in stack.layers):
        return math.inf
    top = stack.layers[0]
    sheared = sum(layer.thickness / layer.shear_modulus for layer in stack.layers)
    return 2 * top.shear_modulus / (1 - top.poisson_ratio) * sheared


@dataclass(frozen=True)
class ShearComponent(SurfaceResponse):
    """Sum a A + b B of a response, as one of a single wave."""

    source: LayeredShear
    along: float
    across: float

    @property
    def short_waves(self) -> float:
        """Limit for short waves [-]."""
        return float(self._of(self.source.short_waves))

    @property
    def long_waves(self) -> float:
        """Limit for long waves [-]; 0 on a rigid base."""
        return float(self._of(self.source.long_waves))

    @property
    def length(self) -> float:
        """Thickness of the thinnest layer [m]."""
        return self.source.length

    @property
    def mean_displacement(self) -> float:
        """Displacement under a uniform traction [m]; inf without a rigid base."""
        return (self.along + self.across) * self.source.mean_displacement

    def ratio(self, wave_number: Numbers) -> Numbers:
        """The sum at wave numbers [1/m]."""
        return np.asarray(self._of(self.source.ratios(wave_number)))

    def _of(self, ratios: ShearRatios) -> Any:
        return self.along * ratios.along + self.across * ratios.across


@dataclass(frozen=True)
class CouplingSlope(SurfaceResponse):
    """Rest of D beyond short waves, times the wave number and the thinnest layer's thickness."""

    source: LayeredShear

    short_waves = long_waves = mean_displacement = 0.0

    @property
    def length(self) -> float:
        """Thickness of the thinnest layer [m]."""
        return self.source.length

    def ratio(self, wave_number: Numbers) -> Numbers:
        """(D - D(∞)) q h at wave numbers [1/m]."""
        rest = self.source.ratios(wave_number).coupling - self.source.short_waves.coupling
        return np.asarray(rest * wave_number * self.length)
