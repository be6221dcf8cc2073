"""Load programs at the command line: run, interruption, sweep, tables and figures."""

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from case.test_case_programs import CASE
from closeness import close_to
from interrupted_runs import kill, same_bits
from viscontact.cli import main
from viscontact.drawing.plotly.panel_over_run import history
from viscontact.plot import history as drawn_history
from viscontact.report.accuracy import accuracy_lines

ERRORS = "output.errors=true"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
def test_a_killed_run_is_resumed_to_the_same_bits(folder):
    assert main(["run", "case.yaml", "-q", "-o", "whole", "--set", ERRORS]) == 0
    kill(9, "-o", "part", "--set", ERRORS)
    assert main(["run", "case.yaml", "-q", "-o", "part", "--resume", "--set", ERRORS]) == 0
    with xr.open_dataset("whole/result.nc") as whole, xr.open_dataset("part/result.nc") as part:
        assert same_bits("part", whole)
        for name in ("events", "event_times", "event_time_errors", "case"):
            np.testing.assert_array_equal(whole.attrs[name], part.attrs[name])
    # Finished, it is not run again.
    assert main(["run", "case.yaml", "-q", "-o", "part", "--resume", "--set", ERRORS]) == 0


def test_tables_and_figures_show_the_events(folder, capsys):
    assert main(["check", "case.yaml"]) == 0
    checked = capsys.readouterr().out
    assert "force reaches 50 mN at about 21" in checked
    assert main(["run", "case.yaml", "-q", "-o", "out", "--set", ERRORS]) == 0
    capsys.readouterr()
    assert main(["show", "out"]) == 0
    shown = capsys.readouterr().out
    ds = vc.open_results("out")
    lines = ds.attrs["events"].splitlines()
    assert len(lines) == 2
    for line in lines:
        assert f"event at {line}" in shown
        assert "(± " in line
    first = float(ds.attrs["event_times"][0])
    figure = drawn_history(ds)
    marked = [line.get_xdata()[0] for line in figure.axes[0].get_lines() if line.get_ls() == ":"]
    assert marked[0] == close_to(first * 1e3)  # in ms
    assert "force reaches 50 mN" in figure.get_supxlabel()
    shapes = history(ds, "approach").layout.shapes
    assert shapes[0].x0 == close_to(first * 1e3)
    assert shapes[0].label.text == "1"
    assert dict(accuracy_lines(ds))["Event 1"] == lines[0]
    ds.close()


@pytest.mark.slow
def test_a_sweep_varies_sentences(folder):
    fast = "move at 0.2 mm/s until force reaches 50 mN"
    slow = "move at 0.1 mm/s until force reaches 50 mN"
    arguments = ["--vary", f"load.sentences[1]={slow},{fast}", "-o", "both", "-j", "1", "-q"]
    assert main(["run", "case.yaml", *arguments]) == 0
    ends = []
    for path in sorted(folder.glob("both/*/result.nc")):
        with xr.open_dataset(path) as ds:
            ends.append(float(ds.attrs["event_times"][0]))
            assert float(ds.force.max()) == close_to(0.05, rel=1e-6)
    # Twice as fast, the force is reached in a little less than half of the time.
    assert 0.45 < min(ends) / max(ends) < 0.5
