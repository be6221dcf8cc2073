"""Result files read without xarray, compared with xarray."""

import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from tests.synthetic_results import ellipse

import bombs
from viscontact.cli import main
from viscontact.results.contact_spots import label_spots
from viscontact.results.netcdf import open_results, save
from viscontact.results.single_spot import ends_in_one_spot, is_one_spot
from viscontact.results.stored_result import stored_result


@pytest.fixture
def file(tmp_path: Path) -> Path:
    ds = ellipse()
    ds["outcome"] = ("time", np.zeros(ds.sizes["time"], dtype="i1"))
    ds["peak_pressure"].values[0] = np.nan
    ds.attrs |= {"title": "An ellipse", "event_times": np.array([0.5, 1.0]), "complete": 1}
    save(ds, tmp_path / "run.nc")
    return tmp_path / "run.nc"


def test_variables_are_those_of_xarray(file: Path) -> None:
    with stored_result(file) as found, open_results(file) as expected:
        assert set(found.data_vars) == set(expected.data_vars)
        assert found.sizes == dict(expected.sizes)
        assert "pressure" in found
        assert "contact" not in found
        for name in (*expected.data_vars, *expected.coords):
            assert found[str(name)].dims == expected[name].dims
            np.testing.assert_array_equal(found[str(name)].values, expected[name].values)


def test_attributes_are_those_of_xarray(file: Path) -> None:
    with stored_result(file) as found, open_results(file) as expected:
        assert found.attrs.keys() == expected.attrs.keys()
        for name, value in expected.attrs.items():
            np.testing.assert_array_equal(found.attrs[name], value)
        assert found.encoding["source"] == expected.encoding["source"]


def test_files_that_are_no_results_are_refused_as_by_open_results(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no result at"):
        stored_result(tmp_path)
    (tmp_path / "result.nc").write_text("text")
    with pytest.raises(ValueError, match="cannot be read as a netCDF result"):
        stored_result(tmp_path)


@pytest.mark.parametrize(("time", "points"), [(2 * 10**9, 8), (3, 10**5)])
def test_sizes_that_no_result_has_are_refused_before_they_are_read(
    time: int, points: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Values that are not written take no room in the file, and gigabytes when they are read."""
    file = bombs.result(tmp_path / "result.nc", time, points)
    said = "its variable (time|pressure) has (16|40) GB according to its header, in a file of 0.0"
    for read in (stored_result, open_results):
        with pytest.raises(ValueError, match=rf"{file} cannot be read as a netCDF result: {said}"):
            read(file)
    assert main(["show", str(file)]) == 2
    assert re.search(rf"^{file}: {said}[^\n]*\n$", capsys.readouterr().err)


def test_what_is_called_one_spot_has_one_label() -> None:
    rng = np.random.default_rng(5)
    counts = {True: 0, False: 0}
    for _ in range(3000):
        contact = rng.random((4, 5)) < rng.uniform(0.2, 0.95)
        found = is_one_spot(contact)
        counts[found] += 1
        if found:
            assert label_spots(contact, (False, False)).max() == 1
    assert min(counts.values()) > 100


def test_last_contact_decides_on_spots(tmp_path: Path) -> None:
    one = np.array([[0.0, 1.0, 1.0], [0.0, 0.0, 1.0]])
    two = np.array([[1.0, 0.0, 1.0], [0.0, 0.0, 1.0]])
    for last, expected in ((one, True), (two, False)):
        pressure = ("time", "x", "y"), np.stack([one, last, 0 * one])
        save(xr.Dataset({"pressure": pressure, "gap": pressure}), tmp_path / "run.nc")
        with stored_result(tmp_path / "run.nc") as stored:
            assert ends_in_one_spot(stored) is expected
