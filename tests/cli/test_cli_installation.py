"""`doctor` and `cite`: what is installed, and how to cite it."""

from __future__ import annotations

import sys
from importlib import metadata
from pathlib import Path

import pytest
from ruamel.yaml import YAML

import viscontact
from viscontact.cli import main
from viscontact.runs.machine import packages

CITATION = Path(__file__).parents[2] / "CITATION.cff"


def test_doctor_names_the_versions_of_all_packages(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor"]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    found = {row[0]: row[1] for row in rows if len(row) > 1}
    assert found["viscontact"] == viscontact.__version__
    assert found["Python"].rstrip(",") == sys.version.split()[0]
    for name in ("numpy", "xarray", "matplotlib", "fastapi"):
        assert found[name] == metadata.version(name)


def test_doctor_says_how_to_install_what_is_missing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    installed = packages._installed
    lacking = ("matplotlib", "ducc0")
    monkeypatch.setattr(packages, "_installed", lambda n: None if n in lacking else installed(n))
    assert main(["doctor"]) == 0
    said = capsys.readouterr().out
    assert "matplotlib missing; to install: pip install 'viscontact[plot]'" in said
    assert "ducc0 missing; to install: pip install 'viscontact[fast]'" in said


@pytest.mark.parametrize("options", [[], ["--bibtex"]])
def test_citation_is_that_of_the_file(
    options: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["cite", *options]) == 0
    said = capsys.readouterr().out
    cited = YAML(typ="safe").load(CITATION)
    [paper] = cited["references"]
    names = [author["family-names"] for author in paper["authors"]]
    for words in (cited["title"], str(cited["version"]), cited["license"], paper["title"], *names):
        assert words in said
    assert str(paper["year"]) in said
