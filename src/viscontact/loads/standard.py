"""Standard load histories: step, ramp, triangle, harmonic."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from viscontact.loads import arguments
from viscontact.loads.approach import ApproachHistory
from viscontact.loads.force import ForceHistory
from viscontact.loads.harmonic import HarmonicHistory
from viscontact.loads.history import Control
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import finite, unit_of, whole

#: Upper limit on the cycles of a harmonic load; each takes dozens of steps.
MOST_CYCLES = 100_000


def step(
    force: float | None = None,
    *,
    approach: float | None = None,
    eccentricity_x: float = 0.0,
    eccentricity_y: float = 0.0,
    tilt_x: float | None = None,
    tilt_y: float | None = None,
) -> ForceHistory | ApproachHistory:
    """Return a force or an approach applied suddenly at time 0, then held.

    Parameters
    ----------
    force : float
        The force, zero or more [N].
    approach : float
        Instead of the force: the approach, positive when the bodies come closer [m].
    eccentricity_x, eccentricity_y : float, optional
        Where the force acts [m]; not with an approach.
    tilt_x, tilt_y : float, optional
        Prescribed slopes; free of moment where left out [rad].

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
    control, held = _control("step", force, approach)
    return _history(control, [0.0], [held], eccentricity_x, eccentricity_y, tilt_x, tilt_y)


def ramp(
    force: float | None = None,
    duration: float | None = None,
    *,
    approach: float | None = None,
    eccentricity_x: float = 0.0,
    eccentricity_y: float = 0.0,
    tilt_x: float | None = None,
    tilt_y: float | None = None,
) -> ForceHistory | ApproachHistory:
    """Return a force or an approach that grows linearly from 0 at time 0, then is held.

    Parameters
    ----------
    force : float
        The force at the end of the ramp, zero or more [N].
    duration : float
        How long the ramp takes, positive [s].
    approach : float
        Instead of the force: the approach at the end of the ramp [m].
    eccentricity_x, eccentricity_y, tilt_x, tilt_y : float, optional
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
    control, end = _control("ramp", force, approach)
    duration = _positive_duration("ramp: duration", duration)
    times, levels = [0.0, duration], [0.0, end]
    return _history(control, times, levels, eccentricity_x, eccentricity_y, tilt_x, tilt_y)


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
) -> ForceHistory | ApproachHistory:
    """Return a force or an approach that grows linearly from 0 at time 0 and falls back to 0.

    Parameters
    ----------
    force : float
        The force at the peak, zero or more [N].
    rise : float
        How long loading takes, positive [s].
    fall : float, optional
        How long unloading takes, positive; as long as `rise` if left out [s].
    approach : float
        Instead of the force: the approach at the peak [m].
    eccentricity_x, eccentricity_y, tilt_x, tilt_y : float, optional
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
    control, peak = _control("triangle", force, approach)
    rise = _positive_duration("triangle: rise", rise)
    fall = rise if fall is None else _positive_duration("triangle: fall", fall)
    times, levels = [0.0, rise, rise + fall], [0.0, peak, 0.0]
    return _history(control, times, levels, eccentricity_x, eccentricity_y, tilt_x, tilt_y)


def harmonic(
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
) -> HarmonicHistory:
    """Return a force or an approach that oscillates about a mean, then stays constant.

    Parameters
    ----------
    mean : float
        Mean force, not less than the amplitude [N].
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
    eccentricity_x, eccentricity_y, tilt_x, tilt_y : float, optional
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
        finite, a force would be negative, or a tilt and an eccentricity contradict each other.

    Examples
    --------
    >>> load = harmonic(mean=10.0, amplitude=5.0, period=2.0, cycles=3)
    >>> load.level_at([0.0, 0.5, 1.5, 6.0, 99.0]).tolist()
    [10.0, 15.0, 5.0, 10.0, 10.0]
    """
    control, middle = _control("harmonic", mean, approach, force_is="mean")
    deviation = _number("amplitude", amplitude, control)
    if control == "force" and abs(deviation) > middle:
        raise ValueError(
            "harmonic: the force must never be negative, but swings between "
            f"{format_quantity(middle - deviation, 'N', 9)} and "
            f"{format_quantity(middle + deviation, 'N', 9)}; give a mean of at least the amplitude"
        )
    turns = whole("harmonic: cycles", cycles, 1, MOST_CYCLES)
    tail = _scalar_tail(control, eccentricity_x, eccentricity_y, tilt_x, tilt_y)
    return HarmonicHistory(
        control=control,
        mean=middle,
        amplitude=deviation,
        period=_positive_duration("harmonic: period", period),
        cycles=turns,
        phase=_number("phase", phase),
        **tail,
    )


def _history(
    control: Control,
    times: Sequence[float],
    levels: Sequence[float],
    eccentricity_x: float,
    eccentricity_y: float,
    tilt_x: float | None,
    tilt_y: float | None,
) -> ForceHistory | ApproachHistory:
    if control == "force":
        return ForceHistory(times, levels, eccentricity_x, eccentricity_y, tilt_x, tilt_y)
    _refuse_eccentric_approach(eccentricity_x, eccentricity_y)
    return ApproachHistory(times, levels, tilt_x, tilt_y)


def _scalar_tail(
    control: Control,
    eccentricity_x: float,
    eccentricity_y: float,
    tilt_x: float | None,
    tilt_y: float | None,
) -> dict[str, Any]:
    if control == "approach":
        _refuse_eccentric_approach(eccentricity_x, eccentricity_y)
    given = {
        "eccentricity_x": eccentricity_x,
        "eccentricity_y": eccentricity_y,
        "tilt_x": tilt_x,
        "tilt_y": tilt_y,
    }
    # The checks of a history with one point; below, a list of one number is refused as well.
    arguments.tail(HarmonicHistory, 1, **given)
    return {name: None if value is None else _number(name, value) for name, value in given.items()}


def _number(name: str, value: object, control: Control = "force") -> float:
    """Return field `name` of a harmonic load as a float, or refuse it."""
    unit = unit_of(HarmonicHistory, name, control) or ""
    return finite(f"harmonic: {name}", value, unit)


def _refuse_eccentric_approach(eccentricity_x: float, eccentricity_y: float) -> None:
    for name, value in (("eccentricity_x", eccentricity_x), ("eccentricity_y", eccentricity_y)):
        if value:
            raise ValueError(
                f"{name} goes with a force, got {format_quantity(value, 'm', 9)} with an approach: "
                "no force is prescribed that could act there; leave it out, or prescribe the tilt"
            )


def _control(
    history: str, force: float | None, approach: float | None, force_is: str = "force"
) -> tuple[Control, float]:
    if (force is None) == (approach is None):
        what = "missing" if force is None else "given twice over"
        raise ValueError(
            f"{history}: {force_is} is {what}; give {force_is}= in N or approach= in m, and only "
            "one of them"
        )
    if approach is not None:
        return "approach", finite(f"{history}: approach", approach, "m")
    return "force", finite(f"{history}: {force_is}", force, "N")


def _positive_duration(name: str, value: float | None) -> float:
    duration = finite(name, value, "s")
    if duration <= 0:
        raise ValueError(
            f"{name} must be a positive time in s, got {value!r}; for a jump use step(...) or "
            "a repeated time in ForceHistory"
        )
    return duration
