"""Records under a temperature that varies, reduced to one temperature by their shift."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import Any, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies.laws import Shift
from viscontact.bodies.laws.time_temperature import GAS_CONSTANT
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.series_fits.columns import positive_column, require_rows
from viscontact.bodies.series_fits.found_shift import FoundShift, factors_over
from viscontact.bodies.series_fits.joint_fit import JointFit, joint_fit
from viscontact.bodies.series_fits.shift_rules import (
    ENERGIES,
    RULES,
    ArrheniusRule,
    ShiftRule,
    WlfRule,
    table_of,
)
from viscontact.bodies.series_fits.spectrum import dense_spectrum, strengths_at
from viscontact.bodies.series_fits.thermal_record import (
    DIFFERENCE,
    ThermalRecord,
    require_steps,
)
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import positive

#: Probability of the intervals.
CONFIDENCE = 0.95

#: Half the width of the interval of the shift over the record, over itself, that is warned of.
UNCERTAIN = 0.5

#: Fall of the information criterion, and part of the largest compliance, from which on a thermal
#: strain is part of a fit.
NOTABLE_EXPANSION, LEAST_EXPANSION = 10.0, 2e-3

#: Part of the largest activation energy that is searched from which on a shift is doubtful.
MOST_OF_SEARCHED = 0.9

#: Temperature below which all rows are taken as degrees Celsius [K].
COLDEST = 150.0

#: Rows that a fit of a shift uses; of longer records groups of rows are averaged.
MOST_ROWS = 1500

#: Temperatures at which a shift is stated where a record does not dwell.
_STATED = 5


class ShiftOptions(TypedDict, total=False):
    """Options of fits of records under a temperature that varies."""

    temperature: ArrayLike | TemperatureHistory | None
    shift: str | Shift | None
    reference_temperature: float | None


def reduced_record(  # noqa: PLR0913
    owner: str,
    times: Floats,
    values: Floats,
    *,
    rises: bool,
    fluid: bool,
    temperature: ArrayLike | TemperatureHistory | None,
    shift: str | Shift | None = None,
    reference_temperature: float | None = None,
    thermal_strain: bool | None = None,
) -> tuple[Floats, Floats, FoundShift | None]:
    """Reduced times [s] and values without thermal strain, in the order given, and the shift.

    Without a temperature, times and values as they are.
    """
    if temperature is None:
        options = {"shift": shift, "reference_temperature": reference_temperature}
        _refuse_idle(owner, thermal_strain=thermal_strain, **options)
        return times, values, None
    order = np.argsort(times, kind="stable")
    history = _history(owner, times[order], order, temperature)
    expands = bool(thermal_strain)
    record = ThermalRecord(times[order], history, values[order], rises, fluid, expands)
    if thermal_strain and not rises:
        raise ValueError(
            f"{owner}: thermal_strain goes with creep; at a constant strain a change of "
            "temperature causes a stress that relaxes, for which there is no term"
        )
    reference = getattr(shift, "reference_temperature", record.first_level)
    if reference_temperature is not None:
        reference = positive(f"{owner}: reference_temperature", reference_temperature, "K")
    if isinstance(shift, Shift):
        found = _given(record, shift.referred_to(reference), reference)
    else:
        require_steps(owner, record)
        records = [record]
        if rises and thermal_strain is None:
            records.append(replace(record, expands=True))
        found = _found(records, _rules(owner, record, shift, reference))
    for text in found.warnings:
        warnings.warn(text, AccuracyWarning, stacklevel=4)
    back = np.argsort(order, kind="stable")
    cold = record.values - (found.expansion or 0.0) * record.warmer
    return record.reduced(found.shift)[back], cold[back], found


def _refuse_idle(owner: str, **given: object) -> None:
    """Refuse options that go with a temperature."""
    for name, value in given.items():
        if value is not None and value is not False:
            raise ValueError(
                f"{owner}: {name} goes with temperature, that of each row of the record; give "
                f"temperature=, or leave {name} out"
            )


def _history(
    owner: str, times: Floats, order: Any, given: ArrayLike | TemperatureHistory
) -> TemperatureHistory:
    """Temperature over time, of its value at each row of a record if it is a column."""
    for row in np.flatnonzero(np.diff(times) <= 0)[:1]:
        raise ValueError(
            f"{owner}: times, row {int(order[row + 1])}: two rows of a record under a temperature "
            f"have the same time, {format_quantity(times[row], 's', 6)}; leave one out"
        )
    if isinstance(given, TemperatureHistory):
        return given
    column = positive_column(owner, "temperature", given, "K")
    require_rows(owner, 3, times=times, temperature=column)
    if column.max() < COLDEST:
        raise ValueError(
            f"{owner}: temperature must be absolute, got at most {column.max():.6g} K; 20 °C is "
            "293.15 K"
        )
    return TemperatureHistory(times, column[order])


def _given(record: ThermalRecord, shift: Shift, reference: float) -> FoundShift:
    """The given shift, with the thermal strain that goes with it."""
    stated = _stated(record)
    decades = factors_over(shift, stated)
    found = FoundShift(shift, reference, stated, decades, np.zeros(stated.size))
    if not record.expands:
        return found
    observed = record.observed(shift)
    dense = dense_spectrum(observed)
    return replace(found, expansion=record.expansion_of(strengths_at(observed, dense.times)[0]))


def _found(records: list[ThermalRecord], rules: list[ShiftRule]) -> FoundShift:
    """Shift found with the law: the rule of the least criterion, without a thermal strain first."""
    record, fits, best = _chosen(records, rules)
    shift, stated = best.rule.shift(best.free), _stated(record)
    decades = factors_over(shift, stated)
    reach = best.reach(CONFIDENCE)
    errors = _errors_over(best, stated)
    spread = np.maximum(np.sqrt(np.diag(best.covariance)), np.finfo(float).tiny)
    found = FoundShift(
        shift=shift,
        reference_temperature=best.rule.reference,
        temperatures=stated,
        decades=decades,
        errors=errors,
        parameters=best.rule.parameters(best.free),
        intervals=best.rule.intervals(best.free, reach, best.covariance / np.outer(spread, spread)),
        confidence=CONFIDENCE,
        criteria={each: fit.criterion - best.criterion for each, fit in fits.items()},
        expansion=best.expansion if record.expands else None,
        expansion_error=best.expansion_error * reach[0] / spread[0],
        widening=best.widening,
    )
    chosen = record.expands and len(records) > 1
    return replace(found, warnings=_doubts(record, best, found, chosen=chosen))


def _chosen(
    records: list[ThermalRecord], rules: list[ShiftRule]
) -> tuple[ThermalRecord, dict[str, JointFit], JointFit]:
    """The record that is fitted, fits by rule, and the best one."""
    chosen: tuple[ThermalRecord, dict[str, JointFit], JointFit] | None = None
    for record in records:
        averaged = _averaged(record)
        fits = {rule.name: joint_fit(averaged, rule) for rule in rules}
        best = min(fits.values(), key=lambda fit: fit.criterion)
        notable = abs(best.expansion) * np.ptp(record.temperatures) > LEAST_EXPANSION * np.max(
            record.values
        )
        if chosen is None or (notable and best.criterion < chosen[2].criterion - NOTABLE_EXPANSION):
            chosen = record, fits, best
    assert chosen is not None  # there is a record
    return chosen


def _rules(
    owner: str, record: ThermalRecord, name: str | None, reference: float
) -> list[ShiftRule]:
    """Rules to try."""
    rules: dict[str, ShiftRule] = {
        "arrhenius": ArrheniusRule(reference, record.history.range),
        "wlf": WlfRule(reference, record.history.range),
        "table": table_of(record.levels, record.history.range, reference),
    }
    if name is None:
        return [rules["arrhenius"], rules["wlf"]]
    if name not in rules:
        raise ValueError(
            f"{owner}: shift must be one of {', '.join(RULES)}, or a WLF, Arrhenius or "
            f"TabulatedShift, got {name!r}"
        )
    if name == "table" and record.levels.size < 2:
        raise ValueError(
            f"{owner}: shift 'table' has a factor for each temperature that the record dwells at, "
            "and it dwells at less than two; take 'arrhenius' or 'wlf'"
        )
    return [rules[name]]


def _averaged(record: ThermalRecord) -> ThermalRecord:
    """The record with means of equal groups of rows, if it is long."""
    size = -(-record.times.size // MOST_ROWS)
    if size == 1:
        return record
    kept = record.times.size // size * size
    times, values = (
        each[:kept].reshape(-1, size).mean(1) for each in (record.times, record.values)
    )
    return replace(record, times=times, values=values)


def _stated(record: ThermalRecord) -> Floats:
    """Temperatures at which the shift is stated [K]."""
    if record.levels.size > 1:
        return record.levels
    return np.linspace(*record.history.range, _STATED)


def _errors_over(fit: JointFit, temperatures: Floats) -> Floats:
    """Half widths of the intervals of log10 a_T at temperatures [-]."""
    steps = DIFFERENCE * np.eye(fit.free.size)
    logs = [
        [factors_over(fit.rule.shift(fit.free + sign * step), temperatures) for sign in (1, -1)]
        for step in steps
    ]
    slopes = np.array([(high - low) / (2 * DIFFERENCE) for high, low in logs])
    variance = np.einsum("ij,ik,kj->j", slopes, fit.covariance, slopes)
    quantile = fit.reach(CONFIDENCE)[0] / np.sqrt(
        max(float(fit.covariance[0, 0]), np.finfo(float).tiny)
    )
    return np.asarray(quantile * np.sqrt(np.maximum(variance, 0.0)))


def _doubts(
    record: ThermalRecord, fit: JointFit, found: FoundShift, *, chosen: bool
) -> tuple[str, ...]:
    """What is doubtful about a shift."""
    doubts = []
    ends = np.array(record.history.range)
    change = float(np.abs(np.diff(factors_over(found.shift, ends)))[0])
    error = float(np.abs(np.subtract(*_errors_over(fit, ends))))
    if error > UNCERTAIN * change:
        doubts.append(
            f"the shift over the record, {change:.2g} decades, is uncertain by {error:.2g}: "
            "temperature and time can hardly be told apart in it; hold the temperature in more "
            "or larger steps, or give the shift"
        )
    energy = change * np.log(10.0) * GAS_CONSTANT / abs(float(np.subtract(*(1 / ends))))
    if energy > MOST_OF_SEARCHED * ENERGIES[-1]:
        doubts.append(
            f"the shift over the record, {change:.2g} decades, is that of an activation energy of "
            f"{energy / 1e3:.0f} kJ/mol, where the search ends: each step of the temperature is a "
            "test of its own then, and many laws fit. Check that the rows follow the temperature "
            "through its ramps, try --thermal-strain no, or give the shift"
        )
    if chosen:
        doubts.append(
            "a part of the strain follows the temperature at once, as thermal expansion does: "
            f"{1e6 * fit.expansion:.3g} /(MPa K), found with the law and subtracted; decide "
            "yourself by thermal_strain (--thermal-strain yes or no)"
        )
    return tuple(doubts)
