"""Periodic contact of wavy surfaces: Westergaard's straight waves, full contact of crossed waves.

On a creeping body under a suddenly applied pressure the contact grows: its width and the approach
are those of the elastic solution with 1/J(t) in place of the contact modulus E*, and it is full as
soon as that solution's is (Lee & Radok 1960, J. Appl. Mech. 27, 438). Its pressure is not the
elastic one of that instant, but tends to it where J becomes constant.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array


@dataclass(frozen=True)
class WavyContact:
    """A surface of straight waves, Δ (1 - cos(2π x/λ)), pressed on an elastic half-space.

    Attributes
    ----------
    mean_pressure : float
        Load over area, positive in compression [Pa].
    full_pressure : float
        Mean pressure from which on the contact is full [Pa].
    wavelength : float
        Distance from crest to crest λ [m].
    amplitude : float
        Half the height from trough to crest Δ [m].
    """

    mean_pressure: float
    full_pressure: float
    wavelength: float
    amplitude: float

    @property
    def ratio(self) -> float:
        """Mean pressure over that of full contact, at most 1 [-]."""
        return min(self.mean_pressure / self.full_pressure, 1.0)

    @property
    def half_width(self) -> float:
        """Half the width of a contact strip: sin²(π a/λ) = p̄/p* [m]."""
        return self.wavelength / math.pi * math.asin(math.sqrt(self.ratio))

    @property
    def peak_pressure(self) -> float:
        """Pressure on the crests [Pa]."""
        if self.mean_pressure >= self.full_pressure:
            return self.mean_pressure + self.full_pressure
        return 2 * math.sqrt(self.mean_pressure * self.full_pressure)

    @property
    def approach(self) -> float:
        """Approach of the waves to the mean plane of the surface, Δ r (1 - ln r), r = p̄/p* [m].

        By integration: an increment of pressure acts as flat punches at distance λ do, whose
        stiffness is dp̄/dδ = -π E*/(2 λ ln sin(π a/λ)).
        """
        return self.amplitude * self.ratio * (1 - math.log(self.ratio))

    def pressure(self, x: ArrayLike) -> Values:
        """Contact pressure, positive in compression [Pa].

        Parameters
        ----------
        x : array_like
            Distance from a crest across the waves [m].

        Returns
        -------
        float or ndarray
            2 p̄ cos(π x/λ) sqrt(sin²ψ - sin²(π x/λ))/sin²ψ with ψ = π a/λ, zero outside the strips;
            p̄ + p* cos(2π x/λ) in full contact [Pa].

        Examples
        --------
        >>> contact = westergaard(1e6, amplitude=1e-6, wavelength=1e-3, contact_modulus=1e9)
        >>> print(f"{contact.pressure(0.0) / 1e6:.4f} MPa")
        3.5449 MPa
        """
        angle = math.pi * real_array("x", x, "m") / self.wavelength
        if self.mean_pressure >= self.full_pressure:
            full: Values = self.mean_pressure + self.full_pressure * np.cos(2 * angle)
            return full
        root = np.sqrt(np.maximum(self.ratio - np.sin(angle) ** 2, 0.0))
        p: Values = 2 * self.full_pressure * np.abs(np.cos(angle)) * root
        return p


def westergaard(
    mean_pressure: float, amplitude: float, wavelength: float, contact_modulus: float
) -> WavyContact:
    """Contact of a surface of straight waves with a half-space.

    Parameters
    ----------
    mean_pressure : float
        Load over area, positive in compression [Pa].
    amplitude : float
        Half the height from trough to crest [m].
    wavelength : float
        Distance from crest to crest [m].
    contact_modulus : float
        E* [Pa].

    Returns
    -------
    WavyContact
        Half width of the strips, approach, and pressure.

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    References
    ----------
    H. M. Westergaard, J. Appl. Mech. 6 (1939) 49; K. L. Johnson, *Contact Mechanics*, Cambridge
    1985, section 13.2.

    Examples
    --------
    A quarter of the pressure of full contact, and sin(π a/λ) is a half:

    >>> full = full_contact_pressure(1e-6, 1e9, wavelength_x=1e-3)
    >>> contact = westergaard(full / 4, amplitude=1e-6, wavelength=1e-3, contact_modulus=1e9)
    >>> print(f"{contact.half_width * 1e3:.6f} mm")
    0.166667 mm
    """
    require_positive("Pa", mean_pressure=mean_pressure)
    full = full_contact_pressure(amplitude, contact_modulus, wavelength_x=wavelength)
    return WavyContact(mean_pressure, full, wavelength, amplitude)


def full_contact_pressure(
    amplitude: float,
    contact_modulus: float,
    *,
    wavelength_x: float = math.inf,
    wavelength_y: float = math.inf,
) -> float:
    """Mean pressure of full contact with waves Δ cos(2π x/λ_x) cos(2π y/λ_y), straight or crossed.

    Parameters
    ----------
    amplitude : float
        Δ, half the height from the deepest to the highest point [m].
    contact_modulus : float
        E* [Pa].
    wavelength_x, wavelength_y : float, optional
        Distances from crest to crest along x and y; one of them may be infinite [m].

    Returns
    -------
    float
        p* = E* Δ |q|/2, |q| = 2π sqrt(1/λ_x² + 1/λ_y²) [Pa].

    Raises
    ------
    ValueError
        If amplitude or modulus is not positive and finite, or a wavelength not positive, or both
        are infinite.

    Notes
    -----
    A pressure p* cos(...) cos(...) displaces the surface by 2 p*/(|q| E*) cos(...) cos(...); the
    mean pressure must be p* for that sum to be compression everywhere. With λ_x = λ_y it is
    sqrt(2) π E* Δ/λ.

    References
    ----------
    K. L. Johnson, J. A. Greenwood, J. G. Higginson, Int. J. Mech. Sci. 27 (1985) 383.

    Examples
    --------
    >>> print(f"{full_contact_pressure(1e-6, 1e9, wavelength_x=1e-3, wavelength_y=1e-3):.0f} Pa")
    4442883 Pa
    """
    require_positive("m", amplitude=amplitude)
    require_positive("Pa", contact_modulus=contact_modulus)
    for name, length in (("wavelength_x", wavelength_x), ("wavelength_y", wavelength_y)):
        if not length > 0:
            raise ValueError(f"{name} must be a positive number in m, got {length!r}")
    waves = math.hypot(1 / wavelength_x, 1 / wavelength_y)
    if waves == 0:
        raise ValueError("wavelength_x, wavelength_y: one of them must be finite [m]")
    return math.pi * contact_modulus * amplitude * waves
