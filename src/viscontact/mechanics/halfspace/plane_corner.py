"""Displacement of the surface of a quarter-plane beyond the mirrored half-plane.

Nothing varies along the end, k = 0, and the body takes x > 0. The map A of `free_end` from the load
on one face to the stress on the other is then a convolution of ln x, without Poisson's ratio. Its
symbol is η/sinh(πη/2) (at η = 0 it is 2/π, as in J. H. Michell's wedge), so that all
images beyond the load itself, at x', have the density

    D(x, x') = (1/2πx) ∫ Â²/(1 - Â²) exp(iη ln(x/x')) dη,   Â = η/sinh(πη/2),

of resultant M = 1/(1 - 4/π²) - 1. Under the half-plane's -(2/π) ln|x² - x'²| of a load and its
image it displaces the surface, per compliance, by

    g(x, x') = -(2/π) M ln(x x'/d²) + (2/π) ∫_0^∞ Â²/(1 - Â²) coth(πη/2)/η cos(ηu) dη

with u = ln(x/x') and the finite part of the integral. The distance d is free: a line load has no
datum. The part M (2/π)/η² exp(-η²) has the finite part -(π/2)|u| erf(|u|/2) - √π exp(-u²/4) times
2M/π, and the rest is summed by Gauss's rule.
"""

from __future__ import annotations

import math

import numpy as np
import scipy  # its special functions are imported at their first use

from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace.filon import panel_nodes

#: Resultant of all images beyond the load, over the load (Michell's wedge).
RESULTANT = 1 / (1 - 4 / math.pi**2) - 1

#: Borders of panels of η, and Gauss nodes in each: the rest falls as exp(-πη) and exp(-η²).
BORDERS, NODES = np.linspace(0.0, 12.0, 13), 16


def added_by_end(x: Floats, load: Floats, datum: float) -> Floats:
    """Displacement g at distances x from the end under unit line loads at others [-].

    In units of compliance times load, with the line load's datum at a distance. The image of the
    load counts in the mirrored half-plane, not here.

    >>> ones = np.ones(1)
    >>> print(f"{added_by_end(ones, ones, 1.0)[0]:.6f}")
    -0.359605
    """
    ratio = np.abs(np.log(x / load))
    eta, weights = panel_nodes(BORDERS, NODES)
    amplitude = RESULTANT * 2 / np.pi
    rest = weights * (_spectrum(eta) - amplitude * np.exp(-(eta**2)) / eta**2)
    summed = np.cos(np.multiply.outer(ratio, eta)) @ rest
    known = ratio * scipy.special.erf(ratio / 2) * np.pi / 2
    known += math.sqrt(math.pi) * np.exp(-(ratio**2) / 4)
    level = RESULTANT * np.log(x / datum * (load / datum))
    return np.asarray(2 / np.pi * (summed - amplitude * known - level))


def _spectrum(eta: Floats) -> Floats:
    """Â²/(1 - Â²) coth(πη/2)/η."""
    sinh, cosh = np.sinh(np.pi * eta / 2), np.cosh(np.pi * eta / 2)
    return np.asarray(eta * cosh / sinh / (sinh**2 - eta**2))
