"""Layers whose laws are Prony series, in place of layers of any laws."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from viscontact.laws import CreepSeries, Law, SeriesLaw
from viscontact.materials.compliance import SeriesCompliance
from viscontact.materials.layers import Layer, Layered
from viscontact.materials.material import Material
from viscontact.time_integration.prony_approximation import as_exponentials

#: Shortest and longest time of interest [s].
Span = tuple[float, float]

#: Times where those of a run are not known: 1 us to 30 years.
ANY_TIMES: Span = (1e-6, 1e9)

#: Shortest time of interest over the end of a run, and the longest one.
EARLY, LATE = 1e-6, 10.0

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
    return min(EARLY * end, float(steps[steps > 0].min(initial=np.inf))), LATE * end


def series_body(body: Layered, span: Span = ANY_TIMES) -> tuple[Layered, float]:
    """Replace laws that are no Prony series by series; return the largest deviation, too.

    The deviation is that of the creep compliance over its value, within the span. A series without
    an instant compliance, which is stiffer at first than whatever lies beneath, has one that it
    reaches before the span. Where nothing is replaced, the body itself is returned.

    Examples
    --------
    >>> from viscontact.laws import PowerLaw
    >>> rubber = Material(PowerLaw(1e-7, 0.3, 1.0, instant=1e-7), poisson_ratio=0.49)
    >>> found, deviation = series_body(Layered([Layer(1e-3, rubber)], base="rigid"))
    >>> type(found.layers[0].material.law).__name__, deviation < 1e-6
    ('CreepSeries', True)
    """
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
    if isinstance(law, SeriesLaw):
        series, deviation = SeriesCompliance(*law.creep_series().terms), 0.0
    else:
        # Of a Poisson's ratio of 0 the contact compliance is Phi itself.
        creep = Material(law, poisson_ratio=0.0).contact_compliance()
        series, deviation = as_exponentials(creep, first, last)
    instant, amplitudes, times = series.instant, series.amplitudes, series.times
    if instant == 0:
        early = times < first
        instant = float(amplitudes[early].sum())
        amplitudes, times = amplitudes[~early], times[~early]
    flows = series.fluidity * last > NO_FLOW * series(last)
    fluidity = series.fluidity if flows else 0.0
    found = CreepSeries(instant, amplitudes.tolist(), times.tolist(), fluidity)
    return replace(material, law=found), deviation
