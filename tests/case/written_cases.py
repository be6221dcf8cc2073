"""Cases as texts, what is read from them, and the lines that refuse them."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from viscontact.case import CaseError, read_case

ROLLER = """\
title: Crowned roller on PMMA, load off centre
indenter:
  shape: roller
  radius: 5 mm
  half_length: 9.565 mm
  crown_radius: 75 mm
material:
  law: creep-series
  instant: 5.545e-4 / MPa
  amplitudes: [6.17e-5 / MPa, 8.38e-5 / MPa]
  times: [10 s, 133.87 s]
  data: deviatoric
  poisson_ratio: 0.38
load:
  kind: step
  force: 10 kN
  eccentricity_x: 4.78 mm
time:
  end: 1000 s
  steps: 120
  spacing: log
grid:
  shape: [256, 128]
  size: [50 mm, 5 mm]
output:
  fields: [0 s, 30 s, 240 s, 1000 s]
"""
SPHERE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 10 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 1 N}
time: {end: 1 s, steps: 4}
"""


def written(folder: Path, text: str, name: str = "case.yaml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def problems(folder: Path, text: str, *overrides: str, name: str = "case.yaml") -> tuple[str, ...]:
    """Problems of a case file, without the folder in front."""
    with pytest.raises(CaseError) as refusal:
        read_case(written(folder, text, name), overrides)
    return tuple(line.replace(f"{folder}{os.sep}", "") for line in refusal.value.problems)
