"""Load history of mixed control: the force on some segments, the approach on others."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.history import Control, LoadHistory, LoadPoint
from viscontact.bodies.loads.program import LoadProgram
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import finite, finite_array, store

#: Beginning of the text about a segment that a stop condition has ended.
STOP = "stop when "


class LoadEvent(NamedTuple):
    """Instant at which a condition of a load program was met."""

    time: float  # [s]
    segment: int  # number of the segment that ended there, from 1
    condition: str  # such as "force reaches 10 nN", or "stop when contact is lost"

    @property
    def scalar(self) -> str:
        """Scalar that the condition is on, or "contact" where this is lost."""
        return self.condition.removeprefix(STOP).partition(" ")[0]


@dataclass(frozen=True)
class MixedHistory(LoadHistory):
    """Segments in turn, each with a force or an approach that is linear in time.

    Where the control changes, the segment before gives the load of that instant, and its result
    should be the first value of the segment after. A `LoadProgram` is carried out as such a
    history. After the last segment its last value is held.

    Parameters
    ----------
    times : sequence of float
        Begin of the first segment, which is 0, and ends of all, increasing, shape (n + 1,) [s].
    controls : sequence of {"force", "approach"}
        What each segment prescribes, shape (n,).
    begins, ends : sequence of float
        Force [N] or approach [m] at begin and end of each segment, shape (n,).
    eccentricity_x, eccentricity_y : float
        Position of the force, where no segment prescribes the approach [m].
    tilt_x, tilt_y : float or None
        Slopes along x and y throughout; None lets that tilt go free [rad].
    program : LoadProgram or None
        The program that this is, or will be, the course of.
    ended_by : sequence of str
        What ended each segment of the program that has been carried out, such as "force reaches
        10 nN" or "stop when contact is lost", shape (n,); empty where its duration ended it.

    Raises
    ------
    ValueError
        If the numbers do not fit together, the times do not increase from 0, or the load
        jumps.

    Examples
    --------
    Pressed in by 1 um within 1 s, then under the 10 N that it took, for 5 s:

    >>> load = MixedHistory([0.0, 1.0, 6.0], ["approach", "force"], [0.0, 10.0], [1e-6, 10.0])
    >>> load.at(0.5).approach, load.at(1.0).approach, load.at(3.0).force
    (5e-07, 1e-06, 10.0)
    """

    control = "mixed"

    times: Sequence[float] = field(metadata={"unit": "s"})
    controls: Sequence[Control]
    begins: Sequence[float] = field(metadata={"unit": {"force": "N", "approach": "m"}})
    ends: Sequence[float] = field(metadata={"unit": {"force": "N", "approach": "m"}})
    eccentricity_x: float = field(default=0.0, metadata={"unit": "m"})
    eccentricity_y: float = field(default=0.0, metadata={"unit": "m"})
    tilt_x: float | None = field(default=0.0, metadata={"unit": "rad"})
    tilt_y: float | None = field(default=0.0, metadata={"unit": "rad"})
    program: LoadProgram | None = field(default=None, metadata={"recorded": "if given"})
    ended_by: Sequence[str] = field(default=(), metadata={"recorded": "if given"})

    def __post_init__(self) -> None:
        times = tuple(finite("times", time, "s") for time in self.times)
        begins = tuple(finite("begins", each) for each in self.begins)
        ends = tuple(finite("ends", each) for each in self.ends)
        store(
            self,
            times=times,
            controls=tuple(self.controls),
            begins=begins,
            ends=ends,
            ended_by=tuple(self.ended_by),
        )
        count = len(times) - 1
        if self.ended_by and len(self.ended_by) != count:
            raise ValueError(
                f"mixed history: wanted a text for each of the {count} segments in ended_by, got "
                f"{len(self.ended_by)}"
            )
        if count < 1 or {len(self.controls), len(begins), len(ends)} != {count}:
            raise ValueError(
                "mixed history: wanted n + 1 times and n controls, begins and ends, got "
                f"{len(times)}, {len(self.controls)}, {len(begins)} and {len(ends)}"
            )
        if times[0] != 0 or (np.diff(times) <= 0).any():
            raise ValueError(f"times must increase from 0 s, got {times!r} in s")
        for control in self.controls:
            if control not in ("force", "approach"):
                raise ValueError(f'controls must be "force" or "approach", got {control!r}')
        if "approach" in self.controls and (self.eccentricity_x or self.eccentricity_y):
            raise ValueError(
                "eccentricity_x and eccentricity_y go with a force; where a segment prescribes the "
                "approach, leave them out"
            )
        self._refuse_jumps()

    def _refuse_jumps(self) -> None:
        before: tuple[Control, float] = (self.controls[0], 0.0)
        for time, control, begin, end in zip(
            self.times, self.controls, self.begins, self.ends, strict=False
        ):
            if control == before[0] and not np.isclose(begin, before[1], rtol=1e-9, atol=0.0):
                unit = "N" if control == "force" else "m"
                raise ValueError(
                    f"mixed history: the {control} jumps at t = {format_quantity(time, 's', 6)} "
                    f"from {format_quantity(before[1], unit, 6)} to "
                    f"{format_quantity(begin, unit, 6)}; only continuous loads are taken, begin "
                    "where the one before ends"
                )
            before = (control, end)

    @property
    def awaits_events(self) -> bool:
        """True for a program that has not been carried out: nothing else is known of its course."""
        return self.program is not None and not self.ended_by

    @property
    def events(self) -> tuple[LoadEvent, ...]:
        """Events of the program that this is the course of, in their order.

        Examples
        --------
        >>> load = MixedHistory([0.0, 1.0], ["force"], [0.0], [2.0], ended_by=["force reaches 2 N"])
        >>> load.events
        (LoadEvent(time=1.0, segment=1, condition='force reaches 2 N'),)
        """
        ends = zip(self.times[1:], self.ended_by, strict=False)
        return tuple(
            LoadEvent(time, number, condition)
            for number, (time, condition) in enumerate(ends, start=1)
            if condition
        )

    @property
    def unit(self) -> str:
        """Unit of the level, a share of the largest force or approach."""
        return "1"

    def at(self, time: float, *, side: str = "right") -> LoadPoint:
        """Return the prescribed load at an instant [s]; there are no jumps, `side` means nothing.

        Examples
        --------
        >>> MixedHistory([0.0, 1.0], ["force"], [0.0], [2.0]).at(0.5).force
        1.0
        """
        control, level = self._level(finite("time", time, "s"))
        return LoadPoint(
            force=level if control == "force" else None,
            eccentricity_x=self.eccentricity_x,
            eccentricity_y=self.eccentricity_y,
            tilt_x=self.tilt_x,
            tilt_y=self.tilt_y,
            approach=level if control == "approach" else None,
        )

    def level_of(self, point: LoadPoint) -> float:
        """Return a load as a share of the largest force or approach [-]."""
        control: Control = "approach" if point.force is None else "force"
        share: float = point.level / self._maximum(control)
        return share

    def level_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the force or approach at many instants [s], as a share of its largest one [-]."""
        instants = finite_array("times", times, "s")
        shares = [
            level / self._maximum(control) for control, level in map(self._level, instants.flat)
        ]
        return np.array(shares, dtype=np.float64).reshape(instants.shape)

    @property
    def largest_level(self) -> float:
        """Largest share: 1, or 0 if there is no load at all."""
        return max(0.0, float(self.level_at(self.times).max()))

    @property
    def least_force(self) -> float:
        """Least prescribed force [N]."""
        of = zip(self.controls, self.begins, self.ends, strict=True)
        return min((min(b, e) for each, b, e in of if each == "force"), default=0.0)

    @property
    def stage_stiffness(self) -> float | None:  # type: ignore[override]
        """Stiffness of the spring of the stage of its program [N/m]; None without one."""
        return None if self.program is None else self.program.stage_stiffness

    @property
    def kinks(self) -> Floats:
        """Begin of the first segment, and ends of all [s]."""
        return np.array(self.times)

    @property
    def jumps(self) -> Floats:
        """Nothing jumps [s]."""
        return np.zeros(0)

    def _level(self, time: float) -> tuple[Control, float]:
        """Control and its force [N] or approach [m]; at the end of a segment those of it."""
        k = min(bisect_left(self.times, time, lo=1), len(self.controls)) - 1
        begin, end = self.times[k], self.times[k + 1]
        # Counted from the end, so that its value comes out exactly.
        left = float(min(max((end - time) / (end - begin), 0.0), 1.0))
        return self.controls[k], self.ends[k] - (self.ends[k] - self.begins[k]) * left

    def _maximum(self, control: Control) -> float:
        of = zip(self.controls, self.begins, self.ends, strict=True)
        largest: float = max((max(b, e) for each, b, e in of if each == control), default=0.0)
        if largest <= 0 and control == "force":  # it only pulls
            largest = -self.least_force
        return largest if largest > 0 else 1.0


def as_history(load: LoadHistory | LoadProgram) -> LoadHistory:
    """Return a load as a history: a program as one that has not been carried out."""
    if not isinstance(load, LoadProgram):
        return load
    return MixedHistory(
        *([0.0, 1.0], [load.parts[0].control], [0.0], [0.0]),
        eccentricity_x=load.eccentricity_x,
        eccentricity_y=load.eccentricity_y,
        tilt_x=load.tilt_x,
        tilt_y=load.tilt_y,
        program=load,
    )
