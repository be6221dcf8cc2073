"""Displacement of the surface of a body that ends at a plane face free of stress.

The body takes x > 0, the pressure p acts on z = 0, and the face is x = 0. A load on a half-space
and its mirror image about the plane of the face leave no shear on it, but a normal stress. A load
on the face that cancels it is mirrored in turn about z = 0, where it leaves no shear and no
displacement, but a normal stress, and so on: two half-spaces overlap (M. Hetényi, J. Appl. Mech.
27 (1960) 289). Waves cos(k y) of the load do not mix. With A the map from the load on one face to
the stress on the other, in X = k x and Z = k z,

    A p~(Z) = 2 ∫ s(X, Z) p~ dX,   s = (X² Z K_2(R)/R² - (1 - 2ν) ∫_Z^∞ K_0(√(X² + t²)) dt) / π,

R² = X² + Z², the sum of all images is p~ = (I - A²)^-1 p. The displacement per compliance is that
of the mirrored half-space, (2/π) (K_0(|X - X'|) + K_0(X + X')), under p~. Its part under p~ - p is

    g(X, X') = ∫ (2/π) (K_0(|X - X"|) + K_0(X + X")) ((I - A²)^-1 - I)(X", X') dX",

which depends on Poisson's ratio only, is symmetric and positive, and is a short sum of products
φ_m(X) φ_m(X') for all wave numbers and positions at once.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.bessel_functions import modified_bessel, modified_bessel_0
from viscontact.mechanics.halfspace.cubic_curves import CubicCurves
from viscontact.mechanics.halfspace.log_panels import NODES, LogPanels

#: First and last place of the panels, and ratio of the ends of a panel. What a load sends nearer
#: to the corner than the first place is left out: a part LOWEST / X of the load.
LOWEST, HIGHEST, RATIO = 1e-13, 25.0, 8.0

#: Panels nearer to the corner than this are not tabulated; nearer places count as this.
NEAREST = 1e-7

#: Parts of a panel on which functions are cubics.
PARTS = 16

#: Largest entry of g that its products may leave out, relative to the largest one.
NEGLECTED = 3e-8


@dataclass(frozen=True, eq=False)
class EndFunctions:
    """Functions φ_m(X) of a free end, with g(X, X') = Σ φ_m(X) φ_m(X')."""

    poisson_ratio: float
    neglected: float  # largest entry left out of g, over the largest entry [-]
    asymmetry: float  # |g(X, X') - g(X', X)| before it is made symmetric, likewise [-]
    _values: CubicCurves  # of ln X
    _nearest: float

    def at(self, place: Floats) -> Floats:
        """φ_m at places X >= 0, shape (..., m); zero far from the end."""
        found = np.zeros((*place.shape, self._values.coefficients.shape[-1]))
        near = place < HIGHEST
        found[near] = self._values(np.log(np.maximum(place[near], self._nearest)))
        return found


@lru_cache(maxsize=8)
def end_functions(poisson_ratio: float) -> EndFunctions:
    """Functions of a free end of a body with a constant Poisson's ratio.

    The end of a body with ν = 0.3 sinks by 0.0866 more than that of the mirrored half-space, under
    a line load cos(y/x) at the distance x, at half this distance (finite elements: 0.08657):

    >>> functions = end_functions(0.3)
    >>> print(f"{functions.at(np.array(0.5)) @ functions.at(np.array(1.0)):.4f}")
    0.0866
    """
    panels = images(poisson_ratio).panels
    first = int(np.searchsorted(np.exp(panels.edges), NEAREST)) - 1
    known = slice(first * NODES, None)
    near = LogPanels(panels.edges[first:])
    raw = (_displacement(panels) @ images(poisson_ratio).density)[known, known]
    # The load that is farther from the corner feels less of what is left out there.
    g = np.triu(raw) + np.triu(raw, 1).T
    factors, left = pivoted_cholesky(np.diagonal(g).copy(), lambda k: g[:, k], NEGLECTED)
    return EndFunctions(
        poisson_ratio,
        left / float(g.max()),
        float(np.abs(raw - raw.T).max() / g.max()),
        CubicCurves.on_panels(near, factors, PARTS),
        float(np.exp(near.edges[0])),
    )


@dataclass(frozen=True, eq=False)
class Images:
    """What one face sends to the other, between nodes of panels of X and of Z."""

    panels: LogPanels
    density: Floats  # (I - A²)^-1 - I at the nodes, under unit line loads at the nodes
    stress: Floats  # s at the nodes of Z (columns) of unit line loads at those of X (rows)


@lru_cache(maxsize=8)
def images(poisson_ratio: float) -> Images:
    """Images of loads near a free end."""
    panels = LogPanels.over(LOWEST, HIGHEST, RATIO)
    stress = _stress(panels, poisson_ratio)
    return Images(panels, _density_of(panels, stress), stress)


def image_density(panels: LogPanels, poisson_ratio: float) -> Floats:
    """(I - A²)^-1 - I at the nodes X, under a unit line load at the nodes X'."""
    return _density_of(panels, _stress(panels, poisson_ratio))


def _density_of(panels: LogPanels, of_loads: Floats) -> Floats:
    stress = 2 * of_loads.T * panels.weights
    both = stress @ stress
    return np.asarray(np.linalg.solve(np.eye(len(both)) - both, both) / panels.weights)


def _stress(panels: LogPanels, poisson_ratio: float) -> Floats:
    """Stress s on the other face at depths Z (columns) of unit line loads at X (rows)."""
    along, depth = panels.places[:, None], panels.places
    distance = np.hypot(along, depth)
    order_0, order_1 = _of_both_sides(distance)
    # ∫_Z^∞ K_0(√(X² + t²)) dt from its value at Z = 0, (π/2) exp(-X), would lose digits far away.
    below = panels.integrals_until(order_0.T).T
    beyond = panels.weights @ order_0.T
    tail = beyond[:, None] - below
    order_2 = order_0 + 2 * order_1 / distance
    radial = along**2 * depth * order_2 / distance**2
    return np.asarray((radial - (1 - 2 * poisson_ratio) * tail) / np.pi)


def _of_both_sides(places: Floats) -> tuple[Floats, Floats]:
    """K_0 and K_1 at the entries of a matrix that is symmetric."""
    upper = np.triu_indices(len(places))
    found = np.empty((2, *places.shape))
    for each, values in zip(found, modified_bessel(places[upper]), strict=True):
        each[upper] = each.T[upper] = values
    return found[0], found[1]


def _displacement(panels: LogPanels) -> Floats:
    """Displacement at the nodes of the mirrored half-space under a density at the nodes."""
    image = modified_bessel_0(panels.places[:, None] + panels.places) * panels.weights
    own = panels.weights_of_logarithm(modified_bessel_0)
    return np.asarray(2 / np.pi * (own + image))


def pivoted_cholesky(
    diagonal: Floats, column: Callable[[int], Floats], tolerance: float
) -> tuple[Floats, float]:
    """Factors F of a positive matrix F F' and the largest entry left out, by greatest pivots."""
    left, columns = diagonal, np.empty((len(diagonal), 0))
    largest = float(left.max())
    while columns.shape[1] < len(left) and left.max() > tolerance * largest:
        pivot = int(left.argmax())
        rest = column(pivot) - columns @ columns[pivot]
        rest /= np.sqrt(rest[pivot])
        columns = np.column_stack([columns, rest])
        left = np.maximum(left - rest**2, 0.0)
    return columns, float(left.max(initial=0.0))
