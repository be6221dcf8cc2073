"""Adhesive contacts of cylinders, waves and punches, and the edge of a creeping body.

``compliance`` is the contact compliance 1/E* [1/Pa].
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.values import require_positive

#: Largest ratio of the outer half width of the cohesive zone to that of the contact, for brackets.
_LARGEST_RATIO = 1e6

#: Points of the quadrature over a cohesive zone.
_POINTS = 200


@dataclass(frozen=True)
class AdhesiveLineState:
    """State of an adhering cylinder.

    Attributes
    ----------
    line_load : float
        Force per length, negative in tension [N/m].
    half_width : float
        Half width of the contact [m].
    zone_half_width : float
        Outer half width of the cohesive zone [m].
    """

    line_load: float
    half_width: float
    zone_half_width: float


@dataclass(frozen=True)
class AdhesiveLine:
    """A cylinder that adheres to an elastic half-space along its length, by Dugdale's law.

    Attributes
    ----------
    radius : float
        Radius of the cylinder [m].
    compliance : float
        Contact compliance 1/E* [1/Pa].
    work : float
        Work of adhesion [J/m²].
    range : float
        Range of the attraction, work over strength [m].
    """

    radius: float
    compliance: float
    work: float
    range: float

    def at_half_width(self, half_width: float) -> AdhesiveLineState:
        """State of a half width of the contact, stable or not [m].

        Examples
        --------
        >>> state = adhesive_line(radius=1e-3, compliance=1e-6, work=0.05, range=1e-7)
        >>> print(f"{state.at_half_width(1e-4).line_load:.3f} N/m")
        2.262 N/m
        """
        strength = self.work / self.range
        ratio = self._ratio(half_width, strength)
        hertz = math.pi * half_width**2 / (4 * self.radius * self.compliance)
        pull = 2 * strength * half_width * math.sqrt(ratio**2 - 1)
        return AdhesiveLineState(hertz - pull, half_width, ratio * half_width)

    def _ratio(self, half_width: float, strength: float) -> float:
        """Outer over inner half width of the cohesive zone, whose gap is the range."""

        def lacking(excess: float) -> float:
            m = 1 + excess
            root, angle = math.sqrt(excess * (2 + excess)), math.acosh(m)
            round_body = half_width**2 / (2 * self.radius) * (m * root - angle)
            opened = 4 * strength * half_width * self.compliance / math.pi
            return (round_body + opened * (root * angle - m * math.log(m))) / self.range - 1

        return 1 + float(brentq(lacking, 1e-14, _LARGEST_RATIO, xtol=1e-15, rtol=1e-13))

    @property
    def pull_off(self) -> AdhesiveLineState:
        """State of least force, at which a contact under a given force ends."""
        scale = float(np.cbrt(self.radius**2 * self.work * self.compliance))
        found = minimize_scalar(
            lambda log: self.at_half_width(math.exp(log) * scale).line_load / self.work * scale,
            bounds=(math.log(1e-2), math.log(10.0)),
            method="bounded",
            options={"xatol": 1e-9},
        )
        return self.at_half_width(math.exp(found.x) * scale)


def adhesive_line(radius: float, compliance: float, work: float, range: float) -> AdhesiveLine:
    """Cylinder that is attracted by a constant traction up to a gap.

    Parameters
    ----------
    radius : float
        Radius of the cylinder, or relative radius of two [m].
    compliance : float
        Contact compliance 1/E* [1/Pa].
    work : float
        Work of adhesion [J/m²].
    range : float
        Largest gap of the attraction, of the strength work/range [m].

    Returns
    -------
    AdhesiveLine
        States by half width, and pull-off (J. M. Baney & C.-Y. Hui 1997, J. Adhes. Sci. Technol.
        11, 393).

    Raises
    ------
    ValueError
        If an argument is not positive.

    Notes
    -----
    With the half widths a and c = m a of contact and cohesive zone and the strength σ0 the line
    load is π a²/(4 R J) - 2 σ0 sqrt(c² - a²), and the gap at c is a²/(2 R) (m sqrt(m² - 1) -
    arcosh m) + 4 σ0 a J/π (sqrt(m² - 1) arcosh m - m ln m).

    Examples
    --------
    >>> line = adhesive_line(radius=1e-3, compliance=1e-6, work=0.05, range=1e-8)
    >>> print(f"{line.pull_off.line_load:.3f} N/m")  # JKR: -3/4 (4 π w² E* R)^(1/3)
    -2.367 N/m
    """
    require_positive("m", radius=radius, range=range)
    require_positive("1/Pa", compliance=compliance)
    require_positive("J/m^2", work=work)
    return AdhesiveLine(radius, compliance, work, range)


def adhesive_wave_pressure(
    half_width: float, height: float, wavelength: float, compliance: float, work: float
) -> float:
    """Mean pressure on a wavy surface that adheres at once, by attraction of no range.

    Parameters
    ----------
    half_width : float
        Half width of the contact, below half the wavelength [m].
    height : float
        Amplitude of the waves [m].
    wavelength : float
        Wavelength [m].
    compliance : float
        Contact compliance 1/E* [1/Pa].
    work : float
        Work of adhesion [J/m²].

    Returns
    -------
    float
        π E* Δ/λ sin²(ψ) - sqrt(2 E* w tan(ψ)/λ), ψ = π a/λ (K. L. Johnson 1995, Int. J. Solids
        Struct. 32, 423) [Pa].

    Raises
    ------
    ValueError
        If an argument is not positive, or the half width not below half the wavelength.

    Examples
    --------
    >>> print(f"{adhesive_wave_pressure(2e-4, 1e-6, 1e-3, 1e-6, 1e-4):.0f} Pa")
    704 Pa
    """
    require_positive("m", half_width=half_width, height=height, wavelength=wavelength)
    require_positive("1/Pa", compliance=compliance)
    require_positive("J/m^2", work=work)
    if half_width >= wavelength / 2:
        raise ValueError(
            f"half_width must be below half the wavelength, {wavelength / 2} m, got {half_width}"
        )
    angle = math.pi * half_width / wavelength
    flat = math.pi * height / (compliance * wavelength)
    tension = math.sqrt(2 * work * math.tan(angle) / (compliance * wavelength))
    return flat * math.sin(angle) ** 2 - tension


def adhesive_punch(radius: float, compliance: float, work: float, range: float = 0.0) -> float:
    """Pull-off force of a flat circular punch.

    Parameters
    ----------
    radius : float
        Radius of the punch [m].
    compliance : float
        Contact compliance 1/E* [1/Pa].
    work : float
        Work of adhesion [J/m²].
    range : float, optional
        Largest gap of a constant attraction; 0 for an attraction of no range [m].

    Returns
    -------
    float
        sqrt(8 π a³ w E*) without a range (K. Kendall 1971, J. Phys. D 4, 1186); with one the force
        at which the gap at the edge is the range, by the cohesive zone of Maugis (1992) under a
        body without curvature, π a² w/range at most [N].

    Raises
    ------
    ValueError
        If an argument is not positive.

    Examples
    --------
    >>> print(f"{adhesive_punch(1e-4, 1e-6, 0.05) * 1e3:.3f} mN")
    1.121 mN
    """
    require_positive("m", radius=radius)
    require_positive("1/Pa", compliance=compliance)
    require_positive("J/m^2", work=work)
    if range == 0:
        return math.sqrt(8 * math.pi * radius**3 * work / compliance)
    require_positive("m", range=range)
    strength = work / range

    def opened(inner: float) -> float:
        root, angle = math.sqrt(1 - inner**2), math.acos(inner)
        return 4 * strength * compliance * radius / math.pi * (root * angle + inner - 1)

    if opened(0.0) <= range:
        return math.pi * radius**2 * strength
    inner = float(brentq(lambda each: opened(each) / range - 1, 0.0, 1.0, xtol=1e-15))
    root, angle = math.sqrt(1 - inner**2), math.acos(inner)
    return 2 * strength * radius**2 * (angle + inner * root)


def edge_energy(passage: float, creep: Callable[[Floats], Floats]) -> float:
    """Energy release of an edge that moves over a creeping body, over the work of adhesion.

    Parameters
    ----------
    passage : float
        Time in which the edge passes the cohesive zone of the relaxed body, π w J/(4 strength²)
        over the speed [s].
    creep : callable
        Compliance over time, divided by the relaxed one; takes and returns an array [-].

    Returns
    -------
    float
        From 1 (slow) to the ratio of relaxed and instant compliance (fast), for an edge that
        recedes (R. A. Schapery 1975, Int. J. Fract. 11, 141; J. A. Greenwood 2004, J. Phys. D 37,
        2557) [-].

    Raises
    ------
    ValueError
        If the passage is not positive.

    Notes
    -----
    x = 2/∫₀¹ j((1 - η) x T) ln((1 + sqrt η)/(1 - sqrt η)) dη with the passage T: a zone of constant
    attraction that is x times as wide as that of the relaxed body.

    Examples
    --------
    >>> zener = lambda t: 1 - 0.9 * np.exp(-t)
    >>> print(f"{edge_energy(1e3, zener):.3f} {edge_energy(1.0, zener):.2f}")
    1.004 2.06
    """
    require_positive("s", passage=passage)
    points, weights = np.polynomial.legendre.leggauss(_POINTS)
    roots = 1 - ((1 - points) / 2) ** 2  # sqrt(eta), dense at 1
    weights = weights * (1 - points) / 2 * 2 * roots
    shape = weights * np.log((1 + roots) / (1 - roots))

    def excess(log: float) -> float:
        x = math.exp(log)
        return x * float(shape @ creep((1 - roots**2) * x * passage)) / 2 - 1

    stiffest = float(creep(np.zeros(1))[0])
    most = 60.0 if stiffest == 0 else -math.log(stiffest)
    return math.exp(float(brentq(excess, -1e-3, most + 1e-3, xtol=1e-12)))
