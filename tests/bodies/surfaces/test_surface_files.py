"""Height maps in files of instruments, arrays and text: units and refusals."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.backend import reading_process
from viscontact.case import CaseError, case_schema, read_case
from viscontact.cli import main
from viscontact.surfaces import Surface, levelled

HEIGHTS = 1e-6 * np.random.default_rng(7).standard_normal((12, 8))

CASE = """\
indenter:
  shape: height-map
  file: map.npz
material: {law: elastic, shear_modulus: 100 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 10 mN, tilt_x: 0 rad, tilt_y: 0 rad}
time: {end: 1 s, steps: 1}
grid: {shape: [40, 36], size: [40 um, 36 um]}
"""


def bumps(nx: int = 32, ny: int = 28) -> np.ndarray:
    """Smooth hills in um on a mesh of 1 um."""
    x, y = np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij")
    return np.asarray(0.05 * np.cos(2 * np.pi * x / 16) * np.cos(2 * np.pi * y / 14))


@pytest.fixture
def case(tmp_path: Path) -> Path:
    np.savez(tmp_path / "map.npz", height=bumps(), spacing=1.0, unit="um")
    (tmp_path / "case.yaml").write_text(CASE)
    return tmp_path / "case.yaml"


def refusal(case: Path, *settings: str) -> str:
    with pytest.raises(CaseError) as refused:
        read_case(case, settings)
    assert len(refused.value.problems) == 1
    return str(refused.value)


# -- files that another program wrote ----------------------------------------------------------


def written(tmp_path: Path, ending: str, unit: str, periodic: bool = False) -> Path:
    """Write the map with SurfaceTopography, 24 um x 12 um large."""
    program = pytest.importorskip("SurfaceTopography", reason="no wheels of it on this system")
    scale = {"m": 1.0, "µm": 1e-6, "nm": 1e-9}[unit]
    size = (24e-6 / scale, 12e-6 / scale)
    topography = program.Topography(HEIGHTS / scale, size, unit=unit, periodic=periodic)
    file = tmp_path / f"map.{ending}"
    write = {"x3p": "to_x3p", "gwy": "to_gwy", "nc": "to_netcdf"}[ending]
    getattr(topography, write)(str(file))
    return file


@pytest.mark.parametrize("ending", ["x3p", "gwy", "nc"])
@pytest.mark.parametrize("unit", ["m", "µm", "nm"])
def test_map_of_another_program_arrives_in_metres(tmp_path: Path, ending: str, unit: str) -> None:
    surface = vc.read_surface(written(tmp_path, ending, unit))
    # X3P and GWY may hold 32 bit.
    np.testing.assert_allclose(surface.heights, HEIGHTS, atol=1e-12)
    assert surface.size == close_to((24e-6, 12e-6), rel=1e-6)


@pytest.mark.parametrize("ending", ["x3p", "nc"])
def test_points_that_were_not_measured_arrive_as_missing(tmp_path: Path, ending: str) -> None:
    program = pytest.importorskip("SurfaceTopography", reason="no wheels of it on this system")
    masked = np.ma.array(HEIGHTS, mask=np.abs(HEIGHTS) > 1e-6)
    file = tmp_path / f"map.{ending}"
    topography = program.Topography(masked, (24e-6, 12e-6), unit="m")
    {"x3p": topography.to_x3p, "nc": topography.to_netcdf}[ending](str(file))
    surface = vc.read_surface(file)
    np.testing.assert_array_equal(surface.missing, masked.mask)
    np.testing.assert_allclose(surface.heights[~masked.mask], HEIGHTS[~masked.mask], atol=1e-12)


def test_matrix_of_another_program_needs_the_missing_units(tmp_path: Path) -> None:
    program = pytest.importorskip("SurfaceTopography", reason="no wheels of it on this system")
    file = tmp_path / "map.txt"
    program.Topography(1e6 * HEIGHTS, (24.0, 12.0)).to_matrix(str(file))
    with pytest.raises(ValueError, match=r"height_unit is missing: map\.txt does not state"):
        vc.read_surface(file)
    with pytest.raises(ValueError, match=r"spacing is missing: map\.txt does not state"):
        vc.read_surface(file, height_unit="um")
    surface = vc.read_surface(file, spacing=(2e-6, 1.5e-6), height_unit="um")
    np.testing.assert_allclose(surface.heights, HEIGHTS, atol=1e-12)
    assert surface.spacing == close_to((2e-6, 1.5e-6))


def test_line_scans_of_another_program_are_swept_or_refused(tmp_path: Path) -> None:
    program = pytest.importorskip("SurfaceTopography", reason="no wheels of it on this system")
    line = HEIGHTS[:, 0]
    even, uneven = tmp_path / "even.nc", tmp_path / "uneven.nc"
    program.UniformLineScan(line, 24e-6, unit="m").to_netcdf(str(even))
    x = np.cumsum(1 + np.arange(12.0))
    program.NonuniformLineScan(1e-6 * x, line, unit="m").to_netcdf(str(uneven))
    assert vc.read_surface(even).shape == (12, 1)
    ridges = vc.read_surface(even, width=8e-6)
    assert ridges.size == close_to((24e-6, 8e-6))
    np.testing.assert_allclose(ridges.heights, np.repeat(line[:, np.newaxis], 4, axis=1))
    with pytest.raises(ValueError, match=r"uneven\.nc: its points are unevenly spaced"):
        vc.read_surface(uneven)


def test_netcdf_states_whether_a_map_is_periodic(tmp_path: Path) -> None:
    assert vc.read_surface(written(tmp_path, "nc", "m", periodic=True)).periodic
    assert not vc.read_surface(written(tmp_path, "nc", "m", periodic=False)).periodic


def test_units_are_refused_where_the_file_has_them(tmp_path: Path) -> None:
    file = written(tmp_path, "gwy", "m")
    with pytest.raises(ValueError, match=r"height_unit: is given in map\.gwy; leave it out"):
        vc.read_surface(file, height_unit="um")
    with pytest.raises(ValueError, match=r"spacing: is given in map\.gwy"):
        vc.read_surface(file, spacing=1e-6)
    with pytest.raises(ValueError, match=r"channel: .* no channel 'phase'; there are"):
        vc.read_surface(file, channel="phase")


def test_file_of_an_instrument_is_pressed_from_a_case(case: Path) -> None:
    written(case.parent, "x3p", "µm")
    found = read_case(case, ["indenter.file=map.x3p", "indenter.level=none"])
    expected = HEIGHTS.max() - HEIGHTS
    x, y = (np.arange(12) - 5.5) * 2e-6, (np.arange(8) - 3.5) * 1.5e-6
    gap = found.indenter.gap(*np.meshgrid(x, y, indexing="ij"))
    np.testing.assert_allclose(gap, expected, atol=1e-12)
    assert found.files == {("indenter", "file"): case.parent / "map.x3p"}


@pytest.mark.parametrize("content", [b"", b"ISO5436", b"\x00" * 4096, b"GWYP\xff\xff"])
@pytest.mark.parametrize("ending", ["x3p", "gwy", "sur", "di", "nc", "xyz"])
def test_broken_file_is_one_line(tmp_path: Path, ending: str, content: bytes) -> None:
    pytest.importorskip("SurfaceTopography", reason="no wheels of it on this system")
    file = tmp_path / f"broken.{ending}"
    file.write_bytes(content)
    with pytest.raises(ValueError, match=r"^broken\.\w+: cannot be read as a surface: [^\n]+$"):
        vc.read_surface(file)


def test_missing_extra_is_refused_with_the_command_to_install_it(
    case: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (case.parent / "map.x3p").write_bytes(b"some")
    # Another process reads the file, and finds this module first.
    missing = case.parent / "missing"
    missing.mkdir()
    (missing / "SurfaceTopography.py").write_text("raise ImportError")
    places = [str(missing), *filter(None, [os.environ.get("PYTHONPATH")])]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(places))
    reading_process._close_spare()
    assert main(["check", str(case), "--set", "indenter.file=map.x3p"]) == 2
    reading_process._close_spare()
    said = capsys.readouterr().err
    assert "pip install 'viscontact[surfaces]'" in " ".join(said.split())
    assert "Traceback" not in said


# -- arrays and text ---------------------------------------------------------------------------


def test_array_is_read_with_the_given_units(tmp_path: Path) -> None:
    np.save(tmp_path / "map.npy", 1e6 * HEIGHTS)
    surface = vc.read_surface(tmp_path / "map.npy", spacing=(1e-6, 2e-6), height_unit="um")
    np.testing.assert_allclose(surface.heights, HEIGHTS, rtol=1e-15)
    assert surface.spacing == (1e-6, 2e-6)
    for given, key in (({"spacing": 1e-6}, "height_unit"), ({"height_unit": "um"}, "spacing")):
        with pytest.raises(ValueError, match=f"{key} is missing: map.npy does not state"):
            vc.read_surface(tmp_path / "map.npy", **given)
    with pytest.raises(ValueError, match=r"height_unit: .*'MPa'"):
        vc.read_surface(tmp_path / "map.npy", spacing=1e-6, height_unit="MPa")


def test_npz_carries_its_units(tmp_path: Path) -> None:
    file = tmp_path / "map.npz"
    np.savez(file, height=1e9 * HEIGHTS, spacing=[500.0, 250.0], unit="nm", periodic=True)
    surface = vc.read_surface(file)
    np.testing.assert_allclose(surface.heights, HEIGHTS, rtol=1e-14)
    assert surface.spacing == close_to((5e-7, 2.5e-7), rel=1e-14)
    assert surface.periodic
    np.savez(file, a=HEIGHTS, b=HEIGHTS)
    with pytest.raises(
        ValueError, match=r"channel: map\.npz must hold an array 'height'; it has a, b"
    ):
        vc.read_surface(file, spacing=1e-6, height_unit="m")
    assert vc.read_surface(file, spacing=1e-6, height_unit="m", channel="b").shape == (12, 8)


@pytest.mark.parametrize(
    ("arrays", "said"),
    [
        ({"spacing": np.nan}, "spacing must be a length"),
        ({"spacing": [1.0, 2.0, 3.0]}, "spacing must be one number or two"),
        ({"spacing": []}, "spacing must be one number or two"),
        ({"spacing": "a"}, "spacing must be one number or two"),
        ({"unit": "MPa"}, "unit: cannot read 'MPa' as a length"),
        ({"height": HEIGHTS + 1j}, "heights must be numbers, got an array of complex128"),
        ({"height": HEIGHTS[np.newaxis]}, r"heights must be a map \[x, y\]"),
        ({"height": np.zeros((0, 3))}, r"heights must be a map \[x, y\]"),
    ],
)
def test_inconsistent_npz_is_refused_by_its_name(
    tmp_path: Path, arrays: dict[str, Any], said: str
) -> None:
    sound: dict[str, Any] = {"height": HEIGHTS, "spacing": 1.0, "unit": "um"}
    np.savez(tmp_path / "map.npz", **(sound | arrays))
    with pytest.raises(ValueError, match=rf"^map\.npz: {said}"):
        vc.read_surface(tmp_path / "map.npz")


def test_pickles_are_not_opened(tmp_path: Path) -> None:
    np.save(tmp_path / "map.npy", np.array([{"a": 1}, {"b": 2}], dtype=object))
    with pytest.raises(ValueError, match=r"map\.npy: cannot be read as an array of numbers"):
        vc.read_surface(tmp_path / "map.npy", spacing=1e-6, height_unit="m")


TEXTS = {
    "commas": "0.0,1.0,2\n3,4,nan\n",
    "semicolons and decimal commas": "0,0;1,0;2,0\n3;4;\n",
    "blanks": "# x across\n0 1 2\n3 4 nan\n",
    "tabs": "0\t1\t2\n3\t4\tbad\n",
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_rows_of_numbers_are_scan_lines_along_x(tmp_path: Path, text: str) -> None:
    (tmp_path / "map.csv").write_text(text)
    surface = vc.read_surface(tmp_path / "map.csv", spacing=1e-6, height_unit="nm")
    np.testing.assert_allclose(
        surface.heights, 1e-9 * np.array([[0, 3], [1, 4], [2, np.nan]]), rtol=1e-15
    )


def test_table_of_points_is_read_in_any_order_with_its_units(tmp_path: Path) -> None:
    points = [(i, j) for i in range(4) for j in range(3) if (i, j) != (2, 1)]
    np.random.default_rng(0).shuffle(points)
    rows = [f"{2 * i + 10:.3f},{0.5 * j:.3f},{10 * i + j}" for i, j in points]
    (tmp_path / "map.csv").write_text("\n".join(["x [um],y [um],height [nm]", *rows]))
    surface = vc.read_surface(tmp_path / "map.csv")
    assert surface.spacing == close_to((2e-6, 0.5e-6))
    expected = 1e-9 * np.add.outer(10.0 * np.arange(4), np.arange(3))
    assert np.argwhere(surface.missing).tolist() == [[2, 1]]
    np.testing.assert_allclose(
        surface.heights[~surface.missing], expected[~surface.missing], rtol=1e-12
    )
    with pytest.raises(ValueError, match=r"height_unit: is given in map\.csv"):
        vc.read_surface(tmp_path / "map.csv", height_unit="um")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("1,2,3\n4,5\n", "map.csv:2 has 2 heights, the first row 3"),
        ("1,2,3\n4,5,x\n", "map.csv:2: height 3: 'x' is not a number"),
        ("x [um],y [um],height [nm]\n0,0,1\n0,0,2\n1,1,1\n", "map.csv:3: this point is given"),
        ("x [um],y [um],height [nm]\n0,0,1\n1,0,2\n1.5,1,1\n3,1,1\n", "on no even mesh"),
        ("x [um],w [um]\n0,a\n1,b\n", r"a map is rows of .*, got 'x \[um\]', 'w \[um\]'"),
        ("x,y,height\n0,0,0\n", "unit"),
        ("", "empty"),
    ],
)
def test_text_that_is_no_map_is_refused_at_its_line(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "map.csv").write_text(text)
    given = {} if text.startswith("x") else {"spacing": 1e-6, "height_unit": "nm"}
    with pytest.raises(ValueError, match=said):
        vc.read_surface(tmp_path / "map.csv", **given)


# -- case files ----------------------------------------------------------------------------------


def test_the_steps_of_preparation_are_those_of_python(case: Path) -> None:
    tilted = bumps() + 0.01 * np.arange(32)[:, np.newaxis]
    np.savez(case.parent / "map.npz", height=tilted, spacing=1.0, unit="um")
    settings = ["indenter.flip=true", "indenter.crop={x: [2 um, 30 um]}"]
    found = read_case(case, [*settings, "indenter.resample=[2 um, 4 um]"]).indenter
    flat = levelled(Surface(-1e-6 * tilted[2:30], 1e-6))
    means = flat.heights.reshape(14, 2, 7, 4).mean(axis=(1, 3))
    assert isinstance(found, vc.HeightMap)
    np.testing.assert_allclose(found.height, means, atol=1e-20)


def test_roughness_is_laid_over_a_shape(case: Path) -> None:
    words = "indenter=[{shape: sphere, radius: 5 mm}, {shape: height-map, file: map.npz}]"
    found = read_case(case, [words])
    both = vc.Sphere(5e-3).gap(3e-6, 2e-6) + read_case(case).indenter.gap(3e-6, 2e-6)
    assert found.indenter.gap(3e-6, 2e-6) == close_to(both, rel=1e-12)
    assert found.files == {("indenter", 1, "file"): case.parent / "map.npz"}


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (["indenter.file=no.npz"], "indenter.file: no such file"),
        (["indenter.spacing=1 um"], "indenter.spacing: is given in map.npz; leave it out"),
        (["indenter.spacing=1"], "indenter.spacing: 1 has no unit"),
        (["indenter.height_factor=0"], "indenter.height_factor: must be a number other than 0"),
        (
            ["indenter.height_factor=1e4"],
            "indenter.height_factor: the heights of map.npz span 1 mm",
        ),
        (["indenter.width=1 um"], "indenter.width: is for line scans"),
        (["indenter.crop={x: [0 um, 90 um]}"], "indenter.crop: x must go from a distance to a"),
        (["indenter.crop={z: [0 um, 9 um]}"], "indenter.crop.z: unknown key"),
        (["indenter.filter=gaussian"], "indenter.resample: is missing"),
        (["indenter.resample=0.1 um"], "indenter.resample: cells of 100 nm are finer than the"),
        (["indenter.resample=2 um", "indenter.cutoff=8 um"], "indenter.cutoff: goes with filter"),
        (["indenter.level=tilt"], "indenter.level: unknown value 'tilt'. Allowed: none, mean"),
    ],
)
def test_mistake_in_a_height_map_is_reported_at_its_key(
    case: Path, settings: list[str], said: str
) -> None:
    assert said in refusal(case, *settings)


def test_maps_with_missing_points_or_one_row_are_refused_until_filled_or_swept(case: Path) -> None:
    holed = bumps()
    holed[10:14, 5:9] = np.nan
    np.savez(case.parent / "map.npz", height=holed, spacing=1.0, unit="um")
    assert "no height at 16 of 896 points (1.79%)" in refusal(case)
    for missing in ("hole", "lowest", "smooth"):
        gap = read_case(case, [f"indenter.missing={missing}"]).indenter.gap(-3.5e-6, -7.5e-6)
        assert np.isinf(gap) == (missing == "hole")
    np.savez(case.parent / "map.npz", height=bumps()[:, 0], spacing=1.0, unit="um")
    assert "map.npz is a line scan (32 x 1 points)" in refusal(case)
    swept = read_case(case, ["indenter.width=10 um"]).indenter
    assert swept.gap(2.5e-6, -3e-6) == swept.gap(2.5e-6, 4e-6)


def test_check_reports_levelling_and_warnings(
    case: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    x, y = np.meshgrid(np.linspace(-1, 1, 32), np.linspace(-1, 1, 28), indexing="ij")
    bowl = x**2 + y**2 + 0.2 * x
    np.savez(case.parent / "map.npz", height=bowl, spacing=1.0, unit="um")
    assert main(["check", str(case), "--set", "indenter.level=plane"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "note: map.npz: a tilt of 12.9 mrad was taken off (level: plane)" in said
    assert "note: map.npz: 32 x 28 points, 1 µm apart; Sa" in said
    assert "note: map.npz is hollow: it would touch along its border first" in said


@pytest.mark.parametrize("missing", [pytest.param("smooth", marks=pytest.mark.slow), "hole"])
def test_map_runs_with_its_file_and_is_taken_up_from_there(
    case: Path, missing: str, capsys: pytest.CaptureFixture[str]
) -> None:
    holed = bumps()
    holed[3:5, 5:9] = np.nan
    np.savez(case.parent / "map.npz", height=holed, spacing=1.0, unit="um")
    directory = case.parent / "out"
    settings = ["--set", f"indenter.missing={missing}"]
    assert main(["run", str(case), "-o", str(directory), "--quiet", *settings]) == 0
    assert (directory / "map.npz").read_bytes() == (case.parent / "map.npz").read_bytes()
    with vc.open_results(directory) as ds:
        assert float(ds.force[-1]) == close_to(10e-3, rel=1e-6)
        area = float(ds.contact_area[-1])
        assert 0 < area < 32e-6 * 28e-6
    # The kept case stands alone: the same result from its directory.
    kept, again = directory / "case.yaml", case.parent / "again"
    assert main(["run", str(kept), "-o", str(again), "--quiet"]) == 0
    with vc.open_results(again) as ds:
        assert float(ds.contact_area[-1]) == area
    assert main(["run", str(case), "-o", str(directory), "--resume", *settings]) == 0
    assert "finished already" in capsys.readouterr().err


def test_schema_takes_one_length_or_two() -> None:
    spacing = case_schema()["$defs"]["HeightMap"]["properties"]["spacing"]
    kinds: list[Any] = [each.get("type") for each in spacing["anyOf"]]
    assert kinds == ["string", "array", "null"]
