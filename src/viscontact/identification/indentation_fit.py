"""Result of an indentation fit: the law and its confidence intervals."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Elastic, Law, PowerLaw
from viscontact.bodies.materials.material import Material
from viscontact.bodies.series_fits.quality import Misfit
from viscontact.identification.fitted_contact import FittedContact
from viscontact.identification.fitted_curve import FittedCurve
from viscontact.identification.record import IndentationRecord
from viscontact.units.display import Displayable, Plotted
from viscontact.units.formatting import format_quantity

_TOUCH = 0.05  # of the largest force: smaller ones may be scatter without contact


@dataclass(frozen=True, eq=False, repr=False)
class IndentationFit(Displayable, Plotted):
    """Law fitted to an indentation record.

    Made by `fit_indentation`.

    Attributes
    ----------
    material : Material
        The material, ready for `viscontact.simulate`.
    parameters : dict of str to float
        The fitted parameters by the names of the law's constructor, in SI units.
    intervals : dict of str to (float, float)
        Confidence interval of each.
    confidence : float
        Its level, such as 0.95.
    correlation : ndarray, shape (p, p)
        Correlation of the parameters' logarithms, in their order: near 1 or -1, the record
        determines a combination of two better than each [-].
    record : IndentationRecord
        The measured record; that of a force curve with the fitted contact point and baseline.
    given : str
        Quantity taken as exact, ``"approach"`` or ``"force"``; the other is fitted.
    fitted : ndarray, shape (n,)
        The other quantity from the law [N or m]; NaN beyond ``until``.
    units : tuple of str
        Units of the parameters, in their order.
    until : float
        Last instant that was fitted [s].
    contact : FittedContact or None
        Contact point and baseline that were fitted together with the law of a force curve.
    widening : float
        Largest factor by which an interval is wider, as the residuals are correlated, than it would
        be for noise that is independent from row to row; 1 for such noise [-].
    misfit : Misfit or None
        Size, reason and remedy of a misfit beyond 10 % (root mean square) or 25 % (largest) of the
        largest force, or approach; None if the law fits better.
    thickness : float or None
        Thickness of the film [m]; None for a half-space.

    Examples
    --------
    >>> from viscontact.identification import fit_indentation
    >>> from viscontact.bodies.indenters import Sphere
    >>> depth = 1e-6 * np.linspace(0.0, 1.0, 11)
    >>> force = 16 / 3 * 2e6 * np.sqrt(5e-6) * depth**1.5  # Hertz with G = 2 MPa, nu = 0.5
    >>> record = IndentationRecord(Sphere(5e-6), np.linspace(0.0, 1.0, 11), depth, force)
    >>> fit = fit_indentation(record, "elastic", poisson_ratio=0.5)
    >>> f"{fit.parameters['shear_modulus']:.3g} {fit.units[0]}", fit.residual < 1e-3
    ('2e+06 Pa', True)
    """

    _figure: ClassVar[str] = "fitted_indentation"

    material: Material
    parameters: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    confidence: float
    correlation: Floats
    record: IndentationRecord
    given: str
    fitted: Floats
    units: tuple[str, ...]
    until: float = math.inf
    contact: FittedContact | None = None
    widening: float = 1.0
    misfit: Misfit | None = None
    thickness: float | None = None

    @property
    def deepest(self) -> float:
        """Largest approach that was fitted [m]."""
        return float(self.record.approach[self.record.times <= self.until].max())

    @property
    def law(self) -> Law:
        """Law in shear."""
        return self.material.law

    @property
    def measured(self) -> Floats:
        """Measured values that `fitted` is compared with [N or m]."""
        return compared(self.record, self.given)[0]

    @property
    def residuals(self) -> Floats:
        """Fitted less measured over the largest measured value; NaN in rows left out [-]."""
        measured, counted = compared(self.record, self.given)
        fitted = self.record.times <= self.until
        difference = (self.fitted - measured) / np.abs(measured[fitted]).max()
        return np.where(counted & fitted, difference, np.nan)

    @property
    def residual(self) -> float:
        """Root mean square of the residuals [-]."""
        return float(np.sqrt(np.nanmean(self.residuals**2)))

    def in_numbers(self, name: str) -> FittedCurve:
        """Return the fit as a row of `CurveFits`, with Young's modulus.

        That of a power law is the relaxation modulus in tension at its reference time, without an
        interval; laws with several times have none.

        Parameters
        ----------
        name : str
            Name of the curve.

        Returns
        -------
        FittedCurve
            Parameters and intervals [SI], residual, largest indentation and force.
        """
        values, intervals = dict(self.parameters), dict(self.intervals)
        units = dict(zip(self.parameters, self.units, strict=True))
        ratio = self.material.poisson_ratio
        if isinstance(self.law, Elastic) and ratio is not None:
            factor = 2 * (1 + float(ratio))
            values["youngs_modulus"] = factor * values["shear_modulus"]
            low, high = intervals["shear_modulus"]
            intervals["youngs_modulus"] = (factor * low, factor * high)
            units["youngs_modulus"] = "Pa"
        if isinstance(self.law, PowerLaw) and ratio is not None:
            modulus = float(self.law.relaxation(self.law.reference_time))
            values["youngs_modulus"] = 2 * (1 + float(ratio)) * modulus
            units["youngs_modulus"] = "Pa"
        fitted = self.record.times <= self.until
        return FittedCurve(
            name,
            values,
            intervals,
            units,
            self.residual,
            self.deepest,
            float(self.record.force[fitted].max()),
        )

    def __repr__(self) -> str:
        fitted = self.record.times[self.record.times <= self.until]
        lines = [
            f"IndentationFit: {type(self.law).__name__} to {fitted.size} rows over "
            f"{format_quantity(np.ptp(fitted), 's')}, residual {self.residual:.2e} of "
            f"the largest {'force' if self.given == 'approach' else 'approach'}"
        ]
        if self.thickness is not None:
            lines.append(f"     film of {format_quantity(self.thickness, 'm', 4)} on a rigid base")
        stated = self.in_numbers("")
        for name, value in stated.values.items():
            line = f"     {name} = {value:.4g} {stated.units[name] or '(-)'}"
            if name in stated.intervals:
                low, high = stated.intervals[name]
                line += f" ({self.confidence:.0%}: {low:.4g} to {high:.4g})"
            elif isinstance(self.law, PowerLaw):
                line += f" in relaxation for {format_quantity(self.law.reference_time, 's')}"
            lines.append(line)
        if self.contact is not None:
            lines.append(f"     {self.contact!r}")
        return "\n".join(lines)


def compared(record: IndentationRecord, given: str) -> tuple[Floats, Bools]:
    """Fitted quantity, force [N] or approach [m], and the mask of the rows that count."""
    if given == "approach":
        return record.force, np.ones(record.force.size, dtype=bool)
    # Without force the approach is the position of the stage, not of the surface.
    return record.approach, record.force > _TOUCH * record.force.max()
