"""Time stepping of an axisymmetric contact under prescribed approach or force."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import scipy

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.lag_means import LagMean
from viscontact.reference.profiles import Profile
from viscontact.reference.rod_history import RodHistory
from viscontact.reference.rods import Rods, RodState, RodStep, solve_at_approach, solve_at_force

_NO_FORCE = 1e-12  # of the largest force of the history: a smaller one counts as zero
_RING = 1e-6  # of the largest approach: a wider opening inside the contact makes it a ring


@dataclass(frozen=True)
class LoadSteps:
    """History of approach or force, divided into steps."""

    # ends of the steps [s] and the approach [m] or force [N] there; equal times are a jump
    times: Floats
    load: Floats
    by_approach: bool  # True if the load is an approach
    given: Integers  # indices of the steps that end at the given times


def load_steps(times: Floats, load: Floats, *, by_approach: bool, substeps: int) -> LoadSteps:
    """Divide the intervals of a history into equal steps; a jump is one step."""
    cuts = np.where(np.diff(times) > 0, substeps, 1)
    given = np.append(0, np.cumsum(cuts))
    place = np.arange(given[-1] + 1)
    cut_times, cut_load = np.interp(place, given, times), np.interp(place, given, load)
    if not by_approach:
        cut_load[cut_load <= _NO_FORCE * load.max()] = 0.0
    return LoadSteps(cut_times, cut_load, by_approach, given)


@dataclass(frozen=True)
class LagCompliance:
    """Means of a compliance over lags, and J(0) [1/Pa]."""

    mean: LagMean
    instant: float


@dataclass(frozen=True)
class StepEnd:
    """State at the end of a step."""

    state: RodState
    displacement: Floats  # [m], shape (rods,)
    work: float = 0.0  # work of the load over the step [J]
    # instant within the step when contact was made, or lost altogether [s]
    touched: float | None = None
    lost: float | None = None


def deepest_approach(profile: Profile, steps: LoadSteps, law: LagCompliance) -> float:
    """Upper bound of the approach over a history [m]."""
    # Under force control it is the approach of a contact that never shrinks, under a force that
    # never falls: 2 (s g(s) - integral of g) = J * dF.
    if steps.by_approach or np.isfinite(profile.edge):
        return max(float(steps.load.max()), 0.0) or 1.0
    growth = np.diff(np.maximum.accumulate(steps.load), prepend=0.0)
    now, ends = steps.times[-1], steps.times
    begins = np.append(steps.times[:1], steps.times[:-1])
    crept = float(law.mean(now - ends, now - begins) @ growth)
    if crept == 0:
        return 1.0

    def missing(logarithm: float) -> float:
        s = np.exp(logarithm)
        return float(np.log(2 * (s * profile.depth(s) - profile.depth_integral(s)) / crept))

    s = np.exp(scipy.optimize.brentq(missing, -70.0, 70.0, xtol=1e-6))
    return 1.001 * float(profile.depth(s))


class OutgrownError(Exception):
    """Contact radius beyond the last rod."""


def march(rods: Rods, steps: LoadSteps, law: LagCompliance) -> Iterator[StepEnd]:
    """Solve step by step; OutgrownError if the contact exceeds the last rod."""
    history = RodHistory(law.mean, len(rods.places), len(steps.times))
    none = np.zeros(len(rods.places))
    now, rate = StepEnd(RodState(0.0, none, none, 0, 0.0, 0.0), none), 0.0
    begin = steps.times[0]
    for end, load in zip(steps.times, steps.load, strict=True):
        before = now.state
        step = _next_step(rods, history, law, now, begin, end)
        if step.compliance == 0:
            now = StepEnd(_unchanged(rods, steps, step, before, load, end), now.displacement)
        else:
            guess = before.approach + rate * step.duration
            after = (
                solve_at_approach(rods, step, load)
                if steps.by_approach
                else (solve_at_force(rods, step, load, guess))
            )
            _require_circle(rods, steps, step, after, load, end)
            now = _record_step(rods, history, step, before, after, (begin, end))
        yield now
        if step.duration > 0:
            rate = (now.state.approach - before.approach) / step.duration
        begin = end


def _next_step(
    rods: Rods, history: RodHistory, law: LagCompliance, now: StepEnd, begin: float, end: float
) -> RodStep:
    """Known quantities of the next step."""
    before, duration = now.state, end - begin
    opening = now.displacement + rods.depths - before.approach
    return RodStep(
        duration=float(duration),
        before=before.chi,
        open_before=np.maximum(opening, 0.0),
        crept=history.displacement_at(end),
        compliance=float(law.mean(np.zeros(1), np.array([duration]))[0]),
        within=lambda lags: law.mean(np.zeros_like(lags), lags),
        instant=law.instant,
    )


def _unchanged(
    rods: Rods, steps: LoadSteps, step: RodStep, before: RodState, load: float, end: float
) -> RodState:
    """State after a jump of a body with J(0) = 0: unchanged, or refused."""
    approach = load if steps.by_approach else before.approach
    apart = before.force == 0 and approach <= step.touching(rods.depths)
    same = load == (before.approach if steps.by_approach else before.force)
    if not (same or (apart and steps.by_approach)):
        raise ValueError(
            f"creep_compliance: J(0) = 0, but the load jumps at t = {end:.6g} s; "
            "give the load a rise, or the law an instant compliance"
        )
    return replace(before, approach=approach)


def _require_circle(
    rods: Rods, steps: LoadSteps, step: RodStep, after: RodState, load: float, end: float
) -> None:
    """Refuse contact beyond the last rod, or in a ring."""
    single = len(rods.places) == 1
    if not single and not steps.by_approach and after.force < load * (1 - 1e-9):
        raise OutgrownError
    beyond = after.wanted[after.reached :]
    opening = rods.depths + step.crept - after.approach
    if np.any(beyond > 0):
        outermost = after.reached + int(np.flatnonzero(beyond > 0)[-1])
        widest = float(opening[after.reached : outermost].max())
        if widest > _RING * float(rods.depths[-1]):
            raise ValueError(
                f"times: at t = {end:.6g} s the contact is a ring, open by {widest:.3g} m within; "
                "this solution holds for full circles. Where the steps are long against the law "
                "more of them help, substeps=; else end the history before"
            )


def _record_step(
    rods: Rods,
    history: RodHistory,
    step: RodStep,
    before: RodState,
    after: RodState,
    span: tuple[float, float],
) -> StepEnd:
    """Add the step's load changes to the history; return the state at its end."""
    begin, end = span
    old, new = before.chi, after.chi
    change, whole = new - old, after.share == 1
    history.add_whole(begin, end, np.where(whole, change, 0.0))
    single = np.flatnonzero(~whole & (change != 0))
    share = after.share[single] * step.duration
    met = new[single] > 0
    starts, ends = np.where(met, end - share, begin), np.where(met, end, begin + share)
    history.add_single(single, starts, ends, change[single])
    longest = float(after.share[(old > 0) | (new > 0)].max(initial=0.0)) * step.duration
    displacement = history.displacement_at(end)
    inside = new > 0
    displacement[inside] = after.approach - rods.depths[inside]
    return StepEnd(
        after,
        displacement,
        _work(rods, before, after, step.duration),
        end - longest if not old.any() and new.any() else None,
        begin + longest if old.any() and not new.any() else None,
    )


def _work(rods: Rods, before: RodState, after: RodState, duration: float) -> float:
    """Work of the load over a step [J]."""
    advance = after.approach - before.approach
    if duration > 0:
        return (before.force + after.force) / 2 * advance
    # In a jump each rod is a spring, in contact for part of the step.
    mean = (before.chi + after.chi) / 2 * after.share
    return rods.sum(mean) * advance
