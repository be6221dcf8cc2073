"""Steady motion: constant speeds along an axis, under a constant load."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.history import LoadHistory, LoadPoint
from viscontact.bodies.loads.motion import AtOrigin, checked_creepage, checked_lateral_creepage
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import finite, real_array


@dataclass(frozen=True)
class SteadyMotion(AtOrigin):
    """Motion towards + along an axis at constant speeds [m/s]; the grid moves with the body."""

    speeds: tuple[float, ...]
    along: str
    rolling: bool | None = None
    #: Surface speeds of a body that rolls over its travel, less 1 [-]; none without traction.
    creepages: tuple[float, ...] = ()
    #: Speed of its surface to the right of its travel, over that, beside each of them [-].
    lateral_creepage: float | None = None
    #: Rotation of its surface over the way, from x to y, beside each of them [rad/m].
    spin: float | None = None

    def __post_init__(self) -> None:
        checked_speeds("speed", self.speeds)
        checked_creepages(self.creepages, rolling=self.rolling)
        first = self.creepages[0] if self.creepages else None
        checked_lateral_creepage(self.lateral_creepage, creepage=first)
        checked_spin(self.spin, creepage=first)


def steady_motion(
    speed: ArrayLike,
    along: str,
    rolling: bool | None,
    creepage: ArrayLike | None = None,
    lateral_creepage: float | None = None,
    spin: float | None = None,
) -> SteadyMotion:
    """Return the motion of the arguments of `steady`."""
    if along not in ("x", "y"):
        raise ValueError(f"along must be 'x' or 'y', got {along!r}")
    if rolling is not None and not isinstance(rolling, bool | np.bool_):
        raise ValueError(f"rolling must be True, False or None, got {rolling!r}")
    creepages = () if creepage is None else checked_creepages(creepage, rolling=rolling)
    if creepage is not None and not creepages:
        raise ValueError("creepage: at least one is needed, got none; leave the argument out")
    first = creepages[0] if creepages else None
    lateral = checked_lateral_creepage(lateral_creepage, creepage=first)
    speeds = tuple(checked_speeds("speed", speed).tolist())
    turning = checked_spin(spin, creepage=first)
    return SteadyMotion(speeds, along, rolling, creepages, lateral, turning)


def checked_spin(spin: float | None, *, creepage: float | None) -> float | None:
    """Return a spin beside a creepage [rad/m], or None; else ValueError."""
    if spin is None:
        return None
    number = finite("spin", spin, "rad/m")
    if creepage is None:
        raise ValueError(
            f"spin goes with a creepage, which may be 0, got spin={spin!r} without one; give the "
            "creepage, too, as in creepage=0.0"
        )
    return number


def checked_creepages(given: ArrayLike, *, rolling: bool | None) -> tuple[float, ...]:
    """Return distinct creepages of a body that does not slide, from one or a list of them [-]."""
    creepages = np.atleast_1d(real_array("creepage", given, "1"))
    if creepages.ndim != 1:
        raise ValueError(f"creepage must be a number or a list of them, got {given!r}")
    for each in creepages.tolist():
        checked_creepage(each, rolling=rolling)
    found, count = np.unique_counts(creepages)
    if (count > 1).any():
        raise ValueError(f"creepage: each is needed once, got {float(found[count > 1][0]):g} twice")
    return tuple(creepages.tolist())


def checked_speeds(name: str, given: Any) -> Floats:
    """Return distinct positive speeds, from one or a list of them [m/s]."""
    speeds = np.atleast_1d(real_array(name, given, "m/s"))
    if speeds.ndim != 1 or not speeds.size or not (np.isfinite(speeds) & (speeds > 0)).all():
        raise ValueError(f"{name} must be positive and finite [m/s], got {given!r}")
    found, count = np.unique_counts(speeds)
    if (count > 1).any():
        twice = format_quantity(found[count > 1][0], "m/s")
        raise ValueError(f"{name}: each speed is needed once, got {twice} twice")
    return speeds


def constant_load(load: LoadHistory) -> LoadPoint:
    """Return the positive load of a history that is constant from time 0; else ValueError."""
    held = load.at(0.0)
    later = [
        load.at(float(time), side=side)
        for time in load.kinks
        for side in ("left", "right")
        if time > 0 or side == "right"  # before time 0 there is no load
    ]
    changes = load.control == "mixed" or np.isfinite(load.longest_step)
    if changes or any(point != held for point in later):
        raise ValueError(
            "load: a steady motion has a constant load, and this one changes in time; use a step "
            "of force or approach"
        )
    if held.force is not None and held.force <= 0:
        raise ValueError(
            "load: the force must be positive in steady motion, got "
            f"{format_quantity(held.force, 'N')}"
        )
    return held
