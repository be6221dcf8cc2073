"""Vertical shift of moduli with temperature: assumed, or as a prior for what sets tell.

The modulus of a rubber or a melt is that of an entropic spring, G(T) ~ T ρ (Ferry, Viscoelastic
Properties of Polymers, 3rd ed., 1980, chapter 11): b_T = T ρ/(T_r ρ_r).
"""

from __future__ import annotations

from typing import Literal, TypedDict

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

Vertical = Literal["none", "rubber", "found"]
VERTICALS: tuple[Vertical, ...] = ("none", "rubber", "found")


class SuperpositionOptions(TypedDict, total=False):
    """Options of `build_master_curve` that concern the vertical shift."""

    vertical: Vertical | None
    expansion: float


# Prior of what is found, b_T = (T/T_r)^v: v = 1 of rubber elasticity and v = 0 lie at 2/3 of the
# standard deviation from the mean.
_EXPONENT, _EXPONENT_SPREAD = 0.5, 0.75
# Beside it each step may differ by this and by this multiple of ln(T2/T1).
_LEAST_STEP, _STEP_SPREAD = 0.005, 0.25


def entropic_logs(temperatures: Floats, expansion: float) -> Floats:
    """Logarithm of T ρ, up to a constant; expansion in volume [1/K]."""
    return np.asarray(np.log(temperatures) - np.log1p(expansion * (temperatures - temperatures[0])))


@dataclass(frozen=True, eq=False)
class VerticalShift:
    """Vertical shifts ln b of several sets: given, or with a prior."""

    temperatures: Floats
    given: Floats | None  # ln b, up to a constant; None where it is found

    @property
    def is_found(self) -> bool:
        """True if the sets decide."""
        return self.given is None

    @property
    def expected_steps(self) -> Floats:
        """Prior mean of the steps of ln b from each set to the next warmer one."""
        return _EXPONENT * np.diff(np.log(self.temperatures))

    @property
    def step_spreads(self) -> Floats:
        """Prior standard deviation of these steps."""
        own = _LEAST_STEP + _STEP_SPREAD * np.diff(np.log(self.temperatures))
        return np.hypot(own, _EXPONENT_SPREAD * np.diff(np.log(self.temperatures)))

    def covariance(self, trust: Floats, anchor: int) -> Floats:
        """Prior covariance of ln b relative to the set `anchor`; `trust` of each step."""
        common = np.log(self.temperatures / self.temperatures[anchor])
        own = _LEAST_STEP + _STEP_SPREAD * np.diff(np.log(self.temperatures))
        sets, steps = np.arange(self.temperatures.size)[:, None], np.arange(own.size)
        between = np.where(steps >= anchor, sets > steps, -1.0 * (sets <= steps))
        return np.asarray(
            _EXPONENT_SPREAD**2 * np.outer(common, common)
            + (between * (own**2 / trust)) @ between.T
        )

    def expected(self, anchor: int) -> Floats:
        """Prior mean of ln b relative to the set `anchor`."""
        return np.asarray(_EXPONENT * np.log(self.temperatures / self.temperatures[anchor]))

    def trust(self, logs: Floats) -> Floats:
        """Weight of the prior of each step: small where the sets contradict it strongly."""
        # Student's t with three degrees of freedom, by iteratively reweighted least squares.
        surprise = (np.diff(logs) - self.expected_steps) / self.step_spreads
        return np.asarray(4.0 / (3.0 + surprise**2))


def vertical_shift(kind: Vertical, temperatures: Floats, expansion: float = 0.0) -> VerticalShift:
    """Vertical shift by its name."""
    if kind == "found":
        return VerticalShift(temperatures, None)
    entropic = entropic_logs(temperatures, expansion)
    return VerticalShift(temperatures, entropic if kind == "rubber" else np.zeros_like(entropic))
