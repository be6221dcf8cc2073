"""Gaps beside a straight edge, against strips solved without the package and Hertz's cylinder.

The strips are uniformly loaded, with the logarithmic influence coefficients of a line load (Johnson
1985, section 2.5), and the half width of contact is a = sqrt(4 P R/(pi E*)) (eq. 4.43).
"""

import numpy as np
import pytest

from closeness import close_to
from viscontact.mechanics.contact.straight_edge import edge_laws


def strip(half_width: float, centre: float, count: int) -> tuple[np.ndarray, ...]:
    """Centres, gaps and pressures of strips of length 1 under a cylinder of radius 1 with E* = 1.

    The load makes the contact `half_width` long; the axis is at `centre`.
    """
    x = np.arange(count) - (count - 1) / 2
    ends = np.abs(x[:, None] - x) + np.array([0.5, -0.5])[:, None, None]
    upper, lower = ends * np.log(np.abs(ends))
    influence = -2 / np.pi * (upper - lower)
    open_gap = (x - centre) ** 2 / 2
    load = np.pi * half_width**2 / 4
    contact = np.abs(x - centre) < half_width
    while True:
        n = np.count_nonzero(contact)
        system = np.ones((n + 1, n + 1))
        system[:n, :n], system[n, n] = influence[np.ix_(contact, contact)], 0.0
        solved = np.linalg.solve(system, np.append(-open_gap[contact], load))
        pressure = np.zeros(count)
        pressure[contact] = solved[:n]
        gap = influence @ pressure + open_gap + solved[n]
        better = (pressure > 0) | (gap < -1e-12)
        if (better == contact).all():
            return x, np.where(contact, 0.0, gap), pressure
        contact = better


def first_gaps(half_width: float, centre: float) -> tuple[float, np.ndarray]:
    """Distance of the first open centre from Hertz's edge, and the gaps of the first three."""
    x, gap, _ = strip(half_width, centre, int(2.6 * half_width))
    first = int(np.flatnonzero((gap > 0) & (x > centre))[0])
    return x[first] - centre - half_width, gap[first : first + 3]


@pytest.mark.parametrize("half_width", [20.0, 80.0])
def test_law_locates_the_edge_of_a_strip(half_width: float) -> None:
    """Largest errors measured: 8.1e-4 and 1.6e-4 cells; gap^(2/3) is 0.11 cells off."""
    law = edge_laws(1.0, periodic=False)[0]
    for centre in np.linspace(0.0, 1.0, 11):
        true, (near, far, farther) = first_gaps(half_width, centre)
        (found,) = law.distance(np.array([near]), np.array([far]), np.array([farther]))
        assert found == close_to(true, abs=0.03 / half_width)


@pytest.mark.parametrize("half_width", [20.0, 80.0])
def test_law_of_pressures_locates_the_edge_of_a_strip_from_within(half_width: float) -> None:
    """Largest errors measured: 1.1e-2 and 2.8e-3 cells; p^2 is 0.1 cells off."""
    law = edge_laws(1.0, periodic=False)[1]
    for centre in np.linspace(0.0, 1.0, 11):
        x, _, pressure = strip(half_width, centre, int(2.6 * half_width))
        last = int(np.flatnonzero(pressure > 0)[-1])
        near, far, farther = pressure[last], pressure[last - 1], pressure[last - 2]
        (found,) = law.distance(np.array([near]), np.array([far]), np.array([farther]))
        assert found == close_to(centre + half_width - x[last], abs=0.4 / half_width)


def test_without_a_third_gap_the_edge_is_known_to_first_order() -> None:
    """Largest errors measured: 1.6e-2 and 4.2e-3 cells."""
    law, unknown = edge_laws(1.0, periodic=False)[0], np.array([np.nan])
    for half_width in (20.0, 80.0):
        for centre in np.linspace(0.0, 1.0, 11):
            true, (near, far, _) = first_gaps(half_width, centre)
            (found,) = law.distance(np.array([near]), np.array([far]), unknown)
            assert found == close_to(true, abs=0.4 / half_width)


def test_cells_are_in_contact_up_to_the_threshold() -> None:
    law = edge_laws(1.0, periodic=False)[0]
    first = [first_gaps(80.0, centre)[0] for centre in np.linspace(0.0, 1.0, 101)]
    assert min(first) == close_to(law.threshold, abs=0.012)
    assert max(first) == close_to(law.threshold + 1, abs=0.012)


def test_law_along_the_grid_depends_on_the_influence_coefficients_only() -> None:
    square, flat = (edge_laws(ratio, periodic=False)[0] for ratio in (1.0, 0.2))
    assert flat.threshold == close_to(square.threshold, abs=1e-4)
    assert flat.growth == close_to(square.growth, abs=2e-4)
    assert edge_laws(1.0, periodic=True)[0].threshold > square.threshold + 0.01


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("ratio", [0.2, 1.0, 5.0])
def test_offset_is_none_along_the_grid_and_small_elsewhere(ratio: float, periodic: bool) -> None:
    law = edge_laws(ratio, periodic=periodic)[0]
    along, oblique = law.offset(np.array([0.0, 0.4]))
    assert along == close_to(0.0, abs=2e-4)
    assert 0 < abs(oblique) < 0.025
    assert law.offset(np.array([-0.4]))[0] == oblique
