"""Bodies in steady motion over a viscoelastic half-space, without friction: Hunter, and limits."""

from __future__ import annotations

import math

from scipy.optimize import brentq
from scipy.special import expit, ive, kve

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.values import require_positive

#: Argument of Bessel functions from which on two terms of their asymptotic series are enough.
LARGE = 1e7


@dataclass(frozen=True)
class MovingCylinder:
    """A long rigid cylinder that rolls or slides at constant speed, without friction.

    Attributes
    ----------
    half_width : float
        Half the width of the contact strip [m].
    offset : float
        Distance of the strip's centre from the axis, positive ahead of it [m].
    friction_coefficient : float
        Resistance of the half-space against the motion over the load [-].
    """

    half_width: float
    offset: float
    friction_coefficient: float


def moving_cylinder(
    force_per_length: float,
    radius: float,
    instant_compliance: float,
    delayed_compliance: float,
    retardation_time: float,
    speed: float,
) -> MovingCylinder:
    """Cylinder on a half-space with one retardation time, in steady motion (Hunter 1961).

    Parameters
    ----------
    force_per_length : float
        Load on a unit of length [N/m].
    radius : float
        Radius of the cylinder [m].
    instant_compliance, delayed_compliance : float
        J0 and J1 of the contact compliance J(t) = J0 + J1 (1 - exp(-t/λ)) [1/Pa].
    retardation_time : float
        λ [s].
    speed : float
        Speed V of the cylinder across its axis [m/s].

    Returns
    -------
    MovingCylinder
        Half width, offset and friction coefficient.

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Notes
    -----
    Hunter's equations for the half width a and the offset m, with l = V λ, r = 1 + J1/J0 and the
    half width a0 at infinite speed, a0² = 4 F' J0 R/π, can be written with x = a²/a0² as

        l (x - 1) = (a/2) (r - x) [K0(a/l)/K1(a/l) + I2(κ)/I1(κ)],   κ = a r/l,
        m = (a/2) (r/x - 1) K0(a/l)/K1(a/l),
        μ = (a/2R) (r - x) [K0(a/l)/(x K1(a/l)) + I2(κ)/(r I1(κ))].

    All terms are positive, so that no digits cancel at any speed; they do in the original form.

    References
    ----------
    S. C. Hunter, J. Appl. Mech. 28 (1961) 611; I. G. Goryacheva, *Contact Mechanics in Tribology*,
    Kluwer 1998.

    Examples
    --------
    >>> found = moving_cylinder(10.0, 10.0, 1 / 2000, 9 / 2000, 10.0, speed=0.1)
    >>> print(f"{found.half_width:.6f} m, {found.friction_coefficient:.7f}")
    0.423817 m, 0.0384423
    """
    require_positive("N/m", force_per_length=force_per_length)
    require_positive("m", radius=radius)
    require_positive(
        "1/Pa", instant_compliance=instant_compliance, delayed_compliance=delayed_compliance
    )
    require_positive("s", retardation_time=retardation_time)
    require_positive("m/s", speed=speed)
    length, ratio = speed * retardation_time, 1 + delayed_compliance / instant_compliance
    fast = math.sqrt(4 * force_per_length * instant_compliance * radius / math.pi)

    def imbalance(share: float) -> float:
        """Logarithm of the first equation's left side over its right, for ln((x - 1)/(r - x))."""
        half_width = fast * math.sqrt(1 + (ratio - 1) * expit(share))
        both = sum(_bessel_ratios(half_width / length, ratio))
        return share + math.log(2 * length / (half_width * both))

    share = brentq(imbalance, -200.0, 200.0, xtol=1e-14)
    growth, rest = (ratio - 1) * expit(share), (ratio - 1) * expit(-share)
    half_width = fast * math.sqrt(1 + growth)
    ahead, inside = _bessel_ratios(half_width / length, ratio)
    return MovingCylinder(
        half_width=half_width,
        offset=half_width / 2 * rest / (1 + growth) * ahead,
        friction_coefficient=half_width
        / (2 * radius)
        * rest
        * (ahead / (1 + growth) + inside / ratio),
    )


def _bessel_ratios(z: float, ratio: float) -> tuple[float, float]:
    """K0(z)/K1(z) and I2(r z)/I1(r z), from large arguments on by their asymptotic series."""
    inside = ratio * z
    return (
        float(kve(0, z) / kve(1, z)) if z < LARGE else 1 - 1 / (2 * z),
        float(ive(2, inside) / ive(1, inside)) if inside < LARGE else 1 - 3 / (2 * inside),
    )


def slow_friction_coefficient(radius: float, mean_retardation_time: float, speed: float) -> float:
    """Friction coefficient of a body of constant curvature in slow steady motion.

    Parameters
    ----------
    radius : float
        Radius of curvature along the motion, the same over the whole contact [m].
    mean_retardation_time : float
        Σ Ji λi/J(∞) of the contact compliance [s].
    speed : float
        Speed V [m/s].

    Returns
    -------
    float
        Limit of resistance over load as V goes to 0, for a line, a sphere or an ellipse alike [-].

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Notes
    -----
    μ = V Σ Ji λi/(J(∞) R). The displacement of a mode lags by V λi, so that to first order
    F = V Σ Ji λi ∫ (∂p/∂ξ) (∂q/∂ξ) dA, with ∂q/∂ξ = -ξ/(J(∞) R) in contact.

    References
    ----------
    The limit of Hunter's cylinder: S. C. Hunter, J. Appl. Mech. 28 (1961) 611.

    Examples
    --------
    >>> print(f"{slow_friction_coefficient(10.0, 9.0, speed=0.001):.5f}")
    0.00090
    """
    require_positive("m", radius=radius)
    require_positive("s", mean_retardation_time=mean_retardation_time)
    require_positive("m/s", speed=speed)
    return speed * mean_retardation_time / radius


def fast_sphere_friction_coefficient(
    force: float, radius: float, instant_compliance: float, creep_rate: float, speed: float
) -> float:
    """Friction coefficient of a sphere in fast steady motion.

    Parameters
    ----------
    force : float
        Load [N].
    radius : float
        Radius of the sphere (of its paraboloid) [m].
    instant_compliance : float
        J0 [1/Pa].
    creep_rate : float
        Initial rate of the contact compliance, J'(0) = Σ Ji/λi + fluidity [1/(Pa s)].
    speed : float
        Speed V [m/s].

    Returns
    -------
    float
        Resistance over load to first order in 1/V [-].

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Notes
    -----
    μ = (4/5) (J'(0)/J0) a²/(R V), with a³ = 3 W J0 R/4 of Hertz. In fast motion the memory of a
    mode, Ei q, vanishes, and the dissipation is F V = J'(0) ∫ p q dA. To first order p is that of
    the elastic contact, with J0 q = (a² - ρ²/2)/R inside; its mean under p is (4/5) a²/R.

    References
    ----------
    K. L. Johnson, *Contact Mechanics*, Cambridge 1985, eqs. 4.22 to 4.24 (Hertz).

    Examples
    --------
    >>> print(f"{fast_sphere_friction_coefficient(10.0, 10.0, 5e-4, 4.5e-4, speed=10.0):.4e}")
    8.0665e-04
    """
    require_positive("N", force=force)
    require_positive("m", radius=radius)
    require_positive("1/Pa", instant_compliance=instant_compliance)
    require_positive("1/(Pa s)", creep_rate=creep_rate)
    require_positive("m/s", speed=speed)
    square = math.pow(3 * force * instant_compliance * radius / 4, 2 / 3)
    return 4 / 5 * creep_rate / instant_compliance * square / (radius * speed)


def moving_wave_resistance(amplitude: float, wavelength: float, loss_modulus: float) -> float:
    """Resistance of a half-space against a wavy body in full contact and steady motion.

    Parameters
    ----------
    amplitude, wavelength : float
        D and λ of the body's gap D (1 - cos(k x)), k = 2π/λ [m].
    loss_modulus : float
        M'' = Im(1/J*), the loss part of the contact modulus at the angular frequency k V [Pa].

    Returns
    -------
    float
        Force against the motion over area, k² D² M''/4 [Pa].

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Notes
    -----
    In full contact the displacement is the wave itself, and the pressure (k/2) D times the complex
    contact modulus; the force is the mean of pressure times slope.

    References
    ----------
    K. L. Johnson, *Contact Mechanics*, Cambridge 1985, eq. 13.7 (the wave on a half-space).

    Examples
    --------
    >>> round(moving_wave_resistance(1e-6, 1e-3, loss_modulus=1e9), 3)
    9869.604
    """
    require_positive("m", amplitude=amplitude, wavelength=wavelength)
    require_positive("Pa", loss_modulus=loss_modulus)
    return (2 * math.pi / wavelength * amplitude) ** 2 * loss_modulus / 4
