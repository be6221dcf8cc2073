"""Measured or printed values of a source, in the convention of its test."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Law

#: Over time; the others are over angular frequency.
_OVER_TIME = ("creep_compliance", "relaxation_modulus")
_QUANTITIES = (*_OVER_TIME, "storage_modulus", "loss_modulus", "loss_tangent")
#: Reciprocal of the creep compliance, as data sheets print it (ISO 899-1).
_CREEP_MODULUS = "creep_modulus"


@dataclass(frozen=True, eq=False)
class Points:
    """Values of one quantity from a source, not computed from the constants they check.

    Parameters
    ----------
    quantity : str
        ``creep_compliance``, ``relaxation_modulus``, ``storage_modulus``, ``loss_modulus`` or
        ``loss_tangent``.
    what : str
        Their source.
    at : ndarray
        Times [s], or angular frequencies [rad/s] of the last three quantities.
    values : ndarray
        Values as Phi [1/Pa], as shear moduli [Pa] or as ratios, whatever the source's
        convention was.
    tolerance : float
        Largest relative deviation of the law from them; the file gives the reason.
    """

    quantity: str
    what: str
    at: Floats
    values: Floats
    tolerance: float

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Points):
            return NotImplemented
        return self._content() == other._content()

    def __hash__(self) -> int:
        return hash(self._content())

    def _content(self) -> tuple[object, ...]:
        """All fields, arrays as tuples, which are compared as a whole."""
        numbers = tuple(self.at.tolist()), tuple(self.values.tolist())
        return self.quantity, self.what, *numbers, self.tolerance

    @property
    def over_time(self) -> bool:
        """True if `at` are times, False if they are angular frequencies."""
        return self.quantity in _OVER_TIME

    def of_law(self, law: Law) -> Floats:
        """Return the quantity of a law at `at`, in the unit of `values`.

        Parameters
        ----------
        law : Law
            A creep law.

        Returns
        -------
        ndarray
            The quantity at `at`, in the unit of `values`.

        Examples
        --------
        >>> from viscontact.bodies.laws import Maxwell
        >>> points = Points("loss_tangent", "", np.array([0.5]), np.array([2.0]), 0.01)
        >>> points.of_law(Maxwell(1e6, 1e6)).round(12).tolist()
        [2.0]
        """
        if self.quantity == "creep_compliance":
            return law(self.at)
        if self.quantity == "relaxation_modulus":
            return law.relaxation(self.at)
        modulus = law.complex_modulus(self.at)
        if self.quantity == "loss_tangent":
            return np.asarray(modulus.imag / modulus.real)
        return np.asarray(modulus.real if self.quantity == "storage_modulus" else modulus.imag)


def read_points(given: dict[str, Any], poisson_ratio: float | None) -> Points:
    """Read an entry's points as those in shear; tensile ones need a constant Poisson's ratio."""
    # A creep modulus is read as the compliance that is its reciprocal.
    if given["quantity"] == _CREEP_MODULUS:
        compliances = [1.0 / value for value in given["values"]]
        given = {**given, "quantity": "creep_compliance", "values": compliances}
    quantity = given["quantity"]
    if quantity not in _QUANTITIES:
        allowed = ", ".join((*_QUANTITIES, _CREEP_MODULUS))
        raise ValueError(f"quantity must be one of {allowed}, got {quantity!r}")
    at = given["times" if quantity in _OVER_TIME else "angular_frequencies"]
    places = np.asarray(at, dtype=np.float64)
    values = np.asarray(given["values"], dtype=np.float64)
    if places.shape != values.shape or values.ndim != 1:
        raise ValueError(f"{quantity}: {places.size} places and {values.size} values; give as many")
    factor = _compliance_factor(given["data"], poisson_ratio)
    if quantity == "creep_compliance":
        values = values / factor
    elif quantity != "loss_tangent":
        values = values * factor / 2.0  # the factor of 1/G is 2
    return Points(quantity, given["what"], places, values, float(given["tolerance"]))


def _compliance_factor(data: str, poisson_ratio: float | None) -> float:
    """Ratio of a compliance of this convention to Phi."""
    if data == "uniaxial":
        if poisson_ratio is None:
            raise ValueError("data: uniaxial needs a constant poisson_ratio in the material")
        return 1.0 / (1.0 + poisson_ratio)
    return {"deviatoric": 1.0, "shear": 2.0}[data]
