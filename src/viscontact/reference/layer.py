"""Round punch, sphere and cone on an elastic layer on a rigid base, by an integral equation.

The Hankel transform of the pressure is written as P(q) = ∫_0^a φ(t) cos(q t) dt, so that an inverse
Abel transform turns the surface displacement δ - f(r) under the body into

    φ(t) + (1/π) ∫_0^a φ(s) [M(t - s) + M(t + s)] ds = g(t)/(π J),
    M(x) = ∫_0^∞ (L(q) - 1) cos(q x) dq,   g(t) = d/dt ∫_0^t r (δ - f(r))/sqrt(t² - r²) dr,

with J = (1 - ν)/(2 G) and L(q) the displacement under a wave of pressure over that of a half-space.
The force is 2 π ∫_0^a φ dt. At the rim of a smooth body φ(a) = 0.

References
----------
N. N. Lebedev, Ia. S. Ufliand, J. Appl. Math. Mech. 22 (1958) 442; I. N. Sneddon, Mixed Boundary
Value Problems in Potential Theory (1966); K. L. Johnson, Contact Mechanics (1985), section 5.8.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.profiles import ConeProfile, Profile, SphereProfile
from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array

#: Wave number times thickness beyond which L - 1 is below rounding.
SHORTEST_WAVE = 22.0

#: Gauss nodes: per thickness on the contact radius with the least number, and in each panel of M.
NODES_PER_THICKNESS, LEAST_NODES, PANEL_NODES = 8, 48, 16


@dataclass(frozen=True, eq=False)
class LayerContact:
    """A rigid round body, pressed on an elastic layer on a rigid base.

    Attributes
    ----------
    force : float
        Load, positive into the layer [N].
    approach : float
        Approach of the body to the base, positive when they come closer [m].
    contact_radius : float
        Radius of the contact [m].
    places, densities : ndarray, shape (n,)
        Gauss nodes t of the contact radius [m] and the density φ(t) there [N/m].
    edge_density : float
        The density at the rim, 0 for a smooth body [N/m].
    """

    force: float
    approach: float
    contact_radius: float
    places: Floats
    densities: Floats
    edge_density: float

    def pressure(self, r: ArrayLike) -> Values:
        """Contact pressure, positive in compression [Pa].

        Parameters
        ----------
        r : array_like
            Distance from the axis [m].

        Returns
        -------
        float or ndarray
            φ(a)/sqrt(a² - r²) - ∫_r^a φ'(t)/sqrt(t² - r²) dt; infinite at the edge of a punch, zero
            outside [Pa].

        Examples
        --------
        On a layer of 20 contact radii the pressure is Hertz's, 3 F/(2 π a²) at the centre:

        >>> ball = layer_sphere(1e-3, 0.01, 0.02, shear_modulus=1e6, poisson_ratio=0.3)
        >>> print(f"{ball.pressure(0.0) * 2 * math.pi * 1e-6 / (3 * ball.force):.6f}")
        1.000000
        """
        r, a = np.abs(real_array("r", r, "m"))[..., None], self.contact_radius
        # φ is smooth: a polynomial in t/a through its values at Gauss nodes and at the rim.
        fitted = np.polynomial.Chebyshev.fit(
            np.append(self.places, a),
            np.append(self.densities, self.edge_density),
            self.places.size // 2,
            domain=(0.0, a),
        ).deriv()
        # With t² = r² + s² the integral is that of φ'(t)/t over 0 < s < sqrt(a² - r²).
        nodes, weights = np.polynomial.legendre.leggauss(2 * self.places.size)
        half = np.sqrt(np.maximum(a**2 - r**2, 0.0)) / 2
        t = np.hypot(r, half * (1 + nodes))
        inside = np.sum(weights * half * fitted(t) / t, axis=-1)
        with np.errstate(divide="ignore"):
            at_edge = self.edge_density / (2 * half[..., 0]) if self.edge_density else 0.0
        return np.where(r[..., 0] <= a, at_edge - inside, 0.0)[()]


def layer_sphere(
    contact_radius: float,
    radius: float,
    thickness: float,
    *,
    shear_modulus: float,
    poisson_ratio: float,
    bonded: bool = True,
) -> LayerContact:
    """Contact of a rigid sphere (paraboloid) with an elastic layer on a rigid base.

    Parameters
    ----------
    contact_radius : float
        Radius a of the contact [m].
    radius : float
        Radius of the sphere [m].
    thickness : float
        Thickness h of the layer [m].
    shear_modulus : float
        Shear modulus of the layer [Pa].
    poisson_ratio : float
        Poisson's ratio of the layer, 0 to 0.5 [-].
    bonded : bool, optional
        The layer is bonded to its base; otherwise it slips there without friction.

    Returns
    -------
    LayerContact
        The force and the approach of this contact radius.

    Raises
    ------
    ValueError
        If a length or modulus is not positive, or Poisson's ratio is out of range.

    Examples
    --------
    A layer as thick as the contact radius is 1.3 times as stiff as a half-space:

    >>> ball = layer_sphere(1.0, 1.0, 1.0, shear_modulus=1.0, poisson_ratio=0.38)
    >>> modulus = 2 / (1 - 0.38)
    >>> print(f"{ball.force / modulus:.6f}, half-space {4 / 3:.6f}")
    1.730067, half-space 1.333333
    """
    profile = SphereProfile(radius)
    require_positive("m", contact_radius=contact_radius)
    layer = _Layer.of(thickness, shear_modulus, poisson_ratio, bonded=bonded)
    return _Equation(layer, contact_radius).smooth_contact(profile)


def layer_cone(
    contact_radius: float,
    half_angle: float,
    thickness: float,
    *,
    shear_modulus: float,
    poisson_ratio: float,
    bonded: bool = True,
) -> LayerContact:
    """Contact of a rigid cone with an elastic layer on a rigid base.

    Parameters
    ----------
    contact_radius : float
        Radius a of the contact [m].
    half_angle : float
        Angle between the axis and the side, between 0 and π/2 [rad].
    thickness : float
        Thickness h of the layer [m].
    shear_modulus : float
        Shear modulus of the layer [Pa].
    poisson_ratio : float
        Poisson's ratio of the layer, 0 to 0.5 [-].
    bonded : bool, optional
        The layer is bonded to its base; otherwise it slips there without friction.

    Returns
    -------
    LayerContact
        The force and the approach of this contact radius.

    Raises
    ------
    ValueError
        If a length, the angle or the modulus is out of range, or Poisson's ratio is.

    Examples
    --------
    A thick layer: Sneddon's force E* a² π cot(half angle)/2 (1965):

    >>> cone = layer_cone(1.0, math.pi / 4, 1e3, shear_modulus=0.25, poisson_ratio=0.5)
    >>> print(f"{cone.force:.3f}, {math.pi / 2:.3f}")
    1.571, 1.571
    """
    profile = ConeProfile(half_angle)
    require_positive("m", contact_radius=contact_radius)
    layer = _Layer.of(thickness, shear_modulus, poisson_ratio, bonded=bonded)
    return _Equation(layer, contact_radius).smooth_contact(profile)


def layer_punch(
    radius: float,
    approach: float,
    thickness: float,
    *,
    shear_modulus: float,
    poisson_ratio: float,
    bonded: bool = True,
) -> LayerContact:
    """Contact of a rigid flat-ended round punch with an elastic layer on a rigid base.

    Parameters
    ----------
    radius : float
        Radius a of the punch [m].
    approach : float
        Approach of the punch to the base [m].
    thickness : float
        Thickness h of the layer [m].
    shear_modulus : float
        Shear modulus of the layer [Pa].
    poisson_ratio : float
        Poisson's ratio of the layer, 0 to 0.5 [-].
    bonded : bool, optional
        The layer is bonded to its base; otherwise it slips there without friction.

    Returns
    -------
    LayerContact
        The force of this approach.

    Raises
    ------
    ValueError
        If a length or modulus is not positive, or Poisson's ratio is out of range.

    Examples
    --------
    A layer as thick as the punch's radius, over the 2 E* a of a half-space:

    >>> punch = layer_punch(1.0, 1.0, 1.0, shear_modulus=0.35, poisson_ratio=0.3)
    >>> print(f"{punch.force / 2:.6f}")
    2.483525
    """
    require_positive("m", radius=radius, approach=approach)
    layer = _Layer.of(thickness, shear_modulus, poisson_ratio, bonded=bonded)
    equation = _Equation(layer, radius)
    found = equation.solve(lambda t: np.full_like(t, approach))
    return equation.contact(found, approach)


@dataclass(frozen=True)
class _Layer:
    """Elastic layer on a rigid base."""

    thickness: float
    compliance: float  # (1 - ν)/(2 G) [1/Pa]
    poisson_ratio: float
    bonded: bool

    @classmethod
    def of(
        cls, thickness: float, shear_modulus: float, poisson_ratio: float, *, bonded: bool
    ) -> _Layer:
        """The layer, checked."""
        require_positive("m", thickness=thickness)
        require_positive("Pa", shear_modulus=shear_modulus)
        if not -1 < poisson_ratio <= 0.5:
            raise ValueError(
                f"poisson_ratio must be above -1 and at most 0.5, got {poisson_ratio!r}"
            )
        return cls(thickness, (1 - poisson_ratio) / (2 * shear_modulus), poisson_ratio, bonded)

    def deviation(self, q: Floats) -> Floats:
        """L - 1 at wave numbers [-]."""
        w = q * self.thickness
        waned = np.exp(-2 * w)
        if not self.bonded:  # L = (cosh 2w - 1)/(sinh 2w + 2w)
            above = -2 * waned * (1 + 2 * w - waned)
            return np.asarray(above / (1 + 4 * w * waned - waned**2))
        k = 3 - 4 * self.poisson_ratio  # L = (2k sinh 2w - 4w)/(2k cosh 2w + 1 + k² + 4w²)
        above = -waned * (4 * w + 1 + k**2 + 4 * w**2 + 2 * k * waned)
        return np.asarray(above / (k + (1 + k**2 + 4 * w**2) * waned + k * waned**2))


@dataclass(frozen=True, eq=False)
class _Density:
    """Density φ at the nodes and at the rim [N/m]."""

    densities: Floats
    edge: float


class _Equation:
    """The integral equation on Gauss nodes of one contact radius."""

    def __init__(self, layer: _Layer, contact_radius: float) -> None:
        self._layer, self._radius = layer, contact_radius
        ratio = contact_radius / layer.thickness
        nodes, weights = np.polynomial.legendre.leggauss(
            LEAST_NODES + math.ceil(NODES_PER_THICKNESS * ratio)
        )
        self.places, self._weights = (1 + nodes) * contact_radius / 2, weights * contact_radius / 2
        self._cosines(ratio)

    def _cosines(self, ratio: float) -> None:
        # ∫ (L - 1) cos(q t) cos(q s) dq = Σ over Gauss nodes of q, in panels of half a period.
        panels = math.ceil(SHORTEST_WAVE * (1 + ratio))
        nodes, weights = np.polynomial.legendre.leggauss(PANEL_NODES)
        length = SHORTEST_WAVE / self._layer.thickness / panels
        q = (length * (np.arange(panels)[:, None] + (1 + nodes) / 2)).ravel()
        strength = np.tile(weights * length / 2, panels) * self._layer.deviation(q)
        at = np.cos(np.multiply.outer(np.append(self.places, self._radius), q))
        kernel = (2 / math.pi) * (at * strength) @ at[:-1].T * self._weights
        self._matrix, self._edge_row = np.eye(len(self.places)) + kernel[:-1], kernel[-1]

    def solve(self, displacement: object) -> _Density:
        """Density for g(t) = `displacement`(t) [m]."""
        assert callable(displacement)
        scale = math.pi * self._layer.compliance
        densities = np.linalg.solve(self._matrix, displacement(self.places) / scale)
        edge = float(displacement(np.array(self._radius))) / scale - self._edge_row @ densities
        return _Density(densities, float(edge))

    def smooth_contact(self, profile: Profile) -> LayerContact:
        """Contact of a profile whose pressure is zero at the rim: the approach makes it so."""
        level, curved = self.solve(np.ones_like), self.solve(profile.depth)
        approach = curved.edge / level.edge
        densities = approach * level.densities - curved.densities
        return self.contact(_Density(densities, 0.0), approach)

    def contact(self, found: _Density, approach: float) -> LayerContact:
        """The contact of a density."""
        force = 2 * math.pi * float(self._weights @ found.densities)
        return LayerContact(
            force, float(approach), self._radius, self.places, found.densities, found.edge
        )
