"""GMRES, preconditioned from the right, on flat vectors (Saad & Schultz 1986)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viscontact.backend.arrays import Floats


def gmres(
    image: Callable[[Floats], Floats], right: Floats, goal: float, max_vectors: int
) -> tuple[Floats, int]:
    """Factors of the basis vectors with which images leave least of a right side, and their number.

    `image` maps a basis vector to the operator's value of its preconditioned direction, which the
    caller keeps. Ends where the norm of what is left is down to `goal`.
    """
    size = norm(right)
    basis, factors, left = [right / size] if size else [], np.empty(0), size
    hessenberg = np.zeros((max_vectors + 1, max_vectors))
    while left > goal and len(factors) < max_vectors:
        column = len(factors)
        new = image(basis[-1])
        for row, known in enumerate(basis):  # modified Gram-Schmidt
            hessenberg[row, column] = along = float(np.einsum("i,i->", known, new))
            new = new - along * known
        hessenberg[column + 1, column] = length = norm(new)
        factors, left = _least_squares(hessenberg[: column + 2, : column + 1], size)
        if length == 0:
            break
        basis.append(new / length)
    return factors, len(factors)


def _least_squares(hessenberg: Floats, size: float) -> tuple[Floats, float]:
    """Factors of the directions with the least residual, and its norm."""
    right = np.zeros(len(hessenberg))
    right[0] = size
    factors = np.linalg.lstsq(hessenberg, right, rcond=None)[0].astype(np.float64)
    return factors, norm(hessenberg @ factors - right)


def norm(vector: Floats) -> float:
    """Euclidean norm, not by BLAS, which would start threads."""
    return float(np.sqrt(np.einsum("i,i->", vector, vector)))
