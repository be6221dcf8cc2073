"""Flat punch on a viscoelastic half-space: constant contact area."""

from __future__ import annotations

import cmath
import math

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.hereditary import TimeFunction, evaluate
from viscontact.reference.values import Values, require_positive
from viscontact.units.numbers import real_array


@dataclass(frozen=True)
class PunchOscillation:
    """Steady oscillation of a flat punch, without the initial transient.

    Attributes
    ----------
    force_amplitude, approach_amplitude : float
        Amplitudes about the means [N], [m].
    phase_lag : float
        Angle by which the approach lags behind the force, 0 to π/2 [rad].
    loss_per_cycle : float
        Work the load does in each cycle, all of it lost [J].

    Examples
    --------
    >>> steady = punch_harmonic(0.005, 5e-10 * (1 - 0.2j), force_amplitude=10.0)
    >>> round(steady.phase_lag, 4), steady.force_amplitude
    (0.1974, 10.0)
    """

    force_amplitude: float
    approach_amplitude: float
    phase_lag: float
    loss_per_cycle: float


def punch_harmonic(
    radius: float,
    complex_compliance: complex,
    *,
    force_amplitude: float | None = None,
    approach_amplitude: float | None = None,
) -> PunchOscillation:
    """Steady oscillation of a round flat punch that never lifts off.

    Parameters
    ----------
    radius : float
        Radius of the punch [m].
    complex_compliance : complex
        J*(ω) = J' - i J'', i ω times the Fourier transform of the contact compliance
        J(t), at the frequency of the oscillation [1/Pa].
    force_amplitude : float, optional
        Amplitude of the force [N].
    approach_amplitude : float, optional
        Amplitude of the approach instead [m]. Exactly one of the two.

    Returns
    -------
    PunchOscillation
        Both amplitudes, the phase lag and the loss per cycle.

    Raises
    ------
    ValueError
        If radius or amplitude is not positive and finite, not one amplitude is given, or J* is
        not in the fourth quadrant.

    Notes
    -----
    w = J* F/(2 a): the amplitudes are in the ratio |J*|/(2 a), the lag is arctan(J''/J') and the
    loss, the area of the loop, π F1² J''/(2 a).

    References
    ----------
    J. D. Ferry, Viscoelastic Properties of Polymers, 3rd ed., Wiley, 1980, chapter 1, for J*;
    I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47-57, for the punch.

    Examples
    --------
    >>> steady = punch_harmonic(0.005, 5e-10 * (1 - 0.2j), force_amplitude=10.0)
    >>> print(f"{steady.approach_amplitude * 1e9:.3f} nm, {steady.loss_per_cycle * 1e6:.4f} uJ")
    509.902 nm, 3.1416 uJ
    """
    require_positive("m", radius=radius)
    storage, loss = complex_compliance.real, -complex_compliance.imag
    if not (storage >= 0 and loss >= 0 and 0 < abs(complex_compliance) < math.inf):
        raise ValueError(
            "complex_compliance: wanted J' - i J'' with J' and J'' >= 0 and finite [1/Pa], got "
            f"{complex_compliance!r}; with exp(i omega t) strain lags, so J'' is subtracted"
        )
    if (force_amplitude is None) == (approach_amplitude is None):
        raise ValueError("punch_harmonic: wanted force_amplitude= or approach_amplitude=, one")
    ratio = abs(complex_compliance) / (2 * radius)
    if force_amplitude is None:
        assert approach_amplitude is not None
        require_positive("m", approach_amplitude=approach_amplitude)
        force_amplitude = approach_amplitude / ratio
    require_positive("N", force_amplitude=force_amplitude)
    return PunchOscillation(
        force_amplitude=force_amplitude,
        approach_amplitude=ratio * force_amplitude,
        phase_lag=-cmath.phase(complex_compliance) + 0.0,
        loss_per_cycle=math.pi * force_amplitude**2 * loss / (2 * radius),
    )


def series_complex_compliance(
    angular_frequency: float,
    instant: float,
    amplitudes: ArrayLike = (),
    times: ArrayLike = (),
    fluidity: float = 0.0,
) -> complex:
    """Complex compliance of J(t) = instant + sum amplitudes (1 - exp(-t/times)) + fluidity t.

    Parameters
    ----------
    angular_frequency : float
        ω [rad/s].
    instant : float
        J(0) [1/Pa].
    amplitudes, times : array_like, optional
        Delayed compliances [1/Pa] and retardation times [s].
    fluidity : float, optional
        Rate of steady flow [1/(Pa s)].

    Returns
    -------
    complex
        J* = instant + sum amplitudes/(1 + i ω times) + fluidity/(i ω) [1/Pa].

    Raises
    ------
    ValueError
        If the frequency is not positive and finite.

    Examples
    --------
    >>> series_complex_compliance(2.0, 1.0, [2.0], [0.5], fluidity=1.0)
    (2-1.5j)
    """
    require_positive("rad/s", angular_frequency=angular_frequency)
    turn = 1j * angular_frequency
    delayed = real_array("amplitudes", amplitudes, "1/Pa") / (
        1 + turn * real_array("times", times, "s")
    )
    return complex(instant + delayed.sum() + fluidity / turn)


def punch_harmonic_start(  # noqa: PLR0913
    t: ArrayLike,
    mean: float,
    amplitude: float,
    angular_frequency: float,
    radius: float,
    instant: float,
    amplitudes: ArrayLike = (),
    times: ArrayLike = (),
    fluidity: float = 0.0,
) -> Values:
    """Approach of a round flat punch under mean + amplitude sin(ω t), from rest at time 0.

    Parameters
    ----------
    t : array_like
        Time since the load began; 0 is just after its jump to the mean [s].
    mean, amplitude : float
        Mean and amplitude of the force; the punch stays in contact while the first is larger
        and the body recovers less than the punch presses [N].
    angular_frequency : float
        ω [rad/s].
    radius : float
        Radius of the punch [m].
    instant, amplitudes, times, fluidity : float, array_like, array_like, float
        J(t) = instant + sum amplitudes (1 - exp(-t/times)) + fluidity t, as in
        `series_complex_compliance`.

    Returns
    -------
    float or ndarray
        Approach, transient included [m].

    Raises
    ------
    ValueError
        If frequency or radius is not positive and finite.

    Notes
    -----
    2 a w = mean J(t) + amplitude integral of J(t - t') ω cos(ω t') dt' over 0 < t' < t,
    where each retardation time contributes, with x = ω τ,
    sin(ω t) - x (cos(ω t) + x sin(ω t) - exp(-t/τ))/(1 + x²), and flow
    (1 - cos(ω t))/ω.

    Examples
    --------
    >>> w = punch_harmonic_start(0.5, 10.0, 5.0, math.pi, 0.005, 5e-10, [5e-10], [0.2])
    >>> print(f"{w * 1e6:.4f} um")
    1.3974 um
    """
    require_positive("rad/s", angular_frequency=angular_frequency)
    require_positive("m", radius=radius)
    now = real_array("t", t, "s")
    sine, cosine = np.sin(angular_frequency * now), np.cos(angular_frequency * now)
    held = instant + fluidity * now
    oscillating = instant * sine + fluidity * (1 - cosine) / angular_frequency
    for compliance, tau in np.broadcast(
        real_array("amplitudes", amplitudes, "1/Pa"), real_array("times", times, "s")
    ):
        x, decayed = angular_frequency * tau, np.exp(-now / tau)
        held = held + compliance * (1 - decayed)
        oscillating = oscillating + compliance * (
            sine - x * (cosine + x * sine - decayed) / (1 + x**2)
        )
    approach: Values = (mean * held + amplitude * oscillating) / (2 * radius)
    return approach


def punch_staircase(
    t: ArrayLike,
    jump_times: ArrayLike,
    forces: ArrayLike,
    radius: float,
    creep_compliance: TimeFunction,
) -> Values:
    """Approach of a round flat punch under a force that changes in jumps.

    Parameters
    ----------
    t : array_like
        Time; at a jump the value just after it [s].
    jump_times, forces : array_like, shape (n,)
        Instants, ascending [s], and the force after each [N]; before the first there is none.
    radius : float
        Radius of the punch [m].
    creep_compliance : callable
        Contact compliance J(t), taking an array of times [s], giving [1/Pa].

    Returns
    -------
    float or ndarray
        Approach; it holds while the punch is in contact, so while no force is 0 [m].

    Raises
    ------
    ValueError
        If the radius is not positive and finite, the instants do not ascend, or a force is
        negative.

    Notes
    -----
    w = sum of dF_i J(t - t_i)/(2 a), Boltzmann's superposition on Sneddon's punch.

    Examples
    --------
    >>> w = punch_staircase([1.0, 3.0], [0.0, 2.0], [10.0, 4.0], 0.005, lambda t: (1 + t) / 2e9)
    >>> print((w * 1e6).round(6))
    [1.  1.4]
    """
    require_positive("m", radius=radius)
    instants = real_array("jump_times", jump_times, "s")
    levels = real_array("forces", forces, "N")
    if not (instants.shape == levels.shape and np.all(np.diff(instants) > 0)):
        raise ValueError(
            "jump_times: wanted ascending instants, as many as forces, got "
            f"{instants.tolist()!r} for {levels.tolist()!r}"
        )
    if levels.min(initial=0.0) < 0:
        raise ValueError(f"forces: wanted 0 N or more, got {levels.tolist()!r}; nothing adheres")
    lags = real_array("t", t, "s")[..., None] - instants
    crept = np.where(lags >= 0, evaluate(creep_compliance, np.maximum(lags, 0.0)), 0.0)
    approach: Values = crept @ np.diff(levels, prepend=0.0) / (2 * radius)
    return approach
