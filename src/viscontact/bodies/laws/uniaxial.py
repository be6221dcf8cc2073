"""Conversion of tensile compliances D and moduli E to shear, by ν or K."""

from __future__ import annotations

from typing import NamedTuple

from viscontact.bodies.laws.parameter_checks import compressibility
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import positive


class Uniaxial(NamedTuple):
    """Conversion Phi(t) = factor (D(t) - volumetric) of a tensile compliance D."""

    # With a constant Poisson's ratio, Phi = (1 + ν) D. With an elastic bulk modulus K, D = (2/3)
    # Phi + 1/(9K), so Phi = (3/2) (D - 1/(9K)): the volumetric part is instant.

    factor: float
    volumetric: float

    def instant(self, owner: str, compliance: float) -> float:
        """Return Phi(0) [1/Pa] from D(0) [1/Pa]."""
        if compliance < self.volumetric:
            most = f" = {format_quantity(1 / (9 * compliance), 'Pa', 6)}" if compliance else ""
            raise ValueError(
                f"{owner}: bulk_modulus {format_quantity(1 / (9 * self.volumetric), 'Pa', 6)} is "
                "too small: an instant tensile compliance of "
                f"{format_quantity(compliance, '1/Pa', 6)} needs a bulk modulus of at least 1/(9 "
                f"D(0)){most}"
            )
        return self.factor * (compliance - self.volumetric)

    def spring(self, owner: str, name: str, modulus: float) -> float:
        """Return the shear modulus [Pa] of the instant spring from its tensile one [Pa]."""
        compliance = self.instant(owner, 1.0 / positive(f"{owner}: {name}", modulus, "Pa"))
        if compliance == 0:
            raise ValueError(
                f"{owner}: bulk_modulus leaves no instant shear compliance: it must be above "
                f"{name}/9 = {format_quantity(modulus / 9, 'Pa', 6)}"
            )
        return 0.5 / compliance

    def delayed(self, owner: str, name: str, value: float, unit: str = "Pa") -> float:
        """Return a shear modulus [Pa] or viscosity [Pa s] from its tensile one."""
        return positive(f"{owner}: {name}", value, unit) / (2 * self.factor)


def uniaxial(owner: str, poisson_ratio: float | None, bulk_modulus: float | None) -> Uniaxial:
    """Return the conversion for a Poisson's ratio or a bulk modulus [Pa], whichever is given."""
    poisson_ratio, bulk_modulus = compressibility(owner, poisson_ratio, bulk_modulus)
    if poisson_ratio is not None:
        return Uniaxial(1.0 + poisson_ratio, 0.0)
    assert bulk_modulus is not None  # exactly one is given
    return Uniaxial(1.5, 1.0 / (9.0 * bulk_modulus))
