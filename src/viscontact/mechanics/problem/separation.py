"""Separation of the response of creeping layers into creep functions times frequency responses.

The compliance C(q, s) of layers (`creeping_stack`) is approximated by a short sum

    C(q, s) ≈ Σ_m b_m(s) L_m(q),   b_m(s) = s L[J_m].

The creep functions J_m are those of the materials: the contact compliance of the uppermost layer,
which short waves see, those of the other parts, and the compliances of uniaxial compression, which
long waves see on a rigid base; after these, those of the layers themselves at single wave numbers.
Each is a Prony series with amplitudes >= 0. The L_m follow by collocation at as many real s_j,

    L_m(q) = Σ_j (B^-1)_mj C(q, s_j),   B_jm = b_m(s_j):

sums of responses of elastic stacks. The sum is exact at the wave numbers and at the s_j in use, as
in cross approximation: the next wave number is that of the largest error, and all of them are moved
while the error falls. The s_j are the pivots of a QR factorisation of the b_m. The error is that of
the harmonic response, max |Σ b_m L_m - C|/|C| over wave numbers and frequencies.

The sum is made passive (`passivity`), and its error is measured with that on finer grids. A larger
error is stated, for what lies between them.

References
----------
M. Bebendorf, Numer. Math. 86 (2000) 565: cross approximation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import TypeAlias

import numpy as np
import scipy

from viscontact.backend.arrays import Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material, uniaxial_compression
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.surface_response import SummedResponse
from viscontact.mechanics.problem.creeping_stack import CreepingStack, stack_of, transformed
from viscontact.mechanics.problem.passivity import passive_share
from viscontact.mechanics.problem.rational_creep import series_of_transform
from viscontact.mechanics.problem.series_body import ANY_TIMES, Span, series_body

__all__ = ["Separation", "separate", "stack_of", "transformed"]


#: Error at which no term is added, and most terms.
ENOUGH, MOST_TERMS = 6.5e-4, 12

#: Largest error with laws that are not Prony series.
WORST = 0.1

#: Stated error over the largest one found, for waves and frequencies between those looked at.
SAFETY = 1.5

#: Wave numbers at which the error is measured, and frequencies and real s a decade.
WAVES, FREQUENCIES_PER_DECADE, COLLOCATION_PER_DECADE = 60, 7, 6

#: As many times more of both are looked at in the end, for the error and for the loss.
FINER, FINEST = 2, 4

#: Range of q h, of all layers and of the thinnest one, and of ω τ of the longest and shortest
#: times.
LONG, SHORT, MARGIN = 0.01, 15.0, 30.0

#: The same for the loss.
LONGEST, SHORTEST, WIDER = 1e-4, 40.0, 1e3

#: Largest sum of the absolute values of the terms, and of all responses in them, over that of the
#: terms.
MOST_CANCELLATION, MOST_ROUNDING = 100.0, 1e7

#: Singular values of b_m(s_j), over the largest, of functions that are not independent.
DEPENDENT = 1e-14

#: Relative difference of creep functions that count as proportional here.
ALIKE = 1e-6

#: Steps by which wave numbers are moved, rounds of this, and the factor of the error to do it for.
MOVES, ROUNDS, WORTHWHILE = (-1, 1, -2, 2), 3, 0.98


#: Compliances of waves of a stack.
Waves: TypeAlias = Callable[[CreepingStack, Numbers, Numbers], Numbers]


@dataclass(frozen=True, eq=False)
class Separation:
    """Terms (J_m, L_m) of a body of layers, and a bound of the relative error of their sum [-]."""

    compliances: tuple[ContactCompliance, ...]
    responses: tuple[SummedResponse, ...]
    error: float
    stacks: tuple[ElasticStack, ...] = ()  # parts of all responses


@lru_cache(maxsize=16)
def separate(body: Layered, span: Span = ANY_TIMES) -> Separation:
    """Terms of the response of layers over times of interest [s]; ValueError if none come close."""
    series, deviation = series_body(body, span)
    return with_laws(Collocation(series).best(), body, series, deviation)


def with_laws(found: Separation, body: Layered, series: Layered, deviation: float) -> Separation:
    """Terms with the laws of a body itself, in whose place series were; ValueError if far off."""
    if series is body:
        if not found.error <= WORST:
            raise ValueError(
                "material: no short sum of terms comes close to the creep of these layers, some of "
                "which flow by far more than others; give them fewer retardation times, or a "
                "modulus that is left after all creep in place of a fluid"
            )
        return found
    # Creep functions of materials are those of the laws themselves, as the responses depend little
    # on the law.
    compliances = tuple(_of_law(each, body, series) for each in found.compliances)
    kept = any(
        each is old and not each.is_elastic
        for each, old in zip(compliances, found.compliances, strict=True)
    )
    error = found.error + (deviation if kept else 0.0)
    if not error <= WORST:
        raise ValueError(
            "material: no short sum of terms comes close to the creep of these layers, with laws "
            "that are not Prony series with an instant compliance; fit one to them, for example "
            "with fit_creep"
        )
    return replace(found, compliances=compliances, error=error)


def _of_law(found: ContactCompliance, body: Layered, series: Layered) -> ContactCompliance:
    """The contact compliance of the law in whose place a series was, or the series itself."""
    assert isinstance(found, SeriesCompliance)  # as all terms are before
    for given, used in zip(body.materials, series.materials, strict=True):
        if given is not used and given.poisson_ratio is not None:
            own = _contact_compliance(used)
            if own.instant == found.instant and np.array_equal(own.amplitudes, found.amplitudes):
                return given.contact_compliance()
    return found


@dataclass(frozen=True, eq=False)
class _Choice:
    """Creep functions of materials and of single wave numbers, with collocation points."""

    materials: tuple[SeriesCompliance, ...]
    waves: tuple[int, ...] = ()  # indices of wave numbers
    points: tuple[int, ...] = ()  # indices of s_j
    error: float = np.inf
    worst: int = 0  # index of the wave number of the largest error

    @property
    def count(self) -> int:
        return len(self.materials) + len(self.waves)


class Collocation:
    """Choice of creep functions and collocation points for one body.

    `compliance` are those of waves at wave numbers and Laplace variables, shape (s, waves).
    """

    def __init__(self, body: Layered, compliance: Waves = CreepingStack.compliance) -> None:
        self._stack, self._compliance = CreepingStack(body), compliance
        whole, thinnest = body.thickness, min(layer.thickness for layer in body.layers)
        slow, fast = self._stack.rates
        decades = float(np.log10(fast / slow * MARGIN**2))
        self._q = np.geomspace(LONG / whole, SHORT / thinnest, WAVES)
        self._wide_q = np.geomspace(LONGEST / whole, SHORTEST / thinnest, FINEST * WAVES)
        self._ends = slow / MARGIN, fast * MARGIN
        self._omega = np.geomspace(*self._ends, int(decades * FREQUENCIES_PER_DECADE))
        self._s = np.geomspace(*self._ends, int(decades * COLLOCATION_PER_DECADE))
        self._at_s = self._waves(self._q, self._s)
        self._full = self._waves(self._q, 1j * self._omega)
        self._weights = np.exp(-np.log(self._at_s).mean(axis=1))
        self._of_waves: dict[int, SeriesCompliance] = {}
        self._parts = _of_parts(body.materials, self._s)

    def _waves(self, q: Numbers, s: Numbers) -> Numbers:
        return self._compliance(self._stack, q, s)

    def best(self) -> Separation:
        """Terms with an error that is small enough, or as small as it becomes."""
        # Elastic parts from the beginning: where most of a wave's energy is in one, a sum without
        # it has a loss as wrong as its error, and passivity costs a hundred times that error.
        first, *others = self._parts
        elastic = (part for part in others if part.is_elastic)
        choice, best = self._collocated(_Choice((first, *elastic))), None
        while True:
            done = choice.count >= MOST_TERMS or not np.isfinite(choice.error)
            if choice.error <= ENOUGH or done:
                found = self._separation(choice)
                best = found if best is None or found.error < best.error else best
                if best.error <= SAFETY * ENOUGH or done:
                    return best
            wave = self._move_waves(self._with_wave(choice))
            parts = [self._with_part(choice, part) for part in self._unused_functions(choice)]
            part = min(parts, key=lambda each: each.error, default=wave)
            # Exact functions, some of which are elastic, before those of waves.
            choice = part if part.error < max(ENOUGH, wave.error) else wave

    def _functions(self, choice: _Choice) -> tuple[SeriesCompliance, ...]:
        return (*choice.materials, *(self._at_wave(index) for index in choice.waves))

    def _unused_functions(self, choice: _Choice) -> list[SeriesCompliance]:
        return [part for part in self._parts if part not in choice.materials]

    def _with_part(self, choice: _Choice, part: SeriesCompliance) -> _Choice:
        return self._collocated(replace(choice, materials=(*choice.materials, part)))

    def _with_wave(self, choice: _Choice) -> _Choice:
        """Choice with the wave number of the largest error."""
        return self._collocated(replace(choice, waves=(*choice.waves, choice.worst)))

    def _move_waves(self, choice: _Choice) -> _Choice:
        """Choice with each wave number moved to a neighbour while the error falls."""
        for _ in range(ROUNDS):
            before = choice.error
            for place in range(len(choice.waves)):
                for moved in _neighbours(choice.waves, place, self._at_s.shape[1]):
                    tried = self._collocated(replace(choice, waves=moved))
                    choice = tried if tried.error < WORTHWHILE * choice.error else choice
            if choice.error == before:
                break
        return choice

    def _collocated(self, choice: _Choice) -> _Choice:
        """The choice with the best collocation points, and its error."""
        functions = self._functions(choice)
        at_s = _transforms(functions, self._s)
        basis, _ = np.linalg.qr(at_s * self._weights[:, None])
        points = scipy.linalg.qr(basis.T, mode="r", pivoting=True)[1][: len(functions)]
        weights = np.linalg.pinv(at_s[points], rcond=DEPENDENT)
        kernels = weights @ self._at_s[points]
        terms = at_s @ np.abs(kernels) / self._at_s
        summed = at_s @ np.abs(weights) @ self._at_s[points] / self._at_s
        harmonic = _transforms(functions, 1j * self._omega)
        error = np.abs(harmonic @ kernels / self._full - 1).max(axis=0)
        excess = max(1.0, terms.max() / MOST_CANCELLATION, summed.max() / MOST_ROUNDING)
        largest = float(error.max() * excess)
        error[list(choice.waves)] = 0.0  # those in use are not taken twice
        return replace(choice, points=tuple(points), error=largest, worst=int(error.argmax()))

    def _separation(self, choice: _Choice) -> Separation:
        """Terms of a choice, made passive, with their error on finer grids."""
        functions, s = self._functions(choice), self._s[list(choice.points)]
        weights = _inverse(_transforms(functions, s))
        (low, high), count = self._ends, self._omega.size
        # Long waves on a fluid creep at any low frequency: only what is looked at is known.
        lowest = low if self._stack.flows else low / WIDER
        harmonic = _transforms(functions, 1j * np.geomspace(lowest, high * WIDER, FINEST * count))
        weights += passive_share(harmonic, weights, self._waves(self._wide_q, s))
        omega = np.geomspace(low, high, FINER * count)
        q = np.geomspace(self._q[0], self._q[-1], FINER * WAVES)
        found = _transforms(functions, 1j * omega) @ weights @ self._waves(q, s)
        error = np.abs(found / self._waves(q, 1j * omega) - 1).max()
        stacks, tops = zip(*(self._stack.elastic(float(each)) for each in s), strict=True)
        rows = (weights * np.array(tops)).tolist()
        kernels = tuple(SummedResponse(tuple(stacks), tuple(row)) for row in rows)
        return Separation(functions, kernels, SAFETY * float(error), tuple(stacks))

    def _at_wave(self, index: int) -> SeriesCompliance:
        """Creep function of one wave number."""
        if index not in self._of_waves:
            stack, given = self._stack, (self._at_s[:, index], self._full[:, index])
            self._of_waves[index] = series_of_transform(
                self._s, self._omega, *given, stack.rates, flows=stack.flows
            )
        return self._of_waves[index]


def _inverse(matrix: Numbers) -> Numbers:
    """Inverse, of functions that are not independent the pseudo-inverse."""
    try:
        return np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(matrix, rcond=DEPENDENT))


def _transforms(functions: Sequence[SeriesCompliance], s: Numbers) -> Numbers:
    """b_m(s) = s L[J_m] of creep functions, shape (s, m) [1/Pa]."""
    return np.stack([transformed(each, s) for each in functions], axis=1)


def _neighbours(waves: tuple[int, ...], place: int, count: int) -> Iterator[tuple[int, ...]]:
    """Indices of wave numbers with one of them moved."""
    for step in MOVES:
        moved = waves[place] + step
        if 0 <= moved < count and moved not in waves:
            yield (*waves[:place], moved, *waves[place + 1 :])


def _of_parts(materials: Sequence[Material], s: Numbers) -> tuple[SeriesCompliance, ...]:
    """Creep functions of the materials, none proportional to another; that of the top first."""
    parts = [_contact_compliance(material) for material in materials]
    parts += [uniaxial_compression(each) for each in materials if each.bulk_modulus is not None]
    found: list[SeriesCompliance] = []
    for part in parts:
        if not any(_are_proportional(part, old, s) for old in found):
            found.append(part)
    return tuple(found)


def _contact_compliance(material: Material) -> SeriesCompliance:
    found = material.contact_compliance()
    assert isinstance(found, SeriesCompliance)  # as the law is a series
    return found


def _are_proportional(one: SeriesCompliance, other: SeriesCompliance, s: Numbers) -> bool:
    """True for two creep functions that are proportional to a few digits."""
    ratio = transformed(one, s) / transformed(other, s)
    return bool(ratio.max() < (1 + ALIKE) * ratio.min())
