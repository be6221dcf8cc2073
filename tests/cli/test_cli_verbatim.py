"""Titles and names reach terminal, figures, reports and tables as they are, controls as escapes."""

from __future__ import annotations

import html
import io
import json
import re
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

import matplotlib as mpl
import pytest
import typer

import viscontact as vc
from reports_without_pictures import without_pictures
from viscontact.cli import main
from viscontact.cli.shell import application
from viscontact.cli.terminal.bars import bars_of_runs
from viscontact.cli.terminal.console import TextConsole
from viscontact.drawing.plotly.responses import responses

#: Markup of rich, names of signs, formulas, HTML, code of typst, formats, and control characters.
TITLE = (
    "Nip [/b] [b]x [link=http://x]y \\[ :warning: $x$ a_b$ \\frac$ <b>&amp;\"' #a *b* `c` {0} 100%s"
    " \x1b[31m \x07 \x9b \u202e \r end"
)
#: The same in names of files, where no system takes a slash and netCDF takes no backslash.
NAME = TITLE.replace("/", "|").replace("\\", "")
#: Name of a file that is a value of a sweep, in the quotes of YAML, which takes no controls.
VALUE = "[b]x $x$ <i>&amp; :warning:.csv"


def as_read(text: str) -> str:
    """Text with the escapes of Python for what is not printed."""
    return "".join(each if each.isprintable() else ascii(each)[1:-1] for each in text)


CASE = {
    "title": TITLE,
    "report": {"project": TITLE, "operator": TITLE, "revision": TITLE},
    "indenter": {"shape": "sphere", "radius": "10 mm"},
    "material": {
        **{"law": "table", "file": f"{NAME}.csv", "quantity": "creep_compliance"},
        **{"data": "shear", "poisson_ratio": 0.4},
    },
    "load": {"kind": "step", "force": "4 N"},
    "time": {"end": "5 s", "steps": 2},
    "grid": {"shape": [16, 16], "size": ["3 mm", "3 mm"]},
    "output": {"errors": False},
}
CURVE = "time [s],J [1/MPa]\n0,0.1\n1,0.15\n10,0.2\n"
OPTIONS = ["--data", "shear", "--poisson-ratio", "0.4"]

__all__ = ["without_pictures"]  # a fixture
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="no such names of files")


class Terminal(io.StringIO):
    """What is written to a terminal."""

    def isatty(self) -> bool:
        """Yes."""
        return True


@pytest.fixture(scope="module")
def computed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a case, two runs of it, and a sweep over two tables."""
    folder = tmp_path_factory.mktemp("computed")
    for name in (f"{NAME}.csv", VALUE):
        (folder / name).write_text(CURVE, encoding="utf-8")
    (folder / f"2{VALUE}").write_text(CURVE.replace("0.1\n", "0.12\n"), encoding="utf-8")
    case = folder / f"{NAME}.yaml"
    case.write_text(json.dumps(CASE), encoding="utf-8")
    for name in (NAME, f"{NAME}2"):
        assert main(["run", str(case), "-o", str(folder / name), "-q"]) == 0
    values = f'material.file="{VALUE}","2{VALUE}"'
    words = ["--vary", values, "-o", str(folder / f"{NAME}s"), "-j", "1", "-q"]
    assert main(["run", str(case), *words]) == 0
    return folder


@pytest.fixture
def folder(computed: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """This folder, in which the commands work, with a terminal that is wide enough."""
    monkeypatch.chdir(computed)
    monkeypatch.setenv("COLUMNS", "1000")
    monkeypatch.setitem(mpl.rcParams, "svg.fonttype", "none")  # texts, not outlines
    return computed


def printed(capsys: pytest.CaptureFixture[str], words: Sequence[str], code: int = 0) -> str:
    """Return what a command prints, after its exit code and the lack of controls are checked."""
    capsys.readouterr()
    with warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)  # of a sign that no font has
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        assert main(list(words)) == code
    found = "".join(capsys.readouterr())
    assert not [each for each in found if not each.isprintable() and each != "\n"]
    return found


#: Words of commands, and their exit codes; each prints the name.
COMMANDS: tuple[tuple[list[str], int], ...] = (
    (["check", f"{NAME}-.yaml"], 2),
    (["check", f"{NAME}.yaml", "--set", f"load.{NAME}=1"], 2),
    (["check", f"{NAME}.yaml", "--plot"], 0),
    (["run", f"{NAME}.yaml", "-o", NAME], 2),
    (["run", f"{NAME}.yaml", "-o", f"{NAME}2", "--overwrite", "-v"], 0),
    (["run", f"{NAME}.yaml", "--table", f"{NAME}.csv", "-o", "new"], 2),
    (["show", f"{NAME}-"], 2),
    (["plot", NAME, "history"], 0),
    (["plot", f"{NAME}s", "response"], 0),
    (["export", NAME, "-o", f"{NAME}.html"], 2),
    (["collect", f"{NAME}s", "-o", f"{NAME}.nc"], 0),
    (["material", f"{NAME}.csv", *OPTIONS], 0),
    (["material", NAME], 2),
    (["material", f"{NAME}.yaml", "--to", "csv", "-o", f"{NAME}-2.csv"], 0),
    (["status", f"{NAME}s"], 0),
    (["fit", f"{NAME}.csv", *OPTIONS, "--terms", "1", "--yaml", f"{NAME}-f.yaml"], 0),
    (["sensitivity", f"{NAME}-.yaml", "--of", "work", "-o", "new"], 2),
    (["design", f"{NAME}-.yaml", "--change", "x=1:2", "--minimise", "work", "-o", "new"], 2),
    (["compare", NAME, f"{NAME}-"], 2),
    (["report", f"{NAME}-"], 2),
    (["heat", f"{NAME}-", "--cooling", "10 W/m2/K", "--ambient", "20 degC", "--area", "1 m2"], 2),
    (["leakage", f"{NAME}-", "--viscosity", "1 mPa s", "--pressure-difference", "1 bar"], 2),
    (["theory", f"{NAME}-.csv", "--material", NAME, "--pressure", "1 MPa"], 2),
    (["demo", NAME], 2),
    (["example", NAME], 2),
    (["example", "sphere-maxwell", "-o", f"{NAME}-e.yaml"], 0),
    (["schema", NAME], 2),
    (["serve", "--no-open", "--dir", f"{NAME}.yaml"], 2),
    (["verify", "--fast", "-o", NAME], 2),
    (["doctor", NAME], 2),
    (["cite", NAME], 2),
)


def test_all_commands_are_tried() -> None:
    assert {words[0] for words, _ in COMMANDS} == set(
        typer.main.get_command(application()).commands
    )  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("words", "code"), COMMANDS, ids=lambda each: "" if isinstance(each, int) else each[0]
)
def test_every_command_prints_names_as_they_are(
    words: list[str], code: int, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = printed(capsys, words, code).replace(r"\x0d", r"\r")  # as Click writes it
    assert as_read(NAME) in found or (words[0] == "export" and not found)


@pytest.mark.slow
def test_a_pdf_has_names_of_any_signs(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert as_read(NAME) in printed(capsys, ["report", NAME, "-o", f"{NAME}.pdf"])


def test_show_prints_the_title_as_it_is(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    # A long title is wrapped to the width of its table.
    assert as_read(TITLE) in " ".join(printed(capsys, ["show", NAME]).split())


def test_errors_of_the_command_line_show_controls(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert "--a\\u202e" in printed(capsys, ["show", "--a\u202e"], 2)


def test_a_terminal_gets_no_controls_but_those_of_colours(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TERM", "xterm-256color")
    for command, text in ((["show", NAME], TITLE), (["status", f"{NAME}s", "--watch"], NAME)):
        screen = Terminal()
        monkeypatch.setattr("sys.stdout", screen)
        assert main(command) == 0
        plain = re.sub(r"\x1b\[[?\d;]*[A-Za-z]", "", screen.getvalue()).replace("\r\n", "\n")
        assert as_read(text) in " ".join(plain.split())
        assert not [each for each in plain if not each.isprintable() and each not in "\r\n"]


def test_names_beside_bars_of_progress_are_no_markup() -> None:
    screen = io.StringIO()
    console = TextConsole(width=1000)
    console.file = screen
    bars = bars_of_runs()
    bars.add_task("[b]x :warning:", total=1.0, details="[/b]")
    console.print(bars.get_renderable())
    assert "[b]x :warning:" in screen.getvalue()
    assert "left, [/b]" in screen.getvalue()


@pytest.mark.parametrize("figure", ["history", "hysteresis", "pressure-map", "contact-outline"])
def test_figures_of_several_runs_name_them_as_they_are(
    figure: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    printed(capsys, ["compare", NAME, f"{NAME}2", "--figure", figure, "-o", "c.svg"])
    # A figure with control characters would not be XML.
    texts = " ".join(" ".join(ElementTree.parse("c.svg").getroot().itertext()).split())
    assert as_read(f"{NAME}2") in texts  # in lines that fit


def test_a_figure_of_a_material_has_its_name_as_it_is(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    printed(capsys, ["material", f"{NAME}.csv", *OPTIONS, "-o", "m.svg"])
    assert as_read(f"{NAME}.csv") in list(ElementTree.parse("m.svg").getroot().itertext())


def test_values_of_a_sweep_are_drawn_as_they_are(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    printed(capsys, ["plot", f"{NAME}s", "response", "-o", "r.svg"])
    assert VALUE in "\n".join(ElementTree.parse("r.svg").getroot().itertext())
    with vc.open_many(f"{NAME}s") as ds:
        figures = [figure.to_dict() for figure in responses(ds)]
    # Plotly reads the entities of HTML, and makes formulas where a notebook has loaded MathJax.
    assert "$" not in json.dumps(figures)
    (ticks,) = {tuple(each["layout"]["xaxis"]["ticktext"]) for each in figures}
    assert VALUE in [html.unescape(text).strip('"') for text in ticks]
    assert not any("<" in text for text in ticks)


@pytest.mark.usefixtures("without_pictures")
def test_a_report_shows_the_title_block_as_it_is(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    printed(capsys, ["report", NAME])
    page = re.sub(
        r"(?s)<script.*?</script>", "", Path(NAME, "report.html").read_text(encoding="utf-8")
    )
    for tag in ("dd", "h1", "title"):
        texts = re.findall(rf"<{tag}[^>]*>(.*?)</{tag}>", page)
        assert any(html.unescape(text).startswith(as_read(TITLE)) for text in texts), tag


def test_a_notebook_shows_the_title_as_it_is(folder: Path) -> None:
    with vc.open_results(NAME) as ds:
        text, drawn = repr(ds.viscontact), ds.viscontact._repr_html_()
    assert as_read(TITLE) in text
    assert as_read(TITLE) in html.unescape(drawn)
    assert "<b>" not in drawn
