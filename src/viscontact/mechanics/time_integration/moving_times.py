"""Times of a moving contact if none are given: one for each cell passed, and times at rest."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.motion import Motion, MovingLoad

#: Times while the body rests, and the first of them after its stop, as a part of the rest.
REST_TIMES, FIRST_REST_TIME = 20, 1e-3

#: Times closer than this part of the whole coincide.
SAME_TIME = 1e-9


@dataclass(frozen=True)
class CellTimes:
    """Request for a step for each cell passed, up to an end [s], on a grid that is chosen later."""

    end: float


def moving_times(
    motion: Motion,
    load: LoadHistory,
    cell_size: tuple[float, float],
    end: float | None = None,
    kept: Sequence[float] = (),
) -> Floats:
    """Times at which the body has passed whole cells (dx, dy), and kinks of load and path [s].

    Alignment of body and cells is then the same at all of them, so that the resistance does not
    scatter. At rest they are in geometric progression. The last one is that of load and path, or
    `end`. The times `kept` up to there are among them.
    """
    kinks = MovingLoad(load, motion).kinks
    end = float(kinks[-1]) if end is None else end
    ends = np.unique([0.0, *kinks[kinks < end], *(time for time in kept if time < end), end])
    found = [motion.times_at_cells(cell_size)]
    for begin, stop in itertools.pairwise(ends.tolist()):
        if (motion.position_at(begin) == motion.position_at(stop)).all() and not any(
            begin < time < stop for time in found[0]
        ):
            parts = np.geomspace(FIRST_REST_TIME, 1.0, REST_TIMES)
            found.append(begin + (stop - begin) * parts)
    times = np.unique(np.concatenate([ends, *found]))
    times = times[times <= end]
    # Of times that coincide the kink is kept, else the first.
    after = np.clip(np.searchsorted(ends, times), 1, len(ends) - 1)
    distance = np.minimum(np.abs(times - ends[after - 1]), np.abs(times - ends[after]))
    rounded = (distance > 0) & (distance < SAME_TIME * end)
    times = times[~rounded]
    apart = np.append(True, np.diff(times) > SAME_TIME * end)
    return np.asarray(times[apart | np.isin(times, ends)])
