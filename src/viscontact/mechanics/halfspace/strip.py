"""Displacement of the surface of a body between two plane faces free of stress.

The body takes -W < x < W, and the pressure on z = 0 is cos(k y) times an even or an odd function
of x. Mirrored about both faces, the load leaves no shear on them, but a normal stress T p. A load
f on the faces, mirrored about z = 0, leaves no shear and no displacement there, but a normal
stress F f. So faces free of stress need f = (I - T F)^-1 T p, and the surface sinks beyond the
mirrored half-space by G p, with (Betti's reciprocity, C the compliance of the faces under f)

    G = T' C (I - T F)^-1 T.

In units of 1/k, at the distance X from the face, with r² = 1 + ζ² and w = k W,

    T = 2 s(X, Z) + (2/π) ∫ [(r² - 2ν) sin(ζZ)/ζ + r² Z cos(ζZ)] Q(r) dζ/r - (1 - 2ν) Q(1),

where s is the stress by the load and its image about one face (see `free_end`), and Q the sum of
exp(-r D) over all further images, of distances D; sin(ζZ)/ζ is taken as the integral of cos(ζZ)
from 0 to Z. F and C are transforms of those of a slab (S. P. Timoshenko & J. N. Goodier, Theory of
Elasticity, 1970, art. 24, with waves along y):

    F = (2/π) ∫ [(ζ/r)² (2H - S) + (2ν/r²) H] cos(ζZ) dζ,   C = (2/π) ∫ (2/r) L cos(ζZ) cos(ζZ') dζ,

with x = r w, ξ = r (w - X), D = sinh x cosh x + x, H = sinh x cosh ξ / D, L = sinh² x / D, and
S = [(sinh x + x cosh x) cosh ξ - ξ sinh ξ sinh x] / D under even loads; under odd ones sinh and
cosh change places and D = sinh x cosh x - x.

For small w the body is a plate loaded at its edge, and w G tends to 2 ν²/(1 - ν²) under even loads,
and to 6 x x' / (W² (1 - ν)(3 + ν)) under odd ones, which bend it.
"""

from __future__ import annotations

from functools import cached_property, lru_cache

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.bessel_functions import modified_bessel
from viscontact.mechanics.halfspace.filon import cosine_weights, panel_nodes
from viscontact.mechanics.halfspace.log_chebyshev import LogChebyshev
from viscontact.mechanics.halfspace.log_panels import LogPanels, interpolation
from viscontact.mechanics.halfspace.strip_slab import slab

#: Range of k W in which faces act on each other and G is tabulated, and number of the places in it,
#: Chebyshev's in ln k W. Above, each face is the end of a body that goes on.
LOWEST_WAVE, HIGHEST_WAVE, WAVES = 0.08, 8.0, 18
SERIES = LogChebyshev(LOWEST_WAVE, HIGHEST_WAVE, WAVES)

#: Lowest k W at which loads on the faces are solved, even and odd ones, which grow as 1/(k W), with
#: the error of the kernels (`long_strip`).
LONGEST_WAVES = 0.002, 0.02

#: First and last place on the faces, in 1/k, and ratio of the ends of panels.
ON_FACE, DEEPEST, RATIO_ON_FACE = 2e-10, 25.0, 9.5

#: First place on the surface, in W, and ratio of the ends of panels.
ON_SURFACE, RATIO = 1e-9, 13.5

#: Nodes of panels of ζ; first panel, ratio and end of those of images, and of those of C.
NODES = 10
OF_IMAGES, IMAGE_RATIO = (0.5, 50.0), 2.0
OF_FACES, FACE_RATIO = (0.5, 10.0), 6.0

#: Products of r and k W from which on images are left out.
FAR = 50.0

#: Parts of a panel of Z in which functions of ln Z are taken as polynomials of Z.
PARTS = 2

#: Places nearer to a face than this, in W, do not count in the stated error: no cell is so short.
SHORTEST = 1e-4


@dataclass(frozen=True, eq=False)
class StripTable:
    """G over Chebyshev's places of ln k W and the nodes of panels of (W - |x|)/W."""

    panels: LogPanels
    coefficients: Floats  # Chebyshev's of w G, less its limit; shape (waves, nodes, nodes)
    limit: Floats  # of w G for small w, shape (nodes, nodes)
    error: float  # asymmetry and last coefficients, over the largest w G [-]
    #: Chebyshev's of the load on the faces that frees them, at the nodes of `face_panels`, and of
    #: the stress that it sends back to the surface, under lines at the nodes of the surface.
    faces: Floats
    tops: Floats
    face_panels: LogPanels

    def weights(self, waves: Floats) -> Floats:
        """Weights of coefficients, then of the limit, in G at w = k W; (waves, coefficients)."""
        inside = np.maximum(waves, LOWEST_WAVE)
        powers = SERIES.powers(inside) / inside[:, None]
        # Towards longer waves G - limit/w is nearly a parabola.
        long = waves < LOWEST_WAVE
        if long.any():
            known = LOWEST_WAVE * np.array([1.0, 2.0, 4.0])
            through = SERIES.powers(known) / known[:, None]
            powers[long] = polynomial_weights(known, waves[long]) @ through
        return np.column_stack([powers, 1 / waves])

    def chebyshev(self, waves: Floats) -> Floats:
        """Weights of the coefficients of `faces` and `tops` at w = k W, shape (waves, terms)."""
        return SERIES.powers(np.clip(waves, LOWEST_WAVE, HIGHEST_WAVE))

    def loads(self, wave: float) -> tuple[Floats, Floats]:
        """Matrices of the load on the faces and of the stress by it above, at w = k W."""
        powers = self.chebyshev(np.array([wave]))[0]
        return np.tensordot(powers, self.faces, axes=1), np.tensordot(powers, self.tops, axes=1)

    @property
    def highest_wave(self) -> float:
        """Largest k W of the table."""
        return HIGHEST_WAVE

    @cached_property
    def entries(self) -> Floats:
        """Coefficients and limit, shape (coefficients, nodes, nodes)."""
        return np.concatenate([self.coefficients, self.limit[None]])


def polynomial_weights(known: Floats, places: Floats) -> Floats:
    """Weights of values at known places in a polynomial through them, at others."""
    vander = np.polynomial.polynomial.polyvander
    count = len(known) - 1
    scaled = known / known[-1], places / known[-1]
    return np.asarray(vander(scaled[1], count) @ np.linalg.inv(vander(scaled[0], count)))


@lru_cache(maxsize=8)
def strip_table(poisson_ratio: float, *, odd: bool) -> StripTable:
    """What two free faces add under even or odd loads, for a constant Poisson's ratio.

    The face of a body with ν = 0.3 sinks by 0.0965 more than that of the mirrored half-space under
    line loads cos(y/W) at x = W/2 and -W/2 (finite elements: 0.0965):

    >>> table = strip_table(0.3, odd=False)
    >>> at_one = np.tensordot(table.weights(np.array([1.0]))[0], table.entries, axes=1)
    >>> from scipy.interpolate import CubicSpline
    >>> under = CubicSpline(table.panels.logarithms, at_one)
    >>> near = np.searchsorted(table.panels.places, 1e-6)
    >>> print(f"{under(np.log(0.5))[near]:.4f}")
    0.0965
    """
    sign = -1.0 if odd else 1.0
    panels = surface_panels()
    waves = SERIES.waves
    parts = [_added(wave, poisson_ratio, sign) for wave in waves]
    raw = np.array([wave * added for wave, (added, _, _) in zip(waves, parts, strict=True)])
    limit = _plate(poisson_ratio, panels.places, odd=odd)
    # The load that is farther from the face feels less of what is left out there.
    farther = np.tri(len(panels.places), dtype=bool).T
    coefficients = SERIES.coefficients(np.where(farther, raw, raw.swapaxes(1, 2)) - limit)
    known = slice(int(np.searchsorted(panels.places, SHORTEST, side="right")), None)
    within = raw[:, known, known]
    skew = np.abs(within - within.swapaxes(1, 2)).max()
    tail = np.abs(coefficients[-2:, known, known]).sum(axis=0).max()
    largest = max(raw.max(), -raw.min())
    freed, sent = (SERIES.coefficients(np.array([part[k] for part in parts])) for k in (1, 2))
    error = float((skew + tail) / largest)
    return StripTable(panels, coefficients, limit, error, freed, sent, face_of_strips().panels)


def _plate(poisson_ratio: float, places: Floats, *, odd: bool) -> Floats:
    """Limit of w G for long waves, of a plate that is loaded at its edge."""
    if not odd:
        return np.full((len(places),) * 2, 2 * poisson_ratio**2 / (1 - poisson_ratio**2))
    arm = 1 - places
    return np.asarray(6 * np.outer(arm, arm) / ((1 - poisson_ratio) * (3 + poisson_ratio)))


def _added(wave: float, poisson_ratio: float, sign: float) -> tuple[Floats, Floats, Floats]:
    """G at w = k W, between the nodes of the surface; load on the faces, and stress by it above."""
    face = face_of_strips()
    stress, freed, sent = freeing_loads(wave, poisson_ratio, sign)
    rate = np.hypot(1.0, face.waves)
    sinh, _, denominator, _ = slab(rate * wave, sign)
    compliance = 4 / np.pi * face.wave_weights / rate * sinh**2 / denominator
    left, right = face.to_waves @ stress, face.to_waves @ freed
    return np.asarray(left.T @ (compliance[:, None] * right)), freed, sent


def freeing_loads(wave: float, poisson_ratio: float, sign: float) -> tuple[Floats, Floats, Floats]:
    """Stress on the faces at w = k W, load on them that frees them, and stress by it above."""
    face = face_of_strips()
    stress = _stress_on_face(wave, poisson_ratio, sign)
    weighted = stress * (wave * surface_panels().weights)
    above = _stress_on_surface(wave, poisson_ratio, sign)
    returned = weighted @ above
    returned *= face.panels.weights
    freed = np.linalg.solve(np.eye(len(returned)) - returned, stress)
    sent = above @ (face.panels.weights[:, None] * freed)
    return stress, np.asarray(freed), sent


def _stress_on_face(wave: float, poisson_ratio: float, sign: float) -> Floats:
    """T: normal stress at nodes of the face (rows) under lines at distances X from it (columns)."""
    face, along, parts = face_of_strips(), wave * surface_panels().places, _parts_of(wave)
    depth = face.panels.places[:, None]
    near = along**2 * depth * parts.radial - (1 - 2 * poisson_ratio) * parts.below
    _, cosines = face.images(wave)
    rate = parts.rate
    further = _images(rate * wave, parts, sign)
    far = face.panels.integrals_from_zero((cosines * (rate - 2 * poisson_ratio / rate)) @ further)
    far += depth * ((cosines * rate) @ further)
    once = np.exp(along - 2 * wave) + np.exp(-along - 2 * wave)
    constant = (1 - 2 * poisson_ratio) * sign * once / (1 - sign * np.exp(-2 * wave))
    return np.asarray(2 / np.pi * (near + far) - constant)


def _images(x: Floats, parts: _Parts, sign: float) -> Floats:
    """Sum of exp(-r D) over images beyond that about the face; shape (rates, places)."""
    decay = np.exp(-2 * x)[:, None]
    return np.asarray(sign * (parts.back + decay * parts.own) / (1 - sign * decay))


def _stress_on_surface(wave: float, poisson_ratio: float, sign: float) -> Floats:
    """F: normal stress at distances X from a face (rows) under lines at its nodes (columns)."""
    face, parts = face_of_strips(), _parts_of(wave)
    depth, along = face.panels.places[:, None], wave * surface_panels().places
    near = depth**2 * along * parts.radial - (1 - 2 * poisson_ratio) * parts.beyond
    zeta, cosines = face.images(wave)
    rate, own, other = parts.rate[:, None], parts.own, sign * parts.back
    x = rate * wave
    sinh, cosh, denominator, _ = slab(x, sign)
    xi = x - rate * along
    both = own + other
    half_sum = sinh / denominator * both
    across = ((sinh + x * cosh) * both - xi * sinh * (own - other)) / denominator
    along_z, along_y = (zeta / parts.rate)[:, None] ** 2, 2 * poisson_ratio / rate**2
    of_slab = along_z * (2 * half_sum - across) + along_y * half_sum
    one_face = (along_z * (1 - rate * along) + along_y) * own
    return np.asarray(2 / np.pi * (near + cosines @ (of_slab - one_face))).T


@dataclass(frozen=True, eq=False)
class _Parts:
    """What even and odd loads, and all Poisson's ratios, share at one w = k W."""

    radial: Floats  # K_2(R)/R², between nodes of the face (rows) and of the surface (columns)
    below: Floats  # ∫ K_0 from Z on, likewise
    beyond: Floats  # ∫ K_0 from X on, likewise
    rate: Floats  # r of the waves of images
    own: Floats  # exp(-r X), shape (waves, nodes of the surface)
    back: Floats  # exp(-r (2 W - X)), likewise


@lru_cache(maxsize=WAVES)
def _parts_of(wave: float) -> _Parts:
    """The parts at w = k W."""
    face, surface = face_of_strips(), surface_panels()
    depth, along = face.panels.places, wave * surface.places
    distance = np.hypot(depth[:, None], along)
    order_0, order_1 = modified_bessel(distance)
    radial = (order_0 + 2 * order_1 / distance) / distance**2
    # From Z on, not until Z and the whole, which would lose digits far away.
    below = face.panels.weights @ order_0 - face.panels.integrals_until(order_0)
    until = wave * surface.integrals_from_zero(order_0.T).T
    beyond = np.pi / 2 * np.exp(-depth)[:, None] - until
    rate = np.hypot(1.0, face.images(wave)[0])
    paths = np.multiply.outer(rate, along)
    back = np.exp(paths - 2 * wave * rate[:, None])
    return _Parts(radial, below, beyond, rate, np.exp(-paths), back)


@dataclass(frozen=True, eq=False)
class Face:
    """Places on the faces, in 1/k, and transforms between them and waves ζ."""

    panels: LogPanels
    image_waves: Floats
    cosines: Floats  # Filon's weights of ∫ f cos(ζZ) dζ over the waves of images
    waves: Floats
    wave_weights: Floats  # of an integral over the waves
    to_waves: Floats  # weights of ∫ f cos(ζZ) dZ, shape (waves, nodes)

    def images(self, wave: float) -> tuple[Floats, Floats]:
        """Waves that images have at w = k W, with weights of their cosines."""
        kept = slice(0, int(np.searchsorted(self.image_waves, FAR / wave)))
        return self.image_waves[kept], self.cosines[:, kept]


@lru_cache(maxsize=1)
def surface_panels() -> LogPanels:
    """Panels of the distance from a face over W, up to the middle."""
    return LogPanels.over(ON_SURFACE, 1.0, RATIO)


@lru_cache(maxsize=1)
def face_of_strips() -> Face:
    """Places on the faces, and their transforms."""
    panels = LogPanels.over(ON_FACE, DEEPEST, RATIO_ON_FACE)
    borders = _borders(OF_IMAGES[0], OF_IMAGES[1] / LONGEST_WAVES[0], IMAGE_RATIO)
    waves = cosine_weights(borders, NODES, panels.places)
    of_faces = _borders(OF_FACES[0], OF_FACES[1] / ON_FACE, FACE_RATIO)
    zeta, weights = panel_nodes(of_faces, NODES)
    return Face(
        panels,
        panel_nodes(borders, NODES)[0],
        waves,
        zeta,
        weights,
        cosine_transform(panels, zeta),
    )


def _borders(first: float, last: float, ratio: float) -> Floats:
    """Borders of panels from 0 to a wave."""
    count = int(np.ceil(np.log(last / first) / np.log(ratio)))
    return np.append(0.0, first * ratio ** np.arange(count + 1))


def cosine_transform(panels: LogPanels, zeta: Floats) -> Floats:
    """Weights of ∫ f cos(ζZ) dZ at the nodes of panels of ln Z; shape (waves, nodes)."""
    # Panels are of one length, so that parts lie alike in all of them.
    begin, end = panels.edges[:2]
    places = np.log(panel_nodes(np.exp(np.linspace(begin, end, PARTS + 1)), NODES)[0])
    inside = interpolation((2 * places - begin - end) / (end - begin))
    count = len(panels.edges) - 1
    borders = np.exp(np.linspace(begin, panels.edges[-1], PARTS * count + 1))
    weights = cosine_weights(borders, NODES, zeta)
    found = weights.reshape(len(zeta), count, -1) @ inside
    return np.asarray(found.reshape(len(zeta), -1))
