"""Thermal expansion of layers: how much thicker they are, and the load that the contact has then.

Layers that are thicker by w(T) narrow the gap as an approach does:

    gap = initial gap + displacement - approach - w(T).

A layer that cannot expand laterally, with σ_z = 0, has the strain (1 + ν)/(1 - ν) α ΔT across it
(from Hooke's law with the strain α ΔT: Timoshenko & Goodier 1951, Theory of Elasticity); a layer
that can, α ΔT. Both hold at any time after a change of temperature while Poisson's ratio is
constant. With an elastic bulk modulus K it follows the stress relaxation, from 9K/(3K + 4G) with
the instant shear modulus to the same with the relaxed one, which is taken.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import field, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import LoadHistory, LoadPoint
from viscontact.bodies.loads.approach import NEAR_KINK, ROUNDING
from viscontact.bodies.loads.history import Control, Cycle
from viscontact.bodies.loads.history_points import TAIL
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.materials.layers import Layer, Layered
from viscontact.bodies.materials.material import Material
from viscontact.units.numbers import finite_array, store

#: Time at which stress has relaxed, of a law that goes on relaxing [s].
LATE = 1e15


@dataclass(frozen=True, eq=False)
class Thickening:
    """Growth of the thickness of all layers of the bodies under a temperature."""

    temperature: TemperatureHistory
    rates: Floats  # of each layer, after all relaxation [m/K]
    origins: Floats  # temperatures at which each has its thickness [K]
    surplus: float = 0.0  # relative error at once after a change, before stress has relaxed [-]

    def at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Growth at times, any shape [m]."""
        warmer = self.temperature.at(times, side=side)[..., None] - self.origins
        return np.asarray(warmer @ self.rates)


def thickening_of(
    bodies: Sequence[Material | Layered], temperature: TemperatureHistory | None
) -> Thickening | None:
    """Growth of the layers of bodies; None if none expands, ValueError without a temperature."""
    layers = [
        (layer, expansion_ratios(layer.material) if held else (1.0, 1.0))
        for body in bodies
        if isinstance(body, Layered)
        for layer, held in _held_layers(body)
        if layer.expands
    ]
    if not layers:
        return None
    if temperature is None:
        raise ValueError(
            "temperature: a layer has a thermal expansion, and its thickness follows from the "
            "temperature, got none; give temperature, or leave expansion and expansion_from out"
        )
    thick = np.array([(each.expansion or 0.0) * each.thickness for each, _ in layers])
    instant, relaxed = np.array([ratios for _, ratios in layers]).T
    origins = np.array([each.expansion_from for each, _ in layers])
    surplus = float(np.max(relaxed / instant)) - 1
    return Thickening(temperature, relaxed * thick, origins, surplus)


def _held_layers(body: Layered) -> list[tuple[Layer, bool]]:
    """The layers, the lowest first, each with True if the base holds it laterally."""
    assert not isinstance(body.bonded, bool)
    held, found = True, list[tuple[Layer, bool]]()
    for layer, bonded in zip(reversed(body.layers), reversed(list(body.bonded)), strict=True):
        if not bonded:
            held = False
        elif found and not held:
            _refuse_bending(layer, found[-1][0])
        found.append((layer, held))
    return found


def _refuse_bending(upper: Layer, lower: Layer) -> None:
    """Refuse layers that slide on the base together and would expand differently."""
    if (upper.expansion, upper.expansion_from) == (lower.expansion, lower.expansion_from):
        return
    if upper.expands or lower.expands:
        raise ValueError(
            "material: layers that are bonded to each other, and slide on what is beneath them, "
            "must expand alike, as their strain would depend on both; give them the same expansion "
            "and expansion_from, or bond the lower one"
        )


def expansion_ratios(material: Material) -> tuple[float, float]:
    """Strain across a layer that is held laterally, over α ΔT: at once, and relaxed [-]."""
    ratio, bulk = material.poisson_ratio, material.bulk_modulus
    if ratio is not None:
        return (1 + ratio) / (1 - ratio), (1 + ratio) / (1 - ratio)
    assert bulk is not None  # exactly one is given
    instant, relaxed = (float(material.law(time)) for time in (0.0, LATE))
    # With G = 1/(2 Phi).
    shear = (1 / (2 * each) if each > 0 else math.inf for each in (instant, relaxed))
    first, last = (9 * bulk / (3 * bulk + 4 * each) for each in shear)
    return first, last


@dataclass(frozen=True, eq=False)
class ThickenedLoad(LoadHistory):
    """A load on layers that expand: an approach with the growth of their thickness added."""

    load: LoadHistory
    thickening: Thickening

    #: Quantity that the load prescribes.
    control: Control | Literal["mixed"] = field(init=False)

    def __post_init__(self) -> None:
        tail = {name: getattr(self.load, name) for name in TAIL}
        store(self, control=self.load.control, **tail)

    def at(self, time: float, *, side: str = "right") -> LoadPoint:
        """Return the load at an instant [s], after a jump or before it ("left")."""
        point = self.load.at(time, side=side)
        if point.approach is None:
            return point
        return replace(point, approach=point.approach + float(self._growth(time, side)))

    def level_of(self, point: LoadPoint) -> float:
        """Return the level of a load, as `level_at` gives it."""
        return self.load.level_of(point)

    def level_at(self, times: ArrayLike, *, side: str = "right") -> Floats:
        """Return the force [N], or the approach and growth [m], at many instants [s]."""
        if self.control == "force":
            return self.load.level_at(times, side=side)
        if self.control == "approach":
            return np.asarray(self.load.level_at(times, side=side) + self._growth(times, side))
        instants = finite_array("times", times, "s")
        points = [self.at(time, side=side) for time in instants.ravel().tolist()]
        levels = [self.load.level_of(point) for point in points]
        return np.array(levels).reshape(instants.shape)

    @property
    def least_force(self) -> float:
        """Least prescribed force [N]."""
        return self.load.least_force

    @cached_property
    def largest_level(self) -> float:
        """Largest level of the whole history."""
        if self.control == "force":
            return self.load.largest_level
        # Between kinks the growth is linear, and so at most that at either end.
        kinks = self.kinks
        sides = ("left", "right")
        if math.isfinite(self.load.longest_step):  # a bound
            growth = max(float(self._growth(kinks, side).max()) for side in sides)
            return self.load.largest_level + growth
        return max(float(self.level_at(kinks, side=side).max()) for side in sides)

    @cached_property
    def kinks(self) -> Floats:
        """Kinks of the load and of the temperature, increasing, time 0 among them [s]."""
        temperature = self.thickening.temperature
        own = np.zeros(0) if temperature.is_constant else temperature.kinks
        return np.unique(np.concatenate([[0.0], self.load.kinks, own]))

    @cached_property
    def jumps(self) -> Floats:
        """Kinks at which bodies that may touch jump against each other, increasing [s]."""
        own = self.load.jumps
        if self.control == "force":
            return own
        kinks = self.kinks
        before, after = self.level_at(kinks, side="left"), self.level_at(kinks)
        pressed = np.maximum(before, after) > 0
        if np.any(self.tilt_x) or np.any(self.tilt_y):
            pressed[:] = True
        return np.union1d(own, kinks[(before != after) & pressed])

    @property
    def longest_step(self) -> float:
        """Longest step on which the load is nearly linear [s]."""
        return self.load.longest_step

    @property
    def curved_until(self) -> float:
        """Time up to which the load is curved [s]."""
        return self.load.curved_until

    @property
    def load_cycles(self) -> tuple[Cycle, ...]:
        """Cycles of the load."""
        return self.load.load_cycles

    @cached_property
    def touches(self) -> Floats:
        """Instants between kinks at which undeformed bodies come to touch, increasing [s]."""
        tilted = np.any(self.tilt_x) or np.any(self.tilt_y)
        if self.control != "approach" or tilted or math.isfinite(self.longest_step):
            return self.load.touches
        kinks = self.kinks
        below = self.level_at(kinks[:-1])
        above = self.level_at(kinks[1:], side="left")
        rises = (below < 0) & (above > 0)
        begin, end, low, high = kinks[:-1][rises], kinks[1:][rises], below[rises], above[rises]
        instants = (begin + (end - begin) * (low / (low - high))) * (1 - ROUNDING)
        apart = np.minimum(instants - begin, end - instants) > NEAR_KINK * instants
        return np.asarray(instants[apart])

    def _growth(self, times: ArrayLike, side: str) -> Floats:
        """Growth of the layers [m]; before time 0 there is no contact that it could press."""
        instants = np.asarray(times, dtype=float)
        begun = instants >= 0 if side == "right" else instants > 0
        return np.where(begun, self.thickening.at(instants, side=side), 0.0)
