"""Frequency response of a stack of elastic layers on a rigid base or on a half-space.

In plane strain the amplitudes y = (μ q U, μ q W, T, S) of the displacements along x and z and of
the tractions σ_xz and σ_zz of a wave of wave number q satisfy y' = A y over ζ = q z, with z into
the body and a = ν/(1 - ν), b = (1 - 2ν)/(2 - 2ν), c = 2/(1 - ν):

    U' = W + T,   W' = b S - a U,   T' = c U + a S,   S' = -T   (displacements times μ q).

The eigenvalues of A are ±1, both double: (A² - 1)² = 0. With N = A² - 1 the matrix exponential is

    exp(A ζ) = cosh ζ + A sinh ζ + (ζ/2) sinh ζ N + (ζ cosh ζ - sinh ζ)/2 A N.

The layers are taken from the base up. What the parts below a level allow there is a plane of
vectors y; the exponential carries it through the next layer. Divided by e^ζ nothing overflows, and
beyond ζ = 20 a layer is a half-space to rounding.

References
----------
W. T. Thomson, J. Appl. Phys. 21 (1950) 89: transfer of waves through layers; T. Nogi, T. Kato,
J. Tribol. 119 (1997) 493: the closed form of one layer.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.surface_response import SurfaceResponse

#: Wave number times thickness beyond which a layer is a half-space to rounding.
DEEP = 20.0

#: Below this, ζ cosh ζ - sinh ζ is summed as a series.
SHALLOW = 0.5


@dataclass(frozen=True)
class ElasticLayer:
    """Elastic layer of a stack."""

    thickness: float  # [m]
    shear_modulus: float  # in any unit, the same for all layers and the base
    poisson_ratio: float  # [-]
    bonded: bool = True  # to what is beneath; without friction otherwise


@dataclass(frozen=True)
class ElasticBase:
    """Elastic half-space under a stack."""

    shear_modulus: float
    poisson_ratio: float


@dataclass(frozen=True)
class ElasticStack(SurfaceResponse):
    """Response of elastic layers, from the surface down, on a half-space or on a rigid base (None).

    Relative to a half-space of the uppermost layer's material, so that L = 1 for short waves.
    """

    layers: tuple[ElasticLayer, ...]
    base: ElasticBase | None

    short_waves = 1.0

    @cached_property
    def length(self) -> float:
        """Thickness of the thinnest layer [m]."""
        return min(layer.thickness for layer in self.layers)

    @cached_property
    def long_waves(self) -> float:
        """Ratio of the base's compliance, as a half-space, to that of the top; 0 if it is rigid."""
        if self.base is None:
            return 0.0
        top = self.layers[0]
        own = (1 - self.base.poisson_ratio) / self.base.shear_modulus
        return own * top.shear_modulus / (1 - top.poisson_ratio)

    @cached_property
    def mean_displacement(self) -> float:
        """Displacement under a uniform pressure of 1 Pa per unit compliance of the top [m]."""
        if self.base is not None:
            return math.inf
        # Uniaxial compression: not even a layer that slides can spread between equal neighbours.
        own = ((each.thickness / each.shear_modulus, each.poisson_ratio) for each in self.layers)
        top = self.layers[0]
        compressed = sum(part * _softness(ratio) for part, ratio in own)
        return 2 * top.shear_modulus / (1 - top.poisson_ratio) * compressed

    def ratio(self, wave_number: Numbers) -> Numbers:
        """L at wave numbers [1/m]."""
        # Of the planes' vectors, the one without shear: S = -p, and p displaces by (1 - ν)/(μ q) L.
        vectors = self.surface_waves(wave_number)
        return np.asarray(-normal_compliance(vectors) / (1 - self.layers[0].poisson_ratio))

    def surface_waves(self, wave_number: Numbers) -> Numbers:
        """Two vectors y at the surface at wave numbers [1/m], shape (..., 4, 2)."""
        q = np.asarray(wave_number)
        waves = _Waves.beneath(self.base, q.shape)
        for layer in reversed(self.layers):
            waves = waves.above(layer, q)
        return waves.vectors


def _softness(poisson_ratio: float) -> float:
    """Shear modulus over the modulus of uniaxial compression, (1 - 2ν)/(2 - 2ν)."""
    return (1 - 2 * poisson_ratio) / (2 - 2 * poisson_ratio)


def wave_matrix(poisson_ratio: float) -> Numbers:
    """Matrix A of the waves in a material."""
    a, b = poisson_ratio / (1 - poisson_ratio), _softness(poisson_ratio)
    c = 2 / (1 - poisson_ratio)
    rows = [[0.0, 1.0, 1.0, 0.0], [-a, 0.0, 0.0, b], [c, 0.0, 0.0, a], [0.0, 0.0, -1.0, 0.0]]
    return np.array(rows)


@dataclass(frozen=True, eq=False)
class _Waves:
    """Two waves below a level: μ q times displacements, and tractions, `vectors` (..., 4, 2)."""

    vectors: Numbers
    shear_modulus: float

    @classmethod
    def beneath(cls, base: ElasticBase | None, shape: tuple[int, ...]) -> _Waves:
        """Waves at the surface of the base: decaying ones, or tractions only."""
        if base is not None:
            vectors = decaying(base.poisson_ratio)
            return cls(np.broadcast_to(vectors, (*shape, 4, 2)), base.shear_modulus)
        vectors = np.zeros((*shape, 4, 2))
        vectors[..., 2, 0] = vectors[..., 3, 1] = 1.0
        return cls(vectors, 1.0)

    def above(self, layer: ElasticLayer, q: Numbers) -> _Waves:
        """Waves at the upper side of a layer."""
        softer = np.array([1.0, 1.0, 0.0, 0.0]) * (layer.shear_modulus / self.shear_modulus - 1)
        vectors = self.vectors * (1 + softer)[:, None]
        if not layer.bonded:
            vectors = sliding(normal_compliance(vectors))
        depth = q * layer.thickness
        deep = depth.real > DEEP
        moved = transfer(np.where(deep, DEEP, depth), layer.poisson_ratio) @ vectors
        moved[deep] = decaying(layer.poisson_ratio)
        # The second vector comes from the tractions: keep both of order one.
        moved /= np.abs(moved).max(axis=-2, keepdims=True)
        return _Waves(moved, layer.shear_modulus)


def decaying(poisson_ratio: float) -> Numbers:
    """Two waves that decay with depth: those of e^-ζ, the columns of (A - 1)²."""
    grown = wave_matrix(poisson_ratio) - np.eye(4)
    return np.asarray((grown @ grown)[:, 2:])


def normal_compliance(vectors: Numbers) -> Numbers:
    """Normal displacement per normal traction without shear traction, of a plane of vectors."""
    (w1, w2), (t1, t2), (s1, s2) = (
        (vectors[..., row, 0], vectors[..., row, 1]) for row in (1, 2, 3)
    )
    return np.asarray((w1 * t2 - w2 * t1) / (s1 * t2 - s2 * t1))


def sliding(compliance: Numbers) -> Numbers:
    """Waves above an interface without friction: it slides, and yields to normal traction."""
    vectors = np.zeros((*compliance.shape, 4, 2), compliance.dtype)
    vectors[..., 0, 0] = vectors[..., 3, 1] = 1.0
    vectors[..., 1, 1] = compliance
    return vectors


def transfer(depth: Numbers, poisson_ratio: float) -> Numbers:
    """The matrix exp(-A ζ) e^-ζ that carries a wave up through a layer of ζ = q h; (..., 4, 4)."""
    a = wave_matrix(poisson_ratio)
    n = a @ a - np.eye(4)
    grown, decayed = 0.5, np.exp(-2 * depth) / 2  # of e^ζ/2 and e^-ζ/2, times e^-ζ
    cosh, sinh = grown + decayed, -np.expm1(-2 * depth) / 2
    series = np.exp(-depth) * _odd_difference(np.where(np.abs(depth) < SHALLOW, depth, 0.0))
    odd = np.where(np.abs(depth) < SHALLOW, series, depth * cosh - sinh)
    factors = (cosh, -sinh, depth * sinh / 2, -odd / 2)
    matrices = (np.eye(4), a, n, a @ n)
    return np.asarray(sum(f[..., None, None] * m for f, m in zip(factors, matrices, strict=True)))


def _odd_difference(depth: Numbers) -> Numbers:
    """Series of ζ cosh ζ - sinh ζ = Σ 2k ζ^(2k+1)/(2k+1)!, which cancels for small ζ."""
    total, term = np.zeros_like(depth), depth
    for k in range(1, 9):
        term = term * depth**2 / (2 * k * (2 * k + 1))
        total = total + 2 * k * term
    return total
