"""Options of the command line: what is read, and its words in messages."""

from __future__ import annotations

import gc
import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from synthetic_results import maxwell_sphere
from viscontact.bodies.indenters import Sphere
from viscontact.cli.material.fit_options import read_indenter, read_kelvin, read_stress, read_weight
from viscontact.cli.quick_imports import quick_imports
from viscontact.cli.results.figures import save_animation
from viscontact.cli.results.history_table import _shown_scalars
from viscontact.cli.results.reports import _run_label
from viscontact.cli.studies.typed_options import as_typed, instant
from viscontact.cli.sweep.checks import _list_names
from viscontact.cli.sweep.plan_options import PlanOptions, share_a_branch
from viscontact.cli.sweep.request import ManyRequest
from viscontact.cli.sweep.table import first_names
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.typed_values import bounds, is_range, split_values


def test_place_of_a_scalar_is_an_instant_or_a_speed() -> None:
    assert [instant(text) for text in ("end", "2 min", "20 mm/s")] == ["end", 120.0, 0.02]


def test_report_is_labelled_with_the_directory_of_its_run(tmp_path: Path) -> None:
    files = (tmp_path / "run-2", tmp_path / "run-2" / "result.nc", tmp_path / "ball.nc")
    assert [_run_label(file) for file in files] == ["run-2", "run-2", "ball"]


def test_steady_motion_under_a_given_approach_has_its_forces_in_the_table() -> None:
    under_force = maxwell_sphere().rename(time="speed").assign_attrs(along="y")
    under_force["friction_coefficient"] = 0 * under_force["force"]
    load = {"type": "ApproachHistory", "times": [0.0], "approach": [1e-6]}
    case = json.loads(under_force.attrs["case"]) | {"load": load}
    under_approach = under_force.assign_attrs(case=json.dumps(case))
    shown = ["force" in _shown_scalars(each) for each in (under_force, under_approach)]
    assert shown == [False, True]


@pytest.mark.parametrize(("stored", "is_said"), [(6, True), (20, False)])
def test_few_stored_instants_of_an_animation_are_said(
    stored: int, is_said: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of 60 frames, fewer than a quarter."""
    film = SimpleNamespace(instants=np.arange(60) * stored // 60)
    plot = SimpleNamespace(animation=lambda ds: film, save_animation=lambda *given: None)
    save_animation(plot, tmp_path / "film.gif", xr.Dataset())
    said = capsys.readouterr()
    assert (f"60 frames show {stored} stored instants" in said.out + said.err) == is_said


def test_weight_has_a_column_and_a_number() -> None:
    assert read_weight("storage=2") == ("storage", 2.0)


def test_stress_is_read_in_pascal() -> None:
    assert read_stress("5 MPa") == 5000000.0


def test_temperature_in_celsius_is_read_in_kelvin() -> None:
    assert read_kelvin("--reference", "20 degC") == 293.15


def test_indenter_is_read_from_its_kind_and_radius() -> None:
    assert read_indenter("sphere 5 mm") == Sphere(radius=0.005)


def test_garbage_is_not_collected_during_imports() -> None:
    with quick_imports():
        assert not gc.isenabled()
    assert gc.get_freeze_count() > 0
    gc.unfreeze()


def test_message_about_an_argument_names_the_option() -> None:
    assert as_typed("constraints: write SCALAR<=VALUE", {}) == "--constraint: write SCALAR<=VALUE"
    assert as_typed("runs must be above zero", {"runs": 0}) == "--runs must be above zero"


def test_several_names_have_a_plural_noun() -> None:
    assert _list_names("line", ["2", "5"]) == "lines 2, 5"


def test_message_about_a_varied_key_names_its_option() -> None:
    options = PlanOptions(varied=("load.force=2,3",))
    found = options.as_typed("--set load.force: cannot read '2'", ["load.force"])
    assert found == "--vary load.force: cannot read '2'"


def test_key_shares_a_branch_with_its_section_but_not_with_its_sibling() -> None:
    assert share_a_branch("load", "load.force")
    assert not share_a_branch("load.kind", "load.force")


def test_comma_in_brackets_does_not_separate_values() -> None:
    assert split_values("[1 mm, 2 mm], 3 mm") == ["[1 mm, 2 mm]", "3 mm"]


def test_command_that_resumes_many_runs_has_all_files() -> None:
    common = RunRequest(Path("a.yaml"), output=Path("all"))
    found = ManyRequest((Path("a.yaml"), Path("b.yaml")), common, jobs=2).resuming
    assert found == "viscontact run a.yaml b.yaml -o all -j 2 --resume"


def test_names_beyond_the_first_are_counted() -> None:
    assert first_names(["a", "b", "c"], 2) == "a, b and 1 more"


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("1 mm:2 mm", True),
        ("[1 mm, 2 mm]:[2 mm, 3 mm]", True),
        ("pmma-paper, {law: elastic, shear_modulus: 1 MPa}", False),
        ("pmma, [a: b", False),  # a bracket that is not closed
        ("'Run: first', \"Run: second\"", False),
        ("'a' : 'b'", True),
        ("5 kN, 10 kN", False),
        ("", False),
    ],
)
def test_a_range_has_colons_outside_brackets_and_quotes(text: str, found: bool) -> None:
    assert is_range(text) is found


def test_parts_of_a_range_are_separated_by_colons() -> None:
    assert bounds("1 mm : 2 mm:log") == ("1 mm", "2 mm", "log")
