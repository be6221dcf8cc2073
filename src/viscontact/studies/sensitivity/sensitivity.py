"""Sensitivity of the result to the inputs of a case: `sensitivity`."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr

from viscontact.case import Case
from viscontact.case.errors import dotted
from viscontact.results.netcdf import open_results
from viscontact.studies.case_values import (
    case_path,
    case_with,
    refuse_repeated,
    texts,
)
from viscontact.studies.evaluation import Progress
from viscontact.studies.executors.executor_choice import require_executor
from viscontact.studies.scalars import require_fluid, require_instant
from viscontact.studies.sensitivity.inputs import CaseNumber, input_of, inputs_of
from viscontact.studies.sensitivity.outputs import OutputScalars, checked_outputs
from viscontact.studies.sensitivity.plan import NOMINAL, Plan, planned
from viscontact.studies.sensitivity.result import SensitivityResult
from viscontact.studies.sensitivity.samples import samples_of
from viscontact.studies.sensitivity.table import derivative_table, scatter_table
from viscontact.studies.sweep.many import tasks_of
from viscontact.studies.sweep.open_many import open_many
from viscontact.studies.sweep.recorded_many import record_many
from viscontact.units.numbers import positive

#: Step in the logarithm of an input. Errors of cells vary with the size of the contact within a
#: cell; steps over which the contact grows by a few cells average them.
STEP = 0.1
#: Default number of samples.
SAMPLES = 64
#: Most failed runs that are named.
MOST_NAMED = 10
#: Largest step.
MOST_STEP = 0.5


def sensitivity(  # noqa: PLR0913
    case: str | PathLike[str],
    of: Sequence[str] | str,
    *,
    change: Sequence[str] | None = None,
    scatter: Mapping[str, Any] | None = None,
    samples: int = SAMPLES,
    seed: int = 0,
    at: Literal["worst", "end"] | float = "worst",
    step: float = STEP,
    settings: Mapping[str, Any] | None = None,
    workers: int | None = None,
    executor: Executor | None = None,
    client: Any = None,
    directory: str | PathLike[str] | None = None,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> SensitivityResult:
    """Return derivatives and elasticities of scalars of the result by the inputs of a case.

    Parameters
    ----------
    case : path-like
        Case file, YAML or TOML.
    of : str or sequence of str
        Names of the outputs, scalars of the result, as ``"peak_pressure,approach"``.
    change : sequence of str, optional
        Dotted keys of the inputs, as ``["indenter.radius"]``; entries of lists count from 1. By
        default all numbers other than zero of bodies, load and motion, except tables of points; an
        empty list for no derivatives.
    scatter : mapping, optional
        Inputs that scatter, by dotted key: two bounds of a uniform distribution, as
        ``{"material.poisson_ratio": ("0.36", "0.40")}``, or a number with its tolerance, as
        ``{"indenter.radius": "12 mm ± 0.02 mm"}``; with ``"log"``, the logarithm is uniform; with
        ``"normal"``, the distribution is normal and 95 % of it are between the bounds. Numbers that
        have a tolerance in the case scatter as well.
    samples : int, optional
        Number N of samples, rounded up to a power of two; with d inputs that scatter they take
        N (d + 2) runs. With 0 there are none.
    seed : int, optional
        Seed of the samples. More samples with the same seed begin with these.
    at : {"worst", "end"} or float, optional
        Instant of the outputs: that of the largest magnitude in each run, the last one, or a time
        of the run [s] (in steady motion a speed [m/s]).
    step : float, optional
        Step of the differences in the logarithm of an input [-], up to 0.5. An input whose limit is
        close gets a shorter one.
    settings : mapping, optional
        Values of other keys, the same in all runs.
    workers : int, optional
        Number of parallel processes; by default as many as there are cores.
    executor : concurrent.futures.Executor, optional
        Executor of the runs in place of processes of this machine, as for `simulate_many`. Its
        workers must see the directory.
    client : distributed.Client, optional
        Client of a Dask cluster, in place of an executor.
    directory : path-like, optional
        Keep the runs there; the same call again computes only what is left, with other outputs
        nothing. By default a temporary directory.
    overwrite : bool, optional
        Begin again, in place of the runs that the directory holds.
    progress : callable, optional
        Called after each run with the number of runs so far and that of all.

    Returns
    -------
    SensitivityResult
        ``table`` (xarray.Dataset) with ``elasticity``, ``derivative`` and their errors over
        (output, input), and the scatter of the outputs; ``notes`` and ``runs``.

    Raises
    ------
    ValueError
        If an argument does not fit, or the case is refused (as `CaseError`).
    RuntimeError
        If the run with the values of the case fails; other runs that fail are among the notes.
    KeyboardInterrupt
        After the runs at work have saved.

    Notes
    -----
    With the logarithm u of an input, f'(u) is the central difference with the step h, and with 2 h;
    Richardson's extrapolation of both has an error of order h^4, and their distance is the error
    of the step. Close to a limit, such as a Poisson's ratio of 0.5, differences are one-sided. All
    runs have the same cells and instants, so that most of their errors cancel. They are repeated
    on cells of twice the length, unless the case has ``errors: false``: the largest change
    of the differences, or the relative error of the case if that is larger, is added to its error.
    The scatter is sampled by a scrambled Sobol' sequence. First-order and total indices (Sobol'
    2001) are estimated as by Saltelli and others (2010), with 95 % intervals by bootstrap over the
    samples. They need independent inputs, so that they are NaN if the run of a sample fails.
    New processes import the calling script first: in a script, put the call under ``if __name__ ==
    "__main__":``.

    Examples
    --------
    >>> file = Path(tempfile.mkdtemp(), "ball.yaml")
    >>> _ = file.write_text(
    ...     "{indenter: {shape: sphere, radius: 5 mm}, "
    ...     "material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}, "
    ...     "load: {kind: step, force: 0.1 N}, time: {end: 1 s, steps: 1}, "
    ...     "grid: {shape: [32, 32], size: [2.4 mm, 2.4 mm]}, output: {errors: false}}"
    ... )
    >>> found = sensitivity(file, "approach", change=["load.force"], workers=1)
    >>> one = found.table.sel(output="approach", input="load.force")
    >>> round(float(one.elasticity), 2)  # Hertz: F^(2/3)
    0.67
    """
    require_executor(executor, client, workers)
    path, fixed = case_path(case), texts(settings)
    outputs, length = checked_outputs(of), positive("step", step)
    if length > MOST_STEP:
        raise ValueError(f"step: must be {MOST_STEP} at most, got {step!r}")
    own = case_with(path, fixed)
    require_fluid(own, outputs)
    require_instant(own, at)
    if own.adaptive is not None:
        raise ValueError(
            f"{path}: time.spacing: adaptive steps differ from run to run, and so do their errors; "
            "write uniform or log with a number of steps"
        )
    place = None if directory is None else Path(directory)
    inputs = _inputs(own, change)
    wanted, toleranced = _with_tolerances(own, scatter)
    sampled, rounded = samples_of(wanted, samples, seed)
    scattered = [each.key for each in sampled.inputs] if sampled else []
    refuse_repeated(scatter=scattered, settings=list(fixed))
    begun = None if overwrite else place
    plan, notes = planned(path, fixed, inputs, length, begun, sampled, chosen=change is not None)
    notes = [*(toleranced if sampled else ()), *rounded, *notes]

    runs = plan.runs()
    with _directory(place) as folder:
        with tasks_of(runs, folder, executor, client, workers) as tasks:
            how = {"return_exceptions": True, "overwrite": overwrite}
            record_many(runs, folder, tasks, lambda _, *n: progress and progress(*n), **how)
        scalars = OutputScalars(open_many(folder), at)
        return _evaluated(plan, scalars, outputs, notes, folder / runs[0].directory)


def _inputs(case: Case, change: Sequence[str] | None) -> list[CaseNumber]:
    if change is None:
        found = inputs_of(case)
        if not found:
            raise ValueError("change: the case has no numbers to change; name a key")
        return found
    keys = [change] if isinstance(change, str) else list(change)
    try:
        refuse_repeated(change=keys)
        return [input_of(case, key) for key in keys]
    except ValueError as error:
        raise ValueError(f"change: {error}") from None


def _with_tolerances(case: Case, scatter: Mapping[str, Any] | None) -> tuple[Any, list[str]]:
    """Inputs that scatter: the given ones, and numbers of the case with a tolerance; with notes."""
    if scatter is not None and not isinstance(scatter, Mapping):
        return scatter, []  # is refused with the samples
    given, document = dict(scatter or {}), case.document
    canonical = {alias: key for key, alias in document.aliases.items()}
    found = {
        dotted(path): text
        for path, text in document.tolerances.items()
        if not {dotted(path), dotted(canonical.get(path, path))} & given.keys()
    }
    notes = [f"{key}: scatters by its tolerance in the case, {text}" for key, text in found.items()]
    return {**given, **found}, notes


def _evaluated(
    plan: Plan,
    scalars: OutputScalars,
    outputs: Sequence[str],
    notes: Sequence[str],
    nominal: Path,
) -> SensitivityResult:
    """Result of computed runs, of which that of the case is in the directory `nominal`."""
    if why := scalars.failures.get(NOMINAL):
        raise RuntimeError(f"the run with the values of the case failed: {why}")
    if missing := [name for name in outputs if name not in scalars.joint]:
        raise ValueError(f"of: {missing[0]}: the results do not have it")
    with open_results(nominal) as ds:
        about = {"title": str(ds.attrs.get("title", "")), "at": str(scalars.at)}
        warned = str(ds.attrs.get("warnings", "")).splitlines()
    table, count = derivative_table(plan, scalars, outputs), scalars.joint.sizes["run"]
    if plan.samples is not None:
        table = table.merge(scatter_table(plan.samples, scalars, outputs))
    notes = (*notes, *_failures(scalars, count), *_unknown_errors(table), *warned)
    about["notes"] = "\n".join(notes)
    return SensitivityResult(table.assign_attrs(about), notes, count)


@contextmanager
def _directory(place: Path | None) -> Iterator[Path]:
    if place is not None:
        yield place
        return
    with tempfile.TemporaryDirectory(prefix="viscontact-") as folder:
        yield Path(folder)


def _failures(scalars: OutputScalars, count: int) -> Iterator[str]:
    """Yield the number of failed runs, and names and reasons of the first ones."""
    failed = scalars.failures
    if failed:
        yield f"{len(failed)} of {count} runs failed; what needs them is NaN"
    for name in list(failed)[:MOST_NAMED]:
        yield f"{name}: {failed[name]}"
    if len(failed) > MOST_NAMED:
        yield f"... and {len(failed) - MOST_NAMED} more, which `viscontact status` lists"


def _unknown_errors(table: xr.Dataset) -> Iterator[str]:
    """Yield notes on outputs whose error is not known, or not finite."""
    for name, error in zip(table["output"].values, table["value_error"].values, strict=True):
        if np.isnan(error) and table.sizes["input"]:
            yield f"{name}: its error is not known; the errors are those of the step only"
        elif np.isinf(error):
            yield f"{name}: depends on the mesh, without a limit; so do its derivatives"
