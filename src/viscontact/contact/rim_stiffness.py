"""Correction of the preconditioner at the rim of a contact.

The preconditioner A, the surface's inverse symbol, treats the displacement outside the active cells
as held at zero, while it is free there. On these cells (a; o: the others) the inverse of the
convolution is A_aa - A_ao A_oo⁻¹ A_oa; what A_aa lacks is largest at the rim, and grows without
limit as cells become smaller. It is replaced by a diagonal: a part of the stiffness A 1_a against a
uniform displacement of the active cells, which is the sum of each of its rows if all that leaves
the active cells returned at once. As A has hardly any positive entry beside its diagonal, what is
left remains positive definite. A diagonal also softens what varies from cell to cell along the rim,
for which nothing is lacking: it is applied to the residual less a part of its own stiffness A r.
Slender cells along the rim are hardly coupled, and so each is held by its own line of cells only.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.patch import Patch
from viscontact.contact.rigid_balance import RigidPlane

#: Part of that stiffness which is taken away: up to a third fewer iterations than without. Beyond
#: 0.8 searches take more, and near 1 they may fail.
CORRECTION = 0.7

#: Part of the stiffness of a residual that is taken from it, over that of a single cell, on square
#: cells. On others it is multiplied by the ratio of the couplings between neighbours.
SMOOTHING = 0.4

#: Part of the cells of a patch up to which a change of the active ones is followed cell by cell.
FEW_CHANGES = 1e-3


class RimStiffness:
    """Stiffness of a patch against a uniform displacement of the active cells, the others held.

    It is kept while the active cells change: where few do, only their neighbours' is corrected.
    """

    def __init__(self, patch: Patch) -> None:
        self._patch = patch
        self._stiffness = np.zeros(patch.shape, np.float32)  # [1/m]
        self._smoothing = 0.0  # compliance by which a residual is smoothed [m]

    def follow(
        self, active: NDArray[np.bool_], last: NDArray[np.bool_], spare: NDArray[np.float32]
    ) -> None:
        """Find the stiffness for other active cells than the last ones; `spare` is used up."""
        near = self._patch.operators.near_stiffness(spare)
        self._smoothing = _smoothing(near)
        changed = np.flatnonzero(active != last)
        if len(changed) > FEW_CHANGES * active.size:
            self._stiffness[...] = self._patch.preconditioner.stiffness_of(active, into=spare)
            return
        rows, columns = np.divmod(changed, active.shape[1])
        sign = np.where(active[rows, columns], np.float32(1), np.float32(-1))
        for (down, right), stiffness in near.items():
            near_rows, near_columns = rows + down, columns + right
            inside = (near_rows >= 0) & (near_rows < active.shape[0])
            inside &= (near_columns >= 0) & (near_columns < active.shape[1])
            places = near_rows[inside], near_columns[inside]
            np.add.at(self._stiffness, places, sign[inside] * stiffness)

    def correct(self, found: NDArray[np.float32], residual: NDArray[np.float32]) -> None:
        """Take the correction from a preconditioned residual, in its memory."""

        def corrected(block: RigidPlane) -> None:
            here = found[block.rows]
            lacking = np.maximum(self._stiffness[block.rows], 0)
            lacking *= CORRECTION
            if self._smoothing:
                lacking *= residual[block.rows] - self._smoothing * here
            else:
                lacking *= residual[block.rows]
            here -= lacking

        self._patch.plane.each(corrected)


def _smoothing(near: dict[tuple[int, int], np.float32]) -> float:
    """Compliance by which a residual is smoothed, from the stiffnesses of neighbours [m]."""
    own, along_x, along_y = (
        abs(float(near.get(offset, 0.0))) for offset in ((0, 0), (1, 0), (0, 1))
    )
    if not min(along_x, along_y):
        return 0.0
    return SMOOTHING * min(along_x, along_y) / max(along_x, along_y) / own
