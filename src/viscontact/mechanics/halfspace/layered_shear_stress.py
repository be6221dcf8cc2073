"""Stress influence coefficients of a rectangle under uniform shear traction on elastic layers.

A traction along x is one of waves whose parts along and across their wave vector q (c, s) are c and
-s. With the transforms X, Y, S, T of the first (`stack_waves`) and Z, V of the second, of antiplane
strain, D = X - Y - 2 Z and E = T - V, the stresses under exp(i k r) are

    σxx = i c (Y + 2 Z + D c²),   σyy = i c (Y + D s²),   σzz = i c S,
    σxz = V + E c²,   σyz = E c s,   σxy = i s (Z + D c²).

Over the distance r from a point load let

    φ_F(r) = (1/2π) ∫_0^∞ F(q) J0(q r) dq,   A_F(r) = (1/2π) ∫_0^∞ F(q) J1(q r) dq,

and M the integral of φ_D r from 0 to r. As i c q is the derivative in x, and -M/r that of the
function whose Laplacian is -φ_D, each corner (x, y) of a rectangle contributes to the double
difference over its corners

    σxx: ∫_0^y [φ_(Y + 2Z) + M/r² + x² G] dy',   G = (φ_D - 2 M/r²)/r²,
    σyy: ∫_0^y φ_Y dy' + y M/r²,   σzz: ∫_0^y φ_S dy',   σxy: ∫_0^x φ_Z dx' + x M/r²,
    σxz: I_T(x, y) + I_V(y, x),   σyz: ∫_0^r A_E dr',   I_F(x, y) = x ∫_0^y A_F(r')/r' dy'.

As under a pressure (`layered_stress`), in the uppermost layer they are corrections to those of its
half-space (`shear_stress_influence`), and smooth on the scale of its thickness everywhere.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
import scipy

from viscontact.backend.arrays import Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.layered_stress import (
    hankel_at_zero,
    hankel_rule,
    integrals_along,
    sums_of_corners,
    without_tiny,
)
from viscontact.mechanics.halfspace.shear_stress_influence import shear_stress_coefficients
from viscontact.mechanics.halfspace.smooth_kernel import DEGREE, MIRRORED, STEP, extended
from viscontact.mechanics.halfspace.stack_waves import (
    AntiplaneWaves,
    StackWaves,
    antiplane_waves,
    layer_at,
    poisson_ratio_at,
    stack_waves,
)
from viscontact.mechanics.halfspace.stress_influence import EXCHANGED
from viscontact.mechanics.halfspace.stress_response import (
    StressResponse,
    WaveTensors,
    half_space_amplitudes,
    sheared_tensors,
)

#: Places of the amplitudes of waves.
ALONG, ACROSS, NORMAL, SHEAR, SIDEWAYS, TURNED = range(6)


@dataclass(frozen=True)
class LayeredShearStress(StressResponse):
    """Stresses in a stack of bonded elastic layers under a traction along x or y."""

    stack: ElasticStack
    axis: int

    def poisson_ratio_at(self, depth: float) -> float:
        """Poisson's ratio of the layer, or of the base."""
        return poisson_ratio_at(self.stack, depth)

    @property
    def exchanged(self) -> LayeredShearStress:
        """Under a traction along the other axis."""
        return LayeredShearStress(self.stack, 1 - self.axis)

    def tensors(self, kx: Floats, ky: Floats) -> WaveTensors:
        """Stresses of a wave of traction along x or y."""
        q = np.hypot(kx, ky)
        q[0, 0] = 1.0  # the mean has no direction
        waves = _Waves.of(self.stack, q.ravel())
        return sheared_tensors(
            kx, ky, self.axis, lambda depth: waves.amplitudes(depth).reshape(6, *q.shape)
        )

    def coefficients(self, x_edges: Floats, y_edges: Floats, depth: float) -> Floats:
        """Stresses at a point per unit traction on cells, as in `shear_stress_coefficients` [-]."""
        if self.axis == 1:
            turned = self.exchanged.coefficients(y_edges, x_edges, depth)
            return turned[EXCHANGED].swapaxes(1, 2)
        length = self.stack.layers[0].thickness

        def corners(x: Floats, y: Floats, reach: float) -> Floats:
            return _corner_terms(self._table(depth, reach), x, y)

        found = sums_of_corners(corners, x_edges / length, y_edges / length)
        if layer_at(self.stack, depth) == 0:
            nu = self.stack.layers[0].poisson_ratio
            found += shear_stress_coefficients(x_edges, y_edges, depth, nu)
        return np.asarray(found)

    @cached_property
    def _rays(self) -> dict[int, _Waves]:
        return {}

    def _table(self, depth: float, reach: float) -> _Table:
        """Table of the transforms for distances up to `reach` in units of the first layer."""
        count = int(np.ceil(np.arcsinh(reach) / STEP)) + MIRRORED
        length = self.stack.layers[0].thickness
        q, hankel = hankel_rule(count)
        if count not in self._rays:
            self._rays[count] = _Waves.of(self.stack, q / length)
        amplitudes = self._rays[count].amplitudes(depth)
        if layer_at(self.stack, depth) == 0:
            nu = self.stack.layers[0].poisson_ratio
            amplitudes = amplitudes - half_space_amplitudes(nu, q / length * depth)
        return _Table.of(without_tiny(amplitudes), count, hankel)


@dataclass(frozen=True, eq=False)
class _Waves:
    """Waves of both kinds under tractions."""

    in_plane: StackWaves
    antiplane: AntiplaneWaves

    @classmethod
    def of(cls, stack: ElasticStack, q: Numbers) -> _Waves:
        """Waves of a stack of wave numbers [1/m]."""
        return cls(stack_waves(stack, q, sheared=True), antiplane_waves(stack, q))

    def amplitudes(self, depth: float) -> Numbers:
        """X, Y, S, T, V and Z at a depth [m], shape (6, n)."""
        found, (turned, sideways) = (
            self.in_plane.stresses(depth),
            self.antiplane.stresses(depth),
        )
        own = found.along, found.across, found.normal, found.shear
        return np.stack([*own, sideways, turned])


@dataclass(frozen=True, eq=False)
class _Table:
    """Splines over asinh r; distances in units of the first layer."""

    waves: Any  # φ of Y + 2 Z, Y, S and Z
    rays: Any  # A_T/r and A_V/r
    moments: Any  # M/r² and G
    difference: Any  # integral of A_E

    @classmethod
    def of(cls, amplitudes: Numbers, count: int, hankel: tuple[Any, Any]) -> _Table:
        """Table of the amplitudes of waves at the wave numbers of Hankel's rule."""
        t = STEP * np.arange(0.5, count)
        r = np.sinh(t)
        along, across, normal, shear, sideways, turned = amplitudes
        bent = along - across - 2 * turned
        even = np.stack([across + 2 * turned, across, normal, turned, bent])
        phi = np.einsum("rq,fq->rf", hankel[0], even).real
        odd = np.stack([shear, sideways])
        ray = np.einsum("rq,fq->rf", hankel[1], odd).real + hankel_at_zero(odd, r)
        spread = _spline(t, phi[:, 4] * r * np.cosh(t), -1).antiderivative()
        mean = (spread(t) - spread(0.0)) / r**2
        moments = np.stack([mean, (phi[:, 4] - 2 * mean) / r**2], axis=1)
        return cls(
            _spline(t, phi[:, :4], 1),
            _spline(t, ray / r[:, None], 1),
            _spline(t, moments, 1),
            _spline(t, (ray[:, 0] - ray[:, 1]) * np.cosh(t), -1).antiderivative(),
        )


def _spline(t: Floats, values: Floats, sign: int) -> Any:
    return scipy.interpolate.make_interp_spline(*extended(t, values, sign), k=DEGREE)


def _corner_terms(table: _Table, x: Floats, y: Floats) -> Floats:
    """Corner terms of all components; a cell's stress is their double difference; (6, nx, ny)."""
    (x_sizes, x_places), (y_sizes, y_places) = (
        np.unique(np.abs(each), return_inverse=True) for each in (x, y)
    )
    near_x, near_y = x_sizes[:, None], y_sizes[None, :]

    def beside_x(near: Floats, r: Floats) -> Floats:
        place = np.arcsinh(r)
        both, _, normal, _ = np.moveaxis(table.waves(place), -1, 0)
        across = table.waves(place)[..., 1]
        mean, bent = np.moveaxis(table.moments(place), -1, 0)
        forward = near * table.rays(place)[..., 0]
        return np.stack([both + mean + near**2 * bent, across, normal, forward], axis=-1)

    def beside_y(near: Floats, r: Floats) -> Floats:
        place = np.arcsinh(r)
        return np.stack([table.waves(place)[..., 3], near * table.rays(place)[..., 1]], axis=-1)

    xx, yy, zz, forward = integrals_along(beside_x, x_sizes, y_sizes)
    turned, sideways = integrals_along(beside_y, y_sizes, x_sizes).swapaxes(1, 2)
    place = np.arcsinh(np.hypot(near_x, near_y))
    mean = table.moments(place)[..., 0]
    yz = table.difference(place)
    found = np.stack([xx, yy + near_y * mean, zz, yz, forward + sideways, turned + near_x * mean])
    odd_x, odd_y = np.sign(x)[:, None], np.sign(y)[None, :]
    one = np.ones((x.size, y.size))
    signs = np.stack([odd_y * one, odd_y * one, odd_y * one, one, odd_x * odd_y, odd_x * one])
    return np.asarray(found[:, x_places[:, None], y_places[None, :]] * signs)
