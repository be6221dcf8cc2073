"""Surface under tractions that move at constant speed: displacement along the surface.

As under a pressure (`moving_load`), each influence coefficient K of shear at rest becomes J0 K +
Σ Ji Ei K. The part of 1/r and that by Poisson's ratio (`shear_influence`) have a compliance each,
and so has each response of layers, beyond its short waves, which are those of a half-space.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from viscontact.backend.arrays import Complexes, Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import fast_length
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.influence import influence_coefficient
from viscontact.mechanics.halfspace.layered_shear import LayeredShear
from viscontact.mechanics.halfspace.layered_shear_influence import (
    shear_correction_at,
    strip_correction,
)
from viscontact.mechanics.halfspace.moving_load import (
    Coefficient,
    MovingCompliance,
    moving_influence_table,
)
from viscontact.mechanics.halfspace.shear_filter import ShearFilter, wave_numbers, wrapped
from viscontact.mechanics.halfspace.shear_influence import (
    ShearTables,
    along_coefficient,
    cross_coefficient,
    periodic_coefficients,
)

#: Wave numbers at which the response of layers is computed for a preconditioner.
_WAVES = 200


@dataclass(frozen=True, eq=False)
class MovingShear:
    """Compliances in motion of the parts of the response to shear."""

    direct: MovingCompliance  # of the part of 1/r
    poisson: MovingCompliance  # of the part by κ: κ J at a constant Poisson's ratio
    layers: tuple[tuple[LayeredShear, MovingCompliance], ...] = ()  # beyond short waves

    def of_waves(self, x: Floats, y: Floats, axis: int) -> tuple[Complexes, Complexes]:
        """Compliances of waves of tractions along and across their wave vector (x, y) [1/Pa].

        Those of layers between some wave numbers are interpolated.
        """
        waves, length = (x, y)[axis], np.hypot(x, y)
        along = self.direct.at_wave_number(waves)
        across = along + self.poisson.at_wave_number(waves)
        some = np.geomspace(length.min(), length.max(), _WAVES)
        for response, moving in self.layers:
            found, short = response.ratios(some), response.short_waves
            own = moving.at_wave_number(waves)
            along = along + np.interp(length, some, found.along - short.along) * own
            across = across + np.interp(length, some, found.across - short.across) * own
        return along, across


def moving_shear_convolution(
    grid: Grid, shape: tuple[int, int], shear: MovingShear, axis: int, **options: Any
) -> ShearFilter:
    """Displacement [m] of tractions [Pa] on a block of the cells of a grid that moves along +axis.

    The block has all cells of the grid along its period.
    """
    across = 1 - axis
    repeats = bool(grid.periodic[across])
    lengths = tuple(
        count if repeats and each == across else fast_length(2 * count - 1)
        for each, count in enumerate(shape)
    )

    datum = grid.size[axis] if repeats else None
    of_layers = [
        (_layered_coefficients(response, datum), moving) for response, moving in shear.layers
    ]

    def spectrum(part: str, compliance: MovingCompliance, parity: int = 1) -> Complexes:
        cells = shape, grid.cell_size
        coefficient = _coefficient(part, shape[across], datum)
        table = moving_influence_table(*cells, compliance, axis, coefficient, parity)
        if part != "direct":
            for own, moving in of_layers:
                table += moving_influence_table(*cells, moving, axis, own[part], parity)
        if part == "direct" and not grid.has_datum:
            table -= _drift(shape, grid.cell_size, axis, compliance)
        return signed_spectrum(table, (lengths[0], lengths[1]), axis, parity)

    direct = spectrum("direct", shear.direct)
    along, across_too, cross = (
        spectrum(part, shear.poisson, parity)
        for part, parity in (("along", 1), ("across", 1), ("cross", -1))
    )
    own = [direct + along, direct + across_too]
    return ShearFilter(shape, (lengths[0], lengths[1]), (own[axis], cross, own[across]), **options)


def moving_shear_preconditioner(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    shear: MovingShear,
    axis: int,
    **options: Any,
) -> ShearFilter:
    """Approximate inverse of the displacement of a block, taken as a period [Pa/m]."""
    # A wave along l is displaced by 2 J/|k| along it, and by 2 (J + κ J) across it.
    x, y, length = wave_numbers(shape, cell_size)
    safe = np.where(length > 0, length, 1.0)
    least_wave = float(length[length > 0].min())
    compliances = shear.of_waves(np.where(length > 0, x, least_wave), y, axis)
    along, across = (length / 2 / each for each in compliances)
    least = min([*np.abs(along[0, 1:2]), *np.abs(along[1:2, 0])])
    share_x, share_y = (x / safe) ** 2, (y / safe) ** 2
    xx = along * share_x + across * share_y
    yy = along * share_y + across * share_x
    xy = (along - across) * x * y / safe**2
    xx[0, 0] = yy[0, 0] = least
    found = tuple(_real_at_shortest(each, shape) for each in (xx, xy, yy))
    return ShearFilter(shape, shape, (found[0], found[1], found[2]), **options)


def _real_at_shortest(symbol: Numbers, shape: tuple[int, int]) -> Numbers:
    """Symbol without imaginary parts at the shortest waves, which have no phase."""
    nx, ny = shape
    if nx % 2 == 0:
        symbol[nx // 2] = symbol[nx // 2].real
    if ny % 2 == 0:
        symbol[:, ny // 2] = symbol[:, ny // 2].real
    return symbol


def _coefficient(part: str, across_cells: int, datum: float | None) -> Coefficient:
    """Coefficients of a part at offsets along and across the motion.

    With a datum [m], the distance at which displacement is zero, cells repeat across the motion.
    """
    # "along" and "across" are those of tractions along and across the motion.

    def free(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        if part == "direct":
            return influence_coefficient(along, across, cell)
        if part == "along":
            return along_coefficient(along, across, cell)
        if part == "across":
            return along_coefficient(across, along, cell[::-1])
        return cross_coefficient(along, across, cell)

    def with_images(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        assert datum is not None
        places: Floats = along[:, 0]
        tables = periodic_coefficients(across_cells, np.abs(places)[None, :], cell[::-1], datum)
        found = _PARTS[part](tables).T
        return found * np.sign(places)[:, None] if part == "cross" else found

    return free if datum is None else with_images


def _layered_coefficients(response: LayeredShear, datum: float | None) -> dict[str, Coefficient]:
    """Coefficients of the parts of layers beyond short waves, as `_coefficient`.

    With a datum [m] a line contact: the parts of one cell that repeats across the motion.
    """
    known: dict[tuple[bytes, int], dict[str, Floats]] = {}

    def computed(along: Floats, across: Floats, cell: tuple[float, float]) -> dict[str, Floats]:
        places = along[:, 0]
        if datum is None:
            tables = shear_correction_at(places, across.size, cell, response)
            return {"along": tables.along_x, "across": tables.along_y, "cross": tables.cross}
        pair = strip_correction(places, cell[0], response, datum)
        own, other = (each[:, None] for each in pair)
        return {"along": own, "across": other, "cross": np.zeros(own.shape)}

    def coefficient(part: str) -> Coefficient:
        def found(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
            key = along.tobytes(), across.size  # all are asked for at the same places
            if key not in known:
                known[key] = computed(along, across, cell)
            return known[key][part]

        return found

    return {part: coefficient(part) for part in ("along", "across", "cross")}


#: Parts of tables whose x is across the motion.
_PARTS: dict[str, Callable[[ShearTables], Floats]] = {
    "direct": lambda tables: tables.direct,
    "along": lambda tables: tables.along_y,
    "across": lambda tables: tables.along_x,
    "cross": lambda tables: tables.cross,
}


def _drift(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    axis: int,
    compliance: MovingCompliance,
) -> Floats:
    """Slope behind a line contact by old creep, at the offsets of a table [m/Pa]."""
    # As of a pressure: `MovingDomain`.
    count, cell = shape[axis], cell_size[axis]
    slope = 2 / np.pi * cell / shape[1 - axis] * compliance.drift
    offsets = slope * cell * np.arange(1 - count, count, dtype=np.float64)
    return offsets[:, None] if axis == 0 else offsets[None, :]


def signed_spectrum(table: Floats, lengths: tuple[int, int], axis: int, parity: int) -> Complexes:
    """Spectrum of a table with signed offsets along an axis, even or odd across."""
    across = 1 - axis
    table = wrapped(table, across, lengths[across], parity)
    count = (table.shape[axis] + 1) // 2
    shape = list(table.shape)
    shape[axis] = lengths[axis]
    kernel = np.zeros(shape)
    lines, given = np.moveaxis(kernel, axis, 0), np.moveaxis(table, axis, 0)
    lines[:count] = given[count - 1 :]
    if count > 1:
        lines[1 - count :] = given[: count - 1]
    return np.asarray(np.fft.rfft2(kernel))
