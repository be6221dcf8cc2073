"""Stress in a body near its free ends beyond that of the mirrored half-space, wave by wave.

A body with free ends is loaded by p~ on its surface, mirrored about the ends, and by a tension f on
its free faces, mirrored about the surface (`free_end`, `strip`): a half-space and a slab overlap.
The mirrored pressure p itself has Love's stresses. What is left, p~ - p and f, is smooth at the
distance at which it acts, so that its waves cos κx cos ky and cos ζz cos ky have amplitudes that
are smooth over the logarithms of κ and ζ, and sums over them are Filon's. With q² = κ² + k² a wave
on the surface puts

    σxx = -[(κ²/q²) (1 - qz) + 2ν k²/q²] exp(-qz),   σzz = -(1 + qz) exp(-qz),
    σyy = -[(k²/q²) (1 - qz) + 2ν κ²/q²] exp(-qz),   σxz, σyz, σxy like sin κx κ/q qz exp(-qz), ...

(Johnson 1985, section 13.2); in those of f, of r² = ζ² + k², the functions of a slab take the
places of (1 + rX) exp(-rX), exp(-rX) and rX exp(-rX) at the distance X from the face: S, H and T of
`strip`, with T = dS/dξ.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace import free_end, strip
from viscontact.mechanics.halfspace.filon import oscillation_weights, panel_nodes
from viscontact.mechanics.halfspace.log_panels import LogPanels, interpolation
from viscontact.mechanics.halfspace.long_strip import long_loads
from viscontact.mechanics.halfspace.strip_slab import SlabFunctions, slab_functions

#: Nodes of panels of waves across, in k; first panel, ratio of the ends of others, and last end.
NODES, FIRST, RATIO, LAST = 10, 0.5, 2.5, 1e9

#: Shortest wave across, of the inverse of a row's length.
SHORTEST = 1e4

#: Places beyond this do not feel a face, in 1/k.
FAR = 28.0

#: Waves of a body between two planes that are summed one by one.
SINGLE = 192


@dataclass(frozen=True, eq=False)
class Places:
    """Places in a body: all pairs of distances from a free face and of depths."""

    distances: Floats  # shape (m,) [m]
    depths: Floats  # shape (n,) [m]

    def within(self, reach: float) -> tuple[Bools, Bools]:
        """True for distances and for depths of less than a reach [m]."""
        return self.distances < reach, self.depths < reach


@dataclass(frozen=True, eq=False)
class RowLoads:
    """Pressures on rows of cells beside a face: amplitudes of a wave along it.

    Columns are amplitudes of cos ky, and then as many of sin ky.
    """

    borders: Floats  # distances of the rows' borders from the face, shape (rows + 1,) [m]
    amplitudes: Floats  # shape (rows, 2 columns) [Pa]
    row: float  # length of a row [m]


def beside_face(ratio: float, wave: float, loads: RowLoads, places: Places) -> Floats:
    """Stresses beyond the mirrored half-space of a body that goes on; (6, columns, m, n) [Pa].

    Components xx, yy, zz, yz, xz, xy, with x from the face into the body: yz and xy are those of
    the amplitudes of sin ky, the others of cos ky. `wave` is k [1/m].
    """
    near, shallow = places.within(FAR / wave)
    found = np.zeros((6, loads.amplitudes.shape[1] // 2, near.size, shallow.size))
    if not (near.any() and shallow.any()):
        return found
    known = free_end.images(ratio)
    # 1. Pressure added on the surface, and tension on the face.
    end = float(np.exp(known.panels.edges[-1])) * (1 - 1e-12)
    until = known.panels.weights_until(np.minimum(wave * loads.borders, end))
    masses = np.diff(until, axis=0).T @ loads.amplitudes
    added = known.density @ masses
    freed = 2 * known.stress.T @ (masses + known.panels.weights[:, None] * added)
    # 2. Their waves, and those at the places.
    count = _panels_to(SHORTEST / (wave * loads.row))
    across, kept = _across(known.panels), slice(0, count * NODES)
    turns = across.waves[kept]
    factor = 2 / np.pi
    distances, depths = wave * places.distances[near], wave * places.depths[shallow]
    top = _under_waves(ratio, turns, depths)
    top_weights = factor * _weights(count, distances)
    side = slab_functions(np.hypot(1.0, turns), distances, None, 1.0)
    face = _from_face(ratio, turns, side)
    face_weights = factor * _weights(count, depths)
    stress = _summed(top, top_weights, across.to_waves[kept] @ added)
    stress += _turned(_summed(face, face_weights, across.to_waves[kept] @ freed))
    found[:, :, near[:, None] & shallow] = stress.reshape(*stress.shape[:2], -1)
    return found


def between_faces(
    ratio: float, wave: float, half: float, loads: RowLoads, places: Places, *, odd: bool
) -> Floats:
    """The same between a free face and a plane at a distance `half`, where p is even or odd.

    `wave` is k from `longest_wave` to `strip.HIGHEST_WAVE` over `half` [1/m].
    """
    table = strip.strip_table(ratio, odd=odd)
    product = wave * half
    solved = table if product >= strip.LOWEST_WAVE else long_loads(ratio, odd=odd)
    until = table.panels.weights_until(np.minimum(loads.borders / half, 1.0))
    masses = product * (np.diff(until, axis=0).T @ loads.amplitudes)
    freed, sent = (each @ masses for each in solved.loads(product))
    sign = -1.0 if odd else 1.0
    # 1. The surface: single waves of the strip, then Filon's sum over the others.
    turns, to_waves = _strip_waves(table.panels, odd=odd)
    places_across = places.distances / half
    cosines = _strip_weights(places_across, odd=odd)
    top = _under_waves(ratio, turns / product, wave * places.depths)
    stress = _summed(top, cosines, to_waves @ sent)
    # 2. The faces.
    count = _panels_to(SHORTEST / (wave * loads.row))
    across, kept = _across(table.face_panels), slice(0, count * NODES)
    side = slab_functions(np.hypot(1.0, across.waves[kept]), wave * places.distances, product, sign)
    face = _from_face(ratio, across.waves[kept], side)
    weights = 2 / np.pi * _weights(count, wave * places.depths)
    return stress + _turned(_summed(face, weights, across.to_waves[kept] @ freed))


@dataclass(frozen=True, eq=False)
class Across:
    """Waves across the surface or down a face, in k, and the transform from nodes of panels."""

    waves: Floats
    to_waves: Floats  # weights of ∫ f cos(cX) dX, shape (waves, nodes)


def _borders() -> Floats:
    count = int(np.ceil(np.log(LAST / FIRST) / np.log(RATIO)))
    return np.append(0.0, FIRST * RATIO ** np.arange(count + 1))


def _panels_to(highest: float) -> int:
    """Panels of waves up to a highest one."""
    borders = _borders()
    return min(int(np.searchsorted(borders, highest)) + 1, len(borders) - 1)


@lru_cache(maxsize=8)
def _across(panels: LogPanels) -> Across:
    borders = _borders()
    waves = panel_nodes(borders, NODES)[0]
    return Across(waves, strip.cosine_transform(panels, waves))


def _weights(count: int, places: Floats) -> Floats:
    """Filon's weights of cosines and sines over panels of waves, at places; (2, places, waves)."""
    found = oscillation_weights(_borders()[: count + 1], NODES, places)
    return np.stack([found.real, found.imag])


@lru_cache(maxsize=4)
def _strip_waves(panels: LogPanels, *, odd: bool) -> tuple[Floats, Floats]:
    """Waves across a strip times its half width, and transforms of values at nodes of X/W."""
    single = np.pi * (np.arange(SINGLE, dtype=np.float64) + (0.5 if odd else 0.0))
    others = panel_nodes(_strip_borders(odd=odd), NODES)[0]
    waves = np.append(single, others)
    found = strip.cosine_transform(panels, waves)
    # Between single waves, less the part of the middle, at which single ones have none.
    step = 1e-4
    places = 1 + 2 * np.log1p(step * np.array([-1, 0, 1])) / np.diff(panels.edges)[-1]
    before, middle, behind = interpolation(places)
    slope = (behind - before) / (2 * step)
    found[SINGLE:, -len(middle) :] -= np.multiply.outer(np.sin(others) / others, middle)
    found[SINGLE:, -len(middle) :] -= np.multiply.outer(np.cos(others) / others**2, slope)
    return waves, found


def _strip_borders(*, odd: bool) -> Floats:
    """Borders of panels of waves beyond the single ones."""
    first = np.pi * (SINGLE - (0.0 if odd else 0.5))
    return np.asarray(first * RATIO ** np.arange(10))


def _strip_weights(places: Floats, *, odd: bool) -> Floats:
    """Weights of cosines and sines of waves across a strip at places X/W; (2, places, waves).

    Beyond the single ones the sum over n is an integral, but for the leading term of the formula
    of Euler and Maclaurin for an oscillation, (πX/2W)/sin(πX/2W).
    """
    turns = np.pi * (np.arange(SINGLE, dtype=np.float64) + (0.5 if odd else 0.0))
    measure = np.full(SINGLE, 2.0)
    if not odd:
        measure[0] = 1.0
    phases = np.multiply.outer(places, turns)
    single = np.stack([np.cos(phases), np.sin(phases)]) * measure
    rest = oscillation_weights(_strip_borders(odd=odd), NODES, places)
    factor = 2 / np.pi / np.sinc(places / 2)[:, None]
    return np.concatenate([single, factor * np.stack([rest.real, rest.imag])], axis=2)


def _under_waves(ratio: float, turns: Floats, depths: Floats) -> Floats:
    """Stresses under waves of pressure on the surface, by k and 1/k; (6, waves, depths)."""
    rate = np.hypot(1.0, turns)[:, None]
    decay = rate * depths
    normal, along, shear = -(1 + decay), -(1 - decay), -decay
    parts = (along, -2 * ratio * np.ones_like(decay), normal, shear)
    return _directed(turns, *(part * np.exp(-decay) for part in parts))


def _from_face(ratio: float, turns: Floats, slab: SlabFunctions) -> Floats:
    """Stresses under waves of tension on the face, with the depth as x and the distance as z."""
    along = 2 * slab.half_sum - slab.normal
    return _directed(turns, along, 2 * ratio * slab.half_sum, slab.normal, slab.shear)


def _directed(turns: Floats, ahead: Floats, aside: Floats, normal: Floats, shear: Floats) -> Floats:
    """Stresses of waves cos cos along two axes, from those along and across their direction."""
    rate = np.hypot(1.0, turns)[:, None]
    east, north = turns[:, None] / rate, 1 / rate
    xx = east**2 * ahead + north**2 * aside
    yy = north**2 * ahead + east**2 * aside
    # σxz goes as sin cos, σyz as cos sin, σxy as sin sin.
    return np.stack([xx, yy, normal, north * shear, east * shear, east * north * (aside - ahead)])


#: Components that go as the sine of the waves across, and of those along.
_ODD_ACROSS = (False, False, False, False, True, True)
_ODD_ALONG = (False, False, False, True, False, True)


def _summed(tensors: Floats, weights: Floats, amplitudes: Floats) -> Floats:
    """Sums over waves (6, waves, n) with weights at m places; (6, columns, m, n)."""
    columns = amplitudes.shape[1] // 2
    found = np.empty((6, columns, weights.shape[1], tensors.shape[2]))
    kinds = zip(found, tensors, _ODD_ACROSS, _ODD_ALONG, strict=True)
    for into, tensor, odd_across, odd_along in kinds:
        own = weights[int(odd_across)]
        part = amplitudes[:, columns:] if odd_along else amplitudes[:, :columns]
        if tensor.shape[1] < columns:
            for index in range(tensor.shape[1]):
                into[:, :, index] = (own @ (tensor[:, index, None] * part)).T
        else:
            for column, amplitude in enumerate(part.T):
                into[column] = (own * amplitude) @ tensor
    return found


def _turned(stress: Floats) -> Floats:
    """Components with x and z exchanged, and places so too."""
    return stress[[2, 1, 0, 5, 4, 3]].swapaxes(2, 3)
