"""Cyclic indentation of a Maxwell body at constant speed, in closed form."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.ting import GrowingProfile
from viscontact.reference.ting_contact import TingContact
from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array

_GAUSS, _WEIGHTS = legendre.leggauss(60)


@dataclass(frozen=True)
class TingCycles(TingContact):
    """Sphere or cone moved cyclically into a Maxwell body at constant speed.

    Made by `ting_cycles`.

    Attributes
    ----------
    profile : SphereProfile or ConeProfile
        The indenter.
    peak : float
        Largest approach [m].
    rise : float
        Duration of each loading, and of each unloading [s].
    modulus : float
        M(0) [Pa].
    relaxation_time : float
        τ of M(t) = M(0) exp(-t/τ) [s].

    Examples
    --------
    From cycle to cycle contact begins later, on the residual indentation:

    >>> from viscontact.reference.profiles import SphereProfile
    >>> contact = ting_cycles(SphereProfile(0.01), 1e-5, 1.0, 2e9, 1.0)
    >>> [round(float(contact.touched(cycle)) - 2 * cycle, 3) for cycle in (1, 2)]
    [0.51, 0.673]
    """

    profile: GrowingProfile
    peak: float
    rise: float
    modulus: float
    relaxation_time: float

    def approach(self, t: ArrayLike) -> Values:
        """Approach at time t, from 0 to the peak and back [m].

        Parameters
        ----------
        t : array_like
            Time, 0 or later [s].

        Returns
        -------
        float or ndarray
            Approach [m].
        """
        share = np.mod(real_array("t", t, "s") / self.rise, 2.0)
        approach: Values = self.peak * np.minimum(share, 2 - share)
        return approach

    def touched(self, cycle: int) -> float:
        """Instant when contact is made in a cycle, counted from 0 [s].

        Parameters
        ----------
        cycle : int
            The cycle.

        Returns
        -------
        float
            The instant [s].
        """
        return float(self._span(np.zeros(1), cycle)[0][0])

    def lost(self, cycle: int) -> float:
        """Instant when contact is lost in a cycle, counted from 0 [s].

        Parameters
        ----------
        cycle : int
            The cycle.

        Returns
        -------
        float
            The instant [s].
        """
        return float(self._span(np.zeros(1), cycle)[1][0])

    def _contact_radius(self, t: Floats) -> Floats:
        return np.array([self._edge(float(now)) for now in t])

    def _force(self, t: Floats) -> Floats:
        # 2 integral of χ(s) over 0 < s < a
        return np.array([self._force_at(float(now)) for now in t])

    def _force_at(self, now: float) -> float:
        half = self._edge(now) / 2
        return float(2 * half * (self._chi(half * (1 + _GAUSS), now) @ _WEIGHTS))

    def _span(self, s: Floats, cycle: int) -> tuple[Floats, Floats]:
        """Instants of contact and loss of contact at the radius s in a cycle [s]."""
        b = self.rise
        touched = b * self.profile.depth(s) / self.peak
        lost = self._separation_times(touched, 0)
        for k in range(1, cycle + 1):
            touched = 4 * k * b - lost  # contact begins at the approach at which it was lost
            lost = self._separation_times(touched, k)
        return touched, lost

    def _separation_times(self, touched: Floats, cycle: int) -> Floats:
        """Instants of loss of contact at radii in contact in a cycle [s]."""
        tau, top = self.relaxation_time, (2 * cycle + 1) * self.rise
        lost: Floats = top + tau * np.log(2 - np.exp((touched - top) / tau))
        return lost

    def _chi(self, s: Floats, now: float) -> Floats:
        """Transformed pressure at radii in contact [N/m]."""
        tau, b = self.relaxation_time, self.rise
        cycle = int(now // (2 * b))
        turn = min(now, (2 * cycle + 1) * b)
        touched, _ = self._span(s, cycle)
        way_in = -np.exp((turn - now) / tau) * np.expm1((touched - turn) / tau)
        loads: Floats = self.modulus * tau * self.peak / b * (way_in + np.expm1((turn - now) / tau))
        return loads

    def _edge(self, now: float) -> float:
        """Radius of the contact [m]."""
        cycle = int(now // (2 * self.rise))
        rising = now <= (2 * cycle + 1) * self.rise

        def inside(s: float) -> float:
            touched, lost = self._span(np.array([s]), cycle)
            return float(now - touched[0] if rising else lost[0] - now)

        largest = float(self.profile.reach(np.array(self.peak)))
        if inside(0.0) <= 0:
            return 0.0
        if inside(largest) >= 0:
            return largest
        return float(brentq(inside, 0.0, largest, xtol=1e-300))


def ting_cycles(
    profile: GrowingProfile, peak: float, rise: float, modulus: float, relaxation_time: float
) -> TingCycles:
    """Contact of a sphere or cone moved cyclically into a Maxwell body at constant speed.

    Parameters
    ----------
    profile : SphereProfile or ConeProfile
        The indenter.
    peak : float
        Largest approach [m].
    rise : float
        Duration of each loading, and of each unloading [s].
    modulus : float
        M(0), the instantaneous contact modulus, 1/J(0) [Pa].
    relaxation_time : float
        τ of M(t) = M(0) exp(-t/τ) [s].

    Returns
    -------
    TingCycles
        Force, contact radius and the instants of contact made and lost.

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Notes
    -----
    An unloaded Maxwell body keeps its shape: a radius s of `press_axisymmetric` is touched again
    at the approach it was lost at. Between, χ = integral of M(t - t') dw(t') from when it was
    touched, so in cycle k, with the peak at b_k, it is lost at
    τ ln(2 exp(b_k/τ) - exp(touched/τ)).

    References
    ----------
    T. C. T. Ting, J. Appl. Mech. 33 (1966) 845-854, for the first cycle; T. C. T. Ting, J. Appl.
    Mech. 35 (1968) 248-254, for contacts made and lost repeatedly. The recursion is in the Notes.

    Examples
    --------
    >>> from viscontact.reference.profiles import SphereProfile
    >>> contact = ting_cycles(SphereProfile(0.01), 1e-5, 1.0, 2e9, 1.0)
    >>> print(f"lost {contact.lost(0):.5f} s, touched again {contact.touched(1):.5f} s")
    lost 1.48988 s, touched again 2.51012 s
    """
    require_positive("m", peak=peak)
    require_positive("s", rise=rise, relaxation_time=relaxation_time)
    require_positive("Pa", modulus=modulus)
    return TingCycles(profile, peak, rise, modulus, relaxation_time)
