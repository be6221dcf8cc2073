"""Warnings about time steps: too long for the law, for loading, or for unloading."""

from __future__ import annotations

import numpy as np

from viscontact.units.formatting import format_quantity

#: Part by which the largest pressure may exceed the largest reported one.
UNREPORTED_PEAK = 0.1

#: Relative change of force or peak pressure over one long step that causes a warning.
NOTABLE_CHANGE = 0.25


def step_warnings(duration: float, change: float) -> dict[str, str]:
    """Warn of a time step [s] too long for the law, by the `change` of load and peak [-]."""
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
    """Warn of a load on a creeping body that grows from zero in one step [s]."""
    # The contact grows with a root of the force, which one linear step follows badly: the pressure
    # after it is off by a few per cent. `share` is the force over the largest of the history.
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
    """Warn of a contact of a creeping body that is lost in one step [s] as the load falls."""
    # Over one linear step the rim, which loses contact early, is loaded for too long: the remaining
    # indentation has an error of up to a third. `share` is the fall over the largest load.
    if share <= NOTABLE_CHANGE:
        return {}
    return {
        "release": (
            f"the contact is lost as the load falls by {share:.0%} of its largest in a single step "
            f"of {format_quantity(duration, 's', 3)}; use several steps there, as the "
            "remaining indentation depends on them"
        )
    }


def unreported_peak_warnings(peak: float, time: float, reported: float) -> dict[str, str]:
    """Warn of a peak pressure [Pa] between the requested times that exceeds the reported one."""
    if peak <= (1 + UNREPORTED_PEAK) * reported:
        return {}
    return {
        "unreported": (
            "between the requested times the peak pressure reaches "
            f"{format_quantity(peak, 'Pa')}, at t = {format_quantity(time, 's', 6)}, and "
            f"{format_quantity(reported, 'Pa')} is the largest that the result holds; request a "
            "time there, or more steps"
        )
    }


def relative_change(before: float, after: float) -> float:
    """Change over the larger of two values; zero if both are."""
    return abs(after - before) / max(abs(after), abs(before), np.finfo(float).tiny)
