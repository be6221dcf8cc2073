"""Harmonic load history: a force or an approach that oscillates about a mean."""

from __future__ import annotations

import itertools
import math
from dataclasses import field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import history_points
from viscontact.bodies.loads.force import NEGLIGIBLE
from viscontact.bodies.loads.history import Control, Cycle, LoadHistory
from viscontact.bodies.loads.level import (
    positive_duration,
    prescribed_level,
    refuse_eccentric_approach,
    refuse_stage,
)
from viscontact.units.numbers import check_fields, finite, finite_array, unit_of, whole

#: Default steps of a cycle. Linear interpolation over 1/128 of a sine has a mean error of 2e-4 of
#: the amplitude, and the loss of a cycle an error of about 6e-4.
STEPS_PER_CYCLE = 128


#: Upper limit on the cycles of a harmonic load; each takes dozens of steps.
MOST_CYCLES = 100_000

_LEVEL_UNITS = {"force": "N", "approach": "m"}  # by the value of `control`


@dataclass(frozen=True, kw_only=True)
class HarmonicHistory(LoadHistory):
    """Harmonic load, mean + amplitude sin(2 π t/period + phase), constant after the last cycle.

    Made by `harmonic`.

    Attributes
    ----------
    control : {"force", "approach"}
        The prescribed quantity.
    mean, amplitude : float
        Mean and amplitude [N or m].
    period : float
        Time of a cycle [s].
    cycles : int
        Number of cycles.
    phase : float
        Phase at time 0 [rad].
    eccentricity_x, eccentricity_y : float
        Position of the force [m].
    tilt_x, tilt_y : float or None
        Prescribed slopes; None where free [rad].
    stage_stiffness : float or None
        Stiffness of the spring between stage and body, as in `ApproachHistory` [N/m].
    """

    control: Control
    mean: float = field(metadata={"unit": _LEVEL_UNITS})
    amplitude: float = field(metadata={"unit": _LEVEL_UNITS})
    period: float = field(metadata={"unit": "s"})
    cycles: int = field(metadata={"unit": "1"})
    phase: float = field(default=0.0, metadata={"unit": "rad"})
    eccentricity_x: float = field(default=0.0, metadata={"unit": "m"})
    eccentricity_y: float = field(default=0.0, metadata={"unit": "m"})
    tilt_x: float | None = field(default=None, metadata={"unit": "rad"})
    tilt_y: float | None = field(default=None, metadata={"unit": "rad"})
    stage_stiffness: float | None = field(
        default=None, metadata={"unit": "N/m", "recorded": "if given"}
    )

    def __post_init__(self) -> None:
        check_fields(self, "stage_stiffness")

    @property
    def end(self) -> float:
        """Instant at which the last cycle ends [s]."""
        return self.cycles * self.period

    def level_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the force [N] or the approach [m] at many instants [s], any shape."""
        instants = finite_array("times", times, "s")
        turns = np.minimum(instants, self.end) / self.period
        # Whole cycles are subtracted first: sin(2 π n) is not 0 in floating point.
        angle = 2 * math.pi * (turns - np.floor(turns)) + self.phase
        level = self.mean + self.amplitude * np.sin(angle)
        started = instants >= 0 if history_points.side_of_jump(side) == "right" else instants > 0
        if self.control == "force":
            counts = started & (np.abs(level) >= NEGLIGIBLE * self._largest_size)
            return np.where(counts, level, 0.0)
        return np.where(started, level, min(self._first_level, 0.0))

    @property
    def least_force(self) -> float:
        """Least force of the whole history [N]."""
        return self.mean - abs(self.amplitude) if self.control == "force" else 0.0

    @property
    def _largest_size(self) -> float:
        return abs(self.mean) + abs(self.amplitude)

    @property
    def _first_level(self) -> float:
        return self.mean + self.amplitude * math.sin(self.phase)

    @property
    def largest_level(self) -> float:
        """Largest force [N] or approach [m] of the whole history."""
        return self.mean + abs(self.amplitude)

    @property
    def kinks(self) -> Floats:
        """Beginning and end of the cycles [s]."""
        return np.array([0.0, self.end])

    @property
    def jumps(self) -> Floats:
        """Time 0, unless the level starts at zero [s]."""
        starts = self.level_at(0.0)
        pulls = self.control == "force" and starts < 0
        return np.zeros(1) if starts > 0 or pulls else np.zeros(0)

    @property
    def longest_step(self) -> float:
        """A 128th of a period [s]."""
        return self.period / STEPS_PER_CYCLE

    @property
    def load_cycles(self) -> tuple[Cycle, ...]:
        """Whole periods; the first begins after the jump to the first level."""
        ends = [(k * self.period, "right") for k in range(self.cycles + 1)]
        return tuple(itertools.pairwise(ends))


def harmonic(  # noqa: PLR0913
    mean: float | None = None,
    amplitude: float | None = None,
    period: float | None = None,
    cycles: int | None = None,
    phase: float = 0.0,
    *,
    approach: float | None = None,
    eccentricity_x: float = 0.0,
    eccentricity_y: float = 0.0,
    tilt_x: float | None = None,
    tilt_y: float | None = None,
    stage_stiffness: float | None = None,
) -> HarmonicHistory:
    """Return a force or an approach that oscillates about a mean, then stays constant.

    Parameters
    ----------
    mean : float
        Mean force; a force that pulls at times needs adhesion between the bodies [N].
    amplitude : float
        Amplitude of the force [N] or, with `approach`, of the approach [m].
    period : float
        Time of a cycle, positive [s].
    cycles : int
        Number of cycles, at least 1.
    phase : float, optional
        The level is mean + amplitude sin(2 π t/period + phase) [rad].
    approach : float
        Instead of the mean force: the mean approach [m].
    eccentricity_x, eccentricity_y, tilt_x, tilt_y, stage_stiffness : float, optional
        As in `step`.

    Returns
    -------
    HarmonicHistory
        Exact at every instant. It starts with a jump unless its first level is zero. Runs take
        at least 128 steps a cycle, whatever the requested instants.

    Raises
    ------
    ValueError
        If not exactly one of mean and approach is given, something else is missing or not
        finite, or a tilt and an eccentricity contradict each other.

    Examples
    --------
    >>> load = harmonic(mean=10.0, amplitude=5.0, period=2.0, cycles=3)
    >>> load.level_at([0.0, 0.5, 1.5, 6.0, 99.0]).tolist()
    [10.0, 15.0, 5.0, 10.0, 10.0]
    """
    control, middle = prescribed_level("harmonic", mean, approach, force_is="mean")
    deviation = _number("amplitude", amplitude, control)
    if control == "force":
        refuse_stage(stage_stiffness)
    turns = whole("harmonic: cycles", cycles, 1, MOST_CYCLES)
    tail = _scalar_tail(control, eccentricity_x, eccentricity_y, tilt_x, tilt_y)
    return HarmonicHistory(
        control=control,
        mean=middle,
        amplitude=deviation,
        period=positive_duration("harmonic: period", period),
        cycles=turns,
        phase=_number("phase", phase),
        **tail,
        stage_stiffness=stage_stiffness,
    )


def _scalar_tail(
    control: Control,
    eccentricity_x: float,
    eccentricity_y: float,
    tilt_x: float | None,
    tilt_y: float | None,
) -> dict[str, Any]:
    if control == "approach":
        refuse_eccentric_approach(eccentricity_x, eccentricity_y)
    given = {
        "eccentricity_x": eccentricity_x,
        "eccentricity_y": eccentricity_y,
        "tilt_x": tilt_x,
        "tilt_y": tilt_y,
    }
    # The checks of a history with one point; below, a list of one number is refused as well.
    history_points.tail(HarmonicHistory, 1, **given)
    return {name: None if value is None else _number(name, value) for name, value in given.items()}


def _number(name: str, value: object, control: Control = "force") -> float:
    """Return field `name` of a harmonic load as a float, or refuse it."""
    unit = unit_of(HarmonicHistory, name, control) or ""
    return finite(f"harmonic: {name}", value, unit)
