"""Events of a load program that a result records."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from viscontact.results.stored_result import Result


class RecordedEvent(NamedTuple):
    """Event of a result."""

    time: float  # [s]
    text: str  # instant, condition and error, in words


def recorded_events(ds: Result) -> list[RecordedEvent]:
    """Return the events of a result in their order; none for other loads than programs."""
    lines = str(ds.attrs.get("events", "")).splitlines()
    times = np.atleast_1d(ds.attrs.get("event_times", [])).tolist()  # netCDF has no list of one
    return [RecordedEvent(float(time), line) for time, line in zip(times, lines, strict=False)]
