"""Stresses inside a stack of elastic layers under a wave of pressure or traction on its surface.

Under the pressure cos(q x) on a surface without shear traction the stresses at a depth are

    σ_xx = X cos(q x),  σ_yy = Y cos(q x),  σ_zz = S cos(q x),  σ_xz = T sin(q x),

with S = -1 and T = 0 at the surface. In the notation of `elastic_stack`, X = c U + a S and, in
plane strain, Y = ν (X + S). From the base up, what the parts below a level allow there is a plane
of vectors y; at the surface the vector of the given tractions follows. From there down, each layer
multiplies the weights of its two vectors by e^(-q h) and by the inverse of the triangular matrix by
which they were made orthonormal on the way up: nothing grows with depth, and nothing cancels.

Under a traction along the wave vector, S = 0 and T = -1 at the surface, the stresses have the same
form a quarter of a wave ahead. A traction across it causes antiplane strain (`AntiplaneWaves`).
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.elastic_stack import (
    ElasticStack,
    decaying,
    normal_compliance,
    sliding,
    transfer,
    wave_matrix,
)
from viscontact.units.formatting import format_quantity

#: Wave number times thickness beyond which a wave does not reach the lower side, to rounding.
VANISHED = 45.0

#: Relative distance to an interface within which a depth belongs to the layer above.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class WaveStresses:
    """Stresses per unit pressure at one depth, over q, before `decay`; tension positive [-]."""

    along: Numbers  # X, normal stress along the wave
    across: Numbers | float  # Y, normal stress parallel to its crests
    normal: Numbers  # S, normal stress on planes parallel to the surface
    shear: Numbers  # T, shear stress on these, a quarter of a wave ahead
    decay: Numbers | float = 1.0


@dataclass(frozen=True, eq=False)
class _LayerWaves:
    """Waves within a layer, or within the base, whose thickness is infinite."""

    lower: Numbers  # at a layer's lower side times e^(q h), at the base's surface; shape (n, 4)
    top: float  # depth of its upper side [m]
    thickness: float  # [m]
    poisson_ratio: float

    def amplitudes(self, q: Numbers, depth: float) -> tuple[Numbers, ...]:
        """U, W (times μ q), T and S at a depth [m]."""
        below = q * (depth - self.top)
        if np.isinf(self.thickness):  # decaying waves: (A + 1)² = 0
            grown = wave_matrix(self.poisson_ratio) + np.eye(4)
            found = self.lower + below[:, None] * (self.lower @ grown.T)
        else:
            height = _limited_depth(q * self.thickness) - below
            height = np.where(height.real > 0, height, 0.0)
            found = (transfer(height, self.poisson_ratio) @ self.lower[:, :, None])[:, :, 0]
        return tuple((np.exp(-below)[:, None] * found).T)


@dataclass(frozen=True, eq=False)
class StackWaves:
    """Waves in all parts of a stack under pressure waves of unit amplitude."""

    q: Numbers  # wave numbers [1/m], shape (n,)
    parts: tuple[_LayerWaves, ...]

    def stresses(self, depth: float) -> WaveStresses:
        """Stresses at a depth [m]; at an interface those of the layer above."""
        part = self.parts[_layer_index([each.top for each in self.parts], depth)]
        along, _, shear, normal = part.amplitudes(self.q, depth)
        nu = part.poisson_ratio
        stretch = (2 * along + nu * normal) / (1 - nu)
        return WaveStresses(stretch, nu * (stretch + normal), normal, shear)


@dataclass(frozen=True, eq=False)
class AntiplaneWaves:
    """Waves of antiplane strain in all parts of a stack under a traction across the wave vector.

    With the traction -1 at the surface, Z is the shear modulus times q times the displacement, the
    shear stress along the wave, and V that on planes parallel to the surface:

        dZ/dz = q V,   dV/dz = q Z

    within a part. -Z/V at the upper side of each is that of `antiplane_compliance`.
    """

    q: Numbers  # wave numbers [1/m], shape (n,)
    tops: tuple[float, ...]  # depths of the upper sides of the parts [m]
    thicknesses: tuple[float, ...]  # inf of the base [m]
    lower: tuple[Numbers, ...]  # -Z/V at the lower side of each part [-]
    upper: tuple[Numbers, ...]  # V at the upper side of each part [-]

    def stresses(self, depth: float) -> tuple[Numbers, Numbers]:
        """Z and V at a depth [m]; at an interface those of the part above."""
        place = _layer_index(list(self.tops), depth)
        below = self.q * (depth - self.tops[place])
        if np.isinf(self.thicknesses[place]):
            faded = np.exp(-below) * self.upper[place]
            return -faded, faded
        height = self.q * self.thicknesses[place] - below
        ratio, whole = self.lower[place], np.exp(-2 * self.q * self.thicknesses[place])
        part = np.exp(-2 * height)
        level = self.upper[place] * np.exp(-below) / (1 + whole + ratio * (1 - whole))
        return -level * (ratio * (1 + part) + 1 - part), level * (1 + part + ratio * (1 - part))


def antiplane_waves(stack: ElasticStack, q: Numbers) -> AntiplaneWaves:
    """Waves of wave numbers q [1/m], shape (n,), not zero, real or complex; of bonded layers."""
    lower: list[Numbers] = []
    found, modulus = np.zeros_like(q), 1.0
    if stack.base is not None:
        found, modulus = np.ones_like(q), stack.base.shear_modulus
    for layer in reversed(stack.layers):
        # Displacement and traction are those of the part beneath.
        found = found * (layer.shear_modulus / modulus)
        lower.insert(0, found)
        whole = np.exp(-2 * q * layer.thickness)
        found = (found * (1 + whole) + 1 - whole) / (1 + whole + found * (1 - whole))
        modulus = layer.shear_modulus
    thicknesses = [layer.thickness for layer in stack.layers]
    upper = [-np.ones_like(q)]
    for thickness, ratio in zip(thicknesses, lower, strict=True):
        whole = np.exp(-2 * q * thickness)
        passed = 2 * np.exp(-q * thickness) / (1 + whole + ratio * (1 - whole))
        upper.append(upper[-1] * passed)
    if stack.base is not None:
        thicknesses, lower = [*thicknesses, np.inf], [*lower, np.ones_like(q)]
    else:
        upper.pop()
    tops = (0.0, *interface_depths(stack))[: len(thicknesses)]
    return AntiplaneWaves(q, tops, tuple(thicknesses), tuple(lower), tuple(upper))


def layer_at(stack: ElasticStack, depth: float) -> int:
    """Index of the layer at or above a depth [m]; the base is the last, if it is not rigid."""
    tops = interface_depths(stack)
    if stack.base is None and depth > tops[-1] * (1 + ROUNDING):
        end, given = format_quantity(tops[-1], "m"), format_quantity(depth, "m")
        raise ValueError(
            f"depths must lie within the layers, which end at {end} on a rigid base; got {given}"
        )
    return _layer_index([0.0, *tops], depth)


def poisson_ratio_at(stack: ElasticStack, depth: float) -> float:
    """Poisson's ratio of the layer at a depth [m], or of the base; ValueError in a rigid one."""
    place = layer_at(stack, depth)
    if place < len(stack.layers):
        return stack.layers[place].poisson_ratio
    assert stack.base is not None  # depths in a rigid one are refused
    return stack.base.poisson_ratio


def interface_depths(stack: ElasticStack) -> list[float]:
    """Depths of the lower sides of all layers [m]."""
    return [float(each) for each in np.cumsum([layer.thickness for layer in stack.layers])]


def stack_waves(stack: ElasticStack, q: Numbers, *, sheared: bool = False) -> StackWaves:
    """Waves of wave numbers q [1/m], shape (n,), not zero, real or complex.

    Under a pressure, or under a traction along the wave vector if `sheared`.
    """
    planes = _planes(stack, q)
    # Down, from the vector of the surface whose tractions are given.
    tops, found = [0.0, *interface_depths(stack)], []
    load: Numbers = -np.ones_like(q)
    given = (load, 0 * load) if sheared else (0 * load, load)
    weights = _with_tractions(planes[0].upper, *given)
    for index, (layer, plane) in enumerate(zip(stack.layers, planes, strict=False)):
        own = _solve(plane.triangle, weights)
        lower = (plane.lower @ own)[:, :, 0]
        found.append(_LayerWaves(lower, tops[index], layer.thickness, layer.poisson_ratio))
        own = own * np.exp(-q * layer.thickness)[:, None, None]
        if layer.bonded:
            weights = own
        elif index + 1 < len(planes):
            normal = own[:, 1, 0]
            weights = _with_tractions(planes[index + 1].upper, 0 * normal, normal)
    if stack.base is not None:
        lower = (planes[-1].upper @ weights)[:, :, 0]
        found.append(_LayerWaves(lower, tops[-1], np.inf, stack.base.poisson_ratio))
    return StackWaves(q, tuple(found))


@dataclass(frozen=True, eq=False)
class _Plane:
    """Vectors that are allowed at the sides of a layer: e^(-A ζ - ζ) lower = upper triangle."""

    lower: Numbers  # (n, 4, 2)
    upper: Numbers
    triangle: Numbers  # (n, 2, 2)


def _planes(stack: ElasticStack, q: Numbers) -> list[_Plane]:
    """Planes of the layers, from the surface down, and of the surface of an elastic base."""
    found: list[_Plane] = []
    if stack.base is None:
        modulus, vectors = 1.0, np.zeros((*q.shape, 4, 2), q.dtype)
        vectors[:, 2, 0] = vectors[:, 3, 1] = 1.0
    else:
        modulus = stack.base.shear_modulus
        vectors = np.broadcast_to(decaying(stack.base.poisson_ratio), (*q.shape, 4, 2))
        found.append(_Plane(vectors, vectors, np.broadcast_to(np.eye(2), (*q.shape, 2, 2))))
    for layer in reversed(stack.layers):
        ratio = layer.shear_modulus / modulus
        lower = vectors * np.array([ratio, ratio, 1.0, 1.0])[:, None]
        if not layer.bonded:
            lower = sliding(normal_compliance(lower))
        depth = _limited_depth(q * layer.thickness)
        vectors, triangle = np.linalg.qr(transfer(depth, layer.poisson_ratio) @ lower)
        found.append(_Plane(lower, vectors, triangle))
        modulus = layer.shear_modulus
    return found[::-1]


def _with_tractions(vectors: Numbers, shear: Numbers, normal: Numbers) -> Numbers:
    """Weights of vectors, (n, 2, 1), for a shear and a normal traction."""
    return _solve(vectors[:, 2:], np.stack([shear, normal], axis=-1)[..., None])


def _solve(matrices: Numbers, right: Numbers) -> Numbers:
    return np.asarray(np.linalg.solve(matrices, right))


def _limited_depth(depth: Numbers) -> Numbers:
    """Wave number times thickness, no larger than where waves have vanished."""
    return depth * np.minimum(1.0, VANISHED / depth.real)


def _layer_index(tops: list[float], depth: float) -> int:
    """Index of the last upper side above a depth, beyond rounding."""
    return max(int(np.searchsorted(np.array(tops) * (1 + ROUNDING), depth)) - 1, 0)
