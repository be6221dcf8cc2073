"""Lee and Radok's viscoelastic contact of a sphere, while the contact grows.

The law enters as two callables, convolution inverses of each other: the creep compliance J(t)
[1/Pa], which stands in the place of 1/E*, and the relaxation modulus M(t) [Pa], which stands
in the place of E*.
"""

from __future__ import annotations

import functools
import itertools
import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.reference.arguments import Values, require_positive
from viscontact.reference.hereditary import (
    TimeFunction,
    accumulated,
    averaged,
    evaluate,
    superposed,
)

_PAIRS_AT_ONCE = 64  # (r, t) pairs evaluated together: some 10 MB of intermediate arrays


class GrowingLoad(Protocol):
    """A load history that never falls, as the Lee-Radok solution needs it."""

    @property
    def corners(self) -> tuple[float, ...]:
        """Instants where the load, or its rate, jumps; the first is 0 [s]."""

    def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Load at each time [N]."""

    def crept(
        self, creep_compliance: TimeFunction, times: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Integral of J(t - t') dW(t') at each time [m²]."""


@dataclass(frozen=True)
class SuddenLoad:
    """A force applied at time 0 and held.

    Attributes
    ----------
    force : float
        The force [N].
    """

    force: float
    corners = (0.0,)

    def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Load at each time, the value just after the jump at 0 [N]."""
        return np.full_like(times, self.force)

    def crept(
        self, creep_compliance: TimeFunction, times: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Integral of J(t - t') dW(t') at each time, here F J(t) [m²]."""
        return self.force * evaluate(creep_compliance, times)


@dataclass(frozen=True)
class RampedLoad:
    """A force that rises in proportion to time, then is held.

    Attributes
    ----------
    force : float
        The force that is held [N].
    duration : float
        Time of its rise [s].
    """

    force: float
    duration: float

    @property
    def corners(self) -> tuple[float, ...]:
        """Instants where the rate of loading jumps [s]."""
        return (0.0, self.duration)

    def at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Load at each time [N]."""
        load: NDArray[np.float64] = self.force * np.minimum(times / self.duration, 1.0)
        return load

    def crept(
        self, creep_compliance: TimeFunction, times: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Integral of J(t - t') dW(t') at each time: F/T times that of J over [t - T, t] [m²]."""
        mean = np.empty_like(times)
        long_held = times > 2 * self.duration
        # Long after the ramp the difference of two integrals from 0 would lose its digits.
        early = times[~long_held]
        if early.size:
            since_held = np.maximum(early - self.duration, 0.0)
            both = accumulated(creep_compliance, np.stack([early, since_held]))
            mean[~long_held] = (both[0] - both[1]) / self.duration
        mean[long_held] = averaged(
            creep_compliance, times[long_held] - self.duration, self.duration
        )
        return self.force * mean


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
        >>> contact = lee_radok_ramp(10.0, 2.0, 0.01, lambda t: 5e-10, lambda t: 2e9)
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
        >>> creep, relaxation = lambda t: (1 + t) / 2e9, lambda t: 2e9 * np.exp(-t)
        >>> contact = lee_radok_step(10.0, 0.01, creep, relaxation)
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
        >>> contact = lee_radok_step(10.0, 0.01, lambda t: 5e-10, lambda t: 2e9)
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
        p = 2/(pi R) integral of M(t - t') ds(t'), s(t') = Re sqrt(a(t')² - r²), the jump of s
        at 0 included: the hereditary integral with M(0) s(t) and M', integrated by parts.
        Relative to the peak the error is about 1e-13 for a law that is smooth on a logarithmic
        scale of time and whose M(0) is finite, 1e-10 where M grows as t**-0.5 towards 0, 1e-7
        for t**-0.8; a table with corners keeps the error of its own interpolation.

        Examples
        --------
        The pressure under a Maxwell body flows outwards: at t = 2 tau its peak leaves the axis.

        >>> creep, relaxation = lambda t: (1 + t) / 2e9, lambda t: 2e9 * np.exp(-t)
        >>> contact = lee_radok_step(10.0, 0.01, creep, relaxation)
        >>> centre, half_way = contact.pressure([0.0, 2e-4], 3.0) / 1e6
        >>> print(f"{centre:.4f} MPa, {half_way:.4f} MPa")
        8.6514 MPa, 8.9234 MPa
        """
        distance, times = np.broadcast_arrays(np.abs(np.asarray(r, np.float64)), _times(t))
        self._require_growth(times)
        pairs = np.stack([distance.ravel(), times.ravel()])
        blocks = np.array_split(pairs, range(_PAIRS_AT_ONCE, pairs.shape[1], _PAIRS_AT_ONCE), 1)
        superposed_heights = np.concatenate([self._superposed_heights(*block) for block in blocks])
        p: Values = 2 / (math.pi * self.radius) * superposed_heights.reshape(distance.shape)[()]
        return p

    def _superposed_heights(
        self, r: NDArray[np.float64], t: NDArray[np.float64]
    ) -> NDArray[np.float64]:
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

    def _heights(
        self, r: NDArray[np.float64], instants: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Give s = Re sqrt(a² - r²) at instants whose first axis goes with r."""
        a, distance = self._radius_at(instants), r.reshape(-1, *[1] * (instants.ndim - 1))
        real_part: NDArray[np.float64] = np.sqrt(np.maximum((a - distance) * (a + distance), 0.0))
        return real_part

    def _instant_reached(
        self, r: NDArray[np.float64], t: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Find the last instant before the growing contact reaches each distance r, else 0."""
        # Bisection on the logarithm of time, since the instant may lie decades before t. The
        # lower bound is given: there s is 0 exactly, while a little later it is already the
        # square root of that little.
        earliest = np.full_like(t, -60.0)
        before, after = earliest, np.zeros_like(t)
        for _ in range(50):
            middle = (before + after) / 2
            inside = self._radius_at(t * np.exp2(middle)) >= r
            before, after = np.where(inside, before, middle), np.where(inside, middle, after)
        return np.where(before > earliest, t * np.exp2(before), 0.0)

    def _radius_at(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        radius: NDArray[np.float64] = np.cbrt(
            0.75 * self.radius * self.load.crept(self.creep_compliance, times)
        )
        return radius

    def _require_growth(self, times: NDArray[np.float64]) -> None:
        """Refuse a law under which the contact shrinks: the solution holds while it grows."""
        end = float(times.max(initial=0.0))
        radii = self._radius_at(end * np.append(0.0, np.geomspace(1e-12, 1.0, 241)))
        if not np.all(np.diff(radii) >= -1e-9 * radii.max()):
            raise ValueError(
                f"creep_compliance: the contact it gives shrinks before t = {end:.6g} s, but the "
                "solution holds only while the contact grows; wanted a compliance J(t) that "
                "never falls (has J been exchanged with M?)"
            )


def lee_radok_step(
    force: float,
    radius: float,
    creep_compliance: TimeFunction,
    relaxation_modulus: TimeFunction,
) -> LeeRadokContact:
    """Contact of a sphere with a viscoelastic half-space under a force applied at once and held.

    Parameters
    ----------
    force : float
        Load from time 0 on, positive into the half-space [N].
    radius : float
        Radius of the sphere [m].
    creep_compliance : callable
        Contact compliance J(t), taking an array of times [s], giving [1/Pa]; (1 - nu) Phi(t)
        for a constant Poisson's ratio. J(0) > 0, since the load jumps.
    relaxation_modulus : callable
        M(t), its convolution inverse, s² L[J] L[M] = 1, so that J(0) M(0) = 1 [Pa].

    Returns
    -------
    LeeRadokContact
        Contact radius, approach and pressure by radius and time.

    Raises
    ------
    ValueError
        If force or radius is not positive and finite, or J and M do not fit each other at 0.

    Notes
    -----
    a³ = (3 R/4) F J(t); p by `LeeRadokContact.pressure`.

    References
    ----------
    E. H. Lee and J. R. M. Radok, J. Appl. Mech. 27 (1960) 438-444.

    Examples
    --------
    >>> creep, relaxation = lambda t: (1 + t / 60) / 2e9, lambda t: 2e9 * np.exp(-t / 60)
    >>> contact = lee_radok_step(10.0, 0.01, creep, relaxation)
    >>> print(f"{contact.pressure(0.0, 60.0) / 1e6:.4f} MPa")
    22.4222 MPa
    """
    require_positive("N", force=force)
    require_positive("m", radius=radius)
    instant = _require_inverse(creep_compliance, relaxation_modulus)
    if instant == 0:
        raise ValueError(
            "creep_compliance: wanted J(0) > 0 under a sudden load, got 0; use lee_radok_ramp"
        )
    return LeeRadokContact(SuddenLoad(force), radius, creep_compliance, relaxation_modulus)


def lee_radok_ramp(
    force: float,
    duration: float,
    radius: float,
    creep_compliance: TimeFunction,
    relaxation_modulus: TimeFunction,
) -> LeeRadokContact:
    """Contact of a sphere with a viscoelastic half-space under a ramped, then held force.

    Parameters
    ----------
    force : float
        Load held after the ramp, positive into the half-space [N].
    duration : float
        Time of the rise from zero [s].
    radius : float
        Radius of the sphere [m].
    creep_compliance : callable
        Contact compliance J(t), taking an array of times [s], giving [1/Pa]; J(0) may be 0.
    relaxation_modulus : callable
        M(t), its convolution inverse, s² L[J] L[M] = 1; where J(0) = 0 it must grow without
        bound towards t = 0, and integrably [Pa].

    Returns
    -------
    LeeRadokContact
        Contact radius, approach and pressure by radius and time.

    Raises
    ------
    ValueError
        If force, duration or radius is not positive and finite, or J and M do not fit each
        other at 0 (a Kelvin-Voigt body's M holds an impulse that no callable can give).

    Notes
    -----
    a³ = (3 R F/(4 T)) integral of J over [max(t - T, 0), t].

    References
    ----------
    E. H. Lee and J. R. M. Radok, J. Appl. Mech. 27 (1960) 438-444.

    Examples
    --------
    >>> creep, relaxation = lambda t: (1 + t / 60) / 2e9, lambda t: 2e9 * np.exp(-t / 60)
    >>> contact = lee_radok_ramp(10.0, 30.0, 0.01, creep, relaxation)
    >>> print(f"{contact.contact_radius(30.0) * 1e3:.6f} mm")
    0.360562 mm
    """
    require_positive("N", force=force)
    require_positive("s", duration=duration)
    require_positive("m", radius=radius)
    _require_inverse(creep_compliance, relaxation_modulus)
    load = RampedLoad(force, duration)
    return LeeRadokContact(load, radius, creep_compliance, relaxation_modulus)


def _times(t: ArrayLike) -> NDArray[np.float64]:
    times = np.asarray(t, dtype=np.float64)
    wrong = times[~(np.isfinite(times) & (times >= 0))]
    if wrong.size:
        raise ValueError(f"t: wanted finite times of at least 0 s, got {wrong.flat[0]!r}")
    return times


def _require_inverse(creep_compliance: TimeFunction, relaxation_modulus: TimeFunction) -> float:
    """Refuse J and M that do not fit each other at time 0; give J(0)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        instant = float(evaluate(creep_compliance, 0.0))
        modulus = float(evaluate(relaxation_modulus, 0.0))
    if instant == 0 and math.isfinite(modulus):
        raise ValueError(
            f"relaxation_modulus: wanted M(0) infinite where J(0) = 0, got {modulus!r} Pa; a "
            "dashpot beside the springs gives M an impulse, which this solution cannot take"
        )
    if instant != 0 and not math.isclose(instant * modulus, 1.0, rel_tol=1e-6):
        raise ValueError(
            f"relaxation_modulus: wanted M(0) = 1/J(0), got J(0) M(0) = {instant * modulus!r}; "
            "give the convolution inverse of the creep compliance (2 G is that of Phi)"
        )
    return instant
