"""Frequency response of an elastic surface to waves of normal pressure."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

import numpy as np

from viscontact.backend.arrays import Numbers
from viscontact.backend.lazy_dataclass import dataclass


class SurfaceResponse(ABC):
    """Ratio L(q): p cos(q x) displaces the surface by (2/q) L p cos(q x) per J; inwards > 0."""

    @property
    @abstractmethod
    def short_waves(self) -> float:
        """Limit of L for short waves [-]."""

    @property
    @abstractmethod
    def long_waves(self) -> float:
        """Limit of L for long waves [-]; 0 on a rigid base."""

    @property
    @abstractmethod
    def length(self) -> float:
        """Thickness of the thinnest layer, inf for a half-space [m]."""

    @abstractmethod
    def ratio(self, wave_number: Numbers) -> Numbers:
        """L at wave numbers [1/m], not zero; analytic, so that they may be complex [-]."""

    @property
    @abstractmethod
    def mean_displacement(self) -> float:
        """Displacement per uniform p and J, without strain across [m]; inf without a rigid base."""


@dataclass(frozen=True)
class HalfSpaceResponse(SurfaceResponse):
    """Response of a half-space to itself: L = 1."""

    short_waves = 1.0
    long_waves = 1.0
    length = math.inf

    def ratio(self, wave_number: Numbers) -> Numbers:
        """L at wave numbers [1/m]."""
        return np.ones_like(wave_number)

    @property
    def mean_displacement(self) -> float:
        """Infinite: a half-space has no support."""
        return math.inf


HALF_SPACE = HalfSpaceResponse()


@dataclass(frozen=True)
class SummedResponse(SurfaceResponse):
    """Weighted sum of surface responses, as of two bodies pressed on each other."""

    parts: tuple[SurfaceResponse, ...]
    weights: tuple[float, ...]

    @property
    def short_waves(self) -> float:
        """Limit of L for short waves [-]."""
        return self._sum([part.short_waves for part in self.parts])

    @property
    def long_waves(self) -> float:
        """Limit of L for long waves [-]."""
        return self._sum([part.long_waves for part in self.parts])

    @property
    def length(self) -> float:
        """The shortest of the parts' [m]."""
        return min(part.length for part in self.parts)

    def ratio(self, wave_number: Numbers) -> Numbers:
        """L at wave numbers [1/m]."""
        pairs = zip(self.weights, self.parts, strict=True)
        return np.asarray(sum(weight * part.ratio(wave_number) for weight, part in pairs))

    @property
    def mean_displacement(self) -> float:
        """The weighted sum [m]; infinite if one of the parts is."""
        means = [part.mean_displacement for part in self.parts]
        return self._sum(means) if np.isfinite(means).all() else math.inf

    def _sum(self, values: list[float]) -> float:
        return math.fsum(w * value for w, value in zip(self.weights, values, strict=True) if w)
