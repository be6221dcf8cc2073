"""Approach history: prescribed approach and tilts over time."""

from __future__ import annotations

from dataclasses import field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import history_points
from viscontact.bodies.loads.piecewise import PiecewiseHistory
from viscontact.units.numbers import check_fields, finite_array, store

#: Relative rounding of an instant, and the distance from a kink below which it is the kink.
ROUNDING, NEAR_KINK = 2e-15, 1e-9


@dataclass(frozen=True, eq=False, init=False)
class ApproachHistory(PiecewiseHistory):
    """An approach and tilts of a stage: piecewise linear in time, with jumps.

    The approach is 0 where the undeformed bodies just touch. Before the first point it is 0, or the
    first value where that is negative, and tilts have their first values; after the last one all
    is held. So a history that starts with an approach above 0 starts with a jump. Where the
    approach is too small for contact (a body withdrawn from its indentation, say), force and
    pressure are zero, and the contact may return later.

    Parameters
    ----------
    times : array_like
        Instants of the points, not decreasing, none before 0, shape (n,) [s].
    approach : float or array_like
        Approach at the points, positive when the bodies come closer, negative when the
        indenter is lifted [m].
    tilt_x, tilt_y : float or array_like or None
        Slopes along x and y, positive when they press the +x or +y end deeper; the stage is
        clamped straight if left out. None lets that tilt go free: the pressure then has no
        moment about the origin along that axis [rad].
    stage_stiffness : float, optional
        The approach is that of a stage on which the body hangs by a spring of this stiffness, as a
        tip hangs on its cantilever: the body's own approach is less by force over stiffness. For
        bodies that adhere [N/m].

    Raises
    ------
    ValueError
        If the arrays do not fit together, the times decrease or come three times or before
        0, a value is not finite, or the stiffness is not positive.

    Examples
    --------
    Pressed in by 1 um in 1 s, held for 2 s, withdrawn instantly:

    >>> history = ApproachHistory(times=[0, 1, 3, 3], approach=[0, 1e-6, 1e-6, -1e-6])
    >>> history.approach_at([0.5, 2.0, 3.0, 9.0]).tolist()
    [5e-07, 1e-06, -1e-06, -1e-06]
    >>> history.at(2.0).force is None, history.at(2.0).tilt_x
    (True, 0.0)
    """

    control = "approach"

    times: Floats = field(metadata={"unit": "s", "name": "at times"})
    approach: Floats = field(metadata={"unit": "m"})
    tilt_x: float | Floats | None = field(metadata={"unit": "rad"})
    tilt_y: float | Floats | None = field(metadata={"unit": "rad"})
    stage_stiffness: float | None = field(
        default=None, metadata={"unit": "N/m", "recorded": "if given"}
    )

    def __init__(
        self,
        times: ArrayLike,
        approach: ArrayLike,
        tilt_x: ArrayLike | None = 0.0,
        tilt_y: ArrayLike | None = 0.0,
        stage_stiffness: float | None = None,
    ) -> None:
        # Written out, so that lists are accepted and arrays are stored.
        instants = history_points.instants(times)
        values = history_points.values(ApproachHistory, "approach", approach, instants.size)
        tilts = history_points.tail(ApproachHistory, instants.size, tilt_x=tilt_x, tilt_y=tilt_y)
        levels = np.broadcast_to(values, instants.shape)
        store(self, times=instants, approach=levels, **tilts, stage_stiffness=stage_stiffness)
        check_fields(self, "stage_stiffness")

    def approach_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the approach at many instants.

        Parameters
        ----------
        times : array_like
            The instants, any shape [s].
        side : {"right", "left"}
            Which value to take at a jump: the one just after it or the one just before.

        Returns
        -------
        ndarray
            Approach, before the first point 0 or the first value where that is negative, same
            shape [m].

        Raises
        ------
        ValueError
            If a time is not a finite number, or the side is neither of the two.

        Examples
        --------
        >>> ApproachHistory([1.0], [1e-6]).approach_at([0.0, 1.0, 2.0]).tolist()
        [0.0, 1e-06, 1e-06]
        """
        instants = finite_array("times", times, "s")
        approach = self._interpolate(self.approach, instants, side)
        return np.where(self._begun(instants, side), approach, min(float(self.approach[0]), 0.0))

    def level_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the approach at many instants [m]; as `approach_at`."""
        return self.approach_at(times, side=side)

    def _level(self, time: float, side: str) -> float:
        if self._reached(time, side) == 0:
            return min(float(self.approach[0]), 0.0)
        return self._value_at(self.approach, time, side)

    @cached_property
    def touches(self) -> Floats:
        """Instants between kinks at which the approach rises through 0, without given tilts [s].

        Examples
        --------
        >>> ApproachHistory([0.0, 4.0, 5.0], [-1e-6, 3e-6, 0.0]).touches.round(12).tolist()
        [1.0]
        """
        if np.any(self.tilt_x) or np.any(self.tilt_y):
            return np.zeros(0)  # a tilted body touches earlier
        rises = (self.approach[:-1] < 0) & (self.approach[1:] > 0)
        begin, end = self.times[:-1][rises], self.times[1:][rises]
        below, above = self.approach[:-1][rises], self.approach[1:][rises]
        # Earlier by rounding, so that the bodies are still apart at the end of a step there.
        instants = (begin + (end - begin) * (below / (below - above))) * (1 - ROUNDING)
        apart = np.minimum(instants - begin, end - instants) > NEAR_KINK * instants
        return np.asarray(instants[apart])

    @property
    def largest_level(self) -> float:
        """Largest approach of the whole history [m]."""
        return float(self.approach.max())
