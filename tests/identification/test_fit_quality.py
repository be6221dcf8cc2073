"""Misfits: each reason on data that have the fault, and silence on data that do not."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from closeness import close_to
from returned import some
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies.series_fits import Fit, fit_dynamic, fit_relaxation
from viscontact.bodies.series_fits.columns import positive_column
from viscontact.bodies.series_fits.conventions import bulk_arguments
from viscontact.bodies.series_fits.quality import Reason
from viscontact.bodies.series_fits.responses import DynamicResponse
from viscontact.bodies.series_fits.spectrum import unweighted
from viscontact.bodies.series_fits.weights import given_weights, weighted
from viscontact.case import read_material
from viscontact.identification import material_section
from viscontact.laws import RelaxationSeries

OMEGA = np.geomspace(1e-4, 1e4, 49)
T = np.geomspace(1e-3, 1e5, 49)
# A broad spectrum over the whole range: some ten terms are needed.
TIMES = np.geomspace(1e-4, 1e4, 17)
SERIES = RelaxationSeries(1e6, (1e9 * TIMES**-0.25).tolist(), TIMES.tolist())
MODULUS = SERIES.complex_modulus(OMEGA)


def scattered(values: np.ndarray, share: float, seed: int) -> np.ndarray:
    return values * np.exp(share * np.random.default_rng(seed).standard_normal(values.shape))


def reason_of(fit: Fit) -> Reason | None:
    return fit.misfit.reason if fit.misfit else None


def oscillation(storage: np.ndarray, loss: np.ndarray, **options: object) -> Fit:
    return fit_dynamic(OMEGA, storage, loss, data="shear", **options)


@pytest.mark.parametrize("share", [0.0, 0.03])
def test_a_fit_within_the_scatter_of_an_instrument_does_not_warn(share):
    """3 % scatter is below 10 % rms, and none of 98 values is off by 25 %."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", AccuracyWarning)
        assert oscillation(scattered(MODULUS.real, share, 1), scattered(MODULUS.imag, share, 2))
        assert fit_relaxation(T, scattered(SERIES.relaxation(T), share, 3), data="shear")


def test_losses_on_another_scale_than_the_storage_contradict_kramers_kronig():
    """G'' is about (pi/2) dG'/d ln(omega), Booij and Thoone (1982): a factor cannot be fitted."""
    with pytest.warns(AccuracyWarning, match="no series has such storage and loss together"):
        fit = oscillation(MODULUS.real, 3.0 * MODULUS.imag)
    assert reason_of(fit) is Reason.DISAGREEMENT
    assert "Kramers-Kronig" in fit.misfit.message
    # Each alone is fitted within a tenth of a percent, which the message says.
    assert "storage alone is met to 0.1 %, loss alone is met to 0.1 %" in fit.misfit.message


def test_few_terms_over_many_decades_are_named_as_too_few():
    with pytest.warns(AccuracyWarning, match="the terms are too few; 2 are used"):
        fit = oscillation(MODULUS.real, MODULUS.imag, terms=2)
    assert reason_of(fit) is Reason.TERMS
    with pytest.warns(AccuracyWarning, match="Allow more terms"):
        assert reason_of(fit_relaxation(T, SERIES.relaxation(T), data="shear", terms=1))


@pytest.mark.parametrize("seed", range(3))
def test_scatter_of_a_fifth_is_named_as_scatter(seed):
    with pytest.warns(AccuracyWarning, match="the data scatter"):
        both = oscillation(scattered(MODULUS.real, 0.2, seed), scattered(MODULUS.imag, 0.2, seed))
    with pytest.warns(AccuracyWarning, match="the data scatter"):
        one = fit_relaxation(T, scattered(SERIES.relaxation(T), 0.2, seed), data="shear")
    assert (reason_of(both), reason_of(one)) == (Reason.SCATTER, Reason.SCATTER)


def test_the_root_mean_square_of_each_column_is_printed():
    storage, loss = scattered(MODULUS.real, 0.2, 1), scattered(MODULUS.imag, 0.3, 2)
    with pytest.warns(AccuracyWarning, match="the data scatter"):
        fit = oscillation(storage, loss)
    for name, missed in some(fit.residuals.items()):
        rms = float(np.sqrt(np.mean(missed**2)))
        assert f"{rms:.2e} of {name}" in repr(fit)
        assert f"{name} by {100 * rms:.2g} % (root mean square" in fit.misfit.message


def test_one_wrong_row_is_named():
    values = SERIES.relaxation(T)
    values[20] *= 1.5
    with pytest.warns(AccuracyWarning, match="such as modulus, row 20"):
        fit = fit_relaxation(T, values, data="shear")
    assert reason_of(fit) is Reason.SCATTER
    assert fit.residual < 0.1 < 0.25 < fit.largest_residual


def test_a_solid_fitted_as_a_fluid_is_named():
    solid = RelaxationSeries(1e8, [1e9], [1.0]).complex_modulus(OMEGA)
    with pytest.warns(AccuracyWarning, match="Leave out the option fluid"):
        assert reason_of(oscillation(solid.real, solid.imag, fluid=True)) is Reason.SOLID
    assert oscillation(solid.real, solid.imag).misfit is None


@pytest.mark.filterwarnings("ignore:the fit misses")
def test_the_weight_of_a_column_decides_which_one_is_met():
    """Of two columns that contradict each other, the residual of the heavier one is the smaller."""
    rms = {}
    for heavy in ("storage", "loss"):
        fit = oscillation(MODULUS.real, 2.0 * MODULUS.imag, weights={heavy: 30.0})
        assert fit.weights == {"storage": 1.0, "loss": 1.0} | {heavy: 30.0}
        rms[heavy] = {name: np.sqrt(np.mean(r**2)) for name, r in fit.residuals.items()}
    assert rms["storage"]["storage"] < 0.1 * rms["loss"]["storage"]
    assert rms["loss"]["loss"] < 0.1 * rms["storage"]["loss"]


def test_weights_found_are_the_inverse_scatter_of_each_column_also_where_they_disagree():
    """1 % and 4 %: a ratio of 4, estimated from 49 rows each, whether the columns agree or not."""
    storage, loss = scattered(MODULUS.real, 0.01, 5), scattered(MODULUS.imag, 0.04, 6)
    agreeing = oscillation(storage, loss).weights
    with pytest.warns(AccuracyWarning, match="Kramers-Kronig"):
        disagreeing = oscillation(storage, 3.0 * loss).weights
    assert agreeing["storage"] == close_to(4.0, rel=0.3)
    assert agreeing["loss"] == 1.0
    assert disagreeing["storage"] == close_to(agreeing["storage"], rel=1e-6)


@pytest.mark.parametrize(
    ("weights", "said"),
    [
        ({"G'": 2.0}, 'weights are those of storage and loss, got one of "G\'"'),
        ({"loss": 0.0}, "the weight of loss must be a positive finite number, got 0"),
        ({"loss": "heavy"}, "the weight of loss must be a positive finite number, got 'heavy'"),
    ],
)
def test_weights_that_cannot_be_used_are_refused(weights, said):
    with pytest.raises(ValueError, match=said):
        oscillation(MODULUS.real, MODULUS.imag, weights=weights)


def test_the_section_of_a_misfit_carries_it_as_a_comment_and_a_warning(tmp_path):
    with pytest.warns(AccuracyWarning, match="the terms are too few"):
        fit = fit_relaxation(T, SERIES.relaxation(T), data="shear", terms=1)
    section = material_section(fit)
    assert section.startswith("material:\n  # misfit: the terms are too few\n")
    path = tmp_path / "law.yaml"
    # Data of shear lack the volume, which the last line asks for.
    path.write_text(f"{section}\n  poisson_ratio: 0.4\n", encoding="utf-8")
    material = read_material(path)
    assert isinstance(material.law, RelaxationSeries)
    assert material.warning == fit.misfit.message
    assert "warning" not in material_section(fit_relaxation(T, SERIES.relaxation(T), data="shear"))


def test_arguments_of_a_fit_are_checked_by_name_and_row():
    with pytest.raises(ValueError, match=r"times, row 1: must be a finite number above 0 s"):
        positive_column("fit_creep", "times", [1.0, -2.0], "s")
    bulk = bulk_arguments("fit_creep", "uniaxial", 0.4, None)
    assert bulk == {"poisson_ratio": 0.4, "bulk_modulus": None}
    weights = given_weights("fit_dynamic", {"storage": 3}, ("storage", "loss"))
    assert weights == {"storage": 3.0, "loss": 1.0}
    # Of root mean square 1, so that a residual is compared with the same tolerance as without.
    values = np.concatenate([MODULUS.real, MODULUS.imag])
    observed = weighted(unweighted(DynamicResponse(OMEGA, fluid=False), values), weights)
    assert np.mean(observed.weights**2) == close_to(1.0, rel=1e-14)
    assert observed.weights[0] == close_to(3.0 * observed.weights[-1], rel=1e-14)
