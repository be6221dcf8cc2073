"""A guess at the next instant from the last ones, by way of the elastic elastic_reference.

The elastic_reference of a creeping contact is the elastic contact, of unit compliance, with the
same displacement: its pressure is P = ∫ J dp. While a contact grows, the elastic_reference is an
ordinary elastic
contact under the elastic_reference force S = ∫ J dW, so that it changes smoothly and slowly with
S, where the
pressure itself relaxes. Extrapolating the elastic_reference in S and returning to p is worth
several iterations a step, and the memory provides the way back.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

#: Points of the extrapolating polynomial. A third one tells more about what the solver's tolerance
#: left in its answers than about physics: it costs half an iteration a step.
EXTRAPOLATION_POINTS = 2

#: Neighbouring steps of the elastic_reference force may differ by this factor, else time is
#: extrapolated in.
MAX_STEP_RATIO = 20.0


@dataclass(frozen=True, eq=False)
class ElasticReference:
    """The elastic elastic_reference of an instant.

    Attributes
    ----------
    time : float
        The instant [s].
    drive : float
        What the elastic_reference moves with: the elastic_reference force ∫ J dW [m²], or a
        prescribed approach [m], which is the twin's as well.
    fields : ndarray, shape (2, nx, ny)
        ElasticReference pressure ∫ J dp [-], and displacement ∫ J dq [m], which belong to each
        other.
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad].
    """

    time: float
    drive: float
    fields: NDArray[np.float64]
    motion: NDArray[np.float64]


def predict(past: Sequence[ElasticReference], time: float, drive: float) -> ElasticReference | None:
    """Extrapolate the elastic_reference.

    Parameters
    ----------
    past : sequence of ElasticReference
        Instants since the load's last kink or jump, oldest first; the last two are used.
    time : float
        The instant to guess [s].
    drive : float
        Its elastic_reference force [m²] or approach [m], which the load's history gives beforehand.

    Returns
    -------
    ElasticReference or None
        A line through them, in the drive where that moves steadily, else in time; the one there
        is; None without a past.
    """
    if not past:
        return None
    known = past[-EXTRAPOLATION_POINTS:]
    drives = [elastic_reference.drive for elastic_reference in known]
    if _is_steady([*drives, drive]):
        weights = lagrange_weights(drives, drive)
    else:
        weights = lagrange_weights([elastic_reference.time for elastic_reference in known], time)
    # From the last one on, as the weights' sum is one: in place, where each pass counts.
    last = known[-1].fields
    fields = np.subtract(known[0].fields, last)
    fields *= weights[0]
    fields += last
    motion = np.asarray(weights) @ np.array(
        [elastic_reference.motion for elastic_reference in known]
    )
    return ElasticReference(time, drive, fields, motion)


def _is_steady(drives: Sequence[float]) -> bool:
    steps = np.diff(drives)
    sizes = np.abs(steps)
    same_sign = bool((steps > 0).all() or (steps < 0).all())
    return same_sign and bool(
        sizes.min() > 1e-9 * np.abs(drives).max() and sizes.max() < MAX_STEP_RATIO * sizes.min()
    )


def lagrange_weights(nodes: Sequence[float], at: float) -> list[float]:
    """Weights of a polynomial's values at the nodes in its value elsewhere.

    Parameters
    ----------
    nodes : sequence of float
        Distinct nodes.
    at : float
        Where the value is wanted.

    Returns
    -------
    list of float
        They sum to one.

    Examples
    --------
    >>> lagrange_weights([0.0, 1.0], 2.0)
    [-1.0, 2.0]
    """
    return [
        math.prod((at - other) / (node - other) for other in nodes if other != node)
        for node in nodes
    ]
