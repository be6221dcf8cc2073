"""Figures of error bars beside true errors, by quantity and by family."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import binom

from verification.families.solved import counted

Array = np.ndarray

#: Largest uncertainty of an exact value over the larger one of error and bar.
CERTAIN = 0.2

#: Parts of the warnings that name a reason why a value may be worse than its bar: steps, cells,
#: singular pressure. Warnings about the bodies (steep flanks, thickness, data) name none.
REASONS = ("time step", "a single step", "requested times", "cells", "mesh", "singular", "errors")

#: End of a warning that is no reason for another value than the peak pressure.
OF_PEAKS = "if the peak matters"


@dataclass(frozen=True)
class Value:
    """One compared value."""

    family: str
    quantity: str
    run: str
    time: float
    ratio: float  # bar over true error
    error: float  # relative to the exact value
    warned: bool  # a warning of the run names a reason


def values_of(records: Iterable[dict[str, Any]]) -> list[Value]:
    """Compared values of solved runs."""
    found = []
    for record in records:
        if "refused" in record:
            continue
        history, exact, bars = record["history"], record["exact"], record["bars"]
        for name in exact:
            here = counted(name, history, exact)
            here &= np.isfinite(bars[name]) & _is_known(record, name)
            for k in np.flatnonzero(here):
                error = abs(history[name][k] - exact[name][k])
                found.append(
                    Value(
                        record["family"],
                        name,
                        record["name"],
                        float(history["time"][k]),
                        float(bars[name][k] / max(error, 1e-300)),
                        float(error / abs(exact[name][k])),
                        any(_is_reason(text, name) for text in record["warnings"]),
                    )
                )
    return found


def _is_reason(text: str, name: str) -> bool:
    """True if a warning names a reason why a value may be worse than its bar."""
    if text.endswith(OF_PEAKS) and name != "peak_pressure":
        return False
    return any(part in text for part in REASONS)


def _is_known(record: dict[str, Any], name: str) -> Array:
    """Instants at which an exact value is certain enough to judge error and bar by it."""
    error = np.abs(record["history"][name] - record["exact"][name])
    uncertainty = record.get("uncertainty", {}).get(name, np.zeros(len(error)))
    return np.asarray(uncertainty <= CERTAIN * np.fmax(error, record["bars"][name]))


def line(title: str, values: Sequence[Value]) -> str:
    """Numbers of values, parts within and beyond bars, median of bar over error."""
    ratios = np.array([value.ratio for value in values])
    beyond = ratios < 1 / 3
    silent = sum(not value.warned for value, is_out in zip(values, beyond, strict=True) if is_out)
    return (
        f"{title:24s} {len(ratios):5d} values, {np.mean(ratios >= 1):6.1%} within, "
        f"{int(beyond.sum()):3d} beyond three bars ({silent} without a warning), "
        f"median bar/error {np.median(ratios):5.1f}"
    )


@dataclass(frozen=True)
class Unjudged:
    """Counts of values whose bar says nothing that could be compared."""

    unknown: int  # bars that are NaN beside a value that is known
    singular: int  # peaks without a limit, by theory
    missed: int  # of these, stated with a finite bar
    false: int  # finite peaks stated as without a limit
    finite: int  # finite peaks


def unjudged(records: Iterable[dict[str, Any]]) -> Unjudged:
    """Unknown bars, and peaks without a limit as far as they were recognised."""
    counts = np.zeros(5, dtype=int)
    for record in records:
        if "refused" in record:
            continue
        history, bars = record["history"], record["bars"]
        for name, exact in record["exact"].items():
            here = counted(name, history, record["exact"])
            counts[0] += int(np.isnan(bars[name][here]).sum())
            if name == "peak_pressure":
                endless = np.isinf(exact) & (history[name] > 0)
                stated = np.isinf(bars[name])
                counts[1:] += [
                    int(part.sum()) for part in (endless, endless & ~stated, here & stated, here)
                ]
    return Unjudged(*counts.tolist())


def report(records: Sequence[dict[str, Any]]) -> list[str]:
    """Lines of all values, by quantity and by family."""
    values, rest = values_of(records), unjudged(records)
    refused = sum("refused" in record for record in records)
    lines = [
        line(f"{len(records)} runs, {refused} refused", values),
        f"{rest.unknown} bars unknown; {rest.missed} of {rest.singular} singular peaks missed, "
        f"{rest.false} of {rest.finite} finite peaks taken for singular",
    ]
    for attribute in ("quantity", "family"):
        for name in dict.fromkeys(getattr(value, attribute) for value in values):
            part = [value for value in values if getattr(value, attribute) == name]
            lines.append("  " + line(name, part))
    return lines


#: Least part within, overall and in every family and quantity; largest parts beyond three bars, in
#: all and without a warning that names a reason (meant is 0); largest median of bar over error.
WITHIN, WITHIN_EACH, BEYOND_THREE, SILENT, MEDIAN = 0.95, 0.93, 0.005, 0.001, 5.0

#: Least number of values of which a part within is judged.
FEWEST = 40


#: A median of 400 values, of which half are independent, is larger by this once in 20 times: bars
#: over errors scatter by a factor of 4.5.
MEDIAN_OF_SAMPLE = 1.25 * MEDIAN


def least_within(count: int, limit: float) -> float:
    """Least part within its bars that a sample has of values that keep a limit.

    A sample has less once in 70 times. Two instants of a run err alike and count as one.
    """
    independent = count // 2
    return float(binom.ppf(1 / 70, independent, limit)) / independent


def shortfalls(values: Sequence[Value], *, sample: bool = False) -> list[str]:
    """Lines about what falls short of these limits, or of those of a sample; none if kept."""
    ratios = np.array([value.ratio for value in values])
    beyond = [value for value in values if value.ratio < 1 / 3]
    found = []
    silent = sum(not value.warned for value in beyond)
    if (
        np.mean(ratios >= 1) < (least_within(len(values), WITHIN) if sample else WITHIN)
        or len(beyond) > BEYOND_THREE * len(values)
        or silent > SILENT * len(values)
        or np.median(ratios) > (MEDIAN_OF_SAMPLE if sample else MEDIAN)
    ):
        found.append(line("all", values))
    for attribute in ("quantity", "family"):
        for name in dict.fromkeys(getattr(value, attribute) for value in values):
            part = [value for value in values if getattr(value, attribute) == name]
            within = np.mean([value.ratio >= 1 for value in part])
            least = least_within(len(part), WITHIN_EACH) if sample else WITHIN_EACH
            if len(part) >= FEWEST and within < least:
                found.append(line(name, part))
    return found
