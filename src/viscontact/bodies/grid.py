"""Uniform rectangular grid of pressure and displacement, and automatic grids."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from viscontact.backend.arrays import Field, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.axis_flags import NEITHER, AxisFlags
from viscontact.units.display import Displayable
from viscontact.units.numbers import as_real, finite, positive, store, whole

#: Quantities that a mesh can be chosen for.
GRID_QUANTITIES = ("peak_pressure", "contact_area", "approach")

#: Further ones that can be requested. Errors of the other results follow from the whole history.
FURTHER_QUANTITIES = (
    *("mean_pressure", "contact_length", "contact_width", "peak_line_load", "force"),
    *("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y"),
)
MESH_QUANTITIES = GRID_QUANTITIES + FURTHER_QUANTITIES

#: Least number of cells across the largest contact of a run.
MIN_CELLS_ACROSS = 4

#: Range of tolerances of an automatic mesh.
FINEST, COARSEST = 1e-4, 0.5


@dataclass(frozen=True)
class Grid(Displayable):
    """A uniform grid of rectangular cells, centred on the origin or elsewhere.

    Parameters
    ----------
    shape : tuple of int
        Numbers of cells (nx, ny) along x and y; at least 4 each, or 1 along a periodic axis along
        which nothing varies.
    size : tuple of float
        Extents (lx, ly) of the whole grid [m].
    periodic : bool or pair of bool, optional
        If true, the grid is one period of a surface that is periodic along x and y; otherwise it
        is a part of a half-space without load outside. A pair gives each axis its own: with
        ``(True, False)`` bodies and load repeat along x and are alone across (a line contact, a
        row of rollers). The force is then that of one period, and the approach has no datum.
    centre : tuple of float, optional
        Position (x, y) of the middle of the grid [m]; the origin by default. Moments and
        eccentricities are about the origin on every grid.

    Raises
    ------
    ValueError
        If a number of cells is not a whole number of at least 4 (or 1 along a periodic axis), an
        extent is not positive and finite, periodic is neither true nor false nor a pair of these,
        or the centre is no pair of finite numbers.

    Examples
    --------
    >>> grid = Grid(shape=(4, 8), size=(0.02, 0.02))
    >>> grid.cell_size
    (0.005, 0.0025)
    >>> grid.x.tolist()
    [-0.0075, -0.0025, 0.0025, 0.0075]
    >>> Grid(shape=(4, 8), size=(0.02, 0.02), centre=(0.5, 0.0)).x.tolist()
    [0.4925, 0.4975, 0.5025, 0.5075]
    >>> Grid((1, 64), (1e-3, 2e-3), periodic=(True, False)).periodic
    (True, False)
    """

    shape: tuple[int, int] = field(metadata={"unit": "1"})
    size: tuple[float, float] = field(metadata={"unit": "m"})
    periodic: AxisFlags = NEITHER
    centre: tuple[float, float] = field(
        default=(0.0, 0.0), kw_only=True, metadata={"unit": "m", "recorded": "if given"}
    )

    if TYPE_CHECKING:  # any of these forms is kept as a pair

        def __init__(
            self,
            shape: tuple[int, int],
            size: tuple[float, float],
            periodic: bool | tuple[bool, bool] = False,
            *,
            centre: tuple[float, float] = (0.0, 0.0),
        ) -> None: ...

    def __post_init__(self) -> None:
        periodic = AxisFlags(self.periodic, "grid.periodic")
        shape = tuple(
            whole(f"grid.shape: {name}", count, 1 if repeats and as_real(count) == 1 else 4)
            for name, count, repeats in zip(
                ("nx", "ny"), _pair("shape", self.shape), periodic, strict=True
            )
        )
        size = _lengths("size", ("lx", "ly"), self.size, positive)
        centre = _lengths("centre", ("x", "y"), self.centre, finite)
        store(self, shape=shape, size=size, periodic=periodic, centre=centre)

    def __repr__(self) -> str:
        centre = f", centre={self.centre}" if any(self.centre) else ""
        return f"Grid(shape={self.shape}, size={self.size}, periodic={self.periodic}{centre})"

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
    def area(self) -> float:
        """Area of the whole grid [m²]; the mean pressure of a period is its force over this."""
        return self.size[0] * self.size[1]

    @property
    def has_datum(self) -> bool:
        """False if the grid is periodic along one axis only: the approach has no datum there.

        The displacement under a load that repeats along a line goes as the logarithm of the
        distance from it, so that no point of the half-space is at rest.
        """
        return self.periodic[0] == self.periodic[1]

    @property
    def line_length(self) -> float | None:
        """Length of the period of a line contact [m]; None for any other grid.

        A line contact has a single cell along its only periodic axis, along which nothing varies.
        Force, area, work and power of a period are proportional to this length.

        >>> Grid((1, 64), (1e-3, 2e-3), periodic=(True, False)).line_length
        0.001
        """
        if self.has_datum:
            return None
        axis = self.periodic.index(True)
        return self.size[axis] if self.shape[axis] == 1 else None

    @property
    def x(self) -> Floats:
        """Cell centres along x, shape (nx,) [m]."""
        return _centres(self.shape[0], self.size[0], self.centre[0])

    @property
    def y(self) -> Floats:
        """Cell centres along y, shape (ny,) [m]."""
        return _centres(self.shape[1], self.size[1], self.centre[1])

    @property
    def size_about_origin(self) -> tuple[float, float]:
        """Extents of the smallest region centred on the origin that contains the grid [m].

        >>> Grid((4, 4), (1.0, 1.0), centre=(-2.0, 0.0)).size_about_origin
        (5.0, 1.0)
        """
        (lx, ly), (x, y) = self.size, self.centre
        return lx + 2 * abs(x), ly + 2 * abs(y)

    def largest_at(self, field: Floats) -> tuple[float, float]:
        """Position of the largest value of a field over this grid.

        Parameters
        ----------
        field : ndarray, shape (nx, ny)
            The field.

        Returns
        -------
        tuple of float
            Centre of the cell [m].

        Examples
        --------
        >>> Grid((4, 4), (1.0, 1.0)).largest_at(np.arange(16.0).reshape(4, 4))
        (0.375, 0.375)
        """
        i, j = divmod(int(field.argmax()), self.shape[1])
        return float(self.x[i]), float(self.y[j])

    def widened(self, shape: tuple[int, int]) -> Grid:
        """Grid with additional cells around the same ones.

        Parameters
        ----------
        shape : tuple of int
            Numbers of cells, larger than those of this grid by even numbers, or equal.

        Returns
        -------
        Grid
            The centres of the old cells are among the new ones, to rounding.

        Raises
        ------
        ValueError
            If the old cells would not be preserved, or the period would change.

        Examples
        --------
        >>> Grid((4, 8), (0.02, 0.02)).widened((6, 8)).size
        (0.03, 0.02)
        """
        more = [new - old for new, old in zip(shape, self.shape, strict=True)]
        if any(count < 0 or count % 2 for count in more):
            raise ValueError(
                f"a grid of {self.shape} cells is widened by as many cells on either side, "
                f"not to {shape}"
            )
        if any(count and repeats for count, repeats in zip(more, self.periodic, strict=True)):
            raise ValueError(f"a period of {self.shape} cells has no more, got {shape}")
        pairs = zip(self.size, self.shape, shape, strict=True)
        along, across = (s if old == new else s / old * new for s, old, new in pairs)
        return replace(self, shape=shape, size=(along, across))

    def embed(self, field: Field, wider: Grid, beyond: float = 0.0) -> Field:
        """Embed a field over this grid in a wider one.

        Parameters
        ----------
        field : ndarray, shape (..., nx, ny)
            The field.
        wider : Grid
            This grid, `widened`.
        beyond : float
            Value outside this grid.

        Returns
        -------
        ndarray
            The field over the wider grid.

        Examples
        --------
        >>> small = Grid((4, 4), (1.0, 1.0))
        >>> small.embed(np.ones((4, 4)), small.widened((6, 4)))[:, 0].tolist()
        [0.0, 1.0, 1.0, 1.0, 1.0, 0.0]
        """
        (nx, ny), (wide_x, wide_y) = self.shape, wider.shape
        whole = np.full((*field.shape[:-2], wide_x, wide_y), beyond)
        first_x, first_y = (wide_x - nx) // 2, (wide_y - ny) // 2
        whole[..., first_x : first_x + nx, first_y : first_y + ny] = field
        return whole


@dataclass(frozen=True)
class AutomaticGrid(Displayable):
    """Automatic grid, whose cells the run chooses for a tolerance.

    Parameters
    ----------
    tolerance : float, optional
        Largest relative error of the quantities due to the mesh, between 1e-4 and 0.5 [-].
    quantities : sequence of str, optional
        Any of ``"peak_pressure"``, ``"contact_area"``, ``"approach"``; these three when left out.
        Where the approach is prescribed, the force takes its place.
        Also ``"mean_pressure"``, ``"contact_length"``, ``"contact_width"``, ``"peak_line_load"``,
        ``"force"``, ``"eccentricity_x"``, ``"eccentricity_y"``, ``"tilt_x"``, ``"tilt_y"``. Errors
        of eccentricities and tilts are relative to their absolute value, or where that is smaller,
        to a hundredth of the contact's extent, and of the displacement over that extent.
    largest_cell : tuple of float, optional
        Largest edge lengths (dx, dy) of a cell [m]; cells that the tolerance allows to be larger
        get these. Runs on equal cells can be compared where a peak pressure has no limit.

    Raises
    ------
    ValueError
        If the tolerance is out of range, a quantity is unknown, or a length is not positive and
        finite.

    Examples
    --------
    >>> AutomaticGrid(tolerance=0.005, quantities=["approach"])
    AutomaticGrid(tolerance=0.005, quantities=('approach',), largest_cell=None)
    """

    tolerance: float = field(default=0.01, metadata={"unit": "1"})
    quantities: Sequence[str] = GRID_QUANTITIES
    largest_cell: tuple[float, float] | None = field(default=None, metadata={"unit": "m"})

    def __post_init__(self) -> None:
        allowed = as_real(self.tolerance)
        if allowed is None or not FINEST <= allowed <= COARSEST:
            raise ValueError(
                f"tolerance must lie between {FINEST:g} and {COARSEST:g}, got {self.tolerance!r}"
            )
        named = self.quantities
        names = tuple(named) if isinstance(named, tuple | list) else ()
        if not names or any(name not in MESH_QUANTITIES for name in names):
            raise ValueError(
                f"quantities must name some of {', '.join(MESH_QUANTITIES)}, got {named!r}; the "
                "errors of other results follow from the whole history: see their error bars"
            )
        store(self, tolerance=allowed, quantities=tuple(dict.fromkeys(names)))
        if self.largest_cell is not None:
            cell = _lengths("largest_cell", ("dx", "dy"), self.largest_cell, positive)
            store(self, largest_cell=cell)


def _pair(name: str, given: Any) -> tuple[Any, Any]:
    try:
        along_x, along_y = given
    except (TypeError, ValueError):
        raise ValueError(f"grid.{name} needs two entries, along x and y, got {given!r}") from None
    return along_x, along_y


def _lengths(
    name: str, parts: tuple[str, str], given: Any, check: Callable[[str, object, str], float]
) -> tuple[float, ...]:
    pairs = zip(parts, _pair(name, given), strict=True)
    return tuple(check(f"grid.{name}: {part}", each, "m") for part, each in pairs)


def _centres(cells: int, extent: float, middle: float) -> Floats:
    # Built from whole numbers so that mirrored centres are exact opposites around the origin.
    offsets = (2 * np.arange(cells) - (cells - 1)).astype(np.float64)
    return middle + offsets * (extent / (2 * cells))
