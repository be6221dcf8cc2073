"""The cells in contact as results store them, and in results from before."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from viscontact.mechanics.state import FIELD_NAMES
from viscontact.results.snapshots import take_snapshots
from viscontact.results.stored_contact import cells_in_contact
from viscontact.results.stored_result import stored_result
from viscontact.results.variables import FIELDS

RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)


@pytest.fixture(scope="module")
def ds() -> xr.Dataset:
    grid, ball = vc.Grid((32, 28), (3e-3, 3e-3)), vc.Sphere(0.01)
    load = vc.ForceHistory([0.0, 0.5, 0.5, 1.0], [0.0, 0.0, 0.1, 0.1])
    return vc.simulate(ball, RUBBER, load, grid, [0.0, 0.5, 1.0], errors=False)


def test_fields_of_a_state_are_those_of_a_result() -> None:
    assert tuple(FIELDS) == FIELD_NAMES


def test_a_result_marks_the_cells_whose_gap_is_closed(ds: xr.Dataset) -> None:
    closed = ds.gap <= 2e-6 * ds.displacement.max(["x", "y"])
    touching = ds.outcome == 0  # before the load, the body touches at a point without force
    assert touching.values.tolist() == [False, True, True]
    np.testing.assert_array_equal(ds.in_contact == 1, closed & touching)


def test_the_stored_mask_counts_not_the_sign_of_the_pressure(ds: xr.Dataset) -> None:
    """As under adhesion: tension within the contact, and beside it."""
    pulled = ds.assign(pressure=-ds.pressure)
    for snapshot, expected in zip(
        take_snapshots(pulled, [0.5, 1.0], "test"), ds.in_contact[1:] == 1, strict=True
    ):
        assert snapshot.touching
        np.testing.assert_array_equal(snapshot.in_contact, expected)
    assert vc.contact_spots(pulled).spots.values.tolist() == [0, 1, 1]
    outside = ds.assign(in_contact=0 * ds.in_contact)
    assert vc.contact_spots(outside).spots.values.tolist() == [0, 0, 0]


def test_results_without_the_mask_are_read_as_before(ds: xr.Dataset, tmp_path: Path) -> None:
    before = ds.drop_vars("in_contact")
    vc.save(before, tmp_path / "before.nc")
    vc.save(ds, tmp_path / "run.nc")
    with (
        vc.open_results(tmp_path / "before.nc") as old,
        vc.open_results(tmp_path / "run.nc") as new,
    ):
        assert new.in_contact.dtype == np.int8
        xr.testing.assert_equal(cells_in_contact(old), cells_in_contact(new))
        xr.testing.assert_identical(vc.contact_spots(old), vc.contact_spots(new))
    for name in ("before", "run"):
        with stored_result(tmp_path / f"{name}.nc") as stored:
            np.testing.assert_array_equal(cells_in_contact(stored, 2), ds.pressure[2] > 0)
