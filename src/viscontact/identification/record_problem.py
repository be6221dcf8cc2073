"""Fit of a record whose approach, or force, is exact: the law alone."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from viscontact import reference
from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.material import Material
from viscontact.identification.candidates import Candidate
from viscontact.identification.elastic_indentation import ElasticIndentation
from viscontact.identification.fitted_part import stroke_of
from viscontact.identification.indentation_fit import compared
from viscontact.identification.record import IndentationRecord
from viscontact.identification.tip_contact import PressedTip
from viscontact.reference.lag_means import lag_mean

_ELEMENTS = 60  # relative error of the force about 1e-4, far below the scatter of any record
_LEAD = 2.0  # steps: a record that begins less deep than these began at contact


@dataclass(frozen=True, eq=False)
class RecordProblem:
    """Force under a given approach, or the reverse, as a law gives it."""

    record: IndentationRecord
    given: str
    shape: Candidate
    material: Callable[..., Material]
    elastic: ElasticIndentation
    begins_coarse: bool = True

    @cached_property
    def _counted(self) -> Bools:
        return compared(self.record, self.given)[1]

    @cached_property
    def scale(self) -> float:
        """Largest measured value [N or m]."""
        return float(np.abs(compared(self.record, self.given)[0]).max())

    @cached_property
    def measured(self) -> Floats:
        """Measured values in the rows that count, over the largest one [-]."""
        return compared(self.record, self.given)[0][self._counted] / self.scale

    @property
    def starts(self) -> list[Floats]:
        """Starting values of the law."""
        return [self.shape.free(np.array(start)) for start in self.shape.starts]

    @property
    def reach(self) -> Floats:
        """Largest change of each unknown besides those of the law: there is none."""
        return np.zeros(0)

    @property
    def baseline(self) -> Floats:
        """Columns of the baseline: there is none."""
        return np.zeros((self.measured.size, 0))

    @property
    def unseen(self) -> Floats:
        """Standard deviation of what the rows cannot tell from other terms: none [-]."""
        return np.zeros(self.measured.size)

    def law_of(self, free: Floats) -> Material:
        """Material of unknowns."""
        return self.material(self.shape.build(*self.shape.values(free).tolist()))

    def response(self, free: Floats, finer: int = 1) -> Floats:
        """Exact solution in the rows that count, over the largest measured value [-].

        It is searched with a coarser one, by the tip alone in place of the pressure within the
        contact, where there is one; `finer` ones are those of the pressure.
        """
        material = self.law_of(free)
        is_coarse = finer == 1 and self.has_coarser
        whole = self._by_tip(material) if is_coarse else self.exact(material)
        return whole[self._counted] / self.scale

    def refined(self, coarse: Floats, fine: Floats) -> Floats:
        """Error of the finer response [-]: not known, and far below that of the coarser one."""
        return np.zeros_like(fine)

    @cached_property
    def has_coarser(self) -> bool:
        """True if the tip is pressed in once."""
        if self.elastic.film is not None or self.given != "approach" or not self.begins_coarse:
            return False
        return stroke_of(self.record).second_approach is None

    def exact(self, material: Material) -> Floats:
        """Exact solution for the other quantity of the record [N or m]."""
        times, approach, force, lead = self._since_contact
        if self.elastic.film is not None:
            return self._by_tip(material)
        contact = reference.press_axisymmetric(
            self.record.profile,
            times,
            creep_compliance=material.contact_compliance(),
            elements=_ELEMENTS,
            approach=approach if self.given == "approach" else None,
            force=np.maximum(force, 0.0) if self.given == "force" else None,
        )
        whole = contact.force if self.given == "approach" else contact.approach
        response = whole[lead:]
        if not np.isfinite(response).all():
            row = int(np.argmax(~np.isfinite(response)))
            raise ValueError(f"fit_indentation: the exact solution gives no number in row {row}")
        return np.asarray(response)

    def _by_tip(self, material: Material) -> Floats:
        """Force on the tip: from the last touch before the largest approach on, 0 before it [N]."""
        times, approach, _, lead = self._since_contact
        free = np.flatnonzero(approach[: int(approach.argmax())] <= 0)
        first, touch = 0, float(times[0])
        if free.size:
            first = int(free[-1]) + 1
            around = slice(first - 1, first + 1)
            (low, high), (begin, end) = approach[around], times[around]
            touch = float(begin + low / (low - high) * (end - begin))
        # A record that begins in contact jumps into it, in a step of no duration.
        nodes, way = np.append(touch, times[first:]), np.append(0.0, approach[first:])
        mean = lag_mean(material.contact_compliance())
        force = PressedTip(self.elastic).force(nodes, way, mean)[1:]
        return np.append(np.zeros(first), force)[lead:]

    @cached_property
    def _since_contact(self) -> tuple[Floats, Floats, Floats, int]:
        return _from_contact(self.record, self.elastic)


def _from_contact(
    record: IndentationRecord, elastic: ElasticIndentation
) -> tuple[Floats, Floats, Floats, int]:
    """Times, approach and force from first contact on, and the number of rows put before."""
    # A first row that is in contact by a step or two, or within the noise of the force, was reached
    # at the rate of what follows, not in a jump.
    t, d, F = record.times, record.approach, record.force
    later = np.flatnonzero((t > t[0]) & (d > d[0]))
    if not (d[0] > 0 and later.size):
        return t, d, F, 0
    row = int(later[0])
    step, duration = float(d[row] - d[0]), float(t[row] - t[0])
    noise = float(np.sqrt(np.mean(np.diff(F, 2) ** 2) / 6)) if F.size > 2 else 0.0
    shallow = elastic.force(float(d[0])) / elastic.force(float(d.max()))
    if d[0] > _LEAD * step and shallow * F.max() > 2 * noise:
        return t, d, F, 0
    before = t[0] - duration * float(d[0]) / step
    return np.append(before, t), np.append(0.0, d), np.append(0.0, F), 1
