"""Course of a load program: the segments that have been carried out, and the one that follows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from viscontact.bodies.loads import Condition, LoadProgram, MixedHistory, Segment
from viscontact.bodies.loads.history import Control
from viscontact.bodies.loads.mixed import STOP
from viscontact.bodies.loads.program_sentences import SLIDING
from viscontact.mechanics.state import ContactState, Outcome
from viscontact.units.formatting import format_quantity

#: Part of a force, or of a duration, that is rounding.
ROUNDING = 1e-12


class EventError(ValueError):
    """A condition of a load program that is not met."""


class ProgramCourse:
    """Part of a program that has been carried out, up to the `latest` end [s], and what follows."""

    # `lengths` are longest durations of the segments in place of those of the program [s].
    def __init__(
        self,
        program: LoadProgram,
        latest: float,
        lengths: Sequence[float] | None = None,
        *,
        may_pull: bool = False,
    ) -> None:
        """Take a program; where bodies adhere, its forces may pull."""
        self._may_pull = may_pull
        self.program, self.latest, self._lengths = program, latest, lengths
        self.times: list[float] = [0.0]
        self.controls: list[Control] = []
        self.stopped = False
        self._begins: list[float] = []
        self._ends: list[float] = []
        self._ended_by: list[str] = []
        self._begin = 0.0

    @property
    def is_over(self) -> bool:
        """True after the last segment, a stop, or the latest end."""
        segments = self.program.segments if self._lengths is None else self._lengths
        done = len(self.controls) == len(segments)
        return done or self.stopped or self.times[-1] >= self.latest

    @property
    def begin(self) -> float:
        """Begin of the segment that follows [s]."""
        return self.times[-1]

    @property
    def segment(self) -> Segment:
        """The segment that follows."""
        return self.program.parts[len(self.controls)]

    @property
    def planned_end(self) -> float:
        """End of the segment that follows, if no condition is met before [s]."""
        duration = self.segment.duration
        if self._lengths is not None:
            duration = self._lengths[len(self.controls)]
        end = self.latest if duration is None else min(self.begin + duration, self.latest)
        return min(end, self.begin + self._way_to_zero)

    @property
    def _way_to_zero(self) -> float:
        """Duration after which a force that the segment reduces is zero; inf for others [s]."""
        rate = self.segment.rate
        if self._may_pull:
            return math.inf
        return self._begin / -rate if self.segment.control == "force" and rate < 0 else math.inf

    def refuse_pull(self) -> None:
        """Refuse a segment that would reduce the force below zero; EventError."""
        duration, way = self.segment.duration, self._way_to_zero
        if way == 0 or (duration is not None and way < duration * (1 - ROUNDING)):
            raise EventError(
                f"load: segment {len(self.controls) + 1}, '{self.segment}': the force is zero "
                f"after {format_quantity(way, 's', 6)} of it, and a negative force needs adhesion; "
                "end it with 'until contact is lost'"
            )

    @property
    def conditions(self) -> list[Condition]:
        """Conditions that end the segment that follows; the first is its own, if it has one."""
        own = self.segment.until
        return [each for each in (own, *self.program.stop) if isinstance(each, Condition)]

    def history(self) -> MixedHistory:
        """History so far, with the segment that follows up to its planned end."""
        times, controls = list(self.times), list(self.controls)
        begins, ends, ended_by = list(self._begins), list(self._ends), list(self._ended_by)
        if not self.is_over:
            end = self.planned_end
            times.append(end)
            controls.append(self.segment.control)
            begins.append(self._begin)
            ends.append(self._level(end))
            ended_by.append("")
        program = self.program
        places = program.eccentricity_x, program.eccentricity_y
        tilts = program.tilt_x, program.tilt_y
        return MixedHistory(times, controls, begins, ends, *places, *tilts, program, ended_by)

    def _level(self, time: float) -> float:
        level = self._begin + self.segment.rate * (time - self.begin)
        if self.segment.control == "approach":
            return level
        least = ROUNDING * abs(self._begin)
        if not self._may_pull:
            return level if level > least else 0.0
        return level if abs(level) > least else 0.0

    def finish(self, state: ContactState, met: Condition | None) -> None:
        """End the segment at a state, where a condition was met, or none."""
        segment = self.segment
        on_spring = state.stage_position is not None
        approach = state.stage_position if on_spring else state.approach
        values: dict[str, float] = {"force": state.force, "approach": approach or 0.0}
        values[segment.control] = self._level(state.time)
        ended_by = ""
        if met is not None:
            self.stopped = met is not segment.until
            ended_by = f"{STOP}{met}" if self.stopped else str(met)
            # A stage is not where the body is.
            if met.scalar in values and not (on_spring and met.scalar == "approach"):
                values[met.scalar] = met.value
        self.times.append(state.time)
        self.controls.append(segment.control)
        self._begins.append(self._begin)
        self._ends.append(values[segment.control])
        self._ended_by.append(ended_by)
        if not self.is_over:
            self._begin = values[self.segment.control]

    def end_with(self, state: ContactState) -> None:
        """End the program with its present segment, whose force has pulled the bodies apart."""
        self.finish(replace(state, time=self.planned_end), None)
        self.stopped = True


def never_happens(course: ProgramCourse, states: Sequence[ContactState]) -> str:
    """Message about the segment that follows, whose condition is not met at any of its states."""
    segment, number = course.segment, len(course.controls) + 1
    condition = segment.until
    assert isinstance(condition, Condition)
    return (
        f"load: segment {number}, '{segment}': this does not happen by the latest end at "
        f"{format_quantity(course.latest, 's', 6)}, {_nearest(condition, states)}; give a later "
        "end, or change the program"
    )


def _nearest(condition: Condition, states: Sequence[ContactState]) -> str:
    """Text on the closest approach of the states to a condition."""
    if condition.scalar == "contact":
        nearest = min(states, key=lambda state: state.force)
        now, name, unit = nearest.force, "force", "N"
        if all(state.outcome is Outcome.NO_CONTACT for state in states):
            return "as the segment begins without contact"
    else:
        sliding = condition.scalar == SLIDING
        name, unit = "slip_fraction" if sliding else condition.scalar, condition.unit
        wanted = 1.0 if sliding else condition.value
        nearest = min(states, key=lambda state: abs(getattr(state, name) - wanted))
        now = float(getattr(nearest, name))
    at = format_quantity(nearest.time, "s", 6)
    return f"{name} comes closest at {at} with {format_quantity(now, unit)}"
