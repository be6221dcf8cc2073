"""Contact radius and pressure of a sphere on a viscoelastic half-space under growing contact."""

from __future__ import annotations

import functools
import itertools
import math

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.growing_load import GrowingLoad
from viscontact.reference.hereditary import TimeFunction, evaluate, superposed
from viscontact.reference.values import Values
from viscontact.units.numbers import real_array

_PAIRS_AT_ONCE = 64  # (r, t) pairs evaluated together: some 10 MB of intermediate arrays


@dataclass(frozen=True)
class LeeRadokContact:
    """A sphere pressed on a viscoelastic half-space by a load that never falls.

    Made by `lee_radok_step` and `lee_radok_ramp`.

    Attributes
    ----------
    load : GrowingLoad
        The load history.
    radius : float
        Radius of the sphere [m].
    creep_compliance : callable
        J(t) [1/Pa].
    relaxation_modulus : callable
        M(t) [Pa].
    """

    load: GrowingLoad
    radius: float
    creep_compliance: TimeFunction
    relaxation_modulus: TimeFunction

    def force(self, t: ArrayLike) -> Values:
        """Load at time t, positive into the half-space [N].

        Parameters
        ----------
        t : array_like
            Time since the load began [s].

        Returns
        -------
        float or ndarray
            The load [N].

        Examples
        --------
        >>> from viscontact import reference
        >>> contact = reference.lee_radok_ramp(10.0, 2.0, 0.01, lambda t: 5e-10, lambda t: 2e9)
        >>> print(f"{contact.force(1.0):.1f} N")
        5.0 N
        """
        return self.load.at(_times(t))[()]

    def contact_radius(self, t: ArrayLike) -> Values:
        """Radius of the contact circle at time t [m].

        Parameters
        ----------
        t : array_like
            Time since the load began [s].

        Returns
        -------
        float or ndarray
            a(t), a³ = (3 R/4) integral of J(t - t') dW(t') (Lee & Radok 1960) [m].

        Raises
        ------
        ValueError
            If a time is negative or not finite, or the contact shrinks before the last one.

        Examples
        --------
        >>> from viscontact import reference
        >>> creep, relaxation = lambda t: (1 + t) / 2e9, lambda t: 2e9 * np.exp(-t)
        >>> contact = reference.lee_radok_step(10.0, 0.01, creep, relaxation)
        >>> print(f"{contact.contact_radius(7.0) / contact.contact_radius(0.0):.6f}")
        2.000000
        """
        times = _times(t)
        self._require_growth(times)
        return self._radius_at(times)[()]

    def approach(self, t: ArrayLike) -> Values:
        """Approach of the bodies at time t, positive when they come closer [m].

        Parameters
        ----------
        t : array_like
            Time since the load began [s].

        Returns
        -------
        float or ndarray
            a(t)²/R [m].

        Raises
        ------
        ValueError
            If a time is negative or not finite, or the contact shrinks before the last one.

        Examples
        --------
        >>> from viscontact import reference
        >>> contact = reference.lee_radok_step(10.0, 0.01, lambda t: 5e-10, lambda t: 2e9)
        >>> print(f"{contact.approach(1.0) * 1e6:.5f} um")
        11.20351 um
        """
        approach: Values = np.square(self.contact_radius(t)) / self.radius
        return approach

    def pressure(self, r: ArrayLike, t: ArrayLike) -> Values:
        """Contact pressure at distance r and time t, positive in compression [Pa].

        Parameters
        ----------
        r : array_like
            Distance from the axis, broadcast with ``t`` [m].
        t : array_like
            Time since the load began; 0 is just after a sudden load [s].

        Returns
        -------
        float or ndarray
            The pressure, zero outside the contact [Pa].

        Raises
        ------
        ValueError
            If a time is negative or not finite, or the contact shrinks before the last one.

        Notes
        -----
        p = 2/(π R) integral of M(t - t') ds(t'), s(t') = Re sqrt(a(t')² - r²), the jump of s
        at 0 included: the hereditary integral with M(0) s(t) and M', integrated by parts.
        Relative to the peak the error is about 1e-13 for a law that is smooth on a logarithmic
        scale of time and whose M(0) is finite, 1e-10 where M grows as t**-0.5 towards 0, 1e-7
        for t**-0.8; a table with corners keeps the error of its own interpolation.

        Examples
        --------
        The pressure under a Maxwell body flows outwards: from t = 1.54 τ on its peak is off the
        axis.

        >>> from viscontact import reference
        >>> creep, relaxation = lambda t: (1 + t) / 2e9, lambda t: 2e9 * np.exp(-t)
        >>> contact = reference.lee_radok_step(10.0, 0.01, creep, relaxation)
        >>> centre, half_way = contact.pressure([0.0, 2e-4], 3.0) / 1e6
        >>> print(f"{centre:.4f} MPa, {half_way:.4f} MPa")
        8.6514 MPa, 8.9234 MPa
        """
        distance, times = np.broadcast_arrays(np.abs(real_array("r", r, "m")), _times(t))
        self._require_growth(times)
        pairs = np.stack([distance.ravel(), times.ravel()])
        blocks = np.array_split(pairs, range(_PAIRS_AT_ONCE, pairs.shape[1], _PAIRS_AT_ONCE), 1)
        superposed_heights = np.concatenate([self._superposed_heights(*block) for block in blocks])
        p: Values = 2 / (math.pi * self.radius) * superposed_heights.reshape(distance.shape)[()]
        return p

    def _superposed_heights(self, r: Floats, t: Floats) -> Floats:
        """Integrate M(t - t') ds(t') for pairs (r, t) in one-dimensional arrays."""
        at_once = self._heights(r, np.zeros_like(t))
        jumped = at_once > 0
        total = np.zeros_like(t)
        total[jumped] = at_once[jumped] * evaluate(self.relaxation_modulus, t[jumped])
        reached = self._instant_reached(r, t)
        for begin, finish in itertools.pairwise((*self.load.corners, math.inf)):
            end = np.minimum(t, finish)
            start = np.clip(reached, np.minimum(begin, end), end)
            grew = end > start
            total[grew] += superposed(
                self.relaxation_modulus,
                functools.partial(self._heights, r[grew]),
                start[grew],
                end[grew],
                now=t[grew],
            )
        return total

    def _heights(self, r: Floats, instants: Floats) -> Floats:
        """Chord s = Re sqrt(a² - r²) at times whose first axis is that of r [m]."""
        a, distance = self._radius_at(instants), r.reshape(-1, *[1] * (instants.ndim - 1))
        real_part: Floats = np.sqrt(np.maximum((a - distance) * (a + distance), 0.0))
        return real_part

    def _instant_reached(self, r: Floats, t: Floats) -> Floats:
        """Last instant before the growing contact reaches each distance r, else 0 [s]."""
        # Bisection on the logarithm of time, since the instant may be decades before t. The lower
        # bound is returned: there s is exactly 0, while it rises as a square root right after it.
        earliest = np.full_like(t, -60.0)
        before, after = earliest, np.zeros_like(t)
        for _ in range(50):
            middle = (before + after) / 2
            inside = self._radius_at(t * np.exp2(middle)) >= r
            before, after = np.where(inside, before, middle), np.where(inside, middle, after)
        return np.where(before > earliest, t * np.exp2(before), 0.0)

    def _radius_at(self, times: Floats) -> Floats:
        radius: Floats = np.cbrt(0.75 * self.radius * self.load.crept(self.creep_compliance, times))
        return radius

    def _require_growth(self, times: Floats) -> None:
        """Refuse a law under which the contact shrinks."""
        end = float(times.max(initial=0.0))
        radii = self._radius_at(end * np.append(0.0, np.geomspace(1e-12, 1.0, 241)))
        if not np.all(np.diff(radii) >= -1e-9 * radii.max()):
            raise ValueError(
                f"creep_compliance: the contact it gives shrinks before t = {end:.6g} s, but the "
                "solution holds only while the contact grows; wanted a compliance J(t) that "
                "never falls (has J been exchanged with M?)"
            )


def _times(t: ArrayLike) -> Floats:
    times = real_array("t", t, "s")
    wrong = times[~(np.isfinite(times) & (times >= 0))]
    if wrong.size:
        raise ValueError(f"t: wanted finite times of at least 0 s, got {wrong.flat[0]!r}")
    return times
