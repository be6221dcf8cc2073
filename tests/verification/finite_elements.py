"""Round contact with creeping layers on a rigid base, by axisymmetric finite elements.

Independent of the package in space (bilinear elements of scikit-fem), in time (its own integration
of the standard solid) and in the contact (an active set of nodes on condensed stiffness).

A layer of the relaxation modulus G∞ + G₁ exp(-t/τ) and a constant Poisson's ratio has the stress of
its strain times G∞, and times G₁ that of ∫ exp(-(t - s)/τ) dε(s). The latter is the strain of a
field of displacements w with w' = u' - w/τ, so that nodal fields are all that is stored. With u
linear in time over a step d,

    w(t + d) = e w(t) + g [u(t + d) - u(t)],   e = exp(-d/τ),   g = (1 - e) τ/d.
"""

from dataclasses import dataclass

import numpy as np
import skfem
from scipy.sparse.linalg import splu
from skfem.helpers import ddot, sym_grad, trace

Array = np.ndarray


@dataclass(frozen=True)
class SolidLayer:
    """A layer of a standard solid, bonded to what is beneath."""

    thickness: float  # [m]
    relaxed: float  # shear modulus after a long time [Pa]
    decaying: float  # part of it that relaxes [Pa]
    time: float  # of this relaxation [s]
    poisson_ratio: float


@dataclass(frozen=True)
class RoundContact:
    """Approach [m], contact radius [m] and pressure at the centre [Pa] over time."""

    approach: Array
    radius: Array
    centre: Array


class LayersUnderABall:
    """Layers on a rigid base, out to where a load on the middle is not felt."""

    def __init__(self, layers: list[SolidLayer], reach: float, fine: int, wide: float) -> None:
        """Elements of reach/fine along the surface out to `reach`, then growing, to `wide` [m]."""
        self._layers = layers
        size = reach / fine
        r = _grown(0.0, wide, size, reach)
        depth = sum(layer.thickness for layer in layers)
        z, top = np.zeros(1), 0.0
        for layer in layers:
            count = max(int(np.ceil(layer.thickness / size * min(1.0, 1 / (1 + top / reach)))), 4)
            z = np.append(z, top + layer.thickness * np.arange(1, count + 1) / count)
            top += layer.thickness
        mesh = skfem.MeshQuad.init_tensor(r, depth - z[::-1])
        self._basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementQuad1()))
        self._matrices = self._layer_matrices(depth)
        at, tiny = self._basis.doflocs, 1e-6 * depth
        clamped = (at[1] < tiny) | (at[0] > wide - tiny)
        clamped |= (at[0] < tiny) & (np.arange(at.shape[1]) % 2 == 0)  # on the axis u_r = 0
        self._free = np.flatnonzero(~clamped)
        surface = np.flatnonzero((at[1] > depth - tiny) & (np.arange(at.shape[1]) % 2 == 1))
        surface = surface[at[0, surface] <= reach * (1 + 1e-9)]
        self._surface = surface[np.argsort(at[0, surface])]
        self.places = at[0, self._surface]

    def _layer_matrices(self, depth: float) -> list:
        """Stiffness of each layer per unit shear modulus, on all degrees of freedom."""
        middles = self._basis.mesh.p[1, self._basis.mesh.t].mean(axis=0)
        found, top = [], depth
        for layer in self._layers:
            inside = np.flatnonzero((middles < top) & (middles > top - layer.thickness))
            top -= layer.thickness
            part = self._basis.with_elements(inside)
            found.append(_stiffness(layer.poisson_ratio).assemble(part).tocsr())
        return found

    def press(self, radius: float, forces: Array, step: float) -> RoundContact:
        """Press a ball of a radius with given forces [N] at the ends of uniform steps.

        The first force acts at once.
        """
        shape = self.places**2 / (2 * radius)
        u = np.zeros(self._basis.N)
        lagging = [np.zeros_like(u) for _ in self._layers]  # w of each layer
        contact = np.ones(len(self.places), dtype=bool)
        states, solver = [], self._condensed(None)
        for k, force in enumerate(forces):
            if k == 1:
                solver = self._condensed(step)
            decays = [0.0 if k == 0 else np.exp(-step / each.time) for each in self._layers]
            gains = [self._gain(each, step if k else None) for each in self._layers]
            load = np.zeros_like(u)
            parts = zip(self._layers, self._matrices, lagging, decays, gains, strict=True)
            for layer, matrix, w, e, g in parts:
                load -= layer.decaying * (matrix @ (e * w - g * u))
            state, new, contact = self._solved(solver, load, shape, float(force), contact)
            for w, e, g in zip(lagging, decays, gains, strict=True):
                w *= e
                w += g * (new - u)
            u = new
            states.append(state)
        return RoundContact(*np.array(states).T)

    def _gain(self, layer: SolidLayer, step: float | None) -> float:
        """The factor g of a step; 1 of a jump."""
        return 1.0 if step is None else (1 - np.exp(-step / layer.time)) * layer.time / step

    def _condensed(self, step: float | None) -> tuple:
        """Factors of the stiffness in a step, and displacements of the surface by its forces."""
        total = sum(
            (each.relaxed + each.decaying * self._gain(each, step)) * matrix
            for each, matrix in zip(self._layers, self._matrices, strict=True)
        )
        factors = splu(total[self._free][:, self._free].tocsc())
        loads = np.zeros((self._basis.N, len(self._surface)))
        loads[self._surface, np.arange(len(self._surface))] = -1.0  # downwards
        moved = np.zeros_like(loads)
        moved[self._free] = factors.solve(loads[self._free])
        return factors, moved, -moved[self._surface]

    def _solved(
        self, solver: tuple, load: Array, shape: Array, force: float, contact: Array
    ) -> tuple[tuple[float, float, float], Array, Array]:
        """Contact under a force: nodes are released where they pull, and added where they enter."""
        factors, moved, compliance = solver
        u = np.zeros(self._basis.N)
        u[self._free] = factors.solve(load[self._free])
        sunk = -u[self._surface]
        for _ in range(200):
            inside = np.flatnonzero(contact)
            system = np.ones((inside.size + 1, inside.size + 1))
            system[:-1, :-1], system[-1, -1] = compliance[np.ix_(inside, inside)], 0.0
            system[:-1, -1] = -1.0
            *pressed, approach = np.linalg.solve(
                system, np.append(-shape[inside] - sunk[inside], force)
            )
            forces = np.zeros(len(shape))
            forces[inside] = pressed
            gap = sunk + compliance @ forces - (approach - shape)
            following = np.where(contact, forces > 0, gap < 0)
            if (following == contact).all():
                break
            contact = following
        else:
            raise AssertionError("the contact was not found")
        # Mean pressure around the axis: forces of the first nodes over the area that they carry.
        r, size = self.places[2], self.places[3] - self.places[2]
        centre = forces[:3].sum() / (np.pi * (r**2 + size * r + size**2 / 3))
        last = int(np.flatnonzero(contact)[-1])
        radius = (self.places[last] + self.places[last + 1]) / 2
        return (approach, radius, centre), u + moved @ forces, contact


def _grown(start: float, end: float, size: float, reach: float) -> Array:
    """Places of equal steps out to a reach, then growing by a fifth to the end."""
    places = list(np.arange(start, reach + size / 2, size))
    while places[-1] < end:
        size *= 1.2
        places.append(places[-1] + size)
    return np.array(places) * np.where(np.array(places) > reach, end / places[-1], 1.0)


def _stiffness(poisson_ratio: float) -> skfem.BilinearForm:
    """Axisymmetric stiffness per unit shear modulus; x is the distance from the axis."""
    dilatant = 2 * poisson_ratio / (1 - 2 * poisson_ratio)

    def form(u: Array, v: Array, w: Array) -> Array:
        r = w.x[0]
        (hoop, other), (strain, virtual) = (u[0] / r, v[0] / r), (sym_grad(u), sym_grad(v))
        volumes = (trace(strain) + hoop) * (trace(virtual) + other)
        return 2 * np.pi * r * (2 * (ddot(strain, virtual) + hoop * other) + dilatant * volumes)

    return skfem.BilinearForm(form)
