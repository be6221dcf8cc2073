"""An ellipsoid, its axes along x, y and z."""

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
class Ellipsoid(Indenter):
    """An ellipsoid, pressed along one of its axes.

    Parameters
    ----------
    semi_axis_x, semi_axis_y, semi_axis_z : float
        Half its extents along x, y and z [m].

    Raises
    ------
    ValueError
        If a semi-axis is not a positive, finite number.

    Notes
    -----
    The gap is c (1 - sqrt(1 - ρ²)) with ρ² = (x/a)² + (y/b)², computed without cancellation. The
    radii of curvature at the apex are a²/c and b²/c; Hertz's theory takes the paraboloid of these.

    Examples
    --------
    >>> egg = Ellipsoid(semi_axis_x=10.0, semi_axis_y=5.0, semi_axis_z=5.0)
    >>> egg.gap([0.0, 6.0, 6.0], [0.0, 0.0, 4.5]).round(12).tolist(), egg.curvatures
    ([0.0, 1.0, inf], (0.05, 0.2))
    """

    semi_axis_x: float = field(metadata={"unit": "m"})
    semi_axis_y: float = field(metadata={"unit": "m"})
    semi_axis_z: float = field(metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "semi_axis_x", "semi_axis_y", "semi_axis_z")

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return c (1 - sqrt(1 - ρ²)), +inf for ρ > 1; see `Indenter.gap`."""
        x, y = positions(x, y)
        return self.semi_axis_z * arc_drop(np.hypot(x / self.semi_axis_x, y / self.semi_axis_y), 1)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvatures c/a² and c/b² [1/m]."""
        return (
            self.semi_axis_z / self.semi_axis_x**2,
            self.semi_axis_z / self.semi_axis_y**2,
        )
