"""Common grid of the runs of a sensitivity."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.studies.sensitivity.cases import HERTZ, written

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.case import read_case
from viscontact.studies.cells import coarser, covering, grid_setting
from viscontact.studies.sensitivity.inputs import inputs_of
from viscontact.studies.sensitivity.plan import planned

NOMINAL = Grid((40, 24), (2e-3, 1e-3), centre=(1e-3, 0.0))


def edges(grid: Grid, axis: int) -> tuple[float, float]:
    middle, half = grid.centre[axis], grid.size[axis] / 2
    return middle - half, middle + half


@pytest.mark.parametrize(
    "other",
    [
        Grid((40, 24), (3e-3, 0.5e-3), centre=(1e-3, 0.0)),
        Grid((64, 64), (1e-3, 1e-3), centre=(0.0, 1e-4)),
        Grid((16, 16), (4e-3, 4e-3), centre=(2e-3, 0.0)),
    ],
)
def test_the_grid_covers_all_others_on_cells_of_the_nominal_one(other: Grid) -> None:
    found = covering(NOMINAL, [other])
    for axis in (0, 1):
        for each in (NOMINAL, other):
            low, high = edges(each, axis)
            assert edges(found, axis)[0] <= low + 1e-12
            assert edges(found, axis)[1] >= high - 1e-12
        ratio = NOMINAL.cell_size[axis] / found.cell_size[axis]
        assert ratio == close_to(round(ratio), rel=1e-12)
        assert found.cell_size[axis] <= 1.5 * other.cell_size[axis] * (1 + 1e-9)
    # Cells end at the same places.
    shift = np.subtract(edges(found, 0)[0], edges(NOMINAL, 0)[0]) / found.cell_size[0]
    assert shift == close_to(round(float(shift)), abs=1e-9)


def test_the_setting_of_a_grid_is_read_back(tmp_path: Path) -> None:
    text = HERTZ[: HERTZ.index("grid")]
    [setting] = [f"{key}={value}" for key, value in grid_setting(NOMINAL).items()]
    assert read_case(written(tmp_path, text), [setting]).grid == NOMINAL


def test_a_line_contact_keeps_its_period_along_the_line(tmp_path: Path) -> None:
    line = replace(NOMINAL, shape=(1, 40), size=(1.0, 4e-3), periodic=(True, False))
    found = covering(line, [replace(line, shape=(1, 64), size=(1.0, 8e-3))])
    assert (found.shape[0], found.size[0], found.periodic) == (1, 1.0, line.periodic)
    assert found.size[1] >= 8e-3
    path = written(tmp_path, HERTZ[: HERTZ.index("grid")])
    [setting] = [f"{key}={value}" for key, value in grid_setting(found).items()]
    assert read_case(path, [setting]).grid == found


def test_coarser_cells_are_twice_as_long() -> None:
    assert coarser(NOMINAL).cell_size == close_to(2 * np.array(NOMINAL.cell_size))


def test_all_runs_have_one_grid_and_coarse_ones_another(tmp_path: Path) -> None:
    path = written(tmp_path, HERTZ[: HERTZ.index("grid")])
    case = read_case(path)
    plan, notes = planned(path, {}, inputs_of(case), 0.1, None, chosen=False)
    grids = [read_case(run.case, run.assignments).grid for run in plan.runs()]
    fine, coarse = dict.fromkeys(grids)
    assert isinstance(fine, Grid)
    assert isinstance(coarse, Grid)
    assert coarse == coarser(fine)
    assert (notes, len(grids)) == ([], 2 * (1 + 5 * 4))


def test_an_input_near_its_limit_has_shorter_or_one_sided_steps(tmp_path: Path) -> None:
    for ratio, points, step in (("0.4", 4, 0.1), ("0.45", 4, 0.05), ("0.5", 3, 0.025)):
        path = written(tmp_path, HERTZ.replace("0.4}", f"{ratio}}}"))
        case = read_case(path)
        given = [each for each in inputs_of(case) if each.key == "material.poisson_ratio"]
        plan, _ = planned(path, {}, given, 0.1, None, chosen=True)
        [found] = plan.derivatives
        assert (len(found.stencil.points), found.step) == (points, step), ratio


def test_a_number_that_cannot_change_is_left_out_with_a_note(tmp_path: Path) -> None:
    text = HERTZ.replace("kind: step, force: 1 N", CYCLES)
    path = written(tmp_path, text)
    case = read_case(path)
    plan, notes = planned(path, {}, inputs_of(case), 0.1, None, chosen=False)
    assert "load.cycles" not in [each.given.key for each in plan.derivatives]
    assert [note.partition(":")[0] for note in notes] == ["load.cycles"]


CYCLES = "kind: harmonic, mean: 1 N, amplitude: 0.5 N, period: 1 s, cycles: 3"
