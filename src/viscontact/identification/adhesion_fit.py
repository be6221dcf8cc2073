"""Result of a fit of adhesion: its values and their confidence intervals."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.adhesion import JKR_ABOVE, Adhesion, regime
from viscontact.bodies.materials.material import Material
from viscontact.identification.fitted_contact import FittedContact
from viscontact.identification.fitted_curve import FittedCurve
from viscontact.identification.force_curve import ForceCurve
from viscontact.units.display import Plotted
from viscontact.units.formatting import format_number, format_quantity


@dataclass(frozen=True, eq=False, repr=False)
class AdhesionFit(Plotted):
    """Adhesion of an elastic sphere, fitted to a force curve.

    Made by `fit_adhesion`.

    Attributes
    ----------
    parameters : dict of str to float
        ``contact_modulus`` E/(1 - nu²) [Pa], ``work`` [J/m²], ``tabor_number`` [-] and ``range``
        [m]; of a curve that does not tell the range from none, an infinite number and a range of 0.
    intervals : dict of str to (float, float)
        Confidence interval of each. The Tabor number and the range are open where the curve is that
        of a limit: to infinity and to 0 in that of Johnson, Kendall and Roberts, to 0 and to
        infinity in that of Derjaguin, Muller and Toporov.
    confidence : float
        Its level, such as 0.95.
    contact : FittedContact
        Position at which the undeformed surfaces would touch, and the baseline.
    curve : ForceCurve
        The measured curve.
    fitted : ndarray, shape (n,)
        Force of the fit, zero in rows without contact, NaN in those beside jumps [N].
    measured : ndarray, shape (n,)
        Measured force, less the fitted baseline [N].
    material : Material
        Elastic half-space of the fitted modulus.
    units : tuple of str
        Units of the parameters, in their order.
    widening : float
        Largest factor by which an interval is wider, as the residuals are correlated [-].
    """

    _figure: ClassVar[str] = "fitted_adhesion"

    parameters: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    confidence: float
    contact: FittedContact
    curve: ForceCurve
    fitted: Floats
    measured: Floats
    material: Material
    units: tuple[str, ...]
    widening: float

    @property
    def tells_range(self) -> bool:
        """True if the curve tells the range from none."""
        return math.isfinite(self.parameters["tabor_number"])

    @property
    def adhesion(self) -> Adhesion:
        """Adhesion by Dugdale's law for `viscontact.simulate`; range None if not determined."""
        length = self.parameters["range"] if self.tells_range else None
        return Adhesion(self.parameters["work"], range=length, law="dugdale")

    @property
    def limit(self) -> str:
        """The limit of long or short ranges that applies to the contact, in words."""
        low, _ = self.intervals["tabor_number"]
        if self.tells_range:
            return regime(self.parameters["tabor_number"])
        if low >= JKR_ABOVE:
            return regime(low)
        if low > 0:
            longest = format_quantity(self.intervals["range"][1], "m", 2)
            numbers = f"Tabor numbers down to {format_number(low, 2)} (ranges up to {longest})"
            return f"the limit of JKR fits, and so do {numbers}"
        return "the limits of JKR and DMT both fit: the range is not determined"

    @property
    def approach(self) -> Floats:
        """Approach of the tip to the undeformed surface, by the measured forces [m]."""
        return self._tip(self.measured)

    @property
    def fitted_approach(self) -> Floats:
        """Approach of the tip by the fitted forces [m]; NaN in rows beside jumps."""
        return self._tip(self.fitted)

    def _tip(self, force: Floats) -> Floats:
        """Approach of the tip under forces on the cantilever [m]."""
        base = self.curve.position - self.contact.position
        return np.asarray(base - force / self.curve.spring_constant)

    @property
    def pull_off_force(self) -> float:
        """Largest measured pull of the retraction, which the noise makes a little larger [N]."""
        return -float(self.measured[self.curve.loading_rows :].min())

    @property
    def residuals(self) -> Floats:
        """Fitted less measured over the largest measured force; NaN in rows left out [-]."""
        largest = np.abs(self.measured[np.isfinite(self.fitted)]).max()
        return np.asarray((self.fitted - self.measured) / largest)

    @property
    def residual(self) -> float:
        """Root mean square of the residuals [-]."""
        return float(np.sqrt(np.nanmean(self.residuals**2)))

    def in_numbers(self, name: str) -> FittedCurve:
        """Return the fit as a row of `CurveFits`; NaN for a range that is not determined.

        Parameters
        ----------
        name : str
            Name of the curve.

        Returns
        -------
        FittedCurve
            Parameters, contact point and pull-off force, intervals [SI], residual, largest
            indentation and force.
        """
        units = dict(zip(self.parameters, self.units, strict=True))
        values = dict(self.parameters)
        if not self.tells_range:
            values |= {"tabor_number": math.nan, "range": math.nan}
        values |= {"contact_point": self.contact.position, "pull_off_force": self.pull_off_force}
        return FittedCurve(
            name,
            values,
            self.intervals | {"contact_point": self.contact.position_interval},
            units | {"contact_point": "m", "pull_off_force": "N"},
            self.residual,
            float(self.approach.max()),
            float(self.measured.max()),
        )

    def __repr__(self) -> str:
        lines = [
            f"AdhesionFit: {np.isfinite(self.fitted).sum()} of {self.fitted.size} rows, residual "
            f"{self.residual:.2e} of the largest force",
            *map(self._line, self.parameters, self.units),
            f"     limit: {self.limit}",
            f"     pull-off force {format_quantity(self.pull_off_force, 'N', 4)}",
            f"     {self.contact!r}",
        ]
        return "\n".join(lines)

    def _line(self, name: str, unit: str) -> str:
        """Line of a parameter, with its interval or the end that the curve determines."""
        value, (low, high) = self.parameters[name], self.intervals[name]
        level = f"{self.confidence:.0%}"
        if math.isinf(value) or value == 0:  # in the limit of short ranges
            within = f"above {low:.4g}" if math.isinf(high) else f"below {high:.4g}"
            known = low > 0 or math.isfinite(high)
            return f"     {name} " + (f"{within} {unit or '(-)'} ({level})" if known else "open")
        return f"     {name} = {value:.4g} {unit or '(-)'} ({level}: {low:.4g} to {high:.4g})"
