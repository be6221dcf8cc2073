"""Doubts about shift factors: uncertain or unknown ones, and sets that contradict each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.identification.shift_uncertainty import ShiftUncertainty
from viscontact.identification.superposition import (
    Superposition,
    slower_steps,
    step_variance,
)
from viscontact.identification.vertical_shift import VerticalShift
from viscontact.units.temperatures import in_celsius

#: Half width of an interval beyond which a shift factor is called uncertain [decades].
UNCERTAIN = 0.1
# A vertical step beyond this many standard deviations and this change is not one of temperature.
_STRANGE, _LARGE = 3.0, 0.1
# Scatter about the common curve at which sets contradict each other, if it is also this multiple
# of the scatter of each set alone, and significantly more.
_CONTRADICTION, _MULTIPLE, _SIGNIFICANCE = 0.04, 1.5, 1e-3
_NON_SIMPLE = (
    "the material is then not thermorheologically simple, or changed between the tests, and one "
    "shift factor does not join its sets"
)


def require_warmer_is_faster(
    owner: str, temperatures: Floats, joined: Superposition, gaps: Sequence[int]
) -> None:
    """Refuse sets of which a warmer one is slower, beyond the uncertainty."""
    for k in set(slower_steps(joined)) - set(gaps):
        decades = np.diff(joined.logs_a)[k] / np.log(10.0)
        raise ValueError(
            f"{owner}: sets at {temperatures[k]:.6g} K and {temperatures[k + 1]:.6g} K: the "
            f"warmer one is slower, by {decades:.2g} decades; have temperatures been "
            "exchanged, or times and frequencies?"
        )


def uncertain_factors(temperatures: Floats, uncertainty: ShiftUncertainty) -> Iterator[str]:
    """Sentence about factors that are uncertain, and about those that are unknown."""
    decades = uncertainty.decades
    unknown = ~np.isfinite(decades)
    if unknown.any():
        yield (
            f"the shift factor is unknown at {_list(temperatures[unknown])}: nothing of these sets "
            "overlaps with those next to the reference temperature; measure at a temperature "
            "between them, or give the shift"
        )
    wide = np.isfinite(decades) & (decades > UNCERTAIN)
    if wide.any():
        each = ", ".join(
            f"± {half:.2g} at {_celsius(kelvin)} °C"
            for kelvin, half in zip(temperatures[wide], decades[wide], strict=True)
        )
        yield (
            f"the shift factor is uncertain by more than {UNCERTAIN:g} decades: log10 a_T is known "
            f"to {each} (95 %), as the sets are nearly flat, overlap too little or scatter too "
            "much there; the law at other temperatures, and beyond the range of one set, is as "
            "uncertain"
        )


def contradictions(joined: Superposition, names: Sequence[str]) -> Iterator[str]:
    """Sentence about responses that miss the common curve by more than their own scatter."""
    own = joined.own
    limits = scipy.stats.f.isf(_SIGNIFICANCE, joined.freedom, np.maximum(own.freedom, 1.0))
    for k, name in enumerate(names):
        ratio = joined.noise[k] / own.noise[k]
        if joined.noise[k] > _CONTRADICTION and ratio > max(_MULTIPLE, np.sqrt(limits[k])):
            yield (
                f"the sets contradict each other: {name} misses the common curve by "
                f"{100 * joined.noise[k]:.2g} % (root mean square), while each set alone scatters "
                f"by {100 * own.noise[k]:.2g} %; the shift factors are the likely culprit. Have "
                "temperatures been exchanged, or is one set of another sample? If not, "
                f"{_NON_SIMPLE}"
            )


def strange_vertical_steps(
    temperatures: Floats, joined: Superposition, vertical: VerticalShift
) -> Iterator[str]:
    """Sentence about each set that is stiffer or softer than temperature explains."""
    if not vertical.is_found:
        return
    count = temperatures.size
    steps, spreads = np.diff(joined.logs_b), vertical.step_spreads
    for k, step in enumerate(steps):
        variance = step_variance(joined.covariance[count:, count:], k)
        surprise = abs(step - vertical.expected_steps[k]) / np.hypot(spreads[k], np.sqrt(variance))
        if surprise > _STRANGE and abs(step) > _LARGE:
            low, high = np.exp(step + np.array([-2, 2]) * np.sqrt(variance))
            more = "stiffer" if step > 0 else "softer"
            yield (
                f"the sets at {_celsius(temperatures[k])} and "
                f"{_celsius(temperatures[k + 1])} °C contradict each other: at equal states "
                f"the warmer one is {more}, {np.exp(step):.3g} times the modulus ({low:.3g} to "
                f"{high:.3g}), where temperature explains "
                f"{temperatures[k + 1] / temperatures[k]:.3g} (a "
                "rubber, modulus as T). Have temperatures been exchanged, or is one set of another "
                f"sample, geometry or unit? If not, {_NON_SIMPLE}"
            )


def _celsius(kelvin: float) -> str:
    return f"{round(in_celsius(kelvin), 6):.4g}"


def _list(temperatures: Floats) -> str:
    return ", ".join(f"{_celsius(kelvin)}" for kelvin in temperatures) + " °C"
