"""The published conjugate-gradient iteration, as a second opinion.

I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206, section 4, steps 1 to 8. Where the force is
off centre a plane takes the place of the mean of the gap and of the scaling by the force, as the
paper does (Spinu & Cerlinca 2018); with `tilts` False it is the published iteration to the letter.
"""

import numpy as np

from verification.independent import deflection


def solve(grid, open_gap, compliance, force, eccentricity=(0.0, 0.0), *, tilts, tolerance=1e-10):
    """Pressure, once its relative change in an iteration is below the tolerance."""
    solid = np.isfinite(open_gap)
    columns = [np.ones(grid.shape)]
    if tilts:
        columns += [np.broadcast_to(grid.x[:, None], grid.shape), np.tile(grid.y, (len(grid.x), 1))]
    scale = np.array([1.0, max(grid.size), max(grid.size)])[: len(columns)]
    basis = np.stack(columns, axis=-1) / scale
    wanted = force / grid.cell_area * np.array([1.0, *eccentricity])[: len(columns)] / scale

    def level(field, cells):
        """Field less the plane that fits it over the cells."""
        fit, *_ = np.linalg.lstsq(basis[cells], field[cells], rcond=None)
        return field - basis @ fit

    def balanced(pressure):
        gram = np.einsum("ij,ija,ijb->ab", pressure, basis, basis)
        return pressure * (basis @ np.linalg.solve(gram, wanted))

    def displaced(pressure):
        return compliance * deflection(pressure, grid.cell_size)

    pressure = balanced(np.where(solid, 1.0, 0.0))
    direction, norm, restart = np.zeros(grid.shape), 1.0, 0.0
    shape = np.where(solid, open_gap, 0.0)
    for _ in range(2000):
        touching = pressure > 0
        gap = level(displaced(pressure) + shape, touching)
        last, norm = norm, float((gap[touching] ** 2).sum())
        direction = np.where(touching, gap + restart * norm / last * direction, 0.0)
        change = level(displaced(direction), touching)
        step = float((gap * direction)[touching].sum() / (change * direction)[touching].sum())
        before = pressure
        pressure = np.where(touching, np.maximum(pressure - step * direction, 0.0), 0.0)
        overlapping = (pressure == 0) & (gap < 0) & solid
        pressure = np.where(overlapping, pressure - step * gap, pressure)
        restart = 0.0 if overlapping.any() else 1.0
        pressure = balanced(pressure)
        if np.abs(pressure - before).sum() <= tolerance * pressure.sum():
            return pressure
    raise AssertionError("the published iteration has not converged")
