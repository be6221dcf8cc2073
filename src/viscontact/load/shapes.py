"""The usual histories: step, ramp, triangle."""

from __future__ import annotations

from viscontact.load.history import ForceHistory
from viscontact.load.points import finite_number


def step(
    force: float | None = None,
    *,
    approach: float | None = None,
    eccentricity_x: float = 0.0,
    eccentricity_y: float = 0.0,
    tilt_x: float | None = None,
    tilt_y: float | None = None,
) -> ForceHistory:
    """Return a force put on at time 0 at once, then held.

    Parameters
    ----------
    force : float
        The force, zero or more [N].
    approach : None
        Approach control is not built yet.
    eccentricity_x, eccentricity_y, tilt_x, tilt_y : float, optional
        As in `ForceHistory`.

    Raises
    ------
    ValueError
        As `ForceHistory`, or if the force is missing or an approach is given.

    Examples
    --------
    >>> step(10e3).at(0.0).force
    10000.0
    """
    held = _force("step", force, approach)
    return ForceHistory([0.0], [held], eccentricity_x, eccentricity_y, tilt_x, tilt_y)


def ramp(
    force: float | None = None,
    duration: float | None = None,
    *,
    approach: float | None = None,
    eccentricity_x: float = 0.0,
    eccentricity_y: float = 0.0,
    tilt_x: float | None = None,
    tilt_y: float | None = None,
) -> ForceHistory:
    """Return a force that grows linearly from 0 at time 0, then is held.

    Parameters
    ----------
    force : float
        The force at the end of the ramp, zero or more [N].
    duration : float
        How long the ramp takes, positive [s].
    approach : None
        Approach control is not built yet.
    eccentricity_x, eccentricity_y, tilt_x, tilt_y : float, optional
        As in `ForceHistory`.

    Raises
    ------
    ValueError
        As `ForceHistory`, or if force or duration is missing or an approach is given.

    Examples
    --------
    >>> ramp(10.0, duration=4.0).force_at([1.0, 4.0, 9.0]).tolist()
    [2.5, 10.0, 10.0]
    """
    end = _force("ramp", force, approach)
    duration = _positive_duration("ramp: duration", duration)
    return ForceHistory([0.0, duration], [0.0, end], eccentricity_x, eccentricity_y, tilt_x, tilt_y)


def triangle(
    force: float | None = None,
    rise: float | None = None,
    fall: float | None = None,
    *,
    approach: float | None = None,
    eccentricity_x: float = 0.0,
    eccentricity_y: float = 0.0,
    tilt_x: float | None = None,
    tilt_y: float | None = None,
) -> ForceHistory:
    """Return a force that grows linearly from 0 at time 0 and falls back to 0.

    Parameters
    ----------
    force : float
        The force at the peak, zero or more [N].
    rise : float
        How long loading takes, positive [s].
    fall : float, optional
        How long unloading takes, positive; as long as `rise` if left out [s].
    approach : None
        Approach control is not built yet.
    eccentricity_x, eccentricity_y, tilt_x, tilt_y : float, optional
        As in `ForceHistory`.

    Raises
    ------
    ValueError
        As `ForceHistory`, or if force or rise is missing or an approach is given.

    Examples
    --------
    >>> triangle(10.0, rise=2.0, fall=4.0).force_at([1.0, 2.0, 3.0, 6.0]).tolist()
    [5.0, 10.0, 7.5, 0.0]
    """
    peak = _force("triangle", force, approach)
    rise = _positive_duration("triangle: rise", rise)
    fall = rise if fall is None else _positive_duration("triangle: fall", fall)
    times, forces = [0.0, rise, rise + fall], [0.0, peak, 0.0]
    return ForceHistory(times, forces, eccentricity_x, eccentricity_y, tilt_x, tilt_y)


def _force(history: str, force: float | None, approach: float | None) -> float:
    if approach is not None:
        raise ValueError(
            f"{history}: approach= is not built yet, got {approach!r}; give force= in N"
        )
    if force is None:
        raise ValueError(f"{history}: force is missing; give force= in N")
    return finite_number(f"{history}: force", force, "N")


def _positive_duration(name: str, value: float | None) -> float:
    duration = finite_number(name, value, "s")
    if duration <= 0:
        raise ValueError(
            f"{name} must be a positive time in s, got {value!r}; for a jump use step(...) or "
            "a repeated time in ForceHistory"
        )
    return duration
