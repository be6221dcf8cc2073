"""Shipped cases with other loads than a held one: each runs, and one number of it is theory's."""

from __future__ import annotations

import math
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact import reference
from viscontact.case import read_case
from viscontact.cli import main


@pytest.fixture(autouse=True)
def _few_dots(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 80)


def run_as_a_user(name: str, folder: Path) -> xr.Dataset:
    """Copy the example, run it, show it, draw its figures."""
    case, directory = folder / f"{name}.yaml", folder / name
    assert main(["example", name, "-o", str(case)]) == 0
    # The bars of one of them are enough.
    bars = [] if name == "sphere-load-unload" else ["--set", "output.errors=false"]
    assert main(["run", str(case), "--quiet", *bars]) == 0
    assert main(["show", str(directory)]) == 0
    for figure in ("history", "hysteresis", "pressure-profile")[: 1 if bars else 3]:
        assert main(["plot", str(directory), figure]) == 0
    with vc.open_results(directory) as ds:
        return ds.load()


@pytest.mark.slow
def test_sphere_that_is_let_go_approached_as_lee_and_radok_say(tmp_path: Path) -> None:
    ds = run_as_a_user("sphere-load-unload", tmp_path)
    # Lee & Radok (1960): while the contact grows, delta^(3/2) = (3/4) R^(-1/2) int J(t-t') dW.
    # J = (1 - nu)/(2 G) (1 + 1 - exp(-t/tau)), G = 10 MPa, tau = 1 s; W rises to 4 N in 1 s.
    mean_J = 0.5 / (2 * 10e6) * (2 - (1 - math.exp(-1)))
    peak = (0.75 * 4 * mean_J / math.sqrt(0.01)) ** (2 / 3)
    # The tolerance of the steps is 1e-3; 92 cells across leave a few 1e-4.
    assert float(ds.approach.sel(time=1.0)) == close_to(peak, rel=1e-3)
    # Without load and contact the dent is left, and recovers.
    left = ds.sel(time=slice(2.0, None))
    assert set(left.outcome.values) == {vc.Outcome.NO_CONTACT}
    assert (np.diff(left.approach) < 0).all()
    assert 0 < float(left.approach[-1]) < 1e-3 * peak
    assert ds.field_time.values.tolist() == [0.5, 1.0, 1.5, 2.0, 4.0, 10.0]


def test_probe_feels_and_loses_the_gel_as_ting_says(tmp_path: Path) -> None:
    ds = run_as_a_user("afm-indentation", tmp_path)
    assert main(["plot", str(tmp_path / "afm-indentation"), "pressure-radial"]) == 0
    # Ting (1966), M = 2 G/(1 - nu) = 4 G.
    bead = reference.SphereProfile(5e-6)
    exact = reference.ting_triangle(bead, 4e-7, 1.0, 2000.0, [1200.0, 800.0], [0.1, 1.0])
    scale = float(exact.force(1.0))
    for time in (0.5, 1.0, 1.2, 1.4):
        force = float(ds.force.sel(time=time))
        # The tolerance of the steps is 1e-3 of the pressure; 95 cells across leave as much.
        assert force == close_to(float(exact.force(time)), abs=2e-3 * scale), time
    contact = ds.time.values[ds.outcome.values == vc.Outcome.CONVERGED]
    first_off = ds.time.values[ds.time.values > contact[-1]][0]
    assert contact[-1] < exact.lost < first_off + 0.02
    assert float(ds.force[-1]) == 0.0
    assert float(ds.approach[-1]) == -4e-7


@pytest.mark.slow
def test_loss_of_an_oscillating_punch_follows_from_its_complex_compliance(tmp_path: Path) -> None:
    ds = run_as_a_user("punch-harmonic", tmp_path)
    # w = J F/(2 a) for a punch of any outline whose 1/(2 a) is w/(J F) at once: of the cells'
    # outline then, which is not quite a circle's.
    law, omega = vc.Zener(10e6, 10e6, 5e6), math.pi
    per_compliance = float(ds.approach[0]) / (20.0 * 0.5 * law(0.0))
    assert per_compliance == close_to(1 / (2 * 2e-3), rel=0.03)
    complex_J = 0.5 / (2 * complex(law.complex_modulus(omega)))
    loss = math.pi * 10.0**2 * -complex_J.imag * per_compliance
    # Ferry (1980), ch. 1; the transient of the start, exp(-8/0.5), is over in the fifth cycle. A
    # polygon of 128 sides lacks (2 pi/128)^2/6 = 4e-4 of its ellipse, the march adds half of that.
    assert float(ds.loss_per_cycle[-1]) == close_to(loss, rel=1e-3)
    last = ds.sel(time=slice(8.0, None))
    amplitude = float(last.approach.max() - last.approach.min()) / 2
    assert amplitude == close_to(10.0 * abs(complex_J) * per_compliance, rel=1e-3)


@pytest.mark.slow
def test_roller_that_is_held_approaches_as_an_elastic_one_of_its_compliance(
    tmp_path: Path,
) -> None:
    ds = run_as_a_user("roller-sentences", tmp_path)
    case = read_case(tmp_path / "roller-sentences.yaml")
    hold = [10e3, 10e3, 2e3, 2e3]
    assert case.load == vc.ForceHistory(
        np.append(0, np.cumsum([*[2, 30, 2, 10] * 3, 0.5, 600 - 132.5])),
        [0, *hold, *hold, *hold, 0, 0],
    )
    # While the contact has only grown, a creeping body of any shape approaches as an elastic one
    # under int J(t-t') dW (Lee & Radok 1960): at 32 s, ramped in 2 s, W times J's mean over the
    # lags from 30 s to 32 s, of eq. 15 of Spinu & Cerlinca (2018).
    lags = np.linspace(30.0, 32.0, 2001)
    phi = 7e-10 - 6.17e-11 * np.exp(-0.1 * lags) - 8.38e-11 * np.exp(-7.47e-3 * lags)
    elastic = vc.Material(vc.Elastic(1 / (2 * np.trapezoid(phi, lags) / 2)), 0.38)
    relaxed = vc.simulate(case.indenter, elastic, vc.step(10e3), case.grid, [0.0], fields="none")
    # Approach and area come from increments, which the steps do not change: rounding and the
    # solver's 1e-6, and the printed digits of the law.
    assert float(ds.approach.sel(time=32.0)) == close_to(float(relaxed.approach[0]), rel=1e-5)
    assert float(ds.approach[-1]) < 0.01 * float(ds.approach.max())


@pytest.mark.parametrize(
    "name", ["sphere-load-unload", "afm-indentation", "punch-harmonic", "roller-sentences"]
)
def test_example_says_what_to_look_at(name: str) -> None:
    text = (files("viscontact.case.examples") / f"{name}.yaml").read_text(encoding="utf-8")
    assert "viscontact plot my" in text
    assert "viscontact run my.yaml" in text


@pytest.fixture(scope="module")
def rolling(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Directory of the rolling roller at two speeds."""
    directory = tmp_path_factory.mktemp("rolling") / "roller-rolling"
    case = directory.with_suffix(".yaml")
    few = ["--set", "motion.speed=[10 mm/s, 1 m/s]", "--set", "output.errors=false"]
    assert main(["example", "roller-rolling", "-o", str(case)]) == 0
    assert main(["run", str(case), "--quiet", *few]) == 0
    return directory


def test_friction_of_a_rolling_roller_is_its_lever_over_its_radius(rolling: Path) -> None:
    """The moment of the pressure about the axis of the arc vanishes, as on an axle.

    For a body of constant curvature, resistance times radius is force times eccentricity, as ∂h/∂y
    is y/R (Goryacheva 1998, chapter 6).
    """
    assert main(["plot", str(rolling), "pressure-map", "--speed", "1 m/s"]) == 0
    with vc.open_results(rolling) as ds:
        assert ds.dissipation.values == close_to((ds.resistance_y * ds.speed).values)
        # The cells of the example, 218 um, and the form by the dissipation differ by their bars.
        lever = ds.eccentricity_y / 20e-3
        assert ds.friction_coefficient.values == close_to(lever.values, rel=0.03)


@pytest.mark.slow
def test_report_of_a_rolling_roller_names_the_speed_of_the_largest_friction(
    rolling: Path,
) -> None:
    assert main(["report", str(rolling)]) == 0
    page = (rolling / "report.html").read_text(encoding="utf-8")
    assert "The friction coefficient is largest at 10" in page


@pytest.mark.slow
def test_instrument_meets_its_conditions_as_lee_radok_and_ting_say(tmp_path: Path) -> None:
    ds = run_as_a_user("afm-record", tmp_path)
    reached, lost = ds.attrs["event_times"]
    # Lee & Radok (1960): F = (4/3) sqrt(R) int M(t - t') d(v t')^(3/2), M = 4 G.
    law = vc.RelaxationSeries(500.0, [300.0, 200.0], [0.1, 1.0])
    u = np.linspace(0.0, math.sqrt(reached), 20001)
    since = np.maximum(reached - u * u, 0.0)  # the last one may round to less than 0
    grown = np.trapezoid(4 * law.relaxation(since) * 3 * u * u, u)
    assert 4 / 3 * math.sqrt(5e-6) * 4e-7**1.5 * grown == close_to(1.5e-9, rel=1e-3)
    # Ting (1966), for the approach of the whole record.
    gel = vc.Material(law, 0.5)
    exact = reference.press_axisymmetric(
        reference.SphereProfile(5e-6),
        ds.time.values,
        approach=ds.approach.values,
        creep_compliance=gel.contact_compliance(),
        substeps=4,
    )
    assert np.abs(ds.force.values - exact.force).max() < 3e-3 * 1.5e-9
    assert ds.force[-1] == 0
    assert lost == float(ds.time[-1])
