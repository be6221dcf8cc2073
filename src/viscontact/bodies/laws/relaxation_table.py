"""Creep law given by a measured table of relaxation modulus over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, field, replace
from functools import cached_property
from typing import Literal

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.interconversion.cached_inverse import Inverse
from viscontact.bodies.laws.interconversion.curve_transform import oscillating
from viscontact.bodies.laws.interconversion.log_curve import LogCurve
from viscontact.bodies.laws.interconversion.volterra import first_node
from viscontact.bodies.laws.law import Law, slowing
from viscontact.bodies.laws.parameter_checks import one_of
from viscontact.bodies.laws.table_columns import check_columns
from viscontact.bodies.laws.uniaxial import uniaxial


@dataclass(frozen=True)
class TabulatedRelaxation(Law):
    """Measured shear relaxation modulus G at the times of a table, without a fit.

    Parameters
    ----------
    times : sequence of float
        Times since the step in strain, ascending, >= 0 [s], spaced in any way; at least two of
        them positive. A row at 0 gives the instant modulus.
    modulus : sequence of float
        G at these times [Pa], positive, never growing.
    before : {"first", "slope"}, optional
        Before the first row, unless that is at 0: its value, so that the body is elastic up to
        there; or the first slope in log time, as the power of time through the first two rows,
        no steeper than t^-0.9. It leaves no instant compliance.
    beyond : {"slope", "last"}, optional
        Beyond the last row: the last slope in log time, as the power of time through the last two
        rows, because a straight line would run below zero; or its value.

    Raises
    ------
    ValueError
        If a value is not finite, negative or 0, the times do not ascend, the modulus grows, or
        fewer than two rows are left: with the column and the row, counted from 0.

    Notes
    -----
    Between the rows G is the monotone cubic in ln t through them (`LogCurve`); up to the first
    positive time after a row at 0 it is straight in t. The creep compliance is half the inverse
    of that curve, computed numerically (`volterra`), with an `inversion_error`.

    Examples
    --------
    >>> law = TabulatedRelaxation([1.0, 10.0, 100.0], [4e9, 2e9, 1e9])
    >>> law.relaxation(10.0), law(0.0), law.inversion_error < 1e-3
    (2000000000.0, 1.25e-10, True)
    """

    times: Sequence[float] = field(metadata={"unit": "s"})
    modulus: Sequence[float] = field(metadata={"unit": "Pa"})
    _: KW_ONLY
    before: Literal["first", "slope"] = "first"
    beyond: Literal["slope", "last"] = "slope"

    def __post_init__(self) -> None:
        check_columns(self, "modulus", -1)
        one_of("TabulatedRelaxation: before", self.before, ("first", "slope"))
        one_of("TabulatedRelaxation: beyond", self.beyond, ("slope", "last"))

    @classmethod
    def from_shear(
        cls,
        times: Sequence[float],
        modulus: Sequence[float],
        *,
        before: Literal["first", "slope"] = "first",
        beyond: Literal["slope", "last"] = "slope",
    ) -> TabulatedRelaxation:
        """Return the law from shear moduli, which are what the class takes.

        Parameters
        ----------
        times, modulus, before, beyond
            As in the class.

        Returns
        -------
        TabulatedRelaxation
            The law.

        Examples
        --------
        >>> TabulatedRelaxation.from_shear([1.0, 10.0], [2e9, 1e9]).modulus
        (2000000000.0, 1000000000.0)
        """
        return cls(times, modulus, before=before, beyond=beyond)

    @classmethod
    def from_uniaxial(
        cls,
        times: Sequence[float],
        modulus: Sequence[float],
        *,
        before: Literal["first", "slope"] = "first",
        beyond: Literal["slope", "last"] = "slope",
        poisson_ratio: float | None = None,
        bulk_modulus: float | None = None,
    ) -> TabulatedRelaxation:
        """Return the law from a tensile relaxation modulus E(t).

        Parameters
        ----------
        times, modulus, before, beyond
            As in the class, but in terms of E [Pa].
        poisson_ratio : float
            Constant Poisson's ratio, above -1 and up to 0.5: G = E / (2 (1 + ν)).
        bulk_modulus : float, optional
            Refused: G(t) is then no function of E(t) at the same instant alone.

        Returns
        -------
        TabulatedRelaxation
            The law in terms of G.

        Raises
        ------
        ValueError
            If Poisson's ratio is not given or out of range, or the bulk modulus is given.

        Examples
        --------
        >>> law = TabulatedRelaxation.from_uniaxial([1.0, 10.0], [6e9, 3e9], poisson_ratio=0.5)
        >>> law.modulus
        (2000000000.0, 1000000000.0)
        """
        owner = "TabulatedRelaxation.from_uniaxial"
        convert = uniaxial(owner, poisson_ratio, bulk_modulus)
        if convert.volumetric > 0:
            raise ValueError(
                f"{owner}: with bulk_modulus the shear modulus is no table at the same times; "
                "give poisson_ratio, or the tensile creep compliance to "
                "TabulatedCreep.from_uniaxial"
            )
        given = cls(times, modulus, before=before, beyond=beyond)
        return replace(
            given, modulus=tuple(value / (2 * convert.factor) for value in given.modulus)
        )

    def slowed(self, factor: float) -> TabulatedRelaxation:
        """Return the law with every time multiplied by a factor > 0."""
        factor = slowing(factor)
        return replace(self, times=tuple(factor * time for time in self.times))

    @property
    def measured_until(self) -> float:
        """Last time of the table [s]."""
        return self.times[-1]

    @property
    def inversion_error(self) -> float:
        """Estimated relative error of the creep compliance over the table's times [-]."""
        return self._error

    @cached_property
    def _curve(self) -> LogCurve:
        return LogCurve(
            self.times,
            self.modulus,
            before="value" if self.before == "first" else "power",
            beyond="power" if self.beyond == "slope" else "value",
            steepest=(-0.9, 0.0),
        )

    @cached_property
    def _inverse(self) -> Inverse:
        curve = self._curve
        first = float(curve.times[0])
        node = first_node(curve)
        return Inverse(curve, curve.mean, node, 1, kinks=(first,), since=first)

    @cached_property
    def _error(self) -> float:
        return self._inverse.error(float(self._curve.times[0]), self.times[-1])

    def _creep(self, t: Floats) -> Floats:
        # Phi is half the inverse of G: the convention's factor 2 is put in here.
        return self._inverse(t) / 2

    def _relaxation(self, t: Floats) -> Floats:
        return self._curve(t)

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        return self._inverse.mean(start, end) / 2

    def _complex_modulus(self, omega: Floats) -> Complexes:
        return oscillating(self._curve, omega)
