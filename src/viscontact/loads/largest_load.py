"""Largest load of a history, and when it acts."""

from __future__ import annotations

import math

import numpy as np

from viscontact.loads.history import LoadHistory, LoadPoint

#: A load that swings shows its crest within so many of its longest steps.
CYCLE_SAMPLES = 128


def largest_load(load: LoadHistory, end: float) -> tuple[float, LoadPoint]:
    """Return when a load is largest, and what it prescribes there.

    Parameters
    ----------
    load : LoadHistory
        The load.
    end : float
        Later instants do not count [s].

    Returns
    -------
    time : float
        One of its kinks, the end, or a step within its first swings [s].
    point : LoadPoint
        What is prescribed there, on the side of a jump where it is more.

    Examples
    --------
    >>> from viscontact.loads import harmonic
    >>> largest_load(harmonic(mean=2.0, amplitude=1.0, period=4.0, cycles=4), end=16.0)[0]
    1.0
    """
    instants: list[float] = [*load.kinks[load.kinks <= end].tolist(), end]
    if math.isfinite(load.longest_step):
        steps = np.arange(1, CYCLE_SAMPLES + 1) * load.longest_step
        instants += steps[steps < end].tolist()
    levels = np.stack([load.level_at(instants, side=side) for side in ("left", "right")], axis=1)
    first, side = divmod(int(levels.argmax()), 2)
    return instants[first], load.at(instants[first], side=("left", "right")[side])
