"""The half-space under a grid, and under patches of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from viscontact.balance import RigidPlane
from viscontact.convolution import Convolution, Preconditioner
from viscontact.grid import Grid
from viscontact.influence import influence_table

#: Free cells kept around a contact in its patch, as a part of the contact's extent.
PATCH_MARGIN = 0.06

#: A patch of more than this part of the grid saves nothing.
WORTHWHILE = 0.8


@dataclass(frozen=True, eq=False)
class Patch:
    """A rectangular block of the grid's cells with the operators that live on it.

    Attributes
    ----------
    rows, columns : slice
        Where it lies in the grid.
    cell_area : float
        Area of a cell [m²].
    convolution : Convolution
        Deflection of the patch under pressure on the patch.
    preconditioner : Preconditioner
        Rough inverse of it.
    plane : RigidPlane
        Planes over the patch.
    """

    rows: slice
    columns: slice
    cell_area: float
    convolution: Convolution
    preconditioner: Preconditioner
    plane: RigidPlane

    def cut(self, field: NDArray[np.float64]) -> NDArray[np.float64]:
        """The patch's part of a field on the grid."""
        return field[self.rows, self.columns]

    def embed(self, field: NDArray[np.float64], shape: tuple[int, int]) -> NDArray[np.float64]:
        """A field on the grid that is zero outside the patch."""
        whole = np.zeros(shape)
        whole[self.rows, self.columns] = field
        return whole

    def holds(self, rows: slice, columns: slice) -> bool:
        """Whether a block of cells lies within the patch."""
        return _within(rows, self.rows) and _within(columns, self.columns)


class HalfSpace:
    """A grid on the half-space: the patch of all its cells, and smaller ones around contacts.

    Searching for the pressure on the contact's own patch costs a fraction of what the whole grid
    does; what is found is checked on the whole grid. The last patch is kept, for a contact that
    creeps stays in it for many steps.

    Parameters
    ----------
    grid : Grid
        The cells that carry pressure and displacement.
    threads : int
        Threads of one transform.
    """

    def __init__(self, grid: Grid, threads: int = 1) -> None:
        self.grid = grid
        self._threads = threads
        self._coefficients = influence_table(grid.shape, grid.cell_size)
        self.whole = self._patch(slice(0, grid.shape[0]), slice(0, grid.shape[1]))
        self._last = self.whole

    def patch_around(self, cells: NDArray[np.bool_]) -> Patch:
        """A patch that holds the given cells with some room to grow.

        Parameters
        ----------
        cells : ndarray of bool, shape (nx, ny)
            Cells that it has to hold.

        Returns
        -------
        Patch
            The last one if it fits well, the whole grid if a patch would save little.
        """
        tight = [_span(np.any(cells, axis=1)), _span(np.any(cells, axis=0))]
        roomy = [_widened(span, n) for span, n in zip(tight, self.grid.shape, strict=True)]
        if _size(roomy) > WORTHWHILE * cells.size:
            return self.whole
        guarded = [slice(max(span.start - 1, 0), span.stop + 1) for span in tight]
        if not self._last.holds(guarded[0], guarded[1]) or (
            _size([self._last.rows, self._last.columns]) > 1.3 * _size(roomy)
        ):
            self._last = self._patch(*roomy)
        return self._last

    def _patch(self, rows: slice, columns: slice) -> Patch:
        grid = self.grid
        shape = (rows.stop - rows.start, columns.stop - columns.start)
        return Patch(
            rows,
            columns,
            grid.cell_area,
            Convolution(self._coefficients[: shape[0], : shape[1]], self._threads),
            Preconditioner(shape, grid.cell_size, self._threads),
            RigidPlane(grid.x[rows], grid.y[columns], grid.cell_size),
        )


def _span(occupied: NDArray[np.bool_] | np.bool_) -> slice:
    index = np.flatnonzero(occupied)
    return slice(int(index[0]), int(index[-1]) + 1) if len(index) else slice(0, 1)


def _widened(span: slice, cells: int) -> slice:
    """A margin on both sides, then up to a length that is good to transform, within the grid."""
    extent = span.stop - span.start
    wanted = extent + 2 * max(3, int(np.ceil(PATCH_MARGIN * extent)))
    length = min(fft.next_fast_len(wanted, real=True), cells)
    start = min(max((span.start + span.stop - length) // 2, 0), cells - length)
    return slice(start, start + length)


def _within(inner: slice, outer: slice) -> bool:
    return bool(outer.start <= inner.start and inner.stop <= outer.stop)


def _size(spans: list[slice]) -> int:
    return int(np.prod([span.stop - span.start for span in spans]))
