"""Surfaces in texts and workbooks: told apart by content, with marks of missing points."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from random_examples import given_few_or_many
from viscontact.case import CaseError, read_case

NX, NY = 5, 4
#: Heights [x, y] in µm with four decimals, all different.
HEIGHTS = np.random.default_rng(3).permutation(NX * NY).reshape(NX, NY) * 0.25 - 2.0
GIVEN = {"height_unit": "um", "spacing": (2e-6, 3e-6)}
SENTINELS = ("-9999", "9999", "-32768", "32767", "1e30", "3.4028235e38", "BAD", "***", "nan", "")


def rows_of(kind: str) -> list[tuple[float, ...]]:
    """Numbers of a matrix of scan lines along x, of points, or of a line."""
    if kind == "matrix":
        return [tuple(line) for line in HEIGHTS.T.tolist()]
    if kind == "line":
        return [(2.0 * i, h) for i, h in enumerate(HEIGHTS[:, 0].tolist())]
    return [(2.0 * i, 3.0 * j, float(HEIGHTS[i, j])) for j in range(NY) for i in range(NX)]


def written(path: Path, rows: list[Any], separator: str, decimal: str, heading: str = "") -> Path:
    lines = [separator.join(f"{v:.4f}".replace(".", decimal) for v in row) for row in rows]
    path.write_text("\n".join([*filter(None, [heading]), *lines]) + "\n", encoding="utf-8")
    return path


@given_few_or_many(
    40,
    300,
    st.sampled_from(["matrix", "points", "line"]),
    st.sampled_from([("\t", ","), ("\t", "."), (";", ","), (";", "."), (",", "."), (" ", ".")]),
    st.sampled_from([".csv", ".txt", ".xyz", ".dat", ".asc"]),
    st.randoms(use_true_random=False),
)
def test_numbers_are_told_apart_by_content_whatever_the_file_is_called(
    tmp_path_factory: pytest.TempPathFactory,
    kind: str,
    marks: tuple[str, str],
    suffix: str,
    random: Any,
) -> None:
    rows = rows_of(kind)
    if kind == "points":
        random.shuffle(rows)
    path = written(tmp_path_factory.getbasetemp() / f"any{suffix}", rows, *marks)
    surface = vc.read_surface(path, **GIVEN)
    expected = HEIGHTS[:, :1] if kind == "line" else HEIGHTS
    np.testing.assert_allclose(surface.heights, 1e-6 * expected, rtol=1e-12)
    assert surface.spacing[0] == close_to(2e-6)
    assert kind == "line" or surface.spacing[1] == close_to(3e-6)


@pytest.mark.parametrize("sentinel", SENTINELS)
@pytest.mark.parametrize("kind", ["matrix", "points", "heading"])
def test_marks_of_missing_points_are_no_heights(sentinel: str, kind: str, tmp_path: Path) -> None:
    cells = [[f"{v:.4f}" for v in row] for row in rows_of("matrix" if kind == "matrix" else "")]
    row, column = (1, 2) if kind == "matrix" else (1 * NX + 2, 2)
    cells[row][column] = sentinel
    heading = ["x [um];y [um];height [um]"] if kind == "heading" else []
    path = tmp_path / "map.csv"
    path.write_text("\n".join([*heading, *map(";".join, cells)]) + "\n")
    surface = vc.read_surface(path, **({} if heading else GIVEN))
    assert np.argwhere(surface.missing).tolist() == [[2, 1]]
    known = ~surface.missing
    np.testing.assert_allclose(surface.heights[known], 1e-6 * HEIGHTS[known], rtol=1e-12)
    is_number = sentinel[-1:].isdigit()
    assert len(surface.notes) == is_number
    if is_number:
        assert "1 point has the value" in surface.notes[0]


def test_a_height_of_9999_among_others_is_a_height(tmp_path: Path) -> None:
    path = tmp_path / "map.csv"
    path.write_text("9999, 9990\n9980, 9995\n")
    surface = vc.read_surface(path, height_unit="nm", spacing=1e-3)
    assert not surface.missing.any()
    np.save(tmp_path / "map.npy", np.array([[1.0, 2.0], [3.0, -9999.0]]))
    array = vc.read_surface(tmp_path / "map.npy", height_unit="um", spacing=1e-3)
    assert np.argwhere(array.missing).tolist() == [[1, 1]]
    assert array.with_heights(array.heights).notes == array.notes


@pytest.mark.parametrize(
    ("heading", "factor"),
    [
        ("x [um],height [um]", 1.0),
        ("X (mm),Z (um)", 1e-3),
        ('"x in µm","y in µm"', 1.0),
        ("x/µm,height/µm", 1.0),
    ],
)
def test_a_profile_is_a_line_scan_and_is_swept_over_its_width(
    heading: str, factor: float, tmp_path: Path
) -> None:
    rows = [(factor * x, h) for x, h in rows_of("line")]
    text = "\n".join(["trace 7", heading, *(f"{x:.6f},{h:.4f}" for x, h in rows)])
    (tmp_path / "trace.csv").write_text(text, encoding="utf-8")
    line = vc.read_surface(tmp_path / "trace.csv")
    assert line.shape == (NX, 1)
    assert line.spacing[0] == close_to(2e-6)
    np.testing.assert_allclose(line.heights[:, 0], 1e-6 * HEIGHTS[:, 0], rtol=1e-12)
    assert vc.read_surface(tmp_path / "trace.csv", width=9e-6).size == close_to((1e-5, 9e-6))


def test_a_case_sweeps_a_profile_of_a_workbook_and_states_its_marks(tmp_path: Path) -> None:
    book = openpyxl.Workbook()
    book.active.title = "Info"
    for row in (("Operator", "x"), ("Points", 4)):
        book.active.append(row)
    sheet = book.create_sheet("Trace")
    for row in (("X[um]", "Z[um]"), (0, 0.1), (2, 0.3), (4, -9999), (6, 0.2)):
        sheet.append(row)
    book.save(tmp_path / "trace.xlsx")
    (tmp_path / "case.yaml").write_text(
        "indenter: {shape: height-map, file: trace.xlsx, width: 8 um, missing: lowest}\n"
        "material: {law: elastic, shear_modulus: 1 GPa, poisson_ratio: 0.5}\n"
        "load: {kind: step, force: 1 uN, tilt_x: 0 rad, tilt_y: 0 rad}\n"
        "time: {end: 1 s, steps: 1}\n"
    )
    case = read_case(tmp_path / "case.yaml")
    assert case.indenter.gap(0.0, 0.0).shape == ()
    assert any("1 point has the value -9999" in note for note in case.notes)
    with pytest.raises(CaseError, match=r"indenter\.width: trace\.xlsx is a line scan"):
        read_case(tmp_path / "case.yaml", ["indenter.width=null"])


def test_positions_that_are_rounded_are_even_and_others_are_not(tmp_path: Path) -> None:
    exact = np.arange(400) * 0.156245
    lines = [f"{x:.1f},{np.sin(x):.4f}" for x in exact]
    path = tmp_path / "trace.csv"
    path.write_text("x [um],height [um]\n" + "\n".join(lines) + "\n")
    surface = vc.read_surface(path)
    assert surface.spacing[0] == close_to(0.156245e-6, rel=1e-3)
    np.testing.assert_allclose(surface.heights[:, 0], 1e-6 * np.sin(exact), atol=1e-10)
    path.write_text("x [um],height [um]\n0,1\n1,1\n2.5,1\n3,1\n3.7,1\n")
    with pytest.raises(ValueError, match=r"trace\.csv: its points are unevenly spaced: x = "):
        vc.read_surface(path)


def test_points_without_units_need_a_spacing_in_the_ratio_of_their_own(tmp_path: Path) -> None:
    path = written(tmp_path / "map.xyz", rows_of("points"), " ", ".")
    with pytest.raises(ValueError, match=r"spacing is missing: the points of map\.xyz lie 2 and 3"):
        vc.read_surface(path, height_unit="um")
    with pytest.raises(ValueError, match="give two distances in this ratio"):
        vc.read_surface(path, height_unit="um", spacing=2e-6)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"spacing": 40.0, "height_unit": "um"}, r"map\.csv: is 200 m long, which no surface"),
        ({"spacing": 1e-6, "height_unit": "m"}, r"height_factor: the heights of map\.csv span"),
    ],
)
def test_sizes_that_cannot_be_are_refused(given: dict[str, Any], said: str, tmp_path: Path) -> None:
    path = written(tmp_path / "map.csv", rows_of("matrix"), ",", ".")
    with pytest.raises(ValueError, match=said):
        vc.read_surface(path, **given)
    assert vc.read_surface(path, spacing=1e-6, height_unit="m", height_factor=1e-6).rms_height > 0


def test_packed_files_and_texts_of_other_kinds_are_refused_with_the_reason(tmp_path: Path) -> None:
    pytest.importorskip("SurfaceTopography", reason="no wheels of it on this system")
    (tmp_path / "map.gz").write_bytes(b"\x1f\x8b\x08\x00" + bytes(30))
    with pytest.raises(ValueError, match=r"map\.gz: .*: it is packed; unpack it"):
        vc.read_surface(tmp_path / "map.gz")
    (tmp_path / "notes.txt").write_text("These are notes\nof a measurement\n")
    with pytest.raises(ValueError, match=r"notes\.txt: a map is rows of bare heights, or columns"):
        vc.read_surface(tmp_path / "notes.txt")


def test_text_of_gwyddion_reaches_the_library_that_reads_it(tmp_path: Path) -> None:
    pytest.importorskip("SurfaceTopography", reason="no wheels of it on this system")
    path = tmp_path / "export.csv"
    path.write_text(
        "# Channel: Height\n# Width: 8.0 µm\n# Height: 6.0 µm\n# Value units: m\n"
        "1e-8 2e-8 3e-8 4e-8\n2e-8 3e-8 4e-8 5e-8\n3e-8 4e-8 5e-8 7e-8\n",
        encoding="utf-8",
    )
    surface = vc.read_surface(path)
    assert surface.size == close_to((8e-6, 6e-6))
    assert surface.heights[3, 0] == close_to(4e-8)


def test_rounded_workbook_of_an_instrument_reaches_the_library_that_reads_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A workbook without a table of points is given to SurfaceTopography as it is."""
    book = openpyxl.Workbook()
    book.active.append(("Work Name", "Sample", "Operator", "N. N."))
    book.active.append(("Measuring Tool", "SJ"))
    book.save(tmp_path / "trace.xlsx")
    seen = []

    def read(path: Path, *_: object) -> vc.Surface:
        seen.append(path)
        return vc.Surface([[0.0, 1e-6]], 1e-6)

    monkeypatch.setattr("viscontact.bodies.surfaces.text_files.read_instrument", read)
    assert vc.read_surface(tmp_path / "trace.xlsx").shape == (1, 2)
    assert seen == [tmp_path / "trace.xlsx"]
