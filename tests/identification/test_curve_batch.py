"""Many curves are fitted one by one: values and intervals of each, and the reasons of failures."""

from __future__ import annotations

import csv
import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.cli import main
from viscontact.identification import (
    CurveFits,
    FittedCurve,
    IndentationRecord,
    fit_each,
    fit_indentation,
)
from viscontact.plot import curve_fits

RADIUS = 5e-6
TIMES = np.linspace(0.0, 1.0, 41)
DEPTH = 1e-6 * TIMES


def hertz(modulus: float) -> IndentationRecord:
    """Johnson 1985, eq. 4.23: F = 4/3 E* sqrt(R) d^1.5, with E* = 4 G for nu = 0.5."""
    return IndentationRecord(
        vc.Sphere(RADIUS), TIMES, DEPTH, 16 / 3 * modulus * np.sqrt(RADIUS) * DEPTH**1.5
    )


def elastic(record: IndentationRecord) -> vc.IndentationFit:
    return fit_indentation(record, "elastic", poisson_ratio=0.5)


def test_each_curve_has_its_own_modulus_and_a_bad_one_its_reason() -> None:
    moduli = [300.0, 1e3, 5e3]
    records = {f"{modulus:g}": hertz(modulus) for modulus in moduli}
    pulled = IndentationRecord(vc.Sphere(RADIUS), TIMES, DEPTH, np.where(TIMES > 0, -1e-9, 1e-12))
    with ThreadPoolExecutor(2) as executor:
        fits = fit_each(elastic, {**records, "pulled": pulled}, executor=executor)
    assert fits.values_of("shear_modulus") == close_to(moduli, rel=1e-6)
    assert fits.values_of("youngs_modulus") == close_to([3 * each for each in moduli], rel=1e-6)
    assert [each.name for each in fits.failed] == ["pulled"]
    assert "force is not positive" in fits.failed[0].failure
    assert "3 of 4 curves" in repr(fits)


def test_power_laws_are_stated_at_the_time_that_is_asked_for() -> None:
    """A power law is the same curve at any reference time: J(t) = J_r (t/t_r)^n."""
    # Lee & Radok 1960: with d = v t, F(t) = 8/3 sqrt(R) ∫ 2 G(t - s) d(d^1.5), and G of a power law
    # without instant is t^-n/(2 J Γ(1 + n) Γ(1 - n)), so that the integral is a beta function.
    exponent, power = 0.2, 1.5
    relaxed = math.gamma(power + 1) / math.gamma(power + 1 - exponent)
    kernel = relaxed / (1e-3 * math.gamma(1 + exponent))
    force = 8 / 3 * math.sqrt(RADIUS) * DEPTH**1.5 * kernel * np.maximum(TIMES, 1e-12) ** -0.2
    record = IndentationRecord(vc.Sphere(RADIUS), TIMES, DEPTH, force)
    own = fit_indentation(record, "power-law", poisson_ratio=0.5)
    asked = fit_indentation(record, "power-law", poisson_ratio=0.5, reference_time=0.01)
    assert asked.law.reference_time == 0.01
    assert asked.parameters["exponent"] == close_to(0.2, rel=1e-3)
    assert asked.parameters["compliance"] == close_to(1e-3 * 0.01**0.2, rel=2e-3)
    assert float(asked.law(0.5)) == close_to(float(own.law(0.5)), rel=1e-6)
    # E = 3 G of an incompressible body, in relaxation for the reference time.
    relaxed = 1 / (2e-3 * 0.01**0.2 * math.gamma(1.2) * math.gamma(0.8))
    assert asked.in_numbers("").values["youngs_modulus"] == close_to(3 * relaxed, rel=2e-3)


def test_curves_without_names_are_refused() -> None:
    with pytest.raises(ValueError, match=r"must be a mapping of names to curves.*got list"):
        fit_each(elastic, [hertz(1e3)])  # type: ignore[arg-type]


def test_reference_time_of_a_law_without_one_is_refused() -> None:
    with pytest.raises(ValueError, match="reference_time goes with power-law"):
        fit_indentation(hertz(1e3), "elastic", poisson_ratio=0.5, reference_time=1.0)


@pytest.mark.parametrize("factor", [1.0, 3.0, 1e3])
def test_histograms_hold_every_curve(factor: float) -> None:
    units = {"shear_modulus": "Pa"}
    curves = (
        FittedCurve(f"{modulus:g}", {"shear_modulus": modulus}, {}, units)
        for modulus in np.geomspace(1e3, 1e3 * factor, 30).tolist()
    )
    axes = curve_fits(CurveFits(tuple(curves))).axes[0]
    assert sum(bar.get_height() for bar in axes.patches if bar.get_height() >= 1) >= 29
    assert (axes.get_xscale() == "log") == (factor > 10)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    curves = tmp_path / "curves"
    curves.mkdir()
    for number, modulus in enumerate((500.0, 2e3)):
        record = hertz(modulus)
        rows = np.c_[TIMES, DEPTH * 1e6, record.force * 1e9]
        head = "time [s],approach [um],force [nN]"
        np.savetxt(
            curves / f"{number}.csv", rows, delimiter=",", header=head, comments="", fmt="%.9g"
        )
    (curves / "odd.csv").write_text("time [s],strain\n0,0\n1,1\n")
    return curves


TYPED = ("--indenter", "sphere 5 um", "--poisson-ratio", "0.5", "--law", "elastic")


def test_command_writes_one_table_of_a_directory(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["fit", str(folder), *TYPED, "-o", "fits.png"]) == 0
    said = capsys.readouterr()
    assert "2 of 3 curves" in said.out
    assert "odd.csv" in said.err
    with Path("fits.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["curve"] for row in rows] == ["0.csv", "1.csv", "odd.csv"]
    for row, modulus in zip(rows, (500.0, 2e3), strict=False):
        assert float(row["shear_modulus [Pa]"]) == close_to(modulus, rel=1e-4)
        ends = [float(row[f"shear_modulus {end} [Pa]"]) for end in ("low", "high")]
        assert ends[0] <= float(row["shear_modulus [Pa]"]) <= ends[1]
    assert rows[2]["failure"]
    assert Path("fits.png").stat().st_size > 1000


@pytest.mark.parametrize(
    ("typed", "message"),
    [
        (["curves/0.csv", "curves/1.csv"], "2 tables: give --indenter"),
        (["curves/0.csv", *TYPED, "--table", "a.csv"], "--table: goes with several curves"),
        (["curves", *TYPED, "--yaml", "a.yaml"], "--yaml: goes with one table"),
        (["curves/0.csv", "curves/0.csv", *TYPED], "is named twice"),
        (["curves/odd.csv", "curves/odd*.csv", *TYPED], "is named twice"),
    ],
)
def test_command_refuses(
    folder: Path, typed: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["fit", *typed]) == 2
    assert message in " ".join(capsys.readouterr().err.split())


def test_places_are_kept_and_have_a_map_beside_each_histogram() -> None:
    moduli = [300.0, 1e3, 5e3, 2e3]
    records = {f"{modulus:g}": hertz(modulus) for modulus in moduli}
    places = {name: (1e-6 * (n % 2), 1e-6 * (n // 2)) for n, name in enumerate(records)}
    fits = fit_each(elastic, records, places=places)
    assert [each.place for each in fits.curves] == list(places.values())
    figure = curve_fits(fits)
    labels = [axes.get_xlabel() for axes in figure.axes if axes.get_xlabel()]
    assert labels == ["Shear modulus [kPa]", "x [µm]", "Young's modulus [kPa]", "x [µm]"]
    [squares] = figure.axes[1].collections
    np.testing.assert_allclose(squares.get_array(), np.array(moduli) / 1e3, rtol=1e-6)
    corners = [path.vertices[:4].mean(axis=0) for path in squares.get_paths()]
    np.testing.assert_allclose(corners, 1e6 * np.array(list(places.values())), atol=1e-9)


def test_a_batch_is_printed_as_its_summary() -> None:
    fits = fit_each(elastic, {f"{modulus:g}": hertz(modulus) for modulus in (1e3, 2e3, 4e3)})
    lines = str(fits).splitlines()
    assert lines[0] == "Fits of many curves"
    assert [" ".join(line.split()) for line in lines[1:3]] == [
        "curves 3 of 3 curves",
        "shear modulus 2 kPa (half of the curves: 1.5 kPa to 3 kPa)",
    ]
    assert len(lines) == 4
    warned = replace(fits.curves[0], warning="the record leaves open exponent")
    assert "3 of 3 curves, 1 with warnings" in repr(CurveFits((warned, *fits.curves[1:])))
