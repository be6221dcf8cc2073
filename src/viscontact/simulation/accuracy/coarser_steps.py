"""Steps of the coarser runs: fewer requested times, and divided steps."""

from __future__ import annotations

import itertools

import numpy as np

from viscontact.backend.arrays import Floats

#: Length of a step, over the longest of the run's steps within it, below which a coarser run takes
#: it as the run does.
SHARED_RATIO = 1.5


def fewer_times(times: Floats, stops: Floats, step_ratio: int) -> Floats:
    """Times of which about every `step_ratio`-th one is kept, a power of 2, between the stops."""
    while step_ratio > 1:
        times, step_ratio = _every_second(times, stops), step_ratio // 2
    return times


def _every_second(times: Floats, stops: Floats) -> Floats:
    """Every second time between two stops of the load, without the first step behind each."""
    # Of an odd number of steps three are joined.
    within = stops[(stops > times[0]) & (stops < times[-1])]
    kept = [times[:1]]
    for begin, end in itertools.pairwise([times[0], *within, times[-1]]):
        inside = times[(times > begin) & (times <= end)]
        kept.append(inside[:1])
        later = np.union1d(inside, end)[1:]
        joined = np.linspace(0, len(later), max(1, len(later) // 2) + 1).astype(int)
        kept.append(np.intersect1d(later[joined[1:] - 1], inside) if len(later) else later)
    return np.unique(np.concatenate(kept))


def parts_of_shared_steps(ends: Floats, others: Floats) -> Floats:
    """Quarters and middles of the steps of the others that are hardly longer than the own ones."""
    own, theirs = np.unique(ends), np.unique(others)
    begins, lengths = theirs[:-1], np.diff(theirs)
    longest = np.zeros(len(begins))
    place = np.clip(np.searchsorted(theirs, own[1:]) - 1, 0, len(begins) - 1)
    np.maximum.at(longest, place, np.diff(own))
    shared = lengths < SHARED_RATIO * longest
    parts = begins[shared] + np.array([[0.25], [0.5]]) * lengths[shared]
    return np.asarray(parts.ravel())


#: Shortest part of the first step behind a jump, over the step, and number of its parts.
SHORTEST_PART, PARTS = 1e-3, 12


def first_steps(ends: Floats, jumps: Floats) -> tuple[Floats, Floats]:
    """Begins and durations of the first steps behind jumps."""
    places = np.searchsorted(ends, jumps, side="right")
    known = places < len(ends)
    return jumps[known], ends[places[known]] - jumps[known]


def parts_of_first_steps(ends: Floats, jumps: Floats) -> Floats:
    """Parts of the first step behind each jump, in geometric progression, with its end."""
    # A moving body heats the material most while this adapts to a jump; in steps that are long
    # against the law, other ones of similar length have the same error.
    begins, durations = first_steps(ends, jumps)
    parts = np.geomspace(SHORTEST_PART, 1.0, PARTS)
    return np.asarray((begins + durations * parts[:, None]).ravel())
