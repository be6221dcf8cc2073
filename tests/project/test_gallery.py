"""The examples of the manual's gallery: each runs unchanged, draws, and checks its number."""

from __future__ import annotations

import ast
import runpy
import warnings
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
from matplotlib.figure import Figure

GALLERY = Path(__file__).parents[2] / "docs" / "gallery"
SCRIPTS = sorted(GALLERY.glob("plot_*.py"))
# What takes least runs every time.
QUICK = ("08", "13", "14")


def names_of(scripts: list[Path]) -> list[object]:
    """The scripts as parameters, those that take longer marked slow."""
    return [
        pytest.param(
            script, id=script.stem, marks=() if script.stem[5:7] in QUICK else pytest.mark.slow
        )
        for script in scripts
    ]


def test_each_example_has_its_picture_in_the_folder() -> None:
    page = (GALLERY / "index.md").read_text(encoding="utf-8")
    for script in SCRIPTS:
        title = (ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or "").split(
            "\n"
        )[0]
        picture = f"../images/gallery/{script.stem}.png"
        assert f"[![{title}]({picture})<br>{title}]({script.name})" in page
        assert (GALLERY / picture).is_file()


@pytest.mark.parametrize("script", names_of(SCRIPTS))
def test_example_draws_and_its_number_is_right(
    script: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    plt.switch_backend("Agg")
    # A warning that an example does not say why it leaves aside is an error here.
    with warnings.catch_warnings():
        made = runpy.run_path(str(script), run_name="__main__")
    assert capsys.readouterr().out.strip()
    assert [value for value in made.values() if isinstance(value, Figure)]
    plt.close("all")


def test_there_are_at_least_ten_examples_each_of_which_checks_a_number() -> None:
    assert len(SCRIPTS) >= 10
    for script in SCRIPTS:
        tree = ast.parse(script.read_text(encoding="utf-8"))
        assert any(isinstance(node, ast.Assert) for node in ast.walk(tree)), script.name
