"""Verdicts on allowable values: within the errors, over the whole run, with reasons."""

from __future__ import annotations

import csv
import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from reports_without_pictures import without_pictures
from returned import some
from viscontact.case import CaseError, read_case
from viscontact.case.allowable import MOVING, NOT_STEADY, OF_LINES, OF_MOVING_LINES, Allowable
from viscontact.cli import main
from viscontact.plot import margin_history
from viscontact.report import report_page, sweep_page
from viscontact.results import variables
from viscontact.results.variables import STRESSES
from viscontact.results.verdicts import overall, verdict_on, verdicts
from viscontact.units.dimensions import DIMENSIONS

__all__ = ["without_pictures"]  # a fixture

pytestmark = pytest.mark.usefixtures("without_pictures")

CASE = """indenter: {shape: sphere, radius: 10 mm}
material: {law: zener, shear_modulus: 1 GPa, delayed_modulus: 1 GPa, viscosity: 10 GPa s,
  poisson_ratio: 0.4}
load: {kind: step, force: 5 N}
time: {end: 10 s, steps: 6, spacing: log}
grid: {shape: [32, 32], size: [1.2 mm, 1.2 mm]}
"""
ALLOWABLE = "allowable: {peak_pressure: 1 MPa, approach: 1 mm, von_mises: 1 GPa}\n"


def run(values: Any, errors: Any, **attributes: Any) -> xr.Dataset:
    """A result of a peak pressure with its errors at 0 s, 1 s, ..."""
    sizes = {"peak_pressure": ("time", values), "peak_pressure_error": ("time", errors)}
    return xr.Dataset(sizes, {"time": np.arange(len(values), dtype=float)}, attributes)


def found(values: Any, errors: Any) -> tuple[str, float, str]:
    """Verdict on an allowable 10 Pa, its instant and its reason."""
    verdict = verdict_on(run(values, errors), "peak_pressure", 10.0)
    return verdict.verdict, verdict.at, verdict.reason


# --- the rule ---------------------------------------------------------------------------------


def test_passed_if_every_value_with_its_error_is_within() -> None:
    assert found([8.0, 9.0, 7.0], [0.5, 0.9, 0.5]) == ("passed", 1.0, "")
    # Where only zeros are known, it is not the instant without a value.
    assert found([math.nan, 0.0, 0.0], [math.nan, 0.0, 0.0]) == ("passed", 1.0, "")
    # The nearest to the limit is a smaller value with a larger error.
    assert found([9.0, 8.5, 7.0], [0.5, 1.4, 0.5]) == ("passed", 1.0, "")


def test_failed_at_the_worst_instant_not_at_the_end() -> None:
    assert found([12.0, 15.0, 7.0], [0.5, 0.9, 0.5]) == ("failed", 1.0, "")


def test_undecided_where_the_limit_lies_within_the_error() -> None:
    why = "the limit lies within the error"
    assert found([8.0, 9.5], [0.5, 0.6]) == ("undecided", 1.0, why)
    assert found([8.0, 10.5], [0.5, 0.6]) == ("undecided", 1.0, why)
    # The largest value is clear, and a smaller one with a large error is not.
    assert found([9.0, 9.5], [2.0, 0.1]) == ("undecided", 0.0, why)


def test_a_magnitude_is_compared_whatever_its_sign() -> None:
    assert found([-12.0, 3.0], [0.1, 0.1])[:2] == ("failed", 0.0)


def test_value_that_grows_as_cells_get_smaller_fails_beyond_the_limit_and_never_passes() -> None:
    assert found([5.0, 99.0], [0.1, math.inf]) == ("failed", 1.0, "smaller cells give more")
    assert found([5.0, 9.0], [0.1, math.inf]) == ("undecided", 1.0, "smaller cells give more")


def test_a_certain_failure_at_another_instant_decides() -> None:
    assert found([11.0, 99.0], [0.1, math.inf])[:2] == ("failed", 0.0)


def test_undecided_without_an_error_or_a_value() -> None:
    assert found([8.0, 2.0], [0.1, math.nan]) == ("undecided", 1.0, "its error is not known")
    assert found([math.nan], [math.nan])[::2] == ("undecided", "it has no value in this run")
    assert verdict_on(run([1.0], [0.0]), "heat", 1.0).reason == "the result does not have it"


def test_instants_without_a_value_do_not_count() -> None:
    # Such as an eccentricity without contact.
    assert found([math.nan, 8.0], [math.nan, 0.1]) == ("passed", 1.0, "")


def test_what_has_passed_so_far_is_undecided_until_the_run_ends() -> None:
    limit = {"allowable": json.dumps({"peak_pressure": {"limit": 10.0}})}
    [early] = verdicts(run([8.0], [0.1], complete=0, **limit))
    [late] = verdicts(run([8.0], [0.1], complete=1, **limit))
    assert (early.verdict, early.reason) == ("undecided", "the run has not ended")
    assert late.verdict == "passed"


def test_worst_verdict_of_several() -> None:
    one = run([8.0], [0.1])
    several = [verdict_on(one, "peak_pressure", limit) for limit in (9.0, 8.0, 7.0)]
    assert [each.verdict for each in several] == ["passed", "undecided", "failed"]
    assert (overall(several), overall(several[:2]), overall([])) == ("failed", "undecided", None)


# --- the section of a case ----------------------------------------------------------------------


def test_every_scalar_with_an_error_and_the_stresses_can_be_limited() -> None:
    names = set(Allowable.model_fields)
    own = {
        name for name in variables.scalars_with_error() if not variables.SCALARS[name].per_length_of
    }
    # Of those per unit length, the ones that lines are judged by; line_load is force_per_length.
    of_lines = {*OF_LINES, *OF_MOVING_LINES}
    assert of_lines - {"line_load"} <= set(variables.scalars_with_error())
    assert names == own | set(STRESSES) | of_lines
    moving = {name for name, each in variables.SCALARS.items() if each.moving}
    assert moving & names == {*MOVING, *OF_MOVING_LINES}
    assert set(variables.NOT_STEADY) & names == set(NOT_STEADY)


def test_limits_have_the_dimension_of_their_scalar() -> None:
    for name, key in some(Allowable.model_fields.items()):
        annotation = str(key.annotation)
        own = "force_per_length" if name == "line_load" else name
        units = variables.SCALARS[own].units if own in variables.SCALARS else "Pa"
        expected = [
            key for key, known in DIMENSIONS.items() if known.unit.replace("^", "") == units
        ]
        assert units == "1" or any(f"dimension='{key}'" in annotation for key in expected), name


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ("{peak_presure: 65 MPa}", "allowable.peak_presure: unknown key; did you mean 'peak_press"),
        ("{peak_pressure: 65 N}", "allowable.peak_pressure: cannot read '65 N' as a pressure"),
        ("{peak_pressure: 65}", "allowable.peak_pressure: 65 has no unit"),
        ("{approach: -1 mm}", "allowable.approach: must be more than zero"),
        ("{heat: 1 J}", "allowable.heat: only a moving contact has it; add a motion"),
    ],
)
def test_errors_name_the_key(given: str, why: str, tmp_path: Path) -> None:
    (tmp_path / "case.yaml").write_text(CASE + f"allowable: {given}\n", encoding="utf-8")
    with pytest.raises(CaseError) as raised:
        read_case(tmp_path / "case.yaml")
    assert f"case.yaml:7: {why}" in str(raised.value)


# --- from the case to the report ----------------------------------------------------------------


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run with limits, and its summary."""
    made = tmp_path_factory.mktemp("limits")
    (made / "ball.yaml").write_text(CASE + ALLOWABLE, encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def directory(folder: Path) -> Path:
    """Its directory; a failed limit is no failed run."""
    assert main(["run", str(folder / "ball.yaml"), "--quiet"]) == 0
    return folder / "ball"


def test_verdicts_of_a_run_are_kept_in_its_attributes(directory: Path) -> None:
    with vc.open_results(directory) as ds:
        stated = json.loads(ds.attrs["allowable"])
        assert {name: each["verdict"] for name, each in stated.items()} == {
            "peak_pressure": "failed",
            "approach": "passed",
            "von_mises": "passed",
        }
        worst = int(ds.peak_pressure.values.argmax())
        assert stated["peak_pressure"]["value"] == float(ds.peak_pressure[worst])
        assert stated["peak_pressure"]["error"] == float(ds.peak_pressure_error[worst])
        # Hertz: 0.58 to 0.62 of the peak pressure for ν of 0.5 to 0.3 (Johnson 1985, section 3.4).
        assert 0.55 < stated["von_mises"]["value"] / float(ds.peak_pressure[worst]) < 0.65
        assert [each.verdict for each in verdicts(ds)] == ["failed", "passed", "passed"]


def test_show_prints_each_verdict(directory: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(directory)]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert "failed: peak pressure" in printed
    assert "allowable 1 MPa" in printed
    assert "passed: approach" in printed


def test_margin_is_the_part_of_the_limit_that_a_value_with_its_error_leaves() -> None:
    limits = {"allowable": json.dumps({"peak_pressure": {"limit": 10.0}})}
    ds = run([-4.0, 12.0, 5.0, 5.0], [1.0, 1.0, math.nan, math.inf], **limits)
    expected = [0.5, -0.3, math.nan, -math.inf]
    np.testing.assert_allclose(vc.margins(ds).margin_peak_pressure, expected)
    assert vc.margins(ds).margin_peak_pressure.attrs["units"] == "1"
    assert verdict_on(ds, "peak_pressure", 10.0).shown_margin == "−30 %"
    assert not vc.margins(ds.assign_attrs(allowable="{}")).data_vars


def test_margin_grows_as_the_pressure_of_a_creeping_body_falls(
    directory: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with vc.open_results(directory) as ds:
        found = vc.margins(ds)
        line, _, _ = margin_history(ds).axes[0].lines  # both scalars, and the limit
        np.testing.assert_allclose(line.get_ydata(), 100 * found.margin_peak_pressure)
        assert set(found.data_vars) == {"margin_peak_pressure", "margin_approach"}
        # Lee and Radok (1960): the contact grows, so that p0 follows the modulus^(2/3) of the time;
        # the compliance has grown by 1 - exp(-1) at 10 s, the delay of the body.
        first, *_, last = 1 - found.margin_peak_pressure.values
        assert last / first == close_to((2 - math.exp(-1)) ** (-2 / 3), rel=0.05)
        assert (np.diff(found.margin_approach) < 0).all()
        # Hertz: p0 = (6 F E*^2 / (pi^3 R^2))^(1/3), E* = 2 G / (1 - nu).
        peak = (6 * 5.0 * (2e9 / 0.6) ** 2 / (math.pi**3 * 10e-3**2)) ** (1 / 3)
        assert float(found.margin_peak_pressure[0]) == close_to(1 - peak / 1e6, rel=0.05)
    main(["show", str(directory)])
    assert re.search(r"allowable 1 mm, margin 9\d.* %", " ".join(capsys.readouterr().out.split()))


def test_export_has_the_margins_and_the_pressure_at_points(
    directory: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = folder / "life.csv"
    points = ["--point", "0 mm,0 mm", "--point", "100 um,0.05 mm"]
    assert main(["export", str(directory), "-o", str(out), *points]) == 0
    with out.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    with vc.open_results(directory) as ds:
        for row, margin in zip(rows, vc.margins(ds).margin_peak_pressure.values, strict=True):
            assert float(row["margin_peak_pressure"]) == margin
        middle, aside = (
            np.array([float(row[name] or "nan") for row in rows])
            for name in rows[0]
            if name.startswith("pressure at ")
        )
        # Hertz: p = p0 sqrt(1 - r^2 / a^2), on cells of 37.5 um
        half = np.sqrt(ds.contact_area.values / math.pi)
        r = math.hypot(100e-6, 50e-6)
        expected = ds.peak_pressure.values * np.sqrt(1 - (r / half) ** 2)
        np.testing.assert_allclose(aside, expected, rtol=0.03)
        np.testing.assert_allclose(middle, ds.peak_pressure.values, rtol=0.02)


@pytest.mark.parametrize(
    ("point", "why"),
    [
        ("1 mm", "--point: write X,Y with units, as '1 mm,0 mm', got '1 mm'"),
        ("1 N,0 mm", "--point: cannot read '1 N' as a length"),
        ("1 m,0 mm", "--point: x = 1 m is beyond the cells, which go from "),
    ],
)
def test_point_that_does_not_fit_is_refused_in_one_line(
    directory: Path, folder: Path, point: str, why: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["export", str(directory), "-o", str(folder / "no.csv"), "--point", point]) == 2
    said = capsys.readouterr().err
    assert why in said
    assert said.count("\n") == 1
    assert not (folder / "no.csv").exists()


def test_report_has_a_chapter_of_verdicts(directory: Path) -> None:
    with vc.open_results(directory) as ds:
        page = report_page(ds)
        assert '<td class="failed" data-head="verdict">failed</td>' in page
        assert '<a href="#allowable">Allowable values</a>' in page
        assert "Margin of each scalar with its error, over time." in page
        without = report_page(ds.assign_attrs(allowable="{}"))
    assert "Allowable values" in page
    assert "Allowable values" not in without


@pytest.mark.slow
def test_table_of_a_sweep_has_the_worst_verdict_of_each_run(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    values = "load.force=1 mN,5 N"
    case = [str(folder / "ball.yaml"), "--set", "grid={tolerance: 0.1}", "--set"]
    limits = "allowable={peak_pressure: 20 MPa}"
    out = ["-o", str(folder / "sweep")]
    assert main(["run", *case, limits, "--vary", values, *out]) == 0
    table = capsys.readouterr().out
    assert re.findall(r"^ball_.*(passed|failed)", table, re.MULTILINE) == ["passed", "failed"]
    ds = vc.open_many(folder / "sweep")
    assert ds["verdict"].values.tolist() == ["passed", "failed"]
    page = sweep_page(ds, title="sweep")
    assert ds["decided_by"].values.tolist() == ["", "peak_pressure"]
    shown = re.findall(r'data-head="verdict">([^<]*)<', page)
    assert shown == ["passed", "failed: peak pressure"]
    assert main(["collect", str(folder / "sweep"), "-o", str(folder / "sweep.csv")]) == 0
    header, *lines = (folder / "sweep.csv").read_text(encoding="utf-8").splitlines()
    place = header.split(",").index("verdict")
    assert [line.split(",")[place] for line in lines] == ["passed", "failed"]
    assert header.split(",")[place + 1] == "decided_by"
    assert [line.split(",")[place + 1] for line in lines] == ["", "peak_pressure"]
