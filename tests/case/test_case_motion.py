"""The `motion` of case files, steps of cells, and their mistakes at their keys."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.case.test_case_loads import problem, read

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads.motion import STANDING
from viscontact.case import Case, case_schema
from viscontact.cli.entry import main
from viscontact.report.inputs import inputs
from viscontact.results.summary import summary_scalars
from viscontact.simulation.transient.setup import prepare_run

GRID = {"shape": [16, 24], "size": ["1.6 mm", "2.4 mm"]}
TRAVEL = {"kind": "travel", "points": [["0 s", "0 mm"], ["2 s", "1 mm"]]}
LOAD = {"kind": "step", "force": "1 N", "tilt_x": 0, "tilt_y": 0}


def moving(folder: Path, **sections: Any) -> Case:
    """The case with a path of 1 mm over a given grid."""
    return read(folder, **({"grid": GRID, "motion": TRAVEL, "load": LOAD} | sections))


def test_points_are_positions_along_an_axis(tmp_path: Path) -> None:
    for along, place in (("y", [0.0, 5e-4]), ("x", [5e-4, 0.0])):
        motion = moving(tmp_path, motion={**TRAVEL, "along": along}).motion
        assert motion.position_at(1.0).tolist() == place
        assert motion.rolling is None


def test_file_gives_the_path_along_both_axes_and_belongs_to_the_run(tmp_path: Path) -> None:
    (tmp_path / "path.csv").write_text("time [s],x [um],y [mm]\n0,0,0\n2,100,1\n")
    case = moving(tmp_path, motion={"kind": "travel", "file": "path.csv", "rolling": True})
    assert case.motion.position_at(2.0).tolist() == close_to([1e-4, 1e-3])
    assert case.motion.rolling is True
    assert list(case.files) == [("motion", "file")]


def test_creepage_is_a_share_of_a_body_that_rolls(tmp_path: Path) -> None:
    swung = {"kind": "reciprocating", "amplitude": "0.3 mm", "period": "4 s", "cycles": 2}
    grips = {"friction": {"coefficient": 0.3, "coupling": False}}
    for motion in (TRAVEL, swung):
        for given in ("0.3 %", 0.003):
            found = moving(tmp_path, motion={**motion, "creepage": given}, **grips).motion
            assert found.creepage == close_to(0.003)
            assert found.lateral_creepage is None
            assert found.rolling is True
        askew = {**motion, "creepage": 0.0, "lateral_creepage": "0.1 %"}
        assert moving(tmp_path, motion=askew, **grips).motion.lateral_creepage == close_to(0.001)
    with pytest.raises(ValueError, match=r"motion\.creepage"):
        moving(tmp_path, motion={**TRAVEL, "creepage": "120 %"}, **grips)
    with pytest.raises(ValueError, match="a body that rolls"):
        moving(tmp_path, motion={**TRAVEL, "creepage": 0.1, "rolling": False}, **grips)
    with pytest.raises(ValueError, match="goes with a creepage, which may be 0"):
        moving(tmp_path, motion={**TRAVEL, "lateral_creepage": 0.1}, **grips)


def test_body_stands_without_a_motion(tmp_path: Path) -> None:
    assert read(tmp_path, grid=GRID, load=LOAD).motion == STANDING


def test_reciprocation(tmp_path: Path) -> None:
    motion = {"kind": "reciprocating", "amplitude": "0.3 mm", "period": "4 s", "cycles": 2}
    case = moving(tmp_path, motion=motion)
    given = vc.reciprocating(3e-4, 4.0, 2)
    assert case.motion == given


def test_cells_are_steps_of_a_cell_up_to_the_end(tmp_path: Path) -> None:
    case = moving(tmp_path, time={"end": "1 s", "spacing": "cells"})
    assert isinstance(case.times, np.ndarray)
    assert case.times.tolist() == close_to(np.linspace(0.0, 1.0, 6))
    assert moving(tmp_path, time={"end": "9 s", "spacing": "cells"}).times[-1] == 9.0  # at rest


def test_cells_of_an_automatic_grid_are_chosen_before_the_steps(tmp_path: Path) -> None:
    time = {"end": "2 s", "spacing": "cells"}
    case = moving(tmp_path, grid={"tolerance": "20 %", "quantities": ["approach"]}, time=time)
    run = prepare_run(case)
    ways = np.diff(run.problem.motion.position_at(run.problem.instants)[:, 1])  # type: ignore[union-attr]
    assert ways.max() == close_to(run.grid.cell_size[1])
    assert set(case.fields) <= set(run.problem.instants)


def test_zero_is_a_tilt_without_unit(tmp_path: Path) -> None:
    assert moving(tmp_path).load.at(0.0).tilt_y == 0.0
    said = problem(tmp_path, load={**LOAD, "tilt_y": 1})
    assert "load.tilt_y: 1 has no unit" in said


@pytest.mark.parametrize(
    ("sections", "said"),
    [
        ({"motion": {**TRAVEL, "kind": "travell"}}, "motion.kind: unknown value 'travell'; did"),
        ({"motion": {"kind": "travel"}}, "motion: give points"),
        ({"motion": {**TRAVEL, "points": [["0 s", "0 mm"]]}}, "motion: x and y: the body does not"),
        ({"motion": {**TRAVEL, "speed": "1 m"}}, "motion.speed: unknown key"),
        ({"motion": {**TRAVEL, "points": []}}, "motion.points: is empty"),
        ({"motion": None, "time": {"end": "1 s", "spacing": "cells"}}, "cells goes with a motion"),
        (
            {"time": {"end": "1 s", "spacing": "cells", "steps": 3}},
            "time.steps: goes with spacing: uniform or log only",
        ),
    ],
)
def test_mistakes_are_named_at_their_keys(
    tmp_path: Path, sections: dict[str, Any], said: str
) -> None:
    given = {"grid": GRID, "motion": TRAVEL, "load": LOAD} | sections
    assert said in problem(tmp_path, **given)


def test_path_file_with_other_columns_is_refused(tmp_path: Path) -> None:
    motion = {"kind": "travel", "file": "path.csv"}
    for text, said in (
        ("time [s],force [N]\n0,0\n", "names are time, x, y"),
        ("time [s]\n0\n1\n", "needs the column time, and x or y"),
    ):
        (tmp_path / "path.csv").write_text(text)
        assert said in problem(tmp_path, grid=GRID, motion=motion)


def test_schema_knows_the_motions() -> None:
    motion, _ = case_schema()["properties"]["motion"]["anyOf"]
    assert {"travel", "reciprocating"} <= set(motion["discriminator"]["mapping"])


def test_run_of_a_moving_contact_is_shown_without_rounding(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    zener = {
        **{"law": "zener", "shear_modulus": "10 MPa", "delayed_modulus": "5 MPa"},
        **{"viscosity": "5 MPa s", "poisson_ratio": 0.5},
    }
    grid = {**GRID, "centre": ["0 mm", "0.5 mm"]}
    cells = {"end": "2 s", "spacing": "cells"}
    moving(tmp_path, time=cells, material=zener, load={**LOAD, "force": "0.5 N"}, grid=grid)
    assert main(["run", "case.yaml", "--quiet"]) == 0
    ds = vc.open_results(tmp_path / "case")
    assert ds.sizes["time"] == 11
    shown = summary_scalars(ds)
    assert {"resistance_y", "friction_coefficient", "heat"} <= set(shown)
    assert "resistance_x" not in shown
    of_motion = [(each.name, each.value) for each in inputs(ds) if each.part == "Motion"]
    assert ("y", "0 m, 1 mm") in of_motion
