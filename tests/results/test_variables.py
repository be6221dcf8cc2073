"""One table lists the scalars of a result, and everything that shows scalars reads it."""

from __future__ import annotations

import dataclasses
import io
import json
import re
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from campaigns import tried
from closeness import close_to
from reports_without_pictures import without_pictures
from returned import some
from viscontact.cli import main
from viscontact.cli.sweep.table import print_table
from viscontact.drawing.content.history import response_names
from viscontact.drawing.plotly.panel_over_run import histories
from viscontact.drawing.svg.result_overview import result_overview
from viscontact.mechanics.problem.kept_fields import NO_FIELDS
from viscontact.mechanics.state import MOTION, ContactState
from viscontact.plot import history
from viscontact.report.drawings import drawn, framed
from viscontact.report.page import report_page
from viscontact.report.run_data import run_data
from viscontact.results import variables
from viscontact.results.dataset import to_dataset
from viscontact.results.history_csv import write_history
from viscontact.results.summary import summary_rows
from viscontact.results.variables import (
    REQUIRED,
    SCALARS,
    Place,
    Variable,
    error_name,
    scalars_of,
    shown_in,
)
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.result_writer import ResultWriter
from viscontact.runs.processes.child import Ended
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.request import RunRequest
from viscontact.simulation.accuracy.coarser_results import history_of
from viscontact.simulation.accuracy.error_models import ERROR_MODELS
from viscontact.simulation.accuracy.first_and_last_contact import ZERO_WITHOUT_CONTACT
from viscontact.web.runs.live_scalars import grown

__all__ = ["without_pictures"]  # a fixture

pytestmark = pytest.mark.usefixtures("without_pictures")

EVERYWHERE = ~Place.NOWHERE
NEW = "rim_slope"
LABEL = "Slope at the rim"


@pytest.fixture(scope="module")
def ds() -> xr.Dataset:
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    grid = vc.Grid((24, 24), (2e-3, 2e-3))
    load = vc.step(0.05, eccentricity_x=2e-5)
    return vc.simulate(vc.Sphere(0.01), rubber, load, grid, [0.0, 1.0, 2.0], errors=False)


@pytest.fixture
def extended(ds: xr.Dataset, monkeypatch: pytest.MonkeyPatch) -> xr.Dataset:
    """A result with a scalar more than the program has: one entry of the table, and its values."""
    entry = Variable(
        "rad", "slope at the rim", label=LABEL, has_error=True, places=EVERYWHERE, rank=20
    )
    monkeypatch.setitem(variables.SCALARS, NEW, entry)
    units = {"units": "rad"}
    return ds.assign(
        {NEW: ("time", [0.1, 0.2, 0.3], units), error_name(NEW): ("time", [0.01] * 3, units)}
    )


def test_table_has_every_scalar_of_a_state_and_of_a_dataset(ds: xr.Dataset) -> None:
    fields = {field.name for field in dataclasses.fields(ContactState)}
    assert {each.per_length_of or name for name, each in SCALARS.items()} <= fields
    stored = [name for name in ds if ds[name].dims == ("time",) and name not in ("gap", "pressure")]
    assert stored == list(scalars_of())


def test_only_results_of_moving_contacts_have_their_scalars(tmp_path: Path) -> None:
    rubber, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((24, 24), (2e-3, 2e-3))
    standing = next(vc.march(vc.Sphere(0.01), rubber, vc.step(0.05), grid, [0.0]))
    names = [name for name, variable in SCALARS.items() if variable.of == MOTION]
    moving = dataclasses.replace(standing, **dict.fromkeys(names, 0.5))
    path = tmp_path / "result.nc"
    with ResultWriter(
        path, Contents(grid, np.zeros(1), NO_FIELDS, parts=frozenset({"motion"}))
    ) as writer:
        writer.append(moving)
        writer.finish()
    stored = vc.open_results(path)
    labelled = to_dataset([moving], "field_time", {})
    for ds in (stored, labelled):
        assert [float(ds[name][0]) for name in names] == [0.5] * len(names)
    assert not set(names) & set(to_dataset([standing], "field_time", {}))
    assert not set(names) & set(history_of([standing]))
    assert {"friction_coefficient", "heat"} <= set(history_of([moving]))


def test_estimated_errors_are_those_of_the_table() -> None:
    promised = [name for name, variable in SCALARS.items() if variable.has_error]
    # The mean pressure follows from force and area, and what a unit of length has from a period.
    own = [name for name in promised if not SCALARS[name].per_length_of]
    assert list(ERROR_MODELS) == [name for name in own if name != "mean_pressure"]
    assert set(ZERO_WITHOUT_CONTACT) <= set(promised)


def test_every_scalar_that_is_shown_has_a_label_and_a_position_of_its_own() -> None:
    shown = [variable for variable in SCALARS.values() if variable.places]
    assert all(variable.label for variable in shown)
    # Only what is prescribed has no error bar; that of a leakage is found with it.
    assert all(
        each.has_error or each.of.startswith("leakage") or each.places == Place.LOAD
        for each in shown
    )
    assert len({variable.rank for variable in shown}) == len(shown)
    assert all(shown_in(place) for place in Place)


def test_new_entry_is_in_dataset_and_csv(
    extended: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    csv = io.StringIO()
    write_history(extended, csv)
    header = csv.getvalue().splitlines()[0].split(",")
    assert f"{NEW} [rad]" in header
    assert f"{NEW}_error [rad]" in header
    rubber, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((24, 24), (2e-3, 2e-3))
    state = next(vc.march(vc.Sphere(0.01), rubber, vc.step(0.05), grid, [0.0]))
    monkeypatch.setattr(ContactState, NEW, 0.5, raising=False)
    assert float(to_dataset([state], "field_time", {})[NEW][0]) == 0.5


def test_new_entry_is_in_summary_card_and_tables(
    extended: xr.Dataset, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert NEW in [row.name for row in summary_rows(extended)]
    assert LABEL.lower() in [row[0] for row in result_overview(extended).rows]
    vc.save(extended, tmp_path / "result.nc")
    assert main(["show", str(tmp_path / "result.nc")]) == 0
    assert "slope" in capsys.readouterr().out


def test_new_entry_is_in_figures_and_report(extended: xr.Dataset) -> None:
    assert f"{LABEL} [mrad]" in [axes.get_ylabel() for axes in history(extended).axes]
    titles = [figure.layout.meta["title"] for figure in histories(extended)]
    assert f"{LABEL} [mrad]" in titles
    assert re.search(rf"<dt>{LABEL}</dt><dd>300 ± 10", report_page(extended).replace("\xa0", " "))


OPTIONAL = [name for name in SCALARS if name not in REQUIRED]
# The result is of a standing contact, from which scalars of a moving one are absent alike.
MOVING = next(name for name in OPTIONAL if SCALARS[name].moving)


#: Scalars that a result is without; neighbours belong to each other, and are left out by turns.
TURNS = tried(6, len(OPTIONAL))
WITHOUT = [OPTIONAL[turn::TURNS] for turn in range(TURNS)]


@pytest.fixture(
    params=[
        *(pytest.param([name], id=name) for name in (NEW, MOVING)),
        *(pytest.param(names, marks=pytest.mark.slow, id=names[0]) for names in WITHOUT),
    ]
)
def older(
    request: pytest.FixtureRequest, extended: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> xr.Dataset:
    """A result that was written before scalars existed."""
    absent = []
    for name in request.param:
        new = dataclasses.replace(SCALARS[name], places=EVERYWHERE, label="New")
        monkeypatch.setitem(variables.SCALARS, name, new)
        absent += [each for each in (name, error_name(name)) if each in extended]
    return extended.drop_vars(set(absent))


def test_older_result_is_shown_without_the_new_scalar(
    older: xr.Dataset,
    extended: xr.Dataset,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    # Still pictures are drawn, too, but not written; of the others, no pixels are counted here.
    for module in ("drawings", "measured"):
        monkeypatch.setattr(f"viscontact.report.{module}.drawn", drawn)
    monkeypatch.setattr("viscontact.report.still_figures.framed", framed)
    monkeypatch.setattr("viscontact.report.drawings.as_svg", lambda figure: b"<svg/>")
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 30)
    files = [str(tmp_path / name) for name in ("result.nc", "newer.nc")]
    for run, file in zip((older, extended), files, strict=True):
        vc.save(run, file)
    for command in (["show"], ["export"], ["plot", "history"], ["report"]):
        assert main([command[0], files[0], *command[1:]]) == 0, command
    assert "force" in capsys.readouterr().out
    assert main(["compare", *files, "-o", str(tmp_path / "compare.png")]) == 0
    assert not [row for row in result_overview(older).rows if row[0] == "new"]
    assert "New" not in run_data(older)["facts"].values()
    assert vc.plot.animation(older, seconds=1.0, fps=2.0).instants.size == 2


@pytest.mark.parametrize("name", ["time", *REQUIRED])
def test_file_without_a_required_scalar_is_no_result(
    name: str, ds: xr.Dataset, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    vc.save(ds.drop_vars(name), tmp_path / "result.nc")
    assert main(["show", str(tmp_path / "result.nc")]) == 2
    assert f"not a result of viscontact: it has no {name}" in capsys.readouterr().err


def test_table_of_runs_never_cuts_a_number(
    extended: xr.Dataset,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    name = "roller_force=1000N"
    limits = json.dumps({"force": {"limit": 1.0}})
    (tmp_path / name).mkdir()
    vc.save(extended.assign_attrs(wall_time=1.0, allowable=limits), tmp_path / name / "result.nc")
    request = RunRequest(tmp_path / f"{name}.yaml")
    job = Job(request, tmp_path / name, name, RunStage.FINISHED, 3, 2.0, 1.0, 1.0)
    for columns, tables in (("80", 2), ("160", 1)):
        monkeypatch.setenv("COLUMNS", columns)
        print_table([Ended(job, "done", 0)])
        printed = capsys.readouterr().out
        assert "…" not in printed
        assert max(map(len, printed.splitlines())) <= int(columns)
        lines = [line for line in printed.splitlines() if line.startswith(name)]
        assert len(lines) == tables
        assert {"50.00", "300.0"} <= set(" ".join(lines).split())


def test_table_of_runs_leaves_the_cell_of_an_older_run_empty(
    extended: xr.Dataset, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ended = []
    for name, run in (("older", extended.drop_vars(NEW)), ("newer", extended)):
        (tmp_path / name).mkdir()
        vc.save(run.assign_attrs(wall_time=1.0), tmp_path / name / "result.nc")
        request = RunRequest(tmp_path / f"{name}.yaml")
        job = Job(request, tmp_path / name, name, RunStage.FINISHED, 3, 2.0, 1.0, 1.0)
        ended.append(Ended(job, "done", 0))
    print_table(ended)
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines() if line}
    assert "300.0" in lines["newer"]
    assert "300.0" not in lines["older"]
    assert "50.00" in lines["older"]


def test_dimensionless_scalar_has_no_brackets(
    ds: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    entry = Variable("1", "shape", label="Aspect", has_error=True, places=EVERYWHERE, rank=20)
    monkeypatch.setitem(variables.SCALARS, "contact_aspect", entry)
    values = {
        "contact_aspect": ("time", [1.0, 2.0, 3.0], {"units": "1"}),
        "contact_aspect_error": ("time", [0.01] * 3, {"units": "1"}),
    }
    vc.save(ds.assign(values), tmp_path / "result.nc")
    assert main(["show", str(tmp_path / "result.nc")]) == 0
    assert "aspect" in (table := capsys.readouterr().out)
    assert "[]" not in table
    page = report_page(ds.assign(values))
    assert "contact aspect" in page
    assert "[]" not in re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)


@pytest.fixture(scope="module")
def roller() -> xr.Dataset:
    """A crowned roller off the centre, whose contact is five widths long."""
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    grid = vc.Grid((40, 24), (24e-3, 4e-3))
    load = vc.step(4.0, eccentricity_x=4e-4)
    body = vc.Paraboloid(radius_x=0.2, radius_y=0.01)
    return vc.simulate(body, rubber, load, grid, [0.0, 1.0], errors=False)


def test_line_load_is_shown_of_long_contacts_only(ds: xr.Dataset, roller: xr.Dataset) -> None:
    length, width = float(roller.contact_length[0]), float(roller.contact_width[0])
    assert 3 * width < length < 12 * width
    label, peak = "Peak line load", float(roller.peak_line_load[0])
    for run, expected in ((roller, True), (ds, False)):
        assert float(run.peak_line_load[0]) > 0  # in the file of any run
        assert ("peak_line_load" in [row.name for row in summary_rows(run)]) == expected
        assert (label.lower() in [row[0] for row in result_overview(run).rows]) == expected
        assert (label in run_data(run)["facts"].values()) == expected
        assert ("peak_line_load" in response_names(run)) == expected
        assert (label in report_page(run)) == expected
        drawn = [axes.get_ylabel() for axes in history(run).axes]
        assert (f"{label} [N/m]" in drawn) == expected
    [row] = [row for row in summary_rows(roller) if row.name == "peak_line_load"]
    assert (row.title, row.unit, float(row.last)) == (
        *("peak line load", "N/m"),
        close_to(peak, rel=1e-3),
    )
    rotated = roller.rename(contact_length="contact_width", contact_width="contact_length")
    assert "peak_line_load" not in [row.name for row in summary_rows(rotated)]


def test_page_receives_the_list_of_scalars(extended: xr.Dataset, tmp_path: Path) -> None:
    data = run_data(extended)
    assert data["facts"][NEW] == LABEL
    assert data["scalars"][NEW]["value"] == [0.1, 0.2, 0.3]
    assert grown(tmp_path, 0)["labels"][NEW] == LABEL


def test_scripts_of_the_page_have_no_list_of_scalars() -> None:
    labels = {variable.label for variable in SCALARS.values() if " " in variable.label}
    scripts = [*files("viscontact.web").joinpath("static").iterdir()]
    scripts += [files("viscontact.drawing.plotly").joinpath("linked.js")]
    own = [each for each in scripts if each.name.endswith(".js") and "plotly" not in each.name]
    assert labels
    for script in some(own):
        text = script.read_text(encoding="utf-8")
        assert not [label for label in labels if f'"{label}"' in text], script.name
