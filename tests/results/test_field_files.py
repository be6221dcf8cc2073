"""Fields of a result in files of ParaView and MATLAB, read without the library that wrote them."""

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.io import loadmat

import viscontact as vc
from viscontact.cli import main

TYPES = {"Float32": "f4", "Float64": "f8", "Int8": "i1", "UInt8": "u1"}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("run") / "ball.nc"
    gel = vc.Material(vc.Zener(1e6, 3e6, 1.0), 0.4)
    step = vc.ForceHistory([0.0], [1.0])
    grid = vc.Grid((24, 16), (4e-3, 4e-3))
    vc.simulate(vc.Sphere(5e-3), gel, step, grid, [0.0, 0.5, 1.0], errors=False).to_netcdf(file)
    return file


def image(file: Path) -> tuple[dict[str, str], dict[str, np.ndarray]]:
    """Attributes of the grid of a VTK image, and its arrays over x and y."""
    content = file.read_bytes()
    start = re.search(rb'<AppendedData encoding="raw">\s*_', content)
    assert start is not None
    head, data = content[: start.start()], content[start.end() :]
    tree = ElementTree.fromstring(head + b"</VTKFile>")
    grid = tree.find("ImageData")
    assert grid is not None
    size = {"UInt32": 4, "UInt64": 8}[tree.get("header_type", "UInt32")]
    ends = [int(number) for number in grid.attrib["WholeExtent"].split()]
    shape = tuple(high - low + 1 for low, high in zip(ends[::2], ends[1::2], strict=True))
    arrays = {}
    for each in grid.iter("DataArray"):
        place = int(each.attrib["offset"])
        length = int.from_bytes(data[place : place + size], "little")
        values = data[place + size : place + size + length]
        flat = np.frombuffer(values, "<" + TYPES[each.attrib["type"]])
        arrays[each.attrib["Name"]] = flat.reshape(shape, order="F")[:, :, 0]
    return dict(grid.attrib), arrays


def test_images_of_paraview_hold_each_field_to_the_last_bit(run: Path, tmp_path: Path) -> None:
    assert main(["export", str(run), "-o", str(tmp_path / "fields.pvd")]) == 0
    files = ElementTree.parse(tmp_path / "fields.pvd").getroot().iter("DataSet")
    found = [(float(each.attrib["timestep"]), tmp_path / each.attrib["file"]) for each in files]
    with vc.open_results(run) as ds:
        assert [time for time, _ in found] == ds[ds.pressure.dims[0]].values.tolist()
        for number, (_, file) in enumerate(found):
            grid, arrays = image(file)
            assert set(arrays) >= {"pressure", "gap", "displacement", "in_contact"}
            for name, values in arrays.items():
                np.testing.assert_array_equal(values, ds[name][number].values)
        origin = [float(number) for number in grid["Origin"].split()]
        spacing = [float(number) for number in grid["Spacing"].split()]
        np.testing.assert_allclose(origin[0] + spacing[0] * np.arange(24), ds.x, rtol=1e-12)
        np.testing.assert_allclose(origin[1] + spacing[1] * np.arange(16), ds.y, rtol=1e-12)


def test_matlab_file_holds_every_number_and_its_unit(run: Path, tmp_path: Path) -> None:
    assert main(["export", str(run), "-o", str(tmp_path / "run.mat")]) == 0
    found = loadmat(tmp_path / "run.mat", simplify_cells=True)
    with vc.open_results(run) as ds:
        for name, each in ds.variables.items():
            np.testing.assert_array_equal(found[str(name)], np.squeeze(each.values))
            assert found["units"][name] == each.attrs.get("units", "")


@pytest.mark.filterwarnings("ignore:the grid is periodic along x only")
def test_line_contact_and_speeds_are_written_too(tmp_path: Path) -> None:
    gel = vc.Material(vc.Zener(1e6, 3e6, 1.0), 0.4)
    grid = vc.Grid((1, 48), (1e-3, 2e-3), periodic=(True, False))
    roll, load = vc.Paraboloid(np.inf, 5e-3), vc.ForceHistory([0.0], [0.1], tilt_y=0.0)
    ds = vc.steady(roll, gel, load, [0.01, 0.1], grid=grid, errors=False)
    ds.to_netcdf(tmp_path / "roll.nc")
    assert main(["export", str(tmp_path / "roll.nc"), "-o", str(tmp_path / "roll.pvd")]) == 0
    assert 'timestep="0.1"' in (tmp_path / "roll.pvd").read_text()
    _, arrays = image(tmp_path / "roll" / "0001.vti")
    np.testing.assert_array_equal(arrays["pressure"], ds.pressure[1].values)


@pytest.mark.parametrize("name", ["fields.vtk", "fields.txt", "fields"])
def test_other_endings_are_refused(
    name: str, run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["export", str(run), "-o", str(tmp_path / name)]) == 2
    assert "name a CSV or an XLSX file" in capsys.readouterr().err
    assert not any(tmp_path.iterdir())


def test_points_belong_to_tables(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    where = ["-o", str(tmp_path / "a.mat"), "--point", "0 mm,0 mm"]
    assert main(["export", str(run), *where]) == 2
    assert "--point adds columns to a table" in capsys.readouterr().err


def test_result_without_fields_says_how_to_store_them(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with vc.open_results(run) as ds:
        bare = ds.load().drop_vars(["pressure", "gap", "displacement", "in_contact"])
    bare.to_netcdf(tmp_path / "bare.nc")
    assert main(["export", str(tmp_path / "bare.nc"), "-o", str(tmp_path / "a.pvd")]) == 2
    assert "run again with fields stored" in capsys.readouterr().err
