"""Removal of tilt and form from a measured surface."""

from __future__ import annotations

from typing import Literal

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.surfaces.surface import Surface

Level = Literal["none", "mean", "plane", "quadratic"]

#: Powers of x and y of the polynomial that is subtracted.
TERMS: dict[str, tuple[tuple[int, int], ...]] = {
    "none": (),
    "mean": ((0, 0),),
    "plane": ((0, 0), (1, 0), (0, 1)),
    "quadratic": ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)),
}


def levelled(surface: Surface, level: Level = "plane") -> Surface:
    """Subtract the least-squares polynomial from the heights of a surface.

    Parameters
    ----------
    surface : Surface
        The surface.
    level : {"none", "mean", "plane", "quadratic"}, optional
        ``"none"``, ``"mean"``: the mean height; ``"plane"``: the plane of tilt, too;
        ``"quadratic"``: the paraboloid of form, too.

    Returns
    -------
    Surface
        The remaining heights; missing points stay missing.

    Raises
    ------
    ValueError
        If the level is unknown, a periodic surface's form is to be taken off, or the known points
        do not determine the polynomial.

    Notes
    -----
    Least squares over the known points. A form that is to be pressed (a ball's, a roller's)
    is levelled by ``"plane"`` at most. A periodic surface is not tilted, or it would not be
    periodic: of it ``"plane"`` takes the mean only.

    Examples
    --------
    >>> tilted = Surface(np.add.outer([0.0, 1e-6, 2e-6], [0.0, 3e-6, 6e-6]), spacing=1e-5)
    >>> bool(np.abs(levelled(tilted).heights).max() < 1e-20)
    True
    """
    if level not in TERMS:
        raise ValueError(f"level must be {', '.join(TERMS)}, got {level!r}")
    if level == "none":
        return surface
    if surface.periodic and level == "quadratic":
        raise ValueError(
            f"level: {surface.name} is periodic, and has no form; level it by its mean, or crop it"
        )
    terms = TERMS["mean" if surface.periodic else level]
    return surface.with_heights(surface.heights - polynomial(surface, terms).of(surface))


class Polynomial:
    """Polynomial in x and y, each over half the size of the map; coefficients in m."""

    def __init__(self, terms: tuple[tuple[int, int], ...], coefficients: Floats) -> None:
        self.terms, self.coefficients = terms, coefficients

    def of(self, surface: Surface) -> Floats:
        """Values at a surface's points, shape (nx, ny) [m]."""
        along_x, along_y = _scaled_axes(surface)
        values = np.zeros(surface.shape)
        for (i, j), factor in zip(self.terms, self.coefficients.tolist(), strict=True):
            values += factor * np.multiply.outer(along_x**i, along_y**j)
        return values

    def __getitem__(self, term: tuple[int, int]) -> float:
        """Coefficient of a pair of powers [m]."""
        return float(self.coefficients[self.terms.index(term)])


def polynomial(surface: Surface, terms: tuple[tuple[int, int], ...]) -> Polynomial:
    """Least-squares polynomial of the known heights with the given powers of x and y."""
    along_x, along_y = _scaled_axes(surface)
    known = ~surface.missing
    # Normal equations from moments: no matrix with a row for each point. The terms are of the
    # order of one and few, so that the squared condition number costs no digit that matters.
    moment = {
        (i, j): float(along_x**i @ known @ along_y**j)
        for i, j in {(a + c, b + d) for a, b in terms for c, d in terms}
    }
    matrix = np.array([[moment[a + c, b + d] for c, d in terms] for a, b in terms])
    reference = float(np.nanmean(surface.heights))
    heights = np.where(known, surface.heights - reference, 0.0)
    right = np.array([along_x**i @ heights @ along_y**j for i, j in terms])
    if np.linalg.matrix_rank(matrix, tol=1e-10 * matrix[0, 0]) < len(terms):
        raise ValueError(
            f"{surface.name}: its {int(known.sum())} known points do not determine a polynomial "
            f"of {len(terms)} terms; level by the mean"
        )
    coefficients = np.linalg.solve(matrix, right)
    coefficients[terms.index((0, 0))] += reference
    return Polynomial(terms, coefficients)


def tilt(surface: Surface) -> tuple[float, float]:
    """Slopes along x and y of the least-squares plane of a surface [rad]."""
    plane = polynomial(surface, TERMS["plane"])
    lx, ly = surface.size
    return plane[1, 0] / (lx / 2), plane[0, 1] / (ly / 2)


def _scaled_axes(surface: Surface) -> tuple[Floats, Floats]:
    lx, ly = surface.size
    return surface.x / (lx / 2), surface.y / (ly / 2)
