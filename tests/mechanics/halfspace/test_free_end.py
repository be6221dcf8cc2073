"""Operator of a free end against closed forms, finite elements, and its own symmetry."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

from closeness import close_to
from viscontact.mechanics.halfspace.end_correction import end_basis
from viscontact.mechanics.halfspace.free_end import (
    HIGHEST,
    LOWEST,
    RATIO,
    end_functions,
    image_density,
)
from viscontact.mechanics.halfspace.log_panels import LogPanels

#: Sum of all images of a load in two dimensions, over the load: the symbol of A is s/sin(π s/2) of
#: Mellin's s, that is 2/π at s = 1, where it is largest. Michell's wedge gives the same.
ALL_IMAGES = 1 / (1 - 4 / np.pi**2)


def test_images_in_two_dimensions_add_up_to_that_of_a_wedge() -> None:
    # Near to the corner all waves are long, and for ν = 1/2 nothing acts at their length.
    panels = LogPanels.over(LOWEST, HIGHEST, RATIO)
    source = int(np.abs(panels.places - 1e-5).argmin())
    total = 1 + panels.weights @ image_density(panels, 0.5)[:, source]
    assert total == close_to(ALL_IMAGES, rel=1e-4)


@pytest.mark.parametrize(
    ("ratio", "places", "expected"),
    [
        # Extra displacement under a line load cos(k y) at k x = 1, by finite elements (Q2, 70 000
        # unknowns) of the plane of one wave number: u_x, u_z ~ cos(k y), u_y ~ sin(k y).
        (0.0, (0.0, 0.5, 2.0), (-0.113470, 0.002447, 0.005293)),
        (0.3, (0.0, 0.5, 2.0), (0.046222, 0.086574, 0.017144)),
        (0.45, (0.0, 0.5, 2.0), (0.258236, 0.213274, 0.043785)),
    ],
)
def test_a_wave_displaces_the_end_as_in_finite_elements(
    ratio: float, places: tuple[float, ...], expected: tuple[float, ...]
) -> None:
    functions = end_functions(ratio)
    found = functions.at(np.array(places)) @ functions.at(np.array(1.0))
    assert np.abs(found - expected).max() < 5e-6


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.5])
def test_force_and_displacement_change_places(ratio: float) -> None:
    functions = end_functions(ratio)
    assert functions.asymmetry < 1e-5
    assert functions.neglected < 1e-7


def test_the_edge_of_an_incompressible_body_sinks_by_a_fixed_factor() -> None:
    # At the edge of ν = 1/2 nothing but the images acts, so that under a load anywhere it sinks by
    # 2/(1 - 4/π²) - 1 times the mirrored half of what the mirrored half-space does.
    functions, waves = end_functions(0.5), np.geomspace(0.1, 5.0, 9)
    edge = functions.at(np.zeros(1))[0]
    mirrored = 2 / np.pi * scipy.special.k0(waves)
    assert 1 + functions.at(waves) @ edge / mirrored == close_to(2 * ALL_IMAGES - 1, rel=1e-4)


def test_cells_of_the_edge_sink_by_this_factor_at_every_place() -> None:
    # The same in space: the first row of cells under cells that are far in their own lengths. What
    # an end adds is flat at the edge, where the displacement by the mirror image has a slope.
    basis = end_basis(0.5, range(200), (1.0, 1.0))
    offsets = np.arange(0, 300, 30)
    found = np.tensordot(basis.coefficients(300, 1.0)[offsets], basis.basis[100], axes=1)
    mirrored = 1 / (np.pi * np.hypot(100.5, offsets))
    factor = 1 + found @ basis.basis[0] / mirrored
    assert factor == close_to(2 * ALL_IMAGES - 1, rel=1e-4)


def test_far_from_an_end_its_effect_falls_as_the_inverse_distance() -> None:
    functions = end_functions(0.3)
    waves = np.geomspace(1e-6, 20.0, 4000)
    far = []
    for distance in (10.0, 20.0, 40.0):
        values = (functions.at(waves * distance) ** 2).sum(axis=1) * waves
        far.append(np.trapezoid(values, np.log(waves)) / np.pi)
    assert np.divide(far[:-1], far[1:]) == close_to([2.0, 2.0], rel=1e-3)
