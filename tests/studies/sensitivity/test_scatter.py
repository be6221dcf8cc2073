"""Scatter of outputs: Sobol' indices and percentiles against known ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import nullcontext
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray
from tests.studies.sensitivity.cases import HERTZ, written

import viscontact as vc
from closeness import close_to
from viscontact.studies.sensitivity.samples import samples_of
from viscontact.studies.sensitivity.variance import indices_of, percentiles_of
from viscontact.studies.sweep.varied_runs import VariedRun

Floats = NDArray[np.float64]
Function = Callable[[Floats], Floats]

#: Keys whose parts of their ranges are the arguments of a test function.
KEYS = ("load.force", "material.youngs_modulus", "indenter.radius_x")
RANGES = {KEYS[0]: ("1 N", "2 N"), KEYS[1]: ("10 MPa", "20 MPa"), KEYS[2]: ("10 mm", "20 mm")}
LOW = np.array([1.0, 10.0, 10.0])


def ishigami(u: Floats) -> Floats:
    """Ishigami and Homma (1990), a = 7 and b = 0.1, of parts u of the ranges -pi to pi."""
    x = np.pi * (2 * u - 1)
    return np.asarray(np.sin(x[..., 0]) * (1 + 0.1 * x[..., 2] ** 4) + 7 * np.sin(x[..., 1]) ** 2)


#: Its indices (Sobol' and Levitan 1999): V1 = (1 + b pi^4/5)^2 / 2, V2 = a^2 / 8,
#: V13 = b^2 pi^8 (1/18 - 1/50).
_V1, _V2, _V13 = (1 + 0.1 * np.pi**4 / 5) ** 2 / 2, 49 / 8, 0.01 * np.pi**8 * (1 / 18 - 1 / 50)
_V = _V1 + _V2 + _V13
ISHIGAMI = np.array([[_V1 / _V, _V2 / _V, 0.0], [(_V1 + _V13) / _V, _V2 / _V, _V13 / _V]])

_A = np.array([0.0, 1.0, 4.5])


def sobol_g(u: Floats) -> Floats:
    """Sobol's G (Saltelli and Sobol' 1995)."""
    return np.asarray(np.prod((np.abs(4 * u - 2) + _A) / (1 + _A), axis=-1))


_PARTS = 1 / (3 * (1 + _A) ** 2)
_ALL = np.prod(1 + _PARTS) - 1
SOBOL_G = np.array([_PARTS, _PARTS * np.prod(1 + _PARTS) / (1 + _PARTS)]) / _ALL


class FunctionInPlaceOfRuns:
    """Stands for `record_many`: the result of each run is a function of its settings."""

    def __init__(self, function: Function, failing: Sequence[str] = ()) -> None:
        self._function, self._failing = function, failing

    def __call__(self, runs: Sequence[VariedRun], directory: Path, *given: Any, **how: Any) -> None:
        parts = np.array([self._parts(run) for run in runs])
        names = [run.name for run in runs]
        done = np.array([name not in self._failing for name in names])
        values = np.where(done, 10 + self._function(parts), np.nan)
        over = ("run", "time")
        both = np.column_stack([values, 2 * values])
        nominal = xr.Dataset({"force": ("time", [1.0, 2.0])}, {"time": [0.0, 1.0]})
        vc.save(nominal, directory / "nominal.nc")
        Path(directory, runs[0].directory).mkdir()
        Path(directory, "nominal.nc").rename(Path(directory, runs[0].directory, "result.nc"))
        self.joint = xr.Dataset(
            {
                "approach": (over, both),
                "state": ("run", np.where(done, "done", "failed")),
                "message": ("run", np.where(done, "", "the contact reaches the border")),
            },
            {"time": [0.0, 1.0], "name": ("run", names)},
        )

    def _parts(self, run: VariedRun) -> Floats:
        texts = [run.settings.get(key, f"{low} x") for key, low in zip(KEYS, LOW, strict=True)]
        return np.array([float(text.split()[0]) for text in texts]) / LOW - 1


def scattered(
    path: Path, monkeypatch: pytest.MonkeyPatch, function: FunctionInPlaceOfRuns, samples: int
) -> vc.SensitivityResult:
    module = import_module(
        "viscontact.studies.sensitivity.sensitivity"
    )  # not the function of this name
    monkeypatch.setattr(module, "tasks_of", lambda *_: nullcontext())
    monkeypatch.setattr(module, "record_many", function)
    monkeypatch.setattr(module, "open_many", lambda _: function.joint)
    return vc.sensitivity(
        path, "approach", change=[], scatter=RANGES, samples=samples, at="end", seed=3
    )


@pytest.mark.parametrize(
    ("function", "exact"), [(ishigami, ISHIGAMI), (sobol_g, SOBOL_G)], ids=["ishigami", "g"]
)
def test_sobol_indices_of_known_functions_lie_within_their_intervals(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, function: Function, exact: Floats
) -> None:
    stand_in = FunctionInPlaceOfRuns(function)
    found = scattered(written(tmp_path, HERTZ), monkeypatch, stand_in, 256)
    table = found.table.sel(output="approach")
    for name, wanted in zip(("first_order", "total_order"), exact, strict=True):
        assert (table[f"{name}_low"].values <= wanted).all(), name
        assert (table[f"{name}_high"].values >= wanted).all(), name
        assert table[name].values == close_to(wanted, abs=0.15)
    assert found.runs == 1 + 1 + 256 * 5  # the case, on coarser cells too, and the samples
    # Percentiles of the same function by a random sample of its own.
    many = 2 * (10 + function(np.random.default_rng(1).random((200_000, 3))))
    spread = np.ptp(np.percentile(many, [5, 95]))
    wanted = np.percentile(many, [5, 50, 95])
    assert table["percentile"].values == close_to(wanted, abs=0.05 * spread)
    assert table["band"].values[:, 1] == close_to(table["percentile"].values)


@pytest.mark.parametrize(("function", "exact"), [(ishigami, ISHIGAMI), (sobol_g, SOBOL_G)])
def test_the_error_of_sobol_indices_falls_with_the_number_of_samples(
    function: Function, exact: Floats, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(import_module("viscontact.studies.sensitivity.variance"), "RESAMPLES", 2)
    errors = []
    for count in (64, 512, 4096):
        squares = []
        for seed in range(6):
            samples, _ = samples_of(RANGES, count, seed)
            assert samples is not None
            found = indices_of(function(samples.points()), seed)
            estimated = np.array([found.first_order[0], found.total_order[0]])
            squares.append(np.mean((estimated - exact) ** 2))
        errors.append(np.sqrt(np.mean(squares)))
    # At least as fast as of random points, with the root of their number: 8 ** (1 / 2) = 2.8.
    assert (np.array(errors[:-1]) / errors[1:] > 2.8).all()


def test_a_failed_sample_is_named_and_leaves_no_indices(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stand_in = FunctionInPlaceOfRuns(sobol_g, ("sample A 00003", "sample load.force 00001"))
    found = scattered(written(tmp_path, HERTZ), monkeypatch, stand_in, 16)
    assert "2 of 82 runs failed; what needs them is NaN" in found.notes
    assert "sample A 00003: the contact reaches the border" in found.notes
    assert np.isnan(found.table.first_order.values).all()
    assert np.isfinite(found.table.percentile.values).all()
    assert int(np.isnan(found.table["sample"].values).sum()) == 1
    assert "in total not known" in str(found)


def test_an_output_that_does_not_vary_has_no_indices() -> None:
    found = indices_of(np.full((4, 8), 3.0), 0)
    assert np.isnan(found.total_order).all()


def test_percentiles_over_time_leave_out_unknown_instants_and_not_their_runs() -> None:
    values = np.array([[1.0, np.nan], [2.0, 5.0], [3.0, 7.0], [np.nan, np.nan]])
    assert percentiles_of(values, np.array([50.0])).tolist() == [[2.0, 6.0]]


def test_a_single_input_causes_all_of_the_variance() -> None:
    found = indices_of(np.random.default_rng(0).random((3, 8)), 0)
    assert found.first_order.tolist() == found.total_order.tolist() == [[1.0]] * 3


@pytest.mark.slow
def test_the_scatter_of_a_hertzian_approach_follows_its_closed_form(tmp_path: Path) -> None:
    # Johnson (1985), eq. 4.23: the approach is a product of independent factors g, F^(2/3) and
    # E^(-2/3). With c = var g / mean(g)^2, the variance of their product is prod(1 + c) - 1.
    text = HERTZ.replace("48, 48", "32, 32") + "output: {errors: false}\n"
    scatter = {"load.force": ("0.8 N", "1.2 N"), KEYS[1]: ("9 MPa", "11 MPa", "log")}
    found = vc.sensitivity(
        written(tmp_path, text), "approach", change=[], scatter=scatter, samples=32, workers=2
    )
    force = [(1.2 ** (p + 1) - 0.8 ** (p + 1)) / (0.4 * (p + 1)) for p in (2 / 3, 4 / 3)]
    modulus = [(11**p - 9**p) / (p * np.log(11 / 9)) for p in (-2 / 3, -4 / 3)]
    c = np.array([second / first**2 - 1 for first, second in (force, modulus)])
    every = np.prod(1 + c) - 1
    table = found.table.sel(output="approach")
    exact = {"first_order": c / every, "total_order": c * (1 + c[::-1]) / every}
    for name, wanted in exact.items():
        assert (table[f"{name}_low"].values <= wanted).all()
        assert (table[f"{name}_high"].values >= wanted).all()
    # Percentiles by a random sample of the closed form, relative to that of the case.
    random = np.random.default_rng(2).random((2, 100_000))
    factors = (0.8 + 0.4 * random[0]) ** (2 / 3) * (0.9 * (11 / 9) ** random[1]) ** (-2 / 3)
    wanted = np.percentile(factors, [5, 50, 95])
    assert table["percentile"].values / float(table["value"]) == close_to(wanted, abs=0.015)


def test_tolerances_of_the_case_scatter(tmp_path: Path) -> None:
    text = HERTZ.replace("48, 48", "24, 24") + "output: {errors: false}\n"
    text = text.replace("force: 1 N", "force: 1 N ± 0.2 N").replace("0.4}", "0.4 ± 0.1}")
    found = vc.sensitivity(
        written(tmp_path, text),
        "approach",
        change=[],
        scatter={"material.poisson_ratio": "0.4 ± 0.05"},
        samples=4,
        workers=1,
    )
    assert sorted(found.table.scattered.values) == ["load.force", "material.poisson_ratio"]
    assert "load.force: scatters by its tolerance in the case, 1 N ± 0.2 N" in found.notes
    # Hertz: the approach is proportional to (F (1 - nu^2))^(2/3).
    low, high = (
        (force * (1 - ratio**2) / (1 - 0.4**2)) ** (2 / 3)
        for force, ratio in ((0.8, 0.45), (1.2, 0.35))
    )
    table = found.table.sel(output="approach")
    nominal = float(table["value"])
    assert low * nominal < float(table["percentile"][0]) < 0.97 * nominal
    assert 1.03 * nominal < float(table["percentile"][-1]) < high * nominal


def test_intervals_are_those_of_points_drawn_anew() -> None:
    """Efron (1979): percentiles of the indices of as many points, drawn with replacement."""
    first, second = np.random.default_rng(0).standard_normal((2, 64, 2))
    mixed = [np.where([n == 0, n == 1], second, first) for n in (0, 1)]
    values = np.array([points @ [1.0, 2.0] for points in (first, second, *mixed)])
    found = indices_of(values, 1)
    again = np.random.default_rng(2).integers(64, size=(1000, 64))
    a, b, *exchanged = values[:, again]
    both = np.concatenate([a, b], axis=1)
    middle, variance = both.mean(axis=1, keepdims=True), both.var(axis=1)
    for n, each in enumerate(exchanged):
        # Saltelli and others (2010); that of Jansen (1999) for the total index.
        alone = ((b - middle) * (each - a)).mean(axis=1) / variance
        total = ((a - each) ** 2).mean(axis=1) / (2 * variance)
        for index, drawn in ((found.first_order, alone), (found.total_order, total)):
            low, high = np.percentile(drawn, [2.5, 97.5])
            # An end of 1000 draws is known within a tenth of the width.
            assert index[1:, n] == close_to(np.array([low, high]), abs=0.1 * (high - low))
