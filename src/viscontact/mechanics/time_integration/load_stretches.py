"""Stretches between the kinks of a load."""

from __future__ import annotations

import numpy as np

from viscontact.bodies.loads import LoadHistory

#: Longest steps of a curved load in one of its stretches: about a cycle.
CYCLE_STEPS = 64.0


def stretch_at(load: LoadHistory, time: float, end: float) -> float:
    """Length of the stretch between kinks of a load that a time is in, or begins, until an end [s].

    A load that is curved has kinks at long intervals, and stretches as long as its cycles.
    """
    kinks = np.append(load.kinks[load.kinks < end], end)
    after = int(np.searchsorted(kinks, time, side="right"))
    begin = float(kinks[after - 1]) if after else 0.0
    stretch = float(kinks[min(after, len(kinks) - 1)]) - begin if time < end else end
    return min(stretch or end, CYCLE_STEPS * load.longest_step)
