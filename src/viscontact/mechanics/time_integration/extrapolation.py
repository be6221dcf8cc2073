"""Initial guess for the next step, extrapolated by way of the elastic reference.

The elastic reference of a viscoelastic contact is the elastic contact of unit compliance with the
same displacement: its pressure is P = ∫ J dp. While a contact grows, it is an ordinary elastic
contact under the reference force S = ∫ J dW, so it changes smoothly and slowly with S, whereas the
pressure itself relaxes. Extrapolating the reference in S, and returning to p by the response of the
hereditary integral, saves several iterations a step.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team

#: Points of the extrapolating polynomial. A third one amplifies the errors that the solver's
#: tolerance leaves: it costs half an iteration a step.
EXTRAPOLATION_POINTS = 2

#: The same of bodies that adhere, whose steps are limited by the error of what is foreseen: a third
#: one saves a fifteenth of the steps of spheres, and a tenth of the convolutions.
ADHESIVE_POINTS = 3

#: Largest ratio of neighbouring steps of the drive; beyond it, the extrapolation is in time.
MAX_STEP_RATIO = 20.0


@dataclass(frozen=True, eq=False)
class ElasticReference:
    """Elastic reference of a viscoelastic contact at one time."""

    time: float  # [s]
    drive: float  # reference force ∫ J dW [m²], or the prescribed approach [m]
    #: Pressure ∫ J dp [-] and displacement ∫ J dq [m]; shape (2, nx, ny).
    fields: Floats
    motion: Floats  # approach [m] and tilts [rad]


def predict(
    past: Sequence[ElasticReference],
    time: float,
    drive: float,
    team: Team | None = None,
    points: int = EXTRAPOLATION_POINTS,
) -> ElasticReference | None:
    """Extrapolate the elastic reference to a time [s] and its drive [m² or m]."""
    # `past` holds those since the load's last kink or jump, oldest first. A polynomial through so
    # many points in the drive where that moves steadily, else in time; constant with one past
    # reference, None without any.
    if not past:
        return None
    known = past[-points:]
    drives = [each.drive for each in known]
    if _moves_evenly([*drives, drive]):
        weights = lagrange_weights(drives, drive)
    else:
        weights = lagrange_weights([each.time for each in known], time)
    fields = np.empty(known[-1].fields.shape)
    (team or Team()).weighted_sum(fields, weights, [each.fields for each in known])
    motion = np.asarray(weights) @ np.array([each.motion for each in known])
    return ElasticReference(time, drive, fields, motion)


def shifted(fields: Floats, cells: tuple[int, int], *, periodic: tuple[bool, bool]) -> Floats:
    """Fields moved by whole cells along the last two axes."""
    # What enters at a border is a copy of the last values there, along a period what leaves.
    for axis, by, repeats in zip((-2, -1), cells, periodic, strict=True):
        if by:
            count = fields.shape[axis]
            source = np.arange(count) - by
            source = source % count if repeats else np.clip(source, 0, count - 1)
            fields = np.take(fields, source, axis=axis)
    return fields


def _moves_evenly(drives: Sequence[float]) -> bool:
    """True if the drive moves one way, by steps of similar size."""
    steps = [late - early for early, late in itertools.pairwise(drives)]
    if min(steps) < 0:
        steps = [-step for step in steps]
    if min(steps) <= 0:
        return False
    least = max(1e-9 * max(map(abs, drives)), max(steps) / MAX_STEP_RATIO)
    return min(steps) > least


def lagrange_weights(nodes: Sequence[float], at: float) -> list[float]:
    """Weights of the values at distinct nodes in their polynomial's value at a point."""
    if len(nodes) == 2:  # as below, at every step
        (first, second), span = nodes, nodes[0] - nodes[1]
        return [(at - second) / span, (at - first) / -span]
    return [
        math.prod((at - other) / (node - other) for other in nodes if other != node)
        for node in nodes
    ]
