"""Work on fields in blocks of lines that stay in the processor's cache, by one or several threads.

What is done to a block line by line needs memory for temporary arrays of one block only. Results
are returned in the order of the blocks, so that sums of them do not depend on the threads.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from types import ModuleType
from typing import Any, TypeVar

import numpy as np

from viscontact.backend.arrays import Bools, Field, Floats, Numbers
from viscontact.backend.transforms import largest_of

#: Size of the lines that are worked on at once [bytes].
BLOCK_BYTES = 2**21

#: Numbers of threads that share blocks evenly are those that divide this.
EVEN_SHARES = 4

#: Start of each array in a workspace, for vector instructions [bytes].
ALIGNMENT = 64

_Block = TypeVar("_Block")
_Found = TypeVar("_Found")


class Team:
    """Threads that share blocks out among themselves, the caller's being one of them.

    Examples
    --------
    >>> Team(2).each(lambda block: block.start, blocks_of(5, 2**19))
    [0, 2, 3, 4]
    """

    def __init__(self, threads: int = 1, core: ModuleType | None = None) -> None:
        #: `core` has the passes that are compiled; None: all are in NumPy.
        self.threads, self.core = threads, core

    @cached_property
    def _pool(self) -> ThreadPoolExecutor:
        return ThreadPoolExecutor(self.threads - 1)

    def each(self, work: Callable[[_Block], _Found], blocks: Sequence[_Block]) -> list[_Found]:
        """Work on all blocks, and return what that gives, in their order."""
        if self.threads == 1 or len(blocks) <= 1:
            return [work(block) for block in blocks]
        shares = min(self.threads, len(blocks))

        def share(first: int) -> list[_Found]:
            return [work(block) for block in blocks[first::shares]]

        others = [self._pool.submit(share, first) for first in range(1, shares)]
        found = [share(0), *(other.result() for other in others)]
        return [found[place % shares][place // shares] for place in range(len(blocks))]

    def each_rows(
        self, work: Callable[..., object], blocks: Sequence[slice], *fields: Numbers
    ) -> None:
        """Work on blocks of rows of some fields; `work` takes the same rows of each.

        >>> total = np.zeros((2, 2))
        >>> Team().each_rows(np.copyto, [slice(1), slice(1, 2)], total, np.eye(2))
        >>> total.tolist()
        [[1.0, 0.0], [0.0, 1.0]]
        """
        if len(blocks) == 1:
            work(*fields)
            return
        self.each(lambda rows: work(*(field[rows] for field in fields)), blocks)

    def each_part(self, work: Callable[..., object], *fields: Numbers) -> None:
        """Work on fields of one shape part by part; `work` takes the same part of each.

        Fields are contiguous. A part is a row of numbers in a field's memory, or all of a small
        field.

        >>> total = np.zeros((2, 2))
        >>> Team().each_part(lambda part, other: np.add(part, other, out=part), total, np.eye(2))
        >>> total.tolist()
        [[1.0, 0.0], [0.0, 1.0]]
        """
        if fields[0].nbytes <= BLOCK_BYTES:
            work(*fields)
            return
        # Not `reshape`, which copies fields that are not contiguous.
        rows = [field.view() for field in fields]
        for row in rows:
            row.shape = (row.size,)
        blocks = blocks_of(rows[0].size, rows[0].itemsize)
        self.each(lambda block: work(*(row[block] for row in rows)), blocks)

    def weighted_sum(
        self, total: Floats, weights: Sequence[float], fields: Sequence[Floats]
    ) -> Floats:
        """Write a weighted sum of contiguous fields to a field, which may be the first of them.

        >>> Team().weighted_sum(np.empty(2), [2.0, 1.0], [np.ones(2), np.arange(2.0)]).tolist()
        [2.0, 3.0]
        """
        if self.core is not None:
            self.core.weighted_sum(total, list(map(float, weights)), list(fields), self.threads)
            return total

        def add(found: Floats, first: Floats, *others: Floats) -> None:
            np.multiply(weights[0], first, out=found)
            for weight, other in zip(weights[1:], others, strict=True):
                found += other if weight == 1.0 else weight * other

        self.each_part(add, total, *fields)
        return total

    def mean_change(self, where: Bools, late: Floats, early: Floats | None = None) -> float:
        """Mean absolute difference of two fields over some cells, or of one to zero; 0 for none.

        >>> Team().mean_change(np.ones((1, 2), bool), np.array([[1.0, -3.0]]))
        2.0
        """
        if self.core is not None:
            given = (None if each is None else np.ascontiguousarray(each) for each in (late, early))
            return float(self.core.mean_change(np.ascontiguousarray(where), *given, self.threads))

        def sums(rows: slice) -> tuple[int, float]:
            here = late[rows] if early is None else late[rows] - early[rows]
            cells = where[rows]
            return int(np.count_nonzero(cells)), float(np.abs(here).sum(where=cells))

        counts, totals = zip(*self.each(sums, blocks_of(len(late), late[:1].nbytes)), strict=True)
        return sum(totals) / sum(counts) if any(counts) else 0.0

    def unfold(self, field: Field, mirrored: tuple[bool, bool]) -> Field:
        """Field with its mirror images before the first row, column, or both; itself without any.

        >>> Team().unfold(np.array([[1.0, 2.0]]), (False, True)).tolist()
        [[2.0, 1.0, 1.0, 2.0]]
        """
        if self.core is not None and any(mirrored):
            (rows, columns), (along_x, along_y) = field.shape, mirrored
            is_flags = field.dtype == bool
            if not field.flags.c_contiguous or not (is_flags or field.dtype == np.float64):
                field = np.ascontiguousarray(field, bool if is_flags else np.float64)
            whole = np.empty((rows * (1 + along_x), columns * (1 + along_y)), field.dtype)
            (self.core.unfold_flags if is_flags else self.core.unfold)(field, whole)
            return whole
        for axis in (0, 1):
            if mirrored[axis]:
                field = np.concatenate([np.flip(field, axis), field], axis)
        return field

    def spans(self, cells: Bools) -> tuple[slice, slice] | None:
        """Smallest slices of rows and columns that hold the marked cells; None without any.

        >>> Team().spans(np.array([[False, True], [False, True]]))
        (slice(0, 2, None), slice(1, 2, None))
        """
        if self.core is not None:
            found = self.core.spans(np.ascontiguousarray(cells))
            first_row, last_row, first_column, last_column = found
            if last_row < 0:
                return None
            return slice(first_row, last_row + 1), slice(first_column, last_column + 1)
        rows, columns = (np.flatnonzero(np.any(cells, axis=axis)) for axis in (1, 0))
        if not rows.size:
            return None
        return slice(int(rows[0]), int(rows[-1]) + 1), slice(int(columns[0]), int(columns[-1]) + 1)


def order_of(
    field: Numbers, blocks: Sequence[slice], number: np.dtype[Any], team: Team, axis: int = 0
) -> float:
    """Return the factor to divide a field by before it is stored as `number`.

    In single precision, with its few exponents, that is its largest value; else 1. It is looked for
    in blocks of the field's lines along an axis.

    Examples
    --------
    >>> order_of(np.array([[1e-99, -4e-99]]), [slice(1)], np.dtype(np.float32), Team())
    4e-99
    """
    if number == field.dtype:
        return 1.0
    if len(blocks) == 1:
        return largest_of(field) or 1.0
    parts = [field[lines] if axis == 0 else field[:, lines] for lines in blocks]
    return max(team.each(largest_of, parts)) or 1.0


class Workspace:
    """Memory that the operators of one domain use in turn, each only while it is applied."""

    def __init__(self) -> None:
        self._bytes = np.empty(0, np.uint8)
        #: Arrays that have been asked for, in this memory.
        self._arrays: dict[tuple[tuple[tuple[int, ...], np.dtype[Any]], ...], list[Numbers]] = {}

    def array(self, shape: tuple[int, ...], kind: np.dtype[Any]) -> Numbers:
        """Return an array without particular values, valid until the next call."""
        return self.arrays((shape, kind))[0]

    def arrays(self, *wanted: tuple[tuple[int, ...], np.dtype[Any]]) -> list[Numbers]:
        """Return arrays of shapes and kinds, beside each other, valid until the next call."""
        if wanted not in self._arrays:
            self._arrays[wanted] = self._made(wanted)
        return self._arrays[wanted]

    def _made(self, wanted: tuple[tuple[tuple[int, ...], np.dtype[Any]], ...]) -> list[Numbers]:
        sizes = [math.prod(shape) * kind.itemsize for shape, kind in wanted]
        *begins, end = itertools.accumulate((size + -size % ALIGNMENT for size in sizes), initial=0)
        if end > len(self._bytes):
            self._arrays.clear()
            self._bytes = np.empty(0, np.uint8)  # freed before the larger one is made
            self._bytes = np.empty(end, np.uint8)
        return [
            self._bytes[begin : begin + size].view(kind).reshape(shape)
            for begin, size, (shape, kind) in zip(begins, sizes, wanted, strict=True)
        ]


def blocks_of(lines: int, bytes_per_line: int) -> list[slice]:
    """Blocks of lines of at most `BLOCK_BYTES`, as even as possible; the first is the largest.

    Several blocks are a multiple of `EVEN_SHARES`, so that threads get equal shares of them.

    Examples
    --------
    >>> blocks_of(5, 2**19)
    [slice(0, 2, None), slice(2, 3, None), slice(3, 4, None), slice(4, 5, None)]
    """
    most = max(1, BLOCK_BYTES // max(1, bytes_per_line))
    count = -(-lines // most)
    if count > 1:
        count = min(lines, count + -count % EVEN_SHARES)
    ends = [-(-lines * place // count) for place in range(count + 1)] if count else [0]
    return [slice(start, stop) for start, stop in itertools.pairwise(ends)]
