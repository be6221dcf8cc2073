"""Figures of fitted laws and master curves."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from identification.adhesive_curves import RADIUS, drawn
from viscontact import reference
from viscontact.bodies.materials.material import Material
from viscontact.bodies.series_fits import fit_creep, fit_dynamic
from viscontact.identification import (
    CurveFits,
    IndentationRecord,
    Isotherm,
    build_master_curve,
    fit_adhesion,
    fit_indentation,
    fit_master_curve,
)
from viscontact.indenters import Sphere
from viscontact.laws import WLF, Elastic, RelaxationSeries
from viscontact.plot import (
    curve_fits,
    fitted_adhesion,
    fitted_indentation,
    fitted_series,
    master_curve,
    save_figure,
)

T = np.geomspace(0.1, 100.0, 20)


@pytest.fixture(autouse=True)
def _few_dots(monkeypatch):
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 80)


LAW = RelaxationSeries(1e6, [1e9, 3e8], [1.0, 30.0])


def test_a_fitted_series_shows_measured_values_and_residuals_in_per_cent(tmp_path):
    compliance = (1e-9 + 1e-9 * (1 - np.exp(-T / 5.0))) * (1 + 0.01 * np.cos(40 * T))
    fit = fit_creep(T, compliance, data="shear")
    figure = fitted_series(fit)
    above, below = figure.axes
    np.testing.assert_allclose(above.lines[0].get_ydata(), 1e9 * compliance)
    residuals = 100 * (fit.law(T) * 2 / compliance - 1)
    np.testing.assert_allclose(below.lines[0].get_ydata(), residuals, atol=1e-9)
    assert above.get_ylabel() == "Creep compliance J [1/GPa]"
    assert below.get_xlabel() == "Time [s]"
    save_figure(figure, tmp_path / "fit.png")


def test_a_test_under_a_varying_temperature_is_drawn_over_the_reduced_time():
    shift, held = WLF(293.15, 8.86, 101.6), T > 10.0
    fit = fit_creep(
        *(T, 2 - np.exp(-T / 5.0)),
        data="shear",
        temperature=np.where(held, 303.15, 293.15),
        shift=shift,
    )
    above, below = fitted_series(fit).axes
    assert below.get_xlabel() == r"Reduced time $\xi$ [s]"
    last = float(np.diff(T)[-1]) / shift.factor(303.15)
    assert float(np.diff(np.sort(above.lines[0].get_xdata()))[-1]) == close_to(last, rel=1e-9)


def test_the_instant_of_the_step_is_left_off_the_logarithmic_axis():
    t = np.concatenate([[0.0], T])
    above, _ = fitted_series(fit_creep(t, 2 - np.exp(-t), data="deviatoric")).axes
    assert above.lines[0].get_xdata().min() == close_to(0.1)


def test_an_oscillation_has_both_moduli_and_ticks_at_the_inverse_times(tmp_path):
    modulus = LAW.complex_modulus(T)
    fit = fit_dynamic(T, modulus.real, modulus.imag, data="shear", tolerance=1e-9)
    figure = fitted_series(fit)
    above, _ = figure.axes
    legend = above.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["Storage modulus", "Loss modulus"]
    ticks = next(line for line in above.lines if line.get_marker() == "|")
    np.testing.assert_allclose(ticks.get_xdata(), [1.0], rtol=1e-5)  # 1/30 s is off the axis
    assert "(loss)" in above.get_title(loc="right")
    save_figure(figure, tmp_path / "fit.svg")


def test_a_master_curve_shows_sets_factors_and_the_curve(tmp_path):
    rule = WLF(300.0, 10.0, 60.0)
    sets = [
        Isotherm(t, T, {"modulus": LAW.relaxation(T / rule.factor(t))})
        for t in (296.15, 300.0, 303.15)
    ]
    curve = build_master_curve(sets, 300.0)
    figure = master_curve(curve, fit=fit_master_curve(curve, data="shear"), rules=[curve.fit_wlf()])
    by_title = {axes.get_title(loc="left"): axes for axes in figure.axes}
    shifts = by_title["Shift factors"]
    np.testing.assert_allclose(shifts.lines[0].get_xdata(), [23.0, 26.85, 30.0])  # °C
    np.testing.assert_allclose(shifts.lines[0].get_ydata(), np.log10(curve.factors))
    master = next(axes for title, axes in by_title.items() if title.startswith("Master curve at"))
    assert "Master curve at 26.85 °C, " in master.get_title(loc="left")
    shown = np.sort(np.concatenate([line.get_xdata() for line in master.lines[:3]]))
    np.testing.assert_allclose(shown, curve.points)
    save_figure(figure, tmp_path / "master.pdf")


def test_a_master_curve_of_oscillations_explains_which_markers_are_storage_and_loss():
    omega = np.geomspace(0.1, 10.0, 5)
    sets = []
    for temperature, factor in ((290.0, 3.0), (300.0, 1.0)):
        modulus = LAW.complex_modulus(factor * omega)
        measured = {"storage": modulus.real, "loss": modulus.imag}
        sets.append(Isotherm(temperature, omega, measured))
    panel = master_curve(build_master_curve(sets, 300.0)).axes[0]
    narrow = master_curve(build_master_curve(sets, 300.0), width="single").axes[0]
    for axes in (panel, narrow):
        assert axes.get_title(loc="left") == "As measured: ● storage, □ loss"
    storage, loss = panel.lines[:2]
    assert (storage.get_marker(), loss.get_marker()) == ("o", "s")
    assert loss.get_markerfacecolor() == "white"


@pytest.mark.parametrize("given", ["approach", "force"])
def test_an_indentation_fit_shows_record_and_residuals(given, tmp_path):
    t = np.linspace(0.0, 2.0, 21)
    d = 1e-6 * np.minimum(t, 2 - t)
    force = reference.press_axisymmetric(
        reference.SphereProfile(5e-6),
        t,
        approach=d,
        creep_compliance=Material(Elastic(1e6), 0.5).contact_compliance(),
    ).force
    record = IndentationRecord(Sphere(5e-6), t, d, force)
    fit = fit_indentation(record, "elastic", poisson_ratio=0.5, given=given)
    figure = fitted_indentation(fit)
    loop, over_time, rest = figure.axes
    np.testing.assert_allclose(loop.lines[0].get_xdata(), 1e6 * d)
    np.testing.assert_allclose(rest.lines[0].get_ydata(), 100 * fit.residuals)
    assert over_time.get_ylabel() == ("Force [µN]" if given == "approach" else "Approach [µm]")
    save_figure(figure, tmp_path / "record.png")


@pytest.mark.filterwarnings("ignore:the fit misses")
def test_a_misfit_and_its_reason_stand_above_the_figure():
    omega = np.geomspace(0.01, 100.0, 15)
    modulus = LAW.complex_modulus(omega)
    missing = fit_dynamic(omega, modulus.real, 5 * modulus.imag, data="shear")
    heading = fitted_series(missing).axes[0].get_title(loc="left")
    assert heading.endswith("Misses the data: no series has such storage and loss together")
    meeting = fit_dynamic(omega, modulus.real, modulus.imag, data="shear")
    assert fitted_series(meeting).axes[0].get_title(loc="left") == ""
    isotherm = Isotherm(293.15, omega, missing.measured)
    curve = build_master_curve([isotherm], 293.15, WLF(293.15, 12.0, 70.0))
    panel = master_curve(curve, fit=missing).axes[2]
    assert "Misses the data" in panel.get_title(loc="left")


def test_fitted_adhesion_shows_the_curve_and_jumps_along_the_cantilever(tmp_path):
    curve, _ = drawn(3, 0.5, noise=1e-3)
    fit = fit_adhesion(curve, Sphere(RADIUS), poisson_ratio=0.5)
    loop, over_time, rest = (figure := fitted_adhesion(fit)).axes
    units = {"µN": 1e-6, "nN": 1e-9, "nm": 1e-9, "µm": 1e-6}
    force, way = (units[label[-3:-1]] for label in (loop.get_ylabel(), loop.get_xlabel()))
    measured, fitted, *jumps = loop.lines
    near = (fit.approach > 1.5 * fit.fitted_approach[fit.fitted < 0].min()) & (fit.fitted != 0)
    assert np.isin(np.round(fit.measured[near] / force, 9), np.round(measured.get_ydata(), 9)).all()
    np.testing.assert_allclose(force * fitted.get_ydata(), fit.fitted)
    # In a jump the base stands still: the force changes by minus the stiffness over the way.
    assert len(jumps) == 2
    for jump in jumps:
        slope = np.diff(force * jump.get_ydata()) / np.diff(way * jump.get_xdata())
        assert slope[0] == close_to(-curve.spring_constant, rel=1e-9)
    into, off = (force * jump.get_ydata() for jump in jumps)
    assert into[0] == off[1] == 0.0
    assert off[0] == fit.fitted[fit.fitted < 0][-1]
    np.testing.assert_allclose(rest.lines[0].get_ydata(), 100 * fit.residuals)
    assert over_time.get_ylabel() == loop.get_ylabel()
    save_figure(figure, tmp_path / "fit.png")


def test_fits_draw_their_own_figure():
    series = fit_creep(T, 1e-9 + 1e-9 * (1 - np.exp(-T / 5.0)), data="shear")
    depth = 1e-6 * np.linspace(0.0, 1.0, 21)
    record = IndentationRecord(Sphere(5e-6), 1e6 * depth, depth, 2e4 * depth**1.5)
    indentation = fit_indentation(record, "elastic", poisson_ratio=0.5)
    curves = CurveFits((indentation.in_numbers("a"), indentation.in_numbers("b")))
    for fit, figure_of in (
        (series, fitted_series),
        (indentation, fitted_indentation),
        (curves, curve_fits),
    ):
        own, same = fit.plot(width="single"), figure_of(fit, width="single")
        assert [axes.get_ylabel() for axes in own.axes] == [axes.get_ylabel() for axes in same.axes]
        assert own.get_size_inches()[0] == same.get_size_inches()[0]
