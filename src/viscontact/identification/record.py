"""Indentation record: approach and force of a rigid indenter over time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.indenters import Cone, FlatPunch, Indenter, Sphere
from viscontact.bodies.series_fits.columns import columns_over_time
from viscontact.reference import ConeProfile, PunchProfile, SphereProfile
from viscontact.units.display import Displayable
from viscontact.units.numbers import real_array, store

_LEAST_ROWS = 5


@dataclass(frozen=True, eq=False)
class IndentationRecord(Displayable):
    """Approach and force of a rigid indenter over time, starting before first contact.

    Parameters
    ----------
    indenter : Sphere, Cone or FlatPunch
        The indenter; a punch must be round.
    times : array_like, shape (n,)
        Instants, never falling; a repeated one is a jump [s].
    approach : array_like, shape (n,)
        Approach, 0 at the first touch and negative before it [m].
    force : array_like, shape (n,)
        Force, positive in compression; scatter may make it negative near 0 [N].

    Raises
    ------
    ValueError
        If a value is not finite or a time falls, naming its row; if lengths differ; if there
        is no contact; if the indenter is another one.

    Examples
    --------
    >>> times = np.linspace(0.0, 1.0, 6)
    >>> record = IndentationRecord(FlatPunch(1e-3), times, 1e-6 * times, 2.0 * times)
    >>> float(record.force[-1])
    2.0
    """

    indenter: Indenter
    times: Floats
    approach: Floats
    force: Floats

    def __post_init__(self) -> None:
        columns = columns_over_time(
            "IndentationRecord",
            _LEAST_ROWS,
            times=(self.times, "s"),
            approach=(self.approach, "m"),
            force=(self.force, "N"),
        )
        if not (columns["approach"].max() > 0 and columns["force"].max() > 0):
            raise ValueError(
                "IndentationRecord: approach and force must be positive in some row, as they are "
                "when the bodies are pressed together"
            )
        store(self, **columns)
        _ = self.profile  # refuses other indenters

    @property
    def profile(self) -> SphereProfile | ConeProfile | PunchProfile:
        """Indenter profile of the exact solution."""
        return indenter_profile(self.indenter)

    def elastic_force(self, approach: Floats) -> Floats:
        """Return the force on an elastic body of contact modulus E* = 1 Pa [N].

        Parameters
        ----------
        approach : ndarray
            Approach >= 0 [m].

        Returns
        -------
        ndarray
            4/3 sqrt(R) d^1.5 (Hertz), 2/π tan(half angle) d² (Sneddon) or 2 a d (Boussinesq).
        """
        return elastic_force(self.indenter, real_array("approach", approach, "m"))


def indenter_profile(indenter: Indenter) -> SphereProfile | ConeProfile | PunchProfile:
    """Profile of the exact solution for an indenter; ValueError for others than three."""
    match indenter:
        case Sphere(radius=radius):
            return SphereProfile(radius)
        case Cone(half_angle=half_angle):
            return ConeProfile(half_angle)
        case FlatPunch(radius=radius) if radius is not None:
            return PunchProfile(radius)
    raise ValueError(
        "IndentationRecord.indenter: must be a Sphere, a Cone or a round FlatPunch(radius), "
        f"got {indenter!r}"
    )


def elastic_force(indenter: Indenter, approach: Floats) -> Floats:
    """Force on an elastic body of contact modulus 1 Pa under an approach >= 0 [N]."""
    match indenter_profile(indenter):
        case SphereProfile(radius=radius):
            return np.asarray(4 / 3 * math.sqrt(radius) * approach**1.5)
        case ConeProfile(half_angle=half_angle):
            return np.asarray(2 / math.pi * math.tan(half_angle) * approach**2)
        case PunchProfile(radius=radius):
            return np.asarray(2 * radius * approach)
