"""Stress that a pressure leaves on the free ends of a body, found by another way than its operator.

The operator's sum of images is taken apart: the load p~ on the surface, mirrored about the faces,
and the load f on a free face that cancels its stress there. That stress is computed anew from the
waves cos κx of p~, each of which puts exp(-q z) [κ²/q² (1 - q z) + 2ν k²/q²], q² = κ² + k², on the
face, and not by the kernels near the corner that the operator has. What it differs by from f is
left on a face that is free of stress.
"""

from __future__ import annotations

from dataclasses import field
from functools import lru_cache

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics import halfspace
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.halfspace.filon import panel_nodes
from viscontact.mechanics.halfspace.log_panels import LogPanels, interpolation

#: Depths at which the stress is found, from a cell to the grid's size along y.
DEPTHS = 20

#: Nodes of panels of wave numbers along the face, whose ends double, and the first of these over
#: the inverse of the grid's size.
ALONG, FIRST = 3, 0.05

#: Decay of the shortest waves at the first depth, in powers of e.
DECAYED = 11.0

#: Decay from which on waves do not count, likewise.
LARGEST_DECAY = 16.0

#: Waves across the face of a body that goes on: nodes of panels, first panel, and length of panels,
#: both over the inverse of the body's length on the grid.
ACROSS, FIRST_ACROSS, TURNS = 8, 1e-3, 12.0

#: First place of panels of the surface, in cells, and ratio of the ends of a panel.
NEAREST, RATIO = 1e-6, 16.0


@dataclass(frozen=True, eq=False)
class Face:
    """A free face of a body, with the rows of cells beside it, counted from it."""

    pressure: Floats  # shape (rows, ny) [Pa]
    distances: Floats  # of the borders of the rows from the face, shape (rows + 1,) [m]


@dataclass(frozen=True, eq=False)
class Waves:
    """Waves across a face, of the rows of cells and of a load between nodes of panels."""

    across: Floats  # κ [1/m]
    weights: Floats  # of the sum, or of (2/π) ∫ dκ [1/m]
    of_rows: Floats  # ∫ cos κx dx over each row, shape (waves, rows) [m]
    of_nodes: Floats  # weights of ∫ f cos κx dx, shape (waves, nodes) [m]
    panels: LogPanels = field(repr=False)  # of the distance from the face [m], or in W

    def stress(self, ratio: float, amplitudes: Floats, waves: Floats, depths: Floats) -> Floats:
        """Stress on the face by waves cos k y, of ascending k, at depths [m]; (k, depths).

        Amplitudes are [Pa m], shape (k, waves across).
        """
        square = self.across**2 + waves[:, None] ** 2
        rate, part = np.sqrt(square), self.across**2 / square
        own, weighted = part + 2 * ratio * (1 - part), self.weights * amplitudes
        found = np.zeros((len(waves), len(depths)))
        for into, depth in zip(found.T, depths.tolist(), strict=True):
            # Shorter waves are gone at this depth.
            along, across = (
                np.searchsorted(each, LARGEST_DECAY / depth) for each in (waves, self.across)
            )
            kept = slice(along), slice(across)
            decay = rate[kept] * depth
            left = np.exp(-decay) * (own[kept] - part[kept] * decay)
            into[:along] = np.einsum("ka,ka->k", left, weighted[kept])
        return found


def stress_left(response: EndedResponse, pressure: Floats, grid: Grid) -> float:
    """Largest normal stress left on the free faces, in the plane of the peak, over the peak [-].

    `pressure` is that on all cells of the grid [Pa].
    """
    peak = float(pressure.max(initial=0.0))
    faces = _faces_of(response, pressure, grid)
    if not (peak > 0 and faces):
        return 0.0
    column = int(np.unravel_index(int(pressure.argmax()), pressure.shape)[1])
    depths = np.geomspace(grid.cell_size[0], max(grid.size), DEPTHS)
    waves, weights = _waves_along(grid)
    # Even about the plane of the peak: the odd part leaves nothing on it.
    edges = (np.arange(grid.shape[1] + 1) - column - 0.5) * grid.cell_size[1]
    means = np.diff(np.sin(np.multiply.outer(waves, edges)) / waves[:, None], axis=1)
    loads = [means @ face.pressure.T for face in faces]
    left = _left_on(response, faces, loads, waves, depths)
    return float(np.abs(weights / np.pi @ left).max() / peak)


def _waves_along(grid: Grid) -> tuple[Floats, Floats]:
    """Wave numbers along the face, with weights of an integral [1/m]."""
    first, last = FIRST / max(grid.size), DECAYED / grid.cell_size[0]
    borders = first * 2.0 ** np.arange(np.ceil(np.log2(last / first)) + 1)
    waves, weights = panel_nodes(borders, ALONG)
    # Longer waves count as the one in the middle of their range.
    return np.append(first / 2, waves), np.append(first, weights)


def _faces_of(response: EndedResponse, pressure: Floats, grid: Grid) -> list[Face]:
    """Free faces, that at -x first."""
    edges = grid.centre[0] - grid.size[0] / 2 + np.arange(grid.shape[0] + 1) * grid.cell_size[0]
    before, after = response.planes
    middles = (edges[1:] + edges[:-1]) / 2
    inside = middles > (-np.inf if before is None else before)
    rows = np.flatnonzero(inside & (middles < (np.inf if after is None else after)))
    if not rows.size:
        return []
    borders, cell = edges[rows[0] : rows[-1] + 2], grid.cell_size[0]
    found = []
    # In whole cells, so that both ends have the same waves.
    if response.free[0] and before is not None:
        found.append(Face(pressure[rows], cell * np.abs(np.rint((borders - before) / cell))))
    if response.free[1] and after is not None:
        distances = np.abs(np.rint((after - borders[::-1]) / cell))
        found.append(Face(pressure[rows[::-1]], cell * distances))
    return found


def _left_on(
    response: EndedResponse,
    faces: list[Face],
    loads: list[Floats],
    waves: Floats,
    depths: Floats,
) -> Floats:
    """Stress left on each face by each wave [Pa m], shape (faces, waves, depths)."""
    ratio, (before, after) = response.poisson_ratio, response.planes
    if before is None or after is None:
        return _beside_one_end(ratio, faces[0], loads[0], waves, depths)[None]
    half = (after - before) / len(faces)
    table = halfspace.strip
    long = waves * half < table.HIGHEST_WAVE
    # The table of the operator ends there, and longer waves count as its longest one.
    longest = np.maximum(waves[long], table.LOWEST_WAVE / half)
    if len(faces) > 1 and np.array_equal(loads[0], loads[1]):
        # Even about the middle, so that both are alike.
        faces, loads = faces[:1], loads[:1]
    left = np.empty((len(faces), len(waves), len(depths)))
    for index, (face, own) in enumerate(zip(faces, loads, strict=True)):
        left[index, ~long] = _beside_one_end(ratio, face, own[~long], waves[~long], depths)
    even, odd = (
        _between(ratio, faces[0], half, _part(loads, sign)[long], longest, depths, odd=sign < 0)
        if len(faces) > 1 or sign > 0
        else 0.0
        for sign in (1, -1)
    )
    left[0, long] = even + odd
    if len(faces) > 1:
        left[1, long] = even - odd
    return left


def _part(loads: list[Floats], sign: int) -> Floats:
    """Even or odd part of loads about the middle between two faces; that of one is even."""
    return loads[0] if len(loads) == 1 else (loads[0] + sign * loads[1]) / 2


def _beside_one_end(
    ratio: float, face: Face, loads: Floats, waves: Floats, depths: Floats
) -> Floats:
    """Stress left on the face of a body that goes on; shape (waves, depths)."""
    known = halfspace.free_end.images(ratio)
    across = _waves_across_one_end(face.distances.tobytes(), float(waves.min()), float(depths[0]))
    end = float(np.exp(known.panels.edges[-1])) * (1 - 1e-12)
    places = np.minimum(np.multiply.outer(waves, face.distances), end)
    masses = known.panels.weights_of_steps(places, loads)
    added = masses @ known.density.T
    freed = 2 * (masses + known.panels.weights * added) @ known.stress
    beyond = values_at(known.panels, added, np.multiply.outer(waves, across.panels.places))
    amplitudes = loads @ across.of_rows.T + beyond @ across.of_nodes.T
    stress = across.stress(ratio, amplitudes, waves, depths)
    return stress - values_at(known.panels, freed, np.multiply.outer(waves, depths))


@lru_cache(maxsize=1)  # of both ends, where the grid is as long beyond the one as beyond the other
def _waves_across_one_end(borders: bytes, longest: float, first_depth: float) -> Waves:
    """Waves across the face of a body that goes on, from borders of rows as they are in memory."""
    distances = np.frombuffer(borders)
    extent, cell = float(distances[-1]), float(np.diff(distances)[0])
    first, length = FIRST_ACROSS / extent, TURNS / extent
    growing = first * 2.0 ** np.arange(max(np.ceil(np.log2(length / first)), 1))
    even = np.arange(growing[-1] + length, DECAYED / first_depth + length, length)
    across, weights = panel_nodes(np.concatenate([[0.0], growing, even]), ACROSS)
    farthest = halfspace.free_end.HIGHEST / longest
    panels = LogPanels.over(NEAREST * cell, farthest, RATIO)
    of_rows = np.diff(np.sin(np.multiply.outer(across, distances)), axis=1) / across[:, None]
    of_nodes = halfspace.strip.cosine_transform(panels, across)
    return Waves(across, 2 / np.pi * weights, of_rows, of_nodes, panels)


def _between(
    ratio: float,
    face: Face,
    half: float,
    loads: Floats,
    waves: Floats,
    depths: Floats,
    *,
    odd: bool,
) -> Floats:
    """Stress left on a face by the even or the odd loads between two; shape (waves, depths)."""
    table = halfspace.strip.strip_table(ratio, odd=odd)
    distances = np.minimum(face.distances, half)
    count = int(np.ceil(DECAYED / float(depths[0]) * half / np.pi)) + 1
    turns = np.pi * (np.arange(count, dtype=np.float64) + (0.5 if odd else 0.0))
    across, weights = np.asarray(turns / half), np.full(count, 2 / half)
    if not odd:
        across[0], weights[0] = 1e-9 / half, 1 / half
    of_rows = np.diff(np.sin(np.multiply.outer(across, distances)), axis=1) / across[:, None]
    of_nodes = half * halfspace.strip.cosine_transform(table.panels, turns)
    summed = Waves(across, weights, of_rows, of_nodes, table.panels)
    masses = loads @ np.diff(table.panels.weights_until(distances / half), axis=0)
    powers, scaled = table.chebyshev(waves * half), (waves * half)[:, None] * masses
    freed, sent = (
        np.einsum("kt,tnk->kn", powers, each @ scaled.T) for each in (table.faces, table.tops)
    )
    amplitudes = loads @ summed.of_rows.T + sent @ summed.of_nodes.T
    stress = summed.stress(ratio, amplitudes, waves, depths)
    return stress - values_at(table.face_panels, freed, np.multiply.outer(waves, depths))


def values_at(panels: LogPanels, values: Floats, places: Floats) -> Floats:
    """Values at places, of those at the nodes of panels; before them as at the first, beyond 0.

    Each line has places of its own, shape (lines, places).
    """
    logarithms, edges = np.log(places), panels.edges
    panel = np.clip(np.searchsorted(edges, logarithms) - 1, 0, len(edges) - 2)
    inside = np.clip(2 * (logarithms - edges[panel]) / np.diff(edges)[panel] - 1, -1.0, 1.0)
    lines = np.arange(len(values))[:, None]
    nodes = values.reshape(len(values), len(edges) - 1, -1)[lines, panel]
    found = np.einsum("lpn,lpn->lp", interpolation(inside), nodes)
    return np.where(logarithms <= edges[-1], found, 0.0)
