"""Standard piecewise linear loads: step, ramp, triangle."""

from __future__ import annotations

from collections.abc import Sequence

from viscontact.bodies.loads.approach import ApproachHistory
from viscontact.bodies.loads.force import ForceHistory
from viscontact.bodies.loads.history import Control
from viscontact.bodies.loads.level import (
    positive_duration,
    prescribed_level,
    refuse_eccentric_approach,
    refuse_stage,
)


def step(
    force: float | None = None,
    *,
    approach: float | None = None,
    eccentricity_x: float = 0.0,
    eccentricity_y: float = 0.0,
    tilt_x: float | None = None,
    tilt_y: float | None = None,
    stage_stiffness: float | None = None,
) -> ForceHistory | ApproachHistory:
    """Return a force or an approach applied suddenly at time 0, then held.

    Parameters
    ----------
    force : float
        The force; a negative one pulls, which needs adhesion between the bodies [N].
    approach : float
        Instead of the force: the approach, positive when the bodies come closer [m].
    eccentricity_x, eccentricity_y : float, optional
        Position of the force [m]; not with an approach.
    tilt_x, tilt_y : float, optional
        Prescribed slopes; free of moment where left out [rad].
    stage_stiffness : float, optional
        With an approach: that of a stage on which the body hangs by a spring, as in
        `ApproachHistory` [N/m].

    Returns
    -------
    ForceHistory or ApproachHistory
        The history.

    Raises
    ------
    ValueError
        As the history, or if not exactly one of force and approach is given.

    Examples
    --------
    >>> step(10e3).at(0.0).force
    10000.0
    >>> step(approach=1e-5).at(0.0).approach
    1e-05
    """
    control, held = prescribed_level("step", force, approach)
    tail = eccentricity_x, eccentricity_y, tilt_x, tilt_y
    return _history(control, [0.0], [held], *tail, stage_stiffness)


def ramp(  # noqa: PLR0913
    force: float | None = None,
    duration: float | None = None,
    *,
    approach: float | None = None,
    eccentricity_x: float = 0.0,
    eccentricity_y: float = 0.0,
    tilt_x: float | None = None,
    tilt_y: float | None = None,
    stage_stiffness: float | None = None,
) -> ForceHistory | ApproachHistory:
    """Return a force or an approach that grows linearly from 0 at time 0, then is held.

    Parameters
    ----------
    force : float
        The force at the end of the ramp, as in `step` [N].
    duration : float
        Duration of the ramp, positive [s].
    approach : float
        Instead of the force: the approach at the end of the ramp [m].
    eccentricity_x, eccentricity_y, tilt_x, tilt_y, stage_stiffness : float, optional
        As in `step`.

    Returns
    -------
    ForceHistory or ApproachHistory
        The history.

    Raises
    ------
    ValueError
        As the history, if not exactly one of force and approach is given, or without duration.

    Examples
    --------
    >>> ramp(10.0, duration=4.0).force_at([1.0, 4.0, 9.0]).tolist()
    [2.5, 10.0, 10.0]
    """
    control, end = prescribed_level("ramp", force, approach)
    duration = positive_duration("ramp: duration", duration)
    times, levels = [0.0, duration], [0.0, end]
    tail = eccentricity_x, eccentricity_y, tilt_x, tilt_y
    return _history(control, times, levels, *tail, stage_stiffness)


def triangle(  # noqa: PLR0913
    force: float | None = None,
    rise: float | None = None,
    fall: float | None = None,
    *,
    approach: float | None = None,
    eccentricity_x: float = 0.0,
    eccentricity_y: float = 0.0,
    tilt_x: float | None = None,
    tilt_y: float | None = None,
    stage_stiffness: float | None = None,
) -> ForceHistory | ApproachHistory:
    """Return a force or an approach that grows linearly from 0 at time 0 and falls back to 0.

    Parameters
    ----------
    force : float
        The force at the peak, as in `step` [N].
    rise : float
        Duration of loading, positive [s].
    fall : float, optional
        Duration of unloading, positive; equal to `rise` if left out [s].
    approach : float
        Instead of the force: the approach at the peak [m].
    eccentricity_x, eccentricity_y, tilt_x, tilt_y, stage_stiffness : float, optional
        As in `step`.

    Returns
    -------
    ForceHistory or ApproachHistory
        The history.

    Raises
    ------
    ValueError
        As the history, if not exactly one of force and approach is given, or without rise.

    Examples
    --------
    >>> triangle(10.0, rise=2.0, fall=4.0).force_at([1.0, 2.0, 3.0, 6.0]).tolist()
    [5.0, 10.0, 7.5, 0.0]
    """
    control, peak = prescribed_level("triangle", force, approach)
    rise = positive_duration("triangle: rise", rise)
    fall = rise if fall is None else positive_duration("triangle: fall", fall)
    times, levels = [0.0, rise, rise + fall], [0.0, peak, 0.0]
    tail = eccentricity_x, eccentricity_y, tilt_x, tilt_y
    return _history(control, times, levels, *tail, stage_stiffness)


def _history(  # noqa: PLR0913
    control: Control,
    times: Sequence[float],
    levels: Sequence[float],
    eccentricity_x: float,
    eccentricity_y: float,
    tilt_x: float | None,
    tilt_y: float | None,
    stage_stiffness: float | None,
) -> ForceHistory | ApproachHistory:
    if control == "force":
        refuse_stage(stage_stiffness)
        return ForceHistory(times, levels, eccentricity_x, eccentricity_y, tilt_x, tilt_y)
    refuse_eccentric_approach(eccentricity_x, eccentricity_y)
    return ApproachHistory(times, levels, tilt_x, tilt_y, stage_stiffness)
