"""Axisymmetric contact as independent rods: the elastic problem of one time step.

In the transform of `AxisymmetricContact` the half-space separates into independent rods, one at
each radius s: each carries χ(s), is displaced by J * dχ, and is either in contact with the
indenter or free of load.

"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.profiles import Profile


@dataclass(frozen=True)
class Rods:
    """Rods at given radii [m], whose load is linear in the depth g(s) between them."""

    # A Hertzian load is linear in g, so on an elastic body the sum over rods is exact.

    profile: Profile
    # radii s, ascending from 0 [m], shape (n,); the last is in contact under a flat punch only
    places: Floats
    depths: Floats  # g(s) [m], shape (n,)
    # weights of a load at the ends of each element in its integral over s [m], shape (n - 1,)
    near: Floats
    far: Floats

    def load(self, chi: Floats, reached: int, front: float) -> float:
        """Force of a load on the first rods, which falls to 0 at the front depth [N]."""
        if reached == 0:
            return 0.0
        if reached == len(self.places):
            return self.sum(chi)
        last = reached - 1
        inside = self.near[:last] @ chi[:last] + self.far[:last] @ chi[1:reached]
        return 2 * float(inside + chi[last] * self._front_weight(last, front))

    def sum(self, chi: Floats) -> float:
        """Twice the integral over s of a load on all rods [N]."""
        if len(self.places) == 1:  # a punch
            return 2 * self.profile.edge * float(chi[0])
        return 2 * float(self.near @ chi[:-1] + self.far @ chi[1:])

    def _front_weight(self, last: int, front: float) -> float:
        """Integral over s of a load that falls from 1 at the last rod to 0 at the front [m]."""
        begin, depth = self.places[last], float(self.depths[last])
        end = float(self.profile.reach(np.array(front)))
        if front - depth <= 1e-9 * front:
            return float(end - begin) / 2
        swept = self.profile.depth_integral(np.array([begin, end]))
        return (front * float(end - begin) - float(swept[1] - swept[0])) / (front - depth)


def placed_rods(profile: Profile, deepest: float, elements: int) -> Rods:
    """Rods for contacts up to `deepest` > 0 [m], clustered towards the largest radius."""
    # Where the approach turns smoothly the contact radius is nearly constant and the loads end like
    # a root of the distance from the largest radius, which even elements follow with a lower order.
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
class RodStep:
    """Known quantities of a time step before its final approach is found."""

    duration: float  # length, 0 for a jump [s]
    before: Floats  # load of each rod at its beginning, 0 where free [N/m], shape (n,)
    # opening between rod and indenter at its beginning, 0 in contact [m], shape (n,)
    open_before: Floats
    crept: Floats  # displacement at its end if no load changes [m], shape (n,)
    compliance: float  # mean of J over the step, which meets a load that changes evenly [1/Pa]
    within: Callable[[Floats], Floats]  # mean of J over lags from 0 to each of an array [1/Pa]
    instant: float  # J(0) [1/Pa]

    def touching(self, depths: Floats) -> float:
        """Approach at which the last rod loses contact, or the first one touches [m]."""
        return float(np.min(depths + self.crept - self.compliance * self.before))


@dataclass(frozen=True)
class RodState:
    """Rods at the end of a step, at a given approach."""

    approach: float  # [m]
    # load that keeps each rod in contact, negative for tension [N/m], shape (n,)
    wanted: Floats
    share: Floats  # of the step that a rod spent in contact, shape (n,)
    reached: int  # number of rods in contact, from the axis on
    front: float  # depth g at which the load falls to 0, the edge of the contact [m]
    force: float  # [N]

    @property
    def chi(self) -> Floats:
        """Load of each rod [N/m]."""
        return np.maximum(self.wanted, 0.0)


def solve_at_approach(rods: Rods, step: RodStep, approach: float) -> RodState:
    """Contact state of all rods at the end of a step, at a given approach [m]."""
    # Loads change evenly over the step, or over its share in contact: a rod that meets the indenter
    # within the step is loaded from there on, one whose load reaches 0 is free from there on.
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
    return RodState(approach, wanted, share, reached, front, force)


def _front(rods: Rods, step: RodStep, excess: Floats, wanted: Floats, reached: int) -> float:
    """Depth g where the load falls to 0, between the last rod in contact and the next [m]."""
    if reached in (0, len(wanted)):
        return float(rods.depths[-1]) if reached else 0.0
    last, begin, end = reached - 1, rods.depths[reached - 1], rods.depths[reached]
    if step.instant > 0:
        return float(begin + (end - begin) * wanted[last] / (wanted[last] - wanted[reached]))
    # Without instant compliance the load of a free rod does not determine its opening, which
    # falls to 0 towards the front.
    beyond = min(reached + 1, len(excess) - 1)
    slope = 1.0
    if beyond > reached:
        slope = (excess[reached] - excess[beyond]) / (rods.depths[beyond] - end)
    front = end + excess[reached] / slope if slope > 0 else end
    return float(np.clip(front, begin, end))


def solve_at_force(rods: Rods, step: RodStep, force: float, guess: float) -> RodState:
    """Contact state in which the rods carry a force >= 0 [N]; at 0 N they are about to touch."""
    # The force grows with the approach, by 2 a over the compliance: a Newton step with that slope,
    # then the secant method, bracketed.
    low = step.touching(rods.depths)
    high = np.inf if np.isfinite(rods.profile.edge) else max(low, float(rods.depths[-1]))
    if force == 0:
        parted = solve_at_approach(rods, step, low)
        # Without rounding residuals on the last rod in contact.
        return replace(
            parted, wanted=np.minimum(parted.wanted, 0.0), reached=0, front=0.0, force=0.0
        )
    state, last = solve_at_approach(rods, step, min(max(guess, low), high)), None
    for _ in range(100):
        short = force - state.force
        if abs(short) <= 1e-13 * force or 0 <= high - low <= 4e-16 * abs(low):
            break
        low, high = (state.approach, high) if short > 0 else (low, state.approach)
        slope = _slope(rods, step, state, last)
        onward = state.approach + short / slope if slope > 0 else high
        if not low < onward < high:
            onward = (low + high) / 2
        last, state = state, solve_at_approach(rods, step, onward)
    return state


def _slope(rods: Rods, step: RodStep, state: RodState, last: RodState | None) -> float:
    """Estimate of dF/dw, by the secant where two states are in contact [N/m]."""
    if last is not None and last.force > 0 and state.force != last.force:
        return (state.force - last.force) / (state.approach - last.approach)
    front = float(rods.profile.reach(np.array(state.front)))
    return 2 * front / step.compliance
