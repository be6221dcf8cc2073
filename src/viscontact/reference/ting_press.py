"""Ting's solution for a triangular approach history, in closed form."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq
from scipy.special import hyp1f1

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.profiles import SphereProfile
from viscontact.reference.ting import GrowingProfile
from viscontact.reference.ting_contact import SinglePress
from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array


@dataclass(frozen=True)
class TingTriangle(SinglePress):
    """Sphere or cone moved into a viscoelastic solid and withdrawn at constant speed.

    Made by `ting_triangle`.

    Attributes
    ----------
    profile : SphereProfile or ConeProfile
        The indenter.
    peak : float
        Largest approach [m].
    rise : float
        Duration of loading, and of unloading [s].
    equilibrium : float
        Equilibrium modulus of M(t) [Pa].
    moduli, times : tuple of float
        Terms of M(t) [Pa], [s].
    """

    profile: GrowingProfile
    peak: float
    rise: float
    equilibrium: float
    moduli: tuple[float, ...]
    times: tuple[float, ...]

    def approach(self, t: ArrayLike) -> Values:
        """Approach at time t [m].

        Parameters
        ----------
        t : array_like
            Time, from 0 to twice the rise [s].

        Returns
        -------
        float or ndarray
            Approach [m].
        """
        times = real_array("t", t, "s")
        return (self.peak / self.rise * np.minimum(times, 2 * self.rise - times))[()]

    def _earlier_instants(self, t: Floats) -> Floats:
        return np.array([self._earlier_than(float(now)) for now in t])

    def _contact_radius(self, t: Floats) -> Floats:
        return self.profile.reach(self.peak / self.rise * self._earlier_instants(t))

    def _force(self, t: Floats) -> Floats:
        # 2 integral of M(t - t') a(t') dw(t') from 0 to t_1, a(t') = a(1) t'^p, p = 1/2 for a
        # sphere and 1 for a cone. Integral of exp(-(t - t')/τ) t'^p from 0 to x =
        # exp(-(t - x)/τ) x^(1+p)/(1+p) 1F1(1; 2+p; -x/τ) (DLMF 13.4.1 and 13.2.39).
        x = self._earlier_instants(t)
        p = 0.5 if isinstance(self.profile, SphereProfile) else 1.0
        weighted = np.full(x.shape, self.equilibrium)
        for modulus, tau in zip(self.moduli, self.times, strict=True):
            weighted += modulus * np.exp((x - t) / tau) * hyp1f1(1.0, 2 + p, -x / tau)
        radius = self.profile.reach(self.peak / self.rise * x)
        force: Floats = 2 * self.peak / self.rise * radius * x / (1 + p) * weighted
        return force

    @property
    def lost(self) -> float:
        """Instant when contact is lost [s]."""
        if not any(self.moduli):
            return 2 * self.rise
        return float(brentq(self._load, self.rise, 2 * self.rise, args=(0.0,), xtol=1e-300))

    def _earlier_than(self, now: float) -> float:
        if now <= self.rise:
            return now
        if self._load(now, 0.0) <= 0:
            return 0.0
        return float(brentq(lambda start: self._load(now, start), 0.0, self.rise, xtol=1e-300))

    def _load(self, now: float, start: float) -> float:
        """Integral of M(now - t') from the start, negative after the peak [Pa s]."""
        peak = self.rise
        load = self.equilibrium * (2 * peak - start - now)
        for modulus, tau in zip(self.moduli, self.times, strict=True):
            way_in = -np.exp((peak - now) / tau) * np.expm1((start - peak) / tau)
            load += modulus * tau * (way_in + np.expm1((peak - now) / tau))
        return float(load)


def ting_triangle(
    profile: GrowingProfile,
    peak: float,
    rise: float,
    equilibrium: float,
    moduli: ArrayLike = (),
    times: ArrayLike = (),
) -> TingTriangle:
    """Contact of a sphere or cone moved into a solid and withdrawn at constant speed.

    Parameters
    ----------
    profile : SphereProfile or ConeProfile
        The indenter.
    peak : float
        Largest approach [m].
    rise : float
        Duration of loading, and of unloading [s].
    equilibrium : float
        Equilibrium modulus, 0 for a body that flows [Pa].
    moduli, times : array_like, optional
        Terms of M(t) = equilibrium + sum moduli exp(-t/times), the inverse of the contact
        compliance: one and no equilibrium for a Maxwell body, one for Zener's [Pa], [s].

    Returns
    -------
    TingTriangle
        Force, contact radius and the instant of lost contact.

    Raises
    ------
    ValueError
        If peak or rise is not positive, a modulus negative, a time not positive, or all moduli 0.

    Notes
    -----
    With M the integral of M and b the rise, M(t - t_1) - 2 M(t - b) = 0: for a Maxwell body
    t_1 = τ ln(2 exp(b/τ) - exp(t/τ)).

    References
    ----------
    T. C. T. Ting, J. Appl. Mech. 33 (1966) 845-854.

    Examples
    --------
    >>> contact = ting_triangle(SphereProfile(0.01), 1e-5, 1.0, 0.0, [2e9], [1.0])
    >>> print(f"{contact.force(1.0):.5f} N, contact lost at {contact.lost:.6f} s")
    5.84288 N, contact lost at 1.489880 s
    """
    require_positive("m", peak=peak)
    require_positive("s", rise=rise)
    terms = [
        tuple(np.atleast_1d(real_array(*each)).tolist())
        for each in (("moduli", moduli, "Pa"), ("times", times, "s"))
    ]
    valid = len(terms[0]) == len(terms[1]) and all(tau > 0 for tau in terms[1])
    if not (valid and min([equilibrium, *terms[0]]) >= 0 and max([equilibrium, *terms[0]]) > 0):
        raise ValueError(
            "moduli: wanted a relaxation series with moduli >= 0 Pa, not all 0, and as many "
            f"positive times, got equilibrium={equilibrium!r}, moduli={terms[0]!r}, "
            f"times={terms[1]!r}"
        )
    return TingTriangle(profile, peak, rise, equilibrium, terms[0], terms[1])
