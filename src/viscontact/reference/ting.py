"""Ting's solution for one rise and fall of the approach."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.hereditary import TimeFunction, evaluate, superposed
from viscontact.reference.profiles import ConeProfile, SphereProfile
from viscontact.reference.ting_contact import SinglePress
from viscontact.reference.values import require_positive

GrowingProfile: TypeAlias = SphereProfile | ConeProfile
"""Indenter whose contact grows with the approach."""

_HALVINGS = 50


@dataclass(frozen=True)
class TingHump(SinglePress):
    """Axisymmetric indenter pressed into a viscoelastic half-space and withdrawn.

    Made by `ting_hump`.

    Attributes
    ----------
    profile : SphereProfile or ConeProfile
        The indenter.
    approach : callable
        Approach by time [m].
    peak_time, end : float
        Instants of the largest approach, and of the last one known [s].
    relaxation_modulus : callable
        M(t) [Pa].
    """

    profile: GrowingProfile
    approach: Callable[[Floats], Floats]
    peak_time: float
    end: float
    relaxation_modulus: TimeFunction

    def _earlier_instants(self, t: Floats) -> Floats:
        # Integral of M(t - t') dw(t') from t_1 to t = 0 (Ting 1966).
        low, high = np.zeros_like(t), np.minimum(t, self.peak_time)
        out = t > self.peak_time
        now, a, b = t[out], low[out], high[out]
        for _ in range(_HALVINGS):
            middle = (a + b) / 2
            pressed = self._path_load(middle, now) > 0  # in contact since then
            a, b = np.where(pressed, middle, a), np.where(pressed, b, middle)
        high[out] = np.where(a > 0, (a + b) / 2, 0.0)
        return high

    def _contact_radius(self, t: Floats) -> Floats:
        earlier = self._earlier_instants(t)
        radius = self.profile.reach(np.maximum(self._radius_at(earlier), 0.0))
        return np.where(earlier > 0, radius, 0.0)

    def _force(self, t: Floats) -> Floats:
        # 2 integral of M(t - t') a(t') dw(t') from 0 to t_1 (Ting 1966)
        earlier, force = self._earlier_instants(t), np.zeros_like(t)
        pressed = earlier > 0
        start = np.zeros(int(pressed.sum()))
        force[pressed] = 2 * superposed(
            self.relaxation_modulus, self._swept_area, start, earlier[pressed], t[pressed]
        )
        return force

    @property
    def lost(self) -> float:
        """Instant when contact is lost, infinite if it is not until the end [s]."""
        if self._path_load(np.zeros(1), np.array([self.end]))[0] > 0:
            return math.inf
        low, high = self.peak_time, self.end
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            held = self._path_load(np.zeros(1), np.array([middle]))[0] > 0
            low, high = (middle, high) if held else (low, middle)
        return (low + high) / 2

    def _path_load(self, start: Floats, now: Floats) -> Floats:
        """Integral of M(now - t') dw(t') from the loading instant `start` to `now` [Pa m]."""
        peak = np.full_like(now, self.peak_time)
        way_in = superposed(self.relaxation_modulus, self._radius_at, start, peak, now)
        return way_in + superposed(self.relaxation_modulus, self._radius_at, peak, now, now)

    def _radius_at(self, instants: Floats) -> Floats:
        return evaluate(self.approach, instants)

    def _swept_area(self, instants: Floats) -> Floats:
        """Integral of a dw up to instants during loading, s g(s) less the integral of g [m²]."""
        depth = np.maximum(self._radius_at(instants), 0.0)
        s = self.profile.reach(depth)
        return s * depth - self.profile.depth_integral(s)


def ting_hump(
    profile: GrowingProfile,
    approach: Callable[[Floats], Floats],
    peak_time: float,
    end: float,
    relaxation_modulus: TimeFunction,
) -> TingHump:
    """Contact of a round indenter whose approach rises once, from 0, and falls once.

    Parameters
    ----------
    profile : SphereProfile or ConeProfile
        The indenter.
    approach : callable
        Approach by time, taking a one-dimensional array of times [s]; 0 at time 0, smooth but
        at its peak [m].
    peak_time, end : float
        Instants of its peak and of its end [s].
    relaxation_modulus : callable
        M(t), the convolution inverse of the contact compliance [Pa].

    Returns
    -------
    TingHump
        Force, contact radius and the instant of lost contact.

    Raises
    ------
    ValueError
        If the instants are not in order, or the approach does not begin at 0 and rise.

    Notes
    -----
    Good to about 1e-10, by quadrature and bisection.

    References
    ----------
    T. C. T. Ting, J. Appl. Mech. 33 (1966) 845-854.

    Examples
    --------
    >>> hump = ting_hump(SphereProfile(0.01), lambda t: 1e-5 * np.sin(math.pi * t / 2) ** 2,
    ...     peak_time=1.0, end=2.0, relaxation_modulus=lambda t: 2e9 * np.exp(-t))
    >>> print(f"{hump.force(1.0):.5f} N, contact lost at {hump.lost:.5f} s")
    5.62135 N, contact lost at 1.47207 s
    """
    require_positive("s", peak_time=peak_time, end=end)
    if not peak_time < end:
        raise ValueError(f"end: wanted an instant after the peak at {peak_time!r} s, got {end!r} s")
    hump = TingHump(profile, approach, peak_time, end, relaxation_modulus)
    rising = hump._radius_at(np.linspace(0.0, peak_time, 101))
    falling = hump._radius_at(np.linspace(peak_time, end, 101))
    if (
        abs(rising[0]) > 1e-12 * rising[-1]
        or np.any(np.diff(rising) < 0)
        or np.any(np.diff(falling) > 0)
    ):
        raise ValueError(
            "approach: wanted one rise from 0 at t = 0 and one fall after peak_time, got "
            f"{rising[0]:.6g} m at 0, {rising[-1]:.6g} m at {peak_time!r} s and "
            f"{falling[-1]:.6g} m at {end!r} s; use press_axisymmetric for other histories"
        )
    return hump
