"""Values that stand for points without a measurement, in place of heights."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats

#: Texts of cells without a height, in small letters.
NOT_MEASURED = ("", "nan", "na", "n/a", "-", "bad", "***", "void", "null", "none")

# Largest and least values of counts, and what programs write by hand.
_MARKERS = (9999.0, 99999.0, 999999.0, 32767.0, 32768.0, 2147483647.0, 2147483648.0, 1e10)
# Beyond this, a value is no length in any unit: 1e30, and the largest one of 32 bits, 3.4e38.
_NO_LENGTH = 1e20
# Single precision and rounding in texts.
_CLOSE = 1e-6
#: Metres in units of files: tables arrive in metres.
LENGTH_UNITS = (1.0, 1e-2, 1e-3, 1e-6, 1e-9, 1e-10, 1e-12, 0.0254, 2.54e-5)


def without_markers(
    values: Floats, units: tuple[float, ...] = (1.0,)
) -> tuple[Floats, tuple[str, ...]]:
    """Heights with NaN for markers of missing points, and notes that state them.

    A marker is the highest or the lowest value, one of the usual numbers in one of the `units`, and
    farther from all other heights than these are from each other; or it is no length at all.
    """
    found = np.array(values, dtype=np.float64)
    notes = []
    with np.errstate(invalid="ignore"):
        beyond = (found >= _NO_LENGTH) | (found <= -_NO_LENGTH)
    if beyond.any():
        notes.append(_note(int(beyond.sum()), float(found[beyond][0])))
        found[beyond] = np.nan
    for _ in range(2 * len(_MARKERS)):
        marker = _marker(found, units)
        if marker is None:
            break
        value, unit = marker
        notes.append(_note(int((found == value).sum()), round(value / unit, 6)))
        found[found == value] = np.nan
    return found, tuple(notes)


def _marker(found: Floats, units: tuple[float, ...]) -> tuple[float, float] | None:
    """Marker among the extreme values, and its unit [m]; None if there is none."""
    # Reductions with a mask: copies of a large map would need a multiple of its memory.
    known = np.isfinite(found)
    if not known.any():
        return None
    for value in _extremes(found, known):
        unit = next((each for each in units if _is_number_of(value / each)), None)
        if unit is None:
            continue
        rest = known & (found != value)
        if rest.any():
            low, high = _extremes(found, rest)
            if min(abs(low - value), abs(high - value)) > high - low:
                return value, unit
    return None


def _extremes(found: Floats, where: Bools) -> tuple[float, float]:
    low = np.min(found, where=where, initial=np.inf)
    return float(low), float(np.max(found, where=where, initial=-np.inf))


def _is_number_of(value: float) -> bool:
    """True for one of the usual markers, with either sign."""
    return any(abs(abs(value) - each) <= _CLOSE * each for each in _MARKERS)


def _note(count: int, value: float) -> str:
    points = "1 point has" if count == 1 else f"{count} points have"
    return f"{points} the value {value:.7g}, which marks missing ones; they have no height"
