"""Influence coefficients of a cell under tractions on layers, beyond those of a half-space.

With the ratios A, B and D of `layered_shear`, φ the direction from the load and J_m Bessel's
functions, a unit force along x displaces the surface per unit contact compliance by

    u_x = S_0 + cos(2 φ) H_2,   u_y = sin(2 φ) H_2,   u_z = cos(φ) D_1,
    S_0 = (1/π) ∫_0^∞ (A + B)/2 J_0(q r) dq,   H_2 = (1/π) ∫_0^∞ (B - A)/2 J_2(q r) dq,
    D_1 = (1/π) ∫_0^∞ D J_1(q r) dq.

The parts by A(∞), B(∞) and D(∞) are those of a half-space (`shear_influence`,
`coupling_influence`); the rest is smooth on the scale of the thinnest layer (`harmonic_kernel`). A
line contact has the waves across the line only: A along them, B across, and

    u_z(y) = (2/π) ∫_0^∞ D sin(q y)/q dq

under a line load. As in `strip_influence` its rest is taken along a ray, where the arc around q = 0
adds the angle of the ray times the value there.
"""

from __future__ import annotations

from functools import lru_cache, partial

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.coupling_influence import CouplingTables, coupling_tables
from viscontact.mechanics.halfspace.harmonic_kernel import (
    COS_1,
    COS_2,
    SIN_2,
    coupling_kernel,
    harmonic_coefficient,
    split_kernel,
)
from viscontact.mechanics.halfspace.layered_influence import (
    correction_coefficient,
    periodic_layered_coefficient,
)
from viscontact.mechanics.halfspace.layered_shear import LayeredShear, ShearComponent
from viscontact.mechanics.halfspace.shear_influence import PairTables, periodic_coefficients
from viscontact.mechanics.halfspace.smooth_kernel import LOG_STEP, RAY
from viscontact.mechanics.halfspace.strip_influence import (
    REACH,
    odd_spline,
    places_and_waves,
)


def shear_correction(grid: Grid, response: LayeredShear) -> PairTables:
    """Coefficients beyond a half-space's, of a grid without a period or of a line contact."""
    if any(grid.periodic):
        return _strips(grid, response)
    x = np.arange(grid.shape[0], dtype=np.float64) * grid.cell_size[0]
    return shear_correction_at(x, grid.shape[1], grid.cell_size, response)


def shear_correction_at(
    x: Floats, ny: int, cell_size: tuple[float, float], response: LayeredShear
) -> PairTables:
    """These coefficients at offsets x >= 0 [m] and of j < ny cells along y, without a period."""
    mean = ShearComponent(response, 0.5, 0.5)
    direct = correction_coefficient(x, ny, cell_size, mean)
    turned, cross = (
        harmonic_coefficient(
            partial(split_kernel, response), turn, x, ny, cell_size, response.length
        )
        for turn in (COS_2, SIN_2)
    )
    return PairTables(direct + turned, cross, direct - turned)


def layered_coupling(grid: Grid, response: LayeredShear) -> CouplingTables:
    """Coefficients of tractions to displacement into layers, of a grid as above."""
    own, weight = coupling_tables(grid), response.short_waves.coupling
    if any(grid.periodic):
        axis = _strip_axis(grid)
        width = grid.cell_size[axis]
        y = np.arange(grid.shape[axis], dtype=np.float64) * width
        found = coupling_of_strip(y, width, response).reshape(grid.shape)
        pair = (np.zeros(grid.shape), found) if axis == 1 else (found, np.zeros(grid.shape))
        return CouplingTables(*(weight * a + b for a, b in zip(_both(own), pair, strict=True)))
    along_x, along_y = (
        harmonic_coefficient(
            *(partial(coupling_kernel, response), COS_1),
            *(np.arange(count, dtype=np.float64) * cell_size[0], across),
            *(cell_size, response.length),
        )
        for (count, across), cell_size in (
            (grid.shape, grid.cell_size),
            (grid.shape[::-1], grid.cell_size[::-1]),
        )
    )
    return CouplingTables(weight * own.along_x + along_x, weight * own.along_y + along_y.T)


def _both(tables: CouplingTables) -> tuple[Floats, Floats]:
    return tables.along_x, tables.along_y


def _strip_axis(grid: Grid) -> int:
    """Axis across the strips of a line contact."""
    axis = grid.periodic.index(False)
    assert grid.shape[1 - axis] == 1  # others are refused
    return axis


def _strips(grid: Grid, response: LayeredShear) -> PairTables:
    """Coefficients of strips, less those of a half-space of short waves."""
    axis = _strip_axis(grid)
    width = grid.cell_size[axis]
    y = np.arange(grid.shape[axis], dtype=np.float64) * width
    along, across = strip_correction(y, width, response, grid.size[axis])
    pair = (along, across) if axis == 0 else (across, along)
    along_x, along_y = (each.reshape(grid.shape) for each in pair)
    return PairTables(along_x, np.zeros(grid.shape), along_y)


def strip_correction(
    y: Floats, width: float, response: LayeredShear, datum: float
) -> tuple[Floats, Floats]:
    """Coefficients at offsets y >= 0 [m] from a strip, of tractions across it and along it.

    Less those of a half-space of short waves, both with a displacement of zero at the distance
    `datum` [m] of a line load, but on a rigid base.
    """
    own, short = periodic_coefficients(1, y[None, :], (width, width), datum), response.short_waves
    poisson = short.across - short.along
    along, across = (
        periodic_layered_coefficient(
            *(1, y, (width, width), ShearComponent(response, *weights), datum)
        )
        - short.along * own.direct
        - poisson * part
        for weights, part in (((1.0, 0.0), own.along_y), ((0.0, 1.0), own.along_x))
    )
    return along[0], across[0]


def coupling_of_strip(y: Floats, width: float, response: LayeredShear) -> Floats:
    """Rest of the displacement into layers [m] at offsets y [m] from a strip under traction."""
    spline = _coupling_primitive(response)

    def primitive(place: Floats) -> Floats:  # even
        return np.asarray(spline(np.arcsinh(np.minimum(np.abs(place) / response.length, REACH))))

    return response.length * (primitive(y + width / 2) - primitive(y - width / 2))


@lru_cache(maxsize=32)
def _coupling_primitive(response: LayeredShear) -> scipy.interpolate.BSpline:
    """Integral of the rest under a line load over y/length from 0, as a spline of asinh."""
    length = response.length
    y, q = places_and_waves()
    short, long = response.short_waves.coupling, response.long_waves.coupling
    rest = (response.ratios(q / length).coupling - short) * LOG_STEP
    arc = float(np.angle(RAY)) * (long - short)
    values = [0.0, *(float((rest * np.exp(1j * q * at)).sum().imag) + arc for at in y[1:])]
    # Over the argument of the spline: cosh(asinh(y)) times those over y.
    slopes = 2 / np.pi * np.array(values) * np.sqrt(1 + y**2)
    found = odd_spline(slopes).antiderivative()
    found.c -= found(0.0)
    return found
