"""The shipped case of a sphere that is pulled off, over the rate of its withdrawal."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.cli import main
from viscontact.runs import adhesive_forecast, forecast
from viscontact.runs.preparation import prepared
from viscontact.runs.solving import solve
from viscontact.simulation.transient.stepper import Stepper

SETTINGS = ("output.fields=none", "grid.shape=[48, 48]")
UNTIL = "until contact is lost"
#: Pull-off force of the exponential law at the Tabor number 1 of the relaxed body, over pi w R, by
#: an axisymmetric computation on rings.
RELAXED = 1.664


@pytest.mark.slow
def test_pull_off_over_the_rate_rises_from_the_relaxed_body_to_a_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["example", "pull-off", "-o", "pull.yaml"]) == 0
    rates = ("0.002 um/s", "1 um/s", "100 um/s")
    vary = "load.sentences[3]=" + ",".join(f"retract at {rate} {UNTIL}" for rate in rates)
    given = [each for setting in SETTINGS for each in ("--set", setting)]
    assert main(["run", "pull.yaml", "-o", "rates", "--quiet", *given, "--vary", vary]) == 0
    ds = vc.open_many("rates")
    pulls, errors = ds["pull_off_force"].values, ds["pull_off_force_error"].values
    assert (ds["pull_off_force"].dims, ds["pull_off_force"].attrs["units"]) == (
        ("load.sentences[3]",),
        "N",
    )
    unit = math.pi * 20e-3 * 20e-6
    # At this rate the edge passes its zone of 0.8 µm in minutes, the body relaxes in a second.
    assert abs(pulls[0] - RELAXED * unit) < 2 * errors[0] + 0.01 * RELAXED * unit
    assert (np.diff(pulls) > 10 * errors[:-1]).all()
    for run, name in enumerate(ds["name"].values):
        with vc.open_results(Path("rates") / f"pull_{name}") as own:
            assert (pulls[run], errors[run]) == (
                own.attrs["pull_off_force"],
                own.attrs["pull_off_force_error"],
            )
    assert main(["collect", "rates", "-o", "rates.csv"]) == 0
    with Path("rates.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [float(row["pull_off_force [N]"]) for row in rows] == pulls.tolist()
    assert [float(row["error of pull_off_time [s]"]) for row in rows] == close_to(
        ds["pull_off_time_error"].values, rel=1e-12
    )
    for figure in ("pull-off", "response"):
        assert main(["plot", "rates", figure, "-o", f"{figure}.png"]) == 0
    assert main(["report", "rates"]) == 0
    assert "Pull-off force [µN]" in Path("rates/report.html").read_text(encoding="utf-8")


@pytest.mark.slow
def test_forecast_counts_steps_that_the_run_takes_within_a_factor_of_two(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With convolutions that take no time, the forecast is a number of steps; a clock may vary."""
    case = tmp_path / "pull.yaml"
    assert main(["example", "pull-off", "-o", str(case)]) == 0
    given = read_case(case, ["grid.shape=[48, 48]", "output.errors=false"])
    run = prepared(given).run
    monkeypatch.setattr(forecast, "convolution_time", lambda *_: 0.0)
    marches = 2  # the first one finds the events
    expected = run.seconds / (marches * adhesive_forecast.OVERHEAD)
    taken = 0

    def counted(self: Stepper, *steps: object) -> object:
        nonlocal taken
        taken += 1
        return accept(self, *steps)

    accept = Stepper.accept
    monkeypatch.setattr(Stepper, "accept", counted)
    solve(run)
    assert taken / 2 < expected < taken * 2
