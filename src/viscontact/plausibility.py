"""Doubts about a result: what a careful reader would ask before believing a number."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from viscontact.indenters import Indenter
from viscontact.rim import Rim

#: Fewer cells across the largest contact than this are doubtful, or refused.
DOUBTFUL_CELLS, REFUSED_CELLS = 10, 4

#: Small-strain theory is doubtful beyond these: slope, contact half width / R, approach / R.
STEEP_SLOPE, WIDE_CONTACT, DEEP_APPROACH = 0.3, 0.3, 0.1

#: Relative change of force or peak pressure that a step long against the law must not hide.
NOTABLE_CHANGE = 0.25


@dataclass(frozen=True)
class Geometry:
    """What the doubts about geometry need to know.

    Attributes
    ----------
    indenter : Indenter
        The shape; its radius of curvature is the measure of depth and width.
    open_gap : ndarray, shape (nx, ny)
        Initial gap [m], +inf outside the outline.
    cell_size : tuple of float
        Edge lengths of a cell [m].
    """

    indenter: Indenter
    open_gap: NDArray[np.float64]
    cell_size: tuple[float, float]


def geometry_doubts(geometry: Geometry, rim: Rim, motion: NDArray[np.float64]) -> dict[str, str]:
    """Doubts about small strains and about where the body ends.

    Parameters
    ----------
    geometry : Geometry
        The undeformed shape on its grid.
    rim : Rim
        The contact and its extents.
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad].

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.
    """
    doubts: dict[str, str] = {}
    open_gap, half_width = geometry.open_gap[rim.rows, rim.columns], min(rim.length, rim.width) / 2
    slope = _steepest_slope(open_gap, rim.contact, motion, geometry.cell_size)
    if slope > STEEP_SLOPE:
        doubts["slope"] = (
            f"the indenter's slope within the contact reaches {slope:.2g}; "
            f"small-strain half-space theory is meant for slopes below {STEEP_SLOPE:g}"
        )
    radius = geometry.indenter.radius_of_curvature
    if half_width > WIDE_CONTACT * radius:
        doubts["width"] = (
            f"the contact's half width is {half_width / radius:.2g} of the indenter's radius of "
            f"curvature; half-space theory is meant for less than {WIDE_CONTACT:g}"
        )
    if motion[0] > DEEP_APPROACH * radius:
        doubts["approach"] = (
            f"the approach is {motion[0] / radius:.2g} of the indenter's radius of curvature; "
            f"small-strain theory is meant for less than {DEEP_APPROACH:g}"
        )
    if _touches_end(open_gap, rim.contact):
        doubts["end"] = (
            "the contact reaches the end of the indenter's profile: pressure is singular there "
            "and the peak pressure depends on the mesh"
        )
    return doubts


def step_doubts(duration: float, change: float) -> dict[str, str]:
    """Doubt about a time step too long for the law while the load or the pressure changes.

    Parameters
    ----------
    duration : float
        Length of such a step [s].
    change : float
        Largest relative change of force and peak pressure over it.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(step_doubts(10.0, change=0.5)), list(step_doubts(10.0, change=0.01))
    (['step'], [])
    """
    if change < NOTABLE_CHANGE:
        return {}
    return {
        "step": (
            f"a time step of {duration:.3g} s is long against the law's relaxation times while "
            f"force or peak pressure change by {change:.0%}; use more steps there"
        )
    }


def touch_doubts(duration: float, share: float) -> dict[str, str]:
    """Doubt about a load that grows from nothing in one step of a creeping body.

    The contact grows with a root of the force, which a straight line through one step follows
    badly: the pressure after it is off by a few per cent.

    Parameters
    ----------
    duration : float
        Length of the step [s].
    share : float
        Force at its end, over the largest of the history.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(touch_doubts(0.1, share=1.0)), list(touch_doubts(0.1, share=0.1))
    (['touch'], [])
    """
    if share <= NOTABLE_CHANGE:
        return {}
    return {
        "touch": (
            f"the load grows from nothing to {share:.0%} of its largest in a single step of "
            f"{duration:.3g} s; use several steps there, as the pressure starts with a root of time"
        )
    }


def relative_change(before: float, after: float) -> float:
    """Change over the larger of two values; zero if both are."""
    return abs(after - before) / max(abs(after), abs(before), np.finfo(float).tiny)


def mesh_doubts(cells_across: int) -> dict[str, str]:
    """Doubt about a coarse mesh.

    Parameters
    ----------
    cells_across : int
        Cells across the run's largest contact, along its shorter way.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(mesh_doubts(8)), list(mesh_doubts(30))
    (['mesh'], [])
    """
    if cells_across >= DOUBTFUL_CELLS:
        return {}
    return {
        "mesh": (
            f"only {cells_across} cells lie across the largest contact, "
            f"{DOUBTFUL_CELLS} or more are wanted; use a finer or smaller grid"
        )
    }


@dataclass
class Doubts:
    """Each kind of doubt once: what has been said already, and what is new."""

    said: dict[str, str] = field(default_factory=dict)

    def new(self, *found: dict[str, str]) -> tuple[str, ...]:
        """Keep what has not been said, and return it.

        Parameters
        ----------
        *found : dict of str to str
            Sentences by kind of doubt.

        Returns
        -------
        tuple of str
            The sentences of kinds met for the first time.
        """
        fresh = {
            kind: text for doubts in found for kind, text in doubts.items() if kind not in self.said
        }
        self.said.update(fresh)
        return tuple(fresh.values())


def _steepest_slope(
    open_gap: NDArray[np.float64],
    contact: NDArray[np.bool_],
    motion: NDArray[np.float64],
    cell_size: tuple[float, float],
) -> float:
    steepest = 0.0
    for axis in (0, 1):
        shape = np.moveaxis(open_gap, axis, 0)
        touched = np.moveaxis(contact, axis, 0)
        pairs = touched[1:] & touched[:-1]
        slope = (shape[1:][pairs] - shape[:-1][pairs]) / cell_size[axis]
        steepest = max(steepest, float(np.abs(slope - motion[1 + axis]).max(initial=0.0)))
    return steepest


def _touches_end(open_gap: NDArray[np.float64], contact: NDArray[np.bool_]) -> bool:
    outside = np.isinf(open_gap)
    return bool(
        (contact[1:] & outside[:-1]).any()
        or (contact[:-1] & outside[1:]).any()
        or (contact[:, 1:] & outside[:, :-1]).any()
        or (contact[:, :-1] & outside[:, 1:]).any()
    )
