"""Half of a strip in plane strain that is loaded at its end, by finite elements of scikit-fem."""

from __future__ import annotations

import numpy as np
import skfem
from scipy.sparse.linalg import splu

Array = np.ndarray


class PlaneSection:
    """Strip between a free face at x = 0 and the middle x = 1, about which loads are even or odd.

    It is loaded on z = 0, and stands without friction on a base, far below, if loads are even.
    """

    def __init__(self, poisson_ratio: float, rows: int, *, odd: bool, depth: float = 8.0) -> None:
        """Elements whose borders are among those of the rows, finer at the edge."""
        self._ratio, self._row = poisson_ratio, 1 / rows
        steps = self._row * np.array([1 / 64, 1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2])
        even = np.arange(0, 1 + self._row / 4, self._row / 2)
        deep = np.linspace(1, depth, 60)
        x, z = (
            np.unique(np.round(np.concatenate(each), 9))
            for each in ((steps, even), ([0.0], steps, even[1:-1], deep))
        )
        mesh = skfem.MeshQuad.init_tensor(x, z)
        self._basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementQuad2(), 2), intorder=5)
        base = self._basis.get_dofs(lambda p: p[1] > depth - 1e-9)
        middle = self._basis.get_dofs(lambda p: p[0] > 1 - 1e-9)
        held = middle.all(["u^2"] if odd else ["u^1"])
        fixed = np.union1d(base.all(["u^1", "u^2"] if odd else ["u^2"]), held)
        self._free = np.setdiff1d(np.arange(self._basis.N), fixed)
        top = mesh.facets_satisfying(lambda p: p[1] < 1e-9)
        self._top = skfem.FacetBasis(mesh, self._basis.elem, facets=top, intorder=7)

    def displacements(self, loads: Array) -> Array:
        """Mean displacement of rows under pressures on them, over the contact compliance."""
        stiffness = self._stiffness().assemble(self._basis)
        solver = splu(stiffness[self._free][:, self._free].tocsc())
        means = [self._means(row) for row in range(len(loads))]
        found = np.zeros(self._basis.N)
        found[self._free] = solver.solve((loads @ np.array(means))[self._free])
        # The shear modulus is 1, and the contact compliance (1 - ν)/2.
        return np.array([mean @ found for mean in means]) / self._row * 2 / (1 - self._ratio)

    def _means(self, row: int) -> Array:
        begin, end = row * self._row, (row + 1) * self._row

        def form(v: Array, w: Array) -> Array:
            return 1.0 * ((w.x[0] > begin) & (w.x[0] < end)) * v[1]

        return skfem.LinearForm(form).assemble(self._top)

    def _stiffness(self) -> skfem.BilinearForm:
        dilatant = 2 * self._ratio / (1 - 2 * self._ratio)

        def strains(u: Array) -> tuple[Array, ...]:
            (ux, uz), (wx, wz) = u.grad
            return ux, wz, (uz + wx) / 2

        def form(u: Array, v: Array, _: Array) -> Array:
            one, other = strains(u), strains(v)
            normal = one[0] * other[0] + one[1] * other[1]
            volumes = (one[0] + one[1]) * (other[0] + other[1])
            return 2 * (normal + 2 * one[2] * other[2]) + dilatant * volumes

        return skfem.BilinearForm(form)
