"""How large a contact becomes in a run: coarse solves at the largest compliance and load."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.indenters import Indenter
from viscontact.loads import LoadHistory, LoadPoint
from viscontact.loads.largest_load import largest_load
from viscontact.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.meshing.elastic_estimate import ContactEstimate, estimate_contact

#: More cells than these are no choice to make for somebody.
MAX_CELLS = 2**22

#: Of a history of more points only so many are looked at, and so many are solved for.
MAX_INSTANTS, MAX_CORNERS = 1000, 60

#: Loads of at least this part of the largest are as good as it, where the force moves.
NEAR_LARGEST_LOAD = 0.9

#: Instants between which a load is followed to its crest.
PEAK_LOAD_SAMPLES = 200


@dataclass(frozen=True, eq=False)
class PointContact:
    """The contact under one load of a history.

    Attributes
    ----------
    point : LoadPoint
        The load.
    compliance : float
        Compliance of the elastic body that it presses [1/Pa].
    estimate : ContactEstimate
        The contact, coarsely.
    """

    point: LoadPoint
    compliance: float
    estimate: ContactEstimate


def contacts_of_history(
    indenter: Indenter, compliance: float, load: LoadHistory, end: float | None
) -> list[PointContact]:
    """Estimate the contact under every corner of a load's history.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    compliance : float
        The largest contact compliance of the run [1/Pa].
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    end : float or None
        Last instant of the run [s]; the load's last point when None.

    Returns
    -------
    list of PointContact
        One or more.

    Raises
    ------
    ValueError
        If nothing ever presses, or no grid fits a contact.
    """
    points = _corners(load, end)
    if not points:
        raise ValueError(
            f"load: the {load.control} is never above zero, so no grid can be fitted to a contact; "
            "give a grid"
        )
    return [
        PointContact(point, compliance, estimate_contact(indenter, compliance, point))
        for point in points
    ]


def smallest_contact(
    indenter: Indenter,
    compliance: ContactCompliance,
    load: LoadHistory,
    end: float | None,
    found: Sequence[PointContact],
) -> PointContact:
    """Return the smallest contact under the largest load: where that acts, and before it creeps.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    compliance : ContactCompliance
        J(t) of both bodies together.
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    end : float or None
        Last instant of the run [s]; the load's last point when None.
    found : sequence of PointContact
        The run's contacts at the largest compliance.

    Returns
    -------
    PointContact
        One of those, or one of a stiffer body.

    Raises
    ------
    ValueError
        If no grid fits that contact.
    """
    highest = max(each.point.level for each in found)
    as_large = [each for each in found if each.point.level >= NEAR_LARGEST_LOAD * highest]
    smallest = min(as_large, key=lambda each: min(each.estimate.extents))
    if load.control == "approach":  # where the compliance scales the pressure, and nothing else
        return smallest
    stiffer = _compliance_at_crest(compliance, load, end)
    if not 0 < stiffer < smallest.compliance:
        return smallest
    estimate = estimate_contact(indenter, stiffer, smallest.point)
    return PointContact(smallest.point, stiffer, estimate)


def _compliance_at_crest(
    compliance: ContactCompliance, load: LoadHistory, end: float | None
) -> float:
    """What has been seen of the compliance when the load is first largest [1/Pa].

    A contact that has only grown is that of an elastic body whose compliance is the mean over the
    ages of the load's parts.
    """
    crest, _ = largest_load(load, float(load.kinks[-1]) if end is None else end)
    instants = np.union1d(
        np.linspace(0.0, crest, PEAK_LOAD_SAMPLES), load.kinks[load.kinks <= crest]
    )
    sides = [load.level_at(instants, side=side) for side in ("left", "right")]
    levels = np.maximum.accumulate(np.stack(sides, axis=1).ravel()).reshape(-1, 2)
    levels = np.maximum(levels, 0.0)
    # What jumps to an instant's right is as old as the instant, what rose before it on average.
    jumps = np.append(levels[0, 1], np.diff(levels, axis=1)[1:, 0])
    ages = crest - instants
    rises = levels[1:, 0] - levels[:-1, 1]
    seen = float(jumps @ np.asarray(compliance(ages)))
    seen += float(rises @ np.asarray(compliance.mean(ages[1:], ages[:-1])))
    return seen / float(levels[-1, 1])


def _corners(load: LoadHistory, end: float | None) -> list[LoadPoint]:
    """Distinct loads at the history's points, and within its pieces: there the force may move."""
    corners = load.kinks if end is None else np.append(load.kinks[load.kinks < end], end)
    within = [corners[:-1] + part * np.diff(corners) for part in (0.25, 0.5, 0.75)]
    crest, _ = largest_load(load, float(corners[-1]))
    instants = _representative_times(
        np.unique(np.concatenate([corners, *within, [crest]])), load
    ).tolist()
    points = [load.at(time, side=side) for time in instants for side in ("left", "right")]
    return _outermost(list(dict.fromkeys(point for point in points if point.level > 0)))


def _representative_times(instants: NDArray[np.float64], load: LoadHistory) -> NDArray[np.float64]:
    """Of very many instants those of the largest load, and as many over the whole history."""
    if instants.size <= 2 * MAX_INSTANTS:
        return instants
    levels = np.maximum(load.level_at(instants, side="left"), load.level_at(instants))
    highest = np.argsort(-levels, kind="stable")[:MAX_INSTANTS]
    spread = np.linspace(0, instants.size - 1, MAX_INSTANTS).astype(int)
    return np.asarray(instants[np.union1d(highest, spread)])


def _outermost(points: list[LoadPoint]) -> list[LoadPoint]:
    """Of very many loads those that are largest, and that act or tilt farthest each way."""
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

    def reach(point: LoadPoint) -> tuple[float, float]:
        return getattr(point, way) or 0.0, point.level

    return [min(points, key=reach), max(points, key=reach)]


def largest_compliance(compliance: ContactCompliance, end: float | None) -> float:
    """Return the contact compliance at the end of a run.

    Parameters
    ----------
    compliance : ContactCompliance
        J(t) of both bodies together.
    end : float or None
        Last instant of the run [s]; the end of all creep when None.

    Returns
    -------
    float
        The compliance [1/Pa].

    Raises
    ------
    ValueError
        If creep never ends, and no end is given.
    """
    if end is not None:
        return float(compliance(end))
    latest = compliance.settled_after
    if math.isinf(latest) or (isinstance(compliance, SeriesCompliance) and compliance.fluidity > 0):
        raise ValueError(
            "end: the law does not say when its creep is over (or flows without end); give end=, "
            "when the run ends, in s"
        )
    if isinstance(compliance, SeriesCompliance):
        return compliance.instant + float(np.sum(compliance.amplitudes))
    return float(compliance(latest))
