"""Progress, memory and requests of runs."""

from __future__ import annotations

from pathlib import Path

from viscontact.bodies.grid import Grid
from viscontact.bodies.laws import Zener
from viscontact.bodies.materials.material import Material
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
