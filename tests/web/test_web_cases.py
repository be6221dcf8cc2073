"""The calculator page tells of a case what the command line tells, word for word."""

from __future__ import annotations

import io
import json
import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Iterator
from importlib.resources import files
from pathlib import Path

import numpy as np
import openpyxl
import pytest
from fastapi.testclient import TestClient

import viscontact as vc
from viscontact.case import Case
from viscontact.cli import main
from viscontact.runs.preparation import PreparedRun, prepared
from viscontact.web.cases import case_reader
from web.calculator_page import CASE, as_printed, asking


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with asking(tmp_path_factory.mktemp("page")) as client:
        yield client


Typed = Callable[[str], tuple[int, str, str]]


@pytest.fixture
def typed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Typed:
    """Return a function that types `check` of a case, and returns code, output and messages."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "500")

    def type_it(text: str) -> tuple[int, str, str]:
        Path("case.yaml").write_text(text, encoding="utf-8")
        code = main(["check", "case.yaml"])
        said = capsys.readouterr()
        return code, said.out, said.err

    return type_it


BAD = {
    "dimension": CASE.replace("4 N", "10 MPa"),
    "several": CASE.replace("4 N", "4").replace("0.5", "1.5").replace("10 mm", "-1 mm"),
    "misspelt": CASE.replace("radius", "radus").replace("sphere,", "ball,"),
    "missing": CASE.replace("  force: 4 N\n", ""),
    "no yaml": CASE.replace("load:", "load: ["),
    "twice": CASE + "title: again\n",
    "no mapping": "- 1\n- 2\n",
    "empty": "# nothing\n",
    "blank": " ",
    "in a list": CASE.replace("  law: zener", "  law: creep-series\n  times: [1 s, 2 N]"),
    "refused by the run": CASE.replace("  force: 4 N", "  force: 4 N\n  eccentricity_x: 1 m"),
    "no contact": CASE.replace("4 N", "0.1 kN").replace("[24, 24]", "[2000000, 2000000]"),
    "no such file": CASE.replace("  law: zener", "  law: table\n  file: none.csv"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_case_is_refused_in_the_words_of_the_command_line(
    client: TestClient, typed: Typed, name: str
) -> None:
    code, _, said = typed(BAD[name])
    assert code == 2
    for path in ("/api/check", "/api/runs"):
        answer = client.post(path, json={"yaml": BAD[name], "quality": "full"})
        assert answer.status_code == 422
        # How much memory is free differs from one moment to the next.
        printed = [
            [line.split(" GB")[0] for line in lines]
            for lines in (as_printed(answer), said.splitlines())
        ]
        assert printed[0] == printed[1]
    assert client.get("/api/runs").json() == []


def test_half_a_character_is_refused_and_leaves_no_run(client: TestClient) -> None:
    text = CASE.replace("Zener sphere", r'"\ud800"')  # JSON and UTF-8 have no such text
    for path in ("/api/case", "/api/check", "/api/runs"):
        answer = client.post(path, json={"yaml": text})
        assert answer.status_code == 422, path
        assert "half a character" in answer.json()["problems"][0]["message"]


def test_values_nested_without_end_are_refused(client: TestClient) -> None:
    nested = '{"case": {"a": ' + "[" * 900 + "]" * 900 + "}}"
    answer = client.post("/api/yaml", content=nested, headers={"content-type": "application/json"})
    assert answer.status_code == 422
    assert "nested too deeply" in answer.json()["problems"][0]["message"]


def test_a_problem_names_its_key_and_its_line(client: TestClient) -> None:
    text = CASE.replace("4 N", "10 MPa").replace("viscosity: 10 MPa s", "viscosity: 10")
    problems = client.post("/api/check", json={"yaml": text}).json()["problems"]
    assert [(each["path"], each["line"]) for each in problems] == [
        ("material.viscosity", 7),
        ("load.force", 11),
    ]
    assert problems[1]["message"].startswith("cannot read '10 MPa' as a force")


def test_a_check_reports_the_same_as_the_command_line(client: TestClient, typed: Typed) -> None:
    text = CASE.replace("steps: 4", "steps: 4, spacing: log")
    _, printed, _ = typed(text)
    found = client.post("/api/check", json={"yaml": text}).json()
    words = [line.split() for line in printed.splitlines()]
    ours = [
        line.replace(": ", " ", 1).split() if n else line.split()
        for n, line in enumerate(found["lines"])
    ]
    free = [n for n, line in enumerate(words) if line[0] in ("memory", "time")]
    assert [line for n, line in enumerate(words) if n not in free] == [
        line for n, line in enumerate(ours) if n not in free
    ]
    assert found["cells"] == [24, 24]
    assert found["steps"] == 4
    assert found["warnings"] == []
    assert found["memory"] > 1e8


def test_a_check_warns_as_the_command_line_does(client: TestClient, typed: Typed) -> None:
    text = CASE.replace("[24, 24]", "[8, 8]")
    _, printed, _ = typed(text)
    found = client.post("/api/check", json={"yaml": text}).json()
    warned = [line.removeprefix("warning: ") for line in printed.splitlines() if "warning" in line]
    assert found["warnings"] == warned != []
    printed_so = [line for line in found["lines"] if line.startswith("warning: ")]
    assert printed_so == [f"warning: {line}" for line in warned]


def test_a_coarse_case_has_fewer_cells_and_steps_and_the_same_size(client: TestClient) -> None:
    examples = {each["name"]: each["yaml"] for each in client.get("/api/examples").json()}
    for name in ("roller-dogbone-e05", "sphere-load-unload", "wavy-creep", "punch-harmonic"):
        full, coarse = (
            client.post("/api/check", json={"yaml": examples[name], "quality": quality}).json()
            for quality in ("full", "coarse")
        )
        # An answer in seconds: on a busy machine, by the best of a few guesses.
        asked = {"yaml": examples[name], "quality": "coarse"}
        guesses = (client.post("/api/check", json=asked).json()["seconds"] for _ in range(5))
        assert coarse["seconds"] < 3 or any(seconds < 3 for seconds in guesses), name
        assert coarse["cells"] <= full["cells"]
        if full["steps"] is not None:
            assert coarse["steps"] <= full["steps"]
        sizes = [each["needs"][0][1].partition(" on ")[2] for each in (full, coarse)]
        assert sizes[0] == sizes[1]
        assert coarse["warnings"] == full["warnings"]
        if name == "roller-dogbone-e05":  # of 512 x 128 cells, 120 steps, and four fields' instants
            assert 3000 < coarse["cells"][0] * coarse["cells"][1] < 8000
            assert 24 <= coarse["steps"] <= 28


def test_a_case_reads_no_file_that_was_not_given_to_the_page(
    client: TestClient, tmp_path: Path
) -> None:
    secret = tmp_path / "secret.csv"
    secret.write_text("time [s], creep_compliance [1/MPa]\n0, 1\n1, 2\n", encoding="utf-8")
    table = CASE.replace(
        "law: zener", "law: table\n  file: NAME\n  data: shear\n  quantity: creep_compliance"
    )
    load = CASE.replace("kind: step\n  force: 4 N", "kind: history\n  file: NAME")
    surface = CASE.replace("shape: sphere, radius: 10 mm", "shape: height-map, file: NAME")
    profile = CASE.replace(
        "shape: sphere, radius: 10 mm",
        "shape: roller, radius: 5 mm, half_length: 9 mm, profile: {kind: table, file: NAME}",
    )
    for text in (table, load, surface, profile):
        for name in (str(secret), f"../{secret.name}", "/dev/zero", '"a\\\\b.csv"', ".netrc"):
            answer = client.post("/api/check", json={"yaml": text.replace("NAME", name)})
            problems = answer.json()["problems"]
            (about_file,) = [each for each in problems if each["path"].endswith("file")]
            assert "is not the plain name of a file" in about_file["message"]
            assert about_file["line"] == text.split("NAME")[0].count("\n") + 1


def test_a_file_that_was_given_is_read(client: TestClient) -> None:
    text = "time [s], force [N]\n0, 0\n1, 4\n"
    answer = client.post("/api/files?name=my%20load.csv", content=text.encode())
    assert answer.status_code == 201
    assert answer.json() == {"name": "my load.csv", "size": len(text)}
    assert answer.json() in client.get("/api/files").json()
    case = CASE.replace("kind: step\n  force: 4 N", "kind: history\n  file: my load.csv")
    assert client.post("/api/check", json={"yaml": case}).status_code == 200
    assert client.delete("/api/files/my%20load.csv").status_code == 204
    answer = client.post("/api/check", json={"yaml": case})
    (problem,) = answer.json()["problems"]
    # And not where the page keeps it.
    remedy = "upload it, or open it together with the case"
    assert problem["message"] == f"no such file my load.csv; {remedy}"
    assert client.delete("/api/files/my%20load.csv").status_code == 404


def test_every_example_is_there_and_can_be_run(client: TestClient) -> None:
    shipped = {
        path.stem for path in (Path(vc.__file__).parent / "case" / "examples").glob("*.yaml")
    }
    examples = client.get("/api/examples").json()
    assert {each["name"] for each in examples} == shipped
    for each in examples:
        answer = client.post("/api/case", json={"yaml": each["yaml"]})
        assert answer.json()["case"] == each["case"]
    # It reads a measured surface, which is there without being given.
    rough = next(each for each in examples if each["name"] == "rough-ball")
    assert client.post("/api/check", json={"yaml": rough["yaml"]}).status_code == 200


def test_values_and_text_of_a_case_are_the_same(client: TestClient) -> None:
    values = client.post("/api/case", json={"yaml": CASE}).json()["case"]
    written = client.post("/api/yaml", json={"case": values}).json()["yaml"]
    assert client.post("/api/case", json={"yaml": written}).json()["case"] == values
    # What a form leaves empty is not written.
    empty = values | {"indenter_material": {"law": ""}, "tolerance": None, "title": ""}
    written = client.post("/api/yaml", json={"case": empty}).json()["yaml"]
    assert client.post("/api/case", json={"yaml": written}).json()["case"] == {
        name: value for name, value in values.items() if name != "title"
    }


def test_a_case_without_a_name_is_named_by_its_content(client: TestClient) -> None:
    values = client.post("/api/case", json={"yaml": CASE}).json()
    assert values["suggested_title"] == "Sphere, radius 10 mm, on Zener 10 MPa, 4 N"
    changed = values["case"] | {"load": {"kind": "ramp", "force": "5 N", "duration": "2 s"}}
    asked = {"case": changed, "yaml": CASE}
    kept = client.post("/api/yaml", json=asked).json()["yaml"]
    assert kept.startswith("title: Zener sphere\n")
    named = client.post("/api/yaml", json=asked | {"titled": False}).json()["yaml"]
    assert named.startswith("title: Sphere, radius 10 mm, on Zener 10 MPa, ramp to 5 N in 2 s\n")
    nothing = client.post("/api/yaml", json={"case": {"load": {}}, "titled": False}).json()
    assert nothing["yaml"] == "{}\n"


def test_text_that_is_changed_in_a_form_keeps_its_comments(client: TestClient) -> None:
    text = "# mine\nload:  # soon more\n  kind: step\n  force: 4 N  # much\ntitle: a\n"
    values = {"load": {"kind": "step", "force": "5 N"}, "title": "a", "tolerance": 1e-5}
    answer = client.post("/api/yaml", json={"case": values, "yaml": text})
    assert answer.json()["yaml"] == (
        "# mine\nload:  # soon more\n  kind: step\n  force: 5 N  # much\n"
        "title: a\ntolerance: 1e-05\n"
    )
    broken = client.post("/api/yaml", json={"case": values, "yaml": "load: ["}).json()["yaml"]
    assert client.post("/api/case", json={"yaml": broken}).json()["case"] == values


def test_schema_is_that_of_the_command_line(
    client: TestClient, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["schema"]) == 0
    assert client.get("/api/schema").json() == json.loads(capsys.readouterr().out)


def drawing(client: TestClient, what: str, *, dark: bool = False, narrow: bool = False) -> str:
    wish = {"yaml": CASE, "what": what, "dark": dark, "narrow": narrow}
    answer = client.post("/api/drawing", json=wish)
    (drawn,) = answer.json()
    assert ElementTree.fromstring(drawn["svg"]).tag.endswith("svg")
    return str(drawn["svg"])


def test_drawings_come_in_ink_for_light_and_for_dark_ground(client: TestClient) -> None:
    assert "#262626" in drawing(client, "load")
    assert "#262626" not in drawing(client, "load", dark=True)
    answer = client.post("/api/drawing", json={"yaml": CASE, "what": "indenter_material"})
    assert answer.status_code == 422
    assert "rigid" in answer.json()["problems"][0]["message"]


def oscillation(folder: Path) -> bytes:
    """Workbook with an oscillation test of a Zener solid, with its loss 40 % too large."""
    book, path = openpyxl.Workbook(), folder / "dma.xlsx"
    sheet = book.create_sheet("DMA")
    sheet.append(["f [Hz]", "E' [MPa]", "E'' [MPa]"])
    for power in range(-4, 5):
        x = 10 ** (power / 2)
        sheet.append([x / (2 * math.pi), 1 + 9 * x**2 / (1 + x**2), 1.4 * 9 * x / (1 + x**2)])
    book.save(path)
    return path.read_bytes()


def test_a_sheet_is_uploaded_and_its_fit_is_drawn_with_its_misfit(
    client: TestClient, tmp_path: Path
) -> None:
    sent = client.post("/api/files?name=dma.xlsx", content=oscillation(tmp_path))
    assert sent.status_code == 201
    head, tail = CASE.split("  law: zener")[0], CASE[CASE.index("load:") :]
    case = f"{head}  law: table\n  file: dma.xlsx#DMA\n  poisson_ratio: 0.5\n{tail}"
    answer = client.post("/api/check", json={"yaml": case, "quality": "coarse"})
    assert answer.status_code == 200, answer.text
    assert any("fitted to dma.xlsx#DMA" in note for note in answer.json()["notes"])
    assert any("misses" in warning for warning in answer.json()["warnings"])
    (found,) = client.post("/api/drawing", json={"yaml": case, "what": "material"}).json()
    drawn = found["svg"]
    for words in ("Storage modulus", "Loss modulus", "Residual [%]", "Misses the data: "):
        assert f"<!-- {words}" in drawn
    wrong = case.replace("dma.xlsx#DMA", "dma.xlsx#Data")
    (problem,) = client.post("/api/check", json={"yaml": wrong}).json()["problems"]
    assert "has no sheet 'Data'; there are 'Sheet', 'DMA'" in problem["message"]
    assert problem["path"] == "material.file"
    client.delete("/api/files/dma.xlsx")


def test_the_contents_of_a_file_say_where_a_case_names_it(
    client: TestClient, tmp_path: Path
) -> None:
    heights = tmp_path / "map.npy"
    np.save(heights, np.random.default_rng(1).normal(size=(8, 6)) * 1e-6)
    files = {
        "map.npy": heights.read_bytes(),
        "dma.xlsx": oscillation(tmp_path),
        "creep.csv": b"time [s],creep_compliance [1/MPa]\n1,1\n10,2\n100,3\n",
        "load.csv": b"time [s],force [N]\n0,0\n1,2\n",
        "curve.csv": b"time [s],position [um],deflection [nm]\n0,0,0\n1,1,2\n2,2,4\n",
        "notes.txt": b"to be done\n",
    }
    found = {}
    for name, content in files.items():
        assert client.post(f"/api/files?name={name}", content=content).status_code == 201
        found[name] = client.get(f"/api/files/{name}/contents")
        client.delete(f"/api/files/{name}")
    sections = {name: answer.json().get("section") for name, answer in found.items()}
    assert sections == {
        "map.npy": {"shape": "height-map", "file": "map.npy"},
        "dma.xlsx": {"law": "table", "file": "dma.xlsx"},
        "creep.csv": {"law": "table", "file": "creep.csv"},
        "load.csv": {"kind": "history", "file": "load.csv"},
        "curve.csv": None,
        "notes.txt": None,
    }
    assert found["curve.csv"].json()["holds"] == "a force curve"
    assert found["notes.txt"].status_code == 422
    assert client.get("/api/files/notes.txt/contents").status_code == 404


@pytest.mark.slow
def test_fits_of_layers_are_drawn_below_the_curves(client: TestClient, tmp_path: Path) -> None:
    client.post("/api/files?name=dma.xlsx", content=oscillation(tmp_path))
    body = """\
  base: rigid
  layers:
    - {thickness: 2 mm, law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.4}
    - {thickness: 1 mm, law: table, file: dma.xlsx#DMA, poisson_ratio: 0.4}
"""
    case = f"{CASE.split('  law: zener')[0]}{body}{CASE[CASE.index('load:') :]}"
    answer = client.post("/api/drawing", json={"yaml": case, "what": "material"})
    assert answer.status_code == 200, answer.text
    curves, fit = answer.json()
    assert (curves["caption"], fit["caption"]) == ("", "material.layers[2]")
    assert "<!-- Creep compliance" in curves["svg"]
    for words in ("Storage modulus", "Residual [%]", "Misses the data: "):
        assert f"<!-- {words}" in fit["svg"]
    client.delete("/api/files/dma.xlsx")


@pytest.mark.slow
@pytest.mark.parametrize("missing", [False, True])
def test_spectrum_of_a_measured_surface_is_drawn_below_its_shape(
    missing: bool, client: TestClient
) -> None:
    examples = files("viscontact.case.examples")
    given = np.load(io.BytesIO((examples / "rough-patch.npz").read_bytes()))
    arrays = {name: np.array(given[name]) for name in given.files}
    if missing:
        arrays["height"][3, 4] = np.nan
    np.savez(file := io.BytesIO(), **arrays)
    client.post("/api/files?name=rough-patch.npz", content=file.getvalue())
    case = (examples / "rough-ball.yaml").read_text(encoding="utf-8")
    case = case.replace("missing: refuse", "missing: hole")
    answer = client.post("/api/drawing", json={"yaml": case, "what": "indenter"})
    assert answer.status_code == 200, answer.text
    shape, spectrum = answer.json()
    assert shape["svg"]
    if missing:
        assert spectrum["svg"] == ""
        assert spectrum["caption"].endswith(
            "no power spectrum is drawn, because points are missing"
        )
    else:
        assert "<!-- Power spectral density" in spectrum["svg"]
        assert "Sq" in spectrum["svg"]
    client.delete("/api/files/rough-patch.npz")


def test_what_can_be_read_is_drawn_while_the_rest_is_wrong(client: TestClient) -> None:
    wrong_force = CASE.replace("4 N", "4 Pa")
    wrong_ball = CASE.replace("10 mm", "ten")
    assert CASE not in (wrong_force, wrong_ball)
    drawn = {}
    for name, text in {"force": wrong_force, "ball": wrong_ball}.items():
        for what in ("indenter", "material", "load"):
            answer = client.post("/api/drawing", json={"yaml": text, "what": what})
            drawn[name, what] = answer.status_code
            if answer.status_code == 422:
                assert len(answer.json()["problems"]) == 1
    refused = [key for key, code in drawn.items() if code != 200]
    assert refused == [("force", "load"), ("ball", "indenter")]


def test_an_automatic_grid_is_found_once_for_a_check_and_a_drawing(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    found: list[str] = []

    def counted(case: Case, *, roughly: bool) -> PreparedRun:
        found.append(case.title)
        return prepared(case, roughly=roughly)

    monkeypatch.setattr(case_reader, "prepared", counted)
    first, second = (CASE.replace("Zener sphere", name) for name in ("first", "second"))
    assert client.post("/api/check", json={"yaml": first}).status_code == 200
    wish = {"yaml": first, "what": "indenter"}
    assert client.post("/api/drawing", json=wish).status_code == 200
    for text in (second, second, first):
        assert client.post("/api/check", json={"yaml": text}).status_code == 200
    assert found == ["first", "second", "first"]
    # A file may be another one the next time.
    text = CASE.replace("kind: step\n  force: 4 N", "kind: history\n  file: load.csv")
    for force in (4, 5):
        content = f"time [s], force [N]\n0, 0\n1, {force}\n"
        client.post("/api/files?name=load.csv", content=content.encode())
        checked = client.post("/api/check", json={"yaml": text}).json()
        assert checked["cells"] == [24, 24]
    assert len(found) == 5
    client.delete("/api/files/load.csv")


def test_drawings_for_a_phone_stand_below_one_another(client: TestClient) -> None:
    drawn = ElementTree.fromstring(drawing(client, "material", narrow=True))
    width, height = (float(drawn.attrib[name].removesuffix("pt")) for name in ("width", "height"))
    assert width / 72 * 96 < 350 < height / 72 * 96  # a phone is 360 to 430 pixels wide


@pytest.mark.slow
def test_every_part_of_a_case_is_drawn(client: TestClient) -> None:
    drawn = [drawing(client, what) for what in ("indenter", "material", "load")]
    assert len(set(drawn)) == 3


def test_the_form_of_a_case_with_aliases_has_the_canonical_keys(client: TestClient) -> None:
    text = CASE.replace("radius: 10 mm", "diameter: 20 mm")
    assert text != CASE
    found = client.post("/api/case", json={"yaml": text}).json()["case"]
    assert found == client.post("/api/case", json={"yaml": CASE}).json()["case"]
    written = client.post("/api/yaml", json={"case": found, "yaml": text}).json()["yaml"]
    assert "radius: 10 mm" in written
    assert "diameter" not in written
