"""Force history: force, eccentricity and prescribed tilts over time."""

from __future__ import annotations

from dataclasses import field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import history_points
from viscontact.bodies.loads.piecewise import PiecewiseHistory
from viscontact.units.numbers import finite_array, store

# Forces below this part of the history's largest count as zero: rounding, not a load.
NEGLIGIBLE = 1e-12


@dataclass(frozen=True, eq=False, init=False)
class ForceHistory(PiecewiseHistory):
    """A force, where it acts, and prescribed tilts: piecewise linear in time, with jumps.

    Between its points the history is linear; a time given twice is a jump, from the first
    value to the second. Before the first point the force is zero, after the last one all is
    held; so a history that starts with a force starts with a jump.

    Parameters
    ----------
    times : array_like
        Instants of the points, not decreasing, none before 0, shape (n,) [s].
    force : float or array_like
        Force at the points, positive in compression; negative ones pull, which needs adhesion
        between the bodies [N].
    eccentricity_x, eccentricity_y : float or array_like
        Position of the force, a scalar or one value a point [m].
    tilt_x, tilt_y : float or array_like, optional
        Prescribed slopes along x and y, a scalar or one value a point, positive when they
        press the +x or +y end deeper; the moment equation of that axis is dropped [rad].

    Raises
    ------
    ValueError
        If the arrays do not fit together, the times decrease or come three times or before
        0, a value is not finite, or an eccentricity is given along an axis whose tilt is
        prescribed.

    Examples
    --------
    Up to 10 N in 1 s, held for 2 s, dropped to 4 N instantly:

    >>> history = ForceHistory(times=[0, 1, 3, 3], force=[0, 10, 10, 4])
    >>> history.force_at([0.5, 2.0, 3.0, 9.0]).tolist()
    [5.0, 10.0, 4.0, 4.0]
    >>> history.at(3.0, side="left").force
    10.0
    """

    times: Floats = field(metadata={"unit": "s", "name": "at times"})
    force: Floats = field(metadata={"unit": "N"})
    eccentricity_x: float | Floats = field(metadata={"unit": "m"})
    eccentricity_y: float | Floats = field(metadata={"unit": "m"})
    tilt_x: float | Floats | None = field(metadata={"unit": "rad"})
    tilt_y: float | Floats | None = field(metadata={"unit": "rad"})

    def __init__(
        self,
        times: ArrayLike,
        force: ArrayLike,
        eccentricity_x: ArrayLike = 0.0,
        eccentricity_y: ArrayLike = 0.0,
        tilt_x: ArrayLike | None = None,
        tilt_y: ArrayLike | None = None,
    ) -> None:
        # Written out, so that lists are accepted and arrays are stored.
        instants = history_points.instants(times)
        tail = history_points.tail(
            ForceHistory,
            instants.size,
            eccentricity_x=eccentricity_x,
            eccentricity_y=eccentricity_y,
            tilt_x=tilt_x,
            tilt_y=tilt_y,
        )
        forces = history_points.values(ForceHistory, "force", force, instants.size)
        forces = np.broadcast_to(forces, instants.shape)
        store(self, times=instants, force=forces, **tail)

    def force_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the force at many instants.

        Parameters
        ----------
        times : array_like
            The instants, any shape [s].
        side : {"right", "left"}
            Which value to take at a jump: the one just after it or the one just before.

        Returns
        -------
        ndarray
            Force, exactly 0 where it is below 1e-12 of the largest, and before the first
            point, same shape [N].

        Raises
        ------
        ValueError
            If a time is not a finite number, or the side is neither of the two.

        Examples
        --------
        >>> ForceHistory([0.0], [10.0]).force_at([0.0, 1.0], side="left").tolist()
        [0.0, 10.0]
        """
        instants = finite_array("times", times, "s")
        force = self._interpolate(self.force, instants, side)
        least = NEGLIGIBLE * self._largest_size
        counts = self._begun(instants, side) & (np.abs(force) >= least)
        return np.where(counts, force, 0.0)

    def level_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the force at many instants [N]; as `force_at`."""
        return self.force_at(times, side=side)

    def _level(self, time: float, side: str) -> float:
        if self._reached(time, side) == 0:
            return 0.0
        force = self._value_at(self.force, time, side)
        return force if abs(force) >= NEGLIGIBLE * self._largest_size else 0.0

    @cached_property
    def _largest_size(self) -> float:
        return float(np.abs(self.force).max())

    @cached_property
    def largest_force(self) -> float:
        """Largest force of the whole history [N]."""
        return float(self.force.max())

    @property
    def least_force(self) -> float:
        """Least force of the whole history [N]."""
        return float(self.force.min())

    @property
    def largest_level(self) -> float:
        """Largest force of the whole history [N]."""
        return self.largest_force
