"""Displacement of the surface of layers on a rigid base that end at plane faces free of stress.

Wave by wave along y, as between the free faces of a half-space (`strip`): the load and its images
about the faces x = ±W leave no shear on them, but the normal stress T p, which is that of endless
layers, wave by wave along x. What frees the faces displaces the surface of the section by (Betti's
reciprocity)

    G = T' F T,

where F is the compliance of the faces, of a section that is free at the top and bonded to the rigid
base at the bottom. Only F is approximate: it is found by finite elements of the second order on a
mesh that is graded towards the edge. Their matrices are sums of Kronecker products of those along x
and along z. The field is U cos ky, V sin ky, W cos ky along x, y, z.

Waves shorter than the uppermost layer feel the end of a half-space of its material (`free_end`).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np
import scipy
from numpy.polynomial.legendre import leggauss

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.log_chebyshev import LogChebyshev
from viscontact.mechanics.halfspace.log_panels import LogPanels
from viscontact.mechanics.halfspace.stack_waves import stack_waves
from viscontact.mechanics.halfspace.strip import surface_panels

#: Largest wave number times the uppermost thickness that feels the layer, number of wave numbers at
#: which G is found, Chebyshev's in ln(k h + SHIFT).
SHORTEST, WAVES, SHIFT = 16.0, 22, 0.25
SERIES = LogChebyshev(SHIFT, SHORTEST + SHIFT, WAVES)

#: Elements at the edge, growth from one to the next, and largest ones, in uppermost thicknesses: of
#: the part of the section near the end, and beyond.
FIRST, GROWTH, LARGEST, NEAR = 0.02, 1.5, 0.25, 3.0

#: Wave number times depth from which on a wave is nothing, and wave number times thickness from
#: which on it is that of a half-space.
DECAYED, SHORT = 30.0, 30.0

#: Gauss nodes in an element of the face.
GAUSS = 4

#: Wave number that stands for 0, in uppermost thicknesses.
LONGEST = 1e-5


@dataclass(frozen=True, eq=False)
class LayerTable:
    """G over Chebyshev's places of wave numbers and the nodes of panels of (W - |x|)/W."""

    panels: LogPanels
    coefficients: Floats  # Chebyshev's of G, shape (waves, nodes, nodes)
    thickness: float  # of the uppermost layer over W
    error: float  # last coefficients, over the largest G [-]

    @property
    def highest_wave(self) -> float:
        """Largest k W of the table."""
        return SHORTEST / self.thickness

    def weights(self, waves: Floats) -> Floats:
        """Weights of coefficients, then of no limit, in G at w = k W; (waves, coefficients)."""
        powers = SERIES.powers(waves * self.thickness + SHIFT)
        return np.column_stack([powers, np.zeros(len(waves))])

    @property
    def entries(self) -> Floats:
        """Coefficients, and the limit of long waves, which a rigid base does not have."""
        return np.concatenate([self.coefficients, np.zeros((1, *self.coefficients.shape[1:]))])


@lru_cache(maxsize=16)
def layer_table(stack: ElasticStack, half_length: float, *, odd: bool) -> LayerTable:
    """What two free faces add under loads that are even or odd about the middle of layers."""
    top = stack.layers[0]
    added = _adder(stack, half_length, odd=odd)
    found = np.array([added(wave / top.thickness) for wave in SERIES.waves - SHIFT])
    coefficients = SERIES.coefficients(found)
    tail = np.abs(coefficients[-2:]).sum(axis=0).max()
    error = float(tail / np.abs(found).max())
    return LayerTable(surface_panels(), coefficients, top.thickness / half_length, error)


def added_at(stack: ElasticStack, half_length: float, wave: float, *, odd: bool) -> Floats:
    """G at a wave number [1/m], between the nodes of the surface."""
    return _adder(stack, half_length, odd=odd)(wave)


def _adder(stack: ElasticStack, half_length: float, *, odd: bool) -> Callable[[float], Floats]:
    """Return the function of the wave number that G is."""
    top = stack.layers[0]
    section = Section.of(stack, half_length, odd=odd)
    stresses = _FaceStress.of(stack, half_length, section.depths, odd=odd)

    def added(wave: float) -> Floats:
        forces = section.forces @ stresses.at(wave)
        own = forces.T @ section.compliance(wave) @ forces
        return np.asarray(2 * top.shear_modulus / (1 - top.poisson_ratio) * own)

    return added


@dataclass(frozen=True, eq=False)
class _FaceStress:
    """Normal stress of endless layers on a face under lines at the nodes of the surface, T."""

    stack: ElasticStack
    depths: Floats  # [m]
    across: Floats  # wave numbers κ [1/m], ascending
    cosines: Floats  # cos κx times the weight of the wave, shape (waves, nodes) [1/m]

    @classmethod
    def of(
        cls, stack: ElasticStack, half_length: float, depths: Floats, *, odd: bool
    ) -> _FaceStress:
        count = int(DECAYED / float(depths.min()) * half_length / np.pi) + 2
        turns = np.pi * (np.arange(count, dtype=np.float64) + (0.5 if odd else 0.0))
        weights = np.full(count, 2 / half_length)
        if not odd:
            weights[0] /= 2
            turns[0] = LONGEST * half_length / stack.layers[0].thickness
        cosines = weights[:, None] * np.cos(np.multiply.outer(turns, surface_panels().places))
        return cls(stack, depths, turns / half_length, cosines)

    def at(self, wave: float) -> Floats:
        """Stress at the depths, compression positive, shape (depths, nodes) [1/m]."""
        square = self.across**2 + wave**2
        rate, part = np.sqrt(square), self.across**2 / square
        ratio, thickness = self.stack.layers[0].poisson_ratio, self.stack.layers[0].thickness
        long = int(np.searchsorted(rate, SHORT / thickness))
        waves = stack_waves(self.stack, rate[:long])
        found = np.empty((len(self.depths), self.cosines.shape[1]))
        for index, depth in enumerate(self.depths.tolist()):
            last = max(int(np.searchsorted(rate, DECAYED / depth)), 1)
            q, along = rate[:last], part[:last]
            own = np.exp(-q * depth) * (along * (1 - q * depth) + 2 * ratio * (1 - along))
            if depth > thickness:
                own[:] = 0.0
            stress = waves.stresses(depth)
            layered = -np.real(
                (stress.along * part[:long] + stress.across * (1 - part[:long])) * stress.decay
            )
            kept = min(long, last)
            own[:kept] = layered[:kept]
            found[index] = own @ self.cosines[:last]
        return found


@dataclass(frozen=True, eq=False)
class Section:
    """Section of layers between a free face and the middle, on a rigid base."""

    depths: Floats  # of the Gauss nodes of the face [m]
    forces: Floats  # ∫ f dz of each node of the face, shape (nodes, depths) [m]
    #: Matrices along x and z, whose Kronecker products make the stiffness; `weighted` those along z
    #: by μ and by λ.
    along: tuple[Floats, Floats, Floats]
    weighted: tuple[tuple[Floats, Floats, Floats], ...]
    free: Integers  # degrees of freedom of U, V, W that are not fixed
    face: Integers  # those of U on the face among them

    @classmethod
    def of(cls, stack: ElasticStack, half_length: float, *, odd: bool) -> Section:
        """Mesh of a section, graded towards both edges of the face."""
        h = stack.layers[0].thickness
        x = _graded(half_length, h)
        z, moduli = [0.0], []
        for layer in stack.layers:
            # Stress grows towards the edges of the face and of each interface.
            upper = _graded(layer.thickness / 2, layer.thickness)
            inner = np.concatenate([upper, layer.thickness - upper[-2::-1]])
            z += (z[-1] + inner[1:]).tolist()
            lame = 2 * layer.shear_modulus * layer.poisson_ratio / (1 - 2 * layer.poisson_ratio)
            moduli += [(layer.shear_modulus, lame)] * (len(inner) - 1)
        depth = np.array(z)
        shear, lame = np.array(moduli).T
        nx, nz = 2 * len(x) - 1, 2 * len(depth) - 1
        fixed = np.zeros((3, nx, nz), bool)
        fixed[:, :, -1] = True  # the base, as z counts from the surface
        fixed[(1, 2) if odd else (0,), -1] = True
        free = np.flatnonzero(~fixed.ravel())
        on_face = np.zeros((3, nx, nz), bool)
        on_face[0, 0, :-1] = True
        face = np.searchsorted(free, np.flatnonzero(on_face.ravel()))
        depths, forces = _face_rule(depth)
        one = np.ones(len(x) - 1)
        weighted = (_matrices(depth, shear), _matrices(depth, lame))
        return cls(depths, forces[:-1], _matrices(x, one), weighted, free, face)

    def compliance(self, wave: float) -> Floats:
        """F: displacement of the nodes of the face along x under forces on them, at one wave."""
        kron, k = scipy.sparse.kron, wave
        (mass, stiff, slope), ((m, s, d), (ml, sl, dl)) = self.along, self.weighted
        m2, s2 = ml + 2 * m, sl + 2 * s
        shear = kron(stiff, m) + kron(mass, s)
        uu = kron(stiff, m2) + kron(mass, s) + k**2 * kron(mass, m)
        ww = kron(mass, s2) + kron(stiff, m) + k**2 * kron(mass, m)
        vv = k**2 * kron(mass, m2) + shear
        uv = k * (kron(slope, ml) - kron(slope.T, m))
        uw = kron(slope, dl.T) + kron(slope.T, d)
        vw = k * (kron(mass, dl.T) - kron(mass, d))
        whole = scipy.sparse.block_array([[uu, uv, uw], [uv.T, vv, vw], [uw.T, vw.T, ww]])
        solver = scipy.sparse.linalg.splu(whole.tocsr()[self.free][:, self.free].tocsc())
        loads = np.zeros((len(self.free), len(self.face)))
        loads[self.face, np.arange(len(self.face))] = 1.0
        return np.asarray(solver.solve(loads)[self.face])


def _graded(length: float, thickness: float) -> Floats:
    """Borders of elements from an edge on, that grow from it; beyond some thicknesses further."""
    borders, size = [0.0], FIRST * thickness
    while borders[-1] < length:
        borders.append(borders[-1] + size)
        near = borders[-1] < NEAR * thickness
        size = min(size * GROWTH, LARGEST * thickness) if near else size * GROWTH
    found = np.array(borders)
    return np.asarray(found * (length / found[-1]))


_T, _W = leggauss(4)
_SHAPES = np.stack([_T * (_T - 1) / 2, 1 - _T**2, _T * (_T + 1) / 2])
_SLOPES = np.stack([_T - 0.5, -2 * _T, _T + 0.5])


def _matrices(borders: Floats, factors: Floats) -> tuple[Floats, Floats, Floats]:
    """∫ f φi φj, ∫ f φi' φj' and ∫ f φi' φj over elements of the second order, sparse."""
    half = np.diff(borders) / 2
    products = (
        np.einsum("iq,jq,q->ij", _SHAPES, _SHAPES, _W),
        np.einsum("iq,jq,q->ij", _SLOPES, _SLOPES, _W),
        np.einsum("iq,jq,q->ij", _SLOPES, _SHAPES, _W),
    )
    scales = factors * half, factors / half, factors
    nodes = 2 * np.arange(len(half))[:, None] + np.arange(3)
    rows, columns = np.repeat(nodes, 3, axis=1).ravel(), np.tile(nodes, 3).ravel()
    size = (2 * len(half) + 1,) * 2
    mass, stiffness, slope = (
        scipy.sparse.coo_array(
            (np.multiply.outer(scale, own).ravel(), (rows, columns)), shape=size
        ).tocsr()
        for scale, own in zip(scales, products, strict=True)
    )
    return mass, stiffness, slope


def _face_rule(borders: Floats) -> tuple[Floats, Floats]:
    """Gauss nodes on the elements of a face [m], and weights of ∫ f φi dz; (nodes, depths)."""
    places, weights = leggauss(GAUSS)
    half, middle = np.diff(borders)[:, None] / 2, (borders[1:] + borders[:-1])[:, None] / 2
    shapes = np.stack([places * (places - 1) / 2, 1 - places**2, places * (places + 1) / 2])
    forces = np.zeros((2 * len(half) + 1, len(half) * GAUSS))
    for element, own in enumerate(half.ravel().tolist()):
        columns = slice(element * GAUSS, (element + 1) * GAUSS)
        forces[2 * element : 2 * element + 3, columns] += own * weights * shapes
    return (middle + half * places).ravel(), forces
