"""Progress, memory and requests of runs."""

from __future__ import annotations

import math
from itertools import count
from pathlib import Path
from types import SimpleNamespace

import pytest

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import FlatPunch, Paraboloid
from viscontact.bodies.laws import Zener
from viscontact.bodies.materials.material import Material
from viscontact.drawing.content.indenter_facts import facts
from viscontact.drawing.content.shape import shape_of
from viscontact.runs import forecast
from viscontact.runs.check_report import drawn_size, warnings_of
from viscontact.runs.processes.request import RunRequest
from viscontact.runs.progress_made import progress_made
from viscontact.runs.run_memory import fitting, least_memory, needed_memory


def test_command_that_resumes_a_run_is_quoted_for_the_shell() -> None:
    found = RunRequest(Path("my case.yaml"), settings=("load.force=20 kN",)).resuming
    assert found == "viscontact run 'my case.yaml' --set 'load.force=20 kN' --resume"


def test_progress_counts_the_initial_instant() -> None:
    assert progress_made(2, 1.0, [0.0, 1.0, 2.0], adaptive=None) == "2 of 3 instants"


def test_memory_of_a_million_cells_is_390_bytes_each_and_less_with_symmetry() -> None:
    assert round(needed_memory(Grid((1000, 1000), (1.0, 1.0)), fields_kept=2) / 1e6) == 390
    found = round(needed_memory(Grid((1000, 1000), (1.0, 1.0)), 2, mirrored=(True, True)) / 1e6)
    assert found == 284


def test_least_memory_counts_the_terms_of_the_law() -> None:
    rubber = Material(Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    found = round(least_memory(Grid((1000, 1000), (1.0, 1.0)), rubber.contact_compliance()) / 1e6)
    assert found == 374


def test_any_two_of_three_runs_fit_into_the_memory() -> None:
    assert fitting([1e8, 2e8, 1.5e8], available=4e8) == 2
    # Whichever they are: the two largest do not.
    assert fitting([1e8, 3e8, 2e8], available=4e8) == 1


def test_duration_of_a_convolution_on_a_large_grid_goes_with_its_cells(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """On a clock that shows a second for whatever is timed."""
    ticks = count()
    # In a minute in which nothing has been timed yet.
    shown = SimpleNamespace(perf_counter=lambda: next(ticks), monotonic=lambda: -1e9)
    monkeypatch.setattr(forecast, "clock", shown)
    cells = [(512, 512), (1024, 1024), (2048, 1024)]
    found = [forecast.convolution_time(Grid(shape, (1.0, 1.0))) for shape in cells]
    assert found == close_to([1.0, 4.0, 8.0])


def test_a_convolution_is_timed_once_a_minute(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a clock that shows a second more for each that is timed."""
    ticks, now = count(), [-2e9]
    durations = (next(ticks) ** 2 for _ in count())
    shown = SimpleNamespace(perf_counter=lambda: next(durations), monotonic=lambda: now[0])
    monkeypatch.setattr(forecast, "clock", shown)
    grid = Grid((64, 64), (1.0, 1.0))
    first = forecast.convolution_time(grid)
    assert forecast.convolution_time(grid) == first
    now[0] += 120.0
    assert forecast.convolution_time(grid) > first


def test_body_that_ends_a_little_beyond_the_grid_is_drawn_with_its_end() -> None:
    for radius, extent in ((1.1e-3, 2.31e-3), (1.5e-3, 2e-3)):
        contact = SimpleNamespace(indenter=FlatPunch(radius))
        run = SimpleNamespace(grid=Grid((8, 8), (2e-3, 2e-3)), contact=contact)
        assert drawn_size(run) == close_to((extent, extent), rel=2e-3)


def test_body_without_end_is_drawn_as_far_along_as_across() -> None:
    cylinder, grid = Paraboloid(math.inf, 5e-3), Grid((1, 64), (1.0, 2e-3), (True, False))
    run = SimpleNamespace(grid=grid, contact=SimpleNamespace(indenter=cylinder))
    assert drawn_size(run) == close_to((2e-3, 2e-3))
    sections = shape_of(cylinder, (2e-3, 2e-3), 9).sections
    texts = list(facts(cylinder, sections, (), (0.0, 0.0, 1.0, 1e-3), "contact"))
    assert texts[0] == "Cylinder along x, radius 5 mm"
    assert texts[-1] == "shaded: contact, 1 mm wide"


@pytest.mark.parametrize(("along", "is_warned"), [(5.0, True), (8.0, False)])
def test_few_cells_along_a_period_count_only_where_the_contact_ends(
    along: float, is_warned: bool
) -> None:
    grid = Grid((8, 64), (1e-3, 8e-3), periodic=(True, False))
    expected = SimpleNamespace(
        estimate=object(), fits=True, cells_along=along, cells_across=30.0, warnings={}
    )
    prepared = SimpleNamespace(run=SimpleNamespace(grid=grid))
    assert bool(warnings_of(prepared, expected)) == is_warned
