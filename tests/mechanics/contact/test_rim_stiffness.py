"""The preconditioner, corrected at the rim, against the inverse of the convolution."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import viscontact as vc
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.rim_stiffness import CORRECTION, RimStiffness
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse

Field = NDArray[np.float64]
Cells = NDArray[np.bool_]

#: A coating ten times as stiff as its base, and an incompressible layer on a rigid one.
STIFF = ElasticStack((ElasticLayer(0.05, 10.0, 0.3),), ElasticBase(1.0, 0.3))
SOFT = ElasticStack((ElasticLayer(0.2, 1.0, 0.5),), None)


def patch_of(cells: int, response: SurfaceResponse = HALF_SPACE) -> Patch:
    return ContactDomain(vc.Grid((cells, cells), (1.0, 1.0)), response=response).whole


def disc(cells: int) -> Cells:
    centres = (np.arange(cells) + 0.5) / cells - 0.5
    return np.asarray(np.hypot(*np.meshgrid(centres, centres)) < 0.4)


def stiffness(patch: Patch, active: Cells) -> RimStiffness:
    rim = RimStiffness(patch)
    nothing = np.zeros_like(active)
    rim.follow(active, nothing, np.count_nonzero(active), np.empty(patch.shape))
    return rim


def matrix(active: Cells, act: Callable[[Field], Field]) -> Field:
    """An operator between active cells."""
    columns = []
    for place in np.argwhere(active):
        unit = np.zeros(active.shape)
        unit[tuple(place)] = 1.0
        columns.append(act(unit)[active])
    return np.array(columns).T


def corrected(patch: Patch, rim: RimStiffness) -> Callable[[Field], Field]:
    def act(residual: Field) -> Field:
        found = patch.preconditioner.apply(residual)
        found -= CORRECTION * np.maximum(rim.values, 0) * residual
        return found

    return act


def condition(cells: int, *, at_rim: bool) -> float:
    """Condition number of the preconditioned convolution under a disc."""
    patch, active = patch_of(cells), disc(cells)
    act = corrected(patch, stiffness(patch, active)) if at_rim else patch.preconditioner.apply
    preconditioned = matrix(active, act) @ matrix(active, patch.convolution.apply)
    values = np.sort(np.linalg.eigvals(preconditioned).real)
    return float(values[-1] / values[0])


def test_the_correction_slows_the_growth_of_the_condition_number_with_cells() -> None:
    plain = [condition(cells, at_rim=False) for cells in (16, 32)]
    better = [condition(cells, at_rim=True) for cells in (16, 32)]
    assert better[0] < 0.8 * plain[0]
    assert better[1] < 0.75 * plain[1]
    assert better[1] / better[0] < plain[1] / plain[0]


@settings(max_examples=15)
@given(
    seed=st.integers(0, 1000),
    share=st.floats(0.02, 0.9),
    response=st.sampled_from([HALF_SPACE, STIFF, SOFT]),
)
def test_the_corrected_preconditioner_is_positive_definite(
    seed: int, share: float, response: SurfaceResponse
) -> None:
    """Under any cells, on layers as well."""
    patch = patch_of(12, response)
    active = np.random.default_rng(seed).random(patch.shape) < share
    active[5, 5] = True
    of_sums = matrix(active, corrected(patch, stiffness(patch, active)))
    assert np.linalg.eigvalsh((of_sums + of_sums.T) / 2).min() > 0


@pytest.mark.parametrize("place", [(32, 58), (0, 0), (63, 40)])
def test_few_changes_give_the_stiffness_that_all_cells_give(place: tuple[int, int]) -> None:
    """But for what leaves the neighbours, here a twentieth."""
    patch, active = patch_of(64), disc(64)
    rim = stiffness(patch, active)
    other = active.copy()
    other[place] ^= True
    rim.follow(other, active, int(np.count_nonzero(other != active)), np.empty(patch.shape))
    followed, known, before = (
        np.maximum(each.values, 0)
        for each in (rim, stiffness(patch, other), stiffness(patch, active))
    )
    assert np.abs(known - before).max() > 0.1 * np.abs(known).max()
    assert np.abs(followed - known).max() < 0.05 * np.abs(known - before).max()
