"""The joint result of a sweep: the numbers of its runs, NaN where there are none."""

from __future__ import annotations

import csv
import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from returned import some
from swept_runs import sweep_of
from viscontact.cli import main
from viscontact.results.run_files import FAILURE_NAME, PROGRESS_NAME, STATE_NAME
from viscontact.results.variables import ERRORS, SCALARS, scalars_of
from viscontact.runs.directory.lock import locked
from viscontact.studies.sweep.axes import sweep_axes
from viscontact.studies.sweep.collecting import slabs, write_joint_result
from viscontact.studies.sweep.joint_layout import JointLayout, joint_layout
from viscontact.studies.sweep.manifest import SweepRun

FORCES, RADII = ("2 N", "4 N"), ("9 mm", "10 mm", "11 mm")
ROWS = [{"load.force": force, "indenter.radius": radius} for force in FORCES for radius in RADII]


@pytest.fixture(scope="module")
def grid(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two forces and three radii, of which the last run waits."""
    return sweep_of(tmp_path_factory.mktemp("grid"), ROWS, waiting=[5])


@pytest.fixture(scope="module")
def listed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Runs with different times and grids, the second of which has the material's name."""
    rows = [
        {"time.steps": "4", "grid.shape": "[24, 24]"},
        {"time.steps": "2", "grid.shape": "[24, 20]"},
        {"time.steps": "3", "grid.shape": "[24, 24]"},
    ]
    return sweep_of(tmp_path_factory.mktemp("listed"), rows, "zip")


def places(sweep: Path) -> list[Path]:
    lines = (sweep / "runs.jsonl").read_text(encoding="utf-8").splitlines()
    return [sweep / json.loads(line)["directory"] for line in lines]


def test_grid_has_the_varied_keys_as_dimensions(grid: Path) -> None:
    ds = vc.open_many(grid)
    assert ds.force.dims == ("load.force", "indenter.radius", "time")
    assert ds["load.force"].values.tolist() == [2.0, 4.0]
    assert ds["indenter.radius"].values.tolist() == [0.009, 0.01, 0.011]
    assert [ds[key].attrs["units"] for key in ROWS[0]] == ["N", "m"]
    assert ds.run.values.tolist() == [[0, 1, 2], [3, 4, 5]]
    assert ds.name.values[1, 0] == "force=4N_radius=9mm"
    assert ds.state.values.tolist() == [["done"] * 3, ["done", "done", "waiting"]]


def test_every_number_is_that_of_the_run(grid: Path) -> None:
    ds = vc.open_many(grid)
    for number, place in enumerate(places(grid)[:5]):
        at = np.unravel_index(number, (2, 3))
        with vc.open_results(place) as run:
            stored = {*SCALARS, *ERRORS} & set(map(str, run))
            assert len(stored) > 20
            for name in (*stored, "pressure", "gap", "line_load"):
                # A set load and its area differ between all runs, so that no exchange passes.
                found = ds[name].values[at]
                np.testing.assert_array_equal(found, run[name].values.astype(float), name)
                named = {"units", "long_name", "ancillary_variables"}
                assert {k: ds[name].attrs.get(k) for k in named} == {
                    k: run[name].attrs.get(k) for k in named
                }
            for name in ("time", "x", "y", "field_time"):
                np.testing.assert_array_equal(ds[name], run[name])
    areas = ds.contact_area.isel(time=-1).values.ravel()[:5]
    assert len(set(areas.tolist())) == 5
    for name in (*stored, "pressure"):
        assert np.isnan(ds[name].values[1, 2]).all()


def test_fields_are_read_for_the_selected_runs_only(
    grid: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ds = vc.open_many(grid)
    pressure = ds.pressure.values  # of all runs
    read: list[str] = []
    from viscontact.studies.sweep import lazy_fields

    opened = lazy_fields.StoredFile

    def reading(path: Path, **options: bool) -> object:
        read.append(path.parent.name)
        return opened(path, **options)

    monkeypatch.setattr(lazy_fields, "StoredFile", reading)
    ds = vc.open_many(grid)
    read.clear()
    lazy = ds.pressure.isel({"indenter.radius": [2, 0], "load.force": 0, "field_time": -1})
    lazy = lazy.isel(x=slice(None, None, -3), y=[3, 12, 5])
    assert read == []
    expected = pressure[0][[2, 0], -1][:, ::-3][:, :, [3, 12, 5]]
    np.testing.assert_array_equal(lazy.values, expected)
    assert sorted(read) == ["force=2N_radius=11mm", "force=2N_radius=9mm"]
    at = xr.DataArray([0, 1], dims="point")
    some = ds.pressure[{"load.force": at, "indenter.radius": at}]
    np.testing.assert_array_equal(some.values, pressure[[0, 1], [0, 1]])
    assert float(ds.pressure[0, 1, 1, 12, 12]) == pressure[0, 1, 1, 12, 12]


def test_different_times_are_filled_up_and_not_interpolated(listed: Path) -> None:
    ds = vc.open_many(listed)
    assert ds.force.dims == ds.time.dims == ("run", "step")
    assert ds.sizes["step"] == 5
    assert ds["time.steps"].values.tolist() == [4.0, 2.0, 3.0]
    assert ds["grid.shape"].dims == ("run",)
    assert ds["grid.shape"].values.tolist()[1] == "[24, 20]"
    for number, place in some(enumerate(places(listed))):
        with vc.open_results(place) as run:
            count = run.sizes["time"]
            for name in ("time", "approach", "approach_error"):
                np.testing.assert_array_equal(ds[name].values[number, :count], run[name])
                assert np.isnan(ds[name].values[number, count:]).all()


def test_different_grids_make_a_tree(listed: Path) -> None:
    ds = vc.open_many(listed)
    assert "pressure" not in ds
    assert "tree=True" in ds.attrs["fields"]
    tree = vc.open_many(listed, tree=True)
    assert set(tree["runs"].children) == {place.name for place in places(listed)}
    xr.testing.assert_identical(tree["sweep"].to_dataset(), ds)
    for place in places(listed):
        with vc.open_results(place) as run:
            xr.testing.assert_identical(tree["runs"][place.name].to_dataset(), run)


def test_fields_at_every_step_of_runs_with_different_times(tmp_path: Path) -> None:
    rows = [
        {"time.steps": "2", "output.fields": "all"},
        {"time.steps": "1", "output.fields": "all"},
    ]
    sweep = sweep_of(tmp_path, rows, "table")
    ds = vc.open_many(sweep)
    assert ds.pressure.dims == ("run", "step", "x", "y")
    for number, place in some(enumerate(places(sweep))):
        with vc.open_results(place) as run:
            count = run.sizes["time"]
            np.testing.assert_array_equal(ds.pressure[number, :count], run.pressure)
    assert np.isnan(ds.pressure[1, 2]).all()


@pytest.mark.parametrize("fields", [True, False])
def test_collected_file_holds_the_same(grid: Path, tmp_path: Path, fields: bool) -> None:
    ds = vc.open_many(grid)
    if not fields:
        extra = [name for name in ds.variables if {"x", "y", "field_time"} & set(ds[name].dims)]
        ds = ds.drop_vars(extra)
    progress: list[tuple[int, int]] = []
    path = tmp_path / "sweep.nc"
    write_joint_result(joint_layout(grid), path, lambda *n: progress.append(n), fields=fields)
    with xr.open_dataset(path) as stored:
        xr.testing.assert_identical(stored, ds)
    assert progress[0] == (6, 6)
    assert list(tmp_path.iterdir()) == [path]


def test_collected_file_with_different_times_holds_the_same(listed: Path, tmp_path: Path) -> None:
    path = tmp_path / "sweep.nc"
    write_joint_result(joint_layout(listed), path, lambda *n: None)
    with xr.open_dataset(path) as stored:
        xr.testing.assert_identical(stored, vc.open_many(listed))


@pytest.mark.parametrize("block", [1, 3000, pytest.param(5000, marks=pytest.mark.slow), 2**24])
def test_size_of_the_blocks_changes_nothing(
    grid: Path, tmp_path: Path, block: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(JointLayout.blocks, "__defaults__", (block,))
    path = tmp_path / "sweep.nc"
    write_joint_result(joint_layout(grid), path, lambda *n: None)
    monkeypatch.undo()
    expected = vc.open_many(grid)
    with xr.open_dataset(path) as stored:
        scalars = {name for name in expected.data_vars if "x" not in expected[name].dims}
        assert set(stored.data_vars) == scalars
        for name in stored.data_vars:
            xr.testing.assert_identical(stored[name], expected[name])


def test_slabs_cover_every_element_once() -> None:
    shape = (3, 2, 4)
    for first in range(24):
        for last in range(first + 1, 25):
            numbers = np.arange(24).reshape(shape)
            found = [numbers[place].ravel() for _, place in slabs(first, last, shape)]
            assert np.concatenate(found).tolist() == list(range(first, last))
            parts = [part for part, _ in slabs(first, last, shape)]
            assert [[p.start, p.stop] for p in parts] == [[f[0], f[-1] + 1] for f in found]


@pytest.fixture
def copied(grid: Path, tmp_path: Path) -> Path:
    return shutil.copytree(grid, tmp_path / "copy")


def test_runs_without_a_result_are_nan_with_their_message(copied: Path) -> None:
    failed, stopped, running, damaged, *_ = places(copied)
    (failed / FAILURE_NAME).write_text('{"code": 1, "message": ["grid: the rim"]}')
    (stopped / STATE_NAME).touch()
    (running / STATE_NAME).touch()
    (damaged / "result.nc").write_bytes(b"no netCDF")
    (damaged / PROGRESS_NAME).unlink()
    with locked(running):
        ds = vc.open_many(copied)
    states = ["failed", "stopped", "running", "failed", "done", "waiting"]
    assert ds.state.values.ravel().tolist() == states
    assert ds.message.values[0, 0] == "grid: the rim"
    assert "cannot be read" in ds.message.values[1, 0]
    is_nan = np.isnan(ds.approach).all("time").values.ravel()
    assert is_nan.tolist() == [state != "done" for state in states]
    assert np.isnan(ds.pressure[0, 0]).all()
    assert not np.isnan(ds.pressure[1, 1]).any()


def test_sweep_without_any_result_has_its_coordinates(copied: Path, tmp_path: Path) -> None:
    for place in places(copied):
        shutil.rmtree(place, ignore_errors=True)
    ds = vc.open_many(copied)
    assert set(ds.data_vars) == {"state", "message"}
    assert (ds.state == "waiting").all()
    write_joint_result(joint_layout(copied), tmp_path / "none.nc", lambda *n: None)
    with xr.open_dataset(tmp_path / "none.nc") as stored:
        assert (stored.state == "waiting").all()


def test_results_of_earlier_versions_are_read_from_their_file(copied: Path, grid: Path) -> None:
    for place in places(copied)[:5]:
        lines = [json.loads(each) for each in (place / PROGRESS_NAME).read_text().splitlines()]
        kept = [{k: line[k] for k in ("time", *scalars_of(), "warnings")} for line in lines]
        text = "".join(json.dumps(line) + "\n" for line in kept)
        (place / PROGRESS_NAME).write_text(text, encoding="utf-8")
    xr.testing.assert_identical(vc.open_many(copied), vc.open_many(grid))


@pytest.mark.parametrize(
    "damage",
    [
        *(b'{"time": 1.0, "for\n', b"\xff\n"),
        *(pytest.param(text, marks=pytest.mark.slow) for text in (b"5\n", b"[]\n")),
    ],
)
def test_damaged_log_does_not_hide_the_result(copied: Path, grid: Path, damage: bytes) -> None:
    path = places(copied)[1] / PROGRESS_NAME
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join([lines[0], damage, *lines[2:]]))
    xr.testing.assert_identical(vc.open_many(copied), vc.open_many(grid))


def test_directory_without_a_manifest_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"runs\.jsonl"):
        vc.open_many(tmp_path)


def rows_of(design: str, *rows: dict[str, str], cases: str = "aaaaaaaa") -> list[SweepRun]:
    return [
        SweepRun(n, f"{n}", f"{n}", row, tuple(row), case, design)
        for n, (row, case) in enumerate(zip(rows, cases, strict=False))
    ]


def test_several_cases_are_a_dimension_of_a_grid() -> None:
    forces = [{"load.force": "1 kN"}, {"load.force": "2 kN"}] * 2
    axes = sweep_axes(rows_of("grid", *forces, cases="aabb"))
    assert axes.dims == ("case", "load.force")
    assert axes.coords["case"].values.tolist() == ["a", "b"]


def test_combinations_that_lack_one_lie_along_run() -> None:
    rows = [{"f": f, "r": r} for f in ("1 N", "2 N") for r in ("1 m", "2 m")]
    assert sweep_axes(rows_of("grid", *rows)).dims == ("f", "r")
    for part in (rows[:3], [rows[1], rows[0], *rows[2:]]):
        axes = sweep_axes(rows_of("grid", *part))
        assert axes.dims == ("run",)
        assert axes.coords["f"].dims == ("run",)
    assert sweep_axes(rows_of("sample", *rows)).dims == ("run",)


@pytest.mark.parametrize(
    ("texts", "values", "units"),
    [
        (["5 kN", "20 N"], [5000.0, 20.0], "N"),
        (["25 degC", "300 K"], [298.15, 300.0], "K"),
        (["0.3", "0.45"], [0.3, 0.45], "1"),
        (["5 kN", ""], [5000.0, np.nan], "N"),
        (["5 kN", "5 mm"], ["5 kN", "5 mm"], None),
        (["a.x3p", "b.x3p"], ["a.x3p", "b.x3p"], None),
    ],
)
def test_coordinates_are_numbers_in_si_or_text(
    texts: list[str], values: list[object], units: str | None
) -> None:
    rows = rows_of("zip", *({"key": text} for text in texts))
    found = sweep_axes(rows).coords["key"]
    np.testing.assert_array_equal(found.values, np.array(values))
    assert found.attrs.get("units") == units


def test_difference_of_temperatures_has_no_offset() -> None:
    rows = rows_of("zip", {"material.shift.c2": "51.6 degC"}, {"material.shift.c2": "40 K"})
    assert sweep_axes(rows).coords["material.shift.c2"].values.tolist() == [51.6, 40.0]


def test_warnings_of_each_run_are_in_the_dataset_and_in_the_table(tmp_path: Path) -> None:
    sweep = sweep_of(tmp_path, [{"material.measured_until": end} for end in ("9 s", "1 s")])
    ds = vc.open_many(sweep)
    none, warned = ds["warnings"].values.tolist()
    assert "extrapolation" not in none
    with vc.open_results(places(sweep)[1]) as run:
        assert warned == run.attrs["warnings"]
    assert "extrapolation" in warned
    for place in places(sweep):
        (place / PROGRESS_NAME).unlink()
    assert vc.open_many(sweep)["warnings"].values.tolist() == [none, warned]
    assert main(["collect", str(sweep), "-o", str(tmp_path / "sweep.csv")]) == 0
    with (tmp_path / "sweep.csv").open(encoding="utf-8", newline="") as file:
        cells = [row["warnings"] for row in csv.DictReader(file)]
    assert cells == [" | ".join(each.splitlines()) for each in (none, warned)]
