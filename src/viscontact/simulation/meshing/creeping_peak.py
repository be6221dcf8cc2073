"""Error of the peak pressure where a contact grows on a body that relaxes.

Freshly pressed material is stiff, the older has relaxed. A growing contact therefore carries a
ring of high pressure along its edge, as wide as the edge moves in a relaxation time, which no
elastic contact shows. While a contact grows, ∫ J dp is the pressure of an elastic one under the
reference force S = ∫ J dF (Lee & Radok 1960, J. Appl. Mech. 27, 438). So the ring on cells follows
from elastic strips (`strip_contact`), without a run:

1. Take extents and peak pressure of the elastic contact as powers of S, from two contacts.
2. March through the history: solve ∫ J dp = P(S) for the pressure p of each strip, and for that of
   many samples of the exact elastic P.
3. The error is the largest difference of the two peaks, relative to the largest peak of the
   history, while the contact is at least LEAST_ACROSS cells across.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.mechanics.time_integration.default_times import (
    MAX_LOAD_STEPS,
    default_end,
    steps_of_one_cell,
)
from viscontact.mechanics.time_integration.fixed_steps import TimeStep, plan_steps, step_ends
from viscontact.mechanics.time_integration.hereditary_integral import (
    HereditaryResponse,
    response_to,
)
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.mechanics.time_integration.plan import plan_hereditary_integral
from viscontact.simulation.meshing.contact_extent import PointContact
from viscontact.simulation.meshing.contact_place import locate_contact
from viscontact.simulation.meshing.strip_contact import StripContact, mean_pressure, strip_contact

#: Creep over the whole history, over J(0), from which on the error is estimated.
LEAST_CREEP = 0.1

#: Least number of cells across the contact from which on the error counts, and largest number for
#: which it is computed: on more cells it is smaller.
LEAST_ACROSS, MOST_ACROSS = 10.0, 1000.0

#: Strips over the half width of the exact contact.
EXACT_STRIPS = 1000

#: Reference force of the second elastic contact, over that of the largest one.
SMALLER_REFERENCE = 1 / 8

#: Parts of each of the steps that resolve the law, and number of steps that limits them.
DIVISIONS, DIVIDED_STEPS = 8, 800

TINY = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, eq=False)
class ContactGrowth:
    """Elastic reference of a growing contact, and the steps of its history."""

    # The reference is the force ∫ J dF [m²] or the approach [m]. Extents of the contact along x and
    # y, and the peak of the elastic pressure, are powers of it, and 1 at its largest value.

    load: LoadHistory
    steps: tuple[TimeStep, ...]
    compliance: SeriesCompliance  # J(t) [1/Pa]
    clock: Clock
    largest: float  # reference of the largest contact
    extents: tuple[float, float]  # exponents of the extents along x and y [-]
    peak: float  # exponent of the peak pressure [-]

    @property
    def is_round(self) -> bool:
        """True if the contact grows alike along x and y."""
        return self.extents[0] == self.extents[1]

    def peak_errors(self, axis: int, across: ArrayLike) -> Floats:
        """Errors of the peak pressure over its maximum, for cells across an axis [-]."""
        cells = np.minimum(across, MOST_ACROSS)
        widths, pressures = self._march(axis, cells / 2)
        exact, found = pressures[:, :1], pressures[:, 1:]
        counts = np.multiply.outer(widths, cells) >= LEAST_ACROSS
        errors = np.where(counts, np.abs(found - exact), 0.0)
        return np.asarray(errors.max(axis=0) / max(float(exact.max()), TINY))

    def _march(self, axis: int, halves: Floats) -> tuple[Floats, Floats]:
        """Relative widths, exact peaks, peaks on cells by step; `halves` in cells."""
        counts = np.ceil(halves).astype(int) + 2
        contact = strip_contact(2 ** math.ceil(math.log2(counts.max())))
        edges = np.linspace(0.0, 1.0, EXACT_STRIPS + 1)
        firsts = 1 + np.cumsum([0, EXACT_STRIPS, *counts[:-1]])
        # The first number is the force, whose integral is the reference.
        numbers = 1 + EXACT_STRIPS + int(counts.sum())
        memory = InternalVariables(self.compliance, (numbers,), clock=self.clock)
        widths, largest = np.zeros(len(self.steps)), np.zeros((len(self.steps), len(firsts)))
        for index, step in enumerate(self.steps):
            response = response_to(step, memory)
            level = max(self.load.at(step.time, side=step.side).level, 0.0)
            reference = self._reference(level, response)
            if reference > 0:
                widths[index] = min(reference ** self.extents[axis], 1.0)
            width = float(widths[index])
            on_cells = _shapes(contact, width * halves, counts)
            shapes = np.concatenate([mean_pressure(width, edges), *on_cells])
            elastic = np.append(level, reference**self.peak * shapes)
            pressure = np.zeros(elastic.shape)
            if response.compliance > 0:
                pressure = np.maximum(elastic - response.history, 0.0) / response.compliance
                pressure[elastic <= 0] = 0.0
            pressure[0] = level
            memory.accept(pressure)
            largest[index] = np.maximum.reduceat(pressure, firsts)
        return widths, largest

    def _reference(self, level: float, response: HereditaryResponse) -> float:
        """Reference after a step to a level [N or m], over that of the largest contact [-]."""
        if self.load.control == "force":
            level = float(response.history[0]) + response.compliance * level
        return max(level, 0.0) / self.largest


def _shapes(contact: StripContact, halves: Floats, counts: NDArray[np.int64]) -> list[Floats]:
    """Pressures of strips over the largest one in Hertz's contact, for several half widths."""
    return [
        contact.pressure(half)[:count] / half if half > 0 else np.zeros(count)
        for half, count in zip(halves.tolist(), counts.tolist(), strict=True)
    ]


def contact_growth(
    indenter: Indenter,
    compliance: ContactCompliance,
    load: LoadHistory,
    end: float | None,
    largest: PointContact,
) -> ContactGrowth | None:
    """Growth of a contact up to `end` [s] and `largest`; None on a body that hardly creeps."""
    last = _last_time(load, compliance, end)
    if not compliance(last) > (1 + LEAST_CREEP) * compliance.instant:
        return None
    times = steps_of_one_cell(load, compliance, last)
    divisions = min(max(DIVIDED_STEPS // len(times), 1), DIVISIONS)
    parts = [times[:-1] + part / divisions * np.diff(times) for part in range(divisions)]
    instants = np.unique(np.concatenate([*parts, times[-1:]]))
    clocks = () if compliance.clock is TIME else (compliance.clock,)
    steps = plan_steps(instants, load, clocks=clocks)
    plan = plan_hereditary_integral(compliance, step_ends(steps), 2)
    by_force = load.control == "force"
    reference = largest.point.level * (largest.compliance if by_force else 1.0)
    extents, peak = _exponents(indenter, largest)
    series, clock = plan.prony_approximation, plan.clock
    return ContactGrowth(load, steps, series, clock, reference, extents, peak)


def _last_time(load: LoadHistory, compliance: ContactCompliance, end: float | None) -> float:
    """End of the examined history: of the run, or of its first MAX_LOAD_STEPS load steps [s]."""
    last = default_end(load, compliance) if end is None else end
    kinks = load.kinks[load.kinks <= last]
    most = float(kinks[MAX_LOAD_STEPS]) if len(kinks) > MAX_LOAD_STEPS else last
    return min(last, most, MAX_LOAD_STEPS * load.longest_step)


def _exponents(indenter: Indenter, largest: PointContact) -> tuple[tuple[float, float], float]:
    """Powers of the reference that extents and peak pressure of the contact follow [-]."""
    point, compliance = largest.point, largest.compliance
    if point.approach is None:
        compliance *= SMALLER_REFERENCE
    else:
        point = replace(point, approach=SMALLER_REFERENCE * point.approach)
    smaller = locate_contact(indenter, compliance, point, response=largest.response)
    estimate = largest.estimate
    ratios = np.divide(
        [*smaller.extents, smaller.peak_pressure * compliance],
        [*estimate.extents, estimate.peak_pressure * largest.compliance],
    )
    # Of balls, the estimates of both extents differ by rounding only.
    along, across, peak = (np.log(ratios) / math.log(SMALLER_REFERENCE)).round(6).tolist()
    return (max(along, 0.0), max(across, 0.0)), max(peak, 0.0)
