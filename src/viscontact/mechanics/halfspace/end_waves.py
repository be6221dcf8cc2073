"""Waves along the ends of a body, and their means over cells.

A function that is smooth over the logarithm of the wave number k, times cos k(y - y') and its mean
over a cell, is summed by Filon's rule, so that the body goes on along y beyond the grid.
"""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace import free_end, long_strip, strip
from viscontact.mechanics.halfspace.ended_load import EndedLoad
from viscontact.mechanics.halfspace.filon import oscillation_weights, panel_nodes

#: Nodes of panels of waves along y, whose ends double, and the first of these over the inverse of
#: the grid's extent.
NODES, FIRST_WAVE = 6, 1e-2


@dataclass(frozen=True, eq=False)
class WaveMeans:
    """Waves along y, and weights of their means over cells at places."""

    waves: Floats  # [1/m]
    #: Of cos and sin k(y - y') between distinct offsets, over k; shape (2, waves, offsets) [1].
    integrals: Floats
    places: Floats  # of the offsets of a place from the cells' edges, shape (y, cells + 1)

    @classmethod
    def of(cls, load: EndedLoad, y: Floats) -> WaveMeans:
        """Waves for a load, and places along y [m]."""
        grid, half = load.grid, load.half_length
        extent = max(*grid.size, *(float(face.borders[-1]) for face in load.faces))
        middle = strip.HIGHEST_WAVE / half if half < math.inf else 1 / extent
        lowest, highest = FIRST_WAVE / extent, 2 * free_end.HIGHEST / grid.cell_size[0]
        powers = np.arange(math.floor(math.log2(lowest / middle)), math.log2(highest / middle) + 1)
        borders = middle * 2.0**powers
        waves = panel_nodes(borders, NODES)[0]
        edge = grid.cell_size[1]
        edges = grid.y[0] - edge / 2 + np.arange(grid.shape[1] + 1) * edge
        offsets = np.subtract.outer(y, edges)
        distinct, places = np.unique(np.round(offsets / edge, 9), return_inverse=True)
        distinct = distinct * edge
        weights = oscillation_weights(borders, NODES, distinct).T / waves[:, None]
        # Waves before the first panel count as one of them, whose cosine is 1.
        waves = np.append(borders[0] / math.e, waves)
        sines = np.vstack([borders[0] * distinct, weights.imag])
        cosines = np.vstack([np.zeros(distinct.size), weights.real])
        integrals = np.stack([sines, -cosines]) / np.pi
        longest = long_strip.longest_wave(odd=False) / half
        return cls(*_extrapolated(waves, integrals, longest), places.reshape(offsets.shape))

    def at(self, index: int) -> Floats:
        """Weights of cos and sin of a wave, over the cells; (2, y, cells)."""
        until = self.integrals[:, index][:, self.places]
        return np.asarray(until[:, :, :-1] - until[:, :, 1:])


def _extrapolated(waves: Floats, weights: Floats, longest: float) -> tuple[Floats, Floats]:
    """Waves and their weights, shape (2, waves, ...), with a wave and twice it for longer ones."""
    long = waves < longest
    if not long.any():
        return waves, weights
    pairs = [near_waves(wave, longest) for wave in waves[long].tolist()]
    parts = np.array([[weight for _, weight in pair] for pair in pairs])
    own, other = np.tensordot(parts.T, weights[:, long], axes=(1, 1))
    kept = np.concatenate([np.stack([own, other], axis=1), weights[:, ~long]], axis=1)
    return np.concatenate([longest * np.array([1.0, 2.0]), waves[~long]]), kept


def near_waves(wave: float, longest: float) -> list[tuple[float, float]]:
    """A wave, or two that are not longer than the longest one, with weights that are linear."""
    beyond = 1 - wave / longest
    return [(wave, 1.0)] if beyond <= 0 else [(longest, 1 + beyond), (2 * longest, -beyond)]
