"""Doubts about a result: what a careful reader would ask before believing a number."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from viscontact.readable import in_words

#: Fewer cells across the largest contact than this are doubtful, or refused.
DOUBTFUL_CELLS, REFUSED_CELLS = 10, 4

#: Fewer cells across the spots that a contact consists of, in the mean, are doubtful. Counted
#: along grid lines, where a disc of d cells has a mean chord of pi/4 d: 4 are a disc of 5 cells.
DOUBTFUL_SPOTS = 4.0

#: The largest pressure may exceed the largest that is told by this part.
UNTOLD = 0.1

#: Relative change of force or peak pressure that a step long against the law must not hide.
NOTABLE_CHANGE = 0.25


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
            f"a time step of {in_words(duration, 's', 3)} is long against the law's relaxation "
            f"times while force or peak pressure change by {change:.0%}; use more steps there"
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
            f"{in_words(duration, 's', 3)}; use several steps there, as the pressure starts with a "
            "root of time"
        )
    }


def release_doubts(duration: float, share: float) -> dict[str, str]:
    """Doubt about a contact of a creeping body that is lost in one step, as the load falls.

    The contact shrinks over it, and a straight line through one step gives the rim, which was left
    early, a load for too long: the dent that stays is off by up to a third.

    Parameters
    ----------
    duration : float
        Length of the step [s].
    share : float
        How far force or approach falls over it, over the largest of the history.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(release_doubts(0.1, share=1.0)), list(release_doubts(0.1, share=0.1))
    (['release'], [])
    """
    if share <= NOTABLE_CHANGE:
        return {}
    return {
        "release": (
            f"the contact is lost as the load falls by {share:.0%} of its largest in a single step "
            f"of {in_words(duration, 's', 3)}; use several steps there, as the dent that stays "
            "depends on them"
        )
    }


def untold_doubts(peak: float, time: float, told: float) -> dict[str, str]:
    """Doubt about instants between which more has happened than at them.

    Parameters
    ----------
    peak : float
        Largest pressure over all steps [Pa].
    time : float
        When it was [s].
    told : float
        Largest pressure over the instants that were asked for [Pa].

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(untold_doubts(2e6, 0.3, told=1e6)), list(untold_doubts(1e6, 0.3, told=1e6))
    (['untold'], [])
    """
    if peak <= (1 + UNTOLD) * told:
        return {}
    return {
        "untold": (
            f"between the instants asked for the peak pressure reaches {in_words(peak, 'Pa')}, at "
            f"t = {in_words(time, 's', 6)}, and {in_words(told, 'Pa')} is the largest that the "
            "result tells; ask for an instant there, or for more steps"
        )
    }


def relative_change(before: float, after: float) -> float:
    """Change over the larger of two values; zero if both are."""
    return abs(after - before) / max(abs(after), abs(before), np.finfo(float).tiny)


def mesh_doubts(cells_across: int, across_spots: float = math.inf) -> dict[str, str]:
    """Doubt about a coarse mesh.

    Parameters
    ----------
    cells_across : int
        Cells across the run's largest contact, along its shorter way.
    across_spots : float
        Cells across the spots that it consists of, from `cells_across_spots`.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(mesh_doubts(8)), list(mesh_doubts(30)), list(mesh_doubts(30, across_spots=1.5))
    (['mesh'], [], ['spots'])
    """
    if cells_across < DOUBTFUL_CELLS:
        return {
            "mesh": (
                f"only {cells_across} cells lie across the largest contact, "
                f"{DOUBTFUL_CELLS} or more are wanted; use a finer or smaller grid"
            )
        }
    if across_spots >= DOUBTFUL_SPOTS:
        return {}
    return {
        "spots": (
            f"the largest contact consists of spots or strips that are {across_spots:.1f} cells "
            f"across in the mean, {DOUBTFUL_SPOTS:g} or more are wanted: their pressure and area "
            "depend on the mesh; use a finer grid"
        )
    }


def cells_across_spots(contact: NDArray[np.bool_], *, periodic: bool = False) -> float:
    """Mean number of cells in a row within a contact, along the axis where it is smaller.

    Parameters
    ----------
    contact : ndarray of bool, shape (nx, ny)
        Cells under pressure.
    periodic : bool
        Whether rows and columns go on where they began.

    Returns
    -------
    float
        Cells; 0 without contact, as many as a row or column has where no contact ends.

    Notes
    -----
    The mean chord. It sees what the extents of a contact hide: a rough surface's spots, or a
    strip that lies askew on the grid.

    Examples
    --------
    >>> spots = np.zeros((8, 8), dtype=bool)
    >>> spots[1:3, 1:6] = spots[5:7, 1:6] = True
    >>> cells_across_spots(spots)
    2.0
    """
    cells = int(np.count_nonzero(contact))
    if not cells:
        return 0.0
    begun = []
    for lines in (contact, contact.T):
        before = lines[-1:] if periodic else np.zeros_like(lines[:1])
        begun.append(int(np.count_nonzero(lines & ~np.concatenate([before, lines[:-1]]))))
    return cells / max(begun) if any(begun) else float(max(contact.shape))


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
