"""Which steps a run takes: the instants asked for, and the load's kinks and jumps among them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.load import ForceHistory

#: An instant this close to a kink of the load, relative to it, is meant to be the kink.
SAME = 1e-9


@dataclass(frozen=True)
class Step:
    """One step of a run.

    Attributes
    ----------
    time : float
        Its end [s].
    duration : float
        Its length, 0 for a jump [s].
    asked : float or None
        The instant asked for that this is, to rounding the same [s]; None for an inner step.
    smooth : bool
        Whether the load goes on as before; False for the first step after a kink or jump.
    before_jump : bool
        Whether the load jumps right after it.
    """

    time: float
    duration: float
    asked: float | None
    smooth: bool
    before_jump: bool = False

    @property
    def is_jump(self) -> bool:
        """Whether the load changes at once, at an instant."""
        return self.duration == 0

    @property
    def side(self) -> str:
        """Which value of the load holds at the step's end."""
        return "left" if self.before_jump else "right"


def schedule(times: NDArray[np.float64], load: ForceHistory) -> list[Step]:
    """Steps through the instants asked for and the load's own.

    Parameters
    ----------
    times : ndarray
        Instants asked for, strictly increasing, none before 0 [s]. One that differs from a kink
        by rounding (a part in 1e9) is taken as the kink.
    load : ForceHistory
        Its kinks and jumps up to the last instant are stepped, too.

    Returns
    -------
    list of Step
        The first is a jump at time 0 (of size zero if the load starts softly); a jump later is
        two steps, up to it and across it.

    Examples
    --------
    >>> import numpy as np
    >>> from viscontact.load import ramp
    >>> [step.time for step in schedule(np.array([0.0, 2.0]), ramp(1.0, 0.5))]
    [0.0, 0.5, 2.0]
    """
    kinks, jumps = set(load.kinks.tolist()), set(load.jumps.tolist())
    wanted: dict[float, float] = {}
    for time in times.tolist():
        kink = _kink_meant(time, load.kinks)
        wanted[time if kink in wanted else kink] = time
    inner = {kink for kink in kinks if kink <= max(wanted)}
    steps = [Step(0.0, 0.0, wanted.get(0.0), smooth=False)]
    for instant in sorted((wanted.keys() | inner) - {0.0}):
        begin, asked, jumping = steps[-1].time, wanted.get(instant), instant in jumps
        smooth = begin not in kinks and begin > 0
        up_to = Step(instant, instant - begin, None if jumping else asked, smooth, jumping)
        steps += [up_to, Step(instant, 0.0, asked, smooth=False)] if jumping else [up_to]
    return steps


def _kink_meant(time: float, kinks: NDArray[np.float64]) -> float:
    nearest = float(kinks[np.abs(kinks - time).argmin()])
    return nearest if abs(nearest - time) <= SAME * max(nearest, time) else time
