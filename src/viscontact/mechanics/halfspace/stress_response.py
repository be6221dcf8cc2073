"""Stresses inside an elastic body under a load on its surface: of one cell, and of a wave."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable

import numpy as np

from viscontact.backend.arrays import Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.shear_stress_influence import shear_stress_coefficients
from viscontact.mechanics.halfspace.stack_waves import WaveStresses
from viscontact.mechanics.halfspace.stress_influence import EXCHANGED, stress_coefficients

#: Six components over wave numbers, real: at a depth they are `StressResponse.phases` times these.
WaveTensors = Callable[[float], list[Floats]]


class StressResponse(ABC):
    """Stresses per unit load on the surface of a body that is homogeneous along it."""

    #: Axis of the load, a traction along x (0) or y (1); None for a pressure.
    axis: int | None = None

    @abstractmethod
    def coefficients(self, x_edges: Floats, y_edges: Floats, depth: float) -> Floats:
        """Stresses at a point per unit load on cells, as in `stress_coefficients` [-]."""

    @abstractmethod
    def tensors(self, kx: Floats, ky: Floats) -> WaveTensors:
        """Stresses over the depth [m] under waves of the load, of wave numbers [1/m]."""

    @abstractmethod
    def poisson_ratio_at(self, depth: float) -> float:
        """Poisson's ratio at a depth [m]; ValueError where there are no stresses."""

    @property
    def phases(self) -> tuple[complex, ...]:
        """Factors of the six components of `tensors`: 1, or ±1j where they are odd in x and y."""
        return (1, 1, 1, -1j, -1j, 1) if self.axis is None else (1j, 1j, 1j, 1, 1, 1j)

    @property
    def exchanged(self) -> StressResponse:
        """The same with x and y exchanged."""
        return self


class PressureStress(StressResponse):
    """Stresses under a pressure, whose waves have the same stresses in all directions."""

    @abstractmethod
    def waves(self, wave_number: Floats) -> Callable[[float], WaveStresses]:
        """Stresses over the depth [m] under a wave of pressure, of wave numbers > 0 [1/m]."""

    def tensors(self, kx: Floats, ky: Floats) -> WaveTensors:
        """Stresses of a wave (Johnson 1985, section 13.2), turned to its direction.

        The mean pressure causes no strain along the surface: σxx = σyy = ν/(1 - ν) σzz.
        """
        q = np.hypot(kx, ky)
        q[0, 0] = 1.0  # the mean has no direction; it is set below
        east, north = kx / q, ky / q
        stresses = self.waves(q)

        def at(depth: float) -> list[Floats]:
            own = stresses(depth)
            parts = (own.along, own.across, own.normal, own.shear)
            ahead, aside, normal, shear = (np.asarray(part * own.decay) for part in parts)
            xx, yy = east**2 * ahead + north**2 * aside, north**2 * ahead + east**2 * aside
            ratio = self.poisson_ratio_at(depth)
            xx[0, 0] = yy[0, 0] = -ratio / (1 - ratio)
            normal[0, 0] = -1.0
            return [xx, yy, normal, north * shear, east * shear, east * north * (ahead - aside)]

        return at


@dataclass(frozen=True)
class HalfSpaceStress(PressureStress):
    """Stresses in a half-space under a pressure: they depend on its Poisson's ratio only."""

    poisson_ratio: float

    def coefficients(self, x_edges: Floats, y_edges: Floats, depth: float) -> Floats:
        """Love's closed form [-]."""
        return stress_coefficients(x_edges, y_edges, depth, self.poisson_ratio)

    def waves(self, wave_number: Floats) -> Callable[[float], WaveStresses]:
        """Johnson 1985, section 13.2: each wave decays as exp(-q z)."""

        def at(depth: float) -> WaveStresses:
            qz = wave_number * depth
            return WaveStresses(-(1 - qz), -2 * self.poisson_ratio, -(1 + qz), -qz, np.exp(-qz))

        return at

    def poisson_ratio_at(self, depth: float) -> float:
        """Poisson's ratio of the half-space."""
        return self.poisson_ratio


@dataclass(frozen=True)
class HalfSpaceShearStress(StressResponse):
    """Stresses in a half-space under a traction along x or y."""

    poisson_ratio: float
    axis: int

    def coefficients(self, x_edges: Floats, y_edges: Floats, depth: float) -> Floats:
        """Cerruti's closed form [-]."""
        if self.axis == 0:
            return shear_stress_coefficients(x_edges, y_edges, depth, self.poisson_ratio)
        turned = shear_stress_coefficients(y_edges, x_edges, depth, self.poisson_ratio)
        return turned[EXCHANGED].swapaxes(1, 2)

    def tensors(self, kx: Floats, ky: Floats) -> WaveTensors:
        """Stresses of a wave of traction along x or y.

        The transforms of `shear_stress_influence`, in which V has (2π/q) exp(-q z); the mean
        traction is a uniform shear stress.
        """
        q = np.hypot(kx, ky)
        q[0, 0] = 1.0  # the mean has no direction
        return sheared_tensors(
            kx, ky, self.axis, lambda depth: half_space_amplitudes(self.poisson_ratio, q * depth)
        )

    def poisson_ratio_at(self, depth: float) -> float:
        """Poisson's ratio of the half-space."""
        return self.poisson_ratio

    @property
    def exchanged(self) -> HalfSpaceShearStress:
        """Under a traction along the other axis."""
        return HalfSpaceShearStress(self.poisson_ratio, 1 - self.axis)


def half_space_amplitudes(poisson_ratio: float, qz: Numbers) -> Numbers:
    """X, Y, S, T, V and Z of `layered_shear_stress` in a half-space, at q z; shape (6, ...)."""
    one = np.ones_like(qz)
    found = [2 - qz, 2 * poisson_ratio * one, qz, qz - 1, -one, one]
    return np.stack(found) * np.exp(-qz)


def sheared_tensors(
    kx: Floats, ky: Floats, axis: int, amplitudes: Callable[[float], Numbers]
) -> WaveTensors:
    """Stresses of waves of traction along an axis by X, Y, S, T, V and Z at a depth.

    The mean traction is a uniform shear stress.
    """
    q = np.hypot(kx, ky)
    q[0, 0] = 1.0  # the mean has no direction: its east and north are 0
    east, north = (kx / q, ky / q) if axis == 0 else (ky / q, kx / q)

    def at(depth: float) -> list[Floats]:
        along, across, normal, shear, sideways, turned = amplitudes(depth)
        bent, carried = along - across - 2 * turned, shear - sideways
        found = [
            (across + 2 * turned + bent * east**2) * east,
            (across + bent * north**2) * east,
            normal * east,
            carried * east * north,
            sideways + carried * east**2,
            (turned + bent * east**2) * north,
        ]
        found[4][0, 0] = -1.0
        return found if axis == 0 else [found[place] for place in EXCHANGED]

    return at
