"""A drawn run, solved with its coarser runs and error bars, beside its exact values."""

import time
import warnings
import zlib
from typing import Any

import numpy as np

import viscontact as vc
from verification.families.exact_run import ExactRun
from viscontact.backend.errors import ConvergenceError, DomainError
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.accuracy.coarser_results import history_of
from viscontact.simulation.accuracy.coarser_runs import march_coarser_run, plan_coarser_runs
from viscontact.simulation.accuracy.error_bars import error_bars_from
from viscontact.simulation.accuracy.first_and_last_contact import ZERO_WITHOUT_CONTACT
from viscontact.simulation.transient.found_events import carried_out
from viscontact.simulation.transient.provenance import contact_event_attributes, run_attributes
from viscontact.simulation.transient.setup import prepare_run
from viscontact.simulation.transient.state_generator import march_run

#: Values below this part of the run's largest count as zero: the work after an elastic cycle, say.
ZERO = 2e-3


def solve(family: str, drawn: ExactRun, *, sampled: int | None = None) -> dict[str, Any]:
    """Solve a drawn run; exact values at all instants, or at `sampled` ones of them.

    Keys of the result: ``family``, ``name``; ``setup`` (the run as it was set up, on its last
    grid) and its essentials ``shape``, ``size``, ``tolerance``, ``hereditary_error``,
    ``inversion_error``, ``control``; ``history`` (scalars of the run), ``results`` (of the
    coarser runs), ``bars``, ``exact`` (inf: no limit, NaN: unknown) and its ``uncertainty`` (where
    it counts), all over the run's instants; ``warnings`` (texts); ``seconds`` of the run,
    ``seconds_coarser`` of the coarser runs, ``seconds_exact``. A run that is refused or stops has
    ``refused`` instead.
    """
    record: dict[str, Any] = {"family": family, "name": drawn.name}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", vc.AccuracyWarning)
        try:
            record |= _solved(drawn)
        except (ValueError, ConvergenceError, DomainError) as error:
            return record | {"refused": f"{type(error).__name__}: {error}"}
    texts = [str(each.message) for each in caught if issubclass(each.category, vc.AccuracyWarning)]
    record["warnings"] = [*texts, *record.pop("bar_warnings")]
    begin = time.process_time()
    times = record["history"]["time"]
    places = np.arange(len(times)) if sampled is None else _sample(record, sampled)
    try:
        _add_truth(record, drawn, places)
    except ConvergenceError as error:  # of a finer run
        return record | {"refused": f"truth: {error}"}
    record["seconds_exact"] = time.process_time() - begin
    return record


def _add_truth(record: dict[str, Any], drawn: ExactRun, places: np.ndarray) -> None:
    """Add exact values at some instants, with their uncertainty, and those of events and jumps."""
    times = record["history"]["time"]
    for name, values_at in (("exact", drawn.exact), ("uncertainty", drawn.uncertainty)):
        record[name] = {}
        for quantity, values in values_at(times[places]).items():
            record[name][quantity] = np.full(len(times), np.nan)
            record[name][quantity][places] = values
    if drawn.events:
        _add_events(record, drawn.events)
    _add_jumps(record, drawn.jumps())


def _add_events(record: dict[str, Any], exact: tuple[float, ...]) -> None:
    """Add the instants of events as a scalar, one after the other over the first instants."""
    # What an event gives its value has it whenever this is; the error is that of the instant.
    load, times = record["setup"].problem.load, record["history"]["time"]
    count = len(times)
    for event in load.events:
        given = ZERO_WITHOUT_CONTACT if event.scalar == "contact" else (event.scalar,)
        for name in record["exact"].keys() & set(given):
            record["exact"][name][times == event.time] = np.nan
    found = [event.time for event in load.events]
    for kind, values in (
        ("history", found),
        ("exact", exact),
        ("bars", record["event_errors"]),
    ):
        record[kind]["event_time"] = np.append(values, np.full(count - len(values), np.nan))


def _add_jumps(record: dict[str, Any], exact: dict[str, tuple[np.ndarray, np.ndarray]]) -> None:
    """Add forces and instants of jumps as scalars, over the first instants."""
    count = len(record["history"]["time"])

    def over_time(values: Any) -> np.ndarray:
        return np.append(values, np.full(count - len(values), np.nan))

    for name, (values, uncertainty) in exact.items():
        found, errors = jumps_in(record["attributes"], name)
        # Another number of jumps: which is which is not known.
        same = len(found) == len(values)
        record["history"][name] = over_time(found)
        record["bars"][name] = over_time(errors)
        record["exact"][name] = over_time(values if same else np.full(len(found), np.nan))
        record["uncertainty"][name] = over_time(uncertainty if same else np.zeros(len(found)))


def jumps_in(attributes: Any, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Values and errors of an attribute of jumps, or the instants of a kind of jump [s]."""
    if name in attributes:
        return np.array([attributes[name]]), np.array([attributes[f"{name}_error"]])
    kinds = np.array(attributes["event_kind"].split("\n"))
    times, errors = (np.array(attributes[f"event_time{end}"]) for end in ("s", "_errors"))
    # A condition of a program that ends on the loss of contact is met at its instant, too.
    return times[kinds == name], errors[kinds == name]


def _solved(drawn: ExactRun) -> dict[str, Any]:
    """Run, coarser runs and bars."""
    begin = time.process_time()
    run = prepare_run(carried_out(Problem(**drawn.arguments)))
    states = list(march_run(run))
    own = time.process_time() - begin
    setup = run.on(states[-1].grid)
    history = history_of([state.without_fields() for state in states])
    begin = time.process_time()
    planned = list(plan_coarser_runs(setup, history))
    results = [result for each in planned if (result := march_coarser_run(each))]
    coarser = time.process_time() - begin
    bars = error_bars_from(setup, history, results)
    return {
        "setup": setup,
        "shape": setup.grid.shape,
        "size": setup.grid.size,
        "tolerance": setup.problem.tolerance,
        "hereditary_error": setup.hereditary.error,
        "inversion_error": setup.problem.compliance.inversion_error,
        "control": setup.problem.load.control,
        "history": history,
        "results": results,
        "bars": bars.values,
        "bar_warnings": bars.warnings,
        "event_errors": bars.attributes.get("event_time_errors", ()),
        "attributes": attributes_of(setup, states, bars.attributes),
        "seconds": own,
        "seconds_coarser": coarser,
    }


def attributes_of(setup: Any, states: Any, described: Any) -> dict[str, Any]:
    """Attributes of jumps of bodies that adhere, with errors described; none of others."""
    if setup.problem.adhesion is None:
        return {}
    events = [event for state in states for event in state.events]
    return contact_event_attributes(events, run_attributes(setup) | dict(described))


def counted(name: str, history: Any, exact: dict[str, np.ndarray]) -> np.ndarray:
    """Instants at which a scalar is compared: what is prescribed, zero or unknown is not."""
    values, found = exact[name], history[name]
    with np.errstate(invalid="ignore"):
        known = np.isfinite(values) & np.isfinite(found)
        largest = np.nanmax(np.abs(found), initial=0.0)
        known &= np.abs(values) > ZERO * largest
        if name == "mean_pressure":  # below zero it is rounding, after the contact is lost
            known &= values > 0
        error = np.abs(found - values)
        # Prescribed, or known from the outline of the body: nothing is estimated.
        if not known.any() or (error[known] <= 1e-9 * np.abs(values[known])).all():
            return np.zeros(len(values), dtype=bool)
    return np.asarray(known)


def _sample(record: dict[str, Any], count: int) -> np.ndarray:
    """A few of the instants at which there is contact, or has been; neighbours err alike."""
    begun = np.flatnonzero(np.maximum.accumulate(record["history"]["peak_pressure"]) > 0)
    places = begun if len(begun) else np.arange(1)
    rng = np.random.default_rng(zlib.crc32(record["name"].encode()))
    return np.sort(rng.choice(places, min(count, len(places)), replace=False))
