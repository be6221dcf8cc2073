"""Cases with closed forms, and how to find their sensitivities."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import viscontact as vc

#: Hertz's point contact; a paraboloid, because a sphere deviates by (a/R)^2.
HERTZ = """
title: Hertz
indenter: {shape: paraboloid, radius_x: 10 mm, radius_y: 10 mm}
material: {data: uniaxial, law: elastic, youngs_modulus: 10 MPa, poisson_ratio: 0.4}
load: {kind: step, force: 1 N}
time: {end: 1 s, steps: 1}
grid: {shape: [48, 48], size: [2.4 mm, 2.4 mm]}
"""


def written(folder: Path, text: str) -> Path:
    """Case file of a text."""
    path = folder / "case.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def deviations(found: vc.SensitivityResult, wanted: dict[tuple[str, str], float]) -> dict[Any, Any]:
    """Elasticities that differ from known ones by more than their errors."""
    table, wrong = found.table, {}
    for (output, key), value in wanted.items():
        one = table.sel(output=output, input=key)
        elasticity, error = float(one.elasticity), float(one.elasticity_error)
        if not abs(elasticity - value) <= error:
            wrong[output, key] = (elasticity, error, value)
    return wrong
