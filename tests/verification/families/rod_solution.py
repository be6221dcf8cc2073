"""Exact scalars of round contacts under any load, by the rods of `viscontact.reference`.

The rods are refined at every kink and jump of the load. On the drawn runs their own error is some
1e-5 of the largest values, far below the bars (`test_truths.py` checks it by doubling them).
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

import viscontact as vc
from verification.families.round_profiles import RoundProfile
from viscontact import reference
from viscontact.reference.hereditary import TimeFunction

Array = np.ndarray

#: Steps over a whole run, least steps between two kinks, elements up to the largest radius.
STEPS, FEWEST, ELEMENTS = 300, 5, 500


@dataclass(frozen=True, eq=False)
class RodSolution:
    """Scalars of a round contact at given instants; zero without contact."""

    contact: reference.AxisymmetricContact
    index: Array  # positions of the given instants among the solution's

    def of(self, name: str) -> Array:
        return np.asarray(getattr(self.contact, name))[self.index]

    @cached_property
    def contact_radius(self) -> Array:
        """Contact radius [m]; over a surface not met before it is where g is the approach."""
        contact = self.contact
        deepest = np.maximum.accumulate(contact.approach)
        grows = (contact.approach >= deepest) & (contact.contact_radius > 0)
        met = contact.profile.reach(np.maximum(contact.approach, 0.0))
        return np.asarray(np.where(grows, met, contact.contact_radius)[self.index])

    def peak_pressure(self) -> Array:
        return np.array([_peak(self.contact, int(k)) for k in self.index])

    def scalars(self, *, sharp: bool = False, peak: bool = True) -> dict[str, Array]:
        a, force = self.contact_radius, self.of("force")
        area = math.pi * a**2
        values = {
            "force": force,
            "approach": self.of("approach"),
            "contact_area": area,
            "contact_length": 2 * a,
            "contact_width": 2 * a,
            "mean_pressure": np.divide(force, area, out=np.zeros_like(a), where=area > 0),
            "work": self.of("work"),
        }
        if sharp:
            values["peak_pressure"] = np.where(a > 0, np.inf, 0.0)
        elif peak:
            values["peak_pressure"] = self.peak_pressure()
        return values


def solve_by_rods(
    profile: RoundProfile,
    load: vc.LoadHistory,
    times: Array,
    compliance: TimeFunction,
    *,
    finer: float = 1.0,
) -> RodSolution:
    """Solution at the given instants; `finer` multiplies steps and elements."""
    steps, levels = _load_points(load, np.asarray(times, dtype=float), finer)
    contact = reference.press_axisymmetric(
        profile,
        steps,
        creep_compliance=compliance,
        elements=round(ELEMENTS * finer),
        **{load.control: levels},
    )
    index = np.searchsorted(steps, times, side="right") - 1
    return RodSolution(contact, index)


def _load_points(load: vc.LoadHistory, times: Array, finer: float) -> tuple[Array, Array]:
    """Instants of the solution, and the load there; a jump has two."""
    end = float(times[-1])
    stops = load.stops[load.stops < end]
    corners = np.unique(np.concatenate([[0.0], stops, [end]]))
    if end == 0:
        return np.zeros(1), load.level_at(np.zeros(1))
    if math.isfinite(load.longest_step):
        between = round(256 * finer * end / (128 * load.longest_step))
        steps = np.linspace(0.0, end, max(between, round(STEPS * finer)))
    else:
        count = max(round(STEPS * finer / (len(corners) - 1)), round(FEWEST * finer))
        steps = reference.clustered_times(corners, count)
    steps = np.unique(np.concatenate([steps, corners, times]))
    # An instant one rounding from a kink would be a step of its own.
    close = np.append(False, np.diff(steps) <= 1e-12 * end)
    close &= ~np.isin(steps, times)
    steps = steps[~close]
    jumps = load.jumps[(load.jumps > 0) & (load.jumps <= end)]
    before = np.searchsorted(steps, jumps)
    both = np.insert(steps, before, jumps)
    levels = np.insert(load.level_at(steps), before, load.level_at(jumps, side="left"))
    return both, levels


def _peak(contact: reference.AxisymmetricContact, k: int) -> float:
    """Largest pressure over the radius, on circles."""
    a = float(contact.contact_radius[k])
    if a == 0:
        return 0.0
    chi, places = contact.transformed_pressure[k], contact.places
    inside = chi > 0
    ends = np.append(places[inside], a)
    loads = np.append(chi[inside], 0.0)
    depths = contact.profile.depth(ends)
    rises, extents = np.diff(loads), np.diff(depths)
    slopes = np.divide(rises, extents, out=np.zeros_like(rises), where=extents > 0)
    low, high, largest = 0.0, 0.99, 0.0
    for _ in range(4):  # ever closer to the largest, which may be near a rounded edge
        radii = np.linspace(low, high, 20)
        pressure = np.array(
            [-slopes @ contact.profile.pressure_weights(ends, r * a) / math.pi for r in radii]
        )
        best = int(pressure.argmax())
        largest = max(largest, float(pressure[best]))
        low, high = radii[max(best - 1, 0)], radii[min(best + 1, len(radii) - 1)]
    return largest
