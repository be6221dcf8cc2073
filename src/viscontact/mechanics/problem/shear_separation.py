"""Separation of the response of creeping layers to shear, as that to pressure (`separation`).

The compliances of waves of traction along and across their wave vector are those of two kinds of
waves of one sum. The displacement into the layers has the same creep functions and collocation
points; it is not positive, and its error counts against the root of the product of the compliances
that it couples.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from viscontact.backend.arrays import Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.bodies.materials.layers import Layered
from viscontact.mechanics.halfspace.layered_shear import LayeredShear
from viscontact.mechanics.problem.creeping_stack import CreepingStack, transformed
from viscontact.mechanics.problem.separation import (
    LONG,
    MARGIN,
    SAFETY,
    SHORT,
    Collocation,
    Separation,
    with_laws,
)
from viscontact.mechanics.problem.series_body import ANY_TIMES, Span, series_body

#: Wave numbers and frequencies at which the error of the coupling is measured.
WAVES, FREQUENCIES = 100, 60


@dataclass(frozen=True, eq=False)
class ShearSeparation:
    """Terms of layers under shear, and a bound of the relative error of their sum [-]."""

    compliances: tuple[ContactCompliance, ...]
    responses: tuple[LayeredShear, ...]
    error: float


@lru_cache(maxsize=16)
def separate_shear(body: Layered, span: Span = ANY_TIMES) -> ShearSeparation:
    """Terms of the response of layers to shear over times of interest [s]; ValueError if none."""
    series, deviation = series_body(body, span)
    found = Collocation(series, _in_plane).best()
    responses = tuple(LayeredShear(found.stacks, each.weights) for each in found.responses)
    error = max(found.error, _coupling_error(series, found, responses))
    given = with_laws(found, body, series, deviation)
    return ShearSeparation(given.compliances, responses, error + given.error - found.error)


def _in_plane(stack: CreepingStack, q: Numbers, s: Numbers) -> Numbers:
    """Compliances of waves along their wave vector, then across."""
    return np.concatenate(stack.shear(q, s)[:2], axis=1)


def _coupling_error(body: Layered, found: Separation, responses: tuple[LayeredShear, ...]) -> float:
    """Bound of the error of the displacement into the layers [-]."""
    stack, thinnest = CreepingStack(body), min(layer.thickness for layer in body.layers)
    slow, fast = stack.rates
    q = np.geomspace(LONG / body.thickness, SHORT / thinnest, WAVES)
    s = 1j * np.geomspace(slow / MARGIN, fast * MARGIN, FREQUENCIES)
    series = [each for each in found.compliances if isinstance(each, SeriesCompliance)]
    creep = np.stack([transformed(each, s) for each in series], axis=1)
    summed = creep @ np.array([each.ratios(q).coupling for each in responses])
    exact = stack.shear(q, s)
    size = np.sqrt(np.abs(exact.along * stack.compliance(q, s)))
    return SAFETY * float((np.abs(summed - exact.coupling) / size).max())
