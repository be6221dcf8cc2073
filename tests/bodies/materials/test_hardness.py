"""Young's modulus of rubbers from their Shore hardness."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials.hardness import READ_AT


@pytest.mark.parametrize("hardness", [30.0, 50.0, 70.0, 85.0])
def test_the_estimate_is_near_the_flat_punch_under_the_spring_of_the_durometer(
    hardness: float,
) -> None:
    # ASTM D2240, type A: F = 0.550 N + 0.075 N S, 2.5 mm (1 - S/100) deep, on a truncated cone of
    # 0.79 mm at the end of a pin of 1.27 mm. Gent (1958) takes a flat punch of the mean radius a:
    # E = 3 F/(8 a w) of an incompressible half-space.
    force, depth = 0.550 + 0.075 * hardness, 2.54e-3 * (1 - hardness / 100)
    punch = 3 * force / (8 * (0.79e-3 + 1.27e-3) / 4 * depth)
    found = vc.modulus_from_shore(hardness)
    logarithmic = 1e6 * 10 ** (0.0235 * hardness - 0.6403)
    assert found.youngs_modulus == close_to(math.sqrt(punch * logarithmic), rel=0.01)
    assert found.lowest < punch < found.highest


#: Hardness and Young's modulus of black-filled natural rubber (designers' table: 830 and
#: 1340 lbf/in^2), and of polyurethanes (data sheets of flexural moduli: 20 000 to 22 000 lbf/in^2).
MEASURED = [
    (65.0, "A", 830 * 6894.76),
    (75.0, "A", 1340 * 6894.76),
    (55.0, "D", 20e3 * 6894.76),
    (55.0, "D", 22e3 * 6894.76),
]


@pytest.mark.parametrize(("hardness", "scale", "measured"), MEASURED)
def test_measured_moduli_lie_in_the_range(hardness: float, scale: str, measured: float) -> None:
    found = vc.modulus_from_shore(hardness, scale)  # type: ignore[arg-type]
    assert found.lowest < measured < found.highest
    if scale == "A":
        assert found.youngs_modulus == close_to(measured, rel=0.1)


def test_the_tested_epdm_lies_in_the_range_of_its_hardness() -> None:
    # Its source calls it epdm_70.
    material = vc.shipped_material("epdm-70-25c")
    found = vc.modulus_from_shore(70)
    assert found.lowest < 3 * float(material.law.relaxation(READ_AT)) < found.highest


def test_estimates_grow_with_the_hardness_and_overlap_between_the_scales() -> None:
    on_a = [vc.modulus_from_shore(each).youngs_modulus for each in np.linspace(20, 90, 29)]
    assert np.all(np.diff(on_a) > 0)
    # 80 and 90 Shore A are about 30 and 40 Shore D (conversion chart of ASTM D2240).
    soft, hard = vc.modulus_from_shore(80), vc.modulus_from_shore(30, "D")
    assert soft.lowest < hard.youngs_modulus < soft.highest


@pytest.mark.parametrize(
    ("hardness", "scale", "message"),
    [
        (95, "A", "from 20 to 90 Shore A, got 95; a harder one is no rubber"),
        (10, "A", "from 20 to 90 Shore A, got 10$"),
        (75, "D", "from 30 to 60 Shore D, got 75; a harder one is no rubber"),
        (50, "C", "scale must be 'A' or 'D'"),
    ],
)
def test_a_hardness_outside_the_relations_is_refused(
    hardness: float, scale: str, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        vc.modulus_from_shore(hardness, scale)  # type: ignore[arg-type]


@pytest.mark.parametrize("volume", [{"poisson_ratio": 0.49}, {"bulk_modulus": 2e9}])
def test_a_law_has_the_modulus_when_the_durometer_is_read(volume: dict[str, float]) -> None:
    estimate = vc.modulus_from_shore(60)
    law = vc.Zener(2e6, 1e6, 1e6)
    found = vc.Material(law, warning="tested once", **volume).with_hardness(estimate)  # type: ignore[arg-type]
    shear, bulk = float(found.law.relaxation(READ_AT)), volume.get("bulk_modulus")
    young = 2.98 * shear if bulk is None else 9 * bulk * shear / (3 * bulk + shear)
    assert young == close_to(estimate.youngs_modulus, rel=1e-12)
    assert found.law(10.0) / found.law(0.0) == close_to(law(10.0) / law(0.0), rel=1e-12)
    assert found.warning is not None
    assert found.warning.startswith("tested once; the stiffness is estimated from 60 Shore A")
