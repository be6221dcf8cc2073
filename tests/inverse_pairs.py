"""Laws as pairs of a creep compliance J and its convolution inverse M, in closed form."""

import itertools

import numpy as np
from scipy.optimize import brentq
from scipy.special import gamma

MODULUS = 2e9


def maxwell(tau):
    """J and M of a Maxwell body."""
    return (lambda t: (1 + t / tau) / MODULUS), (lambda t: MODULUS * np.exp(-t / tau))


def series(instant, amplitudes, times):
    """J and M of a solid with delayed compliances.

    With f(s) = s L[J] = J0 + sum J_i/(1 + s tau_i), M = 1/f(0) + sum exp(s_k t)/(s_k f'(s_k))
    over the zeros s_k, one below each pole -1/tau_i.
    """
    amplitudes, times = np.array(amplitudes), np.array(times)

    def transform(s):
        return instant + np.sum(amplitudes / (1 + s * times))

    rates = np.sort(1 / times)
    bounds = [*rates, rates[-1] * (2 + np.sum(amplitudes) / instant)]
    zeros = np.array(
        [
            -brentq(
                lambda rate: transform(-rate), low * (1 + 1e-12), high * (1 - 1e-12), rtol=1e-15
            )
            for low, high in itertools.pairwise(bounds)
        ]
    )
    slopes = [-np.sum(amplitudes * times / (1 + s * times) ** 2) for s in zeros]
    moduli = 1 / (zeros * np.array(slopes))
    equilibrium = 1 / (instant + amplitudes.sum())

    def creep(t):
        return instant + np.sum(amplitudes * -np.expm1(-t[:, None] / times), axis=1)

    def relaxation(t):
        return equilibrium + np.sum(moduli * np.exp(zeros * t[:, None]), axis=1)

    return creep, relaxation


def power_law(exponent):
    """J = t^n/E and its inverse M = E t^-n/(Gamma(1+n) Gamma(1-n))."""
    scale = MODULUS / (gamma(1 + exponent) * gamma(1 - exponent))

    def relaxation(t):
        with np.errstate(divide="ignore"):
            return scale * t**-exponent

    return (lambda t: t**exponent / MODULUS), relaxation
