"""Load history of mixed control: the force on some segments, the approach on others."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.loads.arguments import numbers
from viscontact.loads.history import Control, LoadHistory, LoadPoint
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import finite, store


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
    tilt_x, tilt_y : float or None
        Slopes along x and y throughout; None lets that tilt go free [rad].
    events : sequence of str
        What ended the segments of the `LoadProgram` that this was, and when.

    Raises
    ------
    ValueError
        If the numbers do not fit together, the times do not increase from 0, a force is negative,
        or the load jumps.

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
    tilt_x: float | None = field(default=0.0, metadata={"unit": "rad"})
    tilt_y: float | None = field(default=0.0, metadata={"unit": "rad"})
    events: Sequence[str] = field(default=(), metadata={"recorded": "if given"})

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
            events=tuple(self.events),
        )
        count = len(times) - 1
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
        self._refuse_jumps()

    def _refuse_jumps(self) -> None:
        before: tuple[Control, float] = (self.controls[0], 0.0)
        for time, control, begin, end in zip(
            self.times, self.controls, self.begins, self.ends, strict=False
        ):
            if control == "force" and min(begin, end) < 0:
                lowest = format_quantity(min(begin, end), "N", 6)
                raise ValueError(f"force must be zero or more, got {lowest}")
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
            eccentricity_x=0.0,
            eccentricity_y=0.0,
            tilt_x=self.tilt_x,
            tilt_y=self.tilt_y,
            approach=level if control == "approach" else None,
        )

    def level_of(self, point: LoadPoint) -> float:
        """Return a load as a share of the largest force or approach [-]."""
        control: Control = "approach" if point.force is None else "force"
        share: float = point.level / self._largest(control)
        return share

    def level_at(self, times: ArrayLike, *, side: str = "right") -> NDArray[np.float64]:
        """Return the force or approach at many instants [s], as a share of its largest one [-]."""
        instants = numbers("times", times, "s")
        shares = [
            level / self._largest(control) for control, level in map(self._level, instants.flat)
        ]
        return np.array(shares, dtype=np.float64).reshape(instants.shape)

    @property
    def largest_level(self) -> float:
        """Largest share: 1, or 0 if there is no load at all."""
        return max(0.0, float(self.level_at(self.times).max()))

    @property
    def kinks(self) -> NDArray[np.float64]:
        """Begin of the first segment, and ends of all [s]."""
        return np.array(self.times)

    @property
    def jumps(self) -> NDArray[np.float64]:
        """Nothing jumps [s]."""
        return np.zeros(0)

    def _level(self, time: float) -> tuple[Control, float]:
        """Control and its force [N] or approach [m]; at the end of a segment those of it."""
        k = min(bisect_left(self.times, time, lo=1), len(self.controls)) - 1
        begin, end = self.times[k], self.times[k + 1]
        # Counted from the end, so that its value comes out exactly.
        left = float(min(max((end - time) / (end - begin), 0.0), 1.0))
        return self.controls[k], self.ends[k] - (self.ends[k] - self.begins[k]) * left

    def _largest(self, control: Control) -> float:
        of = zip(self.controls, self.begins, self.ends, strict=True)
        largest: float = max((max(b, e) for each, b, e in of if each == control), default=0.0)
        return largest if largest > 0 else 1.0
