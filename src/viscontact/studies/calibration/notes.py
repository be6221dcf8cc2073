"""Notes on a calibration: values that the records do not determine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from viscontact.studies.calibration.search import Optimum
from viscontact.studies.calibration.unknowns import Unknown

#: Correlation from which on two parameters are not distinguished, and the part of a range that
#: counts as its bound.
_INSEPARABLE, _AT_BOUND = 0.99, 1e-3


def notes_on(
    unknowns: Sequence[Unknown], found: Optimum, confidence: float, budget: int
) -> Iterator[str]:
    """Yield notes on the optimum of a search of at most `budget` runs."""
    names, correlation = [each.name for each in unknowns], found.correlation
    for n in range(len(names)):
        for m in range(n):
            if abs(correlation[n, m]) > _INSEPARABLE:
                yield (
                    f"{names[m]} and {names[n]} cannot be distinguished (correlation "
                    f"{correlation[n, m]:+.4f}): fix one of them, or add a record with another "
                    "rate or a hold"
                )
    for each, part, reach in zip(unknowns, found.point, found.reach(confidence), strict=True):
        if not _AT_BOUND < part < 1 - _AT_BOUND:
            yield f"{each.name} lies at its bound {each.text(round(part))}; widen its range"
        elif reach > 0.5:
            yield f"{each.name} is left open: its interval is longer than its range"
    if not found.complete:
        yield f"the search ended after {budget} runs, before it had converged; allow more runs"
