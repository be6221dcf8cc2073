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

from viscontact.backend.arrays import Bools, Singles
from viscontact.mechanics.contact.patch import FEW_CHANGES, Patch

#: Part of that stiffness which is taken away: up to a quarter fewer iterations than without. With
#: 0.7 searches on slender cells take still fewer, but pressures at the rim are less exact.
CORRECTION = 0.5


class RimStiffness:
    """Stiffness of a patch against a uniform displacement of the active cells, the others held."""

    # It is kept while the active cells change: where few do, only their neighbours' is corrected.

    def __init__(self, patch: Patch) -> None:
        self._patch = patch
        self.values = np.zeros(patch.shape, np.float32)  # [1/m]

    def follow(self, active: Bools, last: Bools, changed: int, spare: Singles) -> None:
        """Find the stiffness for other active cells than the last ones; `spare` is used up."""
        if changed > FEW_CHANGES * active.size:
            self.values[...] = self._patch.preconditioner.stiffness_of(active, into=spare)
            return
        near = self._patch.operators.near_stiffness(spare)
        self._patch.passes.follow(self.values, active, last, near)
