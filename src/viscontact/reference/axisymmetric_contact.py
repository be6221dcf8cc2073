"""Result of an axisymmetric viscoelastic contact: history, pressure and surface displacement."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.hereditary import TimeFunction
from viscontact.reference.profiles import Profile, arcsine
from viscontact.reference.values import Values
from viscontact.units.numbers import real_array


@dataclass(frozen=True, eq=False)
class AxisymmetricContact:
    """A round indenter on a viscoelastic half-space, through a history of approach or force.

    Made by `press_axisymmetric`.

    Attributes
    ----------
    profile : SphereProfile, ConeProfile or PunchProfile
        The indenter.
    creep_compliance : callable
        J(t) [1/Pa].
    controlled : str
        The given quantity, "approach" or "force".
    elements, substeps : int
        The resolution.
    times : ndarray, shape (n,)
        The instants [s]; a jump has two, the state just before it and just after.
    force : ndarray, shape (n,)
        Force on the half-space, 0 without contact [N].
    approach : ndarray, shape (n,)
        Approach; under no force where the body just touches the deformed surface [m].
    contact_radius : ndarray, shape (n,)
        Radius of the contact circle, 0 without contact [m].
    work : ndarray, shape (n,)
        Work of the load since the beginning [J].
    touched, lost : ndarray
        Instants when contact was made, and when it was lost altogether [s].
    places : ndarray, shape (m,)
        Radii s of the transforms [m].
    transformed_pressure : ndarray, shape (n, m)
        χ(s) = 2 integral of r p(r)/sqrt(r² - s²) over r > s [N/m].
    transformed_displacement : ndarray, shape (n, m)
        v(s) = d/ds integral of r u(r)/sqrt(s² - r²) over r < s [m].
    """

    profile: Profile
    creep_compliance: TimeFunction
    controlled: Literal["approach", "force"]
    elements: int
    substeps: int
    times: Floats
    force: Floats
    approach: Floats
    contact_radius: Floats
    work: Floats
    touched: Floats
    lost: Floats
    places: Floats
    transformed_pressure: Floats
    transformed_displacement: Floats

    def pressure(self, r: ArrayLike, t: float) -> Values:
        """Contact pressure, positive in compression [Pa].

        Parameters
        ----------
        r : array_like
            Distance from the axis [m].
        t : float
            Instant, within `times`; just after a jump. Between `times`, linear [s].

        Returns
        -------
        float or ndarray
            The pressure, zero outside the contact; infinite at a punch's edge [Pa].

        Raises
        ------
        ValueError
            If the instant is outside `times`.

        Notes
        -----
        p(r) = -(1/π) integral of χ'(s)/sqrt(s² - r²) over r < s < a, and for a punch
        χ(a)/(π sqrt(a² - r²)).

        Examples
        --------
        >>> from viscontact import reference
        >>> contact = reference.press_axisymmetric(reference.SphereProfile(0.01), [0.0],
        ...     force=[10.0], creep_compliance=lambda t: np.full_like(t, 5e-10))
        >>> print(f"{contact.pressure(0.0, 0.0) / 1e6:.3f} MPa")  # Hertz: 42.617
        42.617 MPa
        """
        distance = np.abs(real_array("r", r, "m"))
        chi, a = self._at(t, self.transformed_pressure), float(self._at(t, self.contact_radius))
        if np.isfinite(self.profile.edge):
            return _under_punch(distance, self.profile.edge, float(chi[0]))
        inside = chi > 0
        places, loads = np.append(self.places[inside], a), np.append(chi[inside], 0.0)
        shapes = self.profile.outer_integral(places, distance[..., None])
        rises = np.diff(shapes, axis=-1) * _slopes(self.profile.depth(places), loads)
        p: Values = -np.sum(np.where(np.isfinite(rises), rises, np.inf), axis=-1) / math.pi
        return p

    def displacement(self, r: ArrayLike, t: float) -> Values:
        """Displacement of the surface, positive into the half-space [m].

        Parameters
        ----------
        r : array_like
            Distance from the axis, inside the contact or outside [m].
        t : float
            Instant, within `times`; just after a jump. Between `times`, linear [s].

        Returns
        -------
        float or ndarray
            The displacement, including the residual one after contact is lost [m].

        Raises
        ------
        ValueError
            If the instant is outside `times`.

        Notes
        -----
        u(r) = (2/π) integral of v(s)/sqrt(r² - s²) over s < r, v(s) = J * dχ for every s that
        was ever pressed, and 0 beyond.

        Examples
        --------
        >>> from viscontact import reference
        >>> contact = reference.press_axisymmetric(reference.ConeProfile(1.4), [0.0],
        ...     approach=[1e-5], creep_compliance=lambda t: np.full_like(t, 5e-10))
        >>> print(f"{contact.displacement(2e-5, 0.0) * 1e6:.4f} um")  # 10 um - r cot(1.4)
        6.5505 um
        """
        distance = np.abs(real_array("r", r, "m"))[..., None]
        v = self._at(t, self.transformed_displacement)
        if np.isfinite(self.profile.edge):
            places, values = np.array([0.0, self.profile.edge]), np.array([v[0], v[0]])
        else:
            places, values = self._with_front(t, v)
        depths = self.profile.depth(places)
        slopes = _slopes(depths, values)
        levels = values[:-1] - slopes * depths[:-1]
        parts = levels * np.diff(arcsine(np.minimum(places, distance), distance), axis=-1)
        parts += slopes * np.diff(self.profile.inner_integral(places, distance), axis=-1)
        u: Values = 2 / math.pi * np.sum(parts, axis=-1)
        # On the axis u(0) = v(0).
        return np.where(distance[..., 0] == 0, v[0], u)[()]

    def _with_front(self, t: float, v: Floats) -> tuple[Floats, Floats]:
        """Add the contact radius, where v stops following the indenter, to the radii."""
        a = float(self._at(t, self.contact_radius))
        k = int(np.searchsorted(self.places, a))
        if not 0 < k < len(self.places) or a == self.places[k]:
            return self.places, v
        edge = float(self._at(t, self.approach)) - float(self.profile.depth(np.array(a)))
        return np.insert(self.places, k, a), np.insert(v, k, edge)

    def _at(self, t: float, history: Floats) -> Floats:
        """Interpolate a history linearly at time t [s]."""
        if not self.times[0] <= t <= self.times[-1]:
            raise ValueError(
                f"t: wanted an instant from {self.times[0]:.6g} s to {self.times[-1]:.6g} s, "
                f"got {t!r} s"
            )
        after = int(np.searchsorted(self.times, t, side="right"))
        if after == len(self.times):
            return np.asarray(history[-1])
        begin, end = self.times[after - 1], self.times[after]
        share = (t - begin) / (end - begin)
        return np.asarray((1 - share) * history[after - 1] + share * history[after])


def _slopes(depths: Floats, values: Floats) -> Floats:
    """Slope over depth within each element, 0 where it has no extent."""
    rises, extents = np.diff(values), np.diff(depths)
    return np.divide(rises, extents, out=np.zeros_like(rises), where=extents > 0)


def _under_punch(r: Floats, edge: float, chi: float) -> Values:
    """Pressure under a flat punch, χ/(π sqrt(a² - r²)) [Pa]."""
    with np.errstate(divide="ignore", invalid="ignore"):
        p = np.where(r <= edge, chi / (math.pi * np.sqrt(edge**2 - r**2)), 0.0)
    return np.where(np.isnan(p), 0.0, p)[()]
