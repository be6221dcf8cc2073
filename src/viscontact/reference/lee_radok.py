"""Lee-Radok solution of a growing viscoelastic contact of a sphere.

The law is given by two callables, convolution inverses of each other: the creep compliance J(t)
[1/Pa], which replaces 1/E*, and the relaxation modulus M(t) [Pa], which replaces E*.

"""

from __future__ import annotations

import math

import numpy as np

from viscontact.reference.growing_load import RampedLoad, SuddenLoad
from viscontact.reference.hereditary import TimeFunction, evaluate
from viscontact.reference.lee_radok_contact import LeeRadokContact
from viscontact.reference.values import require_positive


def lee_radok_step(
    force: float,
    radius: float,
    creep_compliance: TimeFunction,
    relaxation_modulus: TimeFunction,
) -> LeeRadokContact:
    """Contact of a sphere with a viscoelastic half-space under a suddenly applied, constant force.

    Parameters
    ----------
    force : float
        Load from time 0 on, positive into the half-space [N].
    radius : float
        Radius of the sphere [m].
    creep_compliance : callable
        Contact compliance J(t), taking an array of times [s], giving [1/Pa]; (1 - ν) Phi(t)
        for a constant Poisson's ratio. J(0) > 0, since the load jumps.
    relaxation_modulus : callable
        M(t), its convolution inverse, s² L[J] L[M] = 1, so that J(0) M(0) = 1 [Pa].

    Returns
    -------
    LeeRadokContact
        Contact radius, approach and pressure by radius and time.

    Raises
    ------
    ValueError
        If force or radius is not positive and finite, or J and M do not fit each other at 0.

    Notes
    -----
    a³ = (3 R/4) F J(t); p by `LeeRadokContact.pressure`.

    References
    ----------
    E. H. Lee and J. R. M. Radok, J. Appl. Mech. 27 (1960) 438-444.

    Examples
    --------
    >>> creep, relaxation = lambda t: (1 + t / 60) / 2e9, lambda t: 2e9 * np.exp(-t / 60)
    >>> contact = lee_radok_step(10.0, 0.01, creep, relaxation)
    >>> print(f"{contact.pressure(0.0, 60.0) / 1e6:.4f} MPa")
    22.4222 MPa
    """
    require_positive("N", force=force)
    require_positive("m", radius=radius)
    instant = _require_inverse(creep_compliance, relaxation_modulus)
    if instant == 0:
        raise ValueError(
            "creep_compliance: wanted J(0) > 0 under a sudden load, got 0; use lee_radok_ramp"
        )
    return LeeRadokContact(SuddenLoad(force), radius, creep_compliance, relaxation_modulus)


def lee_radok_ramp(
    force: float,
    duration: float,
    radius: float,
    creep_compliance: TimeFunction,
    relaxation_modulus: TimeFunction,
) -> LeeRadokContact:
    """Contact of a sphere with a viscoelastic half-space under a ramped, then held force.

    Parameters
    ----------
    force : float
        Load held after the ramp, positive into the half-space [N].
    duration : float
        Time of the rise from zero [s].
    radius : float
        Radius of the sphere [m].
    creep_compliance : callable
        Contact compliance J(t), taking an array of times [s], giving [1/Pa]; J(0) may be 0.
    relaxation_modulus : callable
        M(t), its convolution inverse, s² L[J] L[M] = 1; where J(0) = 0 it must grow without
        bound towards t = 0, and integrably [Pa].

    Returns
    -------
    LeeRadokContact
        Contact radius, approach and pressure by radius and time.

    Raises
    ------
    ValueError
        If force, duration or radius is not positive and finite, or J and M do not fit each
        other at 0 (a Kelvin-Voigt body's M holds an impulse that no callable can give).

    Notes
    -----
    a³ = (3 R F/(4 T)) integral of J over [max(t - T, 0), t].

    References
    ----------
    E. H. Lee and J. R. M. Radok, J. Appl. Mech. 27 (1960) 438-444.

    Examples
    --------
    >>> creep, relaxation = lambda t: (1 + t / 60) / 2e9, lambda t: 2e9 * np.exp(-t / 60)
    >>> contact = lee_radok_ramp(10.0, 30.0, 0.01, creep, relaxation)
    >>> print(f"{contact.contact_radius(30.0) * 1e3:.6f} mm")
    0.360562 mm
    """
    require_positive("N", force=force)
    require_positive("s", duration=duration)
    require_positive("m", radius=radius)
    _require_inverse(creep_compliance, relaxation_modulus)
    load = RampedLoad(force, duration)
    return LeeRadokContact(load, radius, creep_compliance, relaxation_modulus)


def _require_inverse(creep_compliance: TimeFunction, relaxation_modulus: TimeFunction) -> float:
    """Check that J(0) M(0) = 1; return J(0) [1/Pa]."""
    with np.errstate(divide="ignore", invalid="ignore"):
        instant = float(evaluate(creep_compliance, 0.0))
        modulus = float(evaluate(relaxation_modulus, 0.0))
    if instant == 0 and math.isfinite(modulus):
        raise ValueError(
            f"relaxation_modulus: wanted M(0) infinite where J(0) = 0, got {modulus!r} Pa; a "
            "dashpot parallel to the springs gives M an impulse, which this solution cannot take"
        )
    if instant != 0 and not math.isclose(instant * modulus, 1.0, rel_tol=1e-6):
        raise ValueError(
            f"relaxation_modulus: wanted M(0) = 1/J(0), got J(0) M(0) = {instant * modulus!r}; "
            "give the convolution inverse of the creep compliance (2 G is that of Phi)"
        )
    return instant
