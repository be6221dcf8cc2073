"""A guess at the next instant from the last ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.contact import Guess

#: Points of the extrapolating polynomial. Four and more follow noise, not physics.
POINTS = 3


@dataclass(frozen=True)
class Found:
    """What was found at an instant, as far as the next guess needs it.

    Attributes
    ----------
    time : float
        The instant [s].
    guess : Guess
        Pressure, deflection and motion found.
    """

    time: float
    guess: Guess


def predict(past: Sequence[Found], time: float) -> Guess | None:
    """Extrapolate pressure, deflection and rigid motion together.

    The deflection is linear in the pressure, so the same combination of both stays exact: a
    good start without a convolution. Under a held load the combination is balanced, too.

    Parameters
    ----------
    past : sequence of Found
        Instants since the load's last kink or jump, oldest first; the last three are used.
    time : float
        The instant to guess [s].

    Returns
    -------
    Guess or None
        Polynomial of degree up to two in time; None without a past.
    """
    known = past[-POINTS:]
    if not known:
        return None
    weights = np.array(lagrange_weights([found.time for found in known], time))
    return Guess(
        pressure=_combined(weights, [found.guess.pressure for found in known]),
        deflection=_combined(weights, [found.guess.deflection for found in known]),
        motion=_combined(weights, [found.guess.motion for found in known]),
    )


def _combined(
    weights: NDArray[np.float64], arrays: Sequence[NDArray[np.float64]]
) -> NDArray[np.float64]:
    total = np.asarray(weights[0] * arrays[0])
    for weight, array in zip(weights[1:], arrays[1:], strict=True):
        total += weight * array
    return total


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
        float(np.prod([(at - other) / (node - other) for other in nodes if other != node]))
        for node in nodes
    ]
