"""Filon's rule: integrals of a function times an oscillation, of any frequency."""

from __future__ import annotations

import numpy as np
from numpy.polynomial.legendre import leggauss, legvander

from viscontact.backend.arrays import Complexes, Floats
from viscontact.mechanics.halfspace.bessel_functions import spherical_bessel


def panel_nodes(edges: Floats, nodes: int) -> tuple[Floats, Floats]:
    """Gauss nodes on panels between edges, panel by panel, and their weights."""
    places, weights = leggauss(nodes)
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges)[:, None] / 2
    return (middle[:, None] + half * places).ravel(), (half * weights).ravel()


def oscillation_weights(edges: Floats, nodes: int, frequencies: Floats) -> Complexes:
    """Weights of ∫ f(x) exp(i ω x) dx at the Gauss nodes of panels; (frequencies, nodes)."""
    # f is a sum of Legendre polynomials over each panel, which have spherical Bessel functions as
    # transforms (Abramowitz & Stegun, eq. 10.1.14).
    places, weights = leggauss(nodes)
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    orders = np.arange(nodes)
    expansion = (2 * orders + 1) * legvander(places, nodes - 1) * weights[:, None]
    bessel = spherical_bessel(nodes, np.abs(frequencies)[:, None] * half)
    phase = np.exp(1j * np.abs(frequencies)[:, None] * middle)[..., None] * 1j**orders
    found = np.einsum("pwn,mn->pwm", phase * bessel, expansion) * half[:, None]
    found = found.reshape(len(frequencies), -1)
    return np.asarray(np.where((frequencies < 0)[:, None], found.conj(), found))
