"""Memory of the fields that a simulation in Python keeps."""

from __future__ import annotations

import gc
import tracemalloc

import viscontact as vc
from closeness import close_to


def peak(steps: int, cells: int) -> int:
    """Largest memory of a simulation without symmetry that keeps all its fields [bytes]."""
    rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    load = vc.step(0.1, eccentricity_x=1e-5, eccentricity_y=1e-5)
    grid, times = vc.Grid((cells, cells), (2.4e-3, 2.4e-3)), vc.uniform_times(1.0, steps)
    gc.collect()  # so that collections fall alike in both runs, whatever ran before
    tracemalloc.start()
    try:
        vc.simulate(vc.Sphere(0.01), rubber, load, grid, times, errors=False)
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_kept_fields_take_three_numbers_a_cell_and_as_many_in_the_dataset() -> None:
    cells, few, many = 96, 4, 16
    peak(few, cells)  # what is imported and cached at first
    taken = (peak(many, cells) - peak(few, cells)) / ((many - few) * cells**2)
    assert taken == close_to(2 * 3 * 8, rel=0.1)
