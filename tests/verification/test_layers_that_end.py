"""Covers that end: limits, symmetries, creep, and what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

THICKNESS, LENGTH = 8e-3, 48e-3
ROLL = vc.Roller(60e-3, LENGTH / 2)


def _rubber(ratio: float, law: vc.Law | None = None) -> vc.Material:
    return vc.Material(law or vc.Elastic(1e6), ratio)


def _cover(material: vc.Material) -> vc.Layered:
    return vc.Layered([vc.Layer(THICKNESS, material)], "rigid")


def _pressed(material: Any, cells: int = 48, **load: Any) -> xr.Dataset:
    grid = vc.Grid((cells + 4, 32), (LENGTH * (1 + 4 / cells), 36e-3))
    given = vc.step(**({"approach": 1e-3} | load))
    return vc.simulate(ROLL, material, given, grid, [0.0], errors=False)


def test_without_poisson_effect_a_cover_carries_alike_up_to_its_ends() -> None:
    cover = _cover(_rubber(0.0))
    free, held = (_pressed(vc.Body(cover, LENGTH, ends=kind)) for kind in ("free", "held"))
    line_load = free.line_load[0].values[2:-2]
    assert line_load == close_to(np.full(48, line_load.mean()), rel=1e-5)
    assert float(free.force[0]) == close_to(float(held.force[0]), rel=1e-5)


def test_walls_make_a_cover_endless() -> None:
    held = _pressed(vc.Body(_cover(_rubber(0.45)), LENGTH, ends="held"))
    line = vc.simulate(
        vc.Roller(60e-3, LENGTH),
        _cover(_rubber(0.45)),
        vc.step(approach=1e-3),
        vc.Grid((1, 32), (LENGTH, 36e-3), periodic=(True, False)),
        [0.0],
        errors=False,
    )
    assert float(held.force[0]) == close_to(float(line.force[0]), rel=1e-6)


def test_a_cover_gives_way_at_its_ends_as_the_elements_say() -> None:
    free = _pressed(vc.Body(_cover(_rubber(0.49)), LENGTH))
    endless = _pressed(_cover(_rubber(0.49)))
    over_middle = free.line_load[0].values[2:-2] / float(free.line_load[0][26])
    # Up to the first row of cells, an eighth of the thickness long.
    assert over_middle[0] < 0.25
    assert (np.diff(over_middle[:24]) > 0).all()
    # Of endless layers the end has a peak; and their approach takes more force.
    assert float(endless.line_load[0][2]) > float(endless.line_load[0][26])
    assert float(free.force[0]) < 0.85 * float(endless.force[0])
    assert float(free.approach[0]) == 1e-3  # the base is rigid, so that it has a datum
    assert free.attrs["ends_error"] == close_to(1e-3, rel=0.02)
    finer = _pressed(vc.Body(_cover(_rubber(0.49)), LENGTH), 96)
    assert float(free.force[0]) == close_to(float(finer.force[0]), rel=3e-3)


def test_half_of_a_cover_is_held_in_the_middle() -> None:
    whole = _pressed(vc.Body(_cover(_rubber(0.4)), LENGTH)).line_load[0].values[26:]
    half = vc.simulate(
        ROLL,
        vc.Body(_cover(_rubber(0.4)), LENGTH / 2, centre=LENGTH / 4, ends=("held", "free")),
        vc.step(approach=1e-3, tilt_x=0.0),
        vc.Grid((28, 32), (LENGTH * 28 / 48, 36e-3), centre=(LENGTH / 4, 0.0)),
        [0.0],
        errors=False,
    )
    assert half.line_load[0].values[2:] == close_to(whole, rel=2e-5)


def test_an_eccentric_force_tilts_a_cover_that_ends() -> None:
    body = vc.Body(_cover(_rubber(0.45)), LENGTH)
    one, other = (
        _pressed(body, approach=None, force=200.0, eccentricity_x=side * 2e-3) for side in (-1, 1)
    )
    assert float(one.tilt_x[0]) == close_to(-float(other.tilt_x[0]), rel=1e-5)
    assert float(other.tilt_x[0]) > 0
    assert one.line_load[0].values == close_to(other.line_load[0].values[::-1], rel=1e-5)


def test_a_cover_that_creeps_begins_and_ends_as_elastic_ones() -> None:
    law = vc.Zener(1e6, 2e6, 2e6)  # relaxed after some seconds
    grid = vc.Grid((28, 24), (LENGTH * 28 / 24, 40e-3))
    load, times = vc.step(200.0), [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 20.0, 60.0]

    def pressed(own: vc.Law | None, times: list[float]) -> xr.Dataset:
        body = vc.Body(_cover(_rubber(0.45, own)), LENGTH)
        return vc.simulate(ROLL, body, load, grid, times, errors=False)

    creeping = pressed(law, times)
    for index, modulus in ((0, 1e6), (-1, 0.5 / float(law(1e9)))):
        elastic = pressed(vc.Elastic(modulus), [0.0])
        for name in ("approach", "contact_area"):
            assert float(creeping[name][index]) == close_to(float(elastic[name][0]), rel=2e-4)


def test_layers_of_two_materials_end_together_on_an_automatic_grid() -> None:
    # The lower layer is far stiffer: it is nearly the base.
    both = vc.Layered(
        [vc.Layer(THICKNESS, _rubber(0.45)), vc.Layer(THICKNESS, _rubber(0.3, vc.Elastic(1e9)))],
        "rigid",
    )
    grid = vc.auto_grid(ROLL, vc.Body(both, LENGTH), vc.step(200.0))
    found, alone = (
        vc.simulate(ROLL, vc.Body(body, LENGTH), vc.step(200.0), grid, [0.0])
        for body in (both, _cover(_rubber(0.45)))
    )
    assert float(found.approach[0]) == close_to(float(alone.approach[0]), rel=5e-3)
    assert found.line_load[0].values == close_to(alone.line_load[0].values, rel=5e-3, abs=1.0)
    assert float(found.approach_error[0] / found.approach[0]) < 0.02
    assert np.isnan(found.attrs["end_stress_left"])


@pytest.mark.parametrize(
    ("layers", "how", "why"),
    [
        ({"base": vc.Material(vc.Elastic(80e9), 0.3)}, {}, "bonded to each other and to a rigid"),
        ({"bonded": False}, {}, "bonded to each other and to a rigid"),
        ({}, {"ends": ("free", None)}, "layers end on both sides"),
        ({"material": vc.Material(vc.Elastic(1e6), bulk_modulus=2e9)}, {}, "constant poisson_rat"),
        ({"material": vc.Material(vc.Elastic(1e6), 0.499)}, {}, "are 0.495 at most"),
        ({"second": vc.Zener(1e6, 1e6, 1e6)}, {}, "must creep alike"),
    ],
)
def test_layers_whose_ends_are_not_known_are_refused(
    layers: dict[str, Any], how: dict[str, Any], why: str
) -> None:
    material, second = layers.pop("material", _rubber(0.45)), layers.pop("second", None)
    given = [vc.Layer(THICKNESS, material)]
    if second is not None:
        given.append(vc.Layer(THICKNESS, _rubber(0.45, second)))
    body = vc.Layered(given, **({"base": "rigid"} | layers))
    with pytest.raises(ValueError, match=why):
        _pressed(vc.Body(body, LENGTH, **how))


#: Parabolas, so that cells and strips have the same gap.
ROLLING, ENDLESS = vc.Paraboloid(1e6, 60e-3), vc.Paraboloid(np.inf, 60e-3)
RETARDED = vc.Zener(1e6, 1e6, 1e6)  # relaxed modulus 0.5 MPa, retardation time 1 s


def _rolled(ratio: float, speeds: Any, **how: Any) -> xr.Dataset:
    body = vc.Body(_cover(_rubber(ratio, RETARDED)), LENGTH)
    grid = vc.Grid((28, 48), (LENGTH * 28 / 24, 48e-3))
    return vc.steady(ROLLING, body, vc.step(200.0, tilt_y=0.0), speeds, grid=grid, **how)


def test_without_poisson_effect_a_cover_that_ends_rolls_as_a_line_contact() -> None:
    found = _rolled(0.0, [1e-3, 1e-2], errors=False)
    line = vc.steady(
        ENDLESS,
        _cover(_rubber(0.0, RETARDED)),
        vc.step(200.0, tilt_y=0.0),
        [1e-3, 1e-2],
        grid=vc.Grid((1, 48), (LENGTH, 48e-3), periodic=(True, False)),
        errors=False,
    )
    for name in ("resistance_y", "approach", "peak_pressure"):
        assert found[name].values == close_to(line[name].values, rel=2e-5)
    line_load = found.line_load[1].values[2:-2]
    assert line_load == close_to(np.full(24, 200.0 / LENGTH), rel=2e-6)


def test_a_cover_that_ends_rolls_fast_and_slowly_as_elastic_ones_are_pressed() -> None:
    rolled = _rolled(0.45, [1e-6, 1e-2, 1e2])
    for index, modulus in ((0, 0.5e6), (2, 1e6)):
        pressed = vc.simulate(
            ROLLING,
            vc.Body(_cover(_rubber(0.45, vc.Elastic(modulus))), LENGTH),
            vc.step(200.0, tilt_y=0.0),
            vc.Grid((28, 48), (LENGTH * 28 / 24, 48e-3)),
            [0.0],
            errors=False,
        )
        assert float(rolled.approach[index]) == close_to(float(pressed.approach[0]), rel=1e-4)
        assert rolled.line_load[index].values == close_to(pressed.line_load[0].values, rel=1e-4)
    # In between, it loses more than its error bar.
    friction, error = rolled.friction_coefficient.values, rolled.friction_coefficient_error.values
    assert friction[1] > 10 * max(friction[0], friction[2])
    assert 0 < error[1] < 0.05 * friction[1]


def test_a_case_gives_the_ends_of_layers(tmp_path: Any) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        """
indenter: {shape: roller, radius: 60 mm, length: 48 mm}
material:
  layers: [{thickness: 8 mm, law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.45}]
  base: rigid
  length: 48 mm
  ends: free
load: {kind: step, force: 200 N}
time: {end: 1 s, steps: 1}
""",
        encoding="utf-8",
    )
    body = read_case(path).material
    assert isinstance(body, vc.Body)
    assert isinstance(body.material, vc.Layered)
    assert body.planes == close_to((-24e-3, 24e-3), rel=1e-12)
