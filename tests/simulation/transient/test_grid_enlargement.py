"""A grid that the contact outgrows is enlarged, and the run goes on as if it had always been so."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from runs.directory.recorded_sphere import finish, same_bits, stop_after
from simulation.transient.measured_swing import write_swing
from simulation.transient.test_march import differing, steps_of, through_a_file
from viscontact.bodies.grid import AutomaticGrid
from viscontact.mechanics.problem.kept_fields import KeptFields
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.problem.problem_from_arguments import contact_problem
from viscontact.mechanics.state import ContactState
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.over_time import OverTime
from viscontact.runs.solving import labelled
from viscontact.simulation.transient.grid_enlargement import next_grid
from viscontact.simulation.transient.march import March
from viscontact.simulation.transient.setup import RunSetup, prepare_run

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

ZENER = vc.Material(vc.Zener(1e6, 5e5, 1e6), 0.5)
POWER = vc.Material(vc.PowerLaw(2e-7, 0.3, 1.0, instant=3e-7), 0.4)
TOLERANCE = 1e-9
COMPARED = (
    *("force", "approach", "contact_area", "contact_length", "contact_width", "peak_pressure"),
    *("work", "time_error"),
)


def growing(run: RunSetup) -> RunSetup:
    """The run as if its grid, which is too small, had been chosen for it."""
    return replace(run, problem=replace(run.problem, grid=AutomaticGrid()))


def sphere(grid: vc.Grid, **more: Any) -> RunSetup:
    """Held until it has crept, lifted, and pressed anew: what is remembered counts."""
    load = vc.ForceHistory([0, 1, 1.5, 3], [0.01, 0.05, 0.0, 0.2])
    given = {"times": vc.uniform_times(3.0, 12), "tolerance": TOLERANCE} | more
    return prepare_run(Problem(vc.Sphere(0.01), ZENER, load, grid, **given))


def eccentric(grid: vc.Grid) -> RunSetup:
    """Not even across y, remembered step by step, and overrun along x first."""
    load = vc.ramp(0.1, 1.0, eccentricity_x=2e-4, eccentricity_y=2e-5)
    times = vc.uniform_times(2.0, 12)
    return prepare_run(Problem(vc.Sphere(0.01), POWER, load, grid, times, tolerance=TOLERANCE))


def staged(grid: vc.Grid) -> RunSetup:
    """Lifted off in between by an approach."""
    load = vc.ApproachHistory([0, 1, 1.3, 3], [0, 1e-5, 0, 3e-5])
    times = vc.uniform_times(3.0, 15)
    return prepare_run(Problem(vc.Sphere(0.01), ZENER, load, grid, times, tolerance=TOLERANCE))


def jumping(grid: vc.Grid) -> RunSetup:
    """By a jump to far beyond the first grid: work is done on what had given way out there."""
    load = vc.ForceHistory([0, 1, 1, 2], [0.01, 0.02, 0.2, 0.2])
    return prepare_run(
        Problem(vc.Sphere(0.01), ZENER, load, grid, vc.uniform_times(2.0, 8), tolerance=TOLERANCE)
    )


def chosen_steps(grid: vc.Grid) -> RunSetup:
    return sphere(grid, times=vc.adaptive_times(3.0, 0.03))


RUNS = {
    "sphere": (sphere, vc.Grid((20, 20), (8e-4, 8e-4))),
    "eccentric": (eccentric, vc.Grid((25, 28), (1e-3, 1.12e-3))),
    "staged": (staged, vc.Grid((20, 20), (8e-4, 8e-4))),
    "jumping": (jumping, vc.Grid((20, 20), (8e-4, 8e-4))),
    "steps of its choice": (chosen_steps, vc.Grid((20, 20), (8e-4, 8e-4))),
}


def states_of(run: RunSetup) -> list[ContactState]:
    return [state for state in March(run) if state is not None]


@pytest.mark.parametrize("kind", RUNS)
def test_run_whose_grid_grows_is_the_run_on_the_large_grid(kind: str) -> None:
    prepare, small = RUNS[kind]
    grown = states_of(growing(prepare(small)))
    assert grown[0].grid == small
    large = grown[-1].grid
    reference = states_of(prepare(large))
    largest = {name: max(abs(getattr(each, name)) for each in reference) for name in COMPARED}
    deepest = max(float(state.displacement.max()) for state in reference)
    for ours, theirs in zip(grown, reference, strict=True):
        # A hundred times the solver's tolerance of gap and balances, in both runs.
        for name in COMPARED:
            apart = abs(getattr(ours, name) - getattr(theirs, name))
            assert apart <= 1e-7 * largest[name], (name, ours.time)
        moved = ours.grid.embed(ours.displacement, large, np.nan) - theirs.displacement
        assert np.nanmax(np.abs(moved)) <= 1e-7 * deepest
        # A gap right to 1e-9 leaves the pressure of a single cell at the rim freer than that.
        pressed = ours.grid.embed(ours.pressure, large) - theirs.pressure
        assert np.abs(pressed).max() <= 1e-6 * largest["peak_pressure"]


def test_larger_grid_has_the_same_cells_to_the_bit() -> None:
    random = np.random.default_rng(5)
    for _ in range(50):
        shape = random.integers(8, 200, 2).tolist()
        grid = vc.Grid((shape[0], shape[1]), tuple(random.uniform(1e-4, 1.0, 2).tolist()))
        larger = next_grid(grid, True, True)
        largest = next_grid(larger, True, False)
        assert largest.cell_size == larger.cell_size == grid.cell_size
        assert np.isin(grid.x, largest.x).all()
        assert np.isin(grid.y, largest.y).all()
        assert largest == grid.widened(largest.shape)


def test_contact_on_a_grid_that_was_given_still_stops_at_its_rim() -> None:
    prepare, small = RUNS["sphere"]
    with pytest.raises(vc.DomainError, match=r"enlarge grid.size, now 800 µm x 800 µm"):
        states_of(prepare(small))


def test_grid_grows_no_further_than_an_automatic_one_may_be(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    prepare, small = RUNS["sphere"]
    # 30 x 30, but not 48 x 48
    monkeypatch.setattr("viscontact.simulation.transient.grid_enlargement.MAX_CELLS", 1000)
    message = r"outgrows 1\.2 mm x 1\.2 mm at t = .*give a grid of your own"
    with pytest.raises(vc.DomainError, match=message):
        states_of(growing(prepare(small)))


@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(kind, marks=pytest.mark.slow)
        if kind in {"sphere", "staged", "steps of its choice"}
        else kind
        for kind in RUNS
    ],
)
def test_run_continues_to_the_same_bits_before_and_after_its_grid_grows(kind: str) -> None:
    prepare, small = RUNS[kind]
    run = growing(prepare(small))
    march = March(run)
    whole, cells = [], []
    for state in march:
        whole.append((state, march.done, march.left))
        cells.append(tuple(march.restart_data()["cells"]))
    first = cells.index(next(each for each in cells if each != small.shape))
    for count in (first, first + 1, len(whole) - 1):
        if not count:
            continue
        begun = March(run)
        for _ in zip(range(count), begun, strict=False):
            restart_data = through_a_file(begun.restart_data())
        assert differing(whole[count:], steps_of(March(run, restart_data))) == []


def test_result_is_on_the_last_grid_and_records_when_it_grew(
    caplog: pytest.LogCaptureFixture,
) -> None:
    caplog.set_level(logging.INFO, logger="viscontact")
    prepare, small = RUNS["sphere"]
    run = growing(prepare(small))
    states = states_of(run)
    ds = labelled(OverTime(run), states, 0.0)
    large = states[-1].grid
    assert ds.x.values.tolist() == large.x.tolist()
    assert ds.sizes["y"] == large.shape[1]
    # Nothing is pressed beyond the grid of an instant; how far it gives way there is not known.
    early = ds.isel(time=0)
    outside = ~np.isin(large.x, small.x)
    assert (early.pressure.values[outside] == 0).all()
    assert not early.in_contact.values[outside].any()
    assert early.in_contact.any()
    assert np.isnan(early.gap.values[outside]).all()
    assert np.isfinite(early.gap.values[~outside][:, ~outside]).all()
    assert (ds.pressure.sum(["x", "y"]) * large.cell_area).values == close_to(ds.force.values)
    dy = large.cell_size[1]
    np.testing.assert_allclose(ds.line_load, ds.pressure.sum("y") * dy, rtol=1e-12)
    lines = ds.attrs["grid_enlarged"].splitlines()
    assert lines[0].startswith("t = 250 ms: from 20 x 20 cells on 800 µm x 800 µm to 30 x 30")
    assert len(lines) == len({state.grid.shape for state in states}) - 1
    said = [record.getMessage() for record in caplog.records]
    assert said[0] == "t = 0.25 s: grid enlarged to 30 x 30 cells"
    assert len(said) == len(lines)


@pytest.mark.slow
def test_contact_beyond_the_automatic_extent_is_followed(tmp_path: Path) -> None:
    """Of a long measured load only the largest and the farthest rows are looked at beforehand."""
    write_swing(tmp_path / "load.csv")
    time, force, offset = np.loadtxt(tmp_path / "load.csv", delimiter=",", skiprows=1).T
    load = vc.ForceHistory(time, force, eccentricity_x=offset)
    gel = vc.Material(vc.Elastic(1e6), 0.5)
    ds = vc.simulate(vc.Sphere(0.01), gel, load, AutomaticGrid(tolerance=0.1), [0.2, 1.0])
    ds = ds.sel(time=[0.2])
    assert ds.attrs["grid_enlarged"].startswith("t = 200 ms: from ")
    # Hertz: a³ = 3 W R / (16 G), here about the eccentricity, as the sphere is free to tilt.
    radius = (3 * 0.18 * 0.01 / 16e6) ** (1 / 3)
    assert ds.force[-1] == close_to(0.18, rel=1e-6)
    assert ds.eccentricity_x[-1] == close_to(6e-4, rel=1e-5)
    assert ds.contact_length[-1] / 2 == close_to(radius, rel=0.05)
    pressed = ds.x.values[ds.pressure.values[-1].any(axis=1)]
    cell = float(ds.x[1] - ds.x[0])
    assert pressed.max() == close_to(6e-4 + radius, abs=cell)


# --- bodies that adhere -----------------------------------------------------------------------

#: Of a sphere on a gel, 1/(4 G) = 1e-6 m²/N; units of force, length and approach (Maugis 1992).
WORK, RADIUS, COMPLIANCE = 0.05, 1e-3, 1e-6
FORCE = np.pi * WORK * RADIUS
LENGTH = np.cbrt(FORCE * RADIUS * COMPLIANCE * 3 / 4)
DEPTH = LENGTH**2 / RADIUS
GEL = vc.Material(vc.Elastic(0.25e6), poisson_ratio=0.5)
CREEPING = vc.Material(vc.Zener(2.5e5, 2.5e5, 2.5e4), poisson_ratio=0.5)


def adhering(cells: int, levels: list[float], material: vc.Material, count: int) -> RunSetup:
    size = cells * 9 * LENGTH / 80
    law = vc.Adhesion(WORK, range=np.cbrt(RADIUS * (WORK * COMPLIANCE) ** 2) / 1.5)
    load = vc.ApproachHistory([0.0, 1.0, 2.0], np.array(levels) * DEPTH)
    given = contact_problem(
        indenter=vc.Paraboloid(RADIUS, RADIUS),
        material=material,
        load=load,
        grid=vc.Grid((cells, cells), (size, size)),
        times=np.linspace(0.0, 2.0, count),
        adhesion=law,
    )
    return prepare_run(given)


def work_and_cells(run: RunSetup) -> tuple[list[float], list[int]]:
    """Work [FORCE · DEPTH] and cells along x of each state."""
    states = states_of(run)
    works = [state.work / (FORCE * DEPTH) for state in states]
    return works, [state.grid.shape[0] for state in states]


def test_elastic_bodies_that_adhere_lose_nothing_on_a_closed_path_on_which_the_grid_grows() -> None:
    # Without a jump the load gets back what it has done. Attraction has pulled beyond the small
    # grid, by an energy of 0.036 at the growth, and by 1e-4 at the first and last approach.
    works, cells = work_and_cells(growing(adhering(44, [-0.3, 3.0, -0.3], GEL, 17)))
    assert (cells[0], cells[-1]) == (44, 72)
    assert works[-1] - works[0] == close_to(0.0, abs=2e-4)
    assert max(works) - min(works) > 3


@pytest.mark.parametrize(
    ("start", "levels", "material", "beyond"),
    [
        # The pull of the new cells changes the force, and the growth takes a step of the shortest
        # length. `beyond` is the energy of their attraction [FORCE · DEPTH].
        (28, [-3.0, 0.8, -3.0], GEL, 0.0515),
        (44, [-0.3, 3.0, -0.3], CREEPING, 0.0179),
    ],
    ids=["in a shortest step", "while it creeps"],
)
def test_work_after_the_growth_contains_that_of_attraction_in_the_new_cells_before(
    start: int, levels: list[float], material: vc.Material, beyond: float
) -> None:
    # As on a grid that was always so large, but for products of what these cells change.
    grown, cells = work_and_cells(growing(adhering(start, levels, material, 33)))
    large, _ = work_and_cells(adhering(cells[-1], levels, material, 33))
    apart = [abs(a - b) for a, b, n in zip(grown, large, cells, strict=True) if n == cells[-1]]
    assert len(apart) > 10
    assert max(apart) < 0.2 * beyond


# --- on disk ----------------------------------------------------------------------------------

SOME = [0.0, 0.75, 2.0, 3.0]


def recorded(directory: Path, fields: str | list[float] = "all") -> Recorded:
    directory.mkdir(exist_ok=True)
    prepare, small = RUNS["sphere"]
    run = growing(prepare(small))
    run = replace(run, problem=replace(run.problem, kept=KeptFields(fields)))
    return Recorded(directory, OverTime(run, errors=False))


@pytest.mark.parametrize("fields", [pytest.param("all", marks=pytest.mark.slow), SOME])
def test_recorded_result_is_the_one_that_is_returned(
    fields: str | list[float], tmp_path: Path
) -> None:
    of = recorded(tmp_path, fields)
    finish(Recorder(of))
    states = states_of(of.run.setup)
    if fields != "all":
        states = [each if each.time in fields else each.without_fields() for each in states]
    expected = labelled(of.run, states, 0.0)
    with vc.open_results(tmp_path) as ds:
        assert ds.attrs["grid_enlarged"] == expected.attrs["grid_enlarged"] != ""
        assert set(ds.variables) == set(expected.variables)
        for name, variable in expected.variables.items():
            assert ds[name].values.tobytes() == variable.values.tobytes(), name


@pytest.mark.parametrize(
    ("pause", "fields"),  # checkpoints after every step, after the first only
    [
        (0.0, SOME),
        pytest.param(1e9, "all", marks=pytest.mark.slow),
        pytest.param(0.0, "all", marks=pytest.mark.slow),
        pytest.param(1e9, SOME, marks=pytest.mark.slow),
    ],
)
def test_run_that_is_stopped_after_every_step_ends_in_the_same_bits(
    fields: str | list[float], pause: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.runs.directory.recorder.PAUSE", pause)
    monkeypatch.setattr("viscontact.runs.directory.recorder.SHARE", 0.0)
    finish(Recorder(recorded(tmp_path / "whole", fields)))
    stopped = recorded(tmp_path / "stopped", fields)
    stop_after(Recorder(stopped), 1)
    for instants in range(2, len(stopped.run.places)):
        stop_after(Recorder.resume(stopped), instants)
    finish(Recorder.resume(stopped))
    assert same_bits(tmp_path / "stopped", tmp_path / "whole")
    notes = []
    for name in ("stopped", "whole"):
        with vc.open_results(tmp_path / name) as ds:
            notes.append((ds.attrs["grid_enlarged"], ds.attrs["warnings"]))
    assert notes[0] == notes[1]


def test_result_that_is_ahead_of_the_state_on_a_larger_grid_is_continued(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As where a process is killed between the two, just after the grid has grown."""
    monkeypatch.setattr("viscontact.runs.directory.recorder.PAUSE", 0.0)
    monkeypatch.setattr("viscontact.runs.directory.recorder.SHARE", 0.0)
    finish(Recorder(recorded(tmp_path / "whole")))
    record = Recorder(recorded(tmp_path / "ahead"))
    saved = b""
    for state in record.steps():
        assert state is not None
        if state.grid.shape != (20, 20):
            break
        saved = (tmp_path / "ahead" / "state.npz").read_bytes()
    record.close()
    with vc.open_results(tmp_path / "ahead") as ds:
        assert ds.sizes["x"] == 30
    (tmp_path / "ahead" / "state.npz").write_bytes(saved)
    finish(Recorder.resume(recorded(tmp_path / "ahead")))
    assert same_bits(tmp_path / "ahead", tmp_path / "whole")
