"""Times of a run, requested or chosen from load and law."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.mechanics import time_integration
from viscontact.mechanics.time_integration.fixed_steps import snap_to_kink
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array


def run_instants(
    times: ArrayLike | AdaptiveTimes | None,
    kept: Sequence[float],
    load: LoadHistory,
    compliance: ContactCompliance,
) -> Floats:
    """Times of a run [s]; of adaptive steps those to be hit: 0, the end, and times of kept fields.

    `times` are as in `march`, and `kept` the times of fields that are named one by one.

    >>> from viscontact.bodies.materials.compliance import SeriesCompliance
    >>> from viscontact.bodies.loads import step
    >>> law = SeriesCompliance(1.0, [1.0], [2.0])
    >>> run_instants(None, (), step(1.0), law)[[0, 1, -1]].round(3).tolist()
    [0.0, 0.103, 10.0]
    """
    if times is None:
        return time_integration.default_times.default_times(load, compliance)
    if not isinstance(times, AdaptiveTimes):
        return _checked_times(times)
    named = real_array("fields", kept, "s")
    stops = [0.0, times.end, *named[(named >= 0) & (named <= times.end)].tolist()]
    # A time that differs from a kink of the load by rounding only is taken as the kink.
    return np.array(sorted({snap_to_kink(stop, load.kinks) for stop in stops}))


def _checked_times(times: ArrayLike) -> Floats:
    """Requested times, finite, not before 0 and strictly increasing [s]."""
    instants = np.atleast_1d(real_array("times", times, "s"))
    if instants.ndim != 1 or instants.size == 0 or not np.isfinite(instants).all():
        raise ValueError(f"times must be one or more finite instants in s, got {times!r}")
    if instants[0] < 0:
        raise ValueError(f"times must not be before 0, got {format_quantity(instants[0], 's', 6)}")
    for i in np.flatnonzero(np.diff(instants) <= 0)[:1]:
        raise ValueError(
            f"times must be strictly increasing, got {format_quantity(instants[i], 's', 6)}, then "
            f"{format_quantity(instants[i + 1], 's', 6)}"
        )
    return instants
