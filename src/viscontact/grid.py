"""The uniform rectangular grid that carries pressure and displacement."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Grid:
    """A uniform grid of rectangular cells, centred on the origin.

    Parameters
    ----------
    shape : tuple of int
        Numbers of cells (nx, ny) along x and y; at least 4 each.
    size : tuple of float
        Extents (lx, ly) of the whole grid [m].

    Raises
    ------
    ValueError
        If a number of cells is not a whole number of at least 4, or an extent is not
        positive and finite.

    Examples
    --------
    >>> grid = Grid(shape=(4, 8), size=(0.02, 0.02))
    >>> grid.cell_size
    (0.005, 0.0025)
    >>> grid.x.tolist()
    [-0.0075, -0.0025, 0.0025, 0.0075]
    """

    shape: tuple[int, int]
    size: tuple[float, float]

    def __post_init__(self) -> None:
        if len(tuple(self.shape)) != 2 or len(tuple(self.size)) != 2:
            raise ValueError(
                f"grid: shape and size need two entries each, got {self.shape!r} and {self.size!r}"
            )
        for name, cells in zip(("nx", "ny"), self.shape, strict=True):
            if int(cells) != cells or cells < 4:
                raise ValueError(f"grid.shape: {name} must be a whole number >= 4, got {cells!r}")
        for name, extent in zip(("lx", "ly"), self.size, strict=True):
            if not (math.isfinite(extent) and extent > 0):
                raise ValueError(f"grid.size: {name} must be a positive length, got {extent!r} m")
        object.__setattr__(self, "shape", (int(self.shape[0]), int(self.shape[1])))
        object.__setattr__(self, "size", (float(self.size[0]), float(self.size[1])))

    @property
    def cell_size(self) -> tuple[float, float]:
        """Edge lengths (dx, dy) of a cell [m]."""
        return self.size[0] / self.shape[0], self.size[1] / self.shape[1]

    @property
    def cell_area(self) -> float:
        """Area of a cell [m²]."""
        dx, dy = self.cell_size
        return dx * dy

    @property
    def x(self) -> NDArray[np.float64]:
        """Cell centres along x, shape (nx,) [m]."""
        return _centres(self.shape[0], self.size[0])

    @property
    def y(self) -> NDArray[np.float64]:
        """Cell centres along y, shape (ny,) [m]."""
        return _centres(self.shape[1], self.size[1])


def _centres(cells: int, extent: float) -> NDArray[np.float64]:
    # Built from whole numbers so that mirrored centres are exact opposites.
    offsets = (2 * np.arange(cells) - (cells - 1)).astype(np.float64)
    return offsets * (extent / (2 * cells))
