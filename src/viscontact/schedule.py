"""Which steps a run takes: the instants asked for, and the load's kinks and jumps between."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.load import ForceHistory


@dataclass(frozen=True)
class Step:
    """One step of a run.

    Attributes
    ----------
    time : float
        Its end [s].
    duration : float
        Its length, 0 for a jump [s].
    wanted : bool
        Whether the state at its end is asked for.
    smooth : bool
        Whether the load went on as before, so that the past predicts the step.
    """

    time: float
    duration: float
    wanted: bool
    smooth: bool

    @property
    def is_jump(self) -> bool:
        """Whether the load changes at once, at an instant."""
        return self.duration == 0

    @property
    def side(self) -> str:
        """Which value of the load holds at the step's end."""
        return "right" if self.is_jump else "left"


def schedule(times: NDArray[np.float64], load: ForceHistory) -> list[Step]:
    """Steps through the instants asked for and the load's own.

    Parameters
    ----------
    times : ndarray
        Instants asked for, strictly increasing, none before 0 [s].
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
    wanted = set(times.tolist())
    kinks = {float(kink) for kink in load.kinks if kink <= times[-1]}
    jumps = {float(jump) for jump in load.jumps}
    steps = [Step(0.0, 0.0, 0.0 in wanted, smooth=False)]
    for instant in sorted((wanted | kinks) - {0.0}):
        before = steps[-1]
        smooth = before.time not in kinks and before.time > 0
        jumping = instant in jumps
        duration = instant - before.time
        steps.append(Step(instant, duration, instant in wanted and not jumping, smooth))
        if jumping:
            steps.append(Step(instant, 0.0, instant in wanted, smooth=False))
    return steps
