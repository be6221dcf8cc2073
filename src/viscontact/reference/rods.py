"""An axisymmetric contact as independent rods: one elastic step of the viscoelastic march.

In the transform of `AxisymmetricContact` the half-space falls apart into rods, one at each
radius s, which do not know of each other: each is pressed by χ(s), gives way by J * dχ,
and is either in touch with the indenter or free of load.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.reference.profiles import Profile

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rods:
    """Rods at given radii, whose load is linear in the depth g(s) between them.

    A Hertzian load is linear in g, so on an elastic body the sum over rods is exact.

    Attributes
    ----------
    profile : Profile
        The indenter.
    places : ndarray, shape (n,)
        Radii s, ascending from 0; the last is never reached, but for a punch's single one [m].
    depths : ndarray, shape (n,)
        g(s) [m].
    near, far : ndarray, shape (n - 1,)
        Weights of a load at the inner and outer end of each element in its integral over s [m].
    """

    profile: Profile
    places: Array
    depths: Array
    near: Array
    far: Array

    def load(self, chi: Array, reached: int, front: float) -> float:
        """Force of a load on the first rods, which falls to 0 at the front depth [N]."""
        if reached == 0:
            return 0.0
        if reached == len(self.places):
            return self.sum(chi)
        last = reached - 1
        inside = self.near[:last] @ chi[:last] + self.far[:last] @ chi[1:reached]
        return 2 * float(inside + chi[last] * self._front_weight(last, front))

    def sum(self, chi: Array) -> float:
        """Twice the integral over s of a load on all rods [N]."""
        if len(self.places) == 1:  # a punch
            return 2 * self.profile.edge * float(chi[0])
        return 2 * float(self.near @ chi[:-1] + self.far @ chi[1:])

    def _front_weight(self, last: int, front: float) -> float:
        """Integral over s of what is 1 at the last rod in contact and 0 at the front."""
        begin, depth = self.places[last], float(self.depths[last])
        end = float(self.profile.reach(np.array(front)))
        if front - depth <= 1e-9 * front:
            return float(end - begin) / 2
        swept = self.profile.depth_integral(np.array([begin, end]))
        return (front * float(end - begin) - float(swept[1] - swept[0])) / (front - depth)


def placed_rods(profile: Profile, deepest: float, elements: int) -> Rods:
    """Place rods on the radii an approach can reach, closer and closer towards the last.

    Parameters
    ----------
    profile : Profile
        The indenter.
    deepest : float
        The approach, above 0 [m].
    elements : int
        Elements between the rods.

    Returns
    -------
    Rods
        One rod more than elements; a single one for a punch, under which all do the same.

    Notes
    -----
    Where the approach turns smoothly the contact dwells: the loads end like a root of the
    distance from its largest radius, which even elements would follow with a lower order.

    Examples
    --------
    >>> from viscontact.reference.profiles import SphereProfile
    >>> placed_rods(SphereProfile(1.0), 0.04, 2).places.round(12).tolist()
    [0.0, 0.15, 0.2]
    """
    if np.isfinite(profile.edge):
        none = np.zeros(0)
        return Rods(profile, np.array([profile.edge]), np.zeros(1), none, none)
    x = np.arange(elements + 1) / elements
    places = float(profile.reach(np.array(deepest))) * x * (2 - x)
    depths = profile.depth(places)
    lengths = np.diff(places)
    far = (np.diff(profile.depth_integral(places)) - depths[:-1] * lengths) / np.diff(depths)
    return Rods(profile, places, depths, lengths - far, far)


@dataclass(frozen=True)
class Step:
    """What is known of a step in time before the approach at its end.

    Attributes
    ----------
    duration : float
        Its length, 0 for a jump [s].
    before : ndarray, shape (n,)
        Load of each rod at its beginning, 0 where free [N/m].
    open_before : ndarray, shape (n,)
        Opening between rod and indenter at its beginning, 0 in contact [m].
    crept : ndarray, shape (n,)
        Displacement at its end if no load changes [m].
    compliance : float
        Mean of J over the step, which meets a load that changes evenly [1/Pa].
    within : callable
        Mean of J over lags from 0 to each of an array [1/Pa].
    instant : float
        J(0) [1/Pa].
    """

    duration: float
    before: Array
    open_before: Array
    crept: Array
    compliance: float
    within: Callable[[Array], Array]
    instant: float

    def touching(self, depths: Array) -> float:
        """Approach at which the last rod is just about to part, or the first to touch [m]."""
        return float(np.min(depths + self.crept - self.compliance * self.before))


@dataclass(frozen=True)
class Settled:
    """Rods at the end of a step, at an approach.

    Attributes
    ----------
    approach : float
        The approach [m].
    wanted : ndarray, shape (n,)
        Load that keeps each rod in contact, negative where it would have to be pulled [N/m].
    share : ndarray, shape (n,)
        Share of the step that a rod spent in contact.
    reached : int
        How many rods from the axis on are in contact.
    front : float
        Depth g at which the load falls to 0, the edge of the contact [m].
    force : float
        Force [N].
    """

    approach: float
    wanted: Array
    share: Array
    reached: int
    front: float
    force: float

    @property
    def chi(self) -> Array:
        """Load of each rod [N/m]."""
        return np.maximum(self.wanted, 0.0)


def settle(rods: Rods, step: Step, approach: float) -> Settled:
    """Find which rods are in contact at the end of a step, and their loads.

    Parameters
    ----------
    rods : Rods
        The rods.
    step : Step
        The step.
    approach : float
        Approach at its end [m].

    Returns
    -------
    Settled
        The rods at the end of the step.

    Notes
    -----
    Loads change evenly over the step, or over its share in contact: a rod that meets the
    indenter on the way is loaded from there on, one whose load reaches 0 is free from there on.
    """
    excess = approach - rods.depths - step.crept
    wanted = step.before + excess / step.compliance
    share = np.ones_like(wanted)
    free = step.before == 0
    share[free] = 0.0
    parted = ~free & (wanted <= 0)
    share[parted] = step.before[parted] / (step.before[parted] - wanted[parted])
    met = np.flatnonzero(free & (excess > 0))
    if met.size:
        share[met] = excess[met] / (step.open_before[met] + excess[met])
        wanted[met] = excess[met] / step.within(share[met] * step.duration)
    inside = wanted > 0
    reached = len(wanted) if inside.all() else int(np.argmin(inside))
    front = _front(rods, step, excess, wanted, reached)
    force = rods.load(wanted, reached, front)
    return Settled(approach, wanted, share, reached, front, force)


def _front(rods: Rods, step: Step, excess: Array, wanted: Array, reached: int) -> float:
    """Find the depth g where the load falls to 0, between the last rod in contact and the next."""
    if reached in (0, len(wanted)):
        return float(rods.depths[-1]) if reached else 0.0
    last, begin, end = reached - 1, rods.depths[reached - 1], rods.depths[reached]
    if step.instant > 0:
        return float(begin + (end - begin) * wanted[last] / (wanted[last] - wanted[reached]))
    # Without instant compliance the load a free rod would need says little of its opening; that
    # falls to 0 towards the front by itself.
    beyond = min(reached + 1, len(excess) - 1)
    slope = 1.0
    if beyond > reached:
        slope = (excess[reached] - excess[beyond]) / (rods.depths[beyond] - end)
    front = end + excess[reached] / slope if slope > 0 else end
    return float(np.clip(front, begin, end))


def settle_under(rods: Rods, step: Step, force: float, guess: float) -> Settled:
    """Find the approach at which the rods carry a force.

    Parameters
    ----------
    rods : Rods
        The rods.
    step : Step
        The step.
    force : float
        The force, 0 or more [N].
    guess : float
        Approach to begin with [m].

    Returns
    -------
    Settled
        The rods at the end of the step; under no force they are about to touch.

    Notes
    -----
    The force grows with the approach, by 2 a over the compliance: Newton's step with that slope
    first, then the secant, kept between the bounds found.
    """
    low = step.touching(rods.depths)
    high = np.inf if np.isfinite(rods.profile.edge) else max(low, float(rods.depths[-1]))
    if force == 0:
        parted = settle(rods, step, low)
        # Rounding would leave a trace of load on the rod that is about to part.
        return replace(
            parted, wanted=np.minimum(parted.wanted, 0.0), reached=0, front=0.0, force=0.0
        )
    state, last = settle(rods, step, min(max(guess, low), high)), None
    for _ in range(100):
        short = force - state.force
        if abs(short) <= 1e-13 * force or 0 <= high - low <= 4e-16 * abs(low):
            break
        low, high = (state.approach, high) if short > 0 else (low, state.approach)
        slope = _slope(rods, step, state, last)
        onward = state.approach + short / slope if slope > 0 else high
        if not low < onward < high:
            onward = (low + high) / 2
        last, state = state, settle(rods, step, onward)
    return state


def _slope(rods: Rods, step: Step, state: Settled, last: Settled | None) -> float:
    """Estimate dF/dw, by the secant where there are two states in contact."""
    if last is not None and last.force > 0 and state.force != last.force:
        return (state.force - last.force) / (state.approach - last.approach)
    front = float(rods.profile.reach(np.array(state.front)))
    return 2 * front / step.compliance
