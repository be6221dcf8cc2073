"""Independent runs in parallel, from Python."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Any

import xarray as xr

from viscontact.grid import Grid
from viscontact.materials.material import Material
from viscontact.runs.free_memory import available_memory
from viscontact.runs.resources import PROGRAM, fitting, least_memory
from viscontact.runs.single import simulate

#: What a run is given as: the arguments of `simulate` by name, or what makes its result.
Recipe = Mapping[str, Any] | Callable[[], xr.Dataset]

#: Libraries that would start a thread for each core, in each process; they read it when imported.
_LIBRARIES = ("OPENBLAS", "MKL", "OMP", "BLIS")


def simulate_many(
    runs: Iterable[Recipe], *, workers: int | None = None, return_exceptions: bool = False
) -> list[Any]:
    """Simulate independent runs in several processes, and return their results in order.

    Parameters
    ----------
    runs : iterable of mapping or callable
        Each the arguments of `simulate` by name, or a function without arguments that returns a
        result. They are sent to the processes: what they hold must be picklable, so that a
        ``lambda`` will not do, a function of a module or a `functools.partial` of one will.
    workers : int, optional
        So many processes at once; as many as there are cores when left out, fewer if so many runs
        do not fit into the memory that is free. Each computes on one thread if the run's own
        ``threads`` does not say otherwise.
    return_exceptions : bool, optional
        Let what a run raises take the place of its result, so that the others are not lost.

    Returns
    -------
    list of xarray.Dataset
        One for each run, in their order; each the same to the last bit as from `simulate`.

    Raises
    ------
    ValueError, ConvergenceError, DomainError, ...
        What the first run that fails raises, with a note that says which it was. The runs at work
        then are ended, as they are by Ctrl-C.
    RuntimeError
        If a process is gone, because it was killed, as systems do that run out of memory, or
        because it could not start.

    Warns
    -----
    AccuracyWarning
        What the runs warn of, each told with its number.
    RuntimeWarning
        If memory is too short for so many at once. What a run takes whose grid is not given is not
        known before, nor that of a function.

    Notes
    -----
    New processes begin by importing the script that called. So the call must stand behind
    ``if __name__ == "__main__":`` in a script; a notebook needs nothing of the kind.

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
    recipes = list(runs)
    count = _affordable(recipes, min(_checked(workers), max(1, len(recipes))))
    before = set(multiprocessing.active_children())
    spawn = multiprocessing.get_context("spawn")  # a fork would copy threads' locks
    with ProcessPoolExecutor(count, mp_context=spawn, initializer=_begin_worker) as pool:
        try:
            with _single_threaded():
                futures = [pool.submit(_outcome, recipe) for recipe in recipes]
            return list(_in_order(futures, return_exceptions))
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            for process in set(multiprocessing.active_children()) - before:
                process.terminate()
            raise


def _checked(workers: int | None) -> int:
    if workers is None:
        return os.cpu_count() or 1
    if isinstance(workers, bool) or not isinstance(workers, int) or workers < 1:
        raise ValueError(f"workers must be a whole number of processes, 1 or more, got {workers!r}")
    return workers


def _affordable(recipes: list[Recipe], wanted: int) -> int:
    """How many of the runs are made at once: no more than fit into memory, as far as is known."""
    needs, available = sorted(map(_least_memory, recipes))[-wanted:], available_memory()
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


def _least_memory(recipe: Recipe) -> float:
    given = {} if callable(recipe) else recipe
    grid, material = given.get("grid"), given.get("material")
    if isinstance(grid, Grid) and isinstance(material, Material):
        return least_memory(grid, material)
    return PROGRAM


@contextmanager
def _single_threaded() -> Iterator[None]:
    """Within it, processes begin whose libraries start no threads of their own accord."""
    names = [f"{library}_NUM_THREADS" for library in _LIBRARIES]
    unset = [name for name in names if name not in os.environ]
    os.environ.update(dict.fromkeys(unset, "1"))
    try:
        yield
    finally:
        for name in unset:
            os.environ.pop(name, None)


def _begin_worker() -> None:
    # Ctrl-C reaches every process at the terminal; the first one ends the others.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    # It waits for runs from a pipe of which it holds both ends: a parent that is killed does not
    # end it.
    if (parent := multiprocessing.parent_process()) is not None:
        parent.join()
        os._exit(1)


def _outcome(recipe: Recipe) -> tuple[xr.Dataset, list[tuple[str, type[Warning]]]]:
    """The result of a run, and what it warned of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        ds = recipe() if callable(recipe) else simulate(**recipe)
    return ds, [(str(each.message), each.category) for each in caught]


def _in_order(futures: list[Future[Any]], return_exceptions: bool) -> Iterator[Any]:
    for number, future in enumerate(futures, start=1):
        which = f"run {number} of {len(futures)}"
        error = future.exception()
        if isinstance(error, BrokenProcessPool):
            raise RuntimeError(
                f"{which}: its process ended without an answer. In a script, call simulate_many "
                'behind `if __name__ == "__main__":`; else it was killed, as happens when memory '
                "runs out: then use fewer workers"
            ) from error
        if error is not None:
            error.add_note(f"in {which} of simulate_many")
            if not return_exceptions:
                raise error
            yield error
            continue
        ds, warned = future.result()
        for text, category in warned:
            warnings.warn(f"{which}: {text}", category, stacklevel=4)
        yield ds
