"""Doubts about the material of a run: its data, what is made of them, and whether they can be."""

from __future__ import annotations

import numpy as np

from viscontact.laws import Law, TabulatedCreep, TabulatedRelaxation
from viscontact.loads import LoadHistory
from viscontact.units.formatting import format_quantity

#: A table's loss modulus may fall below zero by this part of the modulus, at so many frequencies.
NEGATIVE_LOSS, FREQUENCIES = 0.02, 25

#: A creep compliance that may be off by more than this part is not the material's any more.
MAX_LAW_ERROR = 0.01

#: Part of the largest load that may have come later than the data can tell its creep.
EARLY_LOAD_FRACTION = 0.25


def data_warnings(time: float, measured_until: float) -> dict[str, str]:
    """Doubt about a run that goes beyond the times at which the material was measured.

    Parameters
    ----------
    time : float
        Instant of the run [s].
    measured_until : float
        Last time of the data [s].

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(data_warnings(11.0, 10.0)), list(data_warnings(9.0, 10.0))
    (['data'], [])
    """
    if time <= measured_until * (1 + 1e-9):
        return {}
    return {
        "data": (
            f"the run goes beyond {format_quantity(measured_until, 's')}, where the material's "
            "data end; from there on its law is an extrapolation"
        )
    }


def early_warnings(
    measured_from: float, load: LoadHistory, time: float, side: str = "right"
) -> dict[str, str]:
    """Doubt about an instant so soon after the load that no data tell the material's creep yet.

    Parameters
    ----------
    measured_from : float
        First time of the data [s]; 0 if they begin with the instant compliance, or for a formula.
    load : LoadHistory
        What presses.
    time : float
        Instant of the run [s].
    side : {"left", "right"}
        Side of a jump at that instant.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> from viscontact.loads import step
    >>> list(early_warnings(1.0, step(5.0), 0.5)), list(early_warnings(1.0, step(5.0), 1.0))
    (['early'], [])
    """
    if measured_from <= 0:
        return {}
    begin = time - measured_from * (1 - 1e-9)
    before = float(load.level_at(begin)) if begin >= 0 else 0.0
    came = abs(float(load.level_at(time, side=side)) - before)
    if came <= EARLY_LOAD_FRACTION * load.largest_level:
        return {}
    return {
        "early": (
            f"at t = {format_quantity(time, 's')} {came / load.largest_level:.0%} of the load has "
            f"come within less than {format_quantity(measured_from, 's')}, where the material's "
            "data begin; before that its law is an extrapolation. Give the data an earlier row, or "
            "load more slowly"
        )
    }


def law_warnings(memory_error: float, inversion_error: float) -> dict[str, str]:
    """Doubts about a creep compliance that is not quite the one of the law as given.

    Parameters
    ----------
    memory_error : float
        Largest relative deviation of the exponentials that the past is remembered by [-].
    inversion_error : float
        Estimated relative error of a creep compliance converted from a modulus [-].

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(law_warnings(0.1, 0.0)), list(law_warnings(1e-3, 0.02)), law_warnings(1e-3, 1e-3)
    (['memory'], ['conversion'], {})
    """
    warnings: dict[str, str] = {}
    if memory_error > MAX_LAW_ERROR:
        warnings["memory"] = (
            f"the exponentials by which the past is remembered are off by up to "
            f"{memory_error:.0%} of the law's creep compliance; take fewer steps or cells, so "
            "that all steps are kept, or a law without scatter and sharp bends, such as a fit"
        )
    if inversion_error > MAX_LAW_ERROR:
        warnings["conversion"] = (
            f"the creep compliance converted from the law's modulus may be off by "
            f"{inversion_error:.0%} (estimated); smooth the modulus or add rows, or give creep"
        )
    return warnings


def passivity_warnings(law: Law, end: float) -> dict[str, str]:
    """Doubt about a measured law that would give energy back, and more than it was given.

    A table of few steep rows leaves so much open between them that its loss modulus can be negative
    at some frequency, which no material's is.

    Parameters
    ----------
    law : Law
        A law; only tables are looked at, since formulas are passive.
    end : float
        End of the run [s].

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.

    Examples
    --------
    >>> list(passivity_warnings(TabulatedCreep([1, 10, 100], [1, 3, 10]), 100.0))
    ['passivity']
    >>> list(passivity_warnings(TabulatedCreep([0, 1, 10, 100], [1, 1.1, 1.2, 1.3]), 100.0))
    []
    """
    if not isinstance(law, TabulatedCreep | TabulatedRelaxation) or end <= 0:
        return {}
    rows = [time for time in law.times if 0 < time <= end]
    # A bend at the first row is felt at frequencies above it, too.
    frequencies = np.geomspace(1.0 / end, 10.0 / min([*rows, end / 10]), FREQUENCIES)
    modulus = law.complex_modulus(frequencies)
    part = modulus.imag / np.abs(modulus)
    if part.min() > -NEGATIVE_LOSS:
        return {}
    return {
        "passivity": (
            f"at {frequencies[part.argmin()]:.3g} rad/s the measured table has a loss modulus of "
            f"{part.min():.0%} of its modulus, and no material gains energy; add rows (ten a "
            "decade, and one at 0 s), or fit a series to them"
        )
    }
