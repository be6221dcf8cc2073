"""Warnings about the material of a run: range of the data, interconversion, passivity."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.bodies.laws import Law, TabulatedCreep, TabulatedRelaxation
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.clock import TIME
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.problem import DataTimes
from viscontact.units.formatting import format_quantity

#: Tolerated negative loss modulus of a table, as a part of the modulus; frequencies examined.
NEGATIVE_LOSS, FREQUENCIES = 0.02, 25

#: Largest relative error of a creep compliance that is not reported.
MAX_LAW_ERROR = 0.01

#: Excess of the thermal expansion over that at once after a change that is not reported [-].
MAX_EXPANSION_SURPLUS = 0.05

#: Part of the largest load that may act for less time than the data cover.
EARLY_LOAD_FRACTION = 0.25


def data_warnings(time: float, measured: Sequence[DataTimes]) -> dict[str, str]:
    """Warn of a run beyond the times at which a material was measured [s]."""
    until, of = min((each.until, place) for place, each in enumerate(measured))
    if time <= until * (1 + 1e-9):
        return {}
    data, at = measured[of], format_quantity(until, "s")
    reduced = "" if data.clock is TIME else f" of reduced time, which it reaches after {at},"
    if reduced:
        at = format_quantity(data.last, "s")
    return {
        "data": (
            f"the run goes beyond {at}{reduced or ','} where the {data.whose}'s data end; from "
            "there on its law is an extrapolation"
        )
    }


def early_warnings(
    measured: Sequence[DataTimes], load: LoadHistory, time: float, side: str = "right"
) -> dict[str, str]:
    """Warn of a time so soon after the load that the first data miss the creep."""
    late = [each for each in measured if each.first > 0]
    if not late:
        return {}
    data = max(late, key=lambda each: time - each.latest_before(time))
    begin = data.latest_before(time)
    before = float(load.level_at(begin)) if begin >= 0 else 0.0
    came = abs(float(load.level_at(time, side=side)) - before)
    if came <= EARLY_LOAD_FRACTION * load.largest_level:
        return {}
    reduced = "" if data.clock is TIME else " of reduced time"
    return {
        "early": (
            f"at t = {format_quantity(time, 's')} {came / load.largest_level:.0%} of the load has "
            f"come within less than {format_quantity(data.first, 's')}{reduced}, where the "
            f"{data.whose}'s data begin; before that its law is an extrapolation. Give the data an "
            "earlier row, or load more slowly"
        )
    }


def expansion_warnings(surplus: float) -> dict[str, str]:
    """Warn of layers whose thermal expansion follows the relaxation of their stress."""
    if surplus <= MAX_EXPANSION_SURPLUS:
        return {}
    return {
        "expansion": (
            "the layers that expand have a bulk modulus that does not relax, so that their "
            "thickness follows a change of temperature with the relaxation of stress; they are "
            f"given that after all relaxation, up to {surplus:.0%} more than at once"
        )
    }


def passage_warnings(passed: float, measured: Sequence[DataTimes]) -> dict[str, str]:
    """Warn of a contact in steady motion that is passed before the data begin [s]."""
    data = max(measured, key=lambda each: each.first)
    if passed >= data.first * (1 - 1e-9):
        return {}
    return {
        "early": (
            f"the contact is passed in {format_quantity(passed, 's', 2)}, before "
            f"{format_quantity(data.first, 's')}, where the {data.whose}'s data begin; its law is "
            "an extrapolation there"
        )
    }


def law_warnings(memory_error: float, inversion_error: float) -> dict[str, str]:
    """Warn of a creep compliance that deviates from the law as given; relative errors [-]."""
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


def origin_warnings(bodies: Sequence[Material]) -> dict[str, str]:
    """Warn of laws that come with a warning, such as a fit that misses its data."""
    texts = dict.fromkeys(body.warning for body in bodies if body.warning)
    return {"origin": "; ".join(texts)} if texts else {}


def splitting_warnings(error: float) -> dict[str, str]:
    """Warn of layers whose response is not well approximated by a sum of products; error [-]."""
    if error <= MAX_LAW_ERROR:
        return {}
    return {
        "splitting": (
            f"the layers' creep under waves of pressure is approximated by a sum that is off by up "
            f"to {error:.1%}; layers whose moduli differ more (a soft cover on a hard core) have a "
            "smaller error"
        )
    }


def passivity_warnings(law: Law, end: float) -> dict[str, str]:
    """Warn of a measured law whose loss modulus is negative at some frequency."""
    # A table of few steep rows can be such between its rows, although no material gains energy.
    # Formulas are passive, so only tables are examined.
    if not isinstance(law, TabulatedCreep | TabulatedRelaxation) or end <= 0:
        return {}
    rows = [time for time in law.times if 0 < time <= end]
    # A bend at the first row affects frequencies above it, too.
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
