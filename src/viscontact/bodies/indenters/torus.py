"""Torus: a ring with a circular section, pressed flat."""

from __future__ import annotations

from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.arc import arc_drop
from viscontact.bodies.indenters.indenter import Indenter
from viscontact.bodies.indenters.position_checks import positions
from viscontact.units.numbers import check_fields


@dataclass(frozen=True)
class Torus(Indenter):
    """A ring with a circular section, its axis along z; it touches along a circle.

    Parameters
    ----------
    ring_radius : float
        Radius of the circle that the middles of the sections lie on [m].
    tube_radius : float
        Radius of the section [m].

    Raises
    ------
    ValueError
        If a radius is not a positive, finite number.

    Notes
    -----
    A wheel or tyre, whose axis lies along the surface, is a `Roller` with a full crown.

    Examples
    --------
    >>> Torus(ring_radius=20.0, tube_radius=5.0).gap([20.0, 0.0, 26.0], [0.0, 17.0, 0.0]).tolist()
    [0.0, 1.0, inf]
    """

    ring_radius: float = field(metadata={"unit": "m"})
    tube_radius: float = field(metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "ring_radius", "tube_radius")

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the drop of the section's arc, +inf outside the ring; see `Indenter.gap`."""
        distance = np.hypot(*positions(x, y)) - self.ring_radius
        return arc_drop(np.abs(distance), self.tube_radius)
