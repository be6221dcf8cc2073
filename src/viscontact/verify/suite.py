"""List of all verification cases, and their execution."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from viscontact.verify import (
    adhesion,
    coupled_friction,
    creeping_friction,
    edges,
    elastic,
    ends,
    fixed_contact,
    friction,
    friction_on_layers,
    given_pressure,
    growing,
    layers,
    leakage,
    line_contact,
    moving_contact,
    periodic,
    rough_theory,
    steady_motion,
    temperature,
    unloading,
)
from viscontact.verify.case import Case, Result, run_case

CASES: tuple[Case, ...] = (
    *elastic.CASES,
    *edges.CASES,
    *growing.CASES,
    *unloading.CASES,
    *fixed_contact.CASES,
    *friction.CASES,
    *creeping_friction.CASES,
    *coupled_friction.CASES,
    *temperature.CASES,
    *layers.CASES,
    *friction_on_layers.CASES,
    *ends.CASES,
    *periodic.CASES,
    *line_contact.CASES,
    *moving_contact.CASES,
    *steady_motion.CASES,
    *given_pressure.CASES,
    *leakage.CASES,
    *rough_theory.CASES,
    *adhesion.CASES,
)

#: Called before each case with the case, the number done and the total.
Progress = Callable[[Case, int, int], None]


def run_cases(
    *,
    fast: bool = False,
    cases: Sequence[Case] = CASES,
    progress: Progress | None = None,
) -> list[Result]:
    """Run verification cases and compare them with exact solutions.

    Parameters
    ----------
    fast : bool
        Two coarse refinements of each case instead of three.
    cases : sequence of Case
        Cases to run; all when left out.
    progress : callable, optional
        Called with (case, done, total) before each case.

    Returns
    -------
    list of Result
        One for each quantity of each case, in order.

    Examples
    --------
    >>> results = run_cases(fast=True, cases=CASES[:1])
    >>> [(result.quantity, result.passed) for result in results]
    [('approach', True), ('central pressure', True), ('contact radius', True)]
    """
    results: list[Result] = []
    for done, case in enumerate(cases):
        if progress is not None:
            progress(case, done, len(cases))
        results.extend(run_case(case, fast=fast))
    return results
