"""Choice of the passes over the cells of a patch."""

from __future__ import annotations

from viscontact.mechanics.contact.passes.compiled_passes import CompiledPasses
from viscontact.mechanics.contact.passes.contract import SearchPasses
from viscontact.mechanics.contact.passes.numpy_passes import NumPyPasses
from viscontact.mechanics.contact.rigid_balance import RigidPlane


def passes_over(plane: RigidPlane) -> SearchPasses:
    """Return passes over the cells of a plane: compiled ones if its team has them."""
    core = plane.team.core
    return NumPyPasses(plane) if core is None else CompiledPasses(core, plane)
