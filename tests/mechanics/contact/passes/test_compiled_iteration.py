"""An iteration of the search in one call of the compiled core, against the same by its passes."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from viscontact.backend import compiled
from viscontact.backend.arrays import Floats
from viscontact.mechanics.contact.conjugate_gradients import BoundedCG
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.passes.compiled_passes import CompiledPasses
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rigid_balance import Constraints

pytestmark = pytest.mark.skipif(compiled.core is None, reason="no compiled core")

CELLS = 60
GRID = vc.Grid((CELLS, CELLS), (0.5, 0.5))
SMOOTH = vc.Paraboloid(1.0, 0.6).gap(GRID.x[:, None], GRID.y[None, :])
ROUGH = SMOOTH + 3e-3 * np.random.default_rng(5).random(SMOOTH.shape)
ENDED = np.where(np.abs(GRID.y[None, :]) < 0.08, SMOOTH, np.inf)
FORCE, BOTH = Constraints((1e3, None, None)), Constraints((1e3, 20.0, -10.0))
APPROACH = Constraints((None, None, None), (0.02, 1e-3, 0.0))


def searched(
    domain: ContactDomain, gap: Floats, constraints: Constraints, *, at_once: bool
) -> BoundedCG:
    """A search from a small contact, to its end."""
    constraints = domain.reduced_constraints(constraints)
    gap = domain.reduce_by_symmetry(gap)
    pressure = np.where(gap < 4e-3, 4e5, 0.0)
    start = Guess(np.stack([pressure, domain.convolution.apply(pressure)]), np.zeros(3))
    patch = domain.patch_around(gap < 0.04)
    if not at_once:  # without operators of the core
        vars(patch.operators)["compiled"] = None
    assert (patch.operators.compiled is not None) == at_once
    problem = ContactProblem(gap, 2.5e-7, constraints, 1e-15)
    search = BoundedCG(problem.within(patch), patch, start.within(patch))
    search.run(1e-7, 100)
    return search


@pytest.mark.parametrize("mirrored", [(False, False), (True, False), (False, True), (True, True)])
@pytest.mark.parametrize("gap", [SMOOTH, ROUGH, ENDED], ids=["smooth", "rough", "ended"])
@pytest.mark.parametrize("constraints", [FORCE, BOTH, APPROACH], ids=["force", "tilted", "given"])
def test_one_call_has_the_bits_of_its_passes(
    mirrored: tuple[bool, bool], gap: Floats, constraints: Constraints
) -> None:
    found = []
    for at_once in (True, False):
        domain = ContactDomain(GRID, mirrored=mirrored, inner_loops=compiled.COMPILED)
        search = searched(domain, gap, constraints, at_once=at_once)
        found.append((search.iterations, search.convolutions, search.iterate))
    (iterations, convolutions, iterate), (*expected, other) = found
    assert [iterations, convolutions] == expected
    assert iterations > 3
    assert iterate.values.tobytes() == other.values.tobytes()
    assert iterate.motion.tobytes() == other.motion.tobytes()


def test_operators_without_filters_of_the_core_leave_iterations_to_the_passes() -> None:
    domain = ContactDomain(vc.Grid((14, 14), (0.5, 0.5)), inner_loops=compiled.COMPILED)
    assert domain.whole.operators.compiled is None  # 14 = 2 * 7 has no filter as preconditioner
    domain = ContactDomain(GRID, inner_loops=compiled.NUMPY)
    assert domain.whole.operators.compiled is None


def test_a_patch_refuses_operators_of_another_one() -> None:
    core = compiled.core
    assert core is not None
    large, small = (
        ContactDomain(vc.Grid((cells, cells), (0.5, 0.5)), inner_loops=compiled.COMPILED).whole
        for cells in (20, 10)
    )
    operators, passes = large.operators.compiled, small.passes
    assert operators is not None
    assert isinstance(passes, CompiledPasses)
    single, flags = np.zeros(small.shape, np.float32), np.zeros(small.shape, bool)
    double, work = np.zeros(small.shape), np.empty(operators[0].work, np.float32)
    fields = (double, double), (flags, flags), (single, single), (single,) * 4
    others = FORCE, (1.0, 1.0), np.eye(3), (0.5, 0.0), (1.0, 1.0)
    with pytest.raises(ValueError, match="another patch"):
        passes.advance((operators[0], work), fields, *others)
    with pytest.raises(ValueError, match="more numbers to work in"):
        large.passes.advance((operators[0], work[1:]), fields, *others)  # type: ignore[attr-defined]
