"""Operator between two free faces against finite elements, plates, one face, and symmetry."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
import scipy

from closeness import close_to
from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace.filon import panel_nodes
from viscontact.mechanics.halfspace.free_end import end_functions
from viscontact.mechanics.halfspace.log_panels import NODES
from viscontact.mechanics.halfspace.strip import HIGHEST_WAVE, StripTable, strip_table
from viscontact.mechanics.halfspace.strip_basis import StripRows, strip_basis

#: Places |x| from the middle, in half lengths, at which finite elements give the displacement by a
#: pair of line loads at 0.5.
PLACES = np.array([0.2, 0.8, 1.0])


def _at(table: StripTable, places: Floats) -> Floats:
    """Values at distances from a face in half lengths, of values at the nodes of a table."""
    nodes = table.panels.logarithms
    along, edges = np.log(np.maximum(places, 1e-6)), table.panels.edges
    found = np.zeros((len(places), len(nodes)))
    for row, place in zip(found, along, strict=True):
        panel = min(int(np.searchsorted(edges, place, side="right")) - 1, len(edges) - 2)
        own = slice(panel * NODES, (panel + 1) * NODES)
        row[own] = [
            float(scipy.interpolate.BarycentricInterpolator(nodes[own], each)(place))
            for each in np.eye(NODES)
        ]
    return found


def _added(ratio: float, wave: float, *, odd: bool, at: Floats, load: Floats) -> Floats:
    """G between distances from a face, in half lengths."""
    table = strip_table(ratio, odd=odd)
    nodes = np.tensordot(table.weights(np.array([wave]))[0], table.entries, axes=1)
    return np.asarray(_at(table, at) @ nodes @ _at(table, load).T)


@pytest.mark.parametrize(
    ("ratio", "wave", "odd", "expected"),
    [
        # What free faces add to faces held by walls, under line loads cos(k y) at x = W/2 and, even
        # or odd, -W/2, by finite elements (Q2, 100 000 unknowns) of the plane of one wave number k:
        # u_x, u_z ~ cos(k y), u_y ~ sin(k y); 14/k deep.
        (0.0, 1.0, False, (0.033367, -0.026760, -0.190420)),
        (0.0, 1.0, True, (0.026004, 0.136680, 0.107410)),
        (0.0, 0.3, True, (0.409960, 1.758270, 2.185630)),
        (0.0, 3.0, False, (0.006590, -0.000233, -0.085811)),
        (0.3, 1.0, False, (0.161675, 0.194294, 0.096454)),
        (0.3, 1.0, True, (0.085632, 0.413314, 0.482230)),
        (0.3, 0.3, False, (0.670769, 0.640143, 0.489410)),
        (0.3, 0.3, True, (0.631051, 2.655267, 3.315722)),
        (0.3, 3.0, False, (0.010574, 0.037900, -0.003628)),
        (0.3, 3.0, True, (0.005789, 0.039004, 0.004424)),
        (0.45, 1.0, False, (0.402193, 0.525877, 0.488297)),
        (0.45, 1.0, True, (0.152845, 0.714190, 0.882810)),
    ],
)
def test_a_wave_displaces_a_strip_as_in_finite_elements(
    ratio: float, wave: float, odd: bool, expected: tuple[float, ...]
) -> None:
    found = _added(ratio, wave, odd=odd, at=1 - PLACES, load=np.array([0.5]))[:, 0]
    # The finite elements err by up to 3e-5 of the largest: 2.18533, 2.18556, 2.18563 with 44 000,
    # 79 000 and 122 000 unknowns, where 2.18569 is found.
    assert np.abs(found - expected).max() < 3e-5 * max(1.0, *np.abs(expected))


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("odd", [False, True])
def test_long_waves_load_the_edge_of_a_plate(ratio: float, odd: bool) -> None:
    # A plate that is stretched (plane stress against a half-space between walls), or bent by a
    # moment along its edge (Kirchhoff: slope 2 M/(D k (1 - ν)(3 + ν))). The rest stays finite.
    places = np.array([0.9, 0.5, 0.1])
    arms = 1 - places
    plate = 2 * ratio**2 / (1 - ratio**2) * np.ones((3, 3))
    if odd:
        plate = 6 * np.outer(arms, arms) / ((1 - ratio) * (3 + ratio))
    rest = [
        _added(ratio, wave, odd=odd, at=places, load=places) - plate / wave
        for wave in (0.32, 0.16, 0.08)
    ]
    change = [np.abs(later - one).max() for one, later in pairwise(rest)]
    assert change[1] < 0.75 * change[0]
    assert change[1] < 0.03 * np.abs(plate).max() / 0.08 + 0.02


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("odd", [False, True])
def test_short_waves_feel_one_face(ratio: float, odd: bool) -> None:
    places = np.array([1e-3, 1e-2, 0.1, 0.4])
    functions = end_functions(ratio).at(HIGHEST_WAVE * places)
    found = _added(ratio, HIGHEST_WAVE, odd=odd, at=places, load=places)
    assert np.abs(found - functions @ functions.T).max() < 5e-6 * np.abs(found).max()


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("odd", [False, True])
def test_faces_keep_reciprocity_and_give_way(ratio: float, odd: bool) -> None:
    table = strip_table(ratio, odd=odd)
    assert table.error < 3e-6
    for wave in (0.01, 0.5, 7.0):
        g = np.tensordot(table.weights(np.array([wave]))[0], table.entries, axes=1)
        weights = np.sqrt(table.panels.weights)
        values = np.linalg.eigvalsh(weights[:, None] * g * weights)
        assert values[0] > -2e-5 * values[-1]  # positive but for the interpolation over waves


@pytest.mark.parametrize(
    ("free", "odd"), [((True, True), False), ((True, True), True), ((False, True), False)]
)
def test_what_cells_add_in_a_strip_is_a_mean_over_waves(free: tuple[bool, bool], odd: bool) -> None:
    # Against a sum over wave numbers of the mean over both cells along x and one along y.

    strip = StripRows(12, free)
    width, ratio, half = 10.0, 0.3, strip.half_length
    datum = np.hypot(half, width)
    basis = strip_basis(ratio, strip, range(12), (1.0, 1.0), width, odd=odd)
    table = strip_table(ratio, odd=odd)
    rows = (1, 9)
    nearest = [(min(r, 11 - r) if all(free) else 11 - r) for r in rows]
    signs = (-1.0, 1.0) if odd else (1.0, 1.0)
    nodes, weights = np.polynomial.legendre.leggauss(6)
    places = [(r + 0.5 + nodes / 2) / half for r in nearest]

    means = [sign * weights / 2 @ _at(table, at) for sign, at in zip(signs, places, strict=True)]
    pairs = means[0] @ table.entries @ means[1]
    waves, measures = panel_nodes(np.geomspace(1e-7, 30.0, 100), 4)
    values = table.weights(waves * half) @ pairs
    short = waves * half > HIGHEST_WAVE
    lone = [end_functions(ratio).at(np.multiply.outer(waves[short] * half, at)) for at in places]
    one, other = (
        sign * np.einsum("n,knm->km", weights / 2, each)
        for sign, each in zip(signs, lone, strict=True)
    )
    values[short] = (one * other).sum(axis=1)
    limit = pairs[-1] / half
    for offset in (0, 3):
        across = np.cos(waves * offset) * np.sinc(waves / (2 * np.pi))
        below = limit * (np.log(1e-7 * datum) + np.euler_gamma)
        expected = (measures @ (values * across) + below) / np.pi / sum(free)
        found = basis.basis[1] @ basis.coefficients(4, 1.0)[offset] @ basis.basis[9]
        assert found == close_to(expected, abs=1e-6)  # the largest entries are about 0.5
