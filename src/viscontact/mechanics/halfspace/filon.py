"""Filon's rule: integrals of a function times an oscillation, of any frequency."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.polynomial.legendre import leggauss, legvander

from viscontact.backend.arrays import Complexes, Floats
from viscontact.mechanics.halfspace.bessel_functions import spherical_bessel


@lru_cache(maxsize=16)
def gauss_rule(count: int) -> tuple[Floats, Floats]:
    """Places and weights of Gauss's rule on [-1, 1], which are found once for each count."""
    places, weights = leggauss(count)
    places.flags.writeable = weights.flags.writeable = False
    return places, weights


def panel_nodes(edges: Floats, nodes: int) -> tuple[Floats, Floats]:
    """Gauss nodes on panels between edges, panel by panel, and their weights."""
    places, weights = gauss_rule(nodes)
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges)[:, None] / 2
    return (middle[:, None] + half * places).ravel(), (half * weights).ravel()


def oscillation_weights(edges: Floats, nodes: int, frequencies: Floats) -> Complexes:
    """Weights of ∫ f(x) exp(i ω x) dx at the Gauss nodes of panels; (frequencies, nodes)."""
    even, odd, angle = _about_middles(edges, nodes, np.abs(frequencies))
    sine, cosine = np.sin(angle), np.cos(angle)
    found = np.empty(even.shape, np.complex128)
    found.real, found.imag = cosine * even - sine * odd, sine * even + cosine * odd
    lines = found.reshape(len(frequencies), -1)
    return np.asarray(np.where((frequencies < 0)[:, None], lines.conj(), lines))


def cosine_weights(edges: Floats, nodes: int, frequencies: Floats) -> Floats:
    """Weights of ∫ f(x) cos(ω x) dx at the Gauss nodes of panels, ω >= 0; (frequencies, nodes)."""
    even, odd, angle = _about_middles(edges, nodes, frequencies)
    even *= np.cos(angle)
    odd *= np.sin(angle)
    even -= odd
    return even.reshape(len(frequencies), -1)


def _about_middles(edges: Floats, nodes: int, frequencies: Floats) -> tuple[Floats, Floats, Floats]:
    """Weights for cos and sin of ω (x - m), m in the middle of a panel, and ω m.

    Shape (frequencies, panels, nodes); of ω m (frequencies, panels, 1).
    """
    # f is a sum of Legendre polynomials over each panel, which have spherical Bessel functions as
    # transforms (Abramowitz & Stegun, eq. 10.1.14), times i^n: even ones are real, odd ones not.
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    bessel = spherical_bessel(nodes, frequencies[:, None] * half) * half[:, None]
    expansion = _expansion(nodes)
    even, odd = (bessel[..., first::2] @ expansion[first::2] for first in (0, 1))
    return even, odd, (frequencies[:, None] * middle)[..., None]


@lru_cache(maxsize=4)
def _expansion(nodes: int) -> Floats:
    """Legendre coefficients of values at Gauss nodes, times 2 i^n over i or 1; (orders, nodes)."""
    places, weights = gauss_rule(nodes)
    orders = np.arange(nodes)
    signs = np.array([1.0, 1.0, -1.0, -1.0])[orders % 4]
    expansion = signs * (2 * orders + 1) * legvander(places, nodes - 1) * weights[:, None]
    return np.asarray(expansion.T)
