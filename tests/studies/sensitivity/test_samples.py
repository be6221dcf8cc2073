"""Samples of inputs that scatter: their distributions and their arrangement."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.stats import kstest, norm

from viscontact.studies.sensitivity.samples import Samples, samples_of

TWO = {"load.force": ("1 N", "3 N"), "indenter.radius": ("4 mm", "9 mm", "log")}


def sampled(scatter: dict[str, Any], samples: int, seed: int = 0) -> Samples:
    found, _ = samples_of(scatter, samples, seed)
    assert found is not None
    return found


def values_of(samples: Samples) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Numbers of the settings, shape (samples, points, inputs)."""
    rows = [[float(text.split()[0]) for text in own.values()] for _, own in samples.runs()]
    return np.array(rows).reshape(len(samples.labels), samples.count, len(samples.inputs))


def test_each_input_is_exchanged_alone() -> None:
    first, second, force, radius = values_of(sampled(TWO, 8))
    assert np.array_equal(force, np.column_stack([second[:, 0], first[:, 1]]))
    assert np.array_equal(radius, np.column_stack([first[:, 0], second[:, 1]]))
    assert not np.isin(first, second).any()


@pytest.mark.parametrize(
    ("bounds", "quantile"),
    [
        (("1 N", "3 N"), lambda x: (x - 1) / 2),
        (("1 N", "3 N", "log"), lambda x: np.log(x) / np.log(3)),
        (("1 N", "3 N", "normal"), lambda x: norm.cdf(x, 2, 1 / norm.ppf(0.975))),
    ],
)
def test_the_values_follow_their_distribution(bounds: tuple[str, ...], quantile: Any) -> None:
    both = values_of(sampled({"load.force": bounds}, 256))[:2, :, 0]
    assert both.shape == (2, 256)
    for each in both:
        # A quasi-random sample is closer to the distribution than a random one: 1.2 / 256.
        assert kstest(quantile(each), "uniform").statistic < 0.01


def test_more_samples_begin_with_fewer() -> None:
    few, many = (values_of(sampled(TWO, count)) for count in (8, 16))
    assert np.array_equal(many[:, :8], few)
    assert not np.array_equal(values_of(sampled(TWO, 8, seed=1)), few)


def test_numbers_of_samples_are_rounded_up_with_a_note() -> None:
    found, notes = samples_of(TWO, 100, 0)
    assert found is not None
    assert found.count == 128
    assert notes == ["samples: 100 are rounded up to 128, a power of two"]
    assert samples_of(TWO, 64, 0)[1] == []
    assert samples_of(TWO, 0, 0) == samples_of({}, 64, 0) == (None, [])


@pytest.mark.parametrize(
    ("given", "bounds"),
    [
        ("12 N ± 0.02 N", ("11.98 N", "12.02 N")),
        (("12 ± 0.02 N", "normal"), ("11.98 N", "12.02 N", "normal")),
    ],
)
def test_a_tolerance_scatters_between_its_bounds(given: Any, bounds: Any) -> None:
    assert samples_of({"load.force": given}, 8, 0) == samples_of({"load.force": bounds}, 8, 0)


REFUSED: dict[str, tuple[Any, str]] = {
    "reversed": (("3 N", "1 N"), "scatter: load.force: the lower bound comes first"),
    "equal": (("3 N", "3000 mN"), "the lower bound comes first, and differs"),
    "no number": (("pmma", "epdm"), "'pmma' is not a number"),
    "units": (("3 N", "4 mm"), "the units of '3 N' and '4 mm' do not fit"),
    "one bound": (("3 N",), "('9 kN', '11 kN'), or a number with its tolerance, as '10 kN ±"),
    "three bounds": (("3 N", "4 N", "5 N"), "must be two bounds, as ('9 kN', '11 kN'), or a"),
    "another tolerance": ("3 N ± 1 mm", "the unit of 1 mm does not fit 3 N"),
    "word": (("3 N", "4 N", "gauss"), "and 'log' for a logarithmic scale or 'normal'"),
    "zero": (("0 N", "4 N", "log"), "a logarithmic range needs bounds above zero"),
}


@pytest.mark.parametrize(("bounds", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_bounds_that_do_not_fit_are_refused(bounds: Any, message: str) -> None:
    with pytest.raises(ValueError, match=r"\w") as refusal:
        samples_of({"load.force": bounds}, 8, 0)
    assert message in str(refusal.value)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (({"grid.size": ("1 mm", "2 mm")}, 8, 0), "are no inputs of the contact"),
        ((TWO, -1, 0), "samples must be a whole number"),
        ((TWO, 8, -1), "seed must be a whole number"),
        (([("load.force", "1 N")], 8, 0), "scatter: must be a mapping"),
    ],
)
def test_arguments_that_do_not_fit_are_refused(arguments: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        samples_of(*arguments)
