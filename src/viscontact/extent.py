"""How large a grid has to be: coarse elastic solves at the largest compliance and load."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from viscontact.compliance import ContactCompliance, SeriesCompliance
from viscontact.estimate import estimate_contact, level_of
from viscontact.grid import GRID_QUANTITIES, AutomaticGrid, Grid
from viscontact.indenters import Indenter
from viscontact.load import LoadHistory, LoadPoint
from viscontact.material import Material

#: More cells than these are no choice to make for somebody.
MOST_CELLS = 2**22

#: Of a history of more points only so many are looked at, and so many are solved for.
MOST_INSTANTS, MOST_CORNERS = 1000, 60

#: Room around the contact in the grid that is returned.
MARGIN = 1.3

#: A load that swings shows its crest within so many of its longest steps.
SWING_STEPS = 128


def auto_grid(
    indenter: Indenter,
    material: Material,
    load: LoadHistory,
    tolerance: float = 0.01,
    *,
    quantities: Sequence[str] = GRID_QUANTITIES,
    end: float | None = None,
    indenter_material: Material | None = None,
) -> Grid:
    """Choose a grid for a run.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    material : Material
        Material of the half-space.
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    tolerance : float
        Aimed-at relative error of the named quantities, between 1e-4 and 0.5 [-].
    quantities : sequence of str
        What has to be that exact, as in `AutomaticGrid`.
    end : float, optional
        Last instant of the run [s]; the load's last point, or the end of all creep, when left
        out.
    indenter_material : Material, optional
        Material of the indenter; rigid when left out.

    Returns
    -------
    Grid
        Holds the contact at the largest compliance under every corner of the load's history,
        with a margin. The number of cells is a rule of thumb, not yet an error estimate.

    Raises
    ------
    ValueError
        If the tolerance makes no sense, no end of the creep is known, or no grid fits.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> vc.auto_grid(vc.Sphere(0.01), rubber, vc.step(1.0)).shape
    (54, 54)
    """
    wish = AutomaticGrid(tolerance, quantities)
    _require_kinds(indenter, material, load, indenter_material)
    compliance = material.contact_compliance()
    if indenter_material is not None:
        compliance = compliance + indenter_material.contact_compliance()
    return choose_grid(indenter, compliance, load, wish, end)


def choose_grid(
    indenter: Indenter,
    compliance: ContactCompliance,
    load: LoadHistory,
    wish: AutomaticGrid,
    end: float | None,
) -> Grid:
    """Choose a grid for a run whose bodies' compliance is known; see `auto_grid`.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    compliance : ContactCompliance
        J(t) of both bodies together.
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    wish : AutomaticGrid
        What is asked of the grid.
    end : float or None
        Last instant of the run [s].

    Returns
    -------
    Grid
        As `auto_grid` does.

    Raises
    ------
    ValueError
        As `auto_grid` does.
    """
    largest = _largest_compliance(compliance, load, end)
    reach, extents = _reach_of_history(indenter, largest, load, end)
    size = 2 * MARGIN * reach
    # Cells across the contact, then over the grid: errors are at worst of second order.
    cells = (4 / math.sqrt(wish.tolerance)) * size / extents
    if not float(np.prod(cells)) <= MOST_CELLS:
        raise ValueError(
            f"grid: a contact of {extents[0]:.3g} m x {extents[1]:.3g} m within {size[0]:.3g} m x "
            f"{size[1]:.3g} m needs {float(np.prod(cells)):.2g} cells, more than an automatic grid "
            "has; give a grid"
        )
    shape = [max(16, fft.next_fast_len(math.ceil(count), real=True)) for count in cells]
    return Grid((shape[0], shape[1]), (float(size[0]), float(size[1])))


def _require_kinds(indenter: object, material: object, load: object, other: object) -> None:
    for name, value, kind in (
        ("indenter", indenter, Indenter),
        ("material", material, Material),
        ("load", load, LoadHistory),
        ("indenter_material", other, Material),
    ):
        if not isinstance(value, kind) and not (name == "indenter_material" and value is None):
            raise ValueError(f"{name} must be of kind {kind.__name__}, got {value!r}")


def _reach_of_history(
    indenter: Indenter, compliance: float, load: LoadHistory, end: float | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Farthest reach over the history, and the extents of the contact under the largest force."""
    points = _corners(load, end)
    if not points:
        raise ValueError(
            f"load: the {load.control} is never above zero, so no grid can be fitted to a contact; "
            "give a grid"
        )
    found = [estimate_contact(indenter, compliance, point) for point in points]
    reach = np.array([estimate.reach for estimate in found], dtype=np.float64).max(axis=0)
    largest = found[int(np.argmax([level_of(point) for point in points]))]
    return reach, np.array([largest.length, largest.width])


def _corners(load: LoadHistory, end: float | None) -> list[LoadPoint]:
    """Distinct loads at the history's points, and within its pieces: there the force may move."""
    corners = load.kinks if end is None else np.append(load.kinks[load.kinks < end], end)
    within = [corners[:-1] + part * np.diff(corners) for part in (0.25, 0.5, 0.75)]
    crest, _ = largest_load(load, float(corners[-1]))
    instants = _telling(np.unique(np.concatenate([corners, *within, [crest]])), load).tolist()
    points = [load.at(time, side=side) for time in instants for side in ("left", "right")]
    return _outermost(list(dict.fromkeys(point for point in points if level_of(point) > 0)))


def _telling(instants: NDArray[np.float64], load: LoadHistory) -> NDArray[np.float64]:
    """Of very many instants those of the largest load, and as many over the whole history."""
    if instants.size <= 2 * MOST_INSTANTS:
        return instants
    levels = np.maximum(load.level_at(instants, side="left"), load.level_at(instants))
    highest = np.argsort(-levels, kind="stable")[:MOST_INSTANTS]
    spread = np.linspace(0, instants.size - 1, MOST_INSTANTS).astype(int)
    return np.asarray(instants[np.union1d(highest, spread)])


def _outermost(points: list[LoadPoint]) -> list[LoadPoint]:
    """Of very many loads those that are largest, and that act or tilt farthest each way."""
    if len(points) <= MOST_CORNERS:
        return points
    ways = ("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")
    extremes = [max(points, key=level_of)]
    for way in ways:
        extremes += _farthest(points, way)
    highest = sorted(points, key=level_of, reverse=True)[: MOST_CORNERS // 2]
    return list(dict.fromkeys([*extremes, *highest]))


def _farthest(points: list[LoadPoint], way: str) -> list[LoadPoint]:
    """The loads that act or tilt farthest one way and the other."""

    def reach(point: LoadPoint) -> tuple[float, float]:
        return getattr(point, way) or 0.0, level_of(point)

    return [min(points, key=reach), max(points, key=reach)]


def _largest_compliance(
    compliance: ContactCompliance, load: LoadHistory, end: float | None
) -> float:
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


def largest_load(load: LoadHistory, end: float) -> tuple[float, LoadPoint]:
    """Return when a load is largest, and what it prescribes there.

    Parameters
    ----------
    load : LoadHistory
        The load.
    end : float
        Later instants do not count [s].

    Returns
    -------
    time : float
        One of its kinks, the end, or a step within its first swings [s].
    point : LoadPoint
        What is prescribed there, on the side of a jump where it is more.

    Examples
    --------
    >>> from viscontact.load import harmonic
    >>> largest_load(harmonic(mean=2.0, amplitude=1.0, period=4.0, cycles=4), end=16.0)[0]
    1.0
    """
    instants: list[float] = [*load.kinks[load.kinks <= end].tolist(), end]
    if math.isfinite(load.longest_step):
        steps = np.arange(1, SWING_STEPS + 1) * load.longest_step
        instants += steps[steps < end].tolist()
    levels = np.stack([load.level_at(instants, side=side) for side in ("left", "right")], axis=1)
    first, side = divmod(int(levels.argmax()), 2)
    return instants[first], load.at(instants[first], side=("left", "right")[side])
