"""Files of a run directory: names, differences, failures, layout, outline."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest

from viscontact.bodies.grid import Grid
from viscontact.mechanics.problem.kept_fields import KeptFields
from viscontact.results.run_files import FAILURE_NAME
from viscontact.runs.directory.atomic_files import fresh_name, replacing
from viscontact.runs.directory.differences import Difference, differences
from viscontact.runs.directory.failure import write_failure
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.npz_archive import outline_of, write_plain


def test_new_file_is_hidden_until_it_replaces_the_old_one() -> None:
    assert fresh_name(Path("state.npz")).name == ".state.npz.new"


def test_difference_states_both_values() -> None:
    found = str(Difference("load.force", "10 kN", "20 kN"))
    assert found == "load.force: was 10 kN, is now 20 kN"


def test_difference_in_a_list_has_its_position() -> None:
    [found] = differences({"load": {"force": [0.0, 4.0]}}, {"load": {"force": [0.0, 5.0]}})
    assert str(found) == "load.force[2]: was 4.0, is now 5.0"


def test_unknown_numbers_of_equal_descriptions_are_no_difference() -> None:
    assert differences({"end": float("nan")}, {"end": float("nan")}) == ()
    assert len(differences({"end": float("nan")}, {"end": 1.0})) == 1


def test_file_that_was_not_written_to_its_end_is_not_left(tmp_path: Path) -> None:
    kept = tmp_path / "state.npz"
    kept.write_bytes(b"old")

    def stop_half_way() -> None:
        with replacing(kept) as file:
            file.write(b"half")
            raise OSError("the disk is full")

    with pytest.raises(OSError, match="the disk is full"):
        stop_half_way()
    assert list(tmp_path.iterdir()) == [kept]
    assert kept.read_bytes() == b"old"


def test_failure_is_written_with_outcome_code_and_message(tmp_path: Path) -> None:
    write_failure(tmp_path, "stopped", 1, ["contact at the edge"])
    text = (tmp_path / FAILURE_NAME).read_text(encoding="utf-8")
    assert text == '{"outcome": "stopped", "code": 1, "message": ["contact at the edge"]}\n'


def test_some_kept_fields_have_a_time_axis_of_their_own() -> None:
    grid = Grid((4, 4), (1.0, 1.0))
    found = Contents(grid, np.array([0.0, 1.0]), KeptFields([1.0])).layout(grid).axis
    assert found == "field_time"


def test_outline_is_read_without_the_arrays() -> None:
    file = io.BytesIO()
    write_plain(file, {"work": 1.5})
    assert outline_of(file) == {"work": 1.5}
