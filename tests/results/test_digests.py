"""Digests of result files: CRC-32 by definition, and damage that readers notice."""

from __future__ import annotations

import binascii
import json
import logging
import pickle
import shutil
from collections.abc import Callable
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr
from tests.synthetic_results import ellipse

import viscontact as vc
from viscontact.results.damage import DamagedFileError
from viscontact.results.digests import GROUP, digest_of
from viscontact.results.line_digests import is_as_written, read_entries, with_digest
from viscontact.results.seal import check_seal
from viscontact.results.stored_result import stored_result


@pytest.fixture
def path(tmp_path: Path) -> Path:
    vc.save(ellipse(), tmp_path / "run.nc")
    return tmp_path / "run.nc"


def changed(path: Path, change: Callable[[netCDF4.Dataset], object]) -> Path:
    """Change a file as another program does: HDF5 cuts the seal off, the digests stay."""
    with netCDF4.Dataset(str(path), "a") as file:
        file.set_auto_maskandscale(False)
        change(file)
    return path


def test_digest_is_the_crc_32_of_the_bytes_in_little_endian_order() -> None:
    # The check value of CRC-32 (ISO-HDLC) for the digits 1 to 9 in the catalogue of CRCs.
    assert digest_of(np.frombuffer(b"123456789", dtype="u1")) == 0xCBF43926
    values = np.linspace(0, 1, 7)
    assert digest_of(values) == binascii.crc32(values.astype("<f8").tobytes())
    assert digest_of(values.astype(">f8")) == digest_of(values)
    assert digest_of(values[3:], digest_of(values[:3])) == digest_of(values)
    assert digest_of(values.reshape(7, 1).T) == digest_of(values)


def test_saved_result_is_opened_as_it_was_by_any_reader(path: Path) -> None:
    ds = ellipse()
    with vc.open_results(path) as ours, xr.open_dataset(path) as theirs:
        xr.testing.assert_identical(ours.load(), theirs.load())
        np.testing.assert_array_equal(ours.pressure, ds.pressure)


INDICES: list[object] = [
    *(0, -1, slice(None), slice(None, None, -2), [2, 0], np.array([1]), (0, slice(2, 9, 3), 4)),
    *((slice(1, None), [5, 1, 7], slice(8, 2, -1)), (..., 3), ([], 1)),
]


@pytest.mark.parametrize("index", INDICES, ids=str)
def test_values_are_those_of_numpy_at_any_index(path: Path, index: object) -> None:
    whole = ellipse().pressure.values
    key = index if isinstance(index, tuple) else (index,)
    expected = whole
    # Indices of the axes are independent of each other, as those of netCDF4.
    full = (*key, *[slice(None)] * (3 - len(key))) if ... not in key else (slice(None),) * 2 + (3,)
    for axis in (2, 1, 0):
        one = np.asarray(full[axis], dtype=int) if isinstance(full[axis], list) else full[axis]
        expected = expected[(slice(None),) * axis + (one,)]
    with stored_result(path) as found, vc.open_results(path) as ds:
        np.testing.assert_array_equal(found["pressure"][index], expected)
        np.testing.assert_array_equal(ds.pressure[index].values, expected)


def _value(file: netCDF4.Dataset) -> None:
    file["force"][1] = np.nextafter(file["force"][1], 1.0)


def _fields_exchanged(file: netCDF4.Dataset) -> None:
    rows = file["pressure"][:2]
    file["pressure"][:2] = rows[::-1]


CHANGES: dict[str, tuple[Callable[[netCDF4.Dataset], object], str]] = {
    "last bit of a scalar": (_value, "the values of force"),
    "exchanged fields": (_fields_exchanged, "the values of pressure"),
    "a warning": (lambda file: file.setncattr("warnings", "none"), "its attributes"),
    "a unit": (lambda file: file["force"].setncattr("units", "kN"), "the values of force"),
    "a variable": (lambda file: file.renameVariable("force", "friction"), "its variables"),
    "a digest": (lambda file: file[GROUP].setncattr("columns", "{"), "its digests"),
}


@pytest.mark.parametrize(("change", "what"), CHANGES.values(), ids=CHANGES.keys())
def test_change_of_anything_is_named(
    path: Path, change: Callable[[netCDF4.Dataset], object], what: str
) -> None:
    changed(path, change)

    def read_all(opened: Callable[[Path], object]) -> None:
        with opened(path) as ds:  # type: ignore[attr-defined]
            for name in ("force", "pressure"):
                assert ds[name].values.size

    for opened in (vc.open_results, stored_result):
        with pytest.raises(ValueError, match=f"run.nc is damaged.*: {what} are not") as noticed:
            read_all(opened)
        assert str(pickle.loads(pickle.dumps(noticed.value))) == str(noticed.value)


def test_one_damaged_field_leaves_the_others_readable(path: Path) -> None:
    changed(path, _fields_exchanged)
    with vc.open_results(path) as ds:
        np.testing.assert_array_equal(ds.pressure[2], ellipse().pressure[2])
        np.testing.assert_array_equal(ds.force, ellipse().force)
        with pytest.raises(DamagedFileError, match="the values of pressure"):
            _ = ds.pressure[:, 0, 0].values


def test_every_damaged_byte_is_noticed_before_the_file_is_interpreted(path: Path) -> None:
    whole = path.read_bytes()
    rng = np.random.default_rng(3)
    for at in (0, len(whole) - 60, *rng.integers(len(whole) - 50, size=20)):
        damaged = bytearray(whole)
        damaged[at] ^= 1 << rng.integers(8)
        path.write_bytes(damaged)
        with pytest.raises(ValueError, match=r"run\.nc is damaged"):
            vc.open_results(path)


def test_result_that_a_user_saves_is_not_called_damaged(
    path: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    with vc.open_results(path) as ds:
        edited = ds.load().isel(time=slice(2)).assign_attrs(title="mine")
    vc.save(edited, tmp_path / "saved.nc")
    with caplog.at_level(logging.WARNING), vc.open_results(tmp_path / "saved.nc") as ds:
        xr.testing.assert_identical(ds.load(), edited)
    assert caplog.messages == []
    edited.to_netcdf(tmp_path / "other.nc")
    for _ in range(2):
        with caplog.at_level(logging.WARNING), vc.open_results(tmp_path / "other.nc") as ds:
            xr.testing.assert_identical(ds.load(), edited)
    assert len(caplog.messages) == 1
    assert "other.nc has no digests" in caplog.messages[0]


def test_seal_is_cut_off_by_programs_that_change_the_file(path: Path, tmp_path: Path) -> None:
    copy = shutil.copy(path, tmp_path / "copy.nc")
    changed(Path(copy), lambda file: file.setncattr("note", "mine"))
    assert check_seal(path)
    assert not check_seal(Path(copy))
    with pytest.raises(DamagedFileError, match="its attributes"):
        vc.open_results(copy)


VALUES: list[object] = [{"time": 1.5, "warnings": ["ä"]}, {}, ["key", {}], ["k", {"a": {}}]]


@pytest.mark.parametrize("value", VALUES)
def test_line_with_a_digest_is_json_and_any_other_bit_is_noticed(value: object) -> None:
    line = with_digest(json.dumps(value, ensure_ascii=False).encode())
    found = json.loads(line)
    last = found[-1] if isinstance(found, list) else found
    before = line[: line.index(b'"digest"')]
    assert last.pop("digest") == f"{binascii.crc32(before):08x}"
    assert found == value
    assert is_as_written(line)
    for place in range(8 * len(line)):
        damaged = bytearray(line)
        damaged[place // 8] ^= 1 << place % 8
        try:
            # A digest that is no longer found is missed by who reads the lines around it.
            assert not is_as_written(bytes(damaged))
        except ValueError:
            continue


def test_line_of_another_place_is_noticed() -> None:
    line = with_digest(b'{"time": 1.0, "row": 3}')
    assert read_entries(line, 3) == {"time": 1.0, "row": 3}
    with pytest.raises(ValueError, match="not the line that was written there"):
        read_entries(line, 4)
