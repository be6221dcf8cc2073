"""Load programs on round bodies: events, and what follows them.

Truth: the rods of `rod_solution`. The stage moves until a force is reached, holds the height or the
force, and retracts until contact is lost; the approach under a held force is that of the rods.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import PchipInterpolator

import viscontact as vc
from verification.families.creep_curves import Creep, random_creep
from verification.families.exact_run import ExactRun, NotDrawnError
from verification.families.rod_solution import RodSolution
from verification.families.round_bodies import cells_across, contact_size, grid_around
from verification.families.round_profiles import (
    RoundBody,
    paraboloid,
    power_body,
    quartic_ball,
    sphere,
)
from viscontact import reference

Array = np.ndarray

#: Steps of the rods in each part of the program, and elements up to the largest radius.
STEPS, ELEMENTS = 160, 400


@dataclass(frozen=True, eq=False)
class Course:
    """A body that is moved until a force is reached, held, and retracted."""

    body: RoundBody
    creep: Creep
    rate: float  # [m/s]
    force: float  # [N]
    held: str  # "height" or "force"
    length: float  # of the hold [s]
    back: float  # rate of the retraction [m/s]
    longest: float  # time in which the force is reached [s]

    def rods(self, times: Array, **load: Array) -> reference.AxisymmetricContact:
        """Solution by rods; NotDrawnError where the contact becomes a ring."""
        try:
            return reference.press_axisymmetric(
                self.body.profile,
                times,
                creep_compliance=self.creep.compliance,
                elements=ELEMENTS,
                **load,
            )
        except ValueError as error:
            raise NotDrawnError(str(error)) from error

    @cached_property
    def reached(self) -> float:
        """Instant at which the force is reached [s]."""
        found, end = 0.0, self.longest
        for _ in range(2):  # the second time with steps that end there
            times = reference.clustered_times([0.0, end], 2 * STEPS)
            force = self.rods(times, approach=self.rate * times).force
            found = float(PchipInterpolator(force, times)(self.force))
            end = 1.02 * found
        return found

    def approach_at(self, times: Array) -> Array:
        """Approach of the stage without a limit to its retraction [m]."""
        begin, end = self.reached, self.reached + self.length
        rising = self.rate * np.minimum(times, begin)
        held = rising + (self._crept(np.clip(times, begin, end)) if self.held == "force" else 0.0)
        return held - self.back * np.maximum(times - end, 0.0)

    @cached_property
    def _crept(self) -> PchipInterpolator:
        begin, end = self.reached, self.reached + self.length
        rise, hold = (
            reference.clustered_times(ends, 2 * STEPS) for ends in ([0.0, begin], [begin, end])
        )
        force = self.rods(rise, approach=self.rate * rise).force
        times = np.append(rise, hold[1:])
        found = self.rods(times, force=np.append(force, np.full(len(hold) - 1, force[-1])))
        return PchipInterpolator(
            hold, found.approach[len(rise) - 1 :] - found.approach[len(rise) - 1]
        )

    @cached_property
    def lost(self) -> float:
        """Instant at which contact is lost [s]."""
        begin = self.reached + self.length
        end = begin + 1.5 * float(self.approach_at(np.array([begin]))[0]) / self.back
        for _ in range(3):
            times = reference.clustered_times([0.0, self.reached, begin, end], STEPS)
            force = self.rods(times, approach=self.approach_at(times)).force
            last = int(np.flatnonzero(force > 0)[-1])
            # Towards the end the force falls as the 3/2th power of the time that is left.
            y = force[last - 3 : last + 1] ** (2 / 3)
            slope, rest = np.polyfit(times[last - 3 : last + 1], y, 1)
            end = min(-rest / slope, float(times[min(last + 1, len(times) - 1)]))
        return end

    def solution(self, times: Array) -> RodSolution:
        """Solution at any instants."""
        begin = self.reached + self.length
        corners = np.unique([0.0, self.reached, begin, max(float(times[-1]), 1.001 * begin)])
        every = np.unique(np.concatenate([reference.clustered_times(corners, STEPS), times]))
        close = np.append(False, np.diff(every) <= 1e-10 * every[-1])
        every = every[~close | np.isin(every, times)]
        found = self.rods(every, approach=self.approach_at(every))
        return RodSolution(found, np.searchsorted(every, times))


def load_program(rng: np.random.Generator) -> ExactRun:
    """Move until a force is reached, hold height or force, retract until contact is lost."""
    creep, a = random_creep(rng), contact_size(rng)
    body = (paraboloid, sphere, power_body, quartic_ball)[rng.integers(4)](rng, a)
    depth = float(body.profile.depth(np.array(a)))
    rise = creep.time * 10 ** rng.uniform(-1, 0.5)
    held = ("height", "force")[int(creep.jumps and rng.random() < 0.5)]
    course = Course(
        body,
        creep,
        depth / rise,
        0.0,
        held,
        rise * rng.uniform(0.2, 2.0),
        depth / rise * 10 ** rng.uniform(-0.5, 1.5),
        rise,
    )
    times = reference.clustered_times([0.0, rise], STEPS)
    largest = course.rods(times, approach=course.rate * times).force[-1]
    course = replace(course, force=float(largest) * rng.uniform(0.3, 0.8))
    ends = [course.reached, course.lost]
    reach = float(course.solution(np.linspace(0.0, ends[1], 40)).contact_radius.max())
    if reach > 0.9 * body.profile.largest:
        raise NotDrawnError("contact outgrows the profile")
    control = "force" if held == "force" else "approach"
    program = vc.LoadProgram(
        [
            vc.Segment(course.rate, until=vc.Condition("force", course.force)),
            vc.Segment(control=control, duration=course.length),
            vc.Segment(-course.back, until="contact is lost"),
        ]
    )
    grid = grid_around(rng, (reach, reach), cells_across(rng))
    count = round(math.exp(rng.uniform(math.log(20), math.log(80))))
    end = 1.5 * ends[1]
    times = np.unique(
        np.concatenate([np.linspace(0.0, ends[1], count + 1), np.linspace(ends[1], end, 6)])
    )

    def exact(t: Array) -> dict[str, Array]:
        return course.solution(t).scalars(peak=creep.jumps)

    name = f"{body.name}, {held} held, {creep.name}"
    return ExactRun(
        name,
        body.indenter,
        creep.material,
        program,
        grid,
        times,
        exact,
        dict(creep.more),
        events=tuple(ends),
    )
