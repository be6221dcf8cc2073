"""Fit of a force curve: law, contact point and baseline at once."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.material import Material
from viscontact.identification.candidates import Candidate
from viscontact.identification.elastic_indentation import ElasticIndentation
from viscontact.identification.monotone_curve import monotone_curve
from viscontact.identification.record import Cantilever, IndentationRecord
from viscontact.identification.stroke import Stroke
from viscontact.identification.tip_contact import PressedTip
from viscontact.reference.lag_means import lag_mean

_OWN = 0.01  # part of a column that the columns before it do not contain; less is not determined
_LEAST_FREE = 10  # rows without contact after the retraction that determine a drag
_FREE = 1e-9  # of the largest bending: without contact


@dataclass(frozen=True, eq=False)
class CurveProblem:
    """Deflection of the cantilever, in rows, as a law, a contact point and a baseline give it.

    The position of the base is taken as exact and the deflection as measured, so that the noise of
    the deflection acts on nothing else: not on the indentation, as it does where bending is
    subtracted. The baseline is linear: offset, slope over the position, drift over time, and drag
    over the velocity. Its best values for each law and contact point are eliminated by projection
    (Golub and Pereyra 1973).
    """

    record: IndentationRecord
    stroke: Stroke
    shape: Candidate
    material: Callable[..., Material]
    elastic: ElasticIndentation
    drag: bool = False

    @cached_property
    def cantilever(self) -> Cantilever:
        """Cantilever and first estimates of contact point and baseline."""
        given = self.record.cantilever
        if given is None:
            raise TypeError("CurveProblem: the record has no cantilever")
        return given

    @cached_property
    def deflection(self) -> Floats:
        """Measured deflection less the first estimate of the baseline [m]."""
        return self.record.force / self.cantilever.spring_constant

    @cached_property
    def scale(self) -> float:
        """Largest bending [m]."""
        return float(self.deflection.max())

    @cached_property
    def depth(self) -> float:
        """Largest indentation, the unit of the contact point [m]."""
        return max(float(self.record.approach.max()), 1e-3 * self.scale)

    @cached_property
    def columns(self) -> dict[str, Floats]:
        """Terms of the baseline that the rows can tell apart, by their names."""
        z, t = self.stroke.position, self.stroke.times
        offered = {"offset": np.ones_like(z), "slope": z - z.mean(), "drift": t - t.mean()}
        if self.drag:
            offered["drag"] = self.stroke.rates
        # While the contact is loaded, the bending itself is what the position differs by from one
        # that rises evenly: slope and drift are not told apart there.
        rows = (self.record.approach < 0) | (np.arange(z.size) > self.stroke.loading_end)
        kept: list[str] = []
        for name, column in offered.items():
            before = np.stack([offered[each][rows] for each in kept] or [0 * t[rows]], axis=1)
            size = np.abs(before).max(axis=0, initial=1e-300)
            own = column[rows] - before / size @ np.linalg.lstsq(before / size, column[rows])[0]
            if np.linalg.norm(own) > _OWN * np.linalg.norm(column[rows]) > 0:
                kept.append(name)
        return {name: offered[name] for name in kept}

    @cached_property
    def baseline(self) -> Floats:
        """Columns of the baseline, shape (rows, terms)."""
        return np.stack(list(self.columns.values()), axis=1)

    @cached_property
    def measured(self) -> Floats:
        """Deflection over the largest bending [-]."""
        return self.deflection / self.scale

    @property
    def unseen(self) -> Floats:
        """Drift that the curve cannot tell from the slope, up to all of the slope [-]."""
        z, t = self.stroke.position, self.stroke.times
        end = self.stroke.loading_end
        if "drift" in self.columns or t[end] == t[0]:
            return np.zeros_like(t)
        rate = (z[end] - z[0]) / (t[end] - t[0])
        return np.asarray(self.cantilever.slope * rate * (t - t.mean()) / self.scale)

    @property
    def starts(self) -> list[Floats]:
        """Starting values: those of the law, and the first estimate of the contact point."""
        return [np.append(self.shape.free(np.array(start)), 0.0) for start in self.shape.starts]

    @property
    def reach(self) -> Floats:
        """Largest change of each unknown besides those of the law: the contact point."""
        return np.ones(1)

    def law_of(self, free: Floats) -> Material:
        """Material of unknowns."""
        return self.material(self.shape.build(*self.shape.values(free[:-1]).tolist()))

    def contact_of(self, free: Floats) -> float:
        """Position at first contact of unknowns [m]."""
        return self.cantilever.contact + self.depth * float(free[-1])

    def response(self, free: Floats, finer: int = 1) -> Floats:
        """Bending of each row over the largest one [-]."""
        contact = self.contact_of(free)
        if not np.isfinite(self.stroke.touch(contact)):
            return np.zeros_like(self.deflection)
        nodes = self.stroke.nodes(contact, finer)
        mean = lag_mean(self.law_of(free).contact_compliance())
        k = self.cantilever.spring_constant
        tip = PressedTip(self.elastic, 1 / k)
        bent = tip.force(nodes, self.stroke.at(nodes) - contact, mean) / k
        # The bending is smooth between corners, where nodes are close.
        rows = np.clip(self.stroke.times, nodes[0], nodes[-1])
        course = monotone_curve(nodes, bent, rows)
        return np.where(self.stroke.times < nodes[0], 0.0, course) / self.scale

    def refined(self, coarse: Floats, fine: Floats) -> Floats:
        """Error of the response with twice as many nodes [-], which is of second order."""
        return (fine - coarse) / 3

    @property
    def is_drawn_off(self) -> bool:
        """True if rows enough are on the other side of the contact point after the retraction."""
        return int(
            np.sum(self.stroke.position[self.stroke.hold_end :] < self.cantilever.contact)
        ) >= (_LEAST_FREE)

    def is_free_again(self, free: Floats) -> bool:
        """True if rows enough follow the contact to tell a drag from the offset."""
        back = self.response(free)[self.stroke.hold_end + 1 :]
        return int(np.sum(back <= _FREE)) >= _LEAST_FREE
