"""What every indenter offers, and the sum of several."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Indenter(ABC):
    """A rigid shape, known by its initial gap to the plane it is pressed on.

    To add a shape, write a frozen dataclass with a `gap`; give it `curvatures` too if it is
    smooth at its deepest point.
    """

    @abstractmethod
    def gap(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Return the initial gap h_i(x, y) between the undeformed bodies, just touching.

        Parameters
        ----------
        x, y : array_like
            Positions along and across the indenter, any shapes that broadcast [m].

        Returns
        -------
        ndarray
            Gap, positive when open, zero at the deepest point, +inf outside the outline of
            the body [m].
        """

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvatures along x and y at the deepest point, zero where they mean nothing [1/m]."""
        return 0.0, 0.0

    @property
    def radius_of_curvature(self) -> float:
        """Smallest radius of curvature at the deepest point, inf where it means nothing [m]."""
        sharpest = max(self.curvatures)
        return 1 / sharpest if sharpest > 0 else math.inf

    def __add__(self, other: Indenter) -> CombinedIndenter:
        if not isinstance(other, Indenter):
            return NotImplemented
        return CombinedIndenter((self, other))


@dataclass(frozen=True)
class CombinedIndenter(Indenter):
    """Several shapes in one: their gaps add, and the sum is not shifted to zero.

    So a waviness or a roughness is laid over a shape. ``a + b`` makes one.

    Parameters
    ----------
    parts : tuple of Indenter
        The shapes; sums among them are taken apart, so that a + b + c has three parts.

    Raises
    ------
    ValueError
        If there is no part, or one of them is not an indenter.

    Examples
    --------
    Two equal spheres on each other meet like one of half the radius on a plane:

    >>> from viscontact.indenters import Sphere
    >>> (Sphere(0.01) + Sphere(0.01)).radius_of_curvature
    0.005
    """

    parts: tuple[Indenter, ...]

    def __post_init__(self) -> None:
        parts = tuple(self.parts)
        if not parts:
            raise ValueError("CombinedIndenter: parts must hold at least one indenter, got none")
        for part in parts:
            if not isinstance(part, Indenter):
                raise ValueError(f"CombinedIndenter: parts must be indenters, got {part!r}")
        object.__setattr__(self, "parts", tuple(leaf for part in parts for leaf in _leaves(part)))

    def gap(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Return the sum of the parts' gaps; see `Indenter.gap`."""
        return np.asarray(sum(part.gap(x, y) for part in self.parts), dtype=np.float64)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Sums of the parts' curvatures along x and y [1/m]."""
        along_x, along_y = zip(*(part.curvatures for part in self.parts), strict=True)
        return math.fsum(along_x), math.fsum(along_y)


def _leaves(part: Indenter) -> tuple[Indenter, ...]:
    return part.parts if isinstance(part, CombinedIndenter) else (part,)
