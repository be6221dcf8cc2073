"""`viscontact material`: the library, one material, a file; never a traceback."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import viscontact as vc
from viscontact.bodies.materials import library
from viscontact.cli import main

ZENER = """\
material:
  law: zener
  shear_modulus: 10 MPa
  delayed_modulus: 10 MPa
  viscosity: 10 MPa s
  poisson_ratio: 0.5
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    here = tmp_path / "my materials"
    here.mkdir()
    (here / "zener.yaml").write_text(ZENER, encoding="utf-8")
    monkeypatch.chdir(here)
    return here


def test_without_a_name_the_library_is_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["material"]) == 0
    lines = capsys.readouterr().out.splitlines()
    listed = [line.split()[0] for line in lines[:-1] if not line.startswith(" ")]
    assert listed == list(library.names())
    asphalt = next(line for line in lines if line.startswith("asphalt-binder-22c"))
    assert asphalt.split(maxsplit=1)[1].split("  ")[-1].strip() == "10 ms to 10 s"
    assert max(map(len, lines)) <= 100


@pytest.mark.parametrize("name", library.names())
def test_a_shipped_material_names_its_source(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["material", name]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    entry = library.entry(name)
    for text in (entry.title, entry.source, entry.checked, entry.volume, entry.licence):
        assert " ".join(text.split()) in printed
    assert f"law: {entry.material['law']}" in printed
    assert ("not measured" in printed) == (entry.measured is not None)


def test_values_at_the_decades_are_the_laws(capsys: pytest.CaptureFixture[str]) -> None:
    main(["material", "pmma-paper"])
    row = next(line for line in capsys.readouterr().out.splitlines() if " 10 s " in f"{line} ")
    # Eq. 15 at 10 s: 7e-4 - 6.17e-5 / e - 8.38e-5 exp(-0.0747) = 5.9953e-4 / MPa; J is 0.62 of it.
    assert row.split()[2] == "0.5995"
    assert row.split()[4] == "0.3717"


def test_a_file_is_shown_like_a_shipped_material(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["material", "zener.yaml"]) == 0
    printed = capsys.readouterr().out
    assert "Zener, Poisson's ratio 0.5" in printed
    # 2 Phi(inf) = 1/10 + 1/10 per MPa, G(inf) = 5 MPa, J(inf) = Phi/2.
    assert printed.splitlines()[-2].split()[2:] == ["0.1000", "5.000", "0.05000"]
    assert "not measured" not in printed


@pytest.mark.parametrize(
    ("which", "suffix"),
    [
        pytest.param("polystyrene-130c", "png", marks=pytest.mark.slow),
        ("zener.yaml", "svg"),
    ],
)
def test_a_figure_is_written_where_asked(
    folder: Path, which: str, suffix: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["material", which, "-o", f"law.{suffix}"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == f"law.{suffix}"
    assert (folder / f"law.{suffix}").stat().st_size > 5000


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["pmma"], "'pmma'; did you mean 'pmma-paper' or 'pmma-kumar-2004'?"),
        (["polystirene-130c"], "did you mean 'polystyrene-130c'?"),
        (["xyz"], "There are pmma-paper, pmma-kumar-2004"),
        (["zenner.yaml"], "zenner.yaml: no such file; did you mean 'zener.yaml'?"),
        (["."], ".: is a directory"),
        (["pmma-paper", "-o", "law.bmp"], "path must end in .png, .pdf or .svg"),
        (["pmma-paper", "-o", "nowhere/law.png"], "nowhere/law.png: "),
        (["-o", "law.png"], "law.png: a figure shows one material; name it"),
    ],
)
def test_refusals_are_one_line_and_exit_code_2(
    folder: Path, arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["material", *arguments]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert len(error.splitlines()) == 1
    assert [path.name for path in folder.iterdir()] == ["zener.yaml"]


def test_a_broken_file_is_refused_with_line_and_key(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "bad.yaml").write_text(ZENER.replace("10 MPa s", "10 MPa"), encoding="utf-8")
    assert main(["material", "bad.yaml"]) == 2
    assert "bad.yaml:5: material.viscosity: cannot read '10 MPa'" in capsys.readouterr().err


@pytest.mark.slow
def test_without_the_plot_extra_one_line_says_what_to_install(folder: Path) -> None:
    code = (
        "import sys; sys.modules['matplotlib'] = None\n"
        "from viscontact.cli import main\n"
        "sys.exit(main(['material', 'pmma-paper', '-o', 'law.png']))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.strip() == "figures need matplotlib: pip install 'viscontact[plot]'"


def test_the_help_ends_with_an_example(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["material", "--help"]) == 0
    last = [line for line in capsys.readouterr().out.splitlines() if line.strip()][-1]
    assert last.strip() == "Example:  viscontact material pmma-paper -o pmma.png"


def test_python_has_the_shipped_materials_by_name() -> None:
    assert vc.shipped_material("pmma-paper").poisson_ratio == 0.38
