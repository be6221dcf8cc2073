"""Springs under a body in the compiled core, against sums over cells and the same in NumPy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.backend import compiled
from viscontact.backend.team import Team
from viscontact.mechanics.contact.rigid_balance import Constraints, RigidPlane
from viscontact.mechanics.contact.winkler import winkler_contact

pytestmark = pytest.mark.skipif(compiled.core is None, reason="no compiled core")

seeds, sides = st.integers(0, 2**32 - 1), st.tuples(st.integers(1, 40), st.integers(1, 40))
both = st.tuples(st.booleans(), st.booleans())


def plane(shape: tuple[int, int], mirrored: tuple[bool, bool], *, core: bool) -> RigidPlane:
    rows, columns = (
        1e-3 * (np.arange(count) + 0.5 - (0 if even else count / 2))
        for count, even in zip(shape, mirrored, strict=True)
    )
    team = Team(1, compiled.core if core else None)
    return RigidPlane(rows, columns, (1e-3, 1e-3), mirrored, team)


@given(seeds, sides, both)
def test_pressed_springs_are_summed_over_their_cells(
    seed: int, shape: tuple[int, int], mirrored: tuple[bool, bool]
) -> None:
    random = np.random.default_rng(seed)
    gap = np.where(random.random(shape) < 0.1, np.inf, random.standard_normal(shape))
    bearing = (random.random(shape) < 0.3).astype(float)
    motion, free = (0.3, 40.0, -25.0), (True, not mirrored[0], not mirrored[1])
    on = plane(shape, mirrored, core=True)
    core = compiled.core
    assert core is not None
    squares, sums, inverse = core.press(on.of_core, gap, motion, bearing, 0.01, free)
    overlap = np.maximum(on.field(np.array(motion)) - gap, 0.0)
    x, y, _, _, _ = on.cells
    expected = [overlap.sum(), (overlap * x[:, None]).sum(), (overlap * y[None, :]).sum()]
    for axis in (0, 1):
        expected[1 + axis] *= not mirrored[axis]
    np.testing.assert_allclose(squares, (overlap**2).sum(), rtol=1e-12)
    np.testing.assert_allclose(sums, expected, rtol=1e-10, atol=1e-12)
    gram = on.inverse_gram((overlap > 0) + 0.01 * bearing, np.array(free))
    np.testing.assert_allclose(inverse, gram, rtol=1e-8, atol=1e-9 * np.abs(gram).max(initial=1.0))


@given(seeds, both, st.sampled_from([1e-4, 1.0, 1e4]))
def test_a_body_finds_the_same_place_on_springs(
    seed: int, mirrored: tuple[bool, bool], force: float
) -> None:
    shape = 30, 24
    moments = tuple(None if even else 1e-3 * force for even in mirrored)
    constraints = Constraints((force, moments[0], moments[1]))
    found = []
    for core in (True, False):
        on = plane(shape, mirrored, core=core)
        x, y, _, _, _ = on.cells
        gap = 20 * x[:, None] ** 2 + 30 * y[None, :] ** 2
        gap += 1e-4 * np.random.default_rng(seed).random(shape)
        found.append(winkler_contact(gap, 1e-6, constraints, on, 1e-6))
    (pressure, motion), (expected, at) = found
    np.testing.assert_allclose(pressure, expected, atol=1e-6 * expected.max())
    assert pressure.sum() * 1e-6 == close_to(force, 1e-6)
    np.testing.assert_allclose(motion, at, atol=1e-8 * np.abs(at).max())
