"""A case of a creeping sphere, a folder with it, and its finished run."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from viscontact.cli import main

SPHERE = """\
title: Zener sphere
indenter:
  shape: sphere
  radius: 10 mm
material:
  law: zener
  shear_modulus: 10 MPa
  delayed_modulus: 10 MPa
  viscosity: 10 MPa s
  poisson_ratio: 0.5
load:
  kind: step
  force: 4 N
time:
  end: 5 s
  steps: 6
grid:
  shape: [32, 32]
  size: [3 mm, 3 mm]
output:
  errors: false
"""
ERRORS = ["--set", "output.errors=true"]


class Terminal(io.StringIO):
    """What is written to a terminal."""

    def isatty(self) -> bool:
        """Yes."""
        return True


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working directory whose name has a space, with a case in it."""
    here = tmp_path / "my runs"
    here.mkdir()
    (here / "case.yaml").write_text(SPHERE, encoding="utf-8")
    monkeypatch.chdir(here)
    return here


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The directory of a finished run."""
    here = tmp_path_factory.mktemp("finished")
    (here / "case.yaml").write_text(SPHERE, encoding="utf-8")
    assert main(["run", str(here / "case.yaml"), "-q", *ERRORS]) == 0
    return here / "case"


ADAPTIVE = ["--set", "time={end: 5 s, spacing: adaptive, tolerance: 0.01}"]
