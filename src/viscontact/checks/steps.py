"""Doubts about a result: what a careful reader would ask before believing a number."""

from __future__ import annotations

import numpy as np

from viscontact.units.formatting import format_quantity

#: The largest pressure may exceed the largest that is told by this part.
UNREPORTED_PEAK = 0.1

#: Relative change of force or peak pressure that a step long against the law must not hide.
NOTABLE_CHANGE = 0.25


def step_warnings(duration: float, change: float) -> dict[str, str]:
    """Doubt about a time step too long for the law while the load or the pressure changes.

    Parameters
    ----------
    duration : float
        Length of such a step [s].
    change : float
        Largest relative change of force and peak pressure over it.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(step_warnings(10.0, change=0.5)), list(step_warnings(10.0, change=0.01))
    (['step'], [])
    """
    if change < NOTABLE_CHANGE:
        return {}
    return {
        "step": (
            f"a time step of {format_quantity(duration, 's', 3)} is long against the law's "
            f"relaxation times while force or peak pressure change by {change:.0%}; use more steps "
            "there"
        )
    }


def touch_warnings(duration: float, share: float) -> dict[str, str]:
    """Doubt about a load that grows from nothing in one step of a creeping body.

    The contact grows with a root of the force, which a straight line through one step follows
    badly: the pressure after it is off by a few per cent.

    Parameters
    ----------
    duration : float
        Length of the step [s].
    share : float
        Force at its end, over the largest of the history.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(touch_warnings(0.1, share=1.0)), list(touch_warnings(0.1, share=0.1))
    (['touch'], [])
    """
    if share <= NOTABLE_CHANGE:
        return {}
    return {
        "touch": (
            f"the load grows from nothing to {share:.0%} of its largest in a single step of "
            f"{format_quantity(duration, 's', 3)}; use several steps there, as the pressure starts "
            "with a root of time"
        )
    }


def release_warnings(duration: float, share: float) -> dict[str, str]:
    """Doubt about a contact of a creeping body that is lost in one step, as the load falls.

    The contact shrinks over it, and a straight line through one step gives the rim, which was left
    early, a load for too long: the dent that stays is off by up to a third.

    Parameters
    ----------
    duration : float
        Length of the step [s].
    share : float
        How far force or approach falls over it, over the largest of the history.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(release_warnings(0.1, share=1.0)), list(release_warnings(0.1, share=0.1))
    (['release'], [])
    """
    if share <= NOTABLE_CHANGE:
        return {}
    return {
        "release": (
            f"the contact is lost as the load falls by {share:.0%} of its largest in a single step "
            f"of {format_quantity(duration, 's', 3)}; use several steps there, as the dent that "
            "stays depends on them"
        )
    }


def unreported_peak_warnings(peak: float, time: float, told: float) -> dict[str, str]:
    """Doubt about instants between which more has happened than at them.

    Parameters
    ----------
    peak : float
        Largest pressure over all steps [Pa].
    time : float
        When it was [s].
    told : float
        Largest pressure over the instants that were asked for [Pa].

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(unreported_peak_warnings(2e6, 0.3, told=1e6))
    ['untold']
    >>> unreported_peak_warnings(1e6, 0.3, told=1e6)
    {}
    """
    if peak <= (1 + UNREPORTED_PEAK) * told:
        return {}
    return {
        "untold": (
            "between the instants asked for the peak pressure reaches "
            f"{format_quantity(peak, 'Pa')}, at t = {format_quantity(time, 's', 6)}, and "
            f"{format_quantity(told, 'Pa')} is the largest that the result tells; ask for an "
            "instant there, or for more steps"
        )
    }


def relative_change(before: float, after: float) -> float:
    """Change over the larger of two values; zero if both are."""
    return abs(after - before) / max(abs(after), abs(before), np.finfo(float).tiny)
