"""Small files whose content needs gigabytes or minutes end as one message, and soon."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest

import bombs
from fuzzing.families import CASE, LOADED, PRESSED
from fuzzing.test_bad_places import PROGRAM
from viscontact.backend import packed_files
from viscontact.backend.reading_child import ReadingRequest
from viscontact.backend.record import Record
from viscontact.bodies.surfaces import read_surface
from viscontact.identification import read_force_curve
from viscontact.tables import read_line, read_rows, read_table
from viscontact.tables.workbook import write_workbook

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits are those of Linux")

LONGEST = 30.0

# The libraries of instruments take seconds to load, in each process anew.
QUICK = ("zeros.npz", "header.npy", "fills.nc")


def cases(kind: dict[str, Any]) -> list[Any]:
    """Return the names of bombs, of which some take seconds."""
    slow = [name for name in kind if name not in QUICK and kind is not bombs.WORKBOOKS]
    slow.append("rows repeated.ods")
    return [pytest.param(n, marks=pytest.mark.slow if n in slow else ()) for n in kind]


@pytest.fixture
def soon() -> Iterator[None]:
    """Require that what follows takes at most half a minute."""
    begun = time.monotonic()
    yield
    assert time.monotonic() - begun < LONGEST


#: What a file that is refused needs, or has.
_SAID = r"(needs more than 500 MB of memory|takes more than 20 s|cannot be read|more than \d+ rows)"


@pytest.mark.usefixtures("soon")
@pytest.mark.parametrize("name", cases(bombs.WORKBOOKS))
def test_workbook_that_needs_gigabytes_is_refused(name: str, tmp_path: Path) -> None:
    path = bombs.WORKBOOKS[name](tmp_path / name)
    # python-calamine 0.5 builds the repeated columns, which newer ones do not.
    narrow = name == "columns repeated.ods"
    said = f"known heading|names no|header|{_SAID}" if narrow else _SAID
    with pytest.raises(ValueError, match=rf"^{re.escape(path.name)}\S*: .*({said})[^\n]*$"):
        read_table(path)


@pytest.mark.usefixtures("soon")
@pytest.mark.parametrize("name", cases(bombs.MAPS))
def test_map_that_needs_gigabytes_is_refused(name: str, tmp_path: Path) -> None:
    path = bombs.MAPS[name](tmp_path / name)
    units = {} if name.endswith(".x3p") else {"spacing": 1e-6, "height_unit": "um"}  # it has them
    with pytest.raises(ValueError, match=rf"^{re.escape(name)}: {_SAID}[^\n]*$"):
        read_surface(path, **units)


@pytest.mark.usefixtures("soon")
@pytest.mark.parametrize("name", cases(bombs.CURVES))
def test_force_curve_that_needs_gigabytes_is_refused(name: str, tmp_path: Path) -> None:
    path = bombs.CURVES[name](tmp_path / name)
    with pytest.raises(ValueError, match=rf"^{re.escape(name)}: {_SAID}[^\n]*$"):
        read_force_curve(path)


@pytest.mark.slow
@pytest.mark.usefixtures("soon")
def test_every_way_to_a_workbook_is_guarded(tmp_path: Path) -> None:
    path = bombs.WORKBOOKS["no dimension.xlsx"](tmp_path / "far.xlsx")
    sheet = tmp_path / "far.xlsx#A"
    for read in (read_table, read_rows, read_surface, lambda each: read_line(each, "x")):
        for each in (path, sheet):
            with pytest.raises(ValueError, match=r"^far\.xlsx: needs more than 500 MB of memory"):
                read(each)


MAP = PRESSED.replace("FILE,", "FILE, spacing: 1 um, height_unit: um,")

#: Commands, with FILE for the bomb, by the name of the bomb.
COMMANDS = [
    ("no dimension.xlsx", ("run", "loaded.yaml", "-o", "ran")),
    ("no dimension.xlsx", ("run", "good.yaml", "--table", "FILE", "-o", "ran")),
    ("no dimension.xlsx", ("material", "FILE#A", "--data", "shear")),
    ("no dimension.xlsx", ("fit", "FILE", "--poisson-ratio", "0.4")),
    ("zeros.npz", ("check", "map.yaml")),
    ("header.npy", ("run", "map.yaml", "-o", "ran")),
    ("fills.nc", ("check", "map.yaml")),
    ("header.jpk-force", ("fit", "FILE", "--indenter", "sphere 5 um", "--poisson-ratio", "0.5")),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "arguments"), COMMANDS)
def test_command_refuses_it_with_one_message(
    name: str, arguments: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from fuzzing import forked  # Windows lacks what it imports

    monkeypatch.chdir(tmp_path)
    file = f"given{Path(name).suffix}"
    {**bombs.WORKBOOKS, **bombs.MAPS, **bombs.CURVES}[name](tmp_path / file)
    for case, text in (("good", CASE), ("loaded", LOADED), ("map", MAP)):
        text = text.replace("given.csv", file).replace("FILE", file)
        Path(f"{case}.yaml").write_text(text, encoding="utf-8")
    before = sorted(tmp_path.iterdir())
    typed = tuple(each.replace("FILE", file) for each in arguments)
    papers = tmp_path.parent / f"{tmp_path.name}-papers"
    papers.mkdir()
    done = forked.command(typed, PROGRAM, LONGEST, papers)
    assert done.returncode == 2, done.stderr
    assert re.search(rf"{file}: {_SAID}", done.stderr), done.stderr
    assert "Traceback" not in done.stderr
    assert done.stderr.count("\n") == 1
    assert sorted(tmp_path.iterdir()) == before


def test_page_refuses_it_and_answers_on(tmp_path: Path) -> None:
    """The workbook of 1.3 kB once ended the server."""
    pytest.importorskip("fastapi")
    from web.calculator_page import asking

    bomb = bombs.WORKBOOKS["no dimension.xlsx"](tmp_path / "far.xlsx").read_bytes()
    asked = {"file": "far.xlsx", "size": "5 um", "law": "elastic", "poisson_ratio": "0.5"}
    with asking(tmp_path / "page") as client:
        assert client.post("/api/files?name=far.xlsx", content=bomb).status_code == 201
        answer = client.post("/api/fit", json=asked)
        assert answer.status_code == 422
        assert "needs more than 500 MB of memory" in answer.text
        assert client.get("/api/files").is_success


def honest(folder: Path) -> Iterator[tuple[str, Callable[[], tuple[Any, ...]]]]:
    """Yield files of several kinds, and functions that read their values."""
    rng = np.random.default_rng(5)
    book = folder / "creep.xlsx"
    rows = [["time [s]", "D [1/GPa]"], *(map(repr, row) for row in rng.random((9, 2)).tolist())]
    with book.open("wb") as file:
        write_workbook(file, map(list, rows))
    yield "a workbook", lambda: tuple(read_table(book).columns.values())
    heights = rng.standard_normal((6, 5))
    heights[2, 3] = np.nan
    for name in ("map.npy", "map.npz"):
        named = {"height": heights, "unit": "nm", "spacing": [3.0, 0.7]}
        np.save(folder / name, heights) if name == "map.npy" else np.savez(folder / name, **named)
        given = {"spacing": 3e-9, "height_unit": "nm"} if name == "map.npy" else {}
        yield name, partial(_map_values, folder / name, given)
    curve = Path(__file__).parents[1] / "identification" / "cell.jpk-force"
    yield "a force curve", lambda: _curve_values(read_force_curve(curve))
    with netCDF4.Dataset(str(folder / "map.nc"), "w", format="NETCDF3_CLASSIC") as nc:
        for axis, points in zip("xy", heights.shape, strict=True):
            nc.createDimension(axis, points)
        nc.createVariable("heights", "f8", ("x", "y"))[:] = heights
    units = {"spacing": 3e-9, "height_unit": "nm"}
    yield "a map of SurfaceTopography", partial(_map_values, folder / "map.nc", units)


def _map_values(path: Path, given: dict[str, Any]) -> tuple[Any, ...]:
    surface = read_surface(path, **given)
    return surface.heights, surface.spacing, surface.periodic


def _curve_values(curve: Any) -> tuple[Any, ...]:
    return curve.times, curve.position, curve.deflection, curve.spring_constant


def test_honest_files_have_the_same_bits_as_when_read_in_this_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    apart: list[Path] = []

    def here(request: ReadingRequest) -> Record:
        apart.append(request.arguments[0])
        return request.read(*request.arguments)

    names = []
    for name, values in honest(tmp_path):
        if "SurfaceTopography" in name and find_spec("SurfaceTopography") is None:
            continue
        found = values()
        with monkeypatch.context() as patch:
            patch.setattr(packed_files, "read_apart", here)
            expected = values()
        for one, other in zip(found, expected, strict=True):
            assert np.asarray(one).tobytes() == np.asarray(other).tobytes(), name
        names.append(name)
    assert len(names) >= 4
    assert len(apart) == len(names)
