"""Free profiles of rollers, against Lundberg's theory and independent runs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray
from tests.studies.design.test_profile_parts import ROLLER

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case

Array = NDArray[np.float64]

RADIUS, HALF_LENGTH, FORCE, MODULUS = 5e-3, 10e-3, 967.0, 2e9 / (1 - 0.35)  # m, N, E* in Pa

#: A wider contact, on few cells.
WIDE = """
indenter: {shape: roller, radius: 50 mm, half_length: 10 mm}
material: {law: elastic, shear_modulus: 1 GPa, poisson_ratio: 0.35}
load: {kind: step, force: 800 N}
time: {end: 1 s, steps: 1}
grid: {shape: [108, 35], size: [21.6 mm, 2.4 mm]}
output: {errors: false}
"""
WIDE_RADIUS, WIDE_FORCE = 50e-3, 800.0  # m, N

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def _written(folder: Path, case: str) -> Path:
    path = folder / "roller.yaml"
    path.write_text(case)
    return path


def _pressed(radius: float, force: float, x: Array, drop: Array, grid: vc.Grid) -> xr.Dataset:
    profile = vc.TabulatedProfile(x, drop)
    material = vc.Material(vc.Elastic(1e9), poisson_ratio=0.35)
    roller = vc.Roller(radius, HALF_LENGTH, profile=profile)
    return vc.simulate(roller, material, vc.step(force), grid, [0.0], errors=False)


@pytest.mark.slow
def test_a_design_goes_on_where_it_was_interrupted_and_writes_its_files(tmp_path: Path) -> None:
    path, place = _written(tmp_path, WIDE), tmp_path / "found"

    def designed(progress: object = None) -> vc.ProfileDesign:
        return vc.design_profile(
            path,
            knots=3,
            workers=1,
            directory=place,
            progress=progress,  # type: ignore[arg-type]
        )

    def interrupt(done: int, allowed: int) -> None:
        if done == 20:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        designed(interrupt)
    history = place / "trials.jsonl"
    assert len(history.read_text().splitlines()) == 1 + 20
    with history.open("a") as file:
        file.write("[[1.0, 2.")  # killed while writing
    whole = designed()
    lines = history.read_text().splitlines()
    assert len(lines) == 1 + whole.runs
    xr.testing.assert_identical(whole.table, designed().table)
    assert history.read_text().splitlines() == lines
    with xr.open_dataset(place / "trials.nc") as stored:
        np.testing.assert_array_equal(stored["drop"].sel(profile="free"), whole.drop)
    best = read_case(place / "best.yaml").indenter
    assert isinstance(best, vc.Roller)
    np.testing.assert_allclose(best.drop(whole.x), whole.drop, atol=1e-10)
    with pytest.raises(ValueError, match="holds another design, with a different profile"):
        vc.design_profile(path, knots=4, workers=1, directory=place)


@pytest.fixture(scope="module")
def elastic(tmp_path_factory: pytest.TempPathFactory) -> vc.ProfileDesign:
    return vc.design_profile(_written(tmp_path_factory.mktemp("profile"), ROLLER), workers=1)


@pytest.mark.slow
def test_the_free_profile_of_an_even_load_is_lundbergs(elastic: vc.ProfileDesign) -> None:
    # An even peak pressure p0 belongs to the line load w = pi R p0^2 / E* (Hertz), which carries
    # the force on a length of 2 L = F / w. Lundberg (1939): w makes the drop
    # w / (pi E*) ln(1 / (1 - (x/L)^2)), farther from the ends than the contact is wide.
    load = np.pi * RADIUS * elastic.peak_pressure**2 / MODULUS
    effective = FORCE / load / 2
    assert 0.95 * HALF_LENGTH < effective < HALF_LENGTH
    inner = abs(elastic.x) <= 0.9 * HALF_LENGTH
    lundberg = load / (np.pi * MODULUS) * -np.log1p(-((elastic.x[inner] / effective) ** 2))
    assert abs(elastic.drop[inner] - lundberg).max() < 0.015 * lundberg.max()
    # Independent of the search: on other cells the pressure is even along the roller.
    cells = vc.Grid((500, 61), (21e-3, 1e-3))
    ds = _pressed(RADIUS, FORCE, elastic.x, elastic.drop, cells)
    rows = ds.pressure[0].max("y").sel(x=slice(-0.9 * HALF_LENGTH, 0.9 * HALF_LENGTH))
    assert float(rows.max() / rows.min()) < 1.01
    assert float(ds.contact_length[0]) < 2 * HALF_LENGTH * 0.985


@pytest.mark.slow
def test_the_free_profile_is_better_than_all_named_ones_beyond_the_errors(
    elastic: vc.ProfileDesign,
) -> None:
    table = elastic.table
    assert table.profile.values.tolist() == [
        *("case", "cylindrical", "crowned", "lundberg", "johns-gohar", "free")
    ]
    peaks, errors = table.peak_pressure, table.peak_pressure_error
    for name in ("crowned", "lundberg", "johns-gohar"):
        gain = float(peaks.sel(profile=name) - peaks.sel(profile="free"))
        assert gain > float(errors.sel(profile=name) + errors.sel(profile="free"))
    assert np.isposinf(errors.sel(profile="cylindrical"))
    # The even pressure of the whole length is a lower bound.
    even = (FORCE / (2 * HALF_LENGTH) * MODULUS / (np.pi * RADIUS)) ** 0.5
    assert even < elastic.peak_pressure < 1.025 * even


@pytest.mark.slow
def test_the_stated_peak_is_that_of_finer_cells_within_the_errors_of_both(
    elastic: vc.ProfileDesign,
) -> None:
    roller = vc.Roller(RADIUS, HALF_LENGTH, profile=vc.TabulatedProfile(elastic.x, elastic.drop))
    material = vc.Material(vc.Elastic(1e9), poisson_ratio=0.35)
    finer = vc.Grid((1200, 151), (21.6e-3, 1.05e-3))
    ds = vc.simulate(roller, material, vc.step(FORCE), finer, [0.0], fields="none")
    row = elastic.table.sel(profile="free")
    errors = float(row.peak_pressure_error + ds.peak_pressure_error[0])
    assert abs(float(ds.peak_pressure[0]) - elastic.peak_pressure) <= errors
    assert errors < 3e-3 * elastic.peak_pressure


@pytest.mark.slow
def test_on_a_body_that_creeps_the_elastic_optimum_is_not_the_best(tmp_path: Path) -> None:
    case = ROLLER.replace(
        "{law: elastic, shear_modulus: 1 GPa",
        "{law: zener, shear_modulus: 1 GPa, delayed_modulus: 0.4 GPa, viscosity: 4 GPa*s",
    ).replace("{end: 1 s, steps: 1}", "{end: 100 s, steps: 6, spacing: log, first: 1 s}")
    found = vc.design_profile(_written(tmp_path, case), workers=1)
    free, elastic = (found.table.sel(profile=name) for name in ("free", "free, without creep"))
    assert float(elastic.peak_pressure) > 1.1 * float(free.peak_pressure)
    assert float(elastic["drop"].max()) < 0.7 * float(free["drop"].max())
    assert any(note.startswith("without creep the best profile would drop") for note in found.notes)
    # Just after loading the body is elastic: the peak of an even pressure is the least possible.
    even = (FORCE / (2 * HALF_LENGTH) * MODULUS / (np.pi * RADIUS)) ** 0.5
    assert even < float(free.peak_pressure) < 1.06 * even


@pytest.mark.slow
def test_a_design_within_a_tolerance_is_less_sensitive_to_it(tmp_path: Path) -> None:
    path, tolerance = _written(tmp_path, WIDE), 1e-6
    robust, nominal = (
        vc.design_profile(path, knots=5, drop_tolerance=each, workers=1) for each in (tolerance, 0)
    )
    u, grid = nominal.x / HALF_LENGTH, vc.Grid((108, 35), (21.6e-3, 2.4e-3))

    def worst(design: vc.ProfileDesign) -> float:
        shapes = (0 * u, u**2, -(u**2), u, np.cos(2 * np.pi * u), -np.cos(2 * np.pi * u))
        drops = [design.drop + tolerance * shape for shape in shapes]
        return max(
            float(_pressed(WIDE_RADIUS, WIDE_FORCE, design.x, drop, grid).peak_pressure[0])
            for drop in drops
        )

    stated = float(robust.table.peak_pressure_of_deviations.max())
    assert stated == close_to(worst(robust), rel=1e-3)
    assert nominal.peak_pressure < robust.peak_pressure < stated < worst(nominal)
    assert robust.table.deviation.values[0] == "none"


@pytest.mark.slow
def test_an_asymmetric_profile_suits_a_load_that_is_always_off_centre(tmp_path: Path) -> None:
    case = WIDE.replace("800 N", "800 N, eccentricity_x: 2 mm")
    path = _written(
        tmp_path, case.replace("[108, 35], size: [21.6 mm, 2.4", "[108, 55], size: [21.6 mm, 4")
    )
    symmetric, free = (
        vc.design_profile(path, knots=5, symmetric=each, workers=1) for each in (True, False)
    )
    # The even pressure of a contact that is centred on the load and ends with the roller (Hertz).
    even = (WIDE_FORCE / 16e-3 * MODULUS / (np.pi * WIDE_RADIUS)) ** 0.5
    assert even < free.peak_pressure < 1.1 * even
    assert free.peak_pressure < symmetric.peak_pressure
    assert abs(free.drop[0] - free.drop[-1]) > 1e-6
    np.testing.assert_allclose(symmetric.drop, symmetric.drop[::-1], atol=1e-10)


#: A track of the roller's own length, whose ends are free.
EQUAL = """
indenter: {shape: roller, radius: 10 mm, half_length: 2 mm}
material: {law: elastic, shear_modulus: 700 MPa, poisson_ratio: 0.3, length: 4 mm, ends: free}
load: {kind: step, force: 40 N}
time: {end: 1 s, steps: 1}
grid: {shape: [44, 36], size: [4.4 mm, 0.8 mm]}
"""


@pytest.mark.slow
def test_on_a_track_that_ends_with_the_roller_no_profile_is_better_than_none(
    tmp_path: Path,
) -> None:
    # Pressure falls towards free ends: what a crown takes from there is added in the middle.
    found = vc.design_profile(_written(tmp_path, EQUAL), knots=4, workers=1)
    peaks, errors = found.table.peak_pressure, found.table.peak_pressure_error
    assert not any("away from the ends" in note for note in found.notes)
    assert any("cylindrical profile" in note for note in found.notes)
    free, cylinder = (float(peaks.sel(profile=name)) for name in ("free", "cylindrical"))
    assert abs(free - cylinder) < float(errors.sel(profile="free")) + 1e-3 * cylinder
    assert float(peaks.sel(profile="crowned")) > 1.01 * cylinder
