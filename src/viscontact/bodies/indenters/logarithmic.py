"""Logarithmic roller profiles (Lundberg, Johns & Gohar, Fujiwara & Kawase, ISO/TS 16281)."""

from __future__ import annotations

import math
from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.profile import Profile
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import check_fields, positive, real, real_array

#: Profile of ISO/TS 16281: amplitude over roller diameter on short and on long rollers, and largest
#: length of a short roller in diameters; a crown on a long roller takes half of it at either end.
ISO_SHORT, ISO_LONG, ISO_LONGEST_SHORT = 0.00035, 0.0005, 2.5

#: The finite drop of Johns and Gohar: e^(-1/2)/2, to the four digits that they print.
JOHNS_GOHAR = 0.3033


@dataclass(frozen=True)
class LogarithmicProfile(Profile):
    """A logarithmic crown, from the middle or from a straight part on.

    The roller's half length is half of the whole.

    Parameters
    ----------
    amplitude : float
        Factor A of the logarithm [m]. Under the line load w = π E* A the pressure of a roller
        without straight part is even over its length.
    crown_ratio : float, optional
        Part c of the half length that either crown takes, above 0 and at most 1; the rest is
        straight.
    end_drop : float, optional
        Drop z_m at the end [m]; the line falls without end there when left out.

    Raises
    ------
    ValueError
        If a length is not a positive, finite number, or the ratio not within its bounds.

    Notes
    -----
    With u = (|x| - (1 - c) L) / (c L) on the crown and L for the half length,

    drop(x) = A ln(1 / (1 - (1 - exp(-z_m / A)) u²)).

    This is the function of Fujiwara & Kawase (2007), c for their K_2 and K_1 within A; that of
    Lundberg (1939) for c = 1 without z_m; that of Johns & Gohar (1981) for c = 1 with theirs.

    Examples
    --------
    >>> crown = LogarithmicProfile(amplitude=1e-6, end_drop=5e-6)
    >>> (1e6 * crown.drop([0.0, 0.5, 1.0], half_length=1.0)).round(4).tolist()
    [0.0, 0.2854, 5.0]
    """

    amplitude: float = field(metadata={"unit": "m"})
    crown_ratio: float = field(default=1.0, metadata={"unit": "1"})
    end_drop: float | None = field(default=None, metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "amplitude", "end_drop")
        check_fields(self, "crown_ratio", check=real)
        if not 0 < self.crown_ratio <= 1:
            raise ValueError(
                "LogarithmicProfile: crown_ratio must be above 0 and at most 1, the part of the "
                f"half length that the crown takes, got {self.crown_ratio!r}"
            )

    @classmethod
    def lundberg(
        cls, half_length: float, force: float, effective_modulus: float
    ) -> LogarithmicProfile:
        """Return the profile whose pressure is even along the roller under a design load.

        Parameters
        ----------
        half_length : float
            Half the length L of the roller [m].
        force : float
            Design load Q [N].
        effective_modulus : float
            E* of the design, 1/E* = (1 - ν_1²)/E_1 + (1 - ν_2²)/E_2 [Pa]; of a creeping body at
            the time for which the pressure is to be even.

        Returns
        -------
        LogarithmicProfile
            Of amplitude Q / (2 π L E*), without end.

        Raises
        ------
        ValueError
            If an argument is not a positive, finite number.

        Notes
        -----
        Lundberg (1939), Forschung auf dem Gebiete des Ingenieurwesens 10, 201-211. An even line
        load w on |x| < L displaces an elastic half-space less at x than in the middle by
        (w / (π E*)) ln(1 / (1 - (x/L)²)), farther from the ends than the contact is wide.

        Examples
        --------
        >>> round(1e6 * LogarithmicProfile.lundberg(5e-3, 1e4, 115e9).amplitude, 4)
        2.7679
        """
        return cls(_design_amplitude(half_length, force, effective_modulus))

    @classmethod
    def johns_gohar(
        cls, radius: float, half_length: float, force: float, effective_modulus: float
    ) -> LogarithmicProfile:
        """Return Lundberg's profile with a drop at the end that can be made.

        Parameters
        ----------
        radius : float
            Effective radius R of the design, 1/R = 1/R_1 + 1/R_2: of the roller on a plane [m].
        half_length, force, effective_modulus : float
            As for `lundberg`.

        Returns
        -------
        LogarithmicProfile
            With a finite drop at the end.

        Raises
        ------
        ValueError
            If an argument is not positive and finite, or the contact would be wider than long.

        Notes
        -----
        Johns & Gohar (1981), Tribology International 14, 131-136:
        drop(x) = A ln(1 / (1 - (1 - 0.3033 b/L) (x/L)²)) with b, the half width of the Hertzian
        line contact, b² = 2 Q R / (π L E*). The number is that of an even, transversely
        Hertzian pressure, A (ln(L/b) + 1/2 + ln 2) at the end.

        Examples
        --------
        >>> crown = LogarithmicProfile.johns_gohar(5e-3, 5e-3, 1e4, 115e9)
        >>> round(1e6 * crown.end_drop, 2)
        11.76
        """
        amplitude = _design_amplitude(half_length, force, effective_modulus)
        radius = _positive("radius", radius, "m")
        half_width = 2 * math.sqrt(radius * amplitude)
        if half_width >= half_length:
            raise ValueError(
                f"LogarithmicProfile: force of {format_quantity(force, 'N', 9)} makes a contact "
                f"wider than the roller is long, 2b = {format_quantity(2 * half_width, 'm', 3)}; "
                "it is no design load for a line contact"
            )
        return cls(
            amplitude, end_drop=-amplitude * math.log(JOHNS_GOHAR * half_width / half_length)
        )

    @classmethod
    def fujiwara_kawase(
        cls,
        half_length: float,
        force: float,
        effective_modulus: float,
        load_factor: float,
        crown_ratio: float,
        end_drop: float,
    ) -> LogarithmicProfile:
        """Return the profile of Fujiwara and Kawase, with their three parameters.

        Parameters
        ----------
        half_length, force, effective_modulus : float
            As for `lundberg`.
        load_factor : float
            K_1, by which the design load is multiplied, to allow for tilt [-].
        crown_ratio : float
            K_2, the part of the half length that either crown takes [-].
        end_drop : float
            z_m, the drop at the end of the effective length [m].

        Returns
        -------
        LogarithmicProfile
            Of the amplitude K_1 Q / (2 π L E*).

        Raises
        ------
        ValueError
            If an argument is not a positive, finite number, or the ratio is above one.

        Notes
        -----
        Fujiwara & Kawase (2007), Logarithmic profiles of rollers in roller bearings and
        optimization of the profiles, NTN Technical Review 75, 140-148. Built on their abstract's
        words for the three parameters; with K_1 = K_2 = 1 and the drop of Johns & Gohar it is the
        profile of these.

        Examples
        --------
        >>> crown = LogarithmicProfile.fujiwara_kawase(5e-3, 1e4, 115e9, 1.5, 0.6, 20e-6)
        >>> round(1e6 * crown.amplitude, 4), crown.crown_ratio
        (4.1519, 0.6)
        """
        factor = _positive("load_factor", load_factor, "1")
        amplitude = factor * _design_amplitude(half_length, force, effective_modulus)
        return cls(amplitude, crown_ratio, end_drop)

    @classmethod
    def iso_16281(cls, radius: float, half_length: float) -> LogarithmicProfile:
        """Return the reference profile of cylindrical rollers in ISO/TS 16281.

        Parameters
        ----------
        radius : float
            Radius of the roller, half of D_we [m].
        half_length : float
            Half of the effective length L_we [m].

        Returns
        -------
        LogarithmicProfile
            From the middle on; longer rollers than 2.5 diameters over 1.25 at either end.

        Raises
        ------
        ValueError
            If a length is not a positive, finite number.

        Notes
        -----
        For L_we <= 2.5 D_we: 0.00035 D_we ln(1 / (1 - (2 x / L_we)²)); for longer rollers zero
        for |x| <= (L_we - 2.5 D_we)/2 and beyond
        0.0005 D_we ln(1 / (1 - ((2 |x| - (L_we - 2.5 D_we)) / (2.5 D_we))²)). Taken from
        programs that transcribe the standard (its eqs. 42 and 43), not from the standard itself;
        that of tapered rollers is another.

        Examples
        --------
        >>> LogarithmicProfile.iso_16281(radius=5e-3, half_length=6e-3).amplitude * 1e6
        3.5
        """
        radius = _positive("radius", radius, "m")
        half_length = _positive("half_length", half_length, "m")
        longest = ISO_LONGEST_SHORT * radius
        if half_length <= longest:
            return cls(2 * radius * ISO_SHORT)
        return cls(2 * radius * ISO_LONG, crown_ratio=longest / half_length)

    @property
    def _remainder(self) -> float:
        """exp(-z_m / A), zero where the line falls without end."""
        return 0.0 if self.end_drop is None else math.exp(-self.end_drop / self.amplitude)

    def drop(self, x: ArrayLike, half_length: float) -> Floats:
        """Return the drop of the logarithmic crown; see `Profile.drop`."""
        distance, crown = np.abs(real_array("x", x, "m")), self.crown_ratio * half_length
        u = np.clip((distance - (half_length - crown)) / crown, 0.0, 1.0)
        to_end = np.clip((half_length - distance) / crown, 0.0, 1.0)
        last = self._remainder
        # 1 - (1 - e) u², near u = 0 and near u = 1 without cancellation.
        inner = -np.log1p((last - 1) * np.minimum(u, 0.5) ** 2)
        with np.errstate(divide="ignore"):
            outer = -np.log(last * u**2 + to_end * (1 + u))
        drop = self.amplitude * np.where(u < 0.5, inner, outer)
        return np.where(distance <= half_length, drop, np.inf)

    def end(self, half_length: float) -> float:
        """Return the half length [m]."""
        return half_length

    def curvature(self, half_length: float) -> float:
        """Return the curvature in the middle, zero with a straight part [1/m]."""
        if self.crown_ratio < 1:
            return 0.0
        return 2 * self.amplitude * (1 - self._remainder) / half_length**2


def _design_amplitude(half_length: object, force: object, effective_modulus: object) -> float:
    """A = w / (π E*) under the design load's mean over the length [m]."""
    half_length = _positive("half_length", half_length, "m")
    force = _positive("force", force, "N")
    modulus = _positive("effective_modulus", effective_modulus, "Pa")
    return force / (2 * math.pi * half_length * modulus)


def _positive(name: str, value: object, unit: str) -> float:
    return positive(f"LogarithmicProfile: {name}", value, unit)
