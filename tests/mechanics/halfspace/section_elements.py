"""Section of a layer on a rigid base that ends, by finite elements of scikit-fem, wave by wave."""

from __future__ import annotations

import numpy as np
import skfem
from scipy.sparse.linalg import splu

Array = np.ndarray


class LayerSection:
    """Layer of thickness and shear modulus 1 between a free face at x = 0 and the middle x = W.

    Pressure and displacement are waves cos k y along the layer, the displacement along y sin k y.
    """

    def __init__(self, poisson_ratio: float, half_length: float, row: float, *, odd: bool) -> None:
        """Elements whose borders are among those of the rows, finer at the edge and the base."""
        self._ratio, self._row = poisson_ratio, row
        steps = row * np.array([1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2])
        near, far = np.arange(0, 5 * row, row / 8), np.arange(5 * row, half_length + row / 4, row)
        x = np.unique(np.round(np.concatenate([steps, near, far]), 9))
        inner = np.linspace(row, 1 - row, 8)
        z = np.unique(np.round([0.0, *steps, *inner, *(1 - steps), 1.0], 9))
        mesh = skfem.MeshQuad.init_tensor(x, z)
        self._basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementQuad2(), 3), intorder=5)
        clamped = self._basis.get_dofs(lambda p: p[1] < 1e-9).all()
        middle = self._basis.get_dofs(lambda p: p[0] > half_length - 1e-9)
        held = middle.all(["u^2", "u^3"] if odd else ["u^1"])
        self._free = np.setdiff1d(np.arange(self._basis.N), np.union1d(clamped, held))
        top = mesh.facets_satisfying(lambda p: p[1] > 1 - 1e-9)
        self._top = skfem.FacetBasis(mesh, self._basis.elem, facets=top, intorder=7)

    def displacements(self, wave: float, loaded: int, rows: list[int]) -> Array:
        """Mean displacement of rows under a unit pressure on one of them, times the modulus."""
        stiffness = wave_stiffness(self._ratio, wave).assemble(self._basis)
        solver = splu(stiffness[self._free][:, self._free].tocsc())
        found = np.zeros(self._basis.N)
        found[self._free] = solver.solve(self._means(loaded)[self._free])
        return np.array([self._means(row) @ found for row in rows]) / self._row

    def _means(self, row: int) -> Array:
        begin, end = row * self._row, (row + 1) * self._row

        def form(v: Array, w: Array) -> Array:
            inside = (w.x[0] > begin) & (w.x[0] < end)
            return -1.0 * inside * v[1]

        return skfem.LinearForm(form).assemble(self._top)


def wave_stiffness(poisson_ratio: float, k: float) -> skfem.BilinearForm:
    dilatant = 2 * poisson_ratio / (1 - 2 * poisson_ratio)

    def strains(u: Array) -> tuple[Array, ...]:
        along, up, across = u[0], u[1], u[2]
        (ux, uz), (wx, wz), (vx, vz) = u.grad
        shears = (uz + wx) / 2, (vx - k * along) / 2, (vz - k * up) / 2
        return (ux, wz, k * across, *shears)

    def form(u: Array, v: Array, _: Array) -> Array:
        one, other = strains(u), strains(v)
        normal = sum(a * b for a, b in zip(one[:3], other[:3], strict=True))
        shear = sum(a * b for a, b in zip(one[3:], other[3:], strict=True))
        return 2 * (normal + 2 * shear) + dilatant * sum(one[:3]) * sum(other[:3])

    return skfem.BilinearForm(form)
