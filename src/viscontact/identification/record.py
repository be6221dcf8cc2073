"""Indentation record: approach and force of a rigid indenter over time."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.series_fits.columns import columns_over_time
from viscontact.identification.elastic_indentation import elastic_indentation, indenter_profile
from viscontact.reference import ConeProfile, PunchProfile, SphereProfile
from viscontact.units.display import Displayable
from viscontact.units.numbers import real_array, store

_LEAST_ROWS = 5


@dataclass(frozen=True)
class Cantilever:
    """Cantilever and baseline with which approach and force of a force curve were calculated.

    Parameters
    ----------
    spring_constant : float
        Spring constant [N/m].
    contact : float
        Position of the base at first contact [m].
    offset, slope : float
        Baseline: deflection without contact at position 0 [m], and its slope [-].

    Examples
    --------
    >>> Cantilever(0.1, contact=2e-6, offset=0.0, slope=0.001).spring_constant
    0.1
    """

    spring_constant: float
    contact: float
    offset: float
    slope: float


@dataclass(frozen=True, eq=False)
class IndentationRecord(Displayable):
    """Approach and force of a rigid indenter over time, starting before first contact.

    Parameters
    ----------
    indenter : Sphere, Cone, Pyramid or FlatPunch
        The indenter; a punch must be round, a pyramid has three or four faces. A Paraboloid with
        two equal radii is taken for the Sphere, which here is the paraboloid of its radius.
    times : array_like, shape (n,)
        Instants, never falling; a repeated one is a jump [s].
    approach : array_like, shape (n,)
        Approach, 0 at the first touch and negative before it [m].
    force : array_like, shape (n,)
        Force, positive in compression; scatter may make it negative near 0 [N].
    cantilever : Cantilever, optional
        Given by `ContactPoint.record`: the record is a force curve, whose contact point and
        baseline a fit takes as unknown.

    Raises
    ------
    ValueError
        If a value is not finite or a time falls, naming its row; if lengths differ; if there
        is no contact; if the indenter is another one.

    Examples
    --------
    >>> from viscontact.bodies.indenters import FlatPunch
    >>> times = np.linspace(0.0, 1.0, 6)
    >>> record = IndentationRecord(FlatPunch(1e-3), times, 1e-6 * times, 2.0 * times)
    >>> float(record.force[-1])
    2.0
    """

    indenter: Indenter
    times: Floats
    approach: Floats
    force: Floats
    cantilever: Cantilever | None = None

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
        """Indenter profile of the exact solution; of a pyramid the cone of equal force."""
        return indenter_profile(self.indenter)

    def first(self, rows: int) -> IndentationRecord:
        """Return the record up to a number of rows."""
        columns = (self.times[:rows], self.approach[:rows], self.force[:rows])
        return IndentationRecord(self.indenter, *columns, self.cantilever)

    def near_contact(self) -> IndentationRecord:
        """Return the record of a force curve from 3 rows before contact on; others unchanged."""
        if self.cantilever is None:
            return self
        begin = max(int(np.argmax(self.approach > 0)) - 3, 0)
        columns = (self.times[begin:], self.approach[begin:], self.force[begin:])
        return IndentationRecord(self.indenter, *columns, self.cantilever)

    def elastic_force(self, approach: Floats) -> Floats:
        """Return the force on an elastic body of contact modulus E* = 1 Pa [N].

        Parameters
        ----------
        approach : ndarray
            Approach >= 0 [m].

        Returns
        -------
        ndarray
            4/3 sqrt(R) d^1.5 (Hertz), 2/π tan(half angle) d² (Sneddon), 2 a d (Boussinesq), and
            0.8824 or 0.7376 tan(half angle) d² of a pyramid with three or four faces.
        """
        return elastic_indentation(self.indenter).force(real_array("approach", approach, "m"))
