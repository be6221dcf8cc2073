"""Layers whose laws are Prony series, in place of layers of any laws."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from viscontact.bodies.laws import CreepSeries, Law, SeriesLaw
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.bodies.materials.layers import Layer, Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.time_integration.prony_approximation import (
    as_exponentials,
    deviation_between,
)

#: Shortest and longest time of interest [s].
Span = tuple[float, float]

#: Times where those of a run are not known: 1 us to 30 years.
ANY_TIMES: Span = (1e-6, 1e9)

#: Shortest time of interest over the end of a run, and the longest one.
EARLY, LATE = 1e-6, 10.0

#: Time by which a series without an instant compliance is ahead, over the shortest one of interest.
AHEAD = 0.1

#: Part of an amplitude that is left then below which the term is dropped.
NEGLIGIBLE = 1e-12

#: Shortest time of interest over the shortest step, at most: what is ahead by that is close then.
EARLIER = 0.01

#: Time over the end of a run before which steps are not resolved that well.
EARLIEST = 1e-8

#: Part of the creep at the longest time below which flow is rounding of the fit.
NO_FLOW = 1e-6


def span_of(instants: ArrayLike) -> Span:
    """Times of interest in a run with states at these instants, in ascending order [s].

    >>> span_of([0.0, 0.5, 4.0])
    (4e-06, 40.0)
    """
    times = np.asarray(instants, dtype=float)
    steps, end = np.diff(times), float(times[-1])
    if end <= 0:
        return ANY_TIMES
    shortest = float(steps[steps > 0].min(initial=np.inf))
    # Still shorter steps are those of adaptive runs at the beginning of a ramp.
    return min(EARLY * end, max(EARLIER * shortest, min(shortest, EARLIEST * end))), LATE * end


def series_body(body: Layered, span: Span = ANY_TIMES) -> tuple[Layered, float]:
    """Replace laws that are no Prony series; return the largest relative deviation, too."""
    if all(is_series(material.law) for material in body.materials):
        return body, 0.0
    known: dict[Material, tuple[Material, float]] = {}
    for material in body.materials:
        if material not in known:
            known[material] = _series_material(material, span)
    layers = [Layer(layer.thickness, known[layer.material][0]) for layer in body.layers]
    base = body.base if isinstance(body.base, str) else known[body.base][0]
    deviation = max(deviation for _, deviation in known.values())
    return Layered(layers, base, bonded=body.bonded), deviation


def is_series(law: Law) -> bool:
    """True for a Prony series with an instant compliance, which is used as it is."""
    return isinstance(law, SeriesLaw) and law(0.0) > 0


def _series_material(material: Material, span: Span) -> tuple[Material, float]:
    """The material with a law that is a series, and the deviation of its creep compliance."""
    law, (first, last) = material.law, span
    if is_series(law):
        return material, 0.0
    # Of a Poisson's ratio of 0 the contact compliance is Phi itself.
    creep = Material(law, poisson_ratio=0.0).contact_compliance()
    if isinstance(law, SeriesLaw):
        series, deviation = SeriesCompliance(*law.creep_series().terms), 0.0
    else:
        series, deviation = as_exponentials(creep, first, last)
    if series.instant == 0:
        series = _after(series, AHEAD * first)
        deviation = deviation_between(creep, series, first / EARLIER, last)
    flows = series.fluidity * last > NO_FLOW * series(last)
    found = CreepSeries(
        series.instant,
        series.amplitudes.tolist(),
        series.times.tolist(),
        series.fluidity if flows else 0.0,
    )
    return replace(material, law=found), deviation


def _after(series: SeriesCompliance, time: float) -> SeriesCompliance:
    """The series J(t + time), which has an instant compliance [s]."""
    left = series.amplitudes * np.exp(-time / series.times)
    lasting = left > NEGLIGIBLE * series.amplitudes
    return SeriesCompliance(series(time), left[lasting], series.times[lasting], series.fluidity)
