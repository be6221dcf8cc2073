"""Rigid motions along the surface."""

import numpy as np
import pytest

from mechanics.contact.friction.fixtures import hertz
from viscontact.mechanics.contact.friction.rigid_shift import RigidShift


@pytest.mark.parametrize("rotation", [0.0, 0.1])
def test_the_field_of_a_motion_can_be_written_to(rotation):
    """And the motion stays as it is."""
    grid, _ = hertz(4)
    shift = RigidShift(grid.x[:, None], grid.y[None, :], grid.cell_area)
    motion = np.array([1.0, 2.0, rotation])
    shift.field(motion)[...] = 0.0
    np.testing.assert_array_equal(motion, [1.0, 2.0, rotation])
