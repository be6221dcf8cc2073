"""Persson's theory of rough contacts: contact area and hysteresis friction from the spectrum."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from functools import cached_property
from typing import Any, Literal

import numpy as np
import scipy  # its special functions are imported at their first use
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats, Integers, Numbers
from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.material import Material
from viscontact.bodies.surfaces import Surface, surface_of
from viscontact.bodies.surfaces.height_spectrum import mean_square_waves
from viscontact.bodies.surfaces.topographies import is_topography
from viscontact.mechanics.problem.surface import constant_poisson_ratio
from viscontact.units.numbers import non_negative, real, real_array

#: Area of contact over nominal area below which the surface is not seen as rough by the theory.
FEW_SPOTS = 1e-3

#: Cells on the shortest wave below which slopes of the map depend on its spacing, and the share of
#: the mean square slope that waves shorter than this one may have.
CELLS, SHARE = 8.0, 0.01


@dataclass(frozen=True, eq=False)
class RoughWaves:
    """Waves of a surface in the order of their wave number."""

    wave_number: Floats  # |k|, ascending, without 0 [rad/m]
    along: Floats  # component of k along the motion [rad/m]
    slope: Floats  # |k|² w: mean square slope of each [-]
    group: Integers  # number of its |k|
    spacing: float  # the larger one of the map [m]

    @cached_property
    def cells(self) -> float:
        """Points on the shortest wave that counts."""
        sums = np.cumsum(self.slope)
        shortest = self.wave_number[np.searchsorted(sums, (1 - SHARE) * sums[-1])]
        return float(2 * np.pi / (shortest * self.spacing))

    def area_fraction(self, pressure: Floats, modulus: ArrayLike) -> Floats:
        """A/A0 under a nominal pressure [Pa] on a body of contact modulus E* [Pa]."""
        slope = np.sqrt(self.slope.sum())
        return np.asarray(scipy.special.erf(np.sqrt(2) * pressure / (modulus * slope)))

    def sums(self, terms: Floats) -> tuple[Floats, float]:
        """Sum of terms over all waves up to each |k|, half of those at it; and of all."""
        of_group = np.bincount(self.group, weights=terms)
        up_to = np.cumsum(of_group)
        return (up_to - of_group / 2)[self.group], float(up_to[-1])


def persson_area(
    surface: Surface, material: Material, pressure: ArrayLike, time: float | None = None
) -> Any:
    """Contact area over nominal area of a rough surface by Persson's theory.

    Parameters
    ----------
    surface : Surface
        Map of heights; one that is not periodic is multiplied by a window, as by `power_spectrum`.
    material : Material
        Of the half-space on which the rigid surface is pressed; for two bodies, one of the sum of
        their contact compliances.
    pressure : float or array_like
        Nominal pressure, force over area [Pa].
    time : float, optional
        Time for which the pressure is held [s]; needed for a body that creeps.

    Returns
    -------
    float or ndarray
        A/A0, as the pressure [-].

    Raises
    ------
    ValueError
        If an argument is invalid.

    Warns
    -----
    AccuracyWarning
        If A/A0 is below 1e-3, or the map has fewer than 8 points on its shortest wave.

    Notes
    -----
    A/A0 = erf(√2 p/(E* g)), with the rms slope g of all waves: exact at full contact. For small
    loads the computed area is about 1.3 times as large.

    References
    ----------
    B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840.

    Examples
    --------
    >>> import viscontact as vc
    >>> waves = 1e-6 * np.cos(2 * np.pi * np.arange(64) / 64)[:, None] * np.ones(64)
    >>> surface = vc.Surface(waves, 1e-5, periodic=True)
    >>> body = vc.Material(vc.Elastic.from_uniaxial(1e7, 0.5), poisson_ratio=0.5)
    >>> round(vc.surfaces.persson_area(surface, body, 1e4), 4)
    0.1711
    """
    waves = rough_waves(surface, 1)
    _require_half_space(material)
    pressures = _pressures(pressure)
    compliance = material.contact_compliance()
    if time is None and not compliance.is_elastic:
        raise ValueError(
            "time: the material creeps; give the time for which the pressure is held, in s"
        )
    held = 0.0 if time is None else non_negative("time", time, "s")
    found = waves.area_fraction(pressures, 1 / float(compliance(held)))
    _warn([*_doubts(waves), *_few_spots(found)])
    return float(found) if np.ndim(found) == 0 else np.asarray(found)


def persson_sliding(
    surface: Surface,
    material: Material,
    pressure: float,
    speed: ArrayLike,
    along: Literal["x", "y"] = "y",
    gamma: float = 0.5,
) -> xr.Dataset:
    """Contact area and hysteresis friction of a sliding rough surface by Persson's theory.

    Parameters
    ----------
    surface : Surface
        Map of heights of the rigid surface; see `persson_area`.
    material : Material
        Of the half-space that it slides over, with a constant Poisson's ratio.
    pressure : float
        Nominal pressure [Pa].
    speed : float or array_like
        Speeds, positive [m/s].
    along : {"x", "y"}, optional
        Axis of the motion.
    gamma : float, optional
        Part γ of the elastic energy that is not reduced in partial contact, from 0 to 1.

    Returns
    -------
    xarray.Dataset
        Over ``speed``: ``area_fraction`` A/A0, ``friction_coefficient`` with S = γ + (1 - γ) P² and
        ``friction_coefficient_upper`` with S = 1 [-]; warnings as an attribute.

    Raises
    ------
    ValueError
        If an argument is invalid.

    Notes
    -----
    With E*(ω) = 2 G*(ω)/(1 - ν) at ω = k_y v and the mean square w of each wave,

        G(q) = Σ_{|k|≤q} |k|² |E*|² w/(8 σ²),   P = erf(1/(2 √G)),
        μ = Σ |k| k_y S P Im E* w/(2 σ),

    where waves of |k| = q count by half; exact at full contact, where P = 1. In partial contact the
    theory has the order of the friction and the place of its maximum, not the number.

    References
    ----------
    B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840; M. Scaraggi, B. N. J. Persson, J. Phys.:
    Condens. Matter 27 (2015) 105102.

    Examples
    --------
    >>> import viscontact as vc
    >>> waves = 1e-6 * np.cos(2 * np.pi * np.arange(64) / 64) * np.ones((64, 1))
    >>> surface = vc.Surface(waves, 1e-5, periodic=True)
    >>> rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    >>> found = vc.surfaces.persson_sliding(surface, rubber, 1e4, [1e-4, 1e-2, 1.0])
    >>> found.friction_coefficient.values.round(5).tolist()
    [4e-05, 0.00296, 0.00036]
    """
    axis = _axis(along)
    waves, poisson_ratio = rough_waves(surface, axis), _require_half_space(material)
    level = float(_pressures(real("pressure", pressure, "Pa")))
    speeds = np.atleast_1d(real_array("speed", speed, "m/s"))
    if speeds.ndim != 1 or not (np.isfinite(speeds) & (speeds > 0)).all():
        raise ValueError(f"speed must be positive and finite, in m/s, got {speed!r}")
    part = non_negative("gamma", gamma)
    if part > 1:
        raise ValueError(f"gamma must lie between 0 and 1, got {gamma!r}")
    rows = np.array(
        [_sliding(waves, material, poisson_ratio, (level, each), part) for each in speeds.tolist()]
    )
    names = {
        "area_fraction": "contact area over nominal area, theory",
        "friction_coefficient": "friction coefficient, theory",
        "friction_coefficient_upper": "friction coefficient, theory with all of the energy",
    }
    found = {
        name: ("speed", rows[:, k], {"units": "1", "long_name": meaning})
        for k, (name, meaning) in enumerate(names.items())
    }
    notes = [*_doubts(waves), *_few_spots(rows[:, 0])]
    _warn(notes)
    return xr.Dataset(
        found,
        {"speed": ("speed", speeds, {"units": "m/s", "long_name": "sliding speed"})},
        {"warnings": "\n".join(notes), "along": along, "pressure": level, "gamma": part},
    )


def _sliding(
    waves: RoughWaves,
    material: Material,
    poisson_ratio: float,
    load: tuple[float, float],
    gamma: float,
) -> tuple[float, float, float]:
    """A/A0, μ and μ with S = 1 under a pressure [Pa] at a speed [m/s]."""
    pressure, speed = load
    modulus = _modulus(material, poisson_ratio, speed * waves.along)
    energy, whole = waves.sums(waves.slope * np.abs(modulus) ** 2 / (8 * pressure**2))
    share = scipy.special.erf(1 / (2 * np.sqrt(energy)))
    terms = waves.slope * waves.along / waves.wave_number * modulus.imag * share / (2 * pressure)
    reduced = gamma + (1 - gamma) * share**2
    area = float(scipy.special.erf(1 / (2 * np.sqrt(whole))))
    return area, float((reduced * terms).sum()), float(terms.sum())


def _modulus(material: Material, poisson_ratio: float, omega: Floats) -> Numbers:
    """E*(ω) of a half-space [Pa], also at ω <= 0; the imaginary part is odd."""
    size, place = np.unique(np.abs(omega), return_inverse=True)
    found = np.empty(size.shape, complex)
    moves = size > 0
    found[moves] = material.law.complex_modulus(size[moves])
    if not moves.all():  # waves that the motion does not change: the modulus after all creep
        least = size[moves].min() if moves.any() else 1.0
        found[~moves] = material.law.complex_modulus(1e-12 * float(least)).real
    values = 2 * found[place] / (1 - poisson_ratio)
    return np.asarray(np.where(omega < 0, values.conj(), values))


def rough_waves(surface: object, axis: int) -> RoughWaves:
    """Waves of a map in the order of their wave number."""
    given = surface_of(surface) if is_topography(surface) else surface
    if not isinstance(given, Surface):
        raise ValueError(f"surface must be a vc.Surface, got {given!r}; see vc.read_surface")
    squares, *numbers = mean_square_waves(given)
    whole = np.hypot(numbers[0][:, None], numbers[1])
    along = np.broadcast_to((numbers[0][:, None], numbers[1][None, :])[axis], whole.shape)
    kept = (whole > 0) & (squares > 0)
    if not kept.any():
        raise ValueError("surface: its map is flat; the theory needs a rough one")
    order = np.argsort(whole[kept], kind="stable")
    wave_number = whole[kept][order]
    # Waves of equal length differ by rounding.
    steps = np.diff(wave_number, prepend=wave_number[0]) > 1e-9 * wave_number
    slope = wave_number**2 * squares[kept][order]
    spacing = max(given.spacing)
    return RoughWaves(wave_number, along[kept][order], slope, np.cumsum(steps), spacing)


def _axis(along: str) -> int:
    if along not in ("x", "y"):
        raise ValueError(f"along must be 'x' or 'y', got {along!r}")
    return "xy".index(along)


def _require_half_space(material: object) -> float:
    """Poisson's ratio [-] of a half-space."""
    if not isinstance(material, Material):
        raise ValueError(
            f"material must be a vc.Material, as the theory is of half-spaces, got {material!r}"
        )
    ratio = constant_poisson_ratio(material)
    if ratio is None:
        raise ValueError(
            "material: with an elastic bulk modulus Poisson's ratio varies in time; give "
            "poisson_ratio= for the theory"
        )
    return ratio


def _pressures(given: object) -> Floats:
    pressures = real_array("pressure", given, "Pa")
    if not (np.isfinite(pressures) & (pressures > 0)).all():
        raise ValueError(f"pressure must be positive and finite, in Pa, got {given!r}")
    return pressures


def _doubts(waves: RoughWaves) -> Iterator[str]:
    if waves.cells < CELLS:
        yield (
            f"the map has {waves.cells:.1f} points on its shortest waves, {CELLS:g} or more are "
            "wanted: its slope depends on the spacing of the points"
        )


def _few_spots(area: Floats) -> Iterator[str]:
    if float(np.min(area)) < FEW_SPOTS:
        yield (
            f"the contact is {100 * float(np.min(area)):.2g} % of the nominal area; below "
            f"{100 * FEW_SPOTS:g} % a few peaks carry the load, which the theory does not know"
        )


def _warn(notes: list[str]) -> None:
    for note in notes:
        warnings.warn(note, AccuracyWarning, stacklevel=3)
