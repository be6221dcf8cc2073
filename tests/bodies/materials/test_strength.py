"""Onset of yield in contacts of Hertz."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials.strength import onset_ratio


def test_onset_is_that_of_johnson_at_a_ratio_of_0_3() -> None:
    # K. L. Johnson 1985, Contact Mechanics, eqs. 6.7 and 6.5: p0 = 1.60 Y below a ball, by von
    # Mises and Tresca, and 1.79 Y (von Mises) below a cylinder; both are printed to three digits.
    assert onset_ratio(0.3) == close_to(1.60, abs=0.015)
    assert onset_ratio(0.3, is_line=True) == close_to(1.79, abs=0.005)


def test_a_line_contact_without_contraction_yields_at_its_surface() -> None:
    # At ν = 0 the stresses at the surface are -p0, -p0 and 0: von Mises p0, the largest.
    assert onset_ratio(0.0, is_line=True) == close_to(1.0, rel=1e-9)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize("ratio", [0.3, 0.45])
@pytest.mark.parametrize("is_line", [False, True])
def test_onset_is_that_of_the_computed_stresses(ratio: float, is_line: bool) -> None:
    body = vc.Material(vc.Elastic(1e6), ratio)
    if is_line:
        indenter: vc.Indenter = vc.Paraboloid(np.inf, 10e-3)
        grid = vc.Grid((1, 128), (1e-3, 2e-3), periodic=(True, False))
        load = vc.step(0.1)
    else:
        indenter, grid, load = vc.Sphere(10e-3), vc.Grid((64, 64), (2e-3, 2e-3)), vc.step(0.03)
    ds = vc.simulate(indenter, body, load, grid, [1.0], errors=False)
    half = float(ds.contact_width[0]) / 2
    section = vc.section_stresses(ds, half * np.linspace(0.0, 1.5, 61), x=0.0)
    found = float(ds.peak_pressure[0]) / float(section.von_mises.max())
    # 50 cells across resolve the stress to a per cent.
    assert found == close_to(onset_ratio(ratio, is_line=is_line), rel=0.015)


def test_the_strength_counts_fatigue_only_under_loads_that_repeat() -> None:
    body = vc.Material(vc.Elastic(1e9), 0.3, yield_stress=3e8, fatigue_limit=2e8)
    assert (body.strength(), body.strength(repeats=True)) == (3e8, 2e8)
    assert vc.Material(vc.Elastic(1e9), 0.3).strength(repeats=True) is None
    with pytest.raises(ValueError, match="yield_stress must be a positive"):
        vc.Material(vc.Elastic(1e9), 0.3, yield_stress=-1.0)


def test_the_ratio_at_a_bulk_modulus_is_that_of_the_instantaneous_law() -> None:
    # K = 5 G/3 is ν = 0.25.
    body = vc.Material(vc.Maxwell(3e9, 1e9), bulk_modulus=5e9)
    assert body.instant_poisson_ratio == close_to(0.25, rel=1e-12)
