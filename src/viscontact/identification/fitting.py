"""Results of the two fits of an indentation: of a force curve, and of a record."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.identification.candidates import Candidate
from viscontact.identification.curve_problem import CurveProblem
from viscontact.identification.estimation import Estimate, estimated
from viscontact.identification.fitted_contact import FittedContact
from viscontact.identification.indentation_fit import IndentationFit
from viscontact.identification.record import IndentationRecord
from viscontact.identification.record_problem import RecordProblem
from viscontact.identification.stroke import Stroke


def fitted_record(
    problem: RecordProblem, record: IndentationRecord, confidence: float
) -> IndentationFit:
    """Fit of a law to a record whose approach, or force, is exact."""
    problem, estimate = _estimated_record(problem)
    material = problem.law_of(estimate.free)
    return IndentationFit(
        material=material,
        record=record,
        given=problem.given,
        fitted=_padded(problem.exact(material), record, problem.record),
        until=float(problem.record.times[-1]),
        **_law_values(problem.shape, estimate, confidence),
    )


def _estimated_record(problem: RecordProblem) -> tuple[RecordProblem, Estimate]:
    """Estimate by the coarser solution if that leads there, else by the exact one alone."""
    if not problem.has_coarser:
        return problem, estimated(problem)
    exact = replace(problem, begins_coarse=False)
    try:
        coarse = estimated(problem)
        return (problem, coarse) if coarse.is_found else (exact, estimated(exact, coarse.free))
    except ValueError:  # it led to laws whose exact solution ends
        return exact, estimated(exact)


def fitted_curve(
    problem: CurveProblem, record: IndentationRecord, confidence: float
) -> IndentationFit:
    """Fit of law, contact point and baseline to a force curve."""
    problem = replace(problem, drag=problem.is_drawn_off)
    estimate = estimated(problem)
    if not problem.drag and problem.is_free_again(estimate.free):
        problem = replace(problem, drag=True)
        estimate = estimated(problem, estimate.free)
    contact = _fitted_contact(problem, estimate, confidence)
    force = problem.scale * problem.cantilever.spring_constant * problem.response(estimate.free, 2)
    return IndentationFit(
        material=problem.law_of(estimate.free),
        record=_corrected(problem, estimate, record),
        given="approach",
        fitted=_padded(force, record, problem.record),
        until=float(problem.record.times[-1]),
        contact=contact,
        **_law_values(problem.shape, estimate, confidence),
    )


def _padded(values: Floats, record: IndentationRecord, fitted: IndentationRecord) -> Floats:
    """Values of the fitted rows among all rows of a record, NaN in others."""
    begin = int(np.argmax(record.times >= fitted.times[0]))
    whole = np.full(record.times.size, np.nan)
    whole[begin : begin + values.size] = values
    return whole


def _law_values(shape: Candidate, estimate: Estimate, confidence: float) -> dict[str, Any]:
    """Parameters of the law with their intervals, correlation and units."""
    count = len(shape.names)
    found, errors = estimate.free[:count], estimate.errors[:count]
    reach = estimate.quantile(confidence) * errors
    low, high = shape.values(found - reach), shape.values(found + reach)
    covariance = estimate.covariance[:count, :count]
    tiny = np.finfo(np.float64).tiny
    intervals = zip(low.tolist(), high.tolist(), strict=True)
    return {
        "parameters": dict(zip(shape.names, shape.values(found).tolist(), strict=True)),
        "intervals": dict(zip(shape.names, intervals, strict=True)),
        "confidence": confidence,
        "correlation": covariance / np.maximum(np.outer(errors, errors), tiny),
        "units": shape.units,
        "widening": estimate.widening,
    }


def _fitted_contact(problem: CurveProblem, estimate: Estimate, confidence: float) -> FittedContact:
    """Contact point and baseline with their intervals."""
    t = estimate.quantile(confidence)
    law = len(problem.shape.names)
    position = problem.contact_of(estimate.free)
    reach = t * problem.depth * float(estimate.errors[law])
    values, errors = _baseline_terms(problem, estimate)
    return FittedContact(
        position=position,
        position_interval=(position - reach, position + reach),
        baseline=values,
        baseline_intervals={
            name: (value - t * errors[name], value + t * errors[name])
            for name, value in values.items()
        },
    )


def _baseline_terms(
    problem: CurveProblem, estimate: Estimate
) -> tuple[dict[str, float], dict[str, float]]:
    """Terms of the whole baseline, at position 0 and time 0, and their standard errors."""
    names = list(problem.columns)
    # The columns are centred: the offset at 0 is that of the rows less slope and drift to 0.
    lever = {"offset": 1.0, "slope": -float(problem.stroke.position.mean())}
    lever["drift"] = -float(problem.stroke.times.mean())
    turned = np.eye(len(names))
    turned[0] = [lever.get(name, 0.0) for name in names]
    start = len(problem.shape.names) + 1
    covariance = turned @ estimate.covariance[start:, start:] @ turned.T
    errors = problem.scale * np.sqrt(np.maximum(np.diag(covariance), 0.0))
    values = problem.scale * (turned @ estimate.terms)
    first = {"offset": problem.cantilever.offset, "slope": problem.cantilever.slope}
    total = {
        name: float(value) + first.get(name, 0.0) for name, value in zip(names, values, strict=True)
    }
    return total, dict(zip(names, errors.tolist(), strict=True))


def _corrected(
    problem: CurveProblem, estimate: Estimate, record: IndentationRecord
) -> IndentationRecord:
    """Record with the fitted contact point and baseline, with all rows."""
    k = problem.cantilever.spring_constant
    position = record.approach + record.force / k + problem.cantilever.contact
    stroke = Stroke(record.times, position)
    rows = {
        "offset": np.ones_like(position),
        "slope": position - problem.stroke.position.mean(),
        "drift": record.times - problem.stroke.times.mean(),
        "drag": stroke.rates,
    }
    terms = zip(problem.columns, estimate.terms, strict=True)
    line = problem.scale * sum(term * rows[name] for name, term in terms)
    bending = record.force / k - line
    contact = problem.contact_of(estimate.free)
    values, _ = _baseline_terms(problem, estimate)
    cantilever = replace(
        problem.cantilever, contact=contact, offset=values["offset"], slope=values["slope"]
    )
    approach = position - contact - bending
    return IndentationRecord(record.indenter, record.times, approach, k * bending, cantilever)
