"""Size of the contact in a run, from coarse elastic solves at the largest compliance and loads."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadHistory, LoadPoint
from viscontact.bodies.loads.largest_load import largest_load
from viscontact.bodies.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SurfaceResponse
from viscontact.simulation.meshing.contact_place import locate_contact
from viscontact.simulation.meshing.elastic_estimate import ContactEstimate

#: Upper limit on the cells of an automatic grid.
MAX_CELLS = 2**22

#: Most times of a history that are examined, and most loads that are solved for.
MAX_INSTANTS, MAX_CORNERS = 1000, 60

#: Loads of at least this part of the largest count as largest, where the force moves.
NEAR_LARGEST_LOAD = 0.9

#: Times at which a load is sampled up to its first maximum.
PEAK_LOAD_SAMPLES = 200


@dataclass(frozen=True, eq=False)
class PointContact:
    """Contact under one load of a history."""

    point: LoadPoint
    compliance: float  # of the elastic body [1/Pa]
    estimate: ContactEstimate
    response: SurfaceResponse = HALF_SPACE


def contacts_of_history(
    indenter: Indenter,
    compliance: float,
    load: LoadHistory,
    end: float | None,
    *,
    response: SurfaceResponse = HALF_SPACE,
) -> list[PointContact]:
    """Estimate the contact under every corner of a load up to `end` [s], at one J [1/Pa]."""
    points = _corners(load, end)
    if not points:
        raise ValueError(
            f"load: the {load.control} is never above zero, so no grid can be fitted to a contact; "
            "give a grid"
        )
    return [
        PointContact(
            point,
            compliance,
            locate_contact(indenter, compliance, point, response=response),
            response,
        )
        for point in points
    ]


def smallest_contact(
    indenter: Indenter,
    compliance: ContactCompliance,
    load: LoadHistory,
    end: float | None,
    found: Sequence[PointContact],
) -> PointContact:
    """Smallest contact under the largest load: one of `found`, or that before the body creeps."""
    highest = max(each.point.level for each in found)
    as_large = [each for each in found if each.point.level >= NEAR_LARGEST_LOAD * highest]
    smallest = min(as_large, key=lambda each: min(each.estimate.extents))
    if load.control == "approach":  # the compliance scales the pressure only
        return smallest
    stiffer = _compliance_at_largest_load(compliance, load, end)
    if not 0 < stiffer < smallest.compliance:
        return smallest
    response = smallest.response
    estimate = locate_contact(indenter, stiffer, smallest.point, response=response)
    return PointContact(smallest.point, stiffer, estimate, response)


def _compliance_at_largest_load(
    compliance: ContactCompliance, load: LoadHistory, end: float | None
) -> float:
    """Effective compliance when the load first reaches its maximum [1/Pa]."""
    # A contact that has only grown is that of an elastic body whose compliance is the mean of J
    # over the ages of the load's increments.
    peak_time, _ = largest_load(load, float(load.kinks[-1]) if end is None else end)
    instants = np.union1d(
        np.linspace(0.0, peak_time, PEAK_LOAD_SAMPLES), load.kinks[load.kinks <= peak_time]
    )
    sides = [load.level_at(instants, side=side) for side in ("left", "right")]
    levels = np.maximum.accumulate(np.stack(sides, axis=1).ravel()).reshape(-1, 2)
    levels = np.maximum(levels, 0.0)
    # A jump is as old as its time; a rise between two times is weighted by the mean of J over its
    # ages.
    jumps = np.append(levels[0, 1], np.diff(levels, axis=1)[1:, 0])
    rises = levels[1:, 0] - levels[:-1, 1]
    creep = float(jumps @ compliance.since(instants, peak_time))
    creep += float(rises @ compliance.mean_since(instants[:-1], instants[1:], peak_time))
    return creep / float(levels[-1, 1])


def _corners(load: LoadHistory, end: float | None) -> list[LoadPoint]:
    """Distinct loads at the points of a history, and between them, where the force may move."""
    corners = load.kinks if end is None else np.append(load.kinks[load.kinks < end], end)
    within = [corners[:-1] + part * np.diff(corners) for part in (0.25, 0.5, 0.75)]
    peak_time, _ = largest_load(load, float(corners[-1]))
    instants = _representative_times(
        np.unique(np.concatenate([corners, *within, [peak_time]])), load
    ).tolist()
    points = [load.at(time, side=side) for time in instants for side in ("left", "right")]
    return _outermost(list(dict.fromkeys(point for point in points if point.level > 0)))


def _representative_times(instants: Floats, load: LoadHistory) -> Floats:
    """Times of the largest loads, and evenly chosen ones, of a very long history [s]."""
    if instants.size <= 2 * MAX_INSTANTS:
        return instants
    levels = np.maximum(load.level_at(instants, side="left"), load.level_at(instants))
    highest = np.argsort(-levels, kind="stable")[:MAX_INSTANTS]
    spread = np.linspace(0, instants.size - 1, MAX_INSTANTS).astype(int)
    return np.asarray(instants[np.union1d(highest, spread)])


def _outermost(points: list[LoadPoint]) -> list[LoadPoint]:
    """The largest loads of very many, and those that act or tilt farthest each way."""
    if len(points) <= MAX_CORNERS:
        return points
    ways = ("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")
    extremes = [max(points, key=lambda point: point.level)]
    for way in ways:
        extremes += _farthest(points, way)
    highest = sorted(points, key=lambda point: point.level, reverse=True)[: MAX_CORNERS // 2]
    return list(dict.fromkeys([*extremes, *highest]))


def _farthest(points: list[LoadPoint], way: str) -> list[LoadPoint]:
    """The loads that act or tilt farthest one way and the other."""

    def position(point: LoadPoint) -> tuple[float, float]:
        return getattr(point, way) or 0.0, point.level

    return [min(points, key=position), max(points, key=position)]


def largest_compliance(compliance: ContactCompliance, end: float | None) -> float:
    """Contact compliance at the end of a run [s], or of all creep if None [1/Pa]."""
    if end is not None:
        return float(compliance(end))
    latest = compliance.settled_after
    law = compliance.over_reduced_time
    if math.isinf(latest) or (isinstance(law, SeriesCompliance) and law.fluidity > 0):
        raise ValueError(
            "end: the law does not say when its creep is over (or flows without end); give end=, "
            "when the run ends, in s"
        )
    if isinstance(law, SeriesCompliance):
        return law.instant + float(np.sum(law.amplitudes))
    return float(compliance(latest))
