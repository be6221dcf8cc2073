"""Correction of the preconditioner at the rim of a contact.

The preconditioner A, the surface's inverse symbol, treats the displacement outside the active cells
as held at zero, while it is free there. On these cells (a; o: the others) the inverse of the
convolution is A_aa - A_ao A_oo⁻¹ A_oa; what A_aa lacks is largest at the rim, and grows without
limit as cells become smaller. It is replaced by a diagonal: a part of the stiffness A 1_a against a
uniform displacement of the active cells, which is the sum of each of its rows if all that leaves
the active cells returned at once. As A has hardly any positive entry beside its diagonal, what is
left remains positive definite.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Numbers, Singles
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.rigid_balance import RigidPlane

#: Part of that stiffness which is taken away: up to a quarter fewer iterations than without. With
#: 0.7 searches on slender cells take still fewer, but pressures at the rim are less exact.
CORRECTION = 0.5

#: Part of the cells of a patch up to which a change of the active ones is followed cell by cell.
FEW_CHANGES = 1e-3


class RimStiffness:
    """Stiffness of a patch against a uniform displacement of the active cells, the others held."""

    # It is kept while the active cells change: where few do, only their neighbours' is corrected.

    def __init__(self, patch: Patch) -> None:
        self._patch = patch
        self._stiffness = np.zeros(patch.shape, np.float32)  # [1/m]

    def follow(self, active: Bools, last: Bools, spare: Singles) -> None:
        """Find the stiffness for other active cells than the last ones; `spare` is used up."""
        changed = np.flatnonzero(active != last)
        if len(changed) > FEW_CHANGES * active.size:
            self._stiffness[...] = self._patch.preconditioner.stiffness_of(active, into=spare)
            return
        rows, columns = np.divmod(changed, active.shape[1])
        sign = np.where(active[rows, columns], np.float32(1), np.float32(-1))
        for (down, right), stiffness in self._patch.operators.near_stiffness(spare).items():
            near_rows, near_columns = rows + down, columns + right
            inside = (near_rows >= 0) & (near_rows < active.shape[0])
            inside &= (near_columns >= 0) & (near_columns < active.shape[1])
            near = near_rows[inside], near_columns[inside]
            np.add.at(self._stiffness, near, sign[inside] * stiffness)

    def correct(self, found: Numbers, residual: Numbers) -> None:
        """Take the correction from a preconditioned residual, in its memory."""

        def corrected(block: RigidPlane) -> None:
            lacking = CORRECTION * np.maximum(self._stiffness[block.rows], 0)
            lacking *= residual[block.rows]
            found[block.rows] -= lacking

        self._patch.plane.each(corrected)
