"""What a report states for the file: title block, date, files and values as typed."""

from __future__ import annotations

import hashlib
import json
import math
from datetime import datetime, timedelta
from pathlib import Path
from xml.etree.ElementTree import fromstring

import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from reports_without_pictures import without_pictures
from returned import some
from viscontact.case import CaseError, read_case
from viscontact.cli import main
from viscontact.drawing.svg.html import written
from viscontact.report import report_page
from viscontact.report.inputs import InputRow, inputs
from viscontact.report.measured import measured_figure, measured_lines
from viscontact.report.title_block import file_lines, title_entries
from viscontact.results.filed_case import FiledCase, started_at

__all__ = ["without_pictures"]  # a fixture

TABLE = """time [s], D [1/GPa]
1, 0.30
10, 0.36
100, 0.45
1000, 0.60
"""
CASE = """title: Pad under a ball
report: {project: P-7 & <b>, operator: A. Smith, revision: B}
indenter: {shape: sphere, radius: 10 mm}
material: {law: table, file: pom.csv, poisson_ratio: 0.4}
load: {kind: step, force: 5 N}
time: {end: 100 s, steps: 4, spacing: log}
grid: {shape: [24, 24], size: [2.4 mm, 2.4 mm]}
output: {errors: false}
"""


def directory(folder: Path, *options: str, text: str = CASE) -> Path:
    """Run the case; return its directory."""
    (folder / "pad.yaml").write_text(text, encoding="utf-8", newline="\n")
    (folder / "pom.csv").write_text(TABLE, encoding="utf-8", newline="\n")
    assert main(["run", str(folder / "pad.yaml"), "--quiet", *options]) == 0
    return folder / "pad"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run whose files are then changed."""
    folder = tmp_path_factory.mktemp("filing")
    found = directory(folder, "--set", "load.force=6 N")
    (folder / "pom.csv").write_text(TABLE + "10000, 0.9\n", encoding="utf-8")
    return found


@pytest.fixture(scope="module")
def ds(made: Path) -> xr.Dataset:
    """Its result."""
    with vc.open_results(made) as found:
        return found.load()


def sha(content: bytes) -> str:
    """SHA-256 as `sha256sum` prints it."""
    return hashlib.sha256(content).hexdigest()


def test_digests_are_those_of_the_files_when_the_run_was_made(made: Path, ds: xr.Dataset) -> None:
    found = {
        each["role"]: (each["name"], each["sha256"]) for each in FiledCase.of(ds.attrs).input_files
    }
    assert found == {
        "case file": ("pad.yaml", sha(CASE.encode())),
        # With the force of --set and the table beside it; it can be checked in the directory.
        "case as run": ("case.yaml", sha((made / "case.yaml").read_bytes())),
        "material.file": ("pom.csv", sha(TABLE.encode())),
    }


def test_an_unchanged_case_is_listed_once(tmp_path: Path) -> None:
    elastic = CASE.replace("law: table, file: pom.csv", "law: elastic, shear_modulus: 1 GPa")
    with vc.open_results(directory(tmp_path, text=elastic)) as found:
        [only] = FiledCase.of(found.attrs).input_files
    assert only == {"name": "case.yaml", "role": "case as run", "sha256": sha(elastic.encode())}


def test_the_start_is_stated_with_the_offset_from_utc(ds: xr.Dataset) -> None:
    began = datetime.fromisoformat(ds.attrs["started"])
    assert timedelta() < datetime.now().astimezone() - began < timedelta(minutes=10)
    assert began.utcoffset() == datetime.now().astimezone().utcoffset()


def test_a_start_without_offset_or_of_an_older_result_is_not_stated() -> None:
    assert [started_at(each) for each in ({}, {"started": "2026-03-01T00:30:05"})] == ["", ""]


def test_results_of_python_have_the_start_too() -> None:
    rubber, grid = vc.Material(vc.Elastic(1e7), 0.5), vc.Grid((16, 16), (2e-3, 2e-3))
    found = vc.simulate(vc.Sphere(0.01), rubber, vc.step(1.0), grid, [0.0], errors=False)
    assert started_at(found.attrs)
    assert [name for name, _ in title_entries(found)] == ["Run started"]
    assert list(file_lines(found)) == []


@pytest.mark.usefixtures("without_pictures")
def test_report_begins_with_the_title_block(ds: xr.Dataset) -> None:
    page = report_page(ds)
    body = page[page.index("<body>") :]
    block = body[body.index('<dl class="title-block"') : body.index("</dl>") + len("</dl>")]
    texts = [each.text for each in fromstring(block).iter("dd")]
    assert texts == ["P-7 & <b>", "A. Smith", "B", started_at(ds.attrs)]
    assert body.index("title-block") < body.index("<h1>")


def test_report_lists_the_files_with_their_digests(ds: xr.Dataset) -> None:
    text = "".join(map(written, file_lines(ds)))
    for each in some(FiledCase.of(ds.attrs).input_files):
        assert each["sha256"] in text
        assert each["name"] in text


def test_title_block_does_not_change_the_run(tmp_path: Path) -> None:
    directory(tmp_path)
    other = CASE.replace("revision: B", "revision: C")
    (tmp_path / "pad.yaml").write_text(other, encoding="utf-8", newline="\n")
    assert main(["run", str(tmp_path / "pad.yaml"), "--quiet", "--resume"]) == 0


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ("report: {author: me}", "report.author: unknown key"),
        ("report: {project: 7}", "report.project: must be a text, got 7"),
    ],
)
def test_errors_of_the_title_block_name_the_key(given: str, why: str, tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    lines = CASE.splitlines()
    lines[1] = given
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(CaseError) as raised:
        read_case(path)
    assert f":2: {why}" in str(raised.value)


def test_typed_values_are_kept_as_they_were_typed(ds: xr.Dataset) -> None:
    typed = json.loads(ds.attrs["case_as_typed"])
    assert typed["indenter"] == {"shape": "sphere", "radius": "10 mm"}
    assert typed["load"]["force"] == "6 N"  # of --set


ROLLER = """indenter:
  shape: roller
  radius: 5 mm
  half_length: 8 mm
  profile: {kind: johns-gohar, force: 500 N, effective_modulus: 3300 MPa}
material: {law: zener, shear_modulus: 1 GPa, delayed_modulus: 1 GPa, viscosity: 10 GPa s,
  poisson_ratio: 0.4}
load: {kind: step, force: 0.2 kN}
time: {end: 10 s, steps: 4, spacing: log}
grid: {shape: [24, 24], size: [20 mm, 1 mm]}
output: {errors: false, fields: none}
"""


def test_design_of_a_crown_stands_beside_the_amplitude_that_follows(tmp_path: Path) -> None:
    with vc.open_results(directory(tmp_path, text=ROLLER)) as found:
        rows = inputs(found)
    assert InputRow("Indenter", "profile", "logarithmic profile", "johns-gohar") in rows
    assert InputRow("Indenter", "profile force", "", "500 N") in rows
    [amplitude] = [each for each in rows if each.name == "profile amplitude"]
    # Q / (2 pi L E*) with half the length L (Lundberg 1939), by hand.
    lundberg = 1e6 * 500 / (2 * math.pi * 8e-3 * 3300e6)
    assert amplitude.value == f"{lundberg:.4f} µm"
    assert amplitude.typed == ""
    assert InputRow("Load", "force", "200 N", "0.2 kN") in rows
    assert InputRow("Indenter", "radius", "", "5 mm") in rows  # one value, not twice the same


def test_a_measured_compliance_is_shown_as_it_was_measured(ds: xr.Dataset) -> None:
    record = FiledCase.of(ds.attrs).measured["material"]
    assert (record["file"], record["data"], record["rows"]) == ("pom.csv", "uniaxial", 4)
    [axes] = measured_figure(record).axes
    assert axes.get_ylabel() == "Creep compliance D [1/GPa]"
    [line] = axes.lines
    assert line.get_xdata().tolist() == [1, 10, 100, 1000]
    assert line.get_ydata() == close_to([0.30, 0.36, 0.45, 0.60])  # not times 1 + nu
    assert "“D [1/GPa]” (uniaxial test)" in "".join(map(written, measured_lines(ds, "Half-space")))
    assert list(measured_lines(ds, "Indenter")) == []


def test_a_creep_modulus_is_shown_as_a_modulus(tmp_path: Path) -> None:
    case = CASE.replace("pom.csv", "sheet.csv")
    (tmp_path / "sheet.csv").write_text("time [h], E_c [MPa]\n1, 2500\n10, 2000\n100, 1600\n")
    with vc.open_results(directory(tmp_path, text=case)) as found:
        [axes] = measured_figure(FiledCase.of(found.attrs).measured["material"]).axes
    assert axes.get_ylabel() == "Creep modulus E_c [GPa]"
    assert axes.lines[0].get_ydata() == close_to([2.5, 2.0, 1.6])
