"""Compiled passes against those in NumPy, on random fields and on patches of larger ones."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from viscontact.backend import compiled
from viscontact.backend.arrays import Floats
from viscontact.backend.team import Team
from viscontact.mechanics.contact.line_load import peak_line_load
from viscontact.mechanics.contact.passes.compiled_passes import CompiledPasses
from viscontact.mechanics.contact.passes.contract import Measured, SearchPasses, StepAhead
from viscontact.mechanics.contact.passes.numpy_passes import NumPyPasses
from viscontact.mechanics.contact.rigid_balance import Constraints, RigidPlane

pytestmark = pytest.mark.skipif(compiled.core is None, reason="no compiled core")

#: Passes in single precision, one after another.
SINGLE = 2e-5

problems = st.fixed_dictionaries(
    {
        "seed": st.integers(0, 2**32 - 1),
        "shape": st.tuples(st.integers(1, 40), st.integers(1, 40)),
        "mirrored": st.tuples(st.booleans(), st.booleans()),
        "free": st.tuples(st.booleans(), st.booleans(), st.booleans()),
        "share": st.sampled_from([0.0, 0.02, 0.5, 1.0]),
    }
)


class Fields:
    """Random fields of a patch in the middle of larger ones, and passes of both kinds over it."""

    def __init__(
        self,
        seed: int,
        shape: tuple[int, int],
        mirrored: tuple[bool, bool],
        free: tuple[bool, bool, bool],
        share: float,
        threads: int = 1,
    ) -> None:
        self._random, self._shape, self._share = np.random.default_rng(seed), shape, share
        sizes = 1e-3 * (0.5 + self._random.random(2))
        x, y = (size * (np.arange(count) + 0.5) for size, count in zip(sizes, shape, strict=True))
        self.plane = RigidPlane(
            x - (0 if mirrored[0] else x.mean()),
            y - (0 if mirrored[1] else y.mean()),
            (float(sizes[0]), float(sizes[1])),
            mirrored,
            Team(threads),
        )
        resultants = [1.0 if is_free else None for is_free in free]
        for axis in (1, 2):
            if resultants[axis] is not None:
                resultants[axis] = 1e-4
        self.constraints = Constraints((resultants[0], resultants[1], resultants[2]))
        self.numpy = NumPyPasses(self.plane)
        self.compiled = CompiledPasses(compiled.core, self.plane)

    def field(self, kind: type = np.float64) -> Any:
        large = self._random.standard_normal((self._shape[0] + 3, self._shape[1] + 5))
        return large.astype(kind)[1:-2, 2:-3]

    def flags(self) -> Any:
        large = self._random.random((self._shape[0] + 3, self._shape[1] + 5)) < self._share
        return large[1:-2, 2:-3]

    def pressure(self) -> Floats:
        return np.asarray(np.where(self.flags(), np.abs(self.field()), 0.0))

    def both(self, work: Callable[[SearchPasses, list[Any]], Any], *given: Any) -> tuple[Any, Any]:
        """What both passes give, with the fields that they leave, from copies of the same ones."""
        found = []
        for passes in (self.numpy, self.compiled):
            copies = [each.copy() for each in given]
            found.append((work(passes, copies), *copies))
        return found[0], found[1]


def alike(found: Any, expected: Any, rel: float) -> None:
    """Fields that agree relative to the largest value of the expected one."""
    expected = np.asarray(expected, float)
    finite = np.abs(expected[np.isfinite(expected)])
    np.testing.assert_allclose(found, expected, rtol=rel, atol=rel * finite.max(initial=0.0))


@given(problems, st.sampled_from([np.float32, np.float64]), st.sampled_from([1.0, 0.3]))
def test_gap_and_motion_that_fit_a_pressure(problem: Any, kind: type, unit: float) -> None:
    fields = Fields(**problem)
    values = np.stack([fields.pressure(), fields.field()])
    open_gap = fields.field()
    open_gap[values[0] == 0] = np.where(fields.flags(), open_gap, np.inf)[values[0] == 0]
    motion = np.array([0.1, 3.0, -2.0])

    def work(passes: SearchPasses, given: list[Any]) -> Measured:
        into = given[0], given[1]
        return passes.measure(values, motion, (open_gap, 0.7), fields.constraints, into, unit)

    (expected, contact, gap), (found, *others) = fields.both(
        work, fields.flags(), fields.field(kind)
    )
    np.testing.assert_array_equal(others[0], contact)
    alike(found.inverse_gram, expected.inverse_gram, 1e-9)
    alike(found.motion, expected.motion, 1e-9)
    alike(others[1], gap, 1e-9 if kind is np.float64 else SINGLE)
    assert found.largest == close_to(expected.largest, 1e-14)
    assert found.error == close_to(expected.error, abs=SINGLE if kind is np.float32 else 1e-9)


@given(problems, st.sampled_from([0.4, 1.0, 1.7]))
def test_a_step_ahead_is_taken_before_the_gap_is_measured(problem: Any, part: float) -> None:
    fields = Fields(**problem)
    ahead, open_gap, motion = fields.pressure(), fields.field(), np.zeros(3)
    step, change = fields.field(np.float32), fields.field(np.float32)
    ahead_of = StepAhead(ahead, step, change, part, 0.2)

    def work(passes: SearchPasses, given: list[Any]) -> Measured:
        values, contact, gap = given
        return passes.measure(
            values, motion, (open_gap, 0.7), fields.constraints, (contact, gap), 1.0, ahead_of
        )

    start = np.stack([fields.pressure(), fields.field()])
    (_, expected, *_), (_, values, *_) = fields.both(work, start, fields.flags(), fields.field())
    np.testing.assert_array_equal(values, expected)


@given(problems)
def test_overlapped_cells_become_active(problem: Any) -> None:
    fields = Fields(**problem)
    last = fields.flags()

    def work(passes: SearchPasses, given: list[Any]) -> tuple[int, Floats | None]:
        return passes.release(given[0], last, given[1], fields.constraints)

    first, second = fields.both(work, fields.flags(), fields.field(np.float32))
    (changed, inverse), active, gap = first
    np.testing.assert_array_equal(second[1], active)
    np.testing.assert_array_equal(second[2], gap)
    assert second[0][0] == changed == np.count_nonzero(active != last)
    assert (second[0][1] is None) == (inverse is None)
    if inverse is not None:
        alike(second[0][1], inverse, 1e-9)


@given(problems, st.booleans(), st.sampled_from([0.0, 3.0]), st.sampled_from([0.0, 0.2]))
def test_the_next_direction(problem: Any, changed: bool, last_slope: float, shift: float) -> None:
    fields = Fields(**problem)
    active = fields.flags()
    residual = np.where(active, fields.field(np.float32), np.float32(0))
    last_residual, stiffness = fields.field(np.float32), fields.field(np.float32)
    inverse = fields.plane.inverse_gram(active, fields.constraints.free)

    def work(passes: SearchPasses, given: list[Any]) -> float:
        found, direction = given
        return passes.direct(
            found,
            (direction, last_residual, last_slope),
            (residual, active),
            (stiffness, 0.5),
            inverse,
            shift,
            changed=changed,
        )

    first, second = fields.both(work, fields.field(np.float32), fields.field(np.float32))
    size = float(np.abs(first[1]).max())
    np.testing.assert_allclose(second[1], first[1], atol=50 * SINGLE * max(size, 1.0))
    np.testing.assert_allclose(second[2], first[2], atol=50 * SINGLE)
    scale = float(np.abs(residual).max(initial=1.0)) * residual.size
    assert second[0] == close_to(first[0], abs=SINGLE * scale)


@given(problems)
def test_stiffness_follows_changed_cells(problem: Any) -> None:
    fields = Fields(**problem)
    active, last = fields.flags(), fields.flags()
    near = np.arange(9, dtype=np.float32).reshape(3, 3)

    def work(passes: SearchPasses, given: list[Any]) -> None:
        passes.follow(given[0], active, last, near)

    (_, expected), (_, found) = fields.both(work, np.zeros(active.shape, np.float32))
    np.testing.assert_array_equal(found, expected)  # sums of small whole numbers


@given(problems)
def test_balanced_pressures(problem: Any) -> None:
    fields = Fields(**problem)
    area, arm = 1e-6, 1e-2

    def work(passes: SearchPasses, given: list[Any]) -> bool:
        return passes.balance(given[0], fields.constraints, area, arm)

    (expected, pressure), (found, other) = fields.both(work, fields.field())
    assert found == expected
    if found:
        alike(other, pressure, 1e-7)
        sums = fields.numpy.sums(other) * area
        assert fields.constraints.imbalance(sums, arm) < 1e-9
        assert other.min() >= 0


@given(problems, st.sampled_from([None, np.nan]))
def test_least_pressures_and_imbalances(problem: Any, value: float | None) -> None:
    fields = Fields(**problem)
    pressure = fields.field()
    if value is not None:
        pressure[-1, 0] = value
    given = pressure, fields.constraints, 1e-6, 1e-2
    (least, off), (expected, expected_off) = (
        passes.weigh(*given) for passes in (fields.compiled, fields.numpy)
    )
    np.testing.assert_equal(least, expected)
    np.testing.assert_allclose(off, expected_off, rtol=1e-9, atol=1e-12)


@given(problems, st.booleans())
def test_changes_over_a_step(problem: Any, first: bool) -> None:
    fields = Fields(**problem)
    core = compiled.core
    assert core is not None
    given = [np.ascontiguousarray(fields.field()) for _ in range(4)]
    before = None if first else np.ascontiguousarray(fields.field())
    rate, alone = np.empty(given[0].shape), Team()
    found = core.step_change(*given, 0.7, before, rate, 1)
    contact = (given[0] > 0) | (given[1] > 0)
    alike(rate, given[2] / 0.7 - given[3] / 0.7, 1e-13)
    changes = [alone.mean_change(contact, each) for each in (given[2], rate)]
    changes.append(0.0 if before is None else alone.mean_change(contact, rate, before))
    np.testing.assert_allclose(found, changes, rtol=1e-12)


@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.floats(1e-3, 20.0), st.booleans())
def test_peak_line_loads(seed: int, rows: int, length: float, periodic: bool) -> None:
    random = np.random.default_rng(seed)
    # Lengths are those of a contact, at most that of the grid.
    grid = vc.Grid((rows + 3, 4), (max(length, 1.0), 1.0), periodic=(periodic, False))
    load = np.where(random.random(rows + 3) < 0.3, 0.0, random.random(rows + 3))
    alone, together = (
        peak_line_load(load, grid, length, team) for team in (Team(), Team(core=compiled.core))
    )
    assert together == close_to(alone, 1e-12)


@given(problems, st.sampled_from([1e-3, 0.5, 5.0]))
def test_trial_steps(problem: Any, length: float) -> None:
    fields = Fields(**problem)
    pressure, direction = fields.pressure(), fields.field(np.float32)

    def work(passes: SearchPasses, given: list[Any]) -> bool:
        ahead, step = given
        others = fields.constraints, (1e-6, 1e-2)
        return passes.trial(pressure, (direction, length), ahead, (step, 0.3), *others)

    first, second = fields.both(work, fields.field(), fields.field(np.float32))
    assert second[0] == first[0]
    if first[0]:
        alike(second[1], first[1], 1e-7)
        alike(second[2], first[2], 1e-6)


@given(problems)
def test_steps_and_products(problem: Any) -> None:
    fields = Fields(**problem)
    single, double = [fields.field(np.float32) for _ in range(3)], fields.field()

    def work(passes: SearchPasses, given: list[Any]) -> list[float]:
        values, ahead, step = given
        passes.difference(ahead, values[0], 0.3, step)
        products = passes.inner(*single)
        return [passes.move(values, single[0], single[1], -0.4), *products]

    values = np.stack([fields.pressure(), double])
    given = values, fields.field(), fields.field(np.float32)
    (expected, *fields_left), (found, *others) = fields.both(work, *given)
    for one, other in zip(others, fields_left, strict=True):
        alike(one, other, 1e-6 if one.dtype == np.float32 else 1e-15)
    assert found[0] == close_to(expected[0], 1e-14, abs=1e-15)
    assert found[1:] == close_to(expected[1:], abs=SINGLE * double.size)
    alike(fields.compiled.sums(double), fields.numpy.sums(double), 1e-12)


def test_threads_do_not_change_a_bit() -> None:
    shape, found = (700, 300), []
    for threads in (1, 3):
        fields = Fields(7, shape, (False, False), (True, True, True), 0.5, threads)
        values = np.stack([fields.pressure(), fields.field()])
        gap, contact = fields.field(), fields.flags()
        spring = fields.field(), 0.7
        motion = np.zeros(3)
        passes = fields.compiled
        measured = passes.measure(values, motion, spring, fields.constraints, (contact, gap))
        assert passes.balance(values[0], fields.constraints, 1e-6, 1.0)
        found.append([measured.motion, measured.error, gap, values, passes.sums(values[0])])
    for one, other in zip(*found, strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.skipif(sys.platform != "linux", reason="the limit is one of Linux")
def test_threads_that_the_system_refuses_leave_their_work_to_the_caller() -> None:
    script = """
import resource
import numpy as np
import viscontact as vc
from viscontact.backend import compiled
axis, values = np.linspace(-1.0, 1.0, 600), np.random.default_rng(1).random((600, 600))
alone, many = (compiled.core.Plane(axis, axis, (1.0, 1.0), (False, False), n) for n in (1, 64))
pages = int(open("/proc/self/statm").read().split()[0])
limit = pages * resource.getpagesize() + 2**22  # no room for the stack of a thread
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
print(compiled.core.sums(many, values) == compiled.core.sums(alone, values))
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert (done.stdout, done.returncode) == ("True\n", 0), done.stderr


def test_numbers_of_threads_below_one_are_one() -> None:
    axis, values = np.linspace(-1.0, 1.0, 600), np.ones((600, 600))
    assert compiled.core is not None
    for threads in (0, -1):
        plane = compiled.core.Plane(axis, axis, (1.0, 1.0), (False, False), threads)
        assert compiled.core.sums(plane, values)[0] == 600**2


@pytest.mark.parametrize("kind", [NumPyPasses, CompiledPasses])
def test_what_is_no_number_has_no_residual(kind: type) -> None:
    fields = Fields(1, (5, 6), (False, False), (True, True, True), 1.0)
    values = np.stack([fields.pressure(), fields.field()])
    values[1, 2, 3] = np.nan
    passes = fields.numpy if kind is NumPyPasses else fields.compiled
    into = fields.flags(), fields.field()
    with np.errstate(invalid="ignore"):
        measured = passes.measure(
            values, np.zeros(3), (fields.field(), 0.7), fields.constraints, into
        )
    assert np.isnan(measured.error)
    values[1, 2, 3] = values[0, 1, 1] = 0.0  # an open cell, which the motion does not fit
    open_gap = fields.field()
    open_gap[1, 1] = np.nan
    with np.errstate(invalid="ignore"):
        measured = passes.measure(values, np.zeros(3), (open_gap, 0.7), fields.constraints, into)
    assert np.isnan(measured.error)
    values[1, 2, 3] = np.nan
    with np.errstate(invalid="ignore"):
        assert not passes.balance(values[1], fields.constraints, 1e-6, 1.0)


def test_arrays_of_another_kind_or_shape_are_refused() -> None:
    fields = Fields(1, (5, 6), (False, False), (True, True, True), 1.0)
    single, double = np.zeros((5, 6), np.float32), np.zeros((5, 6))
    with pytest.raises(TypeError, match="incompatible function arguments"):
        fields.compiled.difference(fields.pressure(), single, 1.0, single)
    for other in (np.zeros((5, 7)), np.zeros((4, 6)), np.zeros((6, 5))):
        with pytest.raises(ValueError, match="do not have the same shape"):
            fields.compiled.difference(double, other, 1.0, single)
        with pytest.raises(ValueError, match="do not have the same shape"):
            fields.compiled.sums(other)
    with pytest.raises(ValueError, match="numbers of a row must be contiguous"):
        fields.compiled.sums(np.zeros((5, 12))[:, ::2])
    core, flags = compiled.core, np.zeros((5, 6), bool)
    assert core is not None
    with pytest.raises(ValueError, match="as long as its part, or twice as long"):
        core.unfold(double, np.zeros((5, 11)))
    with pytest.raises(ValueError, match="do not have the same shape"):
        core.segment(flags, np.zeros((4, 6)), (0.1, 2.0, 0.1))
    with pytest.raises(ValueError, match="fields of one size"):
        core.weighted_sum(double, [1.0], [np.zeros((4, 6))], 1)
    with pytest.raises(ValueError, match="each field has a weight"):
        core.weighted_sum(double, [1.0, 2.0], [double], 1)
    with pytest.raises(ValueError, match="a plane has a row and a column"):
        core.Plane(np.zeros(0), np.zeros(1), (1.0, 1.0), (False, False), 1)
    with pytest.raises(ValueError, match="the axis is 0 or 1"):
        core.filter(single, single, 2)
    with pytest.raises(ValueError, match="no half of the spectrum"):
        core.filter(single, single[:2].copy(), 0)


@settings(max_examples=20)
@given(problems)
def test_trends_unfolded_fields_and_weighted_sums(problem: Any) -> None:
    fields = Fields(**problem)
    alone, together = Team(), Team(core=compiled.core)
    mirrored = problem["mirrored"]
    for field in (fields.field(), fields.field().T, fields.flags(), fields.field(np.float32)):
        np.testing.assert_array_equal(
            together.unfold(field, mirrored), alone.unfold(field, mirrored)
        )
    given = [np.ascontiguousarray(fields.field()) for _ in range(3)]
    sums = [
        team.weighted_sum(np.empty(given[0].shape), (2.0, -0.3, 1.0), given)
        for team in (alone, together)
    ]
    alike(sums[1], sums[0], 1e-14)
    where = fields.flags()
    for other in (None, given[1]):
        found = together.mean_change(where, given[0], other)
        assert found == close_to(alone.mean_change(where, given[0], other), 1e-12)
