"""Rigid cylinder on a body of its own length, by finite elements of its sections, wave by wave.

Independent of the package: displacements of a body between two free faces under waves of pressure
along the cylinder's axis y are those of scikit-fem, and the contact an active set of cells.
"""

from __future__ import annotations

import numpy as np
import skfem
from scipy.sparse.linalg import splu

from mechanics.halfspace.section_elements import wave_stiffness

Array = np.ndarray

#: Depth of the elements in half lengths, below which sections are alike or undisturbed.
DEPTH = 3.0


class Section:
    """Half of a body between free faces, in x from a face to the middle; shear modulus 1."""

    def __init__(self, poisson_ratio: float, half_length: float, rows: int) -> None:
        """Elements of a row of cells each, finer at the face and the surface."""
        self._ratio, self._row, depth = poisson_ratio, half_length / rows, DEPTH * half_length
        finer = self._row * 2.0 ** -np.arange(1.0, 7.0)
        near = self._row * np.arange(0, 4, 1 / 8)
        x = np.concatenate([finer, near, self._row * np.arange(rows + 1)])
        z = np.append(0.0, np.cumsum(self._row / 8 * 1.25 ** np.arange(60)))
        z = z[: np.searchsorted(z, depth) + 1]
        mesh = skfem.MeshQuad.init_tensor(np.unique(np.round(x, 12)), z)
        element = skfem.ElementVector(skfem.ElementQuad2(), 3)
        self._basis = skfem.Basis(mesh, element, intorder=4)
        every = self._basis.get_dofs(lambda p: p[0] > -1.0)
        base = self._basis.get_dofs(lambda p: p[1] > z[-1] - 1e-9)
        middle = self._basis.get_dofs(lambda p: p[0] > half_length - 1e-9).all(["u^1"])
        self._fixed = np.union1d(base.all(), middle)
        # The mean along y is plane strain, in which the base may widen.
        self._plane = np.unique([*every.all(["u^3"]), *base.all(["u^2"]), *middle])
        top = mesh.facets_satisfying(lambda p: p[1] < 1e-9)
        facets = skfem.FacetBasis(mesh, element, facets=top, intorder=5)
        self._loads = np.array([self._mean(facets, row) for row in range(rows)]).T

    def _mean(self, facets: skfem.FacetBasis, row: int) -> Array:
        begin, end = row * self._row, (row + 1) * self._row

        def form(v: Array, w: Array) -> Array:
            return 1.0 * ((w.x[0] > begin) & (w.x[0] < end)) * v[1]

        return skfem.LinearForm(form).assemble(facets)

    def compliance(self, wave: float) -> Array:
        """Mean displacement of rows under a wave of unit pressure on rows."""
        stiffness = wave_stiffness(self._ratio, wave).assemble(self._basis)
        fixed = self._plane if wave == 0 else self._fixed
        free = np.setdiff1d(np.arange(self._basis.N), fixed)
        found = splu(stiffness[free][:, free].tocsc()).solve(self._loads[free])
        return self._loads[free].T @ found / self._row


def line_load(
    section: Section, rows: int, columns: int, width: float, gap: Array, waves: int, level: float
) -> Array:
    """Load of rows over its mean, under cells of a period of a width along y, even about y = 0.

    `gap` is that of half of the columns, `level` the mean pressure over the shear modulus.
    """
    edge, half = width / columns, columns // 2
    y = (np.arange(half) + 0.5) * edge
    compliance, last = np.zeros((rows, half, rows, half)), np.zeros((rows, rows))
    for number in range(5 * waves):
        wave = 2 * np.pi * number / width
        # Of shorter waves each row feels its own, which falls with the wave number.
        if number <= waves:
            last = own = section.compliance(wave)
        else:
            own = np.diag(np.diag(last)) * waves / number
        mean = float(np.sinc(wave * edge / (2 * np.pi)))
        cosines = np.cos(wave * y)
        part = (2.0 if number else 1.0) * 2 * edge / width * mean
        compliance += part * np.einsum("ab,j,l->ajbl", own, cosines, cosines)
    matrix = compliance.reshape(rows * half, -1)
    matrix = (matrix + matrix.T) / 2
    pressure = pressed(matrix, np.tile(gap, rows), level * rows * half)
    found = pressure.reshape(rows, half).sum(axis=1)
    return found / found.mean()


def pressed(matrix: Array, gap: Array, total: float) -> Array:
    """Pressures of a total with no tension and no overlap, by an active set."""
    touched = gap < np.median(gap)
    for _ in range(100):
        cells = np.flatnonzero(touched)
        flat, shape = np.linalg.solve(
            matrix[np.ix_(cells, cells)], np.column_stack([np.ones(len(cells)), gap[cells]])
        ).T
        approach = (total + shape.sum()) / flat.sum()
        pressure = np.zeros(len(gap))
        pressure[cells] = approach * flat - shape
        open_gap = matrix @ pressure + gap - approach
        after = (touched & (pressure > 0)) | (~touched & (open_gap < 0))
        if np.array_equal(after, touched):
            return pressure
        touched = after
    raise RuntimeError("no active set was found")
