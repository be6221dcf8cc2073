"""Ends of bodies in case files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from closeness import close_to
from viscontact import Body
from viscontact.case import CaseError, read_case

CASE = """
indenter: {{shape: sphere, radius: 10 mm}}
material: {{law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.4, {ends}}}
load: {{kind: step, force: 1 N}}
time: {{end: 1 s, steps: 1}}
grid: {{shape: [32, 32], size: [4 mm, 4 mm]}}
"""


def _case(folder: Path, ends: str) -> Any:
    path = folder / "case.yaml"
    path.write_text(CASE.format(ends=ends), encoding="utf-8")
    return read_case(path)


def test_a_case_gives_the_ends_of_a_body(tmp_path: Path) -> None:
    body = _case(tmp_path, "length: 60 mm, centre: 29 mm, ends: [free, null]").material
    assert isinstance(body, Body)
    assert body.ends == ("free", None)
    assert body.planes == (close_to(-1e-3, rel=1e-12), None)
    assert _case(tmp_path, "length: 60 mm, ends: held").material.ends == ("held", "held")


@pytest.mark.parametrize(
    ("ends", "why"),
    [
        ("ends: free", "length: a body that ends has a length"),
        ("length: 60 mm", "ends: a body that ends has a length"),
        ("centre: 1 mm", "centre: is that of a body that ends"),
        ("length: 60 mm, ends: [null, null]", "a body without ends is a Material"),
        ("length: 60 mm, ends: loose", "ends"),
    ],
)
def test_an_end_that_is_not_complete_is_refused(tmp_path: Path, ends: str, why: str) -> None:
    with pytest.raises(CaseError, match=why):
        _case(tmp_path, ends)


ROLLER = """
indenter: {{shape: roller, radius: 10 mm, {length}}}
material: {{law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.4}}
indenter_material: {{law: elastic, shear_modulus: 80 GPa, poisson_ratio: 0.3, {ends}}}
load: {{kind: step, force: 1 N}}
time: {{end: 1 s, steps: 1}}
"""


def _roller(folder: Path, length: str, ends: str) -> Any:
    path = folder / "case.yaml"
    path.write_text(ROLLER.format(length=length, ends=ends), encoding="utf-8")
    return read_case(path).indenter_material


def test_the_material_of_a_roller_ends_where_the_roller_does(tmp_path: Path) -> None:
    for length in ("length: 5 mm", "half_length: 2.5 mm", "length: 5 mm, profile: iso-16281"):
        body = _roller(tmp_path, length, "ends: free")
        assert isinstance(body, Body)
        assert body.planes == close_to((-2.5e-3, 2.5e-3), rel=1e-12)
    own = _roller(tmp_path, "length: 5 mm", "ends: [free, null], length: 5 mm")
    assert own.planes == (close_to(-2.5e-3, rel=1e-12), None)


def test_a_roller_without_end_leaves_no_length_to_its_material(tmp_path: Path) -> None:
    with pytest.raises(
        CaseError, match=r"indenter_material\.length: a body that ends has a length"
    ):
        _roller(tmp_path, "half_length: 2.5 mm, crown_radius: 50 mm", "ends: free")
