"""Fit of the force curve of an elastic sphere that adheres: its rows, states and unknowns."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.adhesive_branch import adhesive_branch
from viscontact.identification.force_curve import ForceCurve

#: Rows of the approach that the first baseline takes, and the least number of free rows.
_FIRST_FREE, _LEAST_FREE = 0.1, 5
#: Parts of the largest pull: less is free of force; more is held on the branch while withdrawn.
_FREE, _HELD = 0.15, 0.6
#: Standard deviations of noise that two rows one after the other do not reach: a jump into contact
#: may be shallow.
_NOISE = 6.0
#: Part of the largest pull below which a force is never told from none.
_LEAST_FORCE = 1e-3
#: Rows beside a jump that count on neither side of it.
_BESIDE = 2
#: Forces [pi w R] and approaches [(pi² w² R/K²)^(1/3)] of Johnson, Kendall and Roberts at
#: pull-off and without force.
_JKR_PULL, _JKR_WAY, _JKR_FREE = 1.5, (6 ** (2 / 3) + 1.5 ** (2 / 3)) / 3, 6 ** (2 / 3) / 3

_NO_PULL_OFF = (
    "fit_adhesion: no pull-off is found; the curve must begin before contact, and its retraction "
    "must pull with several times the noise, with a negative deflection where the cantilever is "
    "pulled to the sample"
)


@dataclass(frozen=True, eq=False)
class AdhesiveRows:
    """Rows of a force curve that are free of force, and those held in contact."""

    curve: ForceCurve
    free: Bools
    held: Bools
    pull: float  # largest pull [N]

    @classmethod
    def of(cls, curve: ForceCurve) -> AdhesiveRows:
        """Tell rows apart by their force; ValueError if none of a kind is found."""
        turn, count = curve.loading_rows, curve.times.size
        if turn == count:
            raise ValueError(_NO_PULL_OFF)
        first = max(int(_FIRST_FREE * turn), _LEAST_FREE)
        free = np.arange(count) < first
        force = _without_line(curve, free)
        for is_last in (False, False, True):
            pull, lowest = (
                -float(force[turn:].min(initial=0.0)),
                turn + int(np.argmin(force[turn:])),
            )
            noise = max(_NOISE * _noise(force[free]), _LEAST_FORCE * pull)
            begin = _begin(force, min(_FREE * pull, noise) if is_last else _FREE * pull) - _BESIDE
            free = np.arange(count) < begin
            if begin < _LEAST_FREE or not pull > 0:
                break
            force = _without_line(curve, free)
        if begin < _LEAST_FREE or not pull > _LEAST_FREE * float(force[free].std()):
            raise ValueError(_NO_PULL_OFF)
        held_in = begin + int(np.argmax(np.abs(force[begin:]) > _HELD * pull)) + _BESIDE
        beyond = np.flatnonzero(force[lowest:] < -_HELD * pull)
        held_out = lowest + int(beyond[-1]) + 1
        rows = np.arange(count)
        free |= (rows >= held_out + _BESIDE) & (np.abs(force) < _FREE * pull)
        return cls(curve, free, (rows >= held_in) & (rows < held_out), pull)

    @property
    def fitted(self) -> Bools:
        """Rows that are fitted."""
        return np.asarray(self.free | self.held)

    @cached_property
    def line(self) -> tuple[float, float]:
        """Slope [-] and offset [m] of the deflection of free rows over the position."""
        return _line(self.curve, self.free)

    @cached_property
    def force(self) -> Floats:
        """Force of all rows, less the line of the free ones [N]."""
        return _without_line(self.curve, self.free)

    def jkr(self, radius: float) -> tuple[float, float, float]:
        """Work [J/m²], contact modulus [Pa], position at first touch [m] from two points.

        The pull-off and the point without force of the retraction (Johnson, Kendall & Roberts).
        """
        turn = self.curve.loading_rows - 1
        approach = self.curve.position - self.force / self.curve.spring_constant
        lowest = turn + int(np.argmin(self.force[turn:]))
        crossing = turn + int(np.argmax(self.force[turn:] <= 0))
        work = self.pull / (_JKR_PULL * np.pi * radius)
        way = max(float(approach[crossing] - approach[lowest]), 1e-6 * np.ptp(approach))
        depth = way / _JKR_WAY
        modulus = 0.75 * np.pi * work * np.sqrt(radius / depth**3)
        return work, float(modulus), float(approach[crossing] - _JKR_FREE * depth)


def _without_line(curve: ForceCurve, rows: Bools) -> Floats:
    """Force less the line through some rows [N]."""
    slope, offset = _line(curve, rows)
    return np.asarray(curve.spring_constant * (curve.deflection - offset - slope * curve.position))


def _begin(force: Floats, threshold: float) -> int:
    """First of two rows one after the other whose forces exceed a threshold [N]; 0 if none do."""
    beyond = np.abs(force) > threshold
    return int(np.argmax(beyond[:-1] & beyond[1:]))


def _noise(force: Floats) -> float:
    """Standard deviation of noise, from the median of its absolute values [N]."""
    return 1.4826 * float(np.median(np.abs(force)))


def _line(curve: ForceCurve, rows: Bools) -> tuple[float, float]:
    """Slope [-] of the deflection over the position, and offset at position 0 [m]."""
    middle = curve.position[rows].mean()
    slope, offset = np.polyfit(curve.position[rows] - middle, curve.deflection[rows], 1)
    return float(slope), float(offset - slope * middle)


@dataclass(frozen=True)
class AdhesiveUnknowns:
    """Unknowns of an adhesive contact, all positive."""

    names: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class AdhesiveProblem:
    """Force, in rows, as modulus, work, position at first touch and a line give it.

    The Tabor number is given: with it unknown the least squares have a long flat valley.

    The position of the base is taken as exact and the deflection as measured. Beyond the state at
    which the branch ends the force stays the last one: a tip that comes off earlier than it must
    tells nothing.
    """

    rows: AdhesiveRows
    radius: float  # of the tip [m]
    tabor: float  # Tabor number [-]

    def with_tabor(self, tabor: float) -> AdhesiveProblem:
        """The problem under a Tabor number."""
        return replace(self, tabor=tabor)

    @cached_property
    def first(self) -> tuple[float, float, float]:
        """Work [J/m²], modulus [Pa] and position [m] from two points."""
        return self.rows.jkr(self.radius)

    @property
    def shape(self) -> AdhesiveUnknowns:
        """Modulus and work."""
        return AdhesiveUnknowns(("contact_modulus", "work"))

    @property
    def starts(self) -> list[Floats]:
        """Starting values: those of two points, at the first touch that they give."""
        work, modulus, _ = self.first
        return [np.array([np.log(modulus), np.log(work), 0.0])]

    @property
    def reach(self) -> Floats:
        """Largest change of the position at first touch, in units of the force curve."""
        return np.array([np.ptp(self.rows.curve.position) / self._length])

    @property
    def _length(self) -> float:
        """Unit of the position: the deflection by the largest pull, or the way of the tip [m]."""
        work, modulus, _ = self.first
        return float(np.cbrt((np.pi * work * 0.75 / modulus) ** 2 * self.radius))

    def position_of(self, free: Floats) -> float:
        """Position of the base at which the undeformed bodies would touch [m]."""
        return self.first[2] + self._length * float(free[-1])

    @cached_property
    def columns(self) -> Floats:
        """Offset, and slope of the deflection over the position, in all rows, shape (rows, 2)."""
        z = self.rows.curve.position
        return np.stack([np.ones_like(z), z - z.mean()], axis=1)

    @property
    def baseline(self) -> Floats:
        """Columns of the linear terms, shape (fitted rows, 2)."""
        return self.columns[self.rows.fitted]

    @cached_property
    def scale(self) -> float:
        """Largest force [N]."""
        return float(np.abs(self.rows.force[self.rows.fitted]).max())

    @cached_property
    def measured(self) -> Floats:
        """Forces over the largest [-]."""
        return self.rows.force[self.rows.fitted] / self.scale

    @property
    def unseen(self) -> Floats:
        """Nothing that other terms hide."""
        return np.zeros_like(self.measured)

    def response(self, free: Floats, finer: int = 1) -> Floats:
        """Force of each fitted row over the largest one [-]."""
        return self.forces(free, finer)[self.rows.fitted] / self.scale

    def refined(self, coarse: Floats, fine: Floats) -> Floats:
        """Error of the response with twice as many nodes [-], which is of second order."""
        return (fine - coarse) / 3

    def forces(self, free: Floats, finer: int = 1) -> Floats:
        """Force of all rows, zero in free ones [N]."""
        modulus, work = np.exp(free[:-1]).tolist()
        stiffness = 4 / 3 * modulus
        unit = np.pi * work * self.radius
        depth = float(np.cbrt((np.pi * work / stiffness) ** 2 * self.radius))
        curve = self.rows.curve
        way = (curve.position - self.position_of(free)) / depth
        soft = unit / (curve.spring_constant * depth)
        largest = 2 + np.sqrt(max(float(way.max()), 0.0))  # a² < δ + 2/3 sqrt(6 a)
        force, approach = adhesive_branch(self.tabor, largest, finer)
        base = approach + soft * force
        turn = np.flatnonzero(np.diff(base) > 0)
        kept = slice(0, int(turn[0]) + 1 if turn.size else base.size)
        found = np.interp(way, base[kept][::-1], force[kept][::-1])
        return np.where(self.rows.free, 0.0, unit * found)
