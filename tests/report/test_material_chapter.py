"""The materials of a report: curves of what creeps, and the modulus of what does not."""

from __future__ import annotations

import pytest
import xarray as xr

import viscontact as vc
from viscontact.drawing.svg.html import written
from viscontact.report.input_chapters import material_chapter

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

STEEL = vc.Material(vc.Elastic.from_uniaxial(210e9, poisson_ratio=0.3), 0.3)
POLYMER = vc.Material(vc.Zener(1e9, 1e9, 1e9), 0.4)
COVER = vc.Layered([vc.Layer(1e-3, vc.Material(vc.Elastic(1e9), 0.4))], base=STEEL)


def chapter(body: vc.Material | vc.Layered, indenter: vc.Material | None = None) -> str:
    grid, load = vc.Grid((16, 16), (4e-4, 4e-4)), vc.step(1.0)
    ds: xr.Dataset = vc.simulate(
        *(vc.Sphere(10e-3), body, load, grid, [0.0, 1.0]),
        indenter_material=indenter,
        errors=False,
    )
    return "".join(map(written, material_chapter(ds)))


def test_an_elastic_body_has_its_modulus_in_place_of_constant_curves() -> None:
    text = chapter(STEEL, POLYMER)
    half_space, indenter = text.split("<h3>Indenter</h3>")
    assert "Elastic, without creep: shear modulus 80.77 GPa." in half_space
    assert "<img" not in half_space
    assert "<img" in indenter


def test_elastic_layers_have_the_modulus_of_each() -> None:
    assert "shear modulus 1 GPa (layer 1), 80.77 GPa (base)." in chapter(COVER)
