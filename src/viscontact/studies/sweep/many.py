"""Independent runs in parallel, from Python."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import contextmanager, suppress
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any, overload

import xarray as xr

from viscontact.runs.machine.memory import available_memory
from viscontact.runs.run_memory import fitting
from viscontact.runs.single import simulate
from viscontact.simulation.transient.progress_bar import ProgressBar, reported
from viscontact.studies.executors.dask import dask_executor
from viscontact.studies.executors.driver import Workers
from viscontact.studies.executors.executor_choice import (
    chosen_workers,
    number_of_workers,
    require_executor,
)
from viscontact.studies.executors.local import BEHIND_MAIN, LocalTasks, LocalWorkers
from viscontact.studies.executors.remote import RemoteTasks
from viscontact.studies.sweep.open_many import open_many
from viscontact.studies.sweep.recorded_many import Progress, record_many
from viscontact.studies.sweep.specifications import Recipe, checked_recipes, known_memory

#: Longest time in which an interruption is not noticed on Windows [s].
_PAUSE = 0.5

#: Advice for a run whose process is killed.
_REMEDY = f"{BEHIND_MAIN}; else make the same call again"


@overload
def simulate_many(
    runs: Iterable[Recipe],
    *,
    executor: Executor | None = None,
    client: Any = None,
    directory: None = None,
    workers: int | None = None,
    progress: Progress | bool | None = None,
    return_exceptions: bool = False,
) -> list[Any]: ...
@overload
def simulate_many(
    runs: Iterable[Recipe],
    *,
    executor: Executor | None = None,
    client: Any = None,
    directory: str | Path,
    workers: int | None = None,
    progress: Progress | bool | None = None,
    return_exceptions: bool = False,
) -> xr.Dataset: ...
def simulate_many(
    runs: Iterable[Recipe],
    *,
    executor: Executor | None = None,
    client: Any = None,
    directory: str | Path | None = None,
    workers: int | None = None,
    progress: Progress | bool | None = None,
    return_exceptions: bool = False,
) -> list[Any] | xr.Dataset:
    """Simulate independent runs in several processes, and return their results in order.

    Parameters
    ----------
    runs : iterable of mapping or callable
        Arguments of `simulate` by name for each run, or a function without arguments that
        returns a result. They are sent to other processes and must be picklable: a function of a
        module or a `functools.partial` of one, not a ``lambda``.
    executor : concurrent.futures.Executor, optional
        Executor of the runs, as of PEP 3148: a `ProcessPoolExecutor`, loky, `MPIPoolExecutor` of
        mpi4py.futures, and others. By default warm processes of this machine, of which one that
        is killed is replaced and its run repeated once.
    client : distributed.Client, optional
        Client of a Dask cluster, in place of an executor. Workers that declare the resource MEMORY
        compute as many runs at a time as fit into it.
    directory : path-like, optional
        Record the runs there, each in a directory of its own, with a manifest ``runs.jsonl``. Then
        results stay on this disk, which all workers must see. The same call again, also with
        further runs, computes only what is left. The runs are mappings, which are known by their
        position, so that further ones are appended; or those of `vary`, whose values are equal
        however their quantities are written.
    workers : int, optional
        Number of parallel processes; by default the number of cores that this process may use
        (its binding, control group and SLURM job), or fewer if the runs do not fit into the free
        memory, and 1 in a process that is itself a worker. Each computes on one thread unless the
        run sets ``threads``. An executor or a client has its own number.
    progress : bool or callable, optional
        True: show a bar on stderr. A function is called with (number of the run, done, total) as
        runs end.
    return_exceptions : bool, optional
        Return the exception of a failed run in place of its result, and keep the other results.
        With `directory` a failed run is NaN in the dataset, with its message.

    Returns
    -------
    list of xarray.Dataset, or xarray.Dataset
        One result for each run, in their order, bit-identical to that of `simulate`. With
        `directory` the dataset of `open_many`.

    Raises
    ------
    TypeError
        If a run is no mapping of arguments of `simulate` and no function, or the executor or the
        client is none.
    ValueError, ConvergenceError, DomainError, ...
        The exception of the first run that fails, with a note that names the run. All other runs
        are stopped, as by Ctrl-C.
    RuntimeError
        If a process could not start, or was killed, for example because memory ran out; with
        `directory` if any run has failed, after the end of all others.
    KeyboardInterrupt
        With `directory`, after the runs at work have saved.

    Warns
    -----
    AccuracyWarning
        The warnings of the runs, each with the number of its run.
    RuntimeWarning
        If the memory is too small for `workers` runs at once. The memory of a function, or of a
        run without a given grid, is not known in advance.

    Notes
    -----
    New processes import the calling script first. In a script, put the call under
    ``if __name__ == "__main__":``; in a notebook this is not necessary.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> runs = [
    ...     {"indenter": vc.Sphere(0.01), "material": rubber, "load": vc.step(force)}
    ...     for force in (0.1, 0.8)
    ... ]
    >>> one, eight = vc.simulate_many(runs, workers=2)  # doctest: +SKIP
    >>> round(float(eight.approach[0] / one.approach[0]), 2)  # 8**(2/3)  # doctest: +SKIP
    4.0
    """
    report = reported(progress, ProgressBar("run"))
    require_executor(executor, client, workers)
    recipes = checked_recipes(runs)
    if directory is not None:
        place = Path(directory)
        with tasks_of(recipes, place, executor, client, workers) as tasks:
            record_many(recipes, place, tasks, report, return_exceptions=return_exceptions)
        return open_many(place)
    count = None
    if executor is None and client is None:
        count = _affordable(recipes, workers)
    with chosen_workers(count, executor, client, in_processes=True) as chosen:
        assert chosen.executor is not None
        return _results(recipes, chosen.executor, report, return_exceptions)


@contextmanager
def tasks_of(
    recipes: Sequence[Recipe], directory: Path, executor: Executor | None, client: Any, workers: Any
) -> Iterator[Workers]:
    """Workers of runs that are recorded."""
    if directory.exists() and not directory.is_dir():
        raise ValueError(f"directory: {directory} is a file; name a directory for the runs")
    if executor is not None or client is not None:
        chosen = dask_executor(client) if executor is None else lambda memory: executor
        with RemoteTasks(chosen, directory, _REMEDY) as remote:
            yield remote
        return
    count = _affordable(recipes, workers)
    with LocalWorkers(count) as pool:
        yield LocalTasks(pool, count, f"{_REMEDY}, with fewer workers")


def _affordable(recipes: Sequence[Recipe], workers: int | None) -> int:
    """Number of parallel runs that fit into the free memory, as far as is known."""
    wanted = min(number_of_workers(workers), max(1, len(recipes)))
    needs, available = sorted(map(known_memory, recipes))[-wanted:], available_memory()
    count = max(1, fitting(needs, available))
    if count < len(needs):
        warnings.warn(
            f"{wanted} of these runs at once would need about {sum(needs) / 1e9:.3g} GB of memory, "
            f"{available / 1e9:.3g} GB are free; {count} at a time",
            RuntimeWarning,
            stacklevel=3,
        )
        return count
    return wanted


def _outcome(recipe: Recipe) -> tuple[xr.Dataset, list[tuple[str, type[Warning]]]]:
    """Result and warnings of a run."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        ds = recipe() if callable(recipe) else simulate(**recipe)
    return ds, [(str(each.message), each.category) for each in caught]


def _results(
    recipes: list[Recipe], executor: Executor, progress: Progress | None, return_exceptions: bool
) -> list[Any]:
    """Results of the runs in their order; the first failure in this order is raised."""
    futures = [executor.submit(_outcome, recipe) for recipe in recipes]
    found: list[Any] = []
    try:
        for _ in _as_ended(futures, progress):
            while len(found) < len(futures) and futures[len(found)].done():
                found.append(_result(futures, len(found), return_exceptions))
    except BaseException:
        for future in futures:
            future.cancel()
        raise
    return found


def _as_ended(futures: list[Future[Any]], progress: Progress | None) -> Iterator[int]:
    """Yield the numbers of the runs as they end, and report each."""
    finished: SimpleQueue[Future[Any]] = SimpleQueue()
    numbers = {future: number for number, future in enumerate(futures)}
    for future in futures:
        future.add_done_callback(finished.put)
    done = 0
    while done < len(futures):
        with suppress(Empty):
            number = numbers[finished.get(timeout=_PAUSE)]
            done += 1
            if progress is not None:
                progress(number, done, len(futures))
            yield number


def _result(futures: list[Future[Any]], number: int, return_exceptions: bool) -> Any:
    """Result of a run, with its warnings, or its exception."""
    which = f"run {number + 1} of {len(futures)}"
    error = futures[number].exception()
    if isinstance(error, BrokenExecutor):
        raise RuntimeError(
            f"{which}: its process ended without an answer: {BEHIND_MAIN}; else it was killed, as "
            "happens when memory runs out: then use fewer workers"
        ) from error
    if error is not None:
        error.add_note(f"in {which} of simulate_many")
        if not return_exceptions:
            raise error
        return error
    ds, warned = futures[number].result()
    for text, category in warned:
        warnings.warn(f"{which}: {text}", category, stacklevel=4)
    return ds
