"""Filling of points without a measured height."""

from __future__ import annotations

from typing import Literal

import numpy as np
import scipy

from viscontact.backend.arrays import Floats, Integers
from viscontact.bodies.surfaces.surface import Surface

Filling = Literal["smooth", "lowest"]


def filled(surface: Surface, by: Filling = "smooth") -> Surface:
    """Fill missing points with heights.

    Parameters
    ----------
    surface : Surface
        The surface.
    by : {"smooth", "lowest"}, optional
        ``"smooth"``: like a soap film between the known neighbours, nowhere higher or lower
        than they are; ``"lowest"``: the lowest known height, so that they never touch first.

    Returns
    -------
    Surface
        Without missing points.

    Raises
    ------
    ValueError
        If the choice is unknown.

    Notes
    -----
    The film is the solution of Laplace's equation on the mesh (five-point differences, no
    slope across the border of the map).

    Examples
    --------
    >>> filled(Surface([[0.0, 1e-6, 2e-6], [0.0, np.nan, 2e-6]], 1e-6)).heights[1].tolist()
    [0.0, 1e-06, 2e-06]
    """
    if by not in ("smooth", "lowest"):
        raise ValueError(f"by must be 'smooth' or 'lowest', got {by!r}")
    if not surface.missing.any():
        return surface
    heights = surface.heights.copy()
    if by == "lowest":
        heights[surface.missing] = np.nanmin(heights)
    else:
        heights[surface.missing] = _soap_film(surface)
    return surface.with_heights(heights)


def _soap_film(surface: Surface) -> Floats:
    """Heights of the soap film at the missing points, in their order [m]."""
    missing = surface.missing
    number = np.full(surface.shape, -1, dtype=np.intp)
    count = int(missing.sum())
    number[missing] = np.arange(count)
    diagonal, right = np.zeros(count), np.zeros(count)
    links: list[tuple[Integers, Integers, Floats]] = []
    reference = float(np.nanmean(surface.heights))
    for axis, spacing in enumerate(surface.spacing):
        weight = (max(surface.spacing) / spacing) ** 2
        before, after = np.moveaxis(number, axis, 0)[:-1], np.moveaxis(number, axis, 0)[1:]
        heights = np.moveaxis(surface.heights, axis, 0) - reference
        for here, there, known in (
            (before, after, heights[1:]),
            (after, before, heights[:-1]),
        ):
            inside = here >= 0
            row, column = here[inside], there[inside]
            np.add.at(diagonal, row, weight)
            is_known = column < 0
            np.add.at(right, row[is_known], weight * known[inside][is_known])
            both = ~is_known
            links.append((row[both], column[both], np.full(int(both.sum()), -weight)))
    rows, columns, values = (np.concatenate(part) for part in zip(*links, strict=True))
    matrix = scipy.sparse.coo_matrix((values, (rows, columns)), shape=(count, count)).tocsc()
    matrix += scipy.sparse.diags(diagonal, format="csc")
    return np.asarray(scipy.sparse.linalg.spsolve(matrix, right)) + reference
