"""Stress near the free end of a body under a wave of pressure, by finite elements of scikit-fem."""

from __future__ import annotations

import numpy as np
import skfem
from scipy.sparse.linalg import splu

from mechanics.halfspace.section_elements import wave_stiffness

Array = np.ndarray


class EdgeSection:
    """Body in x > 0 with a free face at x = 0, under waves cos y of pressure on its surface.

    It ends at the plane x = `length`, about which loads are even or odd, and in a rigid base.
    """

    def __init__(self, poisson_ratio: float, length: float, depth: float, *, odd: bool) -> None:
        """Elements that are finer at the edge."""
        self._ratio = poisson_ratio
        x, z = _graded(length), _graded(depth)
        self._mesh = skfem.MeshQuad.init_tensor(x, z)
        element = skfem.ElementVector(skfem.ElementQuad2(), 3)
        self._basis = skfem.Basis(self._mesh, element, intorder=3)
        clamped = self._basis.get_dofs(lambda p: p[1] > depth - 1e-9).all()
        middle = self._basis.get_dofs(lambda p: p[0] > length - 1e-9)
        held = middle.all(["u^2", "u^3"] if odd else ["u^1"])
        self._free = np.setdiff1d(np.arange(self._basis.N), np.union1d(clamped, held))

    def stress_under(self, begin: float, end: float) -> tuple[Array, Array]:
        """Places x and z in elements, shape (2, n), and stresses xx, yy, zz, yz, xz, xy; (6, n).

        Under a unit pressure between two places, which are borders of elements.
        """
        top = self._mesh.facets_satisfying(lambda p: p[1] < 1e-9)
        facets = skfem.FacetBasis(self._mesh, self._basis.elem, facets=top, intorder=5)

        def form(v: Array, w: Array) -> Array:
            return 1.0 * ((w.x[0] > begin) & (w.x[0] < end)) * v[1]

        load = skfem.LinearForm(form).assemble(facets)
        stiffness = wave_stiffness(self._ratio, 1.0).assemble(self._basis)
        found = np.zeros(self._basis.N)
        solver = splu(stiffness[self._free][:, self._free].tocsc())
        found[self._free] = solver.solve(load[self._free])
        u = self._basis.interpolate(found)
        (ux, uz), (wx, wz), (vx, vz) = np.asarray(u.grad)
        along, down, across = np.asarray(u)
        volume = self._ratio / (1 - 2 * self._ratio) * (ux + wz + across)
        normal = [2 * (each + volume) for each in (ux, across, wz)]
        stress = np.array([*normal, vz - down, uz + wx, vx - along])
        places = np.asarray(self._basis.global_coordinates())
        return places.reshape(2, -1), stress.reshape(6, -1)


def _graded(length: float) -> Array:
    """Borders of elements, in steps of a twentieth as far as 1, with finer ones at the edge."""
    fine = 0.05 / 2.0 ** np.arange(6, 0, -1)
    coarse = (
        [1.0] if length <= 1 else np.linspace(1.0, length, int(np.ceil((length - 1) / 0.2)) + 1)
    )
    return np.unique(np.round([0.0, *fine, *np.arange(0.05, 1.0, 0.05), *coarse], 12))
