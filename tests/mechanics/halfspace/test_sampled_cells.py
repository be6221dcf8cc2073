"""Lengths of transforms, sampled rows, and strips on thin layers."""

from __future__ import annotations

import numpy as np

from closeness import close_to
from viscontact.backend.transforms import SciPyTransforms
from viscontact.mechanics.halfspace.elastic_stack import ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.kernel_spectrum import kernel_spectrum, padded_length
from viscontact.mechanics.halfspace.sampled_cells import sampled_cells
from viscontact.mechanics.halfspace.stress_lines import part_of
from viscontact.mechanics.halfspace.strip_influence import strip_coefficient
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE


def test_linear_convolution_is_padded_to_twice_the_cells():
    assert padded_length(100, unpadded=False, exact=False) == 200


def test_spectrum_of_an_even_kernel_is_real_and_half():
    kernel, transforms = np.array([[4.0], [1.0]]), SciPyTransforms()
    found = kernel_spectrum(kernel, (3, 1), (False, False), 1, transforms)
    assert found.ravel().tolist() == [6.0, 3.0]  # 4 + 2 cos(2π k/3)


def test_few_cells_stand_for_a_smooth_row():
    row = sampled_cells(np.arange(1001.0), 1000.0)
    values = np.exp(row.centres / 1000)[None, :, None]
    assert row.centres.size < 30
    assert row.at_all(values, axis=1)[0, 500, 0] == close_to(np.exp(0.5005), rel=1e-9)


def test_wide_strip_on_a_thin_layer_compresses_it():
    """h (1 - 2ν)/(1 - ν)² without lateral strain."""
    thin = ElasticStack((ElasticLayer(0.01, 1.0, 0.25),), None)
    exact = 0.01 * (1 - 2 * 0.25) / (1 - 0.25) ** 2
    assert strip_coefficient(np.array([0.0]), 1.0, thin) == close_to([exact], rel=1e-6)


def test_half_space_responds_as_itself():
    assert HALF_SPACE.ratio(np.array([1.0, 2.0])).tolist() == [1.0, 1.0]


def test_progress_of_a_part_is_one_of_all():
    heard = []
    part_of(lambda *done: heard.append(done), 1, 3)(5, 10)
    assert heard == [(15, 30)]
