"""Filters of the compiled core against NumPy's transforms of whole, periodic fields."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viscontact.backend import compiled
from viscontact.backend.arrays import Floats
from viscontact.backend.compiled_filter import CompiledFilter, compiled_filter
from viscontact.backend.team import Team, Workspace

pytestmark = pytest.mark.skipif(compiled.core is None, reason="no compiled core")

#: Lengths of transforms with prime factors of 2, 3 and 5, also long ones that are done in parts.
LENGTHS = [1, 2, 3, 4, 5, 6, 8, 9, 10, 12, 15, 16, 18, 20, 25, 27, 32, 36, 45, 48, 50, 64, 200, 256]

pairs = st.tuples(st.sampled_from(LENGTHS), st.sampled_from(LENGTHS))
evens = st.tuples(st.booleans(), st.booleans())


def team(threads: int = 1) -> Team:
    return Team(threads, compiled.core)


def made(
    shape: tuple[int, int],
    lengths: tuple[int, int],
    even: tuple[bool, bool],
    symbol: Floats,
    *,
    single: bool = False,
    threads: int = 1,
) -> CompiledFilter:
    found = compiled_filter(team(threads), shape, lengths, even, symbol, single=single)
    assert found is not None
    return found


def waves(lengths: tuple[int, int], even: tuple[bool, bool]) -> tuple[int, int]:
    """Numbers of entries of a symbol."""
    rows, columns = (
        length if is_even else length // 2 + 1
        for length, is_even in zip(lengths, even, strict=True)
    )
    return rows, columns


def whole_lines(field: Floats, length: int, axis: int, *, even: bool) -> Floats:
    """Period of a field: zeros behind its lines, and their mirror images where they are even."""
    missing = [(0, 0), (0, 0)]
    missing[axis] = (0, length - field.shape[axis])
    padded = np.pad(field, missing)
    return np.concatenate([padded, np.flip(padded, axis)], axis) if even else padded


def whole_symbol(symbol: Floats, length: int, axis: int, *, even: bool) -> Floats:
    """Symbol at all waves of a period. An even line has nothing of its shortest wave."""
    period = 2 * length if even else length
    wave = np.minimum(np.arange(period), period - np.arange(period))
    return np.asarray(symbol.take(np.minimum(wave, symbol.shape[axis] - 1), axis))


def by_numpy(
    field: Floats, lengths: tuple[int, int], even: tuple[bool, bool], symbol: Floats
) -> Floats:
    whole = field
    for axis in (0, 1):
        whole = whole_lines(whole, lengths[axis], axis, even=even[axis])
        symbol = whole_symbol(symbol, lengths[axis], axis, even=even[axis])
    filtered = np.fft.ifft2(np.fft.fft2(whole) * symbol)
    return np.asarray(filtered.real[: field.shape[0], : field.shape[1]])


def fields(
    seed: int, lengths: tuple[int, int], even: tuple[bool, bool], parts: tuple[float, float]
) -> tuple[Floats, Floats]:
    """A field on some part of the lengths, and a symbol of both signs."""
    random = np.random.default_rng(seed)
    rows, columns = (
        max(1, round(part * length)) for part, length in zip(parts, lengths, strict=True)
    )
    return random.standard_normal((rows, columns)), random.standard_normal(waves(lengths, even))


#: Filters of any field on some part of the lengths, in either precision.
filters = given(
    seed=st.integers(0, 2**32 - 1),
    lengths=pairs,
    even=evens,
    parts=st.tuples(*[st.sampled_from([0.0, 0.3, 0.5, 0.7, 1.0])] * 2),
    single=st.booleans(),
)


@settings(max_examples=150, deadline=None)
@filters
@example(seed=1, lengths=(256, 200), even=(False, False), parts=(0.5, 0.5), single=False)
@example(seed=1, lengths=(256, 200), even=(True, True), parts=(0.5, 0.5), single=False)
@example(seed=1, lengths=(225, 243), even=(True, False), parts=(0.4, 1.0), single=False)
def test_a_filter_is_the_product_of_the_whole_spectrum_and_the_symbol(
    seed: int,
    lengths: tuple[int, int],
    even: tuple[bool, bool],
    parts: tuple[float, float],
    single: bool,
) -> None:
    field, symbol = fields(seed, lengths, even, parts)
    number = np.float32 if single else np.float64
    given: Any = field.astype(number)
    found = made(field.shape, lengths, even, symbol, single=single).apply(given, None, None)
    expected = by_numpy(given.astype(float), lengths, even, symbol)
    rounding = 50 * np.finfo(number).eps * np.abs(symbol).max() * np.linalg.norm(field)
    assert np.abs(found - expected).max() <= rounding


@settings(max_examples=100, deadline=None)
@filters
@example(seed=1, lengths=(90, 75), even=(False, False), parts=(0.5, 0.5), single=True)
def test_units_of_a_symbol_and_a_field_change_no_bit(
    seed: int,
    lengths: tuple[int, int],
    even: tuple[bool, bool],
    parts: tuple[float, float],
    single: bool,
) -> None:
    """What is left by rounding before the product with the symbol does not get into the result."""
    field, symbol = fields(seed, lengths, even, parts)
    given: Any = field.astype(np.float32 if single else np.float64)
    unit, other = given.dtype.type(2.0**-40), given.dtype.type(2.0**20)
    found = made(field.shape, lengths, even, symbol, single=single).apply(given, None, None)
    small = made(field.shape, lengths, even, symbol * unit, single=single)
    assert (small.apply(other * given, None, None) == unit * other * found).all()


@pytest.mark.parametrize("even", [(False, False), (False, True), (True, False), (True, True)])
@pytest.mark.parametrize("single", [False, True])
def test_threads_do_not_change_a_bit(even: tuple[bool, bool], single: bool) -> None:
    lengths = 600, 480
    field, symbol = fields(3, lengths, even, (0.5, 0.5))
    alone, shared = (
        made(field.shape, lengths, even, symbol, single=single, threads=threads).apply(
            field, None, Workspace()
        )
        for threads in (1, 3)
    )
    assert alone.tobytes() == shared.tobytes()


@pytest.mark.parametrize("size", [1e-200, 1e-30, 1e30, 1e200])
def test_single_precision_filters_numbers_beyond_its_range(size: float) -> None:
    lengths, even = (8, 6), (False, True)
    field, symbol = fields(5, lengths, even, (0.5, 0.5))
    found = made(field.shape, lengths, even, symbol, single=True).apply(size * field, None, None)
    expected = by_numpy(field, lengths, even, symbol)
    assert np.abs(found / size - expected).max() < 1e-5 * np.abs(expected).max()


def test_fields_of_other_kinds_and_strides_are_filtered_as_others() -> None:
    lengths, even = (10, 12), (False, True)
    field, symbol = fields(6, lengths, even, (0.5, 0.5))
    for single in (False, True):
        of = made(field.shape, lengths, even, symbol, single=single)
        marked = field > 0
        into: Any = np.full((field.shape[1], field.shape[0]), np.nan, np.float32).T
        assert of.apply(marked, into, None) is into
        expected = of.apply(marked.astype(float), None, None)
        assert np.abs(into - expected).max() < 1e-5 * np.abs(expected).max()
        alike = np.asfortranarray(field)
        assert (of.apply(alike, None, None) == of.apply(field, None, None)).all()


def test_a_field_is_filtered_in_its_own_memory() -> None:
    field, symbol = fields(7, (9, 8), (False, False), (1.0, 1.0))
    of = made(field.shape, (9, 8), (False, False), symbol)
    expected = of.apply(field, None, None)
    assert of.apply(field, field, None) is field
    assert (field == expected).all()


def test_what_is_not_a_number_stays_none() -> None:
    field = np.ones((4, 4))
    field[1, 2] = np.nan
    of = made((4, 4), (8, 8), (True, False), np.ones((8, 5)))
    assert np.isnan(of.apply(field, None, None)).all()


def test_the_symbol_is_given_back() -> None:
    for even in ((False, False), (False, True), (True, False), (True, True)):
        symbol = np.random.default_rng(2).random(waves((75, 80), even))
        assert (made((30, 40), (75, 80), even, symbol).symbol == symbol).all()


def test_other_lengths_and_symbols_are_left_to_other_transforms() -> None:
    symbol = np.ones((7, 8))
    assert compiled_filter(team(), (7, 8), (7, 8), (True, True), symbol, single=False) is None
    ones: Any = np.ones((8, 8), complex)
    assert compiled_filter(team(), (8, 8), (8, 8), (True, True), ones, single=False) is None
    assert compiled_filter(Team(), (8, 8), (8, 8), (True, True), ones.real, single=False) is None


def core() -> ModuleType:
    assert compiled.core is not None
    return compiled.core


def test_arrays_that_do_not_fit_are_refused() -> None:
    make = core().DoubleFilter
    with pytest.raises(ValueError, match="no entry for each wave"):
        make((4, 4), (8, 8), (True, False), np.ones((8, 8)), 1)
    with pytest.raises(ValueError, match="zeros behind"):
        make((9, 4), (8, 8), (True, True), np.ones((8, 8)), 1)
    with pytest.raises(ValueError, match="prime factors"):
        make((4, 4), (14, 8), (True, True), np.ones((14, 8)), 1)
    of = make((4, 4), (8, 8), (True, True), np.ones((8, 8)), 1)
    field, work = np.ones((4, 4)), np.empty(of.work)
    with pytest.raises(ValueError, match="more numbers to work in"):
        of.apply(field, 1.0, np.empty((4, 4)), work[1:])
    with pytest.raises(ValueError, match="same shape"):
        of.apply(field, 1.0, np.empty((4, 5)), work)
    with pytest.raises(TypeError):
        of.apply(field, 1.0, np.empty((4, 4), np.float32), work)
