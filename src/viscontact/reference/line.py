"""Hertz's line contact: a long cylinder on an elastic half-space, in plane strain."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array


@dataclass(frozen=True)
class LineContact:
    """A long cylinder pressed along its length on an elastic half-space.

    Its approach is undefined: in plane strain the half-space sinks without bound.

    Attributes
    ----------
    force_per_length : float
        Load on a unit of length, positive into the half-space [N/m].
    half_width : float
        Half the width of the contact strip, along y [m].
    peak_pressure : float
        Pressure on the centre line, positive in compression [Pa].
    """

    force_per_length: float
    half_width: float
    peak_pressure: float

    def pressure(self, y: ArrayLike) -> Values:
        """Contact pressure, positive in compression [Pa].

        Parameters
        ----------
        y : array_like
            Distance from the centre line [m].

        Returns
        -------
        float or ndarray
            p0 sqrt(1 - y²/b²), zero outside the strip (Johnson 1985, eq. 4.44) [Pa].

        Examples
        --------
        >>> print(f"{hertz_line(1e5, 0.005, 2e9).pressure(0.0) / 1e6:.4f} MPa")
        112.8379 MPa
        """
        square = (real_array("y", y, "m") / self.half_width) ** 2
        p: Values = self.peak_pressure * np.sqrt(np.maximum(1 - square, 0.0))
        return p


def hertz_line(force_per_length: float, radius: float, contact_modulus: float) -> LineContact:
    """Contact of a long cylinder, its axis along x, with a half-space.

    Parameters
    ----------
    force_per_length : float
        Load on a unit of length, positive into the half-space [N/m].
    radius : float
        Radius of the cylinder [m].
    contact_modulus : float
        E* [Pa].

    Returns
    -------
    LineContact
        Half width, peak pressure and the pressure across the strip.

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Notes
    -----
    b² = 4 F' R / (π E*), p0 = 2 F' / (π b).

    References
    ----------
    K. L. Johnson, *Contact Mechanics*, Cambridge 1985, eqs. 4.43-4.45.

    Examples
    --------
    >>> contact = hertz_line(force_per_length=1e5, radius=0.005, contact_modulus=2e9)
    >>> print(f"{contact.half_width * 1e3:.6f} mm")
    0.564190 mm
    """
    require_positive("N/m", force_per_length=force_per_length)
    require_positive("m", radius=radius)
    require_positive("Pa", contact_modulus=contact_modulus)
    half_width = math.sqrt(4 * force_per_length * radius / (math.pi * contact_modulus))
    return LineContact(
        force_per_length=force_per_length,
        half_width=half_width,
        peak_pressure=2 * force_per_length / (math.pi * half_width),
    )
