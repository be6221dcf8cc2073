"""Operators of a half-space that ends, on blocks of cells."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from viscontact.backend.arrays import Numbers
from viscontact.backend.transforms import Field
from viscontact.mechanics import halfspace
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.ended_rows import EndedRows

if TYPE_CHECKING:
    from viscontact.mechanics.halfspace.end_correction import EndCorrection, MovingEndCorrection
    from viscontact.mechanics.halfspace.periodic_ends import MirroredPeriod


class Operator(Protocol):
    """Map of pressure to displacement over compliance."""

    def apply(self, pressure: Field, into: Field | None = None) -> Field:
        """Displacement over compliance [Pa m] under a pressure [Pa]."""
        ...


def _rows_from_plane(
    borders: tuple[int | None, int | None], begin: int, end: int
) -> tuple[int, int]:
    """Rows of the convolution, which begins at a plane, and the place of a block among them.

    From the plane at +x, if there is no other, they are counted back. Between two planes the
    convolution takes all rows.
    """
    before, after = borders
    if before is None:
        assert after is not None  # at least one plane is given
        return after - begin, after - end
    return (end if after is None else after) - before, begin - before


class EndedConvolution:
    """Surface displacement of a body that ends at one plane across x, or at two.

    The pressure is even about the planes, which are borders of cells: the mirrored half-space is a
    convolution by cosine transforms, from a plane on. What free ends add is an `EndCorrection`.
    Cells beyond a plane are outside the body: their pressure has no effect, and they stay at rest.
    """

    #: The compiled core has no filter for it.
    compiled: None = None
    workspace: None = None

    def __init__(
        self,
        ended: EndedRows,
        block: tuple[slice, slice],
        cell_size: tuple[float, float],
        *,
        mirrored: bool = False,
        single: bool = False,
        **options: Any,
    ) -> None:
        """Take the rows and columns of a block; `mirrored` keeps half of the columns."""
        rows, columns = block
        self.shape = (rows.stop - rows.start, columns.stop - columns.start)
        before, after = ended.borders
        begin = rows.start if before is None else max(rows.start, before)
        end = rows.stop if after is None else min(rows.stop, after)
        self._inside = slice(begin - rows.start, end - rows.start)
        self._turned = before is None
        count, start = _rows_from_plane(ended.borders, begin, end)
        self._rows = slice(start, start + end - begin)
        ny = self.shape[1] * (1 + mirrored)
        periodic, moving = None not in ended.borders, ended.moving
        self._mirrored: Convolution | MirroredPeriod
        if ended.repeats and periodic:
            del options["team"]
            period = halfspace.periodic_ends.MirroredPeriod
            self._mirrored = period((count, ny), cell_size, single=single, **options)
        else:
            self._mirrored = Convolution(
                ended.mirrored_coefficients((2 * count, ny), cell_size),
                mirrored=(True, mirrored),
                periodic=(periodic, ended.repeats),
                single=single,
                signed=None if moving is None else 1,
                **options,
            )
        self._padded = (
            None
            if count == end - begin
            else np.zeros((count, self.shape[1]), np.float32 if single else np.float64)
        )
        own = slice(begin - ended.first, end - ended.first)
        shared = {"single": single, "transforms": options["transforms"]}
        self._corrections = _corrections_of(ended, own, ny, cell_size, mirrored, shared)

    def apply(self, pressure: Field, into: Field | None = None) -> Field:
        """Displacement over compliance [Pa m] under a pressure [Pa]; written to `into` if given."""
        result: Numbers = np.empty(self.shape) if into is None else into
        inside = pressure[self._inside]
        found = self._of_mirrored(inside)
        for correction in self._corrections:
            found += correction.apply(inside)
        result[: self._inside.start] = result[self._inside.stop :] = 0.0
        result[self._inside] = found
        return result

    def _of_mirrored(self, inside: Field) -> Field:
        """Displacement of the mirrored half-space within the body."""
        turn = slice(None, None, -1 if self._turned else 1)
        if self._padded is None:
            return self._mirrored.apply(inside[turn])[turn]
        self._padded[self._rows] = inside[turn]
        return self._mirrored.apply(self._padded)[self._rows][turn]


def _corrections_of(
    ended: EndedRows,
    rows: slice,
    columns: int,
    cell_size: tuple[float, float],
    mirrored: bool,
    options: dict[str, Any],
) -> list[EndCorrection | MovingEndCorrection]:
    """What free ends add on rows of the body and a number of columns, with options of all."""
    if ended.repeats:
        period = halfspace.periodic_ends.PeriodicEndCorrection
        return [period(basis, rows, columns, **options) for basis in ended.periodic]
    found: list[EndCorrection | MovingEndCorrection] = []
    for basis in ended.bases:
        if ended.moving is None:
            shared = (basis, rows, columns, cell_size)
            found.append(halfspace.EndCorrection(*shared, mirrored=mirrored, **options))
        else:
            moved = (basis, rows, columns, cell_size[1], ended.moving)
            found.append(halfspace.MovingEndCorrection(*moved, **options))
    return found


class WeightedOperators:
    """Weighted sum of operators on the same block."""

    #: The compiled core has no filter for it.
    compiled: None = None
    workspace: None = None

    def __init__(
        self, operators: Sequence[Operator], weights: Sequence[float], uniform: float = 0.0
    ) -> None:
        """Take operators and weights, and a displacement by the sum of all pressures [m]."""
        self._operators, self._weights, self._uniform = operators, weights, uniform

    def less(self, uniform: float) -> WeightedOperators:
        """The sum less a displacement by the sum of all pressures [m]."""
        return WeightedOperators(self._operators, self._weights, self._uniform - uniform)

    def apply(self, pressure: Field, into: Field | None = None) -> Field:
        """Displacement over compliance [Pa m] under a pressure [Pa]; written to `into` if given."""
        first, *others = zip(self._operators, self._weights, strict=True)
        total = first[0].apply(pressure, into)
        if first[1] != 1.0:
            total *= first[1]
        for operator, weight in others:
            total += weight * operator.apply(pressure)
        if self._uniform:
            total += self._uniform * pressure.sum()
        return total
