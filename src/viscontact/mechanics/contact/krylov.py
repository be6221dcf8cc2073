"""GMRES, preconditioned from the right, on flat vectors (Saad & Schultz 1986)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from viscontact.backend.arrays import Floats, Numbers


def gmres(
    image: Callable[[Numbers], Numbers], right: Numbers, goal: float, max_vectors: int
) -> tuple[Floats, int]:
    """Factors of the basis vectors with which images leave least of a right side, and their number.

    `image` maps a basis vector to the operator's value of its preconditioned direction, which the
    caller keeps; the memory of that value is used. Ends where the norm of what is left is down to
    `goal`.
    """
    size = norm(right)
    basis, left, number = [right / size] if size else [], size, 0
    # Givens rotations make the Hessenberg matrix triangular as it grows (Saad & Schultz, 3.2).
    triangle, rotated = np.zeros((max_vectors, max_vectors)), np.zeros(max_vectors + 1)
    rotated[0] = size
    turns: list[tuple[float, float]] = []
    part = np.empty_like(right)
    while left > goal and number < max_vectors:
        new = image(basis[-1])
        column = []
        for known in basis:  # modified Gram-Schmidt
            column.append(float(np.einsum("i,i->", known, new)))
            np.multiply(known, column[-1], out=part)
            new -= part
        length = norm(new)
        for row, (cosine, sine) in enumerate(turns):
            upper, lower = column[row], column[row + 1]
            column[row : row + 2] = cosine * upper + sine * lower, cosine * lower - sine * upper
        diagonal = math.hypot(column[-1], length)
        if diagonal == 0:
            break
        cosine, sine = column[-1] / diagonal, length / diagonal
        turns.append((cosine, sine))
        column[-1] = diagonal
        triangle[: number + 1, number] = column
        rotated[number : number + 2] = cosine * rotated[number], -sine * rotated[number]
        number += 1
        left = abs(float(rotated[number]))
        if length == 0:
            break
        new /= length
        basis.append(new)
    factors = np.zeros(number)
    for row in reversed(range(number)):
        later = float(triangle[row, row + 1 : number] @ factors[row + 1 :])
        factors[row] = (rotated[row] - later) / triangle[row, row]
    return factors, number


def norm(vector: Numbers) -> float:
    """Euclidean norm, not by BLAS, which would start threads."""
    return float(np.sqrt(np.einsum("i,i->", vector, vector)))
