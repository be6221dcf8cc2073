"""Largest load of a history, and when it acts."""

from __future__ import annotations

import math

import numpy as np

from viscontact.bodies.loads.history import LoadHistory, LoadPoint

#: Upper limit on the samples of a curved load.
MOST_SAMPLES = 10_000


def largest_load(load: LoadHistory, end: float) -> tuple[float, LoadPoint]:
    """Return the time [s] of the largest load up to `end` [s], and the load there."""
    # A kink, the end, or a multiple of the longest step of a curved load, in the first cycle of a
    # cyclic one; at a jump it is the side with the larger load.
    instants: list[float] = [*load.kinks[load.kinks <= end].tolist(), end]
    if math.isfinite(load.longest_step):
        cycles = load.load_cycles
        curved_until = cycles[0][1][0] if cycles else float(load.kinks[-1])
        pieces = min(math.ceil(curved_until / load.longest_step), MOST_SAMPLES)
        samples = np.linspace(0.0, curved_until, pieces + 1)
        instants += samples[samples < end].tolist()
    levels = np.stack([load.level_at(instants, side=side) for side in ("left", "right")], axis=1)
    first, side = divmod(int(levels.argmax()), 2)
    return instants[first], load.at(instants[first], side=("left", "right")[side])
