"""Separation of the response of creeping layers into creep functions times frequency responses.

By the correspondence principle the surface of layers under a wave of pressure p~(q, s), Laplace
transformed in time, is displaced by (2/q) C(q, s) p~, where C is that of the elastic stack of the
moduli G~(s) = 1/(2 s L[Phi]). The sum

    C(q, s) ≈ Σ_m b_m(s) L_m(q),   b_m(s) = s L[J_m],

takes its creep functions J_m from the materials: the contact compliance of the uppermost layer,
which short waves see, those of the other parts, and the compliances of uniaxial compression, which
long waves see on a rigid base; after these, from C at single wave numbers, as Prony series with
amplitudes >= 0. So each J_m is passive. The L_m follow by collocation at as many real s_j,

    L_m(q) = Σ_j (B^-1)_mj C(q, s_j),   B_jm = b_m(s_j):

sums of responses of elastic stacks. Functions and s_j are chosen one after the other for the least
error of the harmonic response, max |Σ b_m L_m - C|/|C| over wave numbers and frequencies. Twice
this error is stated.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from viscontact.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.halfspace.surface_response import SummedResponse
from viscontact.laws import SeriesLaw
from viscontact.materials.compliance import SeriesCompliance
from viscontact.materials.layers import Layered
from viscontact.materials.material import Material, uniaxial_compression

Array = NDArray[Any]

#: Error at which no term is added, and most terms.
ENOUGH, MOST_TERMS = 1e-4, 5

#: Stated error over the largest one found, for wave numbers and frequencies between those, and for
#: creep in time.
SAFETY = 2.0

#: Wave numbers, frequencies and real s at which the error is measured and collocation tried.
WAVES, FREQUENCIES, COLLOCATION = 60, 40, 14

#: Range of q h, of the thinnest layer and of all, and of ω τ of the longest and shortest times.
LONG, SHORT, MARGIN = 0.01, 15.0, 30.0

#: Largest sum of the absolute values of the terms, over that of the terms.
MOST_CANCELLATION = 10.0

#: Relative difference of creep functions that count as proportional here.
ALIKE = 1e-6

#: Retardation times per decade of a creep function at one wave number.
TIMES_PER_DECADE = 4

#: Rounds in which the steps between them are halved around those in use.
REFINEMENTS = 12


@dataclass(frozen=True, eq=False)
class Separation:
    """Terms (J_m, L_m) of a body of layers, and a bound of the relative error of their sum [-]."""

    compliances: tuple[SeriesCompliance, ...]
    responses: tuple[SummedResponse, ...]
    error: float


@lru_cache(maxsize=16)
def separate(body: Layered) -> Separation:
    """Separate the response of layers whose laws are Prony series.

    Examples
    --------
    Rubber on steel needs two terms, that of the cover and that of the core:

    >>> from viscontact.laws import Elastic, Zener
    >>> from viscontact.materials.layers import Layer
    >>> rubber = Material(Zener(2e6, 1e6, 1e6), poisson_ratio=0.49)
    >>> steel = Material(Elastic(80e9), poisson_ratio=0.3)
    >>> found = separate(Layered([Layer(5e-3, rubber)], base=steel))
    >>> len(found.compliances), found.error < 1e-6
    (2, True)
    """
    if not all(isinstance(material.law, SeriesLaw) for material in body.materials):
        raise ValueError(
            "material: layers that creep differently need laws that are Prony series, such as "
            "Zener, CreepSeries or RelaxationSeries; fit one to the other laws, for example with "
            "fit_creep"
        )
    return _Search(body).best()


class _Search:
    """Choice of creep functions and collocation points for one body."""

    def __init__(self, body: Layered) -> None:
        self._body = body
        lengths = [layer.thickness for layer in body.layers]
        self._q = np.geomspace(LONG / sum(lengths), SHORT / min(lengths), WAVES)
        slow, fast = _rates(body.materials)
        self._omega = np.geomspace(slow / MARGIN, fast * MARGIN, FREQUENCIES)
        self._s = np.geomspace(slow / MARGIN, fast * MARGIN, COLLOCATION)
        self._at_s = self._responses(self._s)
        self._full = self._responses(1j * self._omega)

    def best(self) -> Separation:
        """Terms with an error that is small enough, or as small as it becomes."""
        chosen = [_contact_compliance(self._body.layers[0].material)]
        points, error = self._collocated(chosen)
        while error > ENOUGH and len(chosen) < MOST_TERMS:
            found = self._with_another(chosen, self._of_parts(chosen))
            # Exact functions before fitted ones.
            if found is None or found[2] > max(ENOUGH, error / 2):
                waves = [self._at_wave(index) for index in range(2, WAVES, WAVES // 10)]
                others = self._with_another(chosen, waves)
                found = others if found is None or (others and others[2] < found[2]) else found
            if found is None or not found[2] < error:
                break
            chosen, points, error = found
        return Separation(tuple(chosen), self._kernels(chosen, points), SAFETY * error)

    def _responses(self, s: Array) -> Array:
        """C(q, s) [1/Pa], shape (s, q)."""
        return np.array([self._stack(each)[1] * self._stack(each)[0].ratio(self._q) for each in s])

    def _stack(self, s: Any) -> tuple[ElasticStack, Any]:
        """Elastic stack at one s, and the contact compliance of its uppermost layer [1/Pa]."""
        constants = [_constants(material, s) for material in self._body.materials]
        (shear, poisson_ratio), *_ = constants
        return stack_of(self._body, constants), (1 - poisson_ratio) / (2 * shear)

    def _collocated(self, chosen: Sequence[SeriesCompliance]) -> tuple[tuple[int, ...], float]:
        """Best collocation points for some creep functions, and the error with them."""
        at_s = np.array([transformed(each, self._s) for each in chosen])  # (m, s)
        harmonic = np.array([transformed(each, 1j * self._omega) for each in chosen])
        best: tuple[tuple[int, ...], float] = ((), np.inf)
        for points in combinations(range(self._s.size), len(chosen)):
            matrix = at_s[:, points].T
            if np.linalg.cond(matrix / np.abs(matrix).max(axis=0)) > 1e8:
                continue
            kernels = np.linalg.solve(matrix, self._at_s[list(points)])
            parts = np.abs(at_s[:, :, None] * kernels[:, None]).sum(axis=0)
            if float((parts / self._at_s).max()) > MOST_CANCELLATION:
                continue
            error = float(np.abs(harmonic.T @ kernels / self._full - 1).max())
            if error < best[1]:
                best = points, error
        return best

    def _kernels(
        self, chosen: Sequence[SeriesCompliance], points: tuple[int, ...]
    ) -> tuple[SummedResponse, ...]:
        stacks, tops = zip(*(self._stack(float(self._s[j])) for j in points), strict=True)
        matrix = np.array([transformed(each, self._s[list(points)]) for each in chosen]).T
        weights = np.linalg.inv(matrix) * np.array(tops)
        return tuple(SummedResponse(tuple(stacks), tuple(row.tolist())) for row in weights)

    def _with_another(
        self, chosen: list[SeriesCompliance], candidates: list[SeriesCompliance]
    ) -> tuple[list[SeriesCompliance], tuple[int, ...], float] | None:
        """Creep functions with the best of some candidates, its points and error."""
        tried = [([*chosen, new], *self._collocated([*chosen, new])) for new in candidates]
        return min(tried, key=lambda each: each[2], default=None)

    def _of_parts(self, chosen: Sequence[SeriesCompliance]) -> list[SeriesCompliance]:
        """Creep functions of the materials that are not used yet."""
        parts = [_contact_compliance(material) for material in self._body.materials[1:]]
        parts += [
            uniaxial_compression(material)
            for material in self._body.materials
            if material.bulk_modulus is not None
        ]
        return [part for part in parts if not any(_alike(part, old, self._s) for old in chosen)]

    def _at_wave(self, index: int) -> SeriesCompliance:
        """Creep function of one wave number, by non-negative least squares over ω."""
        omega, wanted = self._omega, self._full[:, index]
        decades = float(np.log10(omega[-1] / omega[0]))
        spread = np.log(10) / TIMES_PER_DECADE
        times = 1 / np.geomspace(omega[0], omega[-1], int(decades * TIMES_PER_DECADE) + 1)
        # The sum has few terms: look more closely around the times that it uses.
        for _ in range(REFINEMENTS):
            found = _fitted(times, omega, wanted)
            used = times[found[1:-1] > 0]
            spread /= 2
            times = np.unique(np.multiply.outer(used, np.exp(spread * np.linspace(-1, 1, 5))))
        found = _fitted(times, omega, wanted)
        return SeriesCompliance(found[0], found[1:-1], times, found[-1])


def _fitted(times: Array, omega: Array, wanted: Array) -> NDArray[np.float64]:
    """Instant compliance, amplitudes and fluidity >= 0 of the least relative error over ω."""
    parts = [np.ones_like(wanted), *(1 / (1 + 1j * omega * time) for time in times)]
    scale, slowest = float(np.abs(wanted).max()), omega[0]
    columns = np.stack([*parts, slowest / (1j * omega)], axis=1) * (scale / np.abs(wanted))[:, None]
    relative = wanted / np.abs(wanted)
    rows = np.concatenate([columns.real, columns.imag])
    found, _ = scipy.optimize.nnls(rows, np.concatenate([relative.real, relative.imag]))
    found *= scale
    found[-1] *= slowest
    return np.asarray(found)


def stack_of(body: Layered, constants: Sequence[tuple[Any, Any]]) -> ElasticStack:
    """Stack of elastic layers: shear modulus [any unit] and Poisson's ratio of each material."""
    assert not isinstance(body.bonded, bool)  # made a tuple
    layers = tuple(
        ElasticLayer(layer.thickness, *each, bonded=bonded)
        for layer, each, bonded in zip(body.layers, constants, body.bonded, strict=False)
    )
    base = None if isinstance(body.base, str) else ElasticBase(*constants[-1])
    return ElasticStack(layers, base)


def transformed(compliance: SeriesCompliance, s: Array) -> Array:
    """Laplace transform s L[J] of a Prony series, J_0 + Σ J_i/(1 + s τ_i) + φ/s [1/Pa]."""
    delayed = compliance.amplitudes / (1 + np.multiply.outer(s, compliance.times))
    return np.asarray(compliance.instant + delayed.sum(axis=-1) + compliance.fluidity / s)


def _creep(material: Material) -> SeriesCompliance:
    assert isinstance(material.law, SeriesLaw)  # checked in `separate`
    return SeriesCompliance(*material.law.creep_series().terms)


def _contact_compliance(material: Material) -> SeriesCompliance:
    found = material.contact_compliance()
    assert isinstance(found, SeriesCompliance)  # as the law is a series
    return found


def _constants(material: Material, s: Any) -> tuple[Any, Any]:
    """Shear modulus G~(s) [Pa] and Poisson's ratio of the elastic body that a material is at s."""
    shear = 1 / (2 * transformed(_creep(material), np.asarray(s))[()])
    if material.poisson_ratio is not None:
        return shear, material.poisson_ratio
    bulk = material.bulk_modulus
    assert bulk is not None  # exactly one is given
    return shear, (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))


def _alike(one: SeriesCompliance, other: SeriesCompliance, s: Array) -> bool:
    """True for two creep functions that are proportional to a few digits."""
    ratio = transformed(one, s) / transformed(other, s)
    return bool(ratio.max() < (1 + ALIKE) * ratio.min())


def _rates(materials: Sequence[Material]) -> tuple[float, float]:
    """Slowest and fastest rate of creep and of relaxation of all laws [1/s]."""
    rates = []
    for creep in map(_creep, materials):
        rates += (1 / creep.times).tolist()
        if creep.instant > 0:  # a body relaxes faster than it creeps
            begun = float((creep.amplitudes / creep.times).sum()) + creep.fluidity
            rates += [begun / creep.instant] if begun else []
    return (min(rates), max(rates)) if rates else (1.0, 1.0)
