"""Half-space cut by planes across x: free ends, and frictionless walls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from viscontact.backend.arrays import Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import Field
from viscontact.mechanics import halfspace
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.influence import influence_table
from viscontact.mechanics.halfspace.layered_influence import (
    periodic_layered_coefficient,
    periodic_layered_table,
)
from viscontact.mechanics.halfspace.moving_load import MovingCompliance, moving_influence_table
from viscontact.mechanics.halfspace.periodic_influence import smooth_periodic_table
from viscontact.mechanics.halfspace.surface_response import (
    HALF_SPACE,
    HalfSpaceResponse,
    SummedResponse,
    SurfaceResponse,
)

if TYPE_CHECKING:
    from viscontact.mechanics.halfspace.end_correction import (
        EndBasis,
        EndCorrection,
        MovingEndCorrection,
    )
    from viscontact.mechanics.halfspace.periodic_ends import MirroredPeriod, PeriodicBasis


#: Most cells of a domain whose rows are kept beyond it.
KEPT_CELLS = 50_000


@dataclass(frozen=True)
class EndedResponse(HalfSpaceResponse):
    """Half-space that ends at planes across x; far from them it is one without ends."""

    poisson_ratio: float
    planes: tuple[float | None, float | None]  # at -x and at +x [m]; None: it goes on
    free: tuple[bool, bool]  # free of stress; otherwise held by a frictionless wall
    #: All pressures are even about the middle between two planes.
    even: bool = field(default=False, kw_only=True)


@dataclass(frozen=True)
class EndedLayers(EndedResponse):
    """Layers on a rigid base that end at two planes across x."""

    stack: ElasticStack

    @property
    def long_waves(self) -> float:  # type: ignore[override]
        """Limit of L for long waves, which the base does not let pass [-]."""
        return self.stack.long_waves

    @property
    def length(self) -> float:  # type: ignore[override]
        """Thickness of the thinnest layer [m]."""
        return self.stack.length

    def ratio(self, wave_number: Numbers) -> Numbers:
        """L at wave numbers [1/m], far from the ends."""
        return self.stack.ratio(wave_number)

    @property
    def mean_displacement(self) -> float:
        """Displacement per uniform p and J, without strain across [m]."""
        return self.stack.mean_displacement


def parts_of(response: SurfaceResponse) -> list[tuple[SurfaceResponse, float]]:
    """Responses that are no sums, with their weights."""
    if not isinstance(response, SummedResponse):
        return [(response, 1.0)]
    pairs = zip(response.parts, response.weights, strict=True)
    return [(part, weight * own) for each, weight in pairs for part, own in parts_of(each)]


def has_ends(response: SurfaceResponse) -> bool:
    """True of a half-space that ends, and of a sum with one."""
    return any(isinstance(part, EndedResponse) for part, _ in parts_of(response))


def planes_in(response: SurfaceResponse) -> tuple[float, ...]:
    """Positions x of all ends of a response [m]."""
    ended = (part for part, _ in parts_of(response) if isinstance(part, EndedResponse))
    return tuple(plane for part in ended for plane in part.planes if plane is not None)


def has_even_ends(response: SurfaceResponse) -> bool:
    """True if all ends are alike on both sides of x = 0, and without ends."""
    ended = [part for part, _ in parts_of(response) if isinstance(part, EndedResponse)]
    return all(
        part.free[0] == part.free[1]
        and None not in part.planes
        and part.planes[0] == -(part.planes[1] or 0.0)
        for part in ended
    )


@dataclass(frozen=True, eq=False)
class EndedRows:
    """Rows of cells between planes across x, with what all blocks of them share."""

    borders: tuple[int | None, int | None]  # planes in rows from the first row of the domain
    coefficients: Floats  # [m], of the period of two lengths, or empty for one plane
    bases: tuple[EndBasis, ...]  # of the free ends, over the rows within the body
    first: int  # first row of the domain within the body
    #: Under a load that moves along y; coefficients are at signed offsets then, for one plane, too.
    moving: MovingCompliance | None = None
    repeats: bool = False  # the columns are a period along y
    periodic: tuple[PeriodicBasis, ...] = ()  # in place of `bases` then

    def mirrored_coefficients(
        self, shape: tuple[int, int], cell_size: tuple[float, float]
    ) -> Floats:
        """Coefficients of the mirrored half-space over a shape of cells with its image [m]."""
        rows, columns = shape
        if self.moving is not None:
            middle = self.coefficients.shape[1] // 2
            return self.coefficients[:rows, middle - columns + 1 : middle + columns]
        if self.repeats:
            return self.coefficients[:rows]
        if None not in self.borders:
            return self.coefficients[:, :columns]
        return influence_table(shape, cell_size)


def ended_rows(
    response: EndedResponse,
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    borders: tuple[int | None, int | None],
    moving: MovingCompliance | None = None,
    *,
    periodic: bool = False,
) -> EndedRows:
    """Rows of a domain of a shape that has all columns, with planes at borders of its rows.

    With `periodic`, the columns are a period along y.
    """
    few = moving is None and shape[0] * shape[1] <= KEPT_CELLS
    if periodic:
        return (_kept_period if few else _rows_of_period)(response, shape, cell_size, borders)
    return (_kept_rows if few else _rows)(response, shape, cell_size, borders, moving)


def _rows(
    response: EndedResponse,
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    borders: tuple[int | None, int | None],
    moving: MovingCompliance | None,
) -> EndedRows:
    """The same, computed."""
    before, after = borders
    begin = max(before or 0, 0)
    end = shape[0] if after is None else min(after, shape[0])
    width = shape[1] * cell_size[1]
    longest = 0.0
    if moving is not None:
        # Of material that returns, up to half of its way.
        reach = np.where(np.isinf(moving.periods), moving.lengths, moving.periods / 2)
        longest = float(reach.max(initial=0.0))
    shared = (cell_size, width, longest)
    bases = _bases_of_ends(response, range(begin, end), borders, *shared)
    if moving is None:
        for basis in bases:
            basis.table(shape[1], cell_size[1])  # of all columns at once
    if moving is not None:
        count = end if after is None else after - (before or 0)
        part = (count, shape[1])
        if isinstance(response, EndedLayers):
            table = _moving_table_of_layers(part, cell_size, moving, response.stack)
        else:
            table = _moving_table(part, cell_size, moving, periodic=None not in borders)
        return EndedRows(borders, table, bases, begin, moving)
    table = np.empty((0, 0))
    if before is not None and after is not None:
        # With the datum of a grid that is periodic.
        period = 2 * (after - before)
        layers = response.stack if isinstance(response, EndedLayers) else None
        cells = (period, shape[1])
        table = (
            smooth_periodic_table(cells, cell_size, width)
            if layers is None
            else periodic_layered_table(cells, cell_size, layers, width)
        )
    return EndedRows(borders, table, bases, begin)


def _rows_of_period(
    response: EndedResponse,
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    borders: tuple[int | None, int | None],
) -> EndedRows:
    """The same where the columns are a period along y."""
    before, after = borders
    begin = max(before or 0, 0)
    rows = range(begin, shape[0] if after is None else min(after, shape[0]))
    bases = halfspace.periodic_ends.bases_of_period(response, rows, borders, cell_size, shape[1])
    table = np.empty((0, 0))
    if before is None or after is None:
        count = shape[0] - (before or 0) if after is None else after - begin
        turned = (shape[1], 2 * count), cell_size[::-1]
        # Line loads displace nothing at the distance of the grid's length.
        datum = shape[0] * cell_size[0]
        table = periodic_layered_table(*turned, HALF_SPACE, datum).T
    return EndedRows(borders, table, (), begin, repeats=True, periodic=bases)


#: Kept rows of small grids: an automatic grid is found by several solutions on each of some grids.
_kept_rows = lru_cache(maxsize=8)(_rows)
_kept_period = lru_cache(maxsize=8)(_rows_of_period)


def _moving_table(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    moving: MovingCompliance,
    *,
    periodic: bool,
) -> Floats:
    """Coefficients of a load that moves along y, for rows from a plane on, or between two."""
    if not periodic:
        return moving_influence_table((2 * shape[0], shape[1]), cell_size, moving, 1)
    period, datum = 2 * shape[0] * cell_size[0], shape[1] * cell_size[1]

    def with_images(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        near = np.minimum(across, period - across)
        return halfspace.periodic_influence_coefficient(near, along, cell[::-1], period, datum)

    half = moving_influence_table((shape[0] + 1, shape[1]), cell_size, moving, 1, with_images)
    offsets = np.arange(2 * shape[0])
    return np.asarray(half[np.minimum(offsets, 2 * shape[0] - offsets)])


def _moving_table_of_layers(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    moving: MovingCompliance,
    stack: ElasticStack,
) -> Floats:
    """The same for layers, for rows between two planes."""
    count, datum = 2 * shape[0], shape[1] * cell_size[1]

    def with_images(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        places = np.abs(along[:, 0])
        return periodic_layered_coefficient(count, places, cell[::-1], stack, datum).T

    half = moving_influence_table((shape[0] + 1, shape[1]), cell_size, moving, 1, with_images)
    offsets = np.arange(count)
    return np.asarray(half[np.minimum(offsets, count - offsets)])


def _bases_of_ends(
    response: EndedResponse,
    rows: range,
    borders: tuple[int | None, int | None],
    cell_size: tuple[float, float],
    width: float,
    longest: float,
) -> tuple[EndBasis, ...]:
    """Low-rank forms of what the free ends add on rows of a domain."""
    before, after = borders
    ratio, free = response.poisson_ratio, response.free
    if not rows or not any(free):
        return ()
    if before is not None and after is not None:
        stack = response.stack if isinstance(response, EndedLayers) else None
        strip = halfspace.strip_basis.StripRows(after - before, free, response.even, stack)
        inside = range(rows.start - before, rows.stop - before)
        shared = (ratio, strip, inside, cell_size, width)
        stack = response.stack if isinstance(response, EndedLayers) else None
        return tuple(
            halfspace.strip_basis.strip_basis(*shared, odd=odd, longest=longest)
            for odd in strip.kinds
        )
    if before is not None:
        inside = range(rows.start - before, rows.stop - before)
        return (halfspace.end_basis(ratio, inside, cell_size, longest),)
    assert after is not None  # at least one plane is given
    inside = range(after - rows.stop, after - rows.start)
    return (halfspace.end_basis(ratio, inside, cell_size, longest).turned(),)


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
