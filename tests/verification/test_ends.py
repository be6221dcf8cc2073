"""Contacts near the ends of bodies: limits, creep, and the mirrored half-space."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from returned import some

LEVEL = {"tilt_x": 0.0, "tilt_y": 0.0}


def _at_distance(
    distance: float, material: vc.Material, times: list[float], **how: Any
) -> xr.Dataset:
    """Sphere pressed at a distance from a free end at x < 0 [m], or far from any."""
    # The end is a border of cells, on the grid or beyond it.
    body: vc.Material | vc.Body = material
    if np.isfinite(distance):
        body = vc.Body(material, 1.0, centre=0.5 - distance, ends=("free", None))
    grid = vc.Grid((48, 48), (2.4e-3, 2.4e-3))
    load = vc.step(0.02, **LEVEL)
    return vc.simulate(vc.Sphere(0.01), body, load, grid, times, errors=False, **how)


def test_far_from_an_end_its_effect_falls_as_the_inverse_distance() -> None:
    steel = vc.Material(vc.Elastic(1e6), poisson_ratio=0.3)
    far = float(_at_distance(np.inf, steel, [0.0]).approach[0])
    added = [float(_at_distance(d, steel, [0.0]).approach[0]) - far for d in (6e-3, 12e-3, 24e-3)]
    # A contact of half width a at a distance d differs by (a/d)² from a point load.
    assert np.divide(added[:-1], added[1:]) == close_to([2.0, 2.0], rel=5e-3)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # long steps
def test_a_body_that_creeps_near_its_end_begins_and_ends_as_elastic_ones() -> None:
    law = vc.Zener(1e6, 2e6, 2e6)  # relaxed after some seconds
    creeping = _at_distance(
        0.3e-3, vc.Material(law, 0.5), [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 20.0, 60.0]
    )
    for index, modulus in ((0, 1e6), (-1, 0.5 / float(law(1e9)))):
        elastic = _at_distance(0.3e-3, vc.Material(vc.Elastic(modulus), 0.5), [0.0])
        for name in ("approach", "contact_area", "eccentricity_x"):
            assert float(creeping[name][index]) == close_to(float(elastic[name][0]), rel=2e-5)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # the approach has no datum
def test_a_held_body_is_pressed_as_its_mirrored_half_beside_it() -> None:
    # Two walls mirror the contact without end: a line of spheres, two in each period.
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.4)
    load = vc.step(0.02, tilt_x=0.0)
    held = vc.simulate(
        vc.Sphere(0.01),
        vc.Body(rubber, 2e-3, ends="held"),
        load,
        vc.Grid((36, 32), (2.4e-3, 2e-3)),
        [0.0],
        tolerance=1e-12,
        errors=False,
    )
    row = vc.simulate(
        vc.Sphere(0.01),
        rubber,
        load,
        vc.Grid((30, 32), (2e-3, 2e-3), periodic=(True, False)),
        [0.0],
        tolerance=1e-12,
        errors=False,
    )
    assert held.pressure[0].values[3:33] == close_to(row.pressure[0].values, rel=1e-9, abs=1e-5)
    assert np.isnan(held.approach[0])
    assert "logarithm of the depth" in held.attrs["warnings"]


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # the sharp end
def test_pressure_falls_towards_a_free_end_and_rises_towards_a_sharp_one() -> None:
    steel = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
    grid = vc.Grid((66, 32), (6.6e-3, 0.5e-3))
    load = vc.step(2000.0, **LEVEL)
    peaks = {}
    for name, body in (("sharp", steel), ("free", vc.Body(steel, 6e-3, ends=(None, "free")))):
        ds = vc.simulate(vc.Roller(0.01, 3e-3), body, load, grid, [0.0], errors=False)
        peaks[name] = ds.line_load[0].values[3:63]
        warned = ds.attrs["warnings"]
        # The other end is a sharp one in both.
        assert "ends: free" in warned
    middle = slice(25, 35)
    assert peaks["sharp"][-1] > 1.5 * peaks["sharp"][middle].mean()
    assert peaks["free"][-1] < 0.8 * peaks["free"][middle].mean()


#: Half width of the contact of the cylinders below, load per length, and their length [m, N/m].
HALF_WIDTH, LINE, LENGTH = 0.25231e-3, 10e3, 16 * 0.25231e-3


def _cylinder(ratio: float, cells: int = 80, *, body: Any = None, **load: Any) -> xr.Dataset:
    """Rigid cylinder of a radius of 10 mm on a body of its own length."""
    rubber = vc.Material(vc.Elastic.from_uniaxial(2e9 * (1 - ratio**2), poisson_ratio=ratio), ratio)
    grid = vc.Grid((cells + 4, 32), (LENGTH * (1 + 4 / cells), 3 * HALF_WIDTH))
    return vc.simulate(
        vc.Roller(0.01, LENGTH / 2),
        vc.Body(rubber, LENGTH) if body is None else body(rubber),
        vc.step(LINE * LENGTH, **load),
        grid,
        [0.0],
        errors=False,
    )


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum
def test_the_line_load_on_a_body_of_equal_length_is_uniform_without_poisson_effect() -> None:
    # Nothing acts along x: each slice is in plane strain and in plane stress at once.
    for load in ({}, {"tilt_x": 0.0}):
        line_load = _cylinder(0.0, **load).line_load[0].values[2:-2]
        assert line_load == close_to(np.full(80, LINE), rel=2e-5)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum
@pytest.mark.parametrize(
    ("ratio", "expected"),
    [
        # Line load over its mean at 0.5, 1, 2 and 4 half widths from the end, by an independent
        # program, on one mesh.
        (0.3, (0.873, 0.942, 0.996, 1.029)),
        (0.5, (0.677, 0.837, 0.975, 1.071)),
    ],
)
def test_the_line_load_falls_towards_free_ends(ratio: float, expected: tuple[float, ...]) -> None:
    found = _cylinder(ratio)
    from_end = LENGTH / 2 - found.x.values[42:-2]
    over_mean = found.line_load[0].values[42:-2] / LINE
    places = HALF_WIDTH * np.array([0.5, 1.0, 2.0, 4.0])
    assert np.interp(places, from_end[::-1], over_mean[::-1]) == close_to(expected, rel=6e-3)
    assert np.isnan(found.approach[0])
    assert found.tilt_x[0] == 0.0  # by symmetry


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum
@pytest.mark.parametrize("ratio", [0.3, 0.5])
def test_the_line_load_near_free_ends_hardly_changes_on_finer_cells(ratio: float) -> None:
    places, found = HALF_WIDTH * np.array([0.5, 1.0, 2.0, 4.0]), []
    for cells in (160, 320):
        ds = _cylinder(ratio, cells)
        half = slice(2 + cells // 2, -2)
        from_end = LENGTH / 2 - ds.x.values[half]
        found.append(np.interp(places, from_end[::-1], ds.line_load[0].values[half][::-1]) / LINE)
    assert found[0] == close_to(found[1], rel=3e-3)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum
def test_an_eccentric_force_on_two_free_ends_is_balanced_and_has_no_tilt() -> None:
    one, other = (_cylinder(0.3, 40, eccentricity_x=side * 0.3e-3) for side in (-1, 1))
    for side, found in ((-1, one), (1, other)):
        line_load = found.line_load[0].values
        moment = (line_load * found.x.values).sum() / line_load.sum()
        assert moment == close_to(side * 0.3e-3, rel=1e-6)
        assert np.isnan(found.tilt_x[0])
        assert "slope of its edge" in found.attrs["warnings"]
    assert one.line_load[0].values == close_to(other.line_load[0].values[::-1], rel=1e-5)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum
def test_half_of_a_body_with_two_free_ends_is_held_in_the_middle() -> None:
    whole = _cylinder(0.4, 40).line_load[0].values[22:]
    half = vc.simulate(
        vc.Roller(0.01, LENGTH / 2),
        vc.Body(
            vc.Material(vc.Elastic.from_uniaxial(2e9 * 0.84, poisson_ratio=0.4), 0.4),
            LENGTH / 2,
            centre=LENGTH / 4,
            ends=("held", "free"),
        ),
        vc.step(LINE * LENGTH / 2, tilt_x=0.0),
        vc.Grid((24, 32), (LENGTH * 0.6, 3 * HALF_WIDTH), centre=(0.25 * LENGTH, 0.0)),
        [0.0],
        errors=False,
    )
    assert half.line_load[0].values[2:] == close_to(whole, rel=1e-5)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # long steps, no datum
def test_a_body_that_creeps_between_two_ends_begins_and_ends_as_elastic_ones() -> None:
    law = vc.Zener(1e6, 2e6, 2e6)

    def pressed(own: vc.Law, times: list[float]) -> xr.Dataset:
        body = vc.Body(vc.Material(own, 0.5), 1.6e-3)
        load = vc.step(0.02, eccentricity_x=0.1e-3)
        return vc.simulate(
            vc.Sphere(0.01), body, load, vc.Grid((36, 32), (1.8e-3, 1.6e-3)), times, errors=False
        )

    creeping = pressed(law, [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 20.0, 60.0])
    for index, modulus in ((0, 1e6), (-1, 0.5 / float(law(1e9)))):
        elastic = pressed(vc.Elastic(modulus), [0.0])
        for name in ("peak_pressure", "contact_area", "eccentricity_x"):
            assert float(creeping[name][index]) == close_to(float(elastic[name][0]), rel=1e-4)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # few cells
def test_error_bars_contain_the_error_of_the_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    body = vc.Body(rubber, 1.0, centre=0.5 - 0.3e-3, ends=("free", None))
    grid = vc.Grid((24, 24), (2.4e-3, 2.4e-3))
    setup = "viscontact.simulation.transient.setup.error_of_ends"

    def bars() -> dict[str, float]:
        found = vc.simulate(vc.Sphere(0.01), body, vc.step(0.02, **LEVEL), grid, [0.0])
        assert found.attrs["ends_error"] > 0
        names = ("approach", "peak_pressure", "contact_area")
        return {each: float(found[f"{each}_error"][0] / found[each][0]) for each in names}

    own = bars()
    with monkeypatch.context() as patched:
        patched.setattr(setup, lambda problem, *, even: 0.1)
        for name, bar in some(bars().items()):
            # A bar that is its least one, as that of the area is on few cells, grows by less.
            assert max(own[name], 0.1) < bar < own[name] + 0.1001
    left = "viscontact.simulation.transient.setup.stress_left_on_ends"
    monkeypatch.setattr(left, lambda problem, grid, pressure: 0.1)
    for name, bar in some(bars().items()):
        assert max(own[name], 0.1) < bar < own[name] + 0.1001


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum, long steps
def test_a_result_states_the_stress_that_is_left_on_free_ends() -> None:
    rubber = vc.Material(vc.Zener(1e6, 2e6, 2e6), 0.45)
    body, grid = vc.Body(rubber, 1.6e-3), vc.Grid((36, 32), (1.8e-3, 1.6e-3))
    load = vc.step(0.02, tilt_y=0.0)
    over_time = vc.simulate(vc.Sphere(0.01), body, load, grid, [0.0, 1.0, 10.0])
    rolled = vc.steady(vc.Sphere(0.01), body, load, [1e-4, 1e-3], grid=grid)
    for ds in (over_time, rolled):
        assert 0 < ds.attrs["end_stress_left"] < 2e-5
    # The bodies are apart at the end.
    off = vc.ForceHistory([0.0, 1.0, 2.0], [0.0, 0.02, 0.0])
    lost = vc.simulate(vc.Sphere(0.01), body, off, grid, [0.5, 1.0, 2.0, 3.0])
    assert np.isnan(lost.attrs["end_stress_left"])
    held = vc.simulate(vc.Sphere(0.01), vc.Body(rubber, 1.6e-3, ends="held"), load, grid, [0.0])
    assert held.attrs["end_stress_left"] == 0.0


def test_two_bodies_may_end_at_different_places() -> None:
    # A body that ends far away adds what a far end adds; with all its creep in one term or in two.
    rubber, steel = vc.Material(vc.Elastic(1e6), 0.5), vc.Material(vc.Elastic(2e6), 0.3)
    both = _at_distance(
        0.3e-3, rubber, [0.0], indenter_material=vc.Body(steel, 2.0, ends=(None, "free"))
    )
    half_space = _at_distance(0.3e-3, rubber, [0.0], indenter_material=steel)
    one, other = (float(ds.approach[0]) for ds in (both, half_space))
    assert 0 < one / other - 1 < 1e-4


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"ends": "free", "load": vc.step(0.02, tilt_x=0.0)}, "load.tilt_x: .* bends as a plate"),
        ({"ends": "free", "load": vc.step(approach=1e-6)}, "has no datum"),
        ({"length": 4.01e-3}, "must be a border of cells"),
        ({"motion": vc.Travel([0.0, 1.0], x=[0.0, 1e-3])}, "the motion is along x"),
        ({"friction": 0.3}, "friction is not available"),
        ({"adhesion": vc.Adhesion(work=0.1, range=1e-6)}, "adhesion is not available"),
        ({"periodic": (True, False)}, "grid.periodic: must be false .* that goes on along y"),
        ({"ends": "held", "load": vc.step(approach=1e-6)}, "has no datum"),
        ({"centre": 10e-3, "length": 8e-3}, "no cell of the grid"),
    ],
)
def test_what_a_body_that_ends_is_not_available_for_is_refused(
    changes: dict[str, Any], why: str
) -> None:
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    body = vc.Body(
        rubber,
        changes.pop("length", 4e-3),
        centre=changes.pop("centre", 1.8e-3),
        ends=changes.pop("ends", ("free", None)),
    )
    grid = vc.Grid((48, 48), (2.4e-3, 2.4e-3), periodic=changes.pop("periodic", False))
    given = {"load": vc.step(0.02), "grid": grid, "times": [0.0], **changes}
    with pytest.raises(ValueError, match=why):
        vc.simulate(vc.Sphere(0.01), body, **given)


def test_a_body_that_ends_needs_a_constant_poisson_ratio_and_one_material() -> None:
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    with pytest.raises(ValueError, match="constant poisson_ratio"):
        vc.Body(vc.Material(vc.Elastic(1e6), bulk_modulus=1e9), 1e-3)
    with pytest.raises(ValueError, match="layers that end must be bonded"):
        vc.Body(vc.Layered([vc.Layer(1e-3, rubber)], rubber), 1e-3)
    with pytest.raises(ValueError, match="a body without ends is a Material"):
        vc.Body(rubber, 1e-3, ends=(None, None))


def test_the_material_of_a_roller_that_ends_elsewhere_than_the_roller_is_refused() -> None:
    steel, rubber = (vc.Material(vc.Elastic(each), 0.3) for each in (80e9, 1e6))
    roller = vc.Roller(0.01, 2e-3)
    for body in (vc.Body(steel, 5e-3), vc.Body(steel, 4e-3, centre=1e-4, ends=(None, "free"))):
        with pytest.raises(ValueError, match=r"indenter_material\.length: the roller ends at x = "):
            vc.simulate(roller, rubber, vc.step(1.0), times=[0.0], indenter_material=body)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum, sharp end
def test_the_ends_of_a_roller_and_of_its_track_have_the_same_effect() -> None:
    # Both bodies add their displacements: which of them is called the roller does not matter.
    soft, hard = vc.Elastic(700e6), vc.Elastic(1e15)
    roller, load = vc.Roller(0.01, 2e-3), vc.step(20.0)
    grid = vc.Grid((44, 32), (4.4e-3, 0.6e-3))

    def line_load(own: vc.Law, other: vc.Law, *, of_roller: bool) -> Any:
        ended = vc.Body(vc.Material(own, 0.4), 4e-3)
        endless = vc.Material(other, 0.3)
        bodies = (endless, ended) if of_roller else (ended, endless)
        found = vc.simulate(
            roller, bodies[0], load, grid, [0.0], indenter_material=bodies[1], errors=False
        )
        return found.line_load[0].values

    of_roller = line_load(soft, hard, of_roller=True)
    assert of_roller == close_to(line_load(soft, hard, of_roller=False), rel=1e-6)
    assert of_roller[2] < 0.8 * of_roller[22]
    # A roller as soft as its endless track carries more at its end, one that is harder a peak.
    alike = line_load(soft, soft, of_roller=True)
    assert of_roller[2] / of_roller[22] < alike[2] / alike[22]
