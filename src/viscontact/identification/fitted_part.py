"""Part of an indentation record that is fitted, and adhesion that shortens it."""

from __future__ import annotations

from warnings import warn

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.identification.record import IndentationRecord
from viscontact.identification.stroke import Stroke
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import as_real

#: Names of parts of a record.
PARTS = ("loading", "hold", "end")

_RUN = 5  # rows of a running mean that a pull-off stands out of
_SIGMAS = 5.0  # of the running mean
_LEAST_PULL = 0.005  # of the largest force


def fitted_rows(record: IndentationRecord, until: str | float | None) -> int:
    """Rows that are fitted: up to loading, hold, end or an instant [s]; chosen and said if None."""
    stroke, rows = stroke_of(record), record.times.size
    if until is None:
        return _without_adhesion(record, stroke)
    if isinstance(until, str) and until in PARTS:
        return {"loading": stroke.loading_end + 1, "hold": stroke.hold_end + 1, "end": rows}[until]
    instant = _instant(until, record.times)
    return int(np.searchsorted(record.times, instant, side="right"))


def stroke_of(record: IndentationRecord) -> Stroke:
    """Motion of the base, or of the indenter where there is no cantilever."""
    if record.cantilever is None:
        return Stroke(record.times, record.approach)
    bending = record.force / record.cantilever.spring_constant
    return Stroke(record.times, record.approach + bending + record.cantilever.contact)


def _instant(until: object, times: Floats) -> float:
    """Instant that is given as the end of the fitted part [s]."""
    instant = None if isinstance(until, str) else as_real(until, "s")
    if instant is None or not times[0] < instant < np.inf:
        raise ValueError(
            "fit_indentation: until must be 'loading', 'hold', 'end' or an instant after "
            f"{format_quantity(float(times[0]), 's', 6)}, got {until!r}"
        )
    return instant


def _without_adhesion(record: IndentationRecord, stroke: Stroke) -> int:
    """Rows up to the retraction where its force becomes negative; up to a second approach."""
    rows = record.times.size
    second = stroke.second_approach
    if second is not None and record.cantilever is not None:
        warn(
            "fit_indentation: the base approaches a second time at "
            f"{format_quantity(record.times[second], 's', 4)}; only the first approach and "
            "retraction are fitted",
            AccuracyWarning,
            stacklevel=4,
        )
        rows = second + 1
    pull = _pull_off(record, stroke, rows)
    if pull == 0:
        return rows
    share = pull / float(record.force.max())
    part = "loading and hold are" if stroke.hold_end > stroke.loading_end else "loading is"
    warn(
        "fit_indentation: the force becomes negative during retraction, down to "
        f"{format_quantity(-pull, 'N', 3)} ({100 * share:.2g} % of the largest): adhesion, which "
        f"the law does not contain. Only {part} fitted, where it may still act; until='end' fits "
        "all",
        AccuracyWarning,
        stacklevel=4,
    )
    return stroke.hold_end + 1


def _pull_off(record: IndentationRecord, stroke: Stroke, rows: int) -> float:
    """Largest negative force of the retraction, against what follows it [N]; 0 within the noise."""
    force = record.force[:rows]
    after = force[stroke.hold_end :]
    if after.size < 2 * _RUN or force.size < 2 * _RUN:
        return 0.0
    averaged = np.convolve(after, np.full(_RUN, 1 / _RUN), "valid")
    # The drag of a liquid, or a drift, shifts all that is free after the retraction.
    lost = after[-max(after.size // 10, _RUN) :]
    level = min(float(np.median(lost)), 0.0) if np.median(lost) < 0.1 * force.max() else 0.0
    noise = float(np.sqrt(np.mean(np.diff(force, 2) ** 2) / 6 / _RUN))
    if record.cantilever is not None:
        free = force[: max(int(np.argmax(record.approach > 0)), _RUN)]
        noise = max(noise, float(np.std(np.convolve(free, np.full(_RUN, 1 / _RUN), "valid"))))
    pull = level - float(averaged.min())
    return pull if pull > max(_SIGMAS * noise, _LEAST_PULL * float(force.max())) else 0.0
