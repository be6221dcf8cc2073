"""Patch of a contact domain: a rectangular block of cells with the operators of the search."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from viscontact.backend import compiled
from viscontact.backend.arrays import Field, Singles
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Workspace
from viscontact.mechanics.contact.passes.contract import SearchPasses
from viscontact.mechanics.contact.response_parts import Operator
from viscontact.mechanics.contact.rigid_balance import RigidPlane
from viscontact.mechanics.halfspace.preconditioner import Preconditioner

#: Part of the cells of a patch up to which a change of the active ones is followed cell by cell.
FEW_CHANGES = 1e-3


class PatchOperators:
    """Operators of the search on a block of cells, made when they are first used."""

    def __init__(
        self,
        shape: tuple[int, int],
        convolution: Callable[[], Operator],
        preconditioner: Callable[[], Preconditioner],
    ) -> None:
        self._shape = shape
        self._convolution, self._preconditioner = convolution, preconditioner
        self._near = np.empty((0, 0), np.float32)
        self._spare: list[Singles] = []

    def spare(self, number: int) -> Singles:
        """Field of a number without particular values, for one search at a time."""
        # New fields of a search take longer than what is done with them: the system gives and takes
        # back their memory each time.
        while len(self._spare) <= number:
            self._spare.append(np.empty(self._shape, np.float32))
        return self._spare[number]

    @cached_property
    def convolution(self) -> Operator:
        """Pressure to unit displacement, in single precision."""
        return self._convolution()

    @cached_property
    def preconditioner(self) -> Preconditioner:
        """Approximate inverse of the convolution."""
        return self._preconditioner()

    @cached_property
    def compiled(self) -> tuple[Any, Workspace] | None:
        """Operators of the compiled core and memory for them; None where it lacks one of them."""
        filters = self.convolution.compiled, *self.preconditioner.compiled
        core, of_core = compiled.core, [each.of_core for each in filters if each is not None]
        if core is None or len(of_core) < len(filters):
            return None
        near = self.near_stiffness(np.empty(self._shape, np.float32))
        few = int(FEW_CHANGES * self._shape[0] * self._shape[1])
        return core.Operators(*of_core, near, few), self.convolution.workspace or Workspace()

    def near_stiffness(self, spare: Singles) -> Singles:
        """Stiffness between a cell and those around it, shape (3, 3) [1/m]; uses a field up."""
        if not self._near.size:
            rows, columns = (count // 2 for count in self._shape)
            spare[...] = 0.0
            spare[rows, columns] = 1.0
            found = self.preconditioner.stiffness_of(spare, into=spare)
            self._near = np.zeros((3, 3), np.float32)
            for down, right in np.ndindex(3, 3):
                row, column = rows + down - 1, columns + right - 1
                if 0 <= row < self._shape[0] and 0 <= column < self._shape[1]:
                    self._near[down, right] = found[row, column]
        return self._near


@dataclass(frozen=True, eq=False)
class Patch:
    """Rectangular block of cells with its operators."""

    rows: slice  # position in the fields of the domain
    columns: slice
    cell_area: float  # [m²]
    arm: float  # longer edge, which scales moments to forces [m]
    operators: PatchOperators
    plane: RigidPlane  # rigid motions over the patch
    passes: SearchPasses  # what the search does cell by cell

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of rows and columns."""
        return self.rows.stop - self.rows.start, self.columns.stop - self.columns.start

    @property
    def convolution(self) -> Operator:
        """Pressure to unit displacement, in single precision."""
        return self.operators.convolution

    @property
    def preconditioner(self) -> Preconditioner:
        """Approximate inverse of the convolution."""
        return self.operators.preconditioner

    def cut(self, field: Field) -> Field:
        """The patch's part of a field."""
        return field[self.rows, self.columns]

    def holds(self, rows: slice, columns: slice) -> bool:
        """True if a block of cells lies within the patch."""
        return _lies_within(rows, self.rows) and _lies_within(columns, self.columns)


def _lies_within(inner: slice, outer: slice) -> bool:
    """True if a slice lies within another."""
    return bool(outer.start <= inner.start and inner.stop <= outer.stop)
