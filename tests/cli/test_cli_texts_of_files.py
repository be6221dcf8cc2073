"""Texts of files reach messages as they are, with controls as escapes: names, values, headings."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import openpyxl
import pytest

import viscontact as vc
from viscontact.cli import main

#: Markup of rich, formulas, HTML, formats and a change of direction: signs of texts in files.
TEXT = "[b]x[/b]\u202e $x$ <i>&amp; {0} %s 100% a_b"
#: The same with controls of terminals, for YAML and JSON, which have escapes for them.
CONTROLS = "[b]x \x1b[31m \x07 \x9b \u202e"
ESCAPED = r"[b]x \x1b[31m \x07 \x9b \u202e"
OPTIONS = ("--data", "shear", "--poisson-ratio", "0.4")
UNITS = ("--modulus-unit", "MPa", "--time-unit", "s")


def table(*lines: str) -> Callable[[Path], list[str]]:
    """Write a table, and return the words that read it."""

    def write(folder: Path) -> list[str]:
        (folder / "t.csv").write_text("\n".join(lines), encoding="utf-8")
        return ["material", "t.csv", *OPTIONS]

    return write


def card(name: str, text: str) -> Callable[[Path], list[str]]:
    """Write a card, and return the words that read it."""

    def write(folder: Path) -> list[str]:
        (folder / name).write_text(text, encoding="utf-8")
        return ["material", name, *UNITS]

    return write


def workbook(folder: Path) -> list[str]:
    book = openpyxl.Workbook()
    book.active.title = "$x$ {0} %s \u202e"
    book.active.append(["time [s]", TEXT])
    book.active.append([0.0, 1.0])
    book.save(folder / "t.xlsx")
    return ["material", "t.xlsx", *OPTIONS]


def rows_of_runs(folder: Path) -> list[str]:
    (folder / "c.yaml").write_text(json.dumps(CASE), encoding="utf-8")
    (folder / "t.csv").write_text(f"load.force [N],{TEXT}\n1,2\n", encoding="utf-8")
    return ["run", "c.yaml", "--table", "t.csv", "-o", "runs"]


CASE = {
    "indenter": {"shape": "sphere", "radius": "10 mm"},
    "material": {"law": "elastic", "shear_modulus": "3 MPa", "poisson_ratio": 0.4},
    "load": {"kind": "step", "force": "4 N"},
    "time": {"end": "5 s", "steps": 2},
}
READERS: dict[str, Callable[[Path], list[str]]] = {
    "heading": table(f"time [s],{TEXT} [1/MPa]", "0,1", "1,2"),
    "unit": table(f"time [s],J [{TEXT}]", "0,1", "1,2"),
    "value": table("time [s],J [1/MPa]", "0,1", f"1,{TEXT}"),
    "column beside": table(f"time [s],J [1/MPa],{TEXT}", "0,1,1", "1,2,1"),
    "text of a workbook": workbook,
    "heading of runs": rows_of_runs,
    "name in a card of Abaqus": card(
        "a.inp",
        f'*MATERIAL, NAME="{TEXT}"\n*ELASTIC\n100., 0.3\n*VISCOELASTIC, TIME=PRONY\n0.5,,1.\n',
    ),
    "title in a card of LS-DYNA": card(
        "a.k", f"*KEYWORD\n*MAT_ELASTIC_TITLE\n{TEXT}\n         1     1E-9     100.0       0.3\n"
    ),
}


@pytest.mark.parametrize("place", READERS)
def test_texts_of_files_are_printed_as_they_are(
    place: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "1000")
    assert main(READERS[place](tmp_path)) in (0, 2)
    printed = "".join(capsys.readouterr())
    assert "fault of viscontact" not in printed
    assert r"[b]x[/b]\u202e $x$ <i>&amp; {0} %s 100% a" in printed
    assert not [sign for sign in printed if not sign.isprintable() and sign != "\n"]


@pytest.mark.parametrize("suffix", ["csv", "inp", "mac", "k", "txt", "xyz", "stl", "yaml"])
@pytest.mark.parametrize("control", ["\x1b[31m", "\x07", "\x9b31m"])
def test_files_with_controls_end_in_messages_without_them(
    suffix: str,
    control: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    name = f"t.{suffix}"
    Path(name).write_text(
        f"{control}a {control}\n1,{control}\n*MATERIAL, NAME={control}\n", "utf-8"
    )
    shape = {"shape": "height-map", "file": name, "width": "1 mm"}
    Path("c.yaml").write_text(json.dumps(CASE | {"indenter": shape}), encoding="utf-8")
    for words in (["material", name], ["fit", name], ["check", name], ["check", "c.yaml"]):
        assert main(words) == 2
    printed = "".join(capsys.readouterr())
    assert "fault of viscontact" not in printed
    assert not [sign for sign in printed if not sign.isprintable() and sign != "\n"]


@pytest.mark.parametrize(
    "change",
    [
        {CONTROLS: 1},
        {"indenter": {"shape": CONTROLS}},
        {"indenter": {"shape": "sphere", CONTROLS: "1 mm"}},
        {"load": {"kind": "step", "force": f"4 {CONTROLS}"}},
        {"material": {"law": "table", "file": CONTROLS, "poisson_ratio": 0.4}},
        {"material": {"law": "file", "file": CONTROLS}},
        {"load": {"kind": "program", "sentences": [CONTROLS]}},
        {"title": [CONTROLS]},
    ],
    ids=lambda change: ascii(next(iter(change))),
)
def test_tracebacks_of_a_case_show_its_controls_as_escapes(
    change: dict[str, object], tmp_path: Path
) -> None:
    path = tmp_path / "c.yaml"
    path.write_text(json.dumps(CASE | change), encoding="utf-8")  # JSON has escapes for controls
    with pytest.raises(vc.case.CaseError) as refused:
        vc.case.read_case(path)
    text = str(refused.value)
    assert r"[b]x \x1b" in re.sub(r"\\+", r"\\", text)
    assert not [sign for sign in text if not sign.isprintable() and sign != "\n"]
