"""Curve through points that is monotone where they are."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats


def monotone_curve(places: Floats, values: Floats, at: Floats) -> Floats:
    """Values, at places within those given, of the piecewise cubic curve of Fritsch and Butland.

    The given places increase; there are two or more. Slopes are weighted harmonic means of those
    of the chords on both sides, and 0 at extreme points [1]_.

    References
    ----------
    .. [1] F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304.
    """
    steps, rises = np.diff(places), np.diff(values)
    chords = rises / steps
    slopes = np.full(places.size, chords[0])
    if places.size > 2:
        before, after = chords[:-1], chords[1:]
        monotone = before * after > 0
        heavy, light = 2 * steps[1:] + steps[:-1], steps[1:] + 2 * steps[:-1]
        means = np.zeros(monotone.size)
        weights = heavy[monotone] / before[monotone] + light[monotone] / after[monotone]
        means[monotone] = (heavy + light)[monotone] / weights
        slopes[1:-1] = means
        slopes[0] = _end_slope(steps[0], steps[1], chords[0], chords[1])
        slopes[-1] = _end_slope(steps[-1], steps[-2], chords[-1], chords[-2])
    piece = np.clip(np.searchsorted(places, at, side="right") - 1, 0, steps.size - 1)
    way, h = at - places[piece], steps[piece]
    first, last = slopes[piece], slopes[piece + 1]
    square = (3 * chords[piece] - 2 * first - last) / h
    cube = (first + last - 2 * chords[piece]) / h**2
    return np.asarray(values[piece] + way * (first + way * (square + way * cube)))


def _end_slope(step: float, next_step: float, chord: float, next_chord: float) -> float:
    """Slope at an end by three points, of the sign of the chord and not much steeper."""
    slope = ((2 * step + next_step) * chord - step * next_chord) / (step + next_step)
    if slope * chord <= 0:
        return 0.0
    if chord * next_chord < 0 and abs(slope) > 3 * abs(chord):
        return 3 * chord
    return slope
