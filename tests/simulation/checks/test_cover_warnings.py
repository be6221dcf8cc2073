"""Warnings about covers: where they begin, and what their bounds rest on."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.cli import main
from viscontact.simulation.checks.covers import (
    CELLS_PER_LAYER,
    DEEP_COVER,
    SHEARED_COVER,
    Cover,
    cover_warnings,
    covers_of,
)

RUBBER = vc.Material(vc.Elastic(1e6), poisson_ratio=0.49)
STEEL = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
COVER = Cover(depth=1e-3, squeezed=True, incompressible=1e-3)


def kinds(cover: Cover, half_width: float, approach: float, cell: float = 1e-5) -> list[str]:
    return list(cover_warnings([cover], half_width, approach, (1.0, cell)))


def test_warnings_begin_at_their_bounds() -> None:
    deep = DEEP_COVER * 1e-3
    assert kinds(COVER, 0.9e-3, 1.01 * deep) == ["cover"]
    assert kinds(COVER, 0.9e-3, 0.99 * deep) == []
    sheared = SHEARED_COVER * 1e-6 / 10e-3
    assert kinds(COVER, 10e-3, 1.01 * sheared) == ["squeeze"]
    assert kinds(COVER, 10e-3, 0.99 * sheared) == []
    longest = 1e-3 / CELLS_PER_LAYER
    assert kinds(COVER, 1.1e-3, 0.0, 1.01 * longest) == ["layer_cells"]
    assert kinds(COVER, 1.1e-3, 0.0, 0.99 * longest) == []
    assert kinds(COVER, 0.9e-3, 0.0, 1.01 * longest) == []
    # A line contact on a half-space has no approach.
    assert kinds(COVER, 10e-3, np.nan) == []


@pytest.mark.parametrize("ratio", [0.44, 0.46, 0.49])
def test_cover_is_as_incompressible_by_its_bulk_modulus_as_by_poissons_ratio(ratio: float) -> None:
    """K = 2 G (1 + ν)/(3 (1 - 2ν)); a ratio above 0.45 is nearly incompressible."""
    bulk = 2e6 * (1 + ratio) / (3 * (1 - 2 * ratio))
    by_ratio = vc.Material(vc.Elastic(1e6), ratio)
    by_bulk = vc.Material(vc.Elastic(1e6), bulk_modulus=bulk)
    bodies = [vc.Layered([vc.Layer(1e-3, each)], STEEL) for each in (by_ratio, by_bulk)]
    one, other = covers_of(bodies, 0.0)
    assert one == other
    assert one.squeezed == (ratio > 0.45)


@pytest.mark.parametrize(
    ("layers", "base", "bonded", "depth", "squeezed"),
    [
        ([RUBBER], "rigid", True, 1e-3, True),
        ([RUBBER], STEEL, True, 1e-3, True),
        ([RUBBER], STEEL, False, 1e-3, False),  # it slides out as a whole
        ([RUBBER], RUBBER, True, np.inf, True),  # the base gives way as well
        ([RUBBER, RUBBER], STEEL, (True, False), 2e-3, False),
        ([RUBBER, STEEL], RUBBER, True, np.inf, False),
        ([vc.Material(vc.Elastic(1e6), bulk_modulus=2e9)], STEEL, True, 1e-3, True),
        ([vc.Material(vc.Elastic(1e9), bulk_modulus=2e9)], STEEL, True, 1e-3, False),
        ([vc.Material(vc.Maxwell(1e9, 1e9), bulk_modulus=2e9)], STEEL, True, 1e-3, True),
    ],
)  # fmt: skip
def test_cover_is_what_takes_up_the_approach(
    layers: list[vc.Material], base: object, bonded: object, depth: float, squeezed: bool
) -> None:
    """A Maxwell fluid is nearly incompressible once it has relaxed."""
    body = vc.Layered([vc.Layer(1e-3, each) for each in layers], base, bonded)  # type: ignore[arg-type]
    (cover,) = covers_of([body, STEEL], 100.0)
    assert (cover.depth, cover.squeezed) == (close_to(depth), squeezed)


def test_shear_strain_is_that_of_a_thin_incompressible_layer() -> None:
    """Its pressure from the Fredholm equation: γ = h p'/G at the bond, 0.58 w a/h² in the limit."""
    thickness, contact_radius, shear = 1.0, 20.0, 1.0
    exact = vc.reference.layer_sphere(
        contact_radius, 1e4, thickness, shear_modulus=shear, poisson_ratio=0.5
    )
    r = np.linspace(0.0, 0.99 * contact_radius, 397)
    slope = np.abs(np.gradient(exact.pressure(r), r)).max()
    measure = exact.approach * contact_radius / thickness**2
    assert thickness * slope / shear == close_to(0.58 * measure, rel=0.15)


def test_run_keeps_the_warnings_about_its_cover(tmp_path: Path) -> None:
    body = vc.Layered([vc.Layer(1e-3, RUBBER)], base="rigid")
    exact = vc.reference.layer_sphere(3e-3, 40e-3, 1e-3, shear_modulus=1e6, poisson_ratio=0.49)
    grid = vc.Grid((20, 20), (10e-3, 10e-3))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        ds = vc.simulate(
            vc.Paraboloid(40e-3, 40e-3), body, vc.step(exact.force), grid, [0.0], errors=False
        )
    assert (
        "there are 2 cells per thickness of a nearly incompressible layer, 1 mm"
        in (ds.attrs["warnings"])
    )
    assert exact.approach < DEEP_COVER * 1e-3
    assert "the approach is" not in ds.attrs["warnings"]


@pytest.mark.parametrize(
    ("count", "period", "said"),
    [
        (12, 0.5e-3, "there are 0.5 cells"),
        (12, 1.0, "there are 0.5 cells"),
        (24, 1.0, "is 1 cell "),
    ],
)
def test_period_of_a_line_contact_is_no_cell_of_a_layer(
    count: int, period: float, said: str
) -> None:
    """The cell along the line is as long as the period, which may be shorter than those across."""
    body = vc.Layered([vc.Layer(1e-3, RUBBER)], base="rigid")
    grid = vc.Grid((1, count), (period, 24e-3), periodic=(True, False))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        ds = vc.simulate(
            *(vc.Paraboloid(np.inf, 40e-3), body, vc.step(2e4 * period), grid, [0.0]), errors=False
        )
    assert said in ds.attrs["warnings"]


def test_check_predicts_the_warnings_about_a_cover(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "roll.yaml"
    assert main(["example", "rubber-covered-roll", "-o", str(case)]) == 0
    grid = ["--set", "grid={shape: [96, 48], size: [96 mm, 12 mm]}"]
    assert main(["check", str(case), *grid]) == 0
    said = capsys.readouterr().out
    assert said.count("warning") == 1  # of the strain of the rubber's tests
    assert "representative shear strain" in said
    thin = ["--set", "material.layers[1].thickness=1.5 mm", "--set", "material.base=rigid"]
    force = ["--set", "load={kind: step, force: 6 kN}"]
    assert main(["check", str(case), *grid, *thin, *force]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "of the thickness of the layers, 1.5 mm" in said
    assert "squeezed out to the side" in said
