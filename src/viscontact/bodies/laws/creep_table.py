"""Creep law given by a measured table of compliance over time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import KW_ONLY, field, replace
from functools import cached_property
from typing import Literal

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.interconversion.cached_inverse import Inverse
from viscontact.bodies.laws.interconversion.curve_transform import oscillating
from viscontact.bodies.laws.interconversion.log_curve import LogCurve
from viscontact.bodies.laws.interconversion.oscillation import half_inverse
from viscontact.bodies.laws.interconversion.volterra import first_node
from viscontact.bodies.laws.law import Law, slowing
from viscontact.bodies.laws.parameter_checks import one_of
from viscontact.bodies.laws.table_columns import check_columns, check_left
from viscontact.bodies.laws.uniaxial import uniaxial


@dataclass(frozen=True)
class TabulatedCreep(Law):
    """Measured creep compliance Phi at the times of a table, without a fit.

    Parameters
    ----------
    times : sequence of float
        Times since the step in stress, ascending, >= 0 [s], spaced in any way; at least two of
        them positive. A row at 0 gives the instant compliance (0: none).
    compliance : sequence of float
        Phi at these times [1/Pa], positive, never falling.
    before : {"first", "slope"}, optional
        Before the first row, unless that is at 0: its value, so that the body is elastic up to
        there; or the first slope in log time, as the power of time through the first two rows,
        which stays positive, with an exponent of at most 1. It leaves no instant compliance.
    beyond : {"slope", "last"}, optional
        Beyond the last row: the slope in log time from the last but one to it, or its value.

    Raises
    ------
    ValueError
        If a value is not finite, negative or 0, the times do not ascend, the compliance falls,
        or fewer than two rows are left: with the column and the row, counted from 0.

    Notes
    -----
    Between the rows Phi is the monotone cubic in ln t through them (`LogCurve`); up to the first
    positive time after a row at 0 it is straight in t. The relaxation modulus is the inverse of
    that curve, computed numerically (`volterra`), with an `inversion_error`.

    Examples
    --------
    >>> law = TabulatedCreep([1.0, 10.0, 100.0], [1e-9, 2e-9, 3e-9])
    >>> law(10.0), round(law(1000.0) * 1e9, 9), law.measured_until
    (2e-09, 4.0, 100.0)
    """

    times: Sequence[float] = field(metadata={"unit": "s"})
    compliance: Sequence[float] = field(metadata={"unit": "1/Pa"})
    _: KW_ONLY
    before: Literal["first", "slope"] = "first"
    beyond: Literal["slope", "last"] = "slope"

    def __post_init__(self) -> None:
        check_columns(self, "compliance", 1)
        one_of("TabulatedCreep: before", self.before, ("first", "slope"))
        one_of("TabulatedCreep: beyond", self.beyond, ("slope", "last"))

    @classmethod
    def from_shear(
        cls,
        times: Sequence[float],
        compliance: Sequence[float],
        *,
        before: Literal["first", "slope"] = "first",
        beyond: Literal["slope", "last"] = "slope",
    ) -> TabulatedCreep:
        """Return the law from a rheometer's compliance, shear angle per shear stress.

        Parameters
        ----------
        times, compliance, before, beyond
            As in the class, but in terms of 1/G [1/Pa]: Phi is half of it.

        Returns
        -------
        TabulatedCreep
            The law in terms of Phi.

        Examples
        --------
        >>> TabulatedCreep.from_shear([1.0, 10.0], [2e-9, 4e-9]).compliance
        (1e-09, 2e-09)
        """
        given = cls(times, compliance, before=before, beyond=beyond)
        return replace(given, compliance=tuple(value / 2 for value in given.compliance))

    @classmethod
    def from_uniaxial(
        cls,
        times: Sequence[float],
        compliance: Sequence[float],
        *,
        before: Literal["first", "slope"] = "first",
        beyond: Literal["slope", "last"] = "slope",
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> TabulatedCreep:
        """Return the law from a tensile compliance D, strain per stress.

        Parameters
        ----------
        times, compliance, before, beyond
            As in the class, but in terms of D, with D(0) = 1/E_0 [1/Pa].
        poisson_ratio : float, optional
            Constant Poisson's ratio, above -1 and up to 0.5: Phi = (1 + ν) D.
        bulk_modulus : float, optional
            Elastic bulk modulus K [Pa]: Phi = (3/2) (D - 1/(9K)). Exactly one of the two.

        Returns
        -------
        TabulatedCreep
            The law in terms of Phi.

        Raises
        ------
        ValueError
            If not exactly one is given, or K is so small that a row's Phi would not be positive.

        Examples
        --------
        >>> law = TabulatedCreep.from_uniaxial([1.0, 10.0], [2e-9, 4e-9], poisson_ratio=0.5)
        >>> [round(value * 1e9, 6) for value in law.compliance]
        [3.0, 6.0]
        """
        owner = "TabulatedCreep.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        given = cls(times, compliance, before=before, beyond=beyond)
        check_left(owner, given.compliance, convert.volumetric)
        return replace(
            given, compliance=tuple(convert.instant(owner, value) for value in given.compliance)
        )

    def slowed(self, factor: float) -> TabulatedCreep:
        """Return the law with every time multiplied by a factor > 0."""
        factor = slowing(factor)
        return replace(self, times=tuple(factor * time for time in self.times))

    @property
    def measured_until(self) -> float:
        """Last time of the table [s]."""
        return self.times[-1]

    @property
    def inversion_error(self) -> float:
        """Estimated relative error of the relaxation modulus over the table's times [-].

        Relative to 1/(2 Phi), which G cannot exceed; nan if there is no relaxation modulus,
        because the compliance begins at 0.
        """
        return self._error

    @property
    def creep_error(self) -> float:
        """Estimated relative error of Phi, which is measured: 0 [-]."""
        return 0.0

    @property
    def _begins_at_nothing(self) -> bool:
        return self.times[0] == self.compliance[0] == 0

    @cached_property
    def _curve(self) -> LogCurve:
        return LogCurve(
            self.times,
            self.compliance,
            before="value" if self.before == "first" else "power",
            beyond="line" if self.beyond == "slope" else "value",
            steepest=(0.0, 1.0),
        )

    @cached_property
    def _inverse(self) -> Inverse:
        curve = self._curve
        # G is the inverse of 1/G = 2 Phi: the convention's factor 2 is put in here.
        return Inverse(
            lambda t: 2 * curve(t),
            lambda start, end: 2 * curve.mean(start, end),
            first_node(curve),
            -1,
            kinks=(float(curve.times[0]),),
            since=float(curve.times[0]),
        )

    @cached_property
    def _error(self) -> float:
        if self._begins_at_nothing:
            return math.nan
        return self._inverse.error(float(self._curve.times[0]), self.times[-1])

    def _creep(self, t: Floats) -> Floats:
        return self._curve(t)

    def _relaxation(self, t: Floats) -> Floats:
        if self._begins_at_nothing:
            raise ValueError(
                "TabulatedCreep: a relaxation modulus needs an instant compliance > 0, got "
                f"{self.compliance[0]!r} 1/Pa at 0 s; without one a step in strain takes an "
                "infinite stress (a Dirac impulse): leave that row out, or use the creep alone"
            )
        return self._inverse(t)

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        return self._curve.mean(start, end)

    def _complex_modulus(self, omega: Floats) -> Complexes:
        compliance = oscillating(self._curve, omega)
        return half_inverse(compliance.real, -compliance.imag)
