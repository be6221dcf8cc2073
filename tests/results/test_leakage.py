"""Leakage through gaps: exact channels, topology of channels, symmetries, refused input."""

from __future__ import annotations

import json
import re
from typing import Any

import numpy as np
import pytest
import scipy
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.results.descriptions import describe
from viscontact.results.leakage.channels import (
    FlowAxis,
    channel,
    critical_constriction,
    critical_gap_error,
)
from viscontact.results.leakage.effective_medium import effective_transmissivity
from viscontact.results.leakage.flow import of_mean_gap, solved_flow
from viscontact.verify.leakage import through_slot

PERIODIC = (True, True)
FLUID: dict[str, Any] = {"viscosity": 1e-3, "pressure_difference": 1e5}


def result(gap: Any, size: tuple[float, float], periodic: Any = True) -> xr.Dataset:
    """Result with a gap; contact where it is 0."""
    gap = np.asarray(gap, dtype=float)
    grid = vc.Grid(gap.shape, size, periodic=periodic)
    touched = gap <= 0
    fields = {"gap": gap, "pressure": touched * 1e9, "in_contact": touched.astype("i1")}
    data = {name: (("time", "x", "y"), each[None]) for name, each in fields.items()}
    case = {"grid": describe(grid)}
    coordinates = {"time": [0.0], "x": grid.x, "y": grid.y}
    return xr.Dataset(data, coordinates, {"case": json.dumps(case), "tolerance": 1e-6})


def bars(*rows: str) -> Any:
    """Open cells from drawings: x downwards, y to the right, `#` is contact."""
    return np.array([[cell == "." for cell in row] for row in rows])


def opens(drawing: Any, axis: int, ends: Any = "period", periodic: Any = PERIODIC) -> bool:
    return bool(channel(drawing, FlowAxis(axis, ends, periodic)).any())


def test_error_of_a_sinusoid_along_the_flow_falls_spectrally() -> None:
    errors = []
    for cells in (16, 32, 64):
        x = (np.arange(cells) + 0.5) / cells
        gap = 1e-6 * (1 + 0.8 * np.cos(2 * np.pi * x))[:, None] * np.ones((1, 3))
        flow = solved_flow(gap, gap > 0, FlowAxis(0, "period", PERIODIC), (1 / cells, 0.1))
        exact = (1 - 0.64) ** 2.5 / (1 + 0.32) * 1e-18 / 12
        errors.append(abs(flow.transmissivity / exact - 1))
    assert errors[0] < 2e-3
    assert errors[1] < 1e-7
    assert errors[2] < 1e-11


def test_slot_between_rooms_converges_with_the_first_order() -> None:
    # Potential flow through a slot of width a in unit width; extra length of both steps.
    a, length, long = 0.25, 3.0, 0.5
    steps = (a * a + 1) / a * np.log((1 + a) / (1 - a)) - 2 * np.log(4 * a / (1 - a * a))
    exact = length / (length - long + long / a + steps / np.pi)
    errors = [abs(through_slot(cells, a, length, long) / exact - 1) for cells in (16, 32, 64)]
    assert errors[2] < 4e-3
    assert 1.5 < errors[0] / errors[1] < 3.5
    assert 1.5 < errors[1] / errors[2] < 3.5


def test_slanting_channel_is_open_along_both_axes() -> None:
    slant = bars(".##.", "..##", "#..#", "##..")
    assert opens(slant, 0)
    assert opens(slant, 1)
    found = [
        solved_flow(1.0 * slant, slant, FlowAxis(axis, "period", PERIODIC), (1.0, 1.0))
        for axis in (0, 1)
    ]
    assert found[0].transmissivity == close_to(found[1].transmissivity, rel=1e-12)


def test_channel_displaced_at_the_seam_spans_but_does_not_close_on_itself() -> None:
    displaced = bars(".####", ".####", "...##", "##.##", "##.##")
    assert not opens(displaced, 0)
    assert opens(displaced, 0, "pressure")


def test_channel_that_closes_after_two_periods_is_open() -> None:
    twice = bars(".#.#", ".#.#", "..##", "#..#")
    # From the last row it goes on in the other column of the first, and so around twice.
    turning = bars(".#.##", ".#..#", ".##.#", "..#.#", "#.#..")
    assert opens(turning, 0) == opens(np.tile(turning, (2, 2)), 0)
    assert opens(twice, 0) == opens(np.tile(twice, (2, 2)), 0)
    assert not opens(turning & bars("#####", *["....."] * 4), 0)


def test_blind_branches_open_nothing_and_their_error_is_stated() -> None:
    straight = bars(*["..##"] * 4)
    branch = straight.copy()
    branch[1, 2] = True
    assert not opens(branch, 1)
    axis = FlowAxis(0, "period", PERIODIC)
    assert solved_flow(1.0 * straight, straight, axis, (1.0, 1.0)).transmissivity == close_to(
        0.5 / 12, rel=1e-12
    )
    # Deviations from finer cells, 0.5 times 1.020 over 12.
    found = []
    for times in (1, 2, 4):
        fine = np.kron(branch, np.ones((times, times)))
        flow = solved_flow(fine, fine > 0, axis, (1 / times, 1 / times))
        found.append((flow.transmissivity / (0.5 * 1.0203 / 12) - 1, flow.of_steps * 24))
    assert all(0 < off < stated for off, stated in found)
    assert found[0][0] > 3 * found[1][0] > 9 * found[2][0]


@pytest.mark.parametrize("across", [2, 3, 8])
def test_channel_at_45_degrees_has_its_whole_width(across: int) -> None:
    # Its width is that over sqrt(2) along x, and its length sqrt(2) times that along x.
    count = 12
    place = np.arange(count)
    slant = (place[:, None] - place) % count < across
    flow = solved_flow(1.0 * slant, slant, FlowAxis(0, "period", PERIODIC), (1.0, 1.0))
    assert flow.transmissivity == close_to(across / count / 2 / 12, rel=1e-12)


def test_stated_error_covers_the_staircase_of_round_spots() -> None:
    for part in (0.1, 0.3, 0.5):
        exact = 1 - 2 * part / (1 + part - 0.305827 * part**4 - 0.013362 * part**8)
        stated = []  # within on 239 of 240 spots elsewhere, with 16 to 128 cells on a period
        for cells in (64, 128):
            x = (np.arange(cells) + 0.5) / cells - 0.5
            gap = np.where(np.square(x)[:, None] + np.square(x) < part / np.pi, 0.0, 1e-6)
            leak = vc.leakage(result(gap, (1e-3, 1e-3)), viscosity=1.0).isel(time=0)
            off = abs(12e18 * float(leak.transmissivity) - exact)
            stated.append(12e18 * float(leak.transmissivity_error))
            assert off < stated[-1]
        assert stated[0] > 1.5 * stated[1]


def test_constriction_among_equal_gaps_is_found_at_once() -> None:
    gap = np.full((512, 512), 1e-6)
    gap[200:300, 100:400] = 0.0
    level, i, j = critical_constriction(gap, gap > 0, FlowAxis(0, "period", PERIODIC))
    assert level == 1e-6
    assert gap[i, j] == level


def test_critical_gap_is_the_narrowest_place_of_the_widest_channel() -> None:
    gap = np.zeros((6, 8))
    gap[:, 1], gap[:, 4] = 3.0, 5.0
    gap[2, 1], gap[5, 4] = 2.0, 1.0
    found = critical_constriction(gap, gap > 0, FlowAxis(0, "period", PERIODIC))
    assert found == (2.0, 2, 1)
    assert critical_constriction(gap, gap > 0, FlowAxis(1, "period", PERIODIC))[0] == 0.0


def test_error_of_the_critical_gap_covers_the_saddle_between_cells() -> None:
    # Crossed waves: the highest valley along x has its pass where one cosine is 1, the other -1.
    stated = []
    for cells in (10, 20, 40):
        for shift in (0.0, 0.13, 0.31):
            x = 2 * np.pi * (np.arange(cells) + shift) / cells
            gap = 1e-6 * (1 + 0.4 * np.cos(x)[:, None] + 0.4 * np.cos(x + 0.7))
            flow = FlowAxis(0, "period", PERIODIC)
            off = abs(critical_constriction(gap, gap > 0, flow)[0] - 1e-6)
            stated.append(critical_gap_error(gap, gap > 0, flow))
            assert off <= stated[-1] < 1.5e-7
    assert stated[2] > 2 * stated[5] > 4 * stated[8]


def rough(seed: int, closed: float) -> Any:
    """Smooth random gap whose lowest part is closed."""
    random = np.random.default_rng(seed)
    waves = np.fft.fft2(random.normal(size=(40, 48)))
    k = np.hypot(*np.meshgrid(np.fft.fftfreq(40) * 40, np.fft.fftfreq(48) * 48, indexing="ij"))
    field = np.fft.ifft2(waves * np.exp(-((k / 5) ** 2))).real
    return 1e-6 * np.maximum((field - np.quantile(field, closed)) / field.std(), 0.0)


def test_shift_and_transposition_of_a_map_change_nothing() -> None:
    gap, size = rough(1, 0.25), (4e-4, 5e-4)
    found = vc.leakage(result(gap, size), **FLUID, along="both").isel(time=0)
    moved = vc.leakage(result(np.roll(gap, (7, 19), (0, 1)), size), **FLUID, along="both")
    turned = vc.leakage(result(gap.T, size[::-1]), **FLUID, along="both").isel(time=0)
    for name in ("transmissivity", "transmissivity_error", "leak_rate", "critical_gap"):
        np.testing.assert_allclose(moved[name][0], found[name], rtol=1e-8)
        np.testing.assert_allclose(turned[name][::-1], found[name], rtol=1e-8)
    assert float(found.flux_imbalance.max()) < 1e-8
    assert float(found.transmissivity[0]) != close_to(float(found.transmissivity[1]), rel=0.05)


def test_stated_error_covers_the_limit_of_finer_cells() -> None:
    coarse = rough(2, 0.2)
    axis = FlowAxis(0, "period", PERIODIC)
    values = []
    for times in (1, 2, 4):  # the same stairs, each cell divided
        shape = (40 * times, 48 * times)
        fine = np.kron(coarse, np.ones((times, times))) if times > 1 else coarse
        assert fine.shape == shape
        solved = [
            solved_flow(fine, fine > 0, axis, (1 / 40 / times, 1 / 48 / times), *mean)
            for mean in ((), (of_mean_gap,))
        ]
        values.append([each.transmissivity for each in solved])
    error = abs(values[0][1] - values[0][0])
    assert abs(values[2][0] - values[0][0]) < error


def test_flows_along_both_axes_by_one_factorisation_are_those_along_each(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    solve, called = scipy.sparse.linalg.splu, []

    def counted(*given: Any, **more: Any) -> Any:
        called.append(1)
        return solve(*given, **more)

    monkeypatch.setattr(scipy.sparse.linalg, "splu", counted)
    open_along_x = rough(7, 0.2)
    open_along_x[:, 5] = 0.0
    for gap, factorisations in ((rough(6, 0.15), 2), (open_along_x, 2), (rough(6, 0.15).T, 2)):
        ds = result(gap, (4e-4, 5e-4))
        called.clear()
        both = vc.leakage(ds, **FLUID, along="both", fields="all")
        assert len(called) == factorisations
        for axis in "xy":
            one = vc.leakage(ds, **FLUID, along=axis, fields="all")
            for name in ("transmissivity", "transmissivity_error", "leak_rate"):
                np.testing.assert_allclose(both[name].sel(direction=axis), one[name], rtol=1e-9)
            flows = both.flux_x.sel(direction=axis), one.flux_x
            np.testing.assert_allclose(*flows, atol=1e-9 * float(np.abs(one.flux_x).max()))
    free = result(rough(6, 0.15), (4e-4, 5e-4), periodic=False)
    called.clear()
    vc.leakage(free, **FLUID, along="both")
    assert len(called) == 4  # given pressures at other ends


def test_leak_rate_has_the_units_of_the_seal() -> None:
    plates = result(np.full((4, 6), 2e-6), (1e-3, 3e-3))
    found = vc.leakage(plates, **FLUID).isel(time=0)
    transmissivity = 8e-18 / 12
    assert float(found.transmissivity) == close_to(transmissivity, rel=1e-12)
    assert float(found.leak_rate) == close_to(transmissivity * 1e5 * 3 / 1e-3, rel=1e-12)
    assert float(found.effective_gap) == close_to(2e-6)
    assert float(found.critical_gap) == close_to(2e-6)
    seal = vc.leakage(plates, **FLUID, length=2e-3, width=0.3).isel(time=0)
    assert float(seal.leak_rate) == close_to(transmissivity * 1e5 * 150 / 1e-3, rel=1e-12)
    gas = vc.leakage(plates, viscosity=1e-3, pressure_difference=1e5, gas=1e5).isel(time=0)
    assert float(gas.leak_rate) == close_to(1.5 * float(found.leak_rate), rel=1e-12)
    assert np.isnan(float(vc.leakage(plates, viscosity=1e-3).leak_rate[0]))


def test_contact_without_a_channel_leaks_nothing() -> None:
    gap = rough(3, 0.2)
    gap[11] = 0.0
    found = vc.leakage(result(gap, (1e-3, 1e-3)), **FLUID, along="both", fields="all").isel(time=0)
    shut, still_open = (found.sel(direction=each) for each in "xy")
    names = ("transmissivity", "leak_rate", "leak_rate_error", "critical_gap", "percolates")
    assert [float(shut[name]) for name in names] == [0.0] * 5
    assert not np.asarray(shut.channel).any()
    assert float(still_open.percolates) == 1


def test_fields_balance_in_each_cell() -> None:
    gap = rough(4, 0.2)
    found = vc.leakage(result(gap, (4e-4, 4.8e-4)), **FLUID, fields="all").isel(time=0)
    through = found.flux_x.sum("y").values * 1e-5
    np.testing.assert_allclose(through, float(found.leak_rate), rtol=1e-9)
    assert float(found.fluid_pressure.max()) < 2e5
    assert not found.flux_x.values[gap == 0].any()


def test_gap_of_bodies_apart_is_that_of_the_map() -> None:
    x = (np.arange(32) + 0.5) / 32 * 1e-3 - 0.5e-3
    height = np.broadcast_to(1e-6 * np.cos(2 * np.pi * x / 1e-3)[:, None], (32, 32))
    grid, steel = vc.Grid((32, 32), (1e-3, 1e-3), periodic=True), vc.Material(vc.Elastic(8e10), 0.3)
    load = vc.ApproachHistory([0.0], [-0.25e-6])
    waves = vc.Surface(height, 1e-3 / 32)
    ds = vc.simulate(waves, steel, load, grid, [0.0], errors=False)
    found = vc.leakage(ds, **FLUID).isel(time=0)
    expected = height.max() - height + 0.25e-6
    exact = 1 / np.mean(1 / expected[:, 0] ** 3) / 12
    assert float(found.transmissivity) == close_to(exact, rel=2e-3)


def test_effective_medium_of_one_gap_is_that_gap() -> None:
    assert effective_transmissivity(np.full((3, 3), 3e-9)) == close_to(27e-27 / 12, rel=1e-9)
    assert effective_transmissivity(np.zeros((3, 3))) == 0.0
    shares = [effective_transmissivity(rough(5, part)) for part in (0.1, 0.3, 0.45)]
    assert shares[0] > shares[1] > shares[2] == 0.0


REFUSED: dict[str, tuple[Any, dict[str, Any], str]] = {
    "no gap": (xr.Dataset(), {}, "needs stored fields"),
    "viscosity": (rough(1, 0.2), {"viscosity": -1.0}, "viscosity must be"),
    "difference": (rough(1, 0.2), {"pressure_difference": 0.0}, "pressure_difference must be"),
    "along": (rough(1, 0.2), {"along": "z"}, "along must be"),
    "ends": (rough(1, 0.2), {"ends": "free"}, "ends must be"),
    "gas": (rough(1, 0.2), {"gas": 1e5, "pressure_difference": None}, "gas: needs"),
    "fields": (
        rough(1, 0.2),
        {"fields": "all", "pressure_difference": None},
        "fields: .* need pressure_difference",
    ),
    "unknown gap": (np.where(rough(1, 0.2) > 2e-6, np.nan, 1e-6), {}, "grids differ"),
    "beyond the body": (np.where(rough(1, 0.2) > 2e-6, np.inf, 1e-6), {}, "beyond the end"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_bad_input_is_refused_with_the_remedy(name: str) -> None:
    gap, given, message = REFUSED[name]
    ds = gap if isinstance(gap, xr.Dataset) else result(gap, (1e-3, 1e-3))
    with pytest.raises(ValueError, match=message):
        vc.leakage(ds, **{**FLUID, **given})


def test_period_ends_need_a_period() -> None:
    free = result(rough(1, 0.2), (1e-3, 1e-3), periodic=False)
    assert vc.leakage(free, **FLUID).attrs["ends"] == ["pressure"]
    with pytest.raises(ValueError, match="not periodic along x"):
        vc.leakage(free, **FLUID, ends="period")


def rough_map(cells: int, seed: int = 1, closed: float = 0.2, most: int = 8) -> xr.Dataset:
    """Result with the gap and displacement of a random map of some cells on its shortest wave."""
    random, count = np.random.default_rng(seed), cells * most
    k = np.fft.fftfreq(count) * count
    q = np.hypot(k[:, None], k)
    size = np.where((q > 0) & (q <= most), 1.0, 0.0)
    field = np.fft.ifft2(size * np.exp(2j * np.pi * random.random(q.shape))).real
    depth = 1e-6 * (field - np.quantile(field, closed)) / field.std()
    ds = result(np.maximum(depth, 0.0), (1e-3, 1e-3))
    return ds.assign(displacement=ds.gap.copy(data=np.maximum(-depth, 0.0)[None]))


WARNED: dict[str, tuple[xr.Dataset, dict[str, Any], str]] = {
    "coarse cells": (rough_map(5), {}, "5.0 cells lie on the shortest waves"),
    "few waves": (rough_map(24, most=4), {}, "the period holds 2.* waves"),
    "near closing": (rough_map(10, closed=0.4), {}, "near the 42 % at which rough"),
    "steep": (result(1e3 * rough(1, 0.2), (1e-3, 1e-3)), {}, "the gap has slopes of"),
    "fast": (
        result(np.full((8, 8), 1e-4), (1e-3, 1e-3)),
        {"pressure_difference": 1e5},
        "the Reynolds number is .*, with the density of water",
    ),
    "fast gas": (
        result(np.full((8, 8), 1e-4), (1e-3, 1e-3)),
        {"viscosity": 2e-5, "gas": 1e5},
        "the Reynolds number is .*, with the density of air",
    ),
}


@pytest.mark.parametrize("name", WARNED)
def test_what_makes_a_leak_rate_uncertain_is_warned_of(name: str) -> None:
    ds, given, message = WARNED[name]
    found = vc.leakage(ds, **{**FLUID, "pressure_difference": 1e2, **given})
    assert re.search(message, found.attrs["warnings"])


def test_fine_map_far_from_closing_has_no_warning() -> None:
    fine = rough_map(10, most=12)
    assert vc.leakage(fine, **{**FLUID, "pressure_difference": 1e2}).attrs["warnings"] == ""


def test_narrow_channel_is_warned_of_by_its_cells() -> None:
    narrow = np.zeros((8, 8))
    narrow[:, 2:5] = 1e-6
    notes = vc.leakage(result(narrow, (1e-3, 1e-3)), **FLUID).attrs["warnings"]
    assert "the channel is 3 cells wide" in notes
    wide = np.zeros((8, 8))
    wide[:, [0, 1, 6, 7]] = 1e-6  # through the period
    assert "cells wide" not in vc.leakage(result(wide, (1e-3, 1e-3)), **FLUID).attrs["warnings"]


def test_doubts_are_warned_of() -> None:
    narrow = np.zeros((8, 8))
    narrow[:, 2], narrow[3, 2] = 1e-6, 1e-9
    notes = vc.leakage(result(narrow, (1e-3, 1e-3)), **FLUID).attrs["warnings"]
    assert "a liquid is no continuum" in notes
    assert "a few cells wide" in notes
    assert vc.leakage(result(np.full((4, 4), 1e-6), (1e-3, 1e-3)), **FLUID).attrs["warnings"] == ""


WAVES = vc.Waviness(1e-6, wavelength_x=1e-4, wavelength_y=1e-4)
PERIOD = vc.Grid((16, 16), (1e-4, 1e-4), periodic=True)


def up_and_down(law: vc.Law, mean_pressure: float, steps: int) -> xr.Dataset:
    """Leakage of crossed waves under a force that rises and falls."""
    load = vc.triangle(mean_pressure * PERIOD.area, 1.0)
    body, times = vc.Material(law, 0.3), np.linspace(0.0, 2.0, steps + 1)
    return vc.leakage(vc.simulate(WAVES, body, load, PERIOD, times, errors=False), **FLUID)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_elastic_contact_opens_at_the_force_at_which_it_has_closed() -> None:
    found = up_and_down(vc.Elastic(80e9), 6e9, 16)
    opened = found.percolates.values
    np.testing.assert_array_equal(opened, opened[::-1])
    assert opened.min() == 0 < opened.max()
    np.testing.assert_allclose(found.critical_gap, found.critical_gap[::-1], atol=1e-11)
    said = found.attrs["changes"].splitlines()
    assert [line.split()[0] for line in said] == ["closes", "opens"]
    finer = up_and_down(vc.Elastic(80e9), 6e9, 48)
    assert float(finer.closing_force_error) < float(found.closing_force_error) / 2
    far = abs(float(finer.closing_force) - float(found.closing_force))
    assert far < float(found.closing_force_error)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_creep_keeps_channels_closed_while_the_load_falls() -> None:
    found = up_and_down(vc.Zener(80e9, 40e9, 40e9), 1e9, 16)
    gaps = found.critical_gap.values
    assert (gaps[9:16] < gaps[7:0:-1]).all()  # at equal forces
    assert gaps[16] > gaps[8]  # unloading opens them
    # Held, it closes under a force that does not change.
    held = vc.simulate(
        *(WAVES, vc.Material(vc.Zener(80e9, 10e9, 10e9), 0.3), vc.step(1.5e9 * PERIOD.area)),
        *(PERIOD, [0.0, 1.0, 20.0]),
        errors=False,
    )
    closes = vc.leakage(held, **FLUID)
    assert closes.percolates.values.tolist() == [1.0, 0.0, 0.0]
    assert closes.attrs["changes"] == "closes between 0 s and 1 s, under 15 N"
    assert float(closes.closing_force) == close_to(15.0)


def same_waves(cells: int, seed: int) -> vc.Surface:
    """Random map of the same twelve waves on a period at any number of cells on the shortest."""
    random, most = np.random.default_rng(seed), 12
    k = np.arange(-most, most + 1)
    q = np.hypot(k[:, None], k)
    size = np.where((q >= 1) & (q <= most), np.maximum(q, 4.0) ** -1.8, 0.0)
    waves = np.zeros((cells * most, cells * most), complex)
    waves[np.ix_(k, k)] = size * np.exp(2j * np.pi * random.random(q.shape))
    height = np.fft.ifft2(waves).real * waves.size
    slopes = np.abs(np.fft.fft2(height)) ** 2 / height.size**2
    along = np.fft.fftfreq(cells * most) * cells * most
    rms = np.sqrt((slopes * (2e3 * np.pi) ** 2 * (along[:, None] ** 2 + along**2)).sum())
    return vc.Surface(0.1 / rms * height, 1e-3 / (cells * most), periodic=True)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("pressure", [2e4, 7e4, 1.2e5])
def test_error_of_a_rough_contact_covers_that_of_finer_cells(seed: int, pressure: float) -> None:
    body = vc.Material(vc.Elastic.from_uniaxial(0.75e7, 0.5), poisson_ratio=0.5)
    found = []
    for cells in (4, 8, 24):
        grid = vc.Grid((12 * cells, 12 * cells), (1e-3, 1e-3), periodic=True)
        load = vc.step(pressure * grid.area)
        run = vc.simulate(same_waves(cells, seed), body, load, grid, [0.0], errors=False)
        found.append(vc.leakage(run, viscosity=1.0).isel(time=0))
    exact = float(found[-1].transmissivity)
    for each in found[:-1]:
        assert abs(float(each.transmissivity) - exact) < float(each.transmissivity_error)
    assert abs(float(found[1].transmissivity) / exact - 1) < 0.06
    assert float(found[1].critical_gap) == close_to(float(found[2].critical_gap), rel=0.05)


def test_fluid_that_pushes_the_bodies_apart_is_warned_of_on_a_single_row_of_cells() -> None:
    ds = result(np.full((1, 8), 1e-6), (1e-3, 1e-3)).assign(force=("time", [1.0]))  # 1 MPa
    leak = vc.leakage(ds, viscosity=1e-3, pressure_difference=1e5, along="y")
    assert "carries a part of the load" in leak.attrs["warnings"]
    leak = vc.leakage(ds, viscosity=1e-3, pressure_difference=1e4, along="y")
    assert "carries a part of the load" not in leak.attrs["warnings"]
