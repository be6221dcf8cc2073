"""Sphere on a Maxwell body under a triangular force history, in closed form."""

from __future__ import annotations

import itertools
import math

import numpy as np
import scipy  # its quadrature is imported at its first use
from numpy.typing import ArrayLike
from scipy.special import lambertw

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.ting_contact import SinglePress, over_times
from viscontact.reference.values import Values, require_positive


@dataclass(frozen=True)
class TingForceTriangle(SinglePress):
    """Sphere on a Maxwell body under a force that rises and falls at one rate.

    Made by `ting_force_triangle`.

    Attributes
    ----------
    peak : float
        Largest force [N].
    rise : float
        Time of its rise, and of its fall [s].
    radius : float
        Radius of the sphere [m].
    modulus : float
        M(0) [Pa].
    relaxation_time : float
        That of M(t) [s].
    """

    peak: float
    rise: float
    radius: float
    modulus: float
    relaxation_time: float

    @property
    def widest(self) -> float:
        """Instant of the largest contact: at the peak of the force, or later [s]."""
        return max(self.rise, 2 * self.rise - self.relaxation_time)

    def _force(self, t: Floats) -> Floats:
        return self.peak / self.rise * np.minimum(t, 2 * self.rise - t)

    def _earlier_instants(self, t: Floats) -> Floats:
        b, tau = self.rise, self.relaxation_time
        left = (2 * b - t) / tau
        on_rise = tau * lambertw(left * np.exp(t / tau)).real
        with np.errstate(divide="ignore", invalid="ignore"):
            after_peak = 2 * b + tau * lambertw(-left * np.exp(-left), -1).real
        shrinking = np.where(on_rise <= b, on_rise, after_peak)
        return np.where(t <= self.widest, t, shrinking)

    def _contact_radius(self, t: Floats) -> Floats:
        # a³ = (3 R/4) J * dF at t_1
        return np.cbrt(self._cube(self._earlier_instants(t)))

    def approach(self, t: ArrayLike) -> Values:
        """Approach of the bodies [m].

        Parameters
        ----------
        t : array_like
            Time, from 0 to twice the rise [s].

        Returns
        -------
        float or ndarray
            a²/R while the contact grows; then it falls short of its largest value by the integral
            of exp((t' - t(t'))/τ) dw(t') from t_1 on, t(t') the later instant of equal contact
            [m].
        """
        return over_times(self._approach, t)

    def _approach(self, t: Floats) -> Floats:
        pairs = zip(t, self._earlier_instants(t), strict=True)
        return np.array(
            [self._rise(now) if now <= self.widest else self._fall(then) for now, then in pairs]
        )

    def _cube(self, times: Values) -> Values:
        """Cube of the radius of the growing contact [m³]."""
        tau = self.relaxation_time
        held = np.maximum(times - self.rise, 0.0)
        crept = times + times**2 / (2 * tau) - 2 * (held + held**2 / (2 * tau))
        cube: Values = 0.75 * self.radius * self.peak / self.rise / self.modulus * crept
        return cube

    def _rise(self, then: float) -> float:
        return float(np.cbrt(self._cube(np.float64(then)))) ** 2 / self.radius

    def _fall(self, then: float) -> float:
        """Approach when the shrinking contact again has the radius of time t [m]."""
        b, tau, rate = self.rise, self.relaxation_time, self.peak / self.rise

        def slope(instant: float) -> float:
            """Decay between two instants of equal contact, times dw/dt at the first."""
            force = float(self.force(instant))
            left = -lambertw(-force / (rate * tau) * math.exp((instant - 2 * b) / tau)).real
            decay = math.exp((instant - 2 * b) / tau + left)
            turned = 2 * (1 + (instant - b) / tau) if instant > b else 0.0
            cube_rate = 0.75 * self.radius * rate / self.modulus * (1 + instant / tau - turned)
            a = float(np.cbrt(self._cube(np.float64(instant))))
            return decay * 2 / (3 * a * self.radius) * cube_rate

        # The substitution t = x³ removes the singularity at the beginning.
        corners = sorted({max(then, corner) for corner in (then, self.rise, self.widest)})
        parts = [
            scipy.integrate.quad(
                lambda x: 3 * x**2 * slope(x**3), low ** (1 / 3), high ** (1 / 3), epsrel=1e-12
            )[0]
            for low, high in itertools.pairwise(corners)
        ]
        return self._rise(self.widest) - float(sum(parts))


def ting_force_triangle(
    peak: float, rise: float, radius: float, modulus: float, relaxation_time: float
) -> TingForceTriangle:
    """Contact of a sphere with a Maxwell body under a force that rises and falls at one rate.

    Parameters
    ----------
    peak : float
        Largest force [N].
    rise : float
        Time of its rise, and of its fall [s].
    radius : float
        Radius of the sphere [m].
    modulus : float
        M(0), the instantaneous contact modulus, 1/J(0) [Pa].
    relaxation_time : float
        τ of M(t) = M(0) exp(-t/τ) [s].

    Returns
    -------
    TingForceTriangle
        Contact radius and approach by time.

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Notes
    -----
    While the contact grows, F = integral of M(t - t') d(4 a³/(3 R)) from 0 to t, and afterwards
    the same up to t_1 (Ting 1966). For a Maxwell body, whose M is one exponential, both together
    are F(t) exp(t/τ) = F(t_1) exp(t_1/τ): Lambert's W gives t_1. That the rods at the edge
    are free, integral of M(t - t') dw from t_1 to t = 0, gives dw(t) = exp((t_1 - t)/τ)
    dw(t_1). The contact grows beyond the peak of the force if that is later than τ.

    References
    ----------
    T. C. T. Ting, J. Appl. Mech. 33 (1966) 845-854; the closed form is derived in the Notes.

    Examples
    --------
    >>> contact = ting_force_triangle(10.0, 1.0, 0.01, 2e9, 1.0)
    >>> print(f"{contact.earlier(1.5):.6f} s, residual {contact.approach(2.0) * 1e6:.5f} um")
    0.905795 s, residual 10.46346 um
    """
    require_positive("N", peak=peak)
    require_positive("s", rise=rise, relaxation_time=relaxation_time)
    require_positive("m", radius=radius)
    require_positive("Pa", modulus=modulus)
    return TingForceTriangle(peak, rise, radius, modulus, relaxation_time)
