"""Problems for the package and the other programs: as objects for the package, as arrays for all.

Lengths and moduli are of order one, or small compared with a radius of 1 m and E* = 1 Pa, which
shows whether a solver depends on the scale.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

import viscontact as vc

#: G = 1/4 and nu = 1/2: E* = 1, so the contact compliance is 1.
UNIT = vc.Material(vc.Elastic(0.25), 0.5)

#: Compliance 1 initially and 3 finally; one relaxation time is 30 of 120 steps.
ZENER = vc.Material(vc.Zener(0.25, 0.125, 0.125 * 30.0), 0.5)
STEPS = 120
RECORDED = (1, 30, 60, 90, 120)


@dataclass(frozen=True)
class SharedProblem:
    """A problem for all programs."""

    name: str
    indenter: vc.Indenter
    material: vc.Material
    force: float
    shape: tuple[int, int]
    size: tuple[float, float]
    periodic: bool = False
    creeps: bool = False
    adhesion: tuple[float, float] | None = None  # work [J/m²] and range [m] of an exponential law
    mean_gaps: tuple[float, ...] = ()  # of states that are solved one by one, in place of a force

    @property
    def square_cells(self) -> bool:
        return self.shape[0] == self.shape[1] and self.size[0] == self.size[1]

    def centres(self) -> tuple[np.ndarray, np.ndarray]:
        """Cell centres x and y, the same for a free and a periodic grid."""
        grid = vc.Grid(self.shape, self.size)
        return grid.x, grid.y

    def arrays(self) -> dict[str, np.ndarray]:
        """Arrays of the problem for the drivers."""
        x, y = self.centres()
        gap = np.broadcast_to(self.indenter.gap(x[:, None], y[None, :]), self.shape)
        law = self.material.contact_compliance()
        arrays = {
            "gap": np.array(gap),
            "size": np.array(self.size),
            "force": np.array(self.force),
            "instant": np.array(law(0.0)),
            "periodic": np.array(self.periodic),
        }
        if self.adhesion is not None:
            arrays |= {"adhesion": np.array(self.adhesion), "mean_gaps": np.array(self.mean_gaps)}
        return arrays | self._in_time() if self.creeps else arrays

    def _in_time(self) -> dict[str, np.ndarray]:
        zener = self.material.law
        relaxed = 1 / (1 / zener.shear_modulus + 1 / zener.delayed_modulus)
        tau = zener.viscosity / zener.delayed_modulus
        branch = zener.shear_modulus - relaxed
        return {
            "times": vc.uniform_times(float(STEPS), STEPS),
            "recorded": np.array(RECORDED),
            # J = 1/(4 G) for nu = 1/2
            "amplitudes": np.array([1 / (4 * zener.delayed_modulus)]),
            "relaxation_times": np.array([tau]),
            "equilibrium_modulus": np.array(4 * relaxed),
            "moduli": np.array([4 * branch]),
            "maxwell_times": np.array([tau * relaxed / zener.shear_modulus]),
        }


def sphere(cells: int, *, creeps: bool = False) -> SharedProblem:
    """A paraboloid of radius 1 m whose largest contact has two thirds of the width of the grid."""
    final = 3.0 if creeps else 1.0
    radius = 0.01
    return SharedProblem(
        f"{'Zener' if creeps else 'free'} sphere {cells}²",
        vc.Paraboloid(1.0, 1.0),
        ZENER if creeps else UNIT,
        4 * radius**3 / 3 / final,
        (cells, cells),
        (3 * radius, 3 * radius),
        creeps=creeps,
    )


def roller(nx: int = 1024, ny: int = 256) -> SharedProblem:
    """A crowned roller under a centric force, with a long contact and long cells."""
    return SharedProblem(
        f"crowned roller {nx} x {ny}",
        vc.Roller(5e-3, 9.565e-3, 75e-3),
        UNIT,
        1e4 * 3.58e-10,  # load of the paper divided by its initial E*: the same contact
        (nx, ny),
        (60e-3, 3e-3),
    )


def rough(cells: int, *, periodic: bool) -> SharedProblem:
    """A self-affine surface, Hurst exponent 0.8, about a tenth of it in contact."""
    height = self_affine(cells, wavelengths=(8, cells // 8), seed=1)
    x, y = vc.Grid((cells, cells), (1.0, 1.0)).x, vc.Grid((cells, cells), (1.0, 1.0)).y
    return SharedProblem(
        f"{'periodic' if periodic else 'free'} rough {cells}²",
        vc.HeightMap(x, y, height),
        UNIT,
        0.05
        * rms_slope(height),  # the ratio of real to nominal area is about twice p/(E* h') (Persson)
        (cells, cells),
        (1.0, 1.0),
        periodic=periodic,
    )


def sticky(cells: int) -> SharedProblem:
    """A rough surface that repeats and adheres, at five mean gaps of 2.5 to 0.7 times its height.

    Slope 0.1, 2 to 32 waves on its side; up to a quarter of it is in contact.
    """
    height = self_affine(cells, wavelengths=(2, 32), seed=1)
    height *= 0.1 / rms_slope(height)
    grid = vc.Grid((cells, cells), (1.0, 1.0))
    return SharedProblem(
        f"sticky rough {cells}²",
        vc.HeightMap(grid.x, grid.y, height),
        UNIT,
        np.nan,
        (cells, cells),
        (1.0, 1.0),
        periodic=True,
        adhesion=(6e-5, 3e-3),
        mean_gaps=tuple((np.array([2.5, 2.0, 1.5, 1.0, 0.7]) * height.std()).tolist()),
    )


def rough_ball(cells: int) -> SharedProblem:
    """The same roughness on a paraboloid, with the contact inside the grid.

    The smooth paraboloid would have a contact radius of 0.3 m under the mean pressure of the plane.
    """
    plane, radius = rough(cells, periodic=False), 0.3
    pressure = plane.force / (plane.size[0] * plane.size[1])
    ball = vc.Paraboloid(*[4 * radius / (3 * np.pi * pressure)] * 2)  # p = 4/(3 pi) E* a/R
    force = pressure * np.pi * radius**2
    return replace(plane, name=f"rough ball {cells}²", indenter=ball + plane.indenter, force=force)


def self_affine(cells: int, wavelengths: tuple[int, int], seed: int) -> np.ndarray:
    """Heights with a root mean square of 1e-3 on a period of 1, between two wave numbers."""
    wave = np.fft.fftfreq(cells, 1 / cells)
    q = np.hypot(wave[:, None], wave[None, : cells // 2 + 1])
    amplitude = np.where((q >= wavelengths[0]) & (q <= wavelengths[1]), q, np.inf) ** -1.8
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((cells, cells)))
    height = np.fft.irfft2(amplitude * noise, (cells, cells))
    return height * (1e-3 / height.std())


def rms_slope(height: np.ndarray) -> float:
    """Root mean square slope on a period of length 1."""
    along = (np.roll(height, -1, axis=axis) - np.roll(height, 1, axis=axis) for axis in (0, 1))
    return float(np.sqrt(sum(((d * len(height) / 2) ** 2).mean() for d in along)))


#: Functions that create the problems, by their names on the command line.
PROBLEMS: dict[str, Callable[[], SharedProblem]] = {
    "sphere512": partial(sphere, 512),
    "sphere1024": partial(sphere, 1024),
    "roller": roller,
    "rough-free": partial(rough, 1024, periodic=False),
    "rough-ball": partial(rough_ball, 1024),
    "rough-periodic": partial(rough, 1024, periodic=True),
    "zener256": partial(sphere, 256, creeps=True),
    "zener512": partial(sphere, 512, creeps=True),
    "sticky": partial(sticky, 256),
    # small problems to test the drivers
    "sphere128": partial(sphere, 128),
    "roller-small": partial(roller, 256, 64),
    "rough128": partial(rough, 128, periodic=False),
    "rough128-ball": partial(rough_ball, 128),
    "rough128-periodic": partial(rough, 128, periodic=True),
    "sticky64": partial(sticky, 64),
    "zener64": partial(sphere, 64, creeps=True),
}
