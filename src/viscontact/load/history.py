"""The force history: force, eccentricity and prescribed tilt over time."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.load import points

# Forces below this part of the history's largest count as zero: rounding, not a load.
NEGLIGIBLE = 1e-12


@dataclass(frozen=True)
class LoadPoint:
    """What is prescribed at one instant.

    Parameters
    ----------
    force : float
        Force pressing the bodies together, exactly 0 where it is negligible [N].
    eccentricity_x, eccentricity_y : float
        Where the force acts: its moments are force · eccentricity [m].
    tilt_x, tilt_y : float or None
        Prescribed slopes along x and y, positive when they press the +x or +y end deeper;
        None where the tilt is free and the moment is balanced instead [rad].
    """

    force: float
    eccentricity_x: float
    eccentricity_y: float
    tilt_x: float | None
    tilt_y: float | None


@dataclass(frozen=True, eq=False, init=False)
class ForceHistory:
    """A force, where it acts, and prescribed tilts: piecewise linear in time, with jumps.

    Between its points the history is linear; a time given twice is a jump, from the first
    value to the second. Before the first point the force is zero, after the last one all is
    held; so a history that starts with a force starts with a jump.

    Parameters
    ----------
    times : array_like
        Instants of the points, not decreasing, none before 0, shape (n,) [s].
    force : float or array_like
        Force at the points, positive in compression, zero or more [N].
    eccentricity_x, eccentricity_y : float or array_like
        Where the force acts, a scalar or one value a point [m].
    tilt_x, tilt_y : float or array_like, optional
        Prescribed slopes along x and y, a scalar or one value a point, positive when they
        press the +x or +y end deeper; the moment equation of that axis is dropped [rad].

    Raises
    ------
    ValueError
        If the arrays do not fit together, the times decrease or come three times or before
        0, a value is not finite, a force is negative, or an eccentricity is given along an
        axis whose tilt is prescribed.

    Examples
    --------
    Up to 10 N in 1 s, held for 2 s, dropped to 4 N at once:

    >>> history = ForceHistory(times=[0, 1, 3, 3], force=[0, 10, 10, 4])
    >>> history.force_at([0.5, 2.0, 3.0, 9.0]).tolist()
    [5.0, 10.0, 4.0, 4.0]
    >>> history.at(3.0, side="left").force
    10.0
    """

    times: NDArray[np.float64]
    force: NDArray[np.float64]
    eccentricity_x: float | NDArray[np.float64]
    eccentricity_y: float | NDArray[np.float64]
    tilt_x: float | NDArray[np.float64] | None
    tilt_y: float | NDArray[np.float64] | None

    def __init__(
        self,
        times: ArrayLike,
        force: ArrayLike,
        eccentricity_x: ArrayLike = 0.0,
        eccentricity_y: ArrayLike = 0.0,
        tilt_x: ArrayLike | None = None,
        tilt_y: ArrayLike | None = None,
    ) -> None:
        # Written out, so that lists are welcome and arrays are what comes back.
        instants = points.instants(times)
        count = instants.size
        eccentricities = [
            points.values("eccentricity_x", eccentricity_x, count),
            points.values("eccentricity_y", eccentricity_y, count),
        ]
        tilts = [
            None if tilt_x is None else points.values("tilt_x", tilt_x, count),
            None if tilt_y is None else points.values("tilt_y", tilt_y, count),
        ]
        for axis, eccentricity, tilt in zip("xy", eccentricities, tilts, strict=True):
            points.refuse_both(axis, eccentricity, tilt)
        read = (instants, points.forces(force, count), *eccentricities, *tilts)
        for field, value in zip(fields(self), read, strict=True):
            object.__setattr__(self, field.name, value)

    def at(self, time: float, *, side: str = "right") -> LoadPoint:
        """Return what is prescribed at an instant.

        Parameters
        ----------
        time : float
            The instant [s].
        side : {"right", "left"}
            Which value to take at a jump: the one just after it or the one just before.

        Returns
        -------
        LoadPoint
            Force, eccentricities and tilts; before the first point the force is 0 and the
            others have their first values.

        Raises
        ------
        ValueError
            If the time is not a finite number, or the side is neither of the two.

        Examples
        --------
        >>> ForceHistory([0, 2], [0, 10], eccentricity_x=0.003).at(1.0)
        LoadPoint(force=5.0, eccentricity_x=0.003, eccentricity_y=0.0, tilt_x=None, tilt_y=None)
        """
        instant = np.asarray(points.finite_number("time", time, "s"))

        def value(of: float | NDArray[np.float64] | None) -> float | None:
            return None if of is None else float(self._interpolate(of, instant, side))

        return LoadPoint(
            force=float(self.force_at(instant, side=side)),
            eccentricity_x=float(self._interpolate(self.eccentricity_x, instant, side)),
            eccentricity_y=float(self._interpolate(self.eccentricity_y, instant, side)),
            tilt_x=value(self.tilt_x),
            tilt_y=value(self.tilt_y),
        )

    def force_at(self, times: ArrayLike, *, side: str = "right") -> NDArray[np.float64]:
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
        instants = points.numbers("times", times)
        force = self._interpolate(self.force, instants, side)
        started = np.searchsorted(self.times, instants, side=points.side_of_jump(side)) > 0
        return np.where(started & (force >= NEGLIGIBLE * self.largest_force), force, 0.0)

    @property
    def largest_force(self) -> float:
        """Largest force of the whole history [N]."""
        return float(self.force.max())

    @property
    def kinks(self) -> NDArray[np.float64]:
        """All distinct instants of the points, increasing: kinks, jumps, first and last [s]."""
        return np.unique(self.times)

    @property
    def jumps(self) -> NDArray[np.float64]:
        """Instants where, under load, force, eccentricity or prescribed tilt jumps [s].

        A history that starts with a force has its first jump there.
        """
        kinks = self.kinks
        before, after = self.force_at(kinks, side="left"), self.force_at(kinks)
        changed = before != after
        for of in (self.eccentricity_x, self.eccentricity_y, self.tilt_x, self.tilt_y):
            if of is not None:
                left, right = (self._interpolate(of, kinks, side) for side in ("left", "right"))
                changed |= left != right
        loaded = (before > 0) | (after > 0)
        return np.asarray(kinks[changed & loaded])

    def _interpolate(
        self, values: float | NDArray[np.float64], times: NDArray[np.float64], side: str
    ) -> NDArray[np.float64]:
        """Values at `times`, held before the first and after the last point."""
        values = np.broadcast_to(values, self.times.shape)
        reached = np.searchsorted(self.times, times, side=points.side_of_jump(side))
        i, j = np.maximum(reached - 1, 0), np.minimum(reached, self.times.size - 1)
        span = self.times[j] - self.times[i]
        part = np.divide(times - self.times[i], span, out=np.zeros(times.shape), where=span > 0)
        # Counted from the nearer point, so that either point's value comes out exactly.
        first_half = part < 0.5
        nearer, offset = np.where(first_half, i, j), np.where(first_half, part, part - 1)
        return np.asarray(values[nearer] + (values[j] - values[i]) * offset)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ForceHistory):
            return NotImplemented
        mine, theirs = vars(self), vars(other)
        return all(np.array_equal(mine[name], theirs[name]) for name in mine)

    def __hash__(self) -> int:
        return hash((self.times.size, float(self.times[-1]), self.largest_force))
